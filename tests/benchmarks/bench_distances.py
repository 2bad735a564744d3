"""Shortest ways, fast marching, heat and Mahalanobis beside their peers: `python -m
tests.benchmarks.bench_distances`.

All contenders of a task see the same grid, mesh or points in one run and on one thread, taking
turns; figures are medians of CPU milliseconds. The number behind is what must agree: a distance, or
a sum of distances. Floors are ratios to the best peer that a prototype reached. scikit-fmm marches
node by node with a heap in C++; ours accepts bands of nodes with numpy and calls the student's
update for all nodes of a band at once, which a heap could not. Its floor are the calls that no
round can spare, on as many nodes: each neighbour once, the neighbours' distances, the update, which
of them fall, and the new distances. Scipy's graph is given once
and asked often; ours is made at every call, as the exercise's contract has it. Exact geodesics by
igl are faster than our graph of points on edges, which serves as the truth of surfaces without a
formula.
"""

# ruff: noqa: E402 (the number of threads is set before numpy starts them)
import os

for _name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ.setdefault(_name, "1")

from types import ModuleType

import numpy as np
import scipy

from tests.benchmarks.bench_curvature import Contender, compare, peer
from workbench.algorithms.surfaces.fast_marching import eikonal_update, march
from workbench.algorithms.surfaces.heat_method import HeatMethod, mean_edge_length
from workbench.data.shapes import surfaces
from workbench.geometry.meshes import corners, geodesics
from workbench.geometry.points import metrics

FLOORS = {"dijkstra": 1.3, "heat": 1.3, "mahalanobis": 0.13}
SIDE = 81
BARE = "its rounds' bare calls"


def main() -> None:
    """Print one table per task."""
    networkx = peer("networkx")
    fmm = peer("skfmm")
    potpourri = peer("potpourri3d")
    igl = peer("igl")
    x = np.linspace(0.0, 1.0, SIDE)
    p = np.stack(np.meshgrid(x, x, indexing="ij"), axis=-1).reshape(-1, 2)
    compare(
        "Dijkstra, 81 x 81 nodes, 8 neighbours",
        ways(p, networkx),
        None,
        floor=FLOORS["dijkstra"],
        repeats=5,
    )
    fast_marching(x, fmm)
    ball = surfaces.sphere(2562)
    compare(
        "Distance by heat, 2,562 vertices",
        heats(ball.p, ball.faces, potpourri, igl=igl),
        None,
        floor=FLOORS["heat"],
        repeats=5,
    )
    compare(
        "Exact geodesics beside points on edges, 642 vertices",
        exact(igl),
        None,
        floor=None,
        repeats=3,
    )
    compare(
        "Mahalanobis, 2,000 x 2,000 points in 10 dimensions",
        whitened(),
        None,
        floor=FLOORS["mahalanobis"],
        repeats=3,
    )


def ways(p: np.ndarray, networkx: ModuleType | None) -> dict[str, Contender]:
    """Return who finds all shortest ways from a corner; the sum of the distances must agree."""
    edges = geodesics.grid_edges(SIDE, 8)
    lengths = geodesics.edge_lengths(p, edges)
    graph = scipy.sparse.csr_array((lengths, tuple(edges.T)), shape=(len(p), len(p)))
    contenders: dict[str, Contender] = {
        "ours, graph made": lambda: float(
            geodesics.shortest_distances(edges, lengths, len(p), 0).sum()
        ),
        "scipy, graph made": lambda: float(
            scipy.sparse.csgraph.dijkstra(
                scipy.sparse.csr_array((lengths, tuple(edges.T)), shape=(len(p), len(p))),
                directed=False,
                indices=np.array([0]),
            ).sum()
        ),
        "scipy, graph given": lambda: float(
            scipy.sparse.csgraph.dijkstra(graph, directed=False, indices=np.array([0])).sum()
        ),
    }
    if networkx is not None:
        given = networkx.from_scipy_sparse_array(graph)
        contenders["networkx, graph given"] = lambda: float(
            sum(networkx.single_source_dijkstra_path_length(given, 0).values())
        )
    return contenders


def fast_marching(x: np.ndarray, fmm: ModuleType | None) -> None:
    """Compare who marches, and print what the rounds of ours need at least."""
    medians = compare(
        f"Fast marching, {SIDE} x {SIDE}, from an exact disc",
        marches(x, fmm),
        None,
        floor=None,
        repeats=9,
    )
    if "scikit-fmm, first order" in medians:
        floor = medians[BARE] / min(spent for name, spent in medians.items() if "fmm" in name)
        print(
            f"  floor {floor:.1f}: a round on some hundred nodes needs two dozen calls of numpy,"
            " where a heap in C++ goes from node to node"
        )


