"""Write one Gauss-Newton step on a camera's pose: the small motion that would lower the squared
errors in the picture most, were they linear. The lesson goes downhill by your steps, and halves
those that raise the error.
"""

import numpy as np
from jaxtyping import Float

from lessons.pose.exercises import STUDENTS, a_view
from workbench.exercise import (
    Function,
    Verdict,
    alternative,
    check,
    contract,
    fail,
    left_alone,
    mistake,
    motion_verdict,
    number,
    worst,
)
from workbench.geometry.cameras.camera_motions import gauss_newton_step, linearised, refined
from workbench.geometry.motions import exp_so3, motion, skew


@contract(
    slot="pose_step",
    examples=(
        (
            (
                "pose_step(np.eye(4), np.eye(4)[:, :3] + [0, 0, 2], array([[.5, 0], [0, .5], [0,"
                " 0], [0, 0]]))"
            ),
            "[[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]",
        ),
        (
            (
                "pose_step(np.eye(4) + np.eye(4, k=3), np.eye(4)[:, :3] + [0, 0, 2], array([[.5,"
                " 0], [0, .5], [0, 0], [0, 0]]))"
            ),
            "[[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]",
        ),
    ),
)
def pose_step(
    T: Float[np.ndarray, "4 4"], p_world: Float[np.ndarray, "n 3"], xy: Float[np.ndarray, "n 2"]
) -> Float[np.ndarray, "4 4"]:
    """Return the pose after one Gauss-Newton step on the squared reprojection errors.

    With (X, Y, Z) = R p_world + t, a point is seen at (X/Z, Y/Z). A small motion, by v in metres
    and by the rotation vector w in radians, both in the camera's frame, moves it by v + w × (X, Y,
    Z). Solve the linear least-squares problem for v and w and compose that motion on the left of T.
    Steps about another point are right too, if they arrive.

    Args:
        T: T_camera_world before the step.
        p_world: Four points or more, metres, all in front of the camera.
        xy: Where they were seen, normalised image coordinates.

    Returns:
        T_camera_world after the step, with a proper rotation.
    """
    return gauss_newton_step(T, p_world, xy)


HINT = (
    "Rows of the Jacobian: (1/Z, 0, −X/Z²) and (0, 1/Z, −Y/Z²), each times v + w × p_camera;"
    " residual: seen − xy."
)


def a_start(
    seed: int, n: int = 12, *, aside: float = 0.0, degrees: float = 15.0, metres: float = 0.3
) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray, np.random.Generator]:
    """Return the right T_camera_world, points, where they are seen, and a start that is off by so
    much.
    """
    rng = np.random.default_rng(seed)
    T_true, p_world, xy = a_view(rng, n, aside=aside)
    w = rng.standard_normal(3)
    p_mean = p_world.mean(axis=0)
    R = exp_so3(np.radians(degrees) * w / np.linalg.norm(w)) @ T_true[:3, :3]
    t = T_true[:3, :3] @ p_mean + T_true[:3, 3] + rng.uniform(-metres, metres, 3) - R @ p_mean
    return T_true, p_world, xy, motion(R, t), rng


def arrived(
    candidate: Function,
    seed: int,
    *,
    steps: int = 6,
    sigma: float = 0.0,
    n: int = 12,
    aside: float = 0.0,
) -> Verdict:
    """Judge where some steps arrive from a start that is some 15 degrees and half a metre off."""
    T_true, p_world, xy, T, rng = a_start(seed, n, aside=aside)
    xy = xy + sigma * rng.standard_normal(xy.shape)
    right = refined(T_true[None], p_world, xy)[0] if sigma else T_true
    for _ in range(steps):
        T = candidate(T, p_world, xy)
        if not np.abs(T).max() < 1e9:
            return fail(
                f"The steps run away: the largest number of T is {number(np.abs(T).max(), 2)}."
                f" {HINT}"
            )
        if (
            not 0.5 < np.linalg.det(T[:3, :3]) < 2
        ):  # all points on one, or behind each other: nothing to step from
            return motion_verdict(T, right, f"That is what a step gave. {HINT}", p=p_world)
    return motion_verdict(T, right, f"T is the pose after {steps} steps. {HINT}", p=p_world)


