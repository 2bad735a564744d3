"""Iterative closest point: match each source point to the nearest target point, fit, repeat.

`p_target` and moved points are in the target frame, `p_source` in the source frame, metres.

References: Besl and McKay, A method for registration of 3-D shapes, 1992, section IV.B (the loop,
steps a-d); Chen and Medioni, Object modelling by registration of multiple range images, 1992 (point
to plane); Chetverikov, Svirko, Stepanov and Krsek, The trimmed iterative closest point algorithm,
2002 (keeping a fraction).
"""

import functools
import zlib
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from enum import Enum
from typing import Literal

import numpy as np
import scipy
from jaxtyping import Bool, Float, Int

from workbench.geometry.motions import apply
from workbench.geometry.motions.alignment import align_rigid, point_to_plane_step
from workbench.geometry.points.metrics import rms
from workbench.geometry.points.nearest import check_clouds, tree_of
from workbench.tracing import traced

Match = Callable[[np.ndarray, np.ndarray], np.ndarray]
"""match(p_target, p_source) -> for each source point, the index of its partner; both in the target
frame.
"""
Align = Callable[[np.ndarray, np.ndarray], np.ndarray]
"""align(p_target, p_source) -> T_target_source of paired points."""
PlaneStep = Callable[[np.ndarray, np.ndarray, np.ndarray], np.ndarray]
"""step(p_target, p_source, n_target) -> the small motion to be composed on the left."""
NormalsAt = Callable[[Int[np.ndarray, "n"]], Float[np.ndarray, "n 3"]]
"""normals_at(indices) -> the unit normals of these target points."""

IDENTITY = np.eye(4)
IDENTITY.setflags(write=False)


class Stop(Enum):
    """Why a run ended."""

    CONVERGED = "converged: the last fit moved no point by more than the tolerance"
    CIRCLING = "the matches are those of an earlier iteration again: the run goes round in a circle"
    TOO_FEW_MATCHES = "too few matches are left to fit a motion"
    MAX_ITERATIONS = "the maximum number of iterations is reached"
    NOT_FINITE = "the fit gave a motion with numbers that are not finite"

    @property
    def message(self) -> str:
        """The reason in words."""
        return self.value


@dataclass(frozen=True)
class Gate:
    """Which matches a fit may use: those within a limit found from the distances themselves.

    `max_distance` is a fixed limit in metres. Among the pairs it leaves, `keep` takes that fraction
    with the smallest distances (trimming) and `medians` takes those within that many times the
    median. All three together: the smallest limit counts.
    """

    max_distance: float = np.inf
    keep: float = 1.0
    medians: float = np.inf

    def __post_init__(self) -> None:
        if not (self.max_distance > 0 and 0 < self.keep <= 1 and self.medians >= 1):
            raise ValueError(
                f"max_distance > 0, 0 < keep <= 1 and medians >= 1 are needed, not {self}"
            )

    def limit(self, distances: Float[np.ndarray, "n"]) -> float:
        """Return the largest distance that is accepted, in metres."""
        near = (
            distances[distances <= self.max_distance]
            if np.isfinite(self.max_distance)
            else distances
        )
        limit = self.max_distance
        if len(near) and self.keep < 1:
            count = int(np.ceil(self.keep * len(near)))
            limit = min(limit, float(np.partition(near, count - 1)[count - 1]))
        if len(near) and np.isfinite(self.medians):
            limit = min(limit, self.medians * float(np.median(near)))
        return float(limit)


@dataclass(frozen=True, eq=False)
class State:
    """One sub-step: after `match` the partners are new, after `fit` the motion is.

    Attributes:
        iteration: Counted from 1.
        T_target_source: The motion so far; after `match` it is still that of the fit before.
        indices: The target point matched to each source point.
        distances: Between each moved source point and its partner, metres.
        limit: The largest distance the gate accepted at the match, metres.
        kept: The matches within the limit: the fit uses only these.
        rmse: Root mean square of the kept distances, metres.
        residual: Root mean square of what the fit minimises: those distances, or the distances to
            tangent planes.
        overlap: Share of the source points whose match was kept.
        stop: Why this is the last state, or None.
    """

    phase: Literal["match", "fit"]
    iteration: int
    T_target_source: Float[np.ndarray, "4 4"]
    indices: Int[np.ndarray, "n"]
    distances: Float[np.ndarray, "n"]
    limit: float
    kept: Bool[np.ndarray, "n"]
    rmse: float
    residual: float
    overlap: float
    stop: Stop | None = None


