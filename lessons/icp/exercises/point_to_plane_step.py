"""Write one linear point-to-plane step: the small motion that brings points closest to the tangent
planes at their partners. The lesson uses it where its fit is point-to-plane: choose the preset
plane to watch yours.
"""

import numpy as np
from jaxtyping import Float

from lessons.icp.exercises import STUDENTS, a_motion
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
from workbench.geometry.motions import alignment, apply, exp_so3, motion, skew


@contract(
    slot="step",
    preset="plane",
    examples=(
        (
            (
                "point_to_plane_step(np.array([[9.0, 0, 0]]), np.array([[0.0, 0, 0]]),"
                " np.array([[0.0, 0, 1]]))"
            ),
            "[[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]",
        ),
        (
            (
                "point_to_plane_step(np.array([[9.0, 0, 0]]), np.array([[0.0, 0, 0.5]]),"
                " np.array([[0.0, 0, 1]]))"
            ),
            "[[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, -0.5], [0, 0, 0, 1]]",
        ),
    ),
)
def point_to_plane_step(
    p_target: Float[np.ndarray, "n 3"],
    p_source: Float[np.ndarray, "n 3"],
    n_target: Float[np.ndarray, "n 3"],
) -> Float[np.ndarray, "4 4"]:
    """Return the small rigid motion that brings points closest to the tangent planes at their
    partners.

    Solve the linear least-squares problem in the rotation vector w (radians) and the translation v
    (metres),

        sum of ((p_source + w x p_source + v - p_target) . n_target)^2,

    and return the motion that turns by |w| about w and shifts by v. You may count w from the origin
    or from the centroid of p_source, as long as the motion that you return is that of the points:
    near the solution both are the same.

    Args:
        p_target: A point on each plane, target frame, metres.
        p_source: The points to move, row k towards plane k; in the target frame too, moved by the
            motion so far.
        n_target: Unit normals of the planes, target frame. Either sign is right: n and -n are one
            plane.

    Returns:
        The 4x4 motion to be composed on the left, T_target_source = step @ T_target_source, with a
        proper rotation. Directions that the planes leave open (sliding along a single plane) get
        the smallest motion, none.
    """
    return alignment.point_to_plane_step(p_target, p_source, n_target)


STEP_HINT = "Each pair gives one row: (p_source x n, n) times (w, v) is (p_target - p_source) . n."


def planes(rng: np.random.Generator, n: int = 80) -> tuple[np.ndarray, np.ndarray]:
    """Return points and unit normals of a closed, uneven surface half a metre in size, aside from
    the origin.
    """
    n_target = rng.normal(size=(n, 3))
    n_target /= np.linalg.norm(n_target, axis=1, keepdims=True)
    return n_target * [0.6, 0.4, 0.25] + [0.2, -0.1, 0.3], n_target


def slid(
    rng: np.random.Generator, p: np.ndarray, normals: np.ndarray, metres: float = 0.1
) -> np.ndarray:
    """Return other points of the same planes: nearest neighbours are never the very same points."""
    return p + np.cross(normals, rng.normal(size=p.shape)) * metres


def arrived(
    candidate: Function, seed: int, degrees: float, metres: float, aside: float = 0.0
) -> Verdict:
    """Judge the motion that six steps make of a start that is this far off."""
    rng = np.random.default_rng(seed)
    p_true, n_target = planes(rng)
    p_true = p_true + np.array([aside, 0.0, 0.0])
    p_target = slid(rng, p_true, n_target)
    off = a_motion(rng, degrees, metres)
    c = p_true.mean(0)
    p_source = apply(off, p_true - c) + c
    T = np.eye(4)
    for _ in range(6):
        T = candidate(p_target, apply(T, p_source), n_target) @ T
        if not np.abs(T).max() < 1e9:
            most = number(np.abs(T).max(), 2)
            return fail(
                f"The steps run away: the largest number of T is {most}, right is below 10."
                f" {STEP_HINT}"
            )
    away = motion(off[:3, :3], c + off[:3, 3] - off[:3, :3] @ c)
    hint = f"T_left is the motion that is left after six steps. {STEP_HINT}"
    return motion_verdict(T @ away, np.eye(4), hint, p=p_true, name="T_left")


@check(1)
def shift_only(candidate: Function) -> Verdict:
    """Points that are only shifted come back in one step, though their partners lie elsewhere on
    the planes.
    """
    rng = np.random.default_rng(STUDENTS)
    p_true, n_target = planes(rng)
    right = motion(np.eye(3), np.array([0.03, -0.05, 0.08]))
    p_target = slid(rng, apply(right, p_true), n_target)
    return motion_verdict(candidate(p_target, p_true, n_target), right, STEP_HINT, p=p_true)


@check(3)
def steps_arrive(candidate: Function) -> Verdict:
    """Six steps from 12 degrees and 10 cm away arrive within 0.1 degrees and a millimetre."""
    return worst(arrived(candidate, STUDENTS + k, 12.0, 0.1) for k in range(2))


@check(1)
def planes_are_left_alone(candidate: Function) -> Verdict:
    """Points and normals are not changed."""
    rng = np.random.default_rng(STUDENTS + 3)
    p_true, n_target = planes(rng)
    p_source = apply(a_motion(rng, 1.0, 0.02), p_true)
    return left_alone(
        candidate, _stepped(candidate(p_true, p_source, n_target), p_true, p_source, n_target)
    )


def _stepped(
    step: np.ndarray, p_target: np.ndarray, p_source: np.ndarray, n_target: np.ndarray
) -> Verdict:
    right = alignment.point_to_plane_step(p_target, p_source, n_target)
    return motion_verdict(step, right, STEP_HINT, p=p_source)


