"""Write where a board stands, from its homography and the camera. Your poses are drawn at the step
that places the boards: see whether they stand before the camera, and where the refinement goes from
there.
"""

import numpy as np
import scipy
from jaxtyping import Float

from lessons.calibration.exercises import CAMERA, STUDENTS, views
from workbench.exercise import (
    Function,
    Verdict,
    alternative,
    band,
    beside,
    check,
    contract,
    left_alone,
    mistake,
    motion_verdict,
    worst,
)
from workbench.geometry.cameras import calibration
from workbench.geometry.motions import inverse, motion


@contract(
    slot="pose_from_homography",
    examples=(
        (
            "pose_from_homography(np.eye(3), np.array([[1.0, 0, 0.2], [0, 1, 0.1], [0, 0, 0.5]]))",
            "[[1, 0, 0, 0.2], [0, 1, 0, 0.1], [0, 0, 1, 0.5], [0, 0, 0, 1]]",
        ),
        (
            (
                "pose_from_homography(np.diag([2.0, 2, 1]), np.array([[0.0, 4, -2], [-4, 0, 0], [0,"
                " 0, -2]]))"
            ),
            "[[0, -1, 0, 0.5], [1, 0, 0, 0], [0, 0, 1, 1], [0, 0, 0, 1]]",
        ),
    ),
)
def pose_from_homography(
    K: Float[np.ndarray, "3 3"], H: Float[np.ndarray, "3 3"]
) -> Float[np.ndarray, "4 4"]:
    """Return T_camera_board, metres: the board's pose before the camera.

    H ~ K [r1 r2 t] up to a scale of either sign. r1 and r2 are unit vectors. The board's origin is
    before the camera: t_z > 0. It may show its front or its back.

    Args:
        K: Intrinsics, pixels.
        H: Takes (X, Y, 1) on the board, metres, to pixels. Noise leaves its r1 and r2 not quite
            orthonormal.

    Returns:
        A rigid motion, also with noise: its R has R^T R = I and determinant +1. The inputs stay as
        they are.
    """
    return calibration.pose_from_homography(K, H)


HINT = "K⁻¹ H = λ [r1 r2 t]: find λ with its sign, r3 = r1 × r2, then the nearest rotation."
BOARD = np.array([[0.0, 0, 0], [0.2, 0, 0], [0.2, 0.125, 0], [0, 0.125, 0]])


def posed(candidate: Function, seed: int, count: int = 3) -> Verdict:
    """Judge poses of exact homographies."""
    return worst(
        motion_verdict(candidate(CAMERA, H), T, HINT, p=BOARD) for T, H in views(seed, count)
    )


@check(2)
def exact_views(candidate: Function) -> Verdict:
    """From exact homographies of any scale and sign the poses come back."""
    return posed(candidate, STUDENTS)


@check(2)
def noisy_views_give_rotations(candidate: Function) -> Verdict:
    """With noise in H, R is still a rotation, and near the true one."""
    return rotations(candidate, STUDENTS + 10)


def rotations(candidate: Function, seed: int) -> Verdict:
    """Judge whether R is a rotation where H has noise, and near the true one."""
    verdicts = []
    for T_right, H in views(seed, 4, noise=3e-3):
        T = candidate(CAMERA, H)
        Q = T[:3, :3].T @ T[:3, :3]
        told = beside(Q, np.eye(3), HINT, "RᵀR")
        verdicts.append(
            band(
                "RᵀR differs from I by",
                float(np.abs(Q - np.eye(3)).max()),
                "",
                good=1e-6,
                fair=1e-5,
                hint=told,
            )
        )
        verdicts.append(
            motion_verdict(T, T_right, HINT, p=BOARD, degrees=(4.0, 8.0), metres=(0.03, 0.06))
        )
    return worst(verdicts)


@check(1)
def inputs_are_left_alone(candidate: Function) -> Verdict:
    """K and H are not changed."""
    return left_alone(candidate, posed(candidate, STUDENTS + 20, 1))