def nearest(
    p_target: Float[np.ndarray, "m 3"], p_source: Float[np.ndarray, "n 3"]
) -> Int[np.ndarray, "n"]:
    """Return the index of the target point nearest to each source point.

    Raises:
        ValueError: If there is no target point, or a coordinate is not finite.
    """
    return matcher(p_target, p_source)(p_target, p_source)


@traced
def icp(
    p_target: Float[np.ndarray, "m 3"],
    p_source: Float[np.ndarray, "n 3"],
    T_target_source: Float[np.ndarray, "4 4"] = IDENTITY,
    *,
    n_target: Float[np.ndarray, "m 3"] | NormalsAt | None = None,
    gate: Gate = Gate(),
    match: Match | None = None,
    align: Align = align_rigid,
    step: PlaneStep = point_to_plane_step,
    max_iterations: int = 100,
    tolerance: float = 1e-6,
) -> Iterator[State]:
    """Yield the states of ICP, two per iteration, from an initial guess to a stop.

    ICP finds the nearest minimum, not the best one. With `align_rigid` and a gate that only trims,
    the RMSE of the kept matches never rises; a small RMSE is no proof of a right answer.

    Args:
        n_target: Unit normals, or what gives those of some points, as `Normals.at` does. With them
            each fit is one point-to-plane `step`, without them `align`.
        match: Finds partners; None means `matcher`'s, which keeps one k-d tree for the whole run.
        align: Fits a motion to pairs: `align_rigid`, `align_similarity`, `align_affine`, or one's
            own.
        tolerance: Converged when a fit moves no point by more than this share of the source's
            extent.

    Raises:
        ValueError: If a cloud is empty or holds numbers that are not finite.

    Examples:
        >>> p_target = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]])
        >>> *_, last = icp(p_target, p_target - np.array([0.1, 0.0, 0.0]))
        >>> last.stop.name, last.T_target_source[:3, 3].round(6).tolist()
        ('CONVERGED', [0.1, 0.0, 0.0])
    """
    check_clouds(p_target, p_source)
    match = matcher(p_target, p_source) if match is None else match
    corners = bounding_corners(p_source)
    shortest_move = tolerance * np.linalg.norm(corners[-1] - corners[0])
    fewest = 3 if n_target is None else 6
    p_moved = apply(T_target_source, p_source)
    if isinstance(n_target, np.ndarray):
        normals_at = functools.partial(n_target.take, axis=0)
    else:
        normals_at = n_target
    last_seen = {}  # by matches: the iteration that had them

    for iteration in range(1, max_iterations + 1):
        indices = match(p_target, p_moved)  # step a: closest points
        p_match = p_target.take(indices, axis=0)  # rows by take and compress: a third of the time
        distances = lengths(p_match - p_moved)
        limit = gate.limit(distances)
        kept = distances <= limit
        n_kept = None if normals_at is None else normals_at(indices[kept])
        stop = Stop.TOO_FEW_MATCHES if np.count_nonzero(kept) < fewest else None
        residual = misfit(p_match, p_moved, n_kept, distances=distances, kept=kept)
        matched = summary(
            "match",
            iteration,
            T_target_source,
            indices=indices,
            distances=distances,
            limit=limit,
            kept=kept,
            residual=residual,
            stop=stop,
        )
        yield matched
        if stop:
            return

        if n_kept is None:
            used = (p.compress(kept, axis=0) for p in (p_match, p_source))
            T_new = align(*used)  # step b: Umeyama 1991, eq. 40-42
        else:
            used = (p.compress(kept, axis=0) for p in (p_match, p_moved))
            T_new = step(*used, n_kept) @ T_target_source  # Low 2004, eq. 10
        if not np.isfinite(T_new).all():
            yield replace(matched, phase="fit", stop=Stop.NOT_FINITE)
            return
        largest_move = lengths(apply(T_new, corners) - apply(T_target_source, corners)).max()
        # step c: apply the registration
        T_target_source = T_new
        p_moved = apply(T_new, p_source)
        distances = lengths(p_match - p_moved)
        matches = zlib.crc32(kept.tobytes(), zlib.crc32(indices.tobytes()))
        if largest_move <= shortest_move:  # step d: terminate
            stop = Stop.CONVERGED
        elif (
            last_seen.get(matches, iteration) < iteration - 1
        ):  # only without a cost that must fall: planes, gates
            stop = Stop.CIRCLING
        elif iteration == max_iterations:
            stop = Stop.MAX_ITERATIONS
        last_seen[matches] = iteration
        residual = misfit(p_match, p_moved, n_kept, distances=distances, kept=kept)
        yield summary(
            "fit",
            iteration,
            T_target_source,
            indices=indices,
            distances=distances,
            limit=limit,
            kept=kept,
            residual=residual,
            stop=stop,
        )
        if stop:
            return