@check(3)
def steps_arrive(candidate: Function) -> Verdict:
    """Six steps from 15 degrees and half a metre away arrive within 0.1 degrees and a
    millimetre.
    """
    return worst(arrived(candidate, STUDENTS + k) for k in range(3))


@check(1)
def at_the_right_pose(candidate: Function) -> Verdict:
    """At the right pose the step is none."""
    T, p_world, xy = a_view(np.random.default_rng(STUDENTS + 10), 10)
    return motion_verdict(
        candidate(T, p_world, xy), T, f"All residuals are 0 here. {HINT}", p=p_world
    )


@check(1)
def inputs_are_left_alone(candidate: Function) -> Verdict:
    """The pose, points and coordinates that come in are not changed."""
    return left_alone(candidate, arrived(candidate, STUDENTS + 20))


def small(T: np.ndarray, p_world: np.ndarray, xy: np.ndarray, turned: float = 1.0) -> np.ndarray:
    """Return the right small motion, or one made with other signs of the rotation's derivatives."""
    residuals, J = linearised(T, p_world, xy)
    x = -np.linalg.lstsq(J * np.repeat([1.0, turned], 3), residuals, rcond=None)[0]
    return motion(exp_so3(x[3:]), x[:3])


@mistake(
    "Your step goes uphill: its sign is wrong. Solve J x = −residual, with residual = seen − xy."
)
def uphill(T: np.ndarray, p_world: np.ndarray, xy: np.ndarray) -> np.ndarray:
    """Adds what should be subtracted."""
    residuals, J = linearised(T, p_world, xy)
    x = np.linalg.lstsq(J, residuals, rcond=None)[0]
    return motion(exp_so3(x[3:]), x[:3]) @ T


@mistake(
    "Your step is counted in the camera's frame, but composed on the right of T. Compose it on the"
    " left: step @ T."
)
def composed_on_the_right(T: np.ndarray, p_world: np.ndarray, xy: np.ndarray) -> np.ndarray:
    """Multiplies from the wrong side."""
    return T @ small(T, p_world, xy)


@mistake(
    "Your derivative leaves out −X/Z² and −Y/Z²: moving along the axis changes the picture too, by"
    " the division."
)
def without_division(T: np.ndarray, p_world: np.ndarray, xy: np.ndarray) -> np.ndarray:
    """Differentiates X/Z as if Z were constant."""
    p = p_world @ T[:3, :3].T + T[:3, 3]
    r = (p[:, :2] / p[:, 2:] - xy).ravel()
    J = np.zeros((len(p), 2, 6))
    J[:, 0, 0] = J[:, 1, 1] = 1 / p[:, 2]
    J[:, 0, 4] = 1.0
    J[:, 0, 5] = -p[:, 1] / p[:, 2]
    J[:, 1, 3] = -1.0
    J[:, 1, 5] = p[:, 0] / p[:, 2]
    x = -np.linalg.lstsq(J.reshape(-1, 6), r, rcond=None)[0]
    return motion(exp_so3(x[3:]), x[:3]) @ T


@mistake(
    "You left the rotation out: there are six unknowns, three of translation and three of rotation."
)
def translation_only(T: np.ndarray, p_world: np.ndarray, xy: np.ndarray) -> np.ndarray:
    """Solves for v alone."""
    residuals, J = linearised(T, p_world, xy)
    moved = T.copy()
    moved[:3, 3] -= np.linalg.lstsq(J[:, :3], residuals, rcond=None)[0]
    return moved


