"""SIFT's keypoints: what a turn and a stretch do to them, a blob of known size, and pictures
without any.
"""

import numpy as np
import pytest
import scipy

from lessons.features.turned_pictures import motorcycle_levels, turned
from workbench.geometry.features.matching import filtered, nearest_both_ways
from workbench.geometry.features.sift import Sift, sift, turned_patch


@pytest.fixture(scope="module")
def still() -> Sift:
    return sift(motorcycle_levels()[0])


@pytest.mark.parametrize("quarter", [False, True])
def test_keypoints_turn_with_the_picture(still, quarter):
    image = motorcycle_levels()[0]
    angle = np.pi / 2 if quarter else np.radians(40)
    keypoints = sift(np.rot90(image, -1) if quarter else turned(image, angle))
    i, j = filtered(nearest_both_ways(still.descriptors, keypoints.descriptors), "both", 0.7).T
    assert len(i) > 100
    middle = (np.array(image.shape[::-1]) - 1) / 2
    c, s = np.cos(angle), np.sin(angle)
    places = (still.uv[i] - middle) @ np.array([[c, s], [-s, c]]) + (
        middle[::-1] if quarter else middle
    )
    assert np.mean(np.linalg.norm(places - keypoints.uv[j], axis=1) < 1) > 0.9
    off = (keypoints.angle[j] - still.angle[i] - angle + np.pi) % (2 * np.pi) - np.pi
    assert np.median(np.abs(off)) < np.radians(2)
    assert np.median(np.abs(np.log(keypoints.sigma[j] / still.sigma[i]))) < 0.02


def test_brightness_and_contrast_do_not_count(still):
    image = motorcycle_levels()[0]
    keypoints = sift(0.9 * image + 20)
    i, j = filtered(nearest_both_ways(still.descriptors, keypoints.descriptors), "both", 0.7).T
    assert np.mean(np.linalg.norm(still.uv[i] - keypoints.uv[j], axis=1) < 0.1) > 0.99


@pytest.mark.parametrize("size", [3.0, 4.0, 6.0])
def test_a_blob_is_found_where_it_is_as_large_as_it_is(size):
    """Its size is the finer of two Gaussians that differ by a third of an octave; the blob lies
    between them.
    """
    v, u = np.mgrid[:81, :101]
    keypoints = sift(200 * np.exp(-((u - 60.3) ** 2 + (v - 33.2) ** 2) / (2 * size**2)))
    np.testing.assert_allclose(
        keypoints.uv, np.broadcast_to([60.3, 33.2], keypoints.uv.shape), atol=0.1
    )
    np.testing.assert_allclose(keypoints.sigma * 2 ** (1 / 6), size, rtol=0.03)
    assert len(keypoints.uv)


def test_directions_are_those_of_the_grey_levels():
    """A blob on a ramp has the ramp's direction, from u towards v: on the average of many within a
    fifth of a bin.
    """
    v, u = np.mgrid[-40:41, -40:41].astype(float)
    offs = []
    for angle in np.radians(np.arange(0, 360, 7)):
        ramp = 0.9 * (u * np.cos(angle) + v * np.sin(angle))
        keypoints = sift(128 + ramp + 60 * np.exp(-(u**2 + v**2) / 32))
        off = np.degrees(keypoints.angle - angle)[
            np.linalg.norm(keypoints.uv - [40, 40], axis=1) < 3
        ]
        offs += [min(((degrees + 180) % 360 - 180 for degrees in off), key=abs)] if len(off) else []
    assert len(offs) > 40
    assert np.mean(offs) == pytest.approx(0, abs=2)
    assert np.std(offs) < 6


def test_a_flat_picture_has_no_keypoints():
    keypoints = sift(np.full((40, 60), 120.0))
    assert keypoints.uv.shape == (0, 2)
    assert keypoints.descriptors.shape == (0, 128)


def test_a_turned_patch_is_the_pixels_themselves_or_those_of_the_turned_picture():
    image = scipy.ndimage.gaussian_filter(np.random.default_rng(2).uniform(0, 255, (61, 61)), 3)
    middle = np.array([30.0, 30.0])
    np.testing.assert_allclose(
        turned_patch(image, np.array([20.0, 32.0]), 0.0, half=5.0, side=11), image[27:38, 15:26]
    )
    for angle in (0.0, 0.7, np.pi / 2, -2.0):
        np.testing.assert_allclose(
            turned_patch(turned(image, angle), middle, angle, half=8.0, side=17),
            image[22:39, 22:39],
            atol=2.0,
        )