def marches(x: np.ndarray, fmm: ModuleType | None) -> dict[str, Contender]:
    """Return who marches from a disc of radius 0.1 about a corner; the distance of the far corner
    must be near.
    """
    true = np.hypot(*np.meshgrid(x, x, indexing="ij"))
    h = float(x[1])
    start = np.where(true <= 0.1, true, np.inf)
    free = np.ones((SIDE, SIDE), bool)

    def ours() -> float:
        *_, last = march(start, free, h, band=0.1)
        return float(last.d[-1, -1])

    contenders: dict[str, Contender] = {
        "ours, first order": ours,
        BARE: bare_rounds(start, free, h),
    }
    if fmm is not None:
        contenders["scikit-fmm, first order"] = lambda: float(
            fmm.distance(true - 0.1, dx=h, order=1)[-1, -1] + 0.1
        )
        contenders["scikit-fmm, second order"] = lambda: float(
            fmm.distance(true - 0.1, dx=h)[-1, -1] + 0.1
        )
    return contenders


def bare_rounds(start: np.ndarray, free: np.ndarray, h: float) -> Contender:
    """Return what does, of each round of our march, the calls that it cannot spare, on as many
    nodes.
    """
    sizes: list[int] = []

    def counted(a: np.ndarray, b: np.ndarray, h: float) -> np.ndarray:
        sizes.append(len(a))
        return eikonal_update(a, b, h)

    for _ in march(start, free, h, band=0.1, update=counted):
        pass
    flat = np.full(start.size, 0.5)
    asked = np.zeros(start.size, bool)
    shifts = (0, 2 * SIDE, SIDE - 1, SIDE + 1)
    steps = np.array(shifts)[:, None]
    own = flat[SIDE:]
    beside = [flat[shift:] for shift in shifts]
    inside = np.arange(flat.size - 2 * SIDE - 1)
    places = [inside[:: max(1, len(inside) // size)][:size] for size in sizes]

    def bare() -> float:
        for at in places:
            asked[steps + at[::2]] = True
            asked.nonzero()
            asked.fill(False)
            left, right, below, above = (distances.take(at) for distances in beside)
            updated = eikonal_update(np.minimum(left, right), np.minimum(below, above), h)
            falls = updated < own.take(at)
            own[at.compress(falls)] = updated.compress(falls)
        return float("nan")

    return bare


def heats(
    p: np.ndarray, faces: np.ndarray, potpourri: ModuleType | None, *, igl: ModuleType | None
) -> dict[str, Contender]:
    """Return who factors and solves once; the largest distance, pi in truth, must be near."""
    time = mean_edge_length(p, faces) ** 2

    def ours() -> float:
        method = HeatMethod(corners(p, faces), time)
        u = method.heat(np.array([0]))[:, 0]
        return float(method.distances(method.directions(u), 0).max())

    contenders: dict[str, Contender] = {"ours": ours}
    if potpourri is not None:
        contenders["potpourri3d"] = lambda: float(
            potpourri.MeshHeatMethodDistanceSolver(p, faces).compute_distance(0).max()
        )
    if igl is not None and hasattr(igl, "HeatGeodesicsData"):

        def theirs() -> float:
            made = igl.HeatGeodesicsData()
            igl.heat_geodesics_precompute(p, faces, made)
            return float(np.max(igl.heat_geodesics_solve(made, np.array([0]))))

        contenders["igl"] = theirs
    return contenders


def exact(igl: ModuleType | None) -> dict[str, Contender]:
    """Return who comes near the exact geodesics of a mesh; the sum of the distances must be
    near.
    """
    ball = surfaces.sphere(642)

    def ours() -> float:
        nodes, edges, lengths = geodesics.with_points_on_edges(ball.p, ball.faces, 4)
        return float(
            geodesics.shortest_distances(edges, lengths, len(nodes), 0)[: len(ball.p)].sum()
        )

    contenders: dict[str, Contender] = {"ours, 4 points on each edge": ours}
    if igl is not None:
        none = np.array([], dtype=np.int64)
        every = np.arange(len(ball.p))
        faces = ball.faces.astype(np.int64)
        contenders["igl, exact"] = lambda: float(
            np.sum(igl.exact_geodesic(ball.p, faces, np.array([0]), none, every, none))
        )
    return contenders


def whitened() -> dict[str, Contender]:
    """Return who finds all distances between two clouds; their sum must agree."""
    rng = np.random.default_rng(0)
    a, b = rng.normal(size=(2, 2000, 10))
    A = rng.normal(size=(10, 10))
    C = A @ A.T + np.eye(10)
    cdist = scipy.spatial.distance.cdist
    inverse = np.linalg.inv(C)

    def ours() -> float:
        W = metrics.whitening(C)
        return float(cdist(a @ W.T, b @ W.T).sum())

    return {
        "ours, whitened": ours,
        "scipy, mahalanobis": lambda: float(cdist(a, b, "mahalanobis", VI=inverse).sum()),
    }


if __name__ == "__main__":
    main()