@mistake(
    "You turned by I + [w]×, which is no rotation: it stretches at every step. Turn by |w| about w"
    " (Rodrigues)."
)
def no_proper_rotation(T: np.ndarray, p_world: np.ndarray, xy: np.ndarray) -> np.ndarray:
    """Takes the linear part for the rotation."""
    residuals, J = linearised(T, p_world, xy)
    x = -np.linalg.lstsq(J, residuals, rcond=None)[0]
    return motion(np.eye(3) + skew(x[3:]), x[:3]) @ T


@mistake(
    "Your rotation turns backwards: w × p is −[p]× w. Its columns in the Jacobian have the wrong"
    " sign."
)
def turned_backwards(T: np.ndarray, p_world: np.ndarray, xy: np.ndarray) -> np.ndarray:
    """Uses p × w."""
    return small(T, p_world, xy, -1.0) @ T


@mistake("You returned the step alone. Asked for is the pose after it: step @ T.")
def step_alone(T: np.ndarray, p_world: np.ndarray, xy: np.ndarray) -> np.ndarray:
    """Forgets T."""
    return small(T, p_world, xy)


@mistake(
    "You went down the gradient, Jᵀ r. Gauss-Newton solves (JᵀJ) x = −Jᵀ r: the gradient alone does"
    " not know how far."
)
def gradient(T: np.ndarray, p_world: np.ndarray, xy: np.ndarray) -> np.ndarray:
    """Steps along the gradient."""
    residuals, J = linearised(T, p_world, xy)
    x = -0.1 * J.T @ residuals
    return motion(exp_so3(x[3:]), x[:3]) @ T


@alternative
def written_out(T: np.ndarray, p_world: np.ndarray, xy: np.ndarray) -> np.ndarray:
    """All derivatives of u, then all of v, and Rodrigues' formula."""
    x, y, z = (p_world @ T[:3, :3].T + T[:3, 3]).T
    x, y = x / z, y / z
    of_u = np.stack([1 / z, 0 * z, -x / z, -x * y, 1 + x * x, -y], axis=1)
    of_v = np.stack([0 * z, 1 / z, -y / z, -1 - y * y, x * y, x], axis=1)
    off = np.concatenate([x - xy[:, 0], y - xy[:, 1]])
    v, w = np.split(np.linalg.lstsq(np.concatenate([of_u, of_v]), -off, rcond=None)[0], 2)
    angle = np.linalg.norm(w)
    W = np.cross(w, np.eye(3)).T
    step = np.eye(4)
    step[:3, :3] += np.sinc(angle / np.pi) * W + 0.5 * np.sinc(0.5 * angle / np.pi) ** 2 * W @ W
    step[:3, 3] = v
    return step @ T


@alternative
def by_normal_equations(T: np.ndarray, p_world: np.ndarray, xy: np.ndarray) -> np.ndarray:
    """Turns about the camera and shifts, R and t one by one."""
    residuals, J = linearised(T, p_world, xy)
    x = np.linalg.solve(J.T @ J, -J.T @ residuals)
    R = exp_so3(x[3:])
    return motion(R @ T[:3, :3], R @ T[:3, 3] + x[:3])


@alternative
def about_the_origin_of_the_world(T: np.ndarray, p_world: np.ndarray, xy: np.ndarray) -> np.ndarray:
    """Turns R alone and shifts t alone, with a Jacobian for that."""
    q = p_world @ T[:3, :3].T
    p = q + T[:3, 3]
    z = p[:, 2:]
    D = np.zeros((len(p), 2, 3))
    D[:, 0, 0] = D[:, 1, 1] = 1 / z[:, 0]
    D[:, :, 2] = -p[:, :2] / z**2
    J = np.concatenate([D, np.cross(q[:, None, :], D)], axis=2).reshape(-1, 6)
    x = np.linalg.lstsq(J, -(p[:, :2] / z - xy).ravel(), rcond=None)[0]
    return motion(exp_so3(x[3:]) @ T[:3, :3], T[:3, 3] + x[:3])
