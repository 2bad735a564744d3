"""Networks, patches, distances and k-d trees beside their peers: `python -m
tests.benchmarks.bench_representations`.

All contenders of a task see the same data in one run and on one thread, taking turns; figures are
medians of CPU time in ms. The number behind is what must agree, or an error where methods differ.
Our k-d tree is written to be read, step by step, and is timed for that alone: whoever only wants
the nearest point takes scipy's. Distances to a mesh go through scipy's tree of middles of faces and
then through numpy, face by face of the few that can be nearest: igl walks a compiled tree of boxes,
and would be a dependency for one form of one lesson, whose default is a shape with a distance in
closed form.
"""

# ruff: noqa: E402 (the number of threads is set before numpy starts them)
import os

for _name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ.setdefault(_name, "1")

import argparse
import warnings
from types import ModuleType

import numpy as np
import scipy

from tests.benchmarks.bench_curvature import Contender, compare, peer
from workbench.algorithms.learning.neural_field import BATCH, encoded, new_network, train_field
from workbench.algorithms.spatial.kd_tree import build_tree, looked_at
from workbench.data.shapes.rabbit import rabbit_mesh
from workbench.geometry.fields.signed_distances import face_tree, mesh_sdf, torus_sdf
from workbench.geometry.fields.voxels import Grid
from workbench.geometry.level_sets import level_surface
from workbench.geometry.meshes.measures import signed_volume
from workbench.geometry.shapes.bezier import bezier_patch

FLOORS = {"network": 0.5, "patch": 0.02}


def main(rounds: int = 3) -> None:
    """Print one table per task."""
    compare(
        "1,500 iterations of 512, 3-32-32-1 with 2 octaves; mean error, m",
        networks(),
        None,
        floor=FLOORS["network"],
        repeats=rounds,
    )
    compare(
        "25 iterations and the level set of 28³: one step of the lesson",
        steps(),
        None,
        floor=None,
        repeats=rounds,
    )
    compare(
        "100 x 100 points of a bicubic patch",
        patches(peer("geomdl.BSpline")),
        None,
        floor=FLOORS["patch"],
        repeats=rounds,
    )
    compare(
        "32³ distances of a torus and their level set; volume",
        level_sets(),
        None,
        floor=None,
        repeats=rounds,
    )
    compare(
        "Signed distances of 4,000 points to 5,684 faces",
        distances(peer("igl")),
        None,
        floor=None,
        repeats=rounds,
    )
    compare("Nearest of 4,000 points for 100 queries", searches(), None, floor=None, repeats=rounds)


def samples() -> tuple[np.ndarray, np.ndarray]:
    """Return points around a torus, with their distances."""
    rng = np.random.default_rng(0)
    p = rng.uniform(-1, 1, (15_000, 3))
    return p, torus_sdf(p, 0.6, 0.25)


def networks() -> dict[str, Contender]:
    """Return who trains a network; the mean error at samples tells how well."""
    p, y = samples()

    def ours() -> float:
        rng = np.random.default_rng(1)
        *_, last = train_field(
            new_network(32, 2, "tanh", rng=rng),
            p,
            y.__getitem__,
            counts=(1500,),
            target="sdf",
            rng=rng,
        )
        return float(np.abs(last.network(p) - y).mean())

    contenders: dict[str, Contender] = {"ours": ours}
    learning = peer("sklearn.neural_network")
    if learning is not None:
        x = encoded(p, 2)

        def theirs() -> float:
            regressor = learning.MLPRegressor(
                hidden_layer_sizes=(32, 32),
                activation="tanh",
                batch_size=BATCH,
                learning_rate_init=5e-3,
                max_iter=1500 * BATCH // len(x),
                random_state=1,
                n_iter_no_change=1000,
            )
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")  # it did not converge, as was asked for
                regressor.fit(x, y.astype(np.float32))
            return float(np.abs(regressor.predict(x) - y).mean())

        contenders["sklearn MLPRegressor"] = theirs
    return contenders


def steps() -> dict[str, Contender]:
    """Return what a step of the lesson costs before it is drawn."""
    p, y = samples()
    grid = Grid(np.full(3, -1.0), np.full(3, 2 / 28), (28, 28, 28))
    corners = grid.centres()

    def ours() -> float:
        rng = np.random.default_rng(1)
        *_, last = train_field(
            new_network(32, 2, "tanh", rng=rng),
            p,
            y.__getitem__,
            counts=(25,),
            target="sdf",
            rng=rng,
        )
        return float(len(level_surface(last.network(corners).reshape(grid.shape), grid)[0]))

    return {"ours": ours}


def patches(geomdl: ModuleType | None) -> dict[str, Contender]:
    """Return who evaluates a patch; the sum of all coordinates must agree."""
    control = np.random.default_rng(2).normal(size=(4, 4, 3))
    ends = np.linspace(0, 1, 100)
    uv = np.stack(np.meshgrid(ends, ends, indexing="ij"), axis=-1).reshape(-1, 2)
    contenders: dict[str, Contender] = {"ours": lambda: float(bezier_patch(control, uv).sum())}
    if geomdl is not None:

        def theirs() -> float:
            surface = geomdl.Surface()
            surface.degree_u = surface.degree_v = 3
            surface.ctrlpts2d = control.tolist()
            surface.knotvector_u = surface.knotvector_v = [0, 0, 0, 0, 1, 1, 1, 1]
            surface.sample_size = 100
            return float(np.sum(surface.evalpts))

        contenders["geomdl"] = theirs
    return contenders


def level_sets() -> dict[str, Contender]:
    """Return who marches a grid; the volumes must agree."""
    grid = Grid(np.full(3, -1.0), np.full(3, 2 / 32), (32, 32, 32))

    def values() -> np.ndarray:
        return torus_sdf(grid.centres(), 0.6, 0.25).reshape(grid.shape)

    def theirs() -> float:
        from skimage.measure import marching_cubes

        p, faces, _, _ = marching_cubes(values(), 0.0, spacing=(2 / 32,) * 3)
        return signed_volume(p.astype(float), faces.astype(np.int64))

    return {"ours": lambda: signed_volume(*level_surface(values(), grid)), "skimage alone": theirs}


def distances(igl: ModuleType | None) -> dict[str, Contender]:
    """Return who measures to a mesh; the sum must agree."""
    p, faces = rabbit_mesh(0.03)
    q = np.random.default_rng(3).uniform(-0.6, 0.6, (4000, 3))
    contenders: dict[str, Contender] = {
        "ours": lambda: float(mesh_sdf(face_tree(p, faces, closed=True), q).sum())
    }
    if igl is not None:
        contenders["igl signed_distance"] = lambda: float(
            np.sum(igl.signed_distance(q, p, faces)[0])
        )
    return contenders


def searches() -> dict[str, Contender]:
    """Return who finds nearest points, ours counting what it looks at: its number is that."""
    rng = np.random.default_rng(4)
    p, q = rng.random((4000, 3)), rng.random((100, 3))
    return {
        "ours, step by step": lambda: float(
            looked_at(build_tree(p, np.zeros(3), np.ones(3)), q).mean()
        ),
        "scipy cKDTree (distance)": lambda: float(np.mean(scipy.spatial.cKDTree(p).query(q)[0])),
    }


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rounds", type=int, default=3)
    main(parser.parse_args().rounds)
