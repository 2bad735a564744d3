"""The tasks: their data, their training, and how each state is held against the truth."""

import functools
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from lessons.learning import flatland
from lessons.learning.labelled_shapes import NAMES, labelled_clouds
from lessons.learning.state import Clouds, Looks, Now, Params, State, Target, Task, Turns
from workbench.algorithms.learning.mesh_fitting import Term, fit_mesh
from workbench.algorithms.learning.point_net import train_classifier
from workbench.algorithms.learning.radiance_field import CELLS, SAMPLES, RadianceField, reconstruct
from workbench.algorithms.learning.rotation_regression import regress
from workbench.algorithms.learning.set_regression import ChamferGradient, learn_set
from workbench.data.files import stamp
from workbench.data.framing import Upward, own_points
from workbench.data.own_meshes import read_welded
from workbench.data.shapes import surfaces
from workbench.data.shapes.rabbit import rabbit, rabbit_mesh
from workbench.geometry.cameras.volume_rendering import RayWeights, samples_on
from workbench.geometry.motions.rotation_outputs import IN_PLANE, IN_SPACE, Decode, random_rotations
from workbench.geometry.points.sampling import points_on_faces

UPDATES: Mapping[Task, int] = {
    "angle": 600,
    "rotation": 1500,
    "sets": 150,
    "mesh": 80,
    "classify": 300,
    "field": 225,
}
STEPS = 16
# numbers in a hidden layer, first step of Adam
NETWORKS = {"angle": (32, 4e-3), "rotation": (64, 1.2e-2)}
TURNS, SET, CLOUD, TESTS, PIXELS = 181, 48, 32, 20, 64
RADII = (0.5, 1.5)  # of the circles that a set of points is shown, m
# of meshes: vertices, points given and of the truth, radius (m)
VERTICES = 642
GIVEN = 1200
TRUE = 3000
START = 0.6
MOST_OWN = 200_000
OWN_SIZE = 1.2
# radians off the cameras; how many; density that counts as matter, 1/m
NEW_VIEW = 0.13
NEW_VIEWS = 12
DENSE = 5.0


@dataclass(frozen=True, eq=False)
class Functions:
    """What students can replace."""

    rotation_from_six: Decode
    chamfer_gradient: ChamferGradient
    ray_weights: RayWeights


def counts_of(params: Params) -> tuple[int, ...]:
    """Return after how many updates there is a step: closer together at the start."""
    updates = params.updates or UPDATES[params.task]
    return tuple(
        np.unique(np.rint(updates * np.linspace(0, 1, STEPS + 1) ** 1.5).astype(int)).tolist()
    )


def steps(params: Params, functions: Functions) -> Iterator[State]:
    """Yield the steps of the task."""
    rng = np.random.default_rng(params.seed)
    end = counts_of(params)[-1]
    for about, fit in TASKS[params.task](params, functions, rng):
        yield State(params=params, about=about, now=fit, last=fit.updates == end)


def _turns(
    params: Params, functions: Functions, rng: np.random.Generator
) -> Iterator[tuple[Turns, Now]]:
    largest = np.radians(params.largest)
    if params.task == "angle":
        representation = IN_PLANE[params.angle]
        a = np.linspace(-largest, largest, TURNS)
        R_test = IN_PLANE["one number"].decode(a[:, None])
        about = Turns(np.column_stack([np.cos(a), np.sin(a), 0 * a]), np.degrees(a))
    else:
        representation = IN_SPACE[params.rotation]
        if params.rotation == "6D":
            representation = replace(representation, decode=functions.rotation_from_six)
        R_test, w = random_rotations(
            3 * TURNS, 3, largest, rng=np.random.default_rng(1000 + params.seed)
        )
        about = Turns(w / np.pi, np.degrees(np.linalg.norm(w, axis=1)))
    width, rate = NETWORKS[params.task]
    for fit in regress(
        representation,
        R_test,
        largest=largest,
        compared=params.loss,
        width=width,
        rate=rate,
        counts=counts_of(params),
        rng=rng,
    ):
        yield about, fit


def circle_of(radius: float, turn: float) -> np.ndarray:
    """Return evenly spaced points of a circle in the plane, the first of them turned so far."""
    a = turn + np.linspace(0, 2 * np.pi, SET, endpoint=False)
    return radius * np.column_stack([np.cos(a), np.sin(a), 0 * a])


def _sets(
    params: Params, functions: Functions, rng: np.random.Generator
) -> Iterator[tuple[None, Now]]:
    start = circle_of(1.0, 0.0) * (1 + 0.1 * rng.normal(size=(SET, 1)))
    for learned in learn_set(
        start,
        lambda: circle_of(rng.uniform(*RADII), rng.uniform(0, 2 * np.pi)),
        set_loss=params.set_loss,
        counts=counts_of(params),
        chamfer_gradient=functions.chamfer_gradient,
    ):
        yield None, learned


def _mesh(
    params: Params, functions: Functions, rng: np.random.Generator
) -> Iterator[tuple[Target, Now]]:
    ball = surfaces.sphere(VERTICES)
    name = "the rabbit" if params.scan is None else params.scan.name
    given, truth, p_true, faces_true = _surface(
        params.scan, params.scan and stamp(params.scan), params.up, seed=params.seed
    )
    given = given + params.noise * rng.normal(size=given.shape)
    target = Target(ball.faces, given, p_true, faces_true, name)
    weights: dict[Term, float] = {
        "laplacian": params.laplacian,
        "normal": params.normal,
        "edge": params.edge,
    }
    for fitted in fit_mesh(
        START * ball.p,
        ball.faces,
        given,
        truth=truth,
        weights=weights,
        counts=counts_of(params),
        rng=rng,
        chamfer_gradient=functions.chamfer_gradient,
    ):
        yield target, fitted