def matcher(
    p_target: Float[np.ndarray, "m 3"],
    p_source: Float[np.ndarray, "n 3"],
    tree: "scipy.spatial.KDTree | None" = None,
) -> Match:
    """Return a nearest-neighbour `match`; it visits the source in tree order.

    Consecutive queries then touch the same leaves: for 100,000 points in random order that takes a
    third of the time. `tree` is the target's, where it has one already. A point is searched again
    only once it has moved by half of what its second nearest was farther than its partner: until
    then no other can be nearer, by the triangle inequality (as Elkan does for k-means, 2003).
    """
    check_clouds(p_target, p_source)
    tree = tree or tree_of(p_target)
    order = tree_of(p_source).indices
    searched_at = np.full(p_source.shape, np.inf)
    partner = np.empty(len(p_source), dtype=np.intp)
    free = np.zeros(len(p_source))  # how far a point may move from there and keep its partner

    def match(_p_target: np.ndarray, p_source: np.ndarray) -> np.ndarray:
        stays = lengths(p_source - searched_at) < free  # false of NaN, which the tree refuses
        rows = order[~stays.take(order)]
        searched_at[rows] = p = p_source.take(rows, axis=0)
        workers = -1 if len(p) > 2000 else 1  # threads cost more than they save on few points
        distances, nearest_two = map(np.transpose, tree.query(p, k=2, workers=workers))
        partner[rows] = nearest_two[0]
        free[rows] = (distances[1] - distances[0]) / 2.0
        return partner.copy()

    return match


def bounding_corners(p: Float[np.ndarray, "n 3"]) -> Float[np.ndarray, "8 3"]:
    """Return the corners of the bounding box; no affine map moves a point by more than these."""
    coordinates = np.ascontiguousarray(p.T)
    low, high = coordinates.min(axis=1), coordinates.max(axis=1)
    return np.array([np.where([i & 4, i & 2, i & 1], high, low) for i in range(8)])


def lengths(v: Float[np.ndarray, "n 3"]) -> Float[np.ndarray, "n"]:
    """Return the length of each row."""
    return np.sqrt(np.einsum("ij,ij->i", v, v))


def misfit(
    p_match: Float[np.ndarray, "n 3"],
    p_moved: Float[np.ndarray, "n 3"],
    n_kept: Float[np.ndarray, "k 3"] | None,
    *,
    distances: Float[np.ndarray, "n"],
    kept: Bool[np.ndarray, "n"],
) -> float:
    """Return the root mean square, over the kept matches, of what the fit minimises, metres.

    With normals these are distances to tangent planes, without them `distances`.
    """
    if n_kept is None:
        return rms(distances[kept])
    return rms(np.einsum("ij,ij->i", (p_match - p_moved).compress(kept, axis=0), n_kept))


def summary(
    phase: Literal["match", "fit"],
    iteration: int,
    T_target_source: np.ndarray,
    *,
    indices: np.ndarray,
    distances: np.ndarray,
    limit: float,
    kept: np.ndarray,
    residual: float,
    stop: Stop | None,
) -> State:
    """Return the state of these values, with its RMSE and overlap computed from them."""
    overlap = float(kept.mean())
    return State(
        phase,
        iteration,
        T_target_source,
        indices,
        distances,
        limit,
        kept,
        rms(distances[kept]),
        residual,
        overlap,
        stop,
    )
