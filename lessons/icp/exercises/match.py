"""Write ICP's first half: for every source point the index of its nearest target point. The lesson
draws your correspondences, and fits the motion to them.
"""

import numpy as np
from jaxtyping import Float, Int

from lessons.icp.exercises import STUDENTS
from workbench.algorithms.registration.icp import nearest
from workbench.exercise import (
    Function,
    Verdict,
    alternative,
    check,
    contract,
    fail,
    full,
    left_alone,
    mistake,
    number,
    partial,
)


@contract(
    slot="match",
    forbid=("scipy.spatial",),
    examples=(
        (
            (
                "match(np.array([[0.0, 0, 0], [1, 0, 0]]), np.array([[0.9, 0, 0], [0.2, 0, 0], [5,"
                " 0, 0]]))"
            ),
            "[1, 0, 1]",
        ),
        ("match(np.array([[0.0, 0, 0], [0, 0, 1]]), np.array([[0.0, 0, 0.7]]))", "[1]"),
    ),
)
def match(
    p_target: Float[np.ndarray, "m 3"], p_source: Float[np.ndarray, "n 3"]
) -> Int[np.ndarray, "n"]:
    """Return for each source point the index of the target point nearest to it.

    Args:
        p_target: The cloud to find partners in, metres.
        p_source: The points that want a partner, metres; in the target frame, as ICP has moved them
            so far.

    Returns:
        n whole numbers from 0 to m - 1, Euclidean distances deciding. Several source points may
        share a partner, and target points may stay without one. Where two target points are equally
        near, either is right.

    Raises:
        ValueError: If there is no target point (m = 0).
    """
    return np.asarray(nearest(p_target, p_source), dtype=np.int64)


MATCH_HINT = (
    "For each source point on its own: the smallest Euclidean distance to all target points."
)


def nearest_found(
    candidate: Function, p_target: np.ndarray, p_source: np.ndarray, hint: str = MATCH_HINT
) -> Verdict:
    """Judge partners by their distance: all for the nearest everywhere, half where 19 of 20 have
    it.
    """
    indices, wanted = candidate(p_target, p_source), nearest(p_target, p_source)
    outside = int(((indices < 0) | (indices >= len(p_target))).sum())
    if outside:
        message = f"{outside} indices are outside 0 to {len(p_target) - 1}"
        k = int(np.argmax((indices < 0) | (indices >= len(p_target))))
        return fail(f"{message}: [{k}] is {indices[k]}, right is {wanted[k]}. {hint}")
    best = np.linalg.norm(p_target[wanted] - p_source, axis=1)
    more = np.linalg.norm(p_target[indices] - p_source, axis=1) - best
    wrong = int((more > 1e-9).sum())
    if wrong == 0:
        return full(f"All {len(indices)} partners are the nearest.")
    k = int(np.argmax(more))
    message = (
        f"{wrong} of {len(indices)} partners are not the nearest. [{k}] is {indices[k]}, right is"
        f" {wanted[k]}: "
    )
    message += f"{number(more[k], 2)} m nearer."
    return (
        partial(0.5, f"{message} {hint}")
        if wrong <= 0.05 * len(indices)
        else fail(f"{message} {hint}")
    )


def two_clouds(seed: int, m: int, n: int) -> tuple[np.ndarray, np.ndarray]:
    """Return m target and n source points of one room, one metre in size."""
    rng = np.random.default_rng(seed)
    return rng.uniform(0, 1, (m, 3)), rng.uniform(0, 1, (n, 3))


