"""Rectified pairs: made ones with known disparities, the Middlebury motorcycle, people's."""

import functools
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from jaxtyping import Bool, Float, Int, UInt8

from workbench.data.files import read_image, shipped_array, shipped_image
from workbench.data.views.stereo_scenes import SCENES, Thing, look, nearest_depth, rays
from workbench.errors import InputError
from workbench.geometry.cameras.stereo import StereoCamera

MOST_PIXELS = 16_000_000


@dataclass(frozen=True, eq=False)
class StereoPair:
    """Two RGB pictures of which rows correspond, and what is known of them.

    Attributes:
        disparity: The true one of left pixels, NaN where unknown; None without truth.
        visible: Which left pixels the right camera sees too; None where it is not known.
    """

    left: UInt8[np.ndarray, "h w 3"]
    right: UInt8[np.ndarray, "h w 3"]
    camera: StereoCamera
    disparity: Float[np.ndarray, "h w"] | None = None
    visible: Bool[np.ndarray, "h w"] | None = None


def grey(picture: UInt8[np.ndarray, "h w 3"]) -> Float[np.ndarray, "h w"]:
    """Return the brightness of an RGB picture, 0 .. 255 (weights of ITU-R BT.601)."""
    r, g, b = np.moveaxis(picture.astype(float), -1, 0)
    return 0.299 * r + 0.587 * g + 0.114 * b  # a product of matrices rounds otherwise elsewhere


@dataclass(frozen=True, eq=False, kw_only=True)
class StereoViews:
    """What two cameras see of a scene, 0 .. 255, before their noise.

    Attributes:
        left, right: What they see.
        noise: Of each camera's picture, with a standard deviation of 1.
        camera: They.
        disparity, visible: As of a `StereoPair`.
    """

    left: Float[np.ndarray, "h w 3"]
    right: Float[np.ndarray, "h w 3"]
    noise: Float[np.ndarray, "2 h w 3"]
    camera: StereoCamera
    disparity: Float[np.ndarray, "h w"]
    visible: Bool[np.ndarray, "h w"]

    def exposed(self, noise: float) -> StereoPair:
        """Return the pair of pictures with so much noise, in grey levels of 255."""
        left, right = (
            _exposed(picture + noise * own)
            for picture, own in zip((self.left, self.right), self.noise, strict=True)
        )
        return StereoPair(left, right, self.camera, self.disparity, self.visible)


def synthetic_views(
    scene: str, camera: StereoCamera, size: tuple[int, int], *, rng: np.random.Generator
) -> StereoViews:
    """Look at a scene in `SCENES` with two cameras, with exact disparities.

    A left pixel is visible in the right picture when its point lies inside that and nothing stands
    nearer on the way to it.
    """
    things = SCENES[scene](rng, 1.0 / camera.f)
    u, v = _pixels(size)
    p_right = np.array([camera.baseline, 0.0, 0.0])
    depth, left = look(things, np.zeros(3), rays(u, v, camera.f, cx=camera.cx, cy=camera.cy))
    _, right = look(
        things, p_right, rays(u, v, camera.f, cx=camera.cx + camera.doffs, cy=camera.cy)
    )
    d = camera.f * camera.baseline / depth  # without doffs
    return StereoViews(
        left=left,
        right=right,
        noise=rng.standard_normal((2, *left.shape)),
        camera=camera,
        disparity=d - camera.doffs,
        visible=_seen_by_both(things, camera, depth),
    )


def shares_hidden(
    scene: str, cameras: Sequence[StereoCamera], size: tuple[int, int]
) -> Float[np.ndarray, " n"]:
    """Return the share of left pixels that the right camera does not see, of cameras that differ in
    nothing but the baseline: as of `synthetic_views`, from the depths alone.
    """
    left = cameras[0]
    things = SCENES[scene](np.random.default_rng(0), 1.0 / left.f)  # which colours is all the same
    u, v = _pixels(size)
    depth = nearest_depth(things, np.zeros(3), rays(u, v, left.f, cx=left.cx, cy=left.cy))
    return np.array([1.0 - _seen_by_both(things, camera, depth).mean() for camera in cameras])


def _pixels(size: tuple[int, int]) -> list[np.ndarray]:
    w, h = size
    return list(np.meshgrid(np.arange(w, dtype=float), np.arange(h, dtype=float)))


def _seen_by_both(
    things: tuple[Thing, ...], camera: StereoCamera, depth: Float[np.ndarray, "h w"]
) -> Bool[np.ndarray, "h w"]:
    """Say of which left pixels, of these depths, the right camera sees the point too."""
    h, w = depth.shape
    u, v = _pixels((w, h))
    p_right = np.array([camera.baseline, 0.0, 0.0])
    d = camera.f * camera.baseline / depth  # without doffs
    behind = nearest_depth(things, p_right, rays(u - d, v, camera.f, cx=camera.cx, cy=camera.cy))
    partner = u - (d - camera.doffs)
    return (
        (partner >= 0)
        & (partner <= w - 1)
        & ((behind >= depth * (1 - 1e-9)) | np.isinf(depth) & np.isinf(behind))
    )