def _parts(K: np.ndarray, H: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return r1, r2 and t, scaled by r1 alone as most do, and signed."""
    A = np.linalg.solve(K, H)
    A = A * np.copysign(1 / np.linalg.norm(A[:, 0]), A[2, 2])
    return A[:, 0], A[:, 1], A[:, 2]


def _rotation(Q: np.ndarray) -> np.ndarray:
    U, _, Vt = np.linalg.svd(Q)
    return U @ Vt


@mistake(
    "You left the sign of λ as it came. Of the two signs only one has the board before the camera:"
    " t_z > 0."
)
def sign_as_it_came(K: np.ndarray, H: np.ndarray) -> np.ndarray:
    """λ always positive."""
    r1, r2, t = (
        _parts(K, H) if np.linalg.solve(K, H)[2, 2] > 0 else tuple(-part for part in _parts(K, H))
    )
    return motion(_rotation(np.column_stack([r1, r2, np.cross(r1, r2)])), t)


@mistake(
    "Your R is not orthonormal where H has noise. Take the nearest rotation: U Vᵀ of its singular"
    " value decomposition."
)
def not_orthonormal(K: np.ndarray, H: np.ndarray) -> np.ndarray:
    """[r1 r2 r1 × r2] as they are."""
    r1, r2, t = _parts(K, H)
    return motion(np.column_stack([r1, r2, np.cross(r1, r2)]), t)


@mistake(
    "Your r3 is r2 × r1: R has determinant −1, a mirror image. A right-handed frame has r3 = r1"
    " × r2."
)
def mirrored(K: np.ndarray, H: np.ndarray) -> np.ndarray:
    """r3 = r2 × r1."""
    r1, r2, t = _parts(K, H)
    return motion(_rotation(np.column_stack([r1, r2, np.cross(r2, r1)])), t)


@mistake(
    "Your t is not scaled by λ. The scale that makes r1 and r2 unit vectors belongs to the whole of"
    " K⁻¹ H."
)
def t_unscaled(K: np.ndarray, H: np.ndarray) -> np.ndarray:
    """Takes t as it comes out of K^-1 H."""
    r1, r2, _ = _parts(K, H)
    t = np.linalg.solve(K, H)[:, 2]
    return motion(
        _rotation(np.column_stack([r1, r2, np.cross(r1, r2)])), np.copysign(1.0, t[2]) * t
    )


@mistake(
    "You scaled so that t is one long. It is r1 and r2 that are unit vectors; t keeps its metres."
)
def t_of_length_one(K: np.ndarray, H: np.ndarray) -> np.ndarray:
    """Divides t by its length."""
    r1, r2, t = _parts(K, H)
    return motion(_rotation(np.column_stack([r1, r2, np.cross(r1, r2)])), t / np.linalg.norm(t))


@mistake(
    "You returned T_board_camera. The contract asks for T_camera_board, which takes points of the"
    " board to the camera."
)
def inverted(K: np.ndarray, H: np.ndarray) -> np.ndarray:
    """The inverse."""
    return inverse(calibration.pose_from_homography(K, H))


@mistake("You did not take K off: H is K [r1 r2 t], so begin with K⁻¹ H.")
def without_k(K: np.ndarray, H: np.ndarray) -> np.ndarray:
    """As if K were the identity."""
    r1, r2, t = _parts(np.eye(3), H)
    return motion(_rotation(np.column_stack([r1, r2, np.cross(r1, r2)])), t)


@mistake("Your R is transposed: r1 and r2 are its columns, not its rows.")
def transposed(K: np.ndarray, H: np.ndarray) -> np.ndarray:
    """R^T with the right t."""
    T = calibration.pose_from_homography(K, H)
    return motion(T[:3, :3].T, T[:3, 3])


@alternative
def by_gram_schmidt(K: np.ndarray, H: np.ndarray) -> np.ndarray:
    """r1 as it is, and what of r2 is at right angles to it."""
    A = np.linalg.inv(K) @ H
    A = A / (np.sqrt(np.linalg.norm(A[:, 0]) * np.linalg.norm(A[:, 1])) * np.sign(A[2, 2]))
    r1 = A[:, 0] / np.linalg.norm(A[:, 0])
    r2 = A[:, 1] - (A[:, 1] @ r1) * r1
    r2 /= np.linalg.norm(r2)
    return np.block(
        [
            [np.column_stack([r1, r2, np.cross(r1, r2)]), A[:, 2:]],
            [np.zeros((1, 3)), np.ones((1, 1))],
        ]
    )


@alternative
def by_polar_decomposition(K: np.ndarray, H: np.ndarray) -> np.ndarray:
    """Scipy's polar factor, scaled by r1 alone as in Zhang's paper."""
    A = np.linalg.inv(K) @ H
    A = A / (np.linalg.norm(A[:, 0]) * np.sign(A[2, 2]))
    R, _ = scipy.linalg.polar(np.column_stack([A[:, 0], A[:, 1], np.cross(A[:, 0], A[:, 1])]))
    T = np.eye(4)
    T[:3, :3] = R
    T[:3, 3] = A[:, 2]
    return T