def linear(
    p_source: np.ndarray, n_target: np.ndarray, gap: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Return (w, v) of least squares, w about the origin."""
    A = np.hstack([np.cross(p_source, n_target), n_target])
    x = np.linalg.lstsq(A, gap, rcond=1e-9)[0]
    return x[:3], x[3:]


def gaps(p_target: np.ndarray, p_source: np.ndarray, n_target: np.ndarray) -> np.ndarray:
    """Return the signed distances that are left along the normals."""
    return np.sum((p_target - p_source) * n_target, axis=1)


@mistake(
    "Your step goes away from the planes: the right side has the wrong sign. It is (p_target -"
    " p_source) · n."
)
def sign_of_the_gap(p_target: np.ndarray, p_source: np.ndarray, n_target: np.ndarray) -> np.ndarray:
    """Moves away from the planes."""
    w, v = linear(p_source, n_target, -gaps(p_target, p_source, n_target))
    return motion(exp_so3(w), v)


@mistake(
    "Your translation is right and your rotation turns backwards. (w x p) · n = w · (p x n), so the"
    " rows hold p x n and not n x p; and R turns by w, its transpose by -w."
)
def cross_product_turned_round(
    p_target: np.ndarray, p_source: np.ndarray, n_target: np.ndarray
) -> np.ndarray:
    """Uses n x p for p x n."""
    w, v = linear(p_source, n_target, gaps(p_target, p_source, n_target))
    return motion(exp_so3(-w), v)


@mistake(
    "You aligned the points themselves. Only the distance along the normal counts: sliding along a"
    " plane costs nothing."
)
def point_to_point(p_target: np.ndarray, p_source: np.ndarray, n_target: np.ndarray) -> np.ndarray:
    """Does not use the normals."""
    return alignment.align_rigid(p_target, p_source)


@mistake(
    "You returned I + [w]x, which stretches the cloud at every step. Return the rotation by |w|"
    " about w."
)
def no_proper_rotation(
    p_target: np.ndarray, p_source: np.ndarray, n_target: np.ndarray
) -> np.ndarray:
    """Returns I + [w]x."""
    w, v = linear(p_source, n_target, gaps(p_target, p_source, n_target))
    return motion(np.eye(3) + skew(w), v)


@mistake(
    "You left the rotation out. There are six unknowns: three of rotation, w, and three of"
    " translation, v."
)
def translation_only(
    p_target: np.ndarray, p_source: np.ndarray, n_target: np.ndarray
) -> np.ndarray:
    """Leaves the rotation out."""
    v = np.linalg.lstsq(n_target, gaps(p_target, p_source, n_target), rcond=1e-9)[0]
    return motion(np.eye(3), v)


@mistake(
    "All is right but where the planes leave a direction open: your 6×6 system is singular there."
    " Use least squares with the smallest norm (np.linalg.lstsq)."
)
def singular(p_target: np.ndarray, p_source: np.ndarray, n_target: np.ndarray) -> np.ndarray:
    """Solves the normal equations as if the planes held everything."""
    A = np.hstack([np.cross(p_source, n_target), n_target])
    x = np.linalg.solve(A.T @ A, A.T @ gaps(p_target, p_source, n_target))
    return motion(exp_so3(x[:3]), x[3:])


@mistake(
    "You turn about the centroid, but your motion turns about the origin. Add c - R c to the"
    " translation."
)
def centroid_forgotten(
    p_target: np.ndarray, p_source: np.ndarray, n_target: np.ndarray
) -> np.ndarray:
    """Turns about the centroid and forgets to say so in t."""
    w, v = linear(p_source - p_source.mean(0), n_target, gaps(p_target, p_source, n_target))
    return motion(exp_so3(w), v)


@alternative
def step_about_the_origin(
    p_target: np.ndarray, p_source: np.ndarray, n_target: np.ndarray
) -> np.ndarray:
    """Low's product of three turns, about the origin."""
    A = np.hstack([np.cross(p_source, n_target), n_target])
    gap = np.sum((p_target - p_source) * n_target, axis=1)
    a, b, c, *v = np.linalg.lstsq(A, gap, rcond=1e-9)[0]
    Rx = np.array([[1, 0, 0], [0, np.cos(a), -np.sin(a)], [0, np.sin(a), np.cos(a)]])
    Ry = np.array([[np.cos(b), 0, np.sin(b)], [0, 1, 0], [-np.sin(b), 0, np.cos(b)]])
    Rz = np.array([[np.cos(c), -np.sin(c), 0], [np.sin(c), np.cos(c), 0], [0, 0, 1]])
    T = np.eye(4)
    T[:3, :3] = Rz @ Ry @ Rx
    T[:3, 3] = v
    return T


@alternative
def step_by_pseudo_inverse(
    p_target: np.ndarray, p_source: np.ndarray, n_target: np.ndarray
) -> np.ndarray:
    """Normal equations about the centroid, pseudo-inverse, and the rotation from the SVD of I +
    [w]x.
    """
    c = p_source.mean(axis=0)
    A = np.hstack([np.cross(p_source - c, n_target), n_target])
    x = np.linalg.pinv(A.T @ A, rcond=1e-10, hermitian=True) @ (
        A.T @ gaps(p_target, p_source, n_target)
    )
    W = np.array([[1, -x[2], x[1]], [x[2], 1, -x[0]], [-x[1], x[0], 1]])
    U, _, Vt = np.linalg.svd(W)
    T = np.eye(4)
    T[:3, :3] = U @ Vt
    T[:3, 3] = c + x[3:] - U @ Vt @ c
    return T
