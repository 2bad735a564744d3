"""Calibrates a camera from pictures of a flat board: homographies, K and poses, then all together.

Reference: Zhang, A Flexible New Technique for Camera Calibration, PAMI 2000, section 3.4.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from typing import Literal

import numpy as np
from jaxtyping import Float

from workbench.algorithms.least_squares.board_adjustment import Adjustment, adjust
from workbench.geometry.cameras import calibration, intrinsics
from workbench.geometry.cameras.distortion import NONE, Distortion, distort
from workbench.geometry.motions import apply, motion
from workbench.geometry.motions.alignment import nearest_rotation
from workbench.geometry.two_views.homography import fit_homography, transform_pixels
from workbench.tracing import traced

Phase = Literal["homography", "constraints", "poses", "lens", "refine"]
Rows = Callable[[np.ndarray], np.ndarray]
Pose = Callable[[np.ndarray, np.ndarray], np.ndarray]


@dataclass(frozen=True, eq=False, kw_only=True)
class State:
    """What is known after a step.

    Attributes:
        phase: "homography" of the first view; "constraints" of one view more; "poses" of all views;
            a linear "lens"; and the joint refinement.
        Hs_image_board: Homographies of the views so far, metres to pixels.
        rows: Their constraints, in coordinates in which the picture is one wide with 0 in its
            middle.
        singular_values: Of these rows, without the column of the skew.
        K: None where the rows determine none.
        guessed: Whether K is a guess, because the closed form found no camera.
        Ts_camera_board: Of all views; none before the poses.
        residuals: Projected minus measured, pixels; by each view's own homography before the poses.
    """

    phase: Phase
    Hs_image_board: Float[np.ndarray, "m 3 3"]
    rows: Float[np.ndarray, "r 6"] = field(default_factory=lambda: np.empty((0, 6)))
    singular_values: Float[np.ndarray, " s"] = field(default_factory=lambda: np.empty(0))
    K: Float[np.ndarray, "3 3"] | None = None
    guessed: bool = False
    lens: Distortion = NONE
    Ts_camera_board: Float[np.ndarray, "k 4 4"] = field(default_factory=lambda: np.empty((0, 4, 4)))
    residuals: Float[np.ndarray, "m n 2"]
    adjustment: Adjustment | None = None


@traced
def calibrate(
    p_board: Float[np.ndarray, "n 3"],
    uv: Float[np.ndarray, "k n 2"],
    size: tuple[int, int],
    *,
    constraint_rows: Rows = calibration.constraint_rows,
    pose_from_homography: Pose = calibration.pose_from_homography,
    coefficients: int = 5,
    corner: float | None = None,
    max_iterations: int = 60,
    tolerance: float = 1e-10,
) -> Iterator[State]:
    """Yield the steps of Zhang's calibration.

    Where no camera has these constraints (boards all alike, or too much noise), or one with its
    principal point outside the picture or with a focal length below a third of its width, f is
    guessed as the picture's width.

    Args:
        p_board: In the board's frame, metres, Z = 0.
        size: Width and height of the pictures, pixels.
        coefficients: How many of k1, k2, p1, p2, k3 are estimated.
        corner: Of Cauchy's loss, pixels; squares if None.

    Raises:
        ValueError: If there are fewer than two views, or fewer than four points.
    """
    if len(uv) < 2:
        raise ValueError(f"two views at least are needed, not {len(uv)}")
    w, h = size
    N = np.array([[1 / w, 0, -0.5], [0, 1 / w, -0.5 * h / w], [0, 0, 1]])
    Hs = np.empty((0, 3, 3))
    rows = np.empty((0, 6))
    residuals = np.empty((0, *uv.shape[1:]))
    K = None
    for i, uv_view in enumerate(uv):
        H = fit_homography(p_board[:, :2], uv_view)
        off = transform_pixels(H, p_board[:, :2]) - uv_view
        Hs, residuals = np.concatenate([Hs, H[None]]), np.concatenate([residuals, off[None]])
        if i == 0:
            yield State(phase="homography", Hs_image_board=Hs, residuals=residuals)
        G = N @ H
        rows = np.concatenate([rows, constraint_rows(G / np.linalg.norm(G[:, 0]))])
        singular_values = np.linalg.svd(rows[:, [0, 2, 3, 4, 5]], compute_uv=False)
        K = _in_pixels(N, calibration.intrinsics_from_constraints(rows))
        yield State(
            phase="constraints",
            Hs_image_board=Hs,
            rows=rows,
            singular_values=singular_values,
            K=K,
            residuals=residuals,
        )
    guessed = not _is_likely(K, size)
    if K is None or guessed:
        K = intrinsics(float(w), (w - 1) / 2, (h - 1) / 2)
    Ts = np.stack([pose_from_homography(K, H) for H in Hs])
    lens = NONE
    first = residuals_of(K, NONE, Ts, p_board=p_board, uv=uv)
    yield State(
        phase="poses",
        Hs_image_board=Hs,
        rows=rows,
        K=K,
        guessed=guessed,
        Ts_camera_board=Ts,
        residuals=first,
    )
    Ts_begin = np.stack([motion(nearest_rotation(T[:3, :3]), T[:3, 3]) for T in Ts])
    if coefficients:
        radial = calibration.linear_lens(K, Ts_begin, p_board, uv=uv, terms=min(coefficients, 2))
        lens = Distortion(*radial.tolist())
        bent = residuals_of(K, lens, Ts_begin, p_board=p_board, uv=uv)
        yield State(
            phase="lens",
            Hs_image_board=Hs,
            K=K,
            guessed=guessed,
            lens=lens,
            Ts_camera_board=Ts_begin,
            residuals=bent,
        )
    refinement = adjust(
        K,
        lens,
        Ts_begin,
        p_board=p_board,
        uv=uv,
        coefficients=coefficients,
        corner=corner,
        max_iterations=max_iterations,
        tolerance=tolerance,
    )
    for state in refinement:
        if state.iteration:
            yield State(
                phase="refine",
                Hs_image_board=Hs,
                K=state.K,
                lens=state.lens,
                Ts_camera_board=state.Ts_camera_board,
                residuals=state.residuals,
                adjustment=state,
            )


def residuals_of(
    K: Float[np.ndarray, "3 3"],
    lens: Distortion,
    Ts_camera_board: Float[np.ndarray, "k 4 4"],
    *,
    p_board: Float[np.ndarray, "n 3"],
    uv: Float[np.ndarray, "k n 2"],
) -> Float[np.ndarray, "k n 2"]:
    """Return projected minus measured pixels of all views, also of boards behind the camera."""
    with np.errstate(divide="ignore", invalid="ignore"):
        p = np.concatenate([apply(T, p_board) for T in Ts_camera_board])
        xy = distort(p[:, :2] / p[:, 2:], *lens)
    return (xy @ K[:2, :2].T + K[:2, 2]).reshape(uv.shape) - uv


def _is_likely(K: np.ndarray | None, size: tuple[int, int]) -> bool:
    if K is None:
        return False
    w, h = size
    u, v = K[:2, 2]
    return bool(0 < u < w and 0 < v < h and min(K[0, 0], K[1, 1]) > w / 3)


def _in_pixels(N: np.ndarray, K: np.ndarray | None) -> np.ndarray | None:
    """Return the camera of the pixels themselves, from that of coordinates `N` takes them to."""
    if K is None:
        return None
    K_pixels = np.linalg.inv(N) @ K
    return K_pixels / K_pixels[2, 2]
