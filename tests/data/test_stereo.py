"""Stereo pairs: made ones agree with their truth, and files that cannot be a pair are refused in
one line.
"""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
import scipy
from PIL import Image

from workbench.data.views import stereo
from workbench.data.views.stereo import (
    grey,
    in_both,
    motorcycle_pair,
    read_pair,
    shares_hidden,
    shrunk,
    synthetic_views,
)
from workbench.data.views.stereo_scenes import SCENES
from workbench.errors import InputError
from workbench.geometry.cameras.stereo import StereoCamera, depth_from_disparity

CAMERA = StereoCamera(150.0, 79.5, 59.5, 0.1)


def made(scene, camera=CAMERA, noise=0.0, *, seed=0) -> Any:
    return synthetic_views(scene, camera, (160, 120), rng=np.random.default_rng(seed)).exposed(
        noise
    )


@pytest.mark.parametrize("doffs", [0.0, 4.0])
@pytest.mark.parametrize("scene", SCENES)
def test_the_right_picture_shows_what_the_truth_says(scene, doffs):
    pair = made(scene, StereoCamera(300.0, 79.5, 59.5, 0.1, doffs))
    v, u = np.nonzero(pair.visible & inner(pair.disparity))
    assert len(u) > 5000
    right = scipy.ndimage.map_coordinates(grey(pair.right), [v, u - pair.disparity[v, u]], order=1)
    difference = np.abs(right - grey(pair.left)[v, u])
    assert np.median(difference) < 3.0
    assert np.percentile(difference, 98) < 25.0


def inner(disparity):
    """Return pixels whose neighbours lie on the same surface."""
    spread = scipy.ndimage.maximum_filter(disparity, 5) - scipy.ndimage.minimum_filter(disparity, 5)
    return spread < 1.0


@pytest.mark.parametrize("scene", SCENES)
def test_what_is_hidden_is_nearer_in_the_right_picture(scene):
    pair = made(scene)
    v, u = np.nonzero(~pair.visible)
    landing = u - pair.disparity[v, u]
    inside = landing >= 0
    nearest = np.full((120, 161), -np.inf)
    rows, columns = np.nonzero(pair.visible)
    np.maximum.at(
        nearest,
        (rows, np.rint(columns - pair.disparity[rows, columns]).astype(int)),
        pair.disparity[rows, columns],
    )
    hidden_by = scipy.ndimage.maximum_filter(nearest, (3, 3))[
        v[inside], np.rint(landing[inside]).astype(int)
    ]
    assert inside.any() == (scene != "repeated pattern")
    assert (hidden_by > pair.disparity[v, u][inside]).sum() >= 0.97 * inside.sum()
    assert (
        in_both(pair.disparity) == pair.visible
    ).mean() > 0.97  # judged from rounded pixels it is nearly the same


@pytest.mark.parametrize("scene", SCENES)
def test_what_is_hidden_needs_no_colours(scene):
    cameras = [replace(CAMERA, baseline=baseline) for baseline in (0.05, 0.1, 0.3)]
    pairs = [made(scene, camera, noise=4.0, seed=3) for camera in cameras]
    shares = shares_hidden(scene, cameras, (160, 120))
    assert shares.tolist() == [1.0 - pair.visible.mean() for pair in pairs]


def test_a_plane_is_linear_in_disparity_and_boards_are_where_they_say():
    wall = made("planes").disparity[:80, :45]
    assert np.abs(np.diff(wall, 2, axis=1)).max() < 1e-9
    assert np.abs(np.diff(wall, axis=1)).min() > 1e-3
    pair = made("boards at three depths", StereoCamera(700.0, 79.5, 59.5, 0.12))
    depth = depth_from_disparity(pair.disparity, 700.0, 0.12)
    depths, count = np.unique(np.round(depth, 9), return_counts=True)
    assert depths.tolist() == [1.0, 5.0, 20.0, np.inf]
    assert count.min() > 1500
    assert pair.visible[np.isfinite(depth)].mean() > 0.95


def test_the_ball_bulges_as_a_sphere_does():
    depth = depth_from_disparity(made("spheres").disparity, CAMERA.f, CAMERA.baseline)
    u = round(79.5 + 150 * -0.28 / 1.25)
    v = round(59.5 + 150 * 0.17 / 1.25)
    ray = np.array([(u - 79.5) / 150, (v - 59.5) / 150, 1.0])
    assert np.linalg.norm(depth[v, u] * ray - [-0.28, 0.17, 1.25]) == pytest.approx(0.3, abs=1e-9)