@functools.lru_cache(maxsize=4)
def _surface(
    scan: Path | None, _stamp: tuple[int, int] | None, up: Upward, *, seed: int
) -> tuple[np.ndarray, ...]:
    """Return points of the surface to be fitted, more of them, and its mesh: cached, as most knobs
    leave them alone.
    """
    rng = np.random.default_rng(1000 + seed)
    if scan is None:
        return rabbit(GIVEN, rng), rabbit(TRUE, rng), *rabbit_mesh()
    p, faces = read_welded(scan, MOST_OWN, "fitted")
    p = own_points(p, scan, up, width=OWN_SIZE)
    given, truth = (points_on_faces(p, faces, rng.random((count, 3))) for count in (GIVEN, TRUE))
    return given, truth, p, faces


def _classify(
    params: Params, functions: Functions, rng: np.random.Generator
) -> Iterator[tuple[Clouds, Now]]:
    def draw(count: int) -> tuple[np.ndarray, np.ndarray]:
        of = rng.integers(len(NAMES), size=count)
        return labelled_clouds(of, CLOUD, params.trained, rng=rng), of

    chance = np.random.default_rng(1000 + params.seed)
    of = np.tile(np.arange(len(NAMES)), TESTS)
    plain = labelled_clouds(of, CLOUD, params.trained, rng=chance)
    changed = (
        plain
        if params.turned == params.trained
        else labelled_clouds(of, CLOUD, params.turned, rng=chance)
    )
    changed = changed.copy()
    if any(params.stray):
        changed[:, 0] = params.stray
    if params.shuffled:
        changed = np.stack([cloud[chance.permutation(CLOUD)] for cloud in changed])
    tests = {"plain": plain, "changed": changed}
    about = Clouds(plain, changed, of)
    for classified in train_classifier(
        params.pool, draw, tests, classes=len(NAMES), counts=counts_of(params), rng=rng
    ):
        yield about, classified


def _field(
    params: Params, functions: Functions, rng: np.random.Generator
) -> Iterator[tuple[Looks, Now]]:
    angles = np.linspace(0, 2 * np.pi, params.views, endpoint=False)
    p, d, colors = photographs(angles)
    new = np.linspace(0, 2 * np.pi, NEW_VIEWS, endpoint=False) + NEW_VIEW
    for rebuilt in reconstruct(
        p,
        d,
        colors,
        reach=flatland.REACH,
        counts=counts_of(params),
        rng=rng,
        ray_weights=functions.ray_weights,
    ):
        yield (
            _looks(
                params, functions, rebuilt.field, trained=(p, d, colors), angles=angles, new=new
            ),
            rebuilt,
        )


def photographs(angles: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return where the rays of cameras begin, their directions, and what they see."""
    rays = [flatland.rays_of(float(angle), PIXELS) for angle in angles]
    seen = [flatland.photograph(float(angle), PIXELS) for angle in angles]
    return (
        np.concatenate([p for p, _ in rays]),
        np.concatenate([d for _, d in rays]),
        np.concatenate(seen),
    )


def _looks(
    params: Params,
    functions: Functions,
    field: RadianceField,
    *,
    trained: tuple,
    angles: np.ndarray,
    new: np.ndarray,
) -> Looks:
    p, d, colors = photographs(new)
    _, rendered = field.along(p, d, functions.ray_weights)
    own = field.along(trained[0], trained[1], functions.ray_weights)[1]
    k = params.picked % PIXELS
    weights = field.along(p[[k]], d[[k]], functions.ray_weights)[0][0]
    q, spacing = samples_on(p[[k]], d[[k]], flatland.REACH, count=SAMPLES)
    true_weights = functions.ray_weights(flatland.medium(q)[0], spacing)[0]
    nodes = np.linspace(-1, 1, CELLS)
    full = flatland.medium(np.stack(np.meshgrid(nodes, nodes, indexing="ij"), axis=-1))[0] > 0
    dense = field.density > DENSE
    return Looks(
        trained=signal(own, trained[2]),
        unseen=signal(rendered, colors),
        overlap=float((dense & full).sum() / (dense | full).sum()),
        image=rendered[:PIXELS],
        truth=colors[:PIXELS],
        angles=np.append(angles, NEW_VIEW),
        ray=np.stack([q[0, 0], q[0, -1]]),
        along=np.linalg.norm(q[0] - p[k], axis=1),
        weights=weights,
        true_weights=true_weights,
    )


def signal(image: np.ndarray, truth: np.ndarray) -> float:
    """Return the peak signal-to-noise ratio, dB, of colours from 0 to 1."""
    return float(-10 * np.log10(max(((image - truth) ** 2).mean(), 1e-12)))


TASKS: dict[Task, Callable[[Params, Functions, np.random.Generator], Iterator[tuple]]] = {
    "angle": _turns,
    "rotation": _turns,
    "sets": _sets,
    "mesh": _mesh,
    "classify": _classify,
    "field": _field,
}
