"""Corners found in pictures: of boards that are known, at every size, and of nothing else; and in
real photographs.
"""

from pathlib import Path

import numpy as np
import pytest
import scipy
from PIL import Image

from workbench.algorithms.cameras.calibration import calibrate
from workbench.data.views import boards
from workbench.data.views.board_corners import board_corners, refined
from workbench.geometry.cameras import project, resize_intrinsics
from workbench.geometry.cameras.raster import MeshItem, render

LEFT = [k for k in range(1, 15) if k != 10]


def taken(T_camera_board: np.ndarray, scale: int = 1, noise: float = 3.0) -> np.ndarray:
    """Return our board as a camera with our lens takes it: 2 x 2 rays a pixel, a little blurred,
    with noise.
    """
    w, h = 2 * scale * np.array(boards.SIZE)
    item = MeshItem(*boards.board_mesh())
    K = resize_intrinsics(boards.K_TRUE, 2.0 * scale, 2.0 * scale)
    fine = render(
        [item],
        T_camera_board,
        K,
        width=int(w),
        height=int(h),
        distortion=boards.LENS_TRUE,
        background=(150, 150, 150),
    ).colors
    image = fine[..., 0].reshape(h // 2, 2, w // 2, 2).mean(axis=(1, 3))
    image = scipy.ndimage.gaussian_filter(image, 0.7 * scale)
    image += noise * np.random.default_rng(0).normal(size=image.shape)
    return np.clip(np.rint(image), 0, 255).astype(np.uint8)


def poses(count: int, tilt: float, distance: float = 0.4) -> np.ndarray:
    return boards.board_poses(
        np.random.default_rng(1), count, tilt=np.radians(tilt), distance=distance, spread=1.0
    )


def off(corners: np.ndarray | None, uv: np.ndarray) -> float:
    """Return the rms distance, pixels, to the corners in the right order."""
    assert corners is not None
    return float(np.sqrt(np.square(corners - uv).sum(axis=1).mean()))


@pytest.mark.parametrize(("tilt", "distance"), [(0, 0.4), (20, 0.4), (40, 0.4), (30, 1.2)])
def test_every_board_is_found_with_its_first_corner_first(tilt, distance):
    p = boards.board_points()
    for T in poses(4, tilt, distance):
        assert (
            off(board_corners(taken(T), 9, 6), project(p, T, boards.K_TRUE, boards.LENS_TRUE))
            < 0.35
        )


def test_a_large_picture_and_one_of_few_pixels():
    T = poses(1, 20)[0]
    p = boards.board_points()
    uv = project(p, T, boards.K_TRUE, boards.LENS_TRUE)
    large = taken(T, scale=4)
    assert large.shape == (1920, 2560)
    assert off(board_corners(large, 9, 6), 4 * (uv + 0.5) - 0.5) < 0.3
    small = np.rint(taken(T).reshape(240, 2, 320, 2).mean(axis=(1, 3))).astype(np.uint8)
    assert off(board_corners(small, 9, 6), (uv + 0.5) / 2 - 0.5) < 0.2
    for size in ((320, 240), (1600, 1200), (3840, 2880)):
        whole = Image.fromarray(taken(T)).resize(size, Image.Resampling.BICUBIC)
        assert (
            off(board_corners(np.asarray(whole), 9, 6), (uv + 0.5) * size[0] / 640 - 0.5)
            < 0.15 * size[0] / 320
        )


@pytest.mark.parametrize(
    "change", [lambda g: np.rot90(g), lambda g: 255 - g, lambda g: g // 6, lambda g: g // 2 + 120]
)
def test_turned_negative_dark_or_pale(change):
    assert board_corners(np.ascontiguousarray(change(taken(poses(1, 20)[0]))), 9, 6) is not None


def test_a_board_of_another_shape_is_not_this_one():
    picture = taken(poses(1, 20)[0])
    assert board_corners(picture, 6, 9) is not None  # it is the same board
    for columns, rows in ((8, 6), (9, 5), (7, 5), (10, 6), (9, 7), (3, 3)):
        assert board_corners(picture, columns, rows) is None


def test_a_part_of_a_board_is_none():
    picture = taken(poses(1, 5)[0])
    uv = project(boards.board_points(), poses(1, 5)[0], boards.K_TRUE, boards.LENS_TRUE)
    picture[:, : int(uv[:, 0].min()) + 8] = 150
    assert board_corners(picture, 9, 6) is None


def test_nothing_is_found_where_nothing_is():
    rng = np.random.default_rng(0)
    for picture in (
        np.zeros((480, 640)),
        rng.uniform(0, 255, (480, 640)),
        np.indices((300, 400)).sum(axis=0) % 256,
        np.zeros((5, 5)),
        np.zeros((2000, 3)),
    ):
        assert board_corners(picture.astype(np.uint8), 4, 3) is None


def test_a_corner_without_gradients_stays_where_it_is():
    uv = np.array([[20.0, 20.0], [5.0, 30.0]])
    np.testing.assert_array_equal(refined(np.full((40, 40), 90, np.uint8), uv, 5), uv)


def test_real_pictures_beside_corners_that_were_found_by_opencv(shared_data: Path):
    """In windows as wide as theirs ours are the same; in narrower ones no view is bad any more."""
    folder = shared_data / "calibration"
    arrays = np.load(folder / "corners_9x6.npz")
    corners = []
    for k, theirs in zip(LEFT, arrays["left"], strict=True):
        picture = np.asarray(Image.open(folder / f"left{k:02}.jpg").convert("L"))
        ours = board_corners(picture, 9, 6)
        assert ours is not None
        corners.append(ours)
        wide = refined(picture, ours, 11)
        assert min(off(wide, theirs), off(wide[::-1], theirs)) < 0.001
    close = [
        min(off(ours, theirs), off(ours[::-1], theirs)) < 0.1
        for ours, theirs in zip(corners, arrays["left"], strict=True)
    ]
    assert sum(close) == 9
    p = arrays["object_points"].astype(float)
    for uv, rms, worst, f in (
        (arrays["left"].astype(float), 0.409, 1.22, 536.1),
        (np.stack(corners), 0.179, 0.24, 533.1),
    ):
        *_, end = calibrate(p, uv, (640, 480), coefficients=5)
        views = np.sqrt(np.square(end.residuals).sum(axis=2).mean(axis=1))
        assert np.sqrt(np.square(views).mean()) == pytest.approx(rms, abs=0.001)
        assert views.max() == pytest.approx(worst, abs=0.01)
        assert end.K is not None
        assert end.K[0, 0] == pytest.approx(f, abs=0.1)
