"""Write the choice among possible poses: which one sees the points where they were seen? The lesson
asks you where three points left up to four cameras, and where a plane left two.
"""

import numpy as np
from jaxtyping import Float

from lessons.pose.exercises import STUDENTS, a_view
from workbench.algorithms.cameras import camera_search
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
    worst,
)
from workbench.geometry.cameras.camera_motions import reprojection_errors
from workbench.geometry.cameras.three_points import p3p
from workbench.geometry.motions import apply, inverse
from workbench.numerals import brief


@contract(
    slot="choose_pose",
    examples=(
        (
            "choose_pose(np.eye(4)[None], array([[0., 0, 2]]), array([[0., 0]]))",
            "[[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]",
        ),
        (
            (
                "choose_pose(np.stack([np.diag([-1., 1, -1, 1]), np.eye(4)]), array([[0., 0, 2]]),"
                " array([[0., 0]]))"
            ),
            "[[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]",
        ),
    ),
)
def choose_pose(
    candidates: Float[np.ndarray, "m 4 4"],
    p_world: Float[np.ndarray, "n 3"],
    xy: Float[np.ndarray, "n 2"],
) -> Float[np.ndarray, "4 4"]:
    """Return the candidate that has all points in front and sees them nearest to where they were
    seen.

    Nearest is by the root mean square, over all points, of the distances between (X/Z, Y/Z) of the
    camera and xy.

    Args:
        candidates: One T_camera_world or more; p_camera = R p_world + t.
        p_world: The points to judge by, metres.
        xy: Where they were seen, normalised image coordinates.

    Returns:
        One of the candidates. Where none of them has all points in front (Z > 0), the first.
    """
    return camera_search.choose_pose(candidates, p_world, xy)


HINT = (
    "Move the points into each camera, refuse it if a Z is not positive, divide by Z, and compare"
    " with xy."
)


def judged(
    candidate: Function,
    candidates: np.ndarray,
    p_world: np.ndarray,
    xy: np.ndarray,
    hint: str = HINT,
) -> Verdict:
    """Judge which candidate was chosen."""
    got = candidate(candidates, p_world, xy)
    right = camera_search.choose_pose(candidates, p_world, xy)
    if np.abs(got - right).max() < 1e-9:
        return full(f"The right one of {len(candidates)} poses was chosen.")
    errors = reprojection_errors(np.stack([got, right]), p_world, xy)
    rms = [
        brief(error, 3) if np.isfinite(error) else "not finite"
        for error in np.sqrt(np.square(errors).mean(axis=1))
    ]
    known = np.abs(candidates - got).max(axis=(1, 2)) < 1e-9
    which = f"chose number {int(np.argmax(known))}" if known.any() else "returned something else"
    wanted = int(np.argmax(np.abs(candidates - right).max(axis=(1, 2)) < 1e-9))
    behind = int(np.count_nonzero(np.isinf(errors[0])))
    why = (
        f"{behind} of {len(p_world)} points are not in front of it"
        if behind
        else f"its error is {rms[0]}"
    )
    return fail(
        f"Of {len(candidates)} poses you {which}: {why}; right is number {wanted}, error {rms[1]}."
        f" {hint}"
    )