@functools.lru_cache(maxsize=1)
def motorcycle_pair() -> StereoPair:
    """Return the Middlebury 2014 motorcycle of scikit-image, 741 x 500 pixels, true to 0.1 px.

    Reference: Scharstein et al., High-resolution stereo datasets with subpixel-accurate ground
    truth, GCPR 2014.
    """
    pair = motorcycle()
    assert pair.disparity is not None
    return replace(pair, visible=in_both(pair.disparity))


@functools.lru_cache(maxsize=1)
def motorcycle() -> StereoPair:
    """Return `motorcycle_pair` without what is visible in both pictures, which takes a while."""
    left, right = (shipped_image(f"motorcycle_{side}.png") for side in ("left", "right"))
    disparity = shipped_array("motorcycle_disp.npz")
    camera = StereoCamera(f=994.978, cx=311.193, cy=254.877, baseline=0.193001, doffs=31.086)
    d = np.where(np.isfinite(disparity), disparity, np.nan).astype(float)
    return StereoPair(left, right, camera, d)


def read_pair(
    left: Path, right: Path, f: float, *, baseline: float, doffs: float = 0.0
) -> StereoPair:
    """Return a rectified pair from two image files; grey ones become RGB.

    Args:
        f: Focal length, pixels of these files.
        baseline: Metres.
        doffs: cx_right - cx_left, pixels; the left principal point is taken to be in the middle.

    Raises:
        InputError: If a file is missing, no image, too large, or the two differ in size.
    """
    first, second = _rgb(left), _rgb(right)
    if first.shape != second.shape:
        raise InputError(
            f"the two pictures of a rectified pair have the same size: {Path(left).name} is"
            f" {first.shape[1]} x {first.shape[0]} pixels, {Path(right).name} {second.shape[1]} x"
            f" {second.shape[0]}"
        )
    h, w = first.shape[:2]
    return StereoPair(first, second, StereoCamera(f, (w - 1) / 2, (h - 1) / 2, baseline, doffs))


def shrunk(pair: StereoPair, k: int) -> StereoPair:
    """Return the pair with every block of k x k pixels averaged; f, doffs and disparities too.

    What is left over at the right and lower border is cut off. A block's true disparity is that of
    the pixel in its middle: the mean over an edge would be the depth of nothing.

    Raises:
        InputError: If the pictures are smaller than one block.
    """
    h, w = (side // k for side in pair.left.shape[:2])
    if min(h, w) < 1:
        raise InputError(
            f"pictures of {pair.left.shape[1]} x {pair.left.shape[0]} pixels cannot shrink {k}"
            " times"
        )
    if k == 1:
        return pair

    def averaged(picture: np.ndarray) -> np.ndarray:
        rows = np.zeros((h, w * k, 3), dtype=np.uint32)
        for row in range(k):
            rows += picture[row : h * k : k, : w * k]
        blocks = np.zeros((h, w, 3), dtype=np.uint32)
        for column in range(k):
            blocks += rows[:, column::k]
        return np.rint(blocks.astype(np.float32) / k**2).astype(np.uint8)

    middle = (slice(k // 2, h * k, k), slice(k // 2, w * k, k))
    return replace(
        pair,
        left=averaged(pair.left),
        right=averaged(pair.right),
        camera=pair.camera.shrunk(k),
        disparity=None if pair.disparity is None else pair.disparity[middle] / k,
        visible=None if pair.visible is None else pair.visible[middle],
    )


def in_both(disparity: Float[np.ndarray, "h w"], tolerance: float = 1.0) -> Bool[np.ndarray, "h w"]:
    """Say which left pixels both cameras see, judged from the true left disparities alone.

    Of all left pixels that land on one right pixel, those within `tolerance` pixels of the largest
    disparity are seen; none that land outside, and none that are unknown.
    """
    h, w = disparity.shape
    known = np.isfinite(disparity)
    partner = np.rint(np.arange(w) - np.where(known, disparity, 0)).astype(np.intp)
    inside = known & (partner >= 0) & (partner < w)
    cell: Int[np.ndarray, "h w"] = np.arange(h)[:, None] * w + np.clip(partner, 0, w - 1)
    nearest = np.full(h * w, -np.inf)
    np.maximum.at(nearest, cell[inside], disparity[inside])
    return inside & (np.where(known, disparity, -np.inf) >= nearest[cell] - tolerance)


def _rgb(path: Path) -> UInt8[np.ndarray, "h w 3"]:
    picture = read_image(path)
    h, w = picture.shape[:2]
    if h * w > MOST_PIXELS:
        raise InputError(
            f"{Path(path).name}: {w} x {h} pixels; a pair may have at most {MOST_PIXELS:,} each:"
            " make it smaller first"
        )
    return picture if picture.ndim == 3 else np.repeat(picture[:, :, None], 3, axis=2)


def _exposed(picture: Float[np.ndarray, "h w 3"]) -> UInt8[np.ndarray, "h w 3"]:
    return np.rint(np.clip(picture, 0, 255)).astype(np.uint8)
