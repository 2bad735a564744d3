"""What each stage computes, by the functions in the slots."""

import functools
from collections.abc import Callable, Iterator
from dataclasses import replace

import numpy as np

from lessons.distances.plane import axioms, balls, stereo, whiten
from lessons.distances.slots import Functions
from lessons.distances.state import Found, Front, Now, Params, Subject
from lessons.distances.subjects import reference, subject_of, ways_in_square
from workbench.algorithms.surfaces.fast_marching import Update, eikonal_update, march
from workbench.algorithms.surfaces.heat_method import HeatMethod, directions_of, heat_method
from workbench.data.shapes import surfaces
from workbench.errors import InputError
from workbench.geometry.meshes import Corners, corners, geodesics
from workbench.geometry.meshes.intrinsic import intrinsic_delaunay
from workbench.geometry.meshes.laplacian import negative_weights
from workbench.tracing import traced, untraced

BANDS = 10
NEAR = 0.14  # of the largest true distance: nearer than this a relative error says little
# of the studies: nodes along a side, on a sphere
SIDES = (11, 21, 41, 81, 161)
VERTICES = (42, 162, 642, 2562)
EXTRA = 3
TIMES = np.arange(-2.0, 3.1, 0.5)
PAIRS = 24  # sources between which heat distances are held against each other


def grid(params: Params, functions: Functions) -> Iterator[tuple[Subject, Now]]:
    """Yield a front that goes round the wall, and how far off its distances are."""
    subject = subject_of(params)
    if params.neighbours == "march":
        d = np.empty(0)
        steps = _marched(params, subject, functions.eikonal_update)
        for front in steps:
            d = front.d
            yield subject, front
        edges, lengths = ways_in_square(params.grid, params.wall, 8)
        path = _path(subject, edges, lengths, d=d)
    else:
        edges, lengths = ways_in_square(params.grid, params.wall, int(params.neighbours))
        d = distances_by(functions, edges, lengths, count=len(subject.p), source=subject.source)
        for front in spread(edges, lengths, d):
            yield subject, front
        path = _path(subject, edges, lengths, d=d)
    distances = _found(subject, d, path)
    if params.neighbours == "march":
        distances = replace(distances, eight=_by_eight(params, subject))
    yield subject, distances
    yield subject, replace(distances, study=finer_grids())


def _by_eight(params: Params, subject: Subject) -> float:
    """Return the worst relative error of ways to 8 neighbours on the same grid."""
    edges, lengths = ways_in_square(params.grid, params.wall, 8)
    d = geodesics.shortest_distances(edges, lengths, len(subject.p), subject.source)
    return _found(subject, d, np.empty(0, int)).worst


def surface(params: Params, functions: Functions) -> Iterator[tuple[Subject, Now]]:
    """Yield distances over a mesh, along its edges or by heat, and how far off they are."""
    subject = subject_of(params)
    if params.method == "heat":
        shown = corners(subject.p, subject.faces)
        measured = intrinsic_delaunay(subject.p, subject.faces) if params.delaunay else shown
        time = 10.0**params.time * subject.h**2
        d = np.empty(0)
        for heat in heat_method(measured, subject.source, time):
            d = heat.d
            yield subject, replace(heat, X=directions_of(shown, heat.u)) if len(heat.X) else heat
        distances = replace(
            _found(subject, d, np.empty(0, int)), negative=negative_weights(measured)
        )
        yield subject, distances
        asymmetry, broken = _as_a_metric(HeatMethod(measured, time))
        distances = replace(
            distances, asymmetry=asymmetry, broken=broken, times=_over_time(subject, measured)
        )
    else:
        nodes, edges, lengths = geodesics.with_points_on_edges(
            subject.p, subject.faces, params.extra
        )
        d = distances_by(functions, edges, lengths, count=len(nodes), source=subject.source)
        for front in spread(edges, lengths, d, shown=len(subject.p)):
            yield subject, front
        distances = _found(subject, d[: len(subject.p)], np.empty(0, int))
        goal = (
            int(np.nanargmax(np.abs(distances.error)))
            if np.isfinite(distances.error).any()
            else subject.source
        )
        way = geodesics.shortest_path(edges, lengths, d, goal=goal)
        distances = replace(distances, path=nodes[way])
        yield subject, distances
    if params.shape == "sphere" and subject.is_sphere:
        distances = replace(distances, study=finer_spheres(params.jitter))
    if distances.study or distances.times is not None:
        yield subject, distances