def several(
    seed: int, n: int = 8, sigma: float = 1e-3
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return the solutions of the first three of n points, at least two, and all points with
    noise.
    """
    rng = np.random.default_rng(seed)
    while True:
        _, p_world, xy = a_view(rng, n)
        xy = xy + sigma * rng.standard_normal(xy.shape)
        Ts, _ = p3p(p_world[None, :3], xy[None, :3])
        if len(Ts) > 1:  # one of the others sees the last point better than the right one does
            uv, z = seen(Ts, p_world[-1:])
            k = int(np.argmax(np.square(uv[:, 0] - xy[-1]).sum(axis=1) * (z[:, 0] > 0)))
            xy[-1] = uv[k, 0]
            return Ts[rng.permutation(len(Ts))], p_world, xy


def with_twin(seed: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return two poses of a plane that project alike, one of them with the plane behind, which
    comes first.
    """
    T, p_world, xy = a_view(np.random.default_rng(seed), 8, flat=True)
    p_mean = p_world.mean(axis=0)
    n = np.linalg.svd(p_world - p_mean)[2][2]
    mirror = np.eye(4)  # through the plane, which stays
    mirror[:3, :3] -= 2 * np.outer(n, n)
    mirror[:3, 3] = 2 * n * (n @ p_mean)
    twin = np.diag([-1.0, -1.0, -1.0, 1.0]) @ T @ mirror
    noisy = T.copy()
    noisy[0, 3] += 0.02
    return np.stack([twin, noisy]), p_world, xy


@check(3)
def of_three_points(candidate: Function) -> Verdict:
    """Of the solutions of three points the one is chosen that fits eight."""
    return worst(
        judged(candidate, *several(STUDENTS + k), "All points judge, not the three.")
        for k in range(8)
    )


@check(2)
def a_twin_behind(candidate: Function) -> Verdict:
    """A pose that has the points behind it is refused, though it projects them exactly."""
    return worst(
        judged(candidate, *with_twin(STUDENTS + 20 + k), "Mind the sign of Z.") for k in range(2)
    )


@check(1)
def inputs_are_left_alone(candidate: Function) -> Verdict:
    """The poses, points and coordinates that come in are not changed."""
    return left_alone(candidate, judged(candidate, *several(STUDENTS + 30)))


def seen(Ts: np.ndarray, p_world: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return where each pose sees the points, and their depths."""
    p_camera = np.stack([apply(T, p_world) for T in Ts])
    return p_camera[..., :2] / p_camera[..., 2:], p_camera[..., 2]


@mistake(
    "You did not look at the depths: a pose with the points behind it can project them exactly."
    " Refuse where a Z ≤ 0."
)
def without_depths(candidates: np.ndarray, p_world: np.ndarray, xy: np.ndarray) -> np.ndarray:
    """Compares the errors alone."""
    uv, _ = seen(candidates, p_world)
    return candidates[np.square(uv - xy).sum(axis=(1, 2)).argmin()]


@mistake(
    "You judged by the first three points alone. These fit all the candidates: it takes the others"
    " to choose."
)
def by_three(candidates: np.ndarray, p_world: np.ndarray, xy: np.ndarray) -> np.ndarray:
    """Leaves out all points but three."""
    return camera_search.choose_pose(candidates, p_world[:3], xy[:3])


@mistake(
    "You judged by the last point alone. A single point may be seen well by a wrong pose: use all"
    " of them."
)
def by_the_last(candidates: np.ndarray, p_world: np.ndarray, xy: np.ndarray) -> np.ndarray:
    """Leaves out all points but one."""
    return camera_search.choose_pose(candidates, p_world[-1:], xy[-1:])


@mistake("You returned the first pose, whatever it fits. Compare their errors in the picture.")
def the_first(candidates: np.ndarray, p_world: np.ndarray, xy: np.ndarray) -> np.ndarray:
    """Does not choose."""
    return candidates[0]


@mistake(
    "You counted the points in front, and did not compare the errors of those poses that have all"
    " in front."
)
def most_in_front(candidates: np.ndarray, p_world: np.ndarray, xy: np.ndarray) -> np.ndarray:
    """Takes the pose with most points in front."""
    _, z = seen(candidates, p_world)
    return candidates[np.argmax((z > 0).sum(axis=1))]


@mistake("You chose the right pose and returned its inverse. Return the candidate as it came in.")
def inverted(candidates: np.ndarray, p_world: np.ndarray, xy: np.ndarray) -> np.ndarray:
    """Returns camera-to-world."""
    return inverse(camera_search.choose_pose(candidates, p_world, xy))


@mistake(
    "You took the candidates for camera-to-world. They are T_camera_world: p_camera = R p_world +"
    " t, nothing inverted."
)
def read_inverted(candidates: np.ndarray, p_world: np.ndarray, xy: np.ndarray) -> np.ndarray:
    """Moves the points by the inverses."""
    errors = reprojection_errors(np.stack([inverse(T) for T in candidates]), p_world, xy)
    return candidates[np.sqrt(np.square(errors).mean(axis=1)).argmin()]


@mistake("You returned the pose with the largest error. Take the least.")
def the_worst(candidates: np.ndarray, p_world: np.ndarray, xy: np.ndarray) -> np.ndarray:
    """Takes the maximum."""
    errors = np.square(reprojection_errors(candidates, p_world, xy)).mean(axis=1)
    finite = np.where(np.isfinite(errors), errors, -1.0)
    return candidates[int(np.argmax(finite))]


@mistake(
    "You averaged the depths: their mean is positive though some points are behind. All of them"
    " have to be in front."
)
def mean_depth(candidates: np.ndarray, p_world: np.ndarray, xy: np.ndarray) -> np.ndarray:
    """Asks for a positive mean depth."""
    uv, z = seen(candidates, p_world)
    errors = np.square(uv - xy).sum(axis=(1, 2))
    return candidates[np.where(z.mean(axis=1) > 0, errors, np.inf).argmin()]


@mistake(
    "You refuse poses with the points in front and take those with the points behind. In front is"
    " where Z > 0."
)
def only_behind(candidates: np.ndarray, p_world: np.ndarray, xy: np.ndarray) -> np.ndarray:
    """Has the sign of the depth wrong."""
    uv, z = seen(candidates, p_world)
    errors = np.square(uv - xy).sum(axis=(1, 2))
    return candidates[np.where((z < 0).all(axis=1), errors, np.inf).argmin()]


@mistake(
    "You compared X and Y in metres with xy, without the division by Z. Image coordinates are X/Z"
    " and Y/Z."
)
def without_division(candidates: np.ndarray, p_world: np.ndarray, xy: np.ndarray) -> np.ndarray:
    """Forgets to divide."""
    p_camera = np.stack([apply(T, p_world) for T in candidates])
    errors = np.square(p_camera[..., :2] - xy).sum(axis=(1, 2))
    return candidates[np.where((p_camera[..., 2] > 0).all(axis=1), errors, np.inf).argmin()]


@alternative
def in_a_loop(candidates: np.ndarray, p_world: np.ndarray, xy: np.ndarray) -> np.ndarray:
    """Goes through the poses and keeps the best."""
    best = candidates[0]
    least = np.inf
    for T in candidates:
        p_camera = p_world @ T[:3, :3].T + T[:3, 3]
        if (p_camera[:, 2] <= 0).any():
            continue
        error = ((p_camera[:, :2] / p_camera[:, 2:] - xy) ** 2).sum()
        if error < least:
            best, least = T, error
    return best