def test_seeds_decide_and_noise_differs_between_the_pictures():
    first, same, other = made("planes", seed=1), made("planes", seed=1), made("planes", seed=2)
    assert np.array_equal(first.left, same.left)
    assert np.array_equal(first.right, same.right)
    assert not np.array_equal(first.left, other.left)
    assert np.array_equal(first.disparity, other.disparity)
    noisy = made("plain wall", noise=4.0)
    bare = grey(noisy.left)[40:80, 40:80], grey(noisy.right)[40:80, 30:70]
    assert np.std(bare[0]) == pytest.approx(4.0 * np.linalg.norm([0.299, 0.587, 0.114]), rel=0.1)
    assert abs(np.corrcoef(bare[0].ravel(), bare[1].ravel())[0, 1]) < 0.1


def test_the_motorcycle_is_what_its_readme_says():
    pair = motorcycle_pair()
    assert pair.left.shape == pair.right.shape == (500, 741, 3)
    assert pair.disparity is not None
    assert pair.visible is not None
    assert np.nanmin(pair.disparity) > 7
    assert np.nanmax(pair.disparity) < 60
    assert np.isnan(pair.disparity).mean() == pytest.approx(0.0735, abs=0.001)
    v, u = np.nonzero(pair.visible & inner(np.nan_to_num(pair.disparity)))
    right = scipy.ndimage.map_coordinates(grey(pair.right), [v, u - pair.disparity[v, u]], order=1)
    # left-referenced, and the sign is right
    assert np.median(np.abs(right - grey(pair.left)[v, u])) < 3.0


def test_shrinking_keeps_depths():
    pair: Any = motorcycle_pair()
    small: Any = shrunk(pair, 4)
    assert small.left.shape == (125, 185, 3)
    assert small.camera.f == pytest.approx(994.978 / 4)
    assert small.camera.doffs == pytest.approx(31.086 / 4)
    depths = [
        np.nanmedian(
            depth_from_disparity(p.disparity + p.camera.doffs, p.camera.f, p.camera.baseline)
        )
        for p in (pair, small)
    ]
    assert depths[0] == pytest.approx(depths[1], rel=0.01)
    assert small.left[10, 20, 1] == pytest.approx(pair.left[40:44, 80:84, 1].mean(), abs=0.51)
    assert shrunk(pair, 1).left.shape == (500, 741, 3)
    with pytest.raises(InputError, match="741 x 500 pixels cannot shrink 600 times"):
        shrunk(pair, 600)


def test_own_pairs(tmp_path):
    pair = made("planes")
    for name, picture in (("left.png", pair.left), ("right.png", pair.right)):
        Image.fromarray(picture).save(tmp_path / name)
        Image.fromarray(picture).convert("L").save(tmp_path / f"grey_{name}")
    own = read_pair(tmp_path / "left.png", tmp_path / "right.png", 150.0, baseline=0.1, doffs=2.0)
    assert np.array_equal(own.left, pair.left)
    assert np.array_equal(own.right, pair.right)
    assert own.camera == StereoCamera(150.0, 79.5, 59.5, 0.1, 2.0)
    assert own.disparity is None
    mixed = read_pair(tmp_path / "left.png", tmp_path / "grey_right.png", 150.0, baseline=0.1)
    # colour and grey go together
    assert np.abs(grey(mixed.right) - grey(pair.right)).max() <= 0.5 + 1e-6


def test_files_that_are_no_pair_are_refused_in_one_line(tmp_path, monkeypatch):
    Image.fromarray(np.zeros((20, 30, 3), np.uint8)).save(tmp_path / "a.png")
    Image.fromarray(np.zeros((20, 31), np.uint8)).save(tmp_path / "wide.png")
    Image.fromarray(np.zeros((20, 30), np.uint16)).save(tmp_path / "deep.png")
    (tmp_path / "text.png").write_text("not a picture")
    Image.fromarray(np.random.default_rng(0).integers(0, 256, (20, 30, 3)).astype(np.uint8)).save(
        tmp_path / "full.png"
    )
    (tmp_path / "cut.png").write_bytes((tmp_path / "full.png").read_bytes()[:600])

    def refuse(left, right, words):
        with pytest.raises(InputError, match=words) as caught:
            read_pair(tmp_path / left, tmp_path / right, 150.0, baseline=0.1)
        assert "\n" not in str(caught.value)

    refuse("a.png", "wide.png", "a.png is 30 x 20 pixels, wide.png 31 x 20")
    refuse("a.png", "text.png", "text.png: not readable as an image")
    refuse("cut.png", "a.png", "cut.png: not readable as an image")
    refuse("a.png", "deep.png", "8 bits")
    refuse("a.png", "missing.png", "missing.png")
    monkeypatch.setattr(stereo, "MOST_PIXELS", 500)
    refuse(
        "a.png",
        "a.png",
        "a.png: 30 x 20 pixels; a pair may have at most 500 each: make it smaller first",
    )