def roll(params: Params, functions: Functions) -> Iterator[tuple[Subject, Now]]:
    """Yield distances along a graph of neighbours, beside those on the unrolled sheet."""
    subject = subject_of(params)
    d = distances_by(
        functions, subject.edges, subject.lengths, count=len(subject.p), source=subject.source
    )
    for front in spread(subject.edges, subject.lengths, d):
        yield subject, front
    yield subject, _found(subject, d, _path(subject, subject.edges, subject.lengths, d=d))


def distances_by(
    functions: Functions, edges: np.ndarray, lengths: np.ndarray, *, count: int, source: int
) -> np.ndarray:
    """Return the distances by the function in the slot.

    Raises:
        InputError: If they are no distances.
    """
    d = np.asarray(functions.shortest_distances(edges, lengths, count, source), float)
    if np.isnan(d).any() or (d < 0).any():
        raise InputError("shortest_distances returned values that are no distances")
    return d


@traced
def spread(
    edges: np.ndarray, lengths: np.ndarray, d: np.ndarray, *, shown: int | None = None
) -> Iterator[Front]:
    """Yield how Dijkstra's front grows: nodes are accepted in the order of their distance, their
    neighbours are on trial.
    """
    farthest = float(np.max(d, where=np.isfinite(d), initial=0.0))
    for reach in np.linspace(0.0, farthest, BANDS + 1) if farthest > 0 else (0.0,):
        accepted = d <= reach + 1e-12 * farthest
        tentative = np.where(accepted, d, np.inf)
        for here, neighbours in (edges.T, edges.T[::-1]):
            leaves = accepted[here] & ~accepted[neighbours]
            np.minimum.at(tentative, neighbours[leaves], d[here[leaves]] + lengths[leaves])
        yield Front(d=tentative[:shown], accepted=accepted[:shown], reach=float(reach))


def _marched(params: Params, subject: Subject, update: Update) -> Iterator[Front]:
    """Yield fast marching's fronts."""
    shape = (subject.side, subject.side)
    start = np.where(
        np.linalg.norm(subject.p - subject.p[subject.source], axis=1) <= params.disc,
        subject.truth,
        np.inf,
    )
    start[~subject.free] = np.inf
    start[subject.source] = 0.0
    band = float(subject.truth[subject.free].max()) / BANDS
    for front in march(
        start.reshape(shape), subject.free.reshape(shape), subject.h, band=band, update=update
    ):
        yield Front(d=front.d.ravel(), accepted=front.accepted.ravel(), reach=front.reach)


def _path(subject: Subject, edges: np.ndarray, lengths: np.ndarray, *, d: np.ndarray) -> np.ndarray:
    return subject.p[geodesics.shortest_path(edges, lengths, d, goal=subject.goal)]


def _found(subject: Subject, d: np.ndarray, path: np.ndarray) -> Found:
    truth = reference(subject)
    if not len(truth):
        return Found(d=d, path=path, error=np.full(len(d), np.nan), truth=truth)
    return Found(d=d, path=path, error=relative(d, truth), truth=truth)


def relative(d: np.ndarray, truth: np.ndarray) -> np.ndarray:
    """Return the relative error of distances; NaN near the source, out of reach and where the truth
    is not known.
    """
    known = (
        np.isfinite(d)
        & np.isfinite(truth)
        & (truth > NEAR * np.max(truth, where=np.isfinite(truth), initial=0.0))
    )
    return np.divide(d, truth, out=np.full(len(d), np.nan), where=known) - 1