@check(2)
def few_points(candidate: Function) -> Verdict:
    """Four points find their partners among three, and two of them share one."""
    p_target = np.array([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
    p_source = np.array([[0.9, 0.1, 0.2], [0.2, 0.1, 0.9], [1.4, 0.2, 0.3], [0.1, -0.2, 0.1]])
    return nearest_found(
        candidate, p_target, p_source, f"Asked for were [1, 2, 1, 0]. {MATCH_HINT}"
    )


@check(2)
def two_scans(candidate: Function) -> Verdict:
    """In clouds of 150 and 200 points every source point gets its nearest."""
    return nearest_found(candidate, *two_clouds(STUDENTS, 150, 200))


@check(1)
def clouds_are_left_alone(candidate: Function) -> Verdict:
    """The clouds that come in are not changed."""
    return left_alone(candidate, nearest_found(candidate, *two_clouds(STUDENTS + 1, 30, 40)))


@mistake(
    "You returned the nearest source point of each target point. Nearest neighbour is not"
    " symmetric: it must be one target index for each source point."
)
def matched_backwards(p_target: np.ndarray, p_source: np.ndarray) -> np.ndarray:
    """Finds the source point nearest to each target point."""
    return nearest(p_source, p_target)


@mistake(
    "You paired points with the same row number. The rows of two scans have nothing to do with each"
    " other: compare distances."
)
def paired_by_row(p_target: np.ndarray, p_source: np.ndarray) -> np.ndarray:
    """Pairs points with the same row number."""
    return np.arange(len(p_source)) % len(p_target)


@mistake(
    "You give every target point away only once. In ICP several source points may share a partner:"
    " each takes its nearest, on its own."
)
def one_to_one(p_target: np.ndarray, p_source: np.ndarray) -> np.ndarray:
    """Gives every target point away once, first come first served, as long as there are any."""
    distances = np.linalg.norm(p_source[:, None] - p_target, axis=2)
    indices = np.empty(len(p_source), dtype=int)
    for k, row in enumerate(distances):
        indices[k] = np.argmin(row) if np.isfinite(row).any() else k % len(p_target)
        distances[:, indices[k]] = np.inf
    return indices


@mistake("You compare x and y only. The distance is in space: z counts too.")
def height_ignored(p_target: np.ndarray, p_source: np.ndarray) -> np.ndarray:
    """Compares x and y only."""
    return np.argmin(np.linalg.norm(p_source[:, None, :2] - p_target[:, :2], axis=2), axis=1)


@mistake(
    "You sum absolute differences. That is the Manhattan distance; sum their squares for the"
    " Euclidean one."
)
def manhattan_distance(p_target: np.ndarray, p_source: np.ndarray) -> np.ndarray:
    """Sums absolute differences."""
    return np.argmin(np.abs(p_source[:, None] - p_target).sum(axis=2), axis=1)


@mistake("You return the farthest target points: argmax where argmin belongs.")
def farthest(p_target: np.ndarray, p_source: np.ndarray) -> np.ndarray:
    """Takes the largest distance."""
    return np.argmax(np.linalg.norm(p_source[:, None] - p_target, axis=2), axis=1)


@mistake(
    "You use |a|^2 + |b|^2 - 2 a·b. Far from the origin these cancel and leave no digits: subtract"
    " the points first."
)
def squares_expanded(p_target: np.ndarray, p_source: np.ndarray) -> np.ndarray:
    """Uses |a|^2 + |b|^2 - 2 a b, where far from the origin all digits cancel."""
    squares = (p_source**2).sum(1)[:, None] + (p_target**2).sum(1) - 2 * p_source @ p_target.T
    return np.argmin(squares, axis=1)


@mistake("You returned the distances. Return which target point it is: indices, whole numbers.")
def distances_returned(p_target: np.ndarray, p_source: np.ndarray) -> np.ndarray:
    """Returns how far, not which."""
    return np.linalg.norm(p_target[nearest(p_target, p_source)] - p_source, axis=1)


@alternative
def match_all_at_once(p_target: np.ndarray, p_source: np.ndarray) -> np.ndarray:
    """Compares every pair in one array."""
    squares = np.sum((p_source[:, None, :] - p_target[None, :, :]) ** 2, axis=2)
    return np.asarray(np.argmin(squares, axis=1))


@alternative
def match_one_by_one(p_target: np.ndarray, p_source: np.ndarray) -> list[int]:
    """Loops over the source."""
    return [int(np.argmin(np.linalg.norm(p_target - p, axis=1))) for p in p_source]


@alternative
def match_with_a_tree(p_target: np.ndarray, p_source: np.ndarray) -> np.ndarray:
    """Asks a k-d tree."""
    from scipy.spatial import cKDTree

    if len(p_target) == 0:
        raise ValueError("no target")
    return np.asarray(cKDTree(p_target).query(p_source)[1])
