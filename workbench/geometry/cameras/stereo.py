"""Depth from a rectified pair of pictures: a disparity becomes a depth, a point, an error bar.

Conventions: both cameras look along +Z (OpenCV frame, metres), the right one stands `baseline`
metres along +X of the left one, rows correspond. What the left picture shows in column x is in
column x - d of the right one: the disparity d is positive, and grows towards the cameras. Where the
principal points differ, `doffs` = cx_right - cx_left, in pixels (Middlebury's word), and d + doffs
takes the place of d. At d + doffs = 0 the rays are parallel and what they see is infinitely far;
NaN, not 0, means unknown. f is in pixels of pictures of the size in which d was measured.
Reference: Szeliski, Computer Vision, 2nd ed., 12.1.1.
"""

import math
from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Float

from workbench.geometry.cameras.pinhole import back_project, intrinsics, resize_intrinsics


@dataclass(frozen=True)
class StereoCamera:
    """A rectified pair of cameras, seen from the left one: pixels, and the baseline in metres.

    Raises:
        ValueError: If the focal length or the baseline is not positive and finite.
    """

    f: float
    cx: float
    cy: float
    baseline: float
    doffs: float = 0.0

    def __post_init__(self) -> None:
        if not (0 < self.f < math.inf and 0 < self.baseline < math.inf):
            raise ValueError(
                f"f and baseline must be positive and finite, got {self.f} px and {self.baseline} m"
            )

    @property
    def K(self) -> Float[np.ndarray, "3 3"]:
        """The left camera's intrinsics."""
        return intrinsics(self.f, self.cx, self.cy)

    def depth(self, d: Float[np.ndarray, "..."]) -> Float[np.ndarray, "..."]:
        """Return the depths, metres, of disparities as they were measured, without doffs."""
        return depth_from_disparity(d + self.doffs, self.f, self.baseline)

    def shrunk(self, k: int) -> "StereoCamera":
        """Return the cameras of pictures with blocks of k x k pixels averaged."""
        K = resize_intrinsics(self.K, 1.0 / k, 1.0 / k)
        return StereoCamera(
            float(K[0, 0]), float(K[0, 2]), float(K[1, 2]), self.baseline, self.doffs / k
        )


def depth_from_disparity(
    d: Float[np.ndarray, "..."], f: float, baseline: float
) -> Float[np.ndarray, "..."]:
    """Return the depth Z = f B / d, metres, that a disparity stands for (Szeliski, eq. 12.1).

    Zero gives infinity, NaN stays NaN, and a negative disparity gives NaN: nothing causes one.

    Examples:
        >>> depth_from_disparity(np.array([50.0, 25.0, 0.0]), f=500.0, baseline=0.2).tolist()
        [2.0, 4.0, inf]
    """
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.where(d >= 0.0, f * baseline / np.abs(d), np.nan)


def disparity_from_depth(
    depth: Float[np.ndarray, "..."], f: float, baseline: float
) -> Float[np.ndarray, "..."]:
    """Return the disparity d = f B / Z, pixels, of points at these depths; infinity gives 0.

    Examples:
        >>> disparity_from_depth(np.array([2.0, np.inf]), 400.0, 0.1).tolist()
        [20.0, 0.0]
    """
    return f * baseline / depth


def depth_uncertainty(
    depth: Float[np.ndarray, "..."], f: float, baseline: float, *, disparity_error: float
) -> Float[np.ndarray, "..."]:
    """Return how far a small disparity error moves a depth: sigma_Z = Z² / (f B) sigma_d.

    To first order; `depth_interval` is exact.
    """
    return depth * depth / (f * baseline) * disparity_error


def depth_interval(
    d: Float[np.ndarray, "..."], f: float, baseline: float, *, disparity_error: float
) -> tuple[Float[np.ndarray, "..."], Float[np.ndarray, "..."]]:
    """Return the nearest and furthest depth within an error of a disparity, perhaps infinite."""
    near = depth_from_disparity(d + disparity_error, f, baseline)
    return near, depth_from_disparity(np.maximum(d - disparity_error, 0.0), f, baseline)


def depth_cloud(
    depth: Float[np.ndarray, "h w"], camera: StereoCamera
) -> tuple[Float[np.ndarray, "n 3"], Bool[np.ndarray, "h w"]]:
    """Return the points, in the left camera's frame, of pixels of finite depth, and the mask."""
    seen = np.isfinite(depth) & (depth > 0)
    v, u = np.nonzero(seen)
    return back_project(
        np.column_stack([u, v]).astype(float), depth[seen], np.eye(4), K=camera.K
    ), seen


def points_on_ray(
    uv: tuple[float, float], depth: Float[np.ndarray, " n"], camera: StereoCamera
) -> Float[np.ndarray, "n 3"]:
    """Return the points at these depths on the ray of one left pixel, in the left frame."""
    return back_project(
        np.broadcast_to(np.array(uv, float), (len(depth), 2)), depth, np.eye(4), K=camera.K
    )