def _as_a_metric(method: HeatMethod) -> tuple[np.ndarray, float]:
    """Return the asymmetry of heat distances between some vertices, and the share of triples that
    break the triangle.
    """
    chosen = np.unique(np.linspace(0, method.measured.count - 1, PAIRS).astype(int))
    D = method.between(chosen)
    i, j = np.triu_indices(len(chosen), 1)
    over = D[:, :, None] + D[None, :, :]  # a to b to c
    excess = D[:, None, :] - over
    n = len(chosen)
    apart = np.array(
        [len({a, b, c}) == 3 for a in range(n) for b in range(n) for c in range(n)]
    ).reshape(n, n, n)
    return np.abs(D - D.T)[i, j] / np.maximum(np.abs(D), np.abs(D.T))[i, j], float(
        (excess > 1e-9)[apart].mean()
    )


def _over_time(subject: Subject, measured: Corners) -> tuple[np.ndarray, np.ndarray]:
    """Return the mean size of the error of heat for each time, per cent."""
    truth = reference(subject)
    errors = []
    for time in TIMES:
        *_, last = heat_method(measured, subject.source, 10.0**time * subject.h**2)
        errors.append(100 * float(np.nanmean(np.abs(relative(last.d, truth)))))
    return TIMES, np.array(errors)


@functools.cache
@untraced()
def finer_grids() -> dict[str, tuple[np.ndarray, np.ndarray]]:
    """Return by method the worst error (%) of distances from a corner over the unit square, over
    the spacing (m).
    """
    errors: dict[str, list[float]] = {}
    for side in SIDES:
        x = np.linspace(0.0, 1.0, side)
        p = np.stack(np.meshgrid(x, x, indexing="ij"), axis=-1).reshape(-1, 2)
        truth = np.linalg.norm(p, axis=1)
        h = 1 / (side - 1)
        for neighbours in (4, 8, 16):
            edges = geodesics.grid_edges(side, neighbours)
            d = geodesics.shortest_distances(edges, geodesics.edge_lengths(p, edges), len(p), 0)
            errors.setdefault(f"{neighbours} neighbours", []).append(_worst(d, truth))
        for name, disc in (("marching", 0.0), ("marching, exact disc", 0.1)):
            start = np.where(truth <= disc, truth, np.inf).reshape(side, side)
            *_, last = march(start, np.ones((side, side), bool), h, band=0.2, update=eikonal_update)
            errors.setdefault(name, []).append(_worst(last.d.ravel(), truth))
    return _log(1 / (np.array(SIDES) - 1.0), errors)


@functools.cache
@untraced()
def finer_spheres(jitter: float = 0.0) -> dict[str, tuple[np.ndarray, np.ndarray]]:
    """Return by method the worst error (%) of distances over the unit sphere, over the mean length
    of its edges (m).

    Args:
        jitter: By how much of a cell vertices are moved.
    """
    errors: dict[str, list[float]] = {}
    spacing = []
    for count in VERTICES:
        ball = surfaces.sphere(count, jitter=jitter, rng=np.random.default_rng(0))
        truth = np.arccos(np.clip(ball.p @ ball.p[0], -1, 1))
        for name, extra in (("edges", 0), (f"{EXTRA} points on each edge", EXTRA)):
            nodes, edges, lengths = geodesics.with_points_on_edges(ball.p, ball.faces, extra)
            d = geodesics.shortest_distances(edges, lengths, len(nodes), 0)[: len(ball.p)]
            errors.setdefault(name, []).append(_worst(d, truth))
            if extra == 0:
                spacing.append(float(lengths.mean()))
        *_, last = heat_method(corners(ball.p, ball.faces), 0, spacing[-1] ** 2)
        errors.setdefault("heat", []).append(_worst(last.d, truth))
    return _log(np.array(spacing), errors)


def _worst(d: np.ndarray, truth: np.ndarray) -> float:
    return 100 * float(np.nanmax(np.abs(relative(d, truth))))


def _log(
    spacing: np.ndarray, errors: dict[str, list[float]]
) -> dict[str, tuple[np.ndarray, np.ndarray]]:
    return {
        name: (np.log10(spacing), np.log10(np.array(values))) for name, values in errors.items()
    }


STAGES: dict[str, Callable[[Params, Functions], Iterator[tuple[Subject | None, Now]]]] = {
    "balls": balls,
    "axioms": axioms,
    "whiten": whiten,
    "stereo": stereo,
    "grid": grid,
    "surface": surface,
    "roll": roll,
}
