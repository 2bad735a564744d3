"""Places on shapes, errors of one size, coins whose rims are known."""

import numpy as np
import pytest

from lessons.fitting.fit_scenes import (
    arc_points,
    cap_points,
    errors,
    line_points,
    outlying_plane,
    pipe_points,
)
from workbench.data.files.rims import find_rim, rim_points
from workbench.errors import InputError


@pytest.mark.parametrize("arc", [0.4, 2.0, 2 * np.pi])
def test_places_lie_on_their_shapes_and_within_their_arc(arc):
    p, q, r = arc_points(arc, 50), cap_points(arc, 50), pipe_points(arc, 50)
    for lengths in (
        np.linalg.norm(p, axis=1),
        np.linalg.norm(q, axis=1),
        np.linalg.norm(r[:, :2], axis=1),
    ):
        np.testing.assert_allclose(lengths, 1)
    for x, y in (p.T, r.T[:2]):
        assert np.abs(np.arctan2(y, x)).max() <= arc / 2 + 1e-9
    assert np.arccos(q[:, 0]).max() <= arc / 2 + 1e-9
    assert np.ptp(np.arctan2(p[:, 1], p[:, 0])) == pytest.approx(arc * 49 / 50)


@pytest.mark.parametrize("kind", ["independent", "alike in neighbours"])
def test_errors_have_their_size_whoever_they_agree_with(kind):
    noise = errors(np.random.default_rng(0), (400, 60, 2), 0.3, kind=kind)
    assert noise.std() == pytest.approx(0.3, rel=0.02)
    next_one = (noise[:, 1:] * noise[:, :-1]).mean() / noise.var()
    assert next_one == pytest.approx(0.0 if kind == "independent" else 0.9, abs=0.03)


def test_outliers_lie_where_they_are_said_to():
    p, off = outlying_plane(
        np.random.default_rng(0), 400, 0.01, outliers=0.25, reach=0.5, both_sides=False
    )
    assert off.sum() == 100
    assert 0 <= p[off, 2].min() < p[off, 2].max() <= 0.5
    assert np.abs(p[~off, 2]).max() < 0.05
    assert (
        outlying_plane(
            np.random.default_rng(0), 400, 0.01, outliers=0.25, reach=0.5, both_sides=True
        )[0][:, 2].min()
        < -0.3
    )


def test_a_drawn_disc_has_its_rim():
    v, u = np.mgrid[:80, :100]
    disc = np.where(np.hypot(u - 52, v - 41) < 20, 200, 30).astype(np.uint8)
    for image in (disc, np.repeat(disc[..., None], 3, 2)):
        rim = rim_points(image, np.array([50.0, 38.0]), 90, farthest=35.0)
        assert np.abs(np.hypot(*(rim - [52, 41]).T) - 20).max() < 0.8


def test_a_rim_is_in_its_own_radii_and_has_windows_all_round():
    v, u = np.mgrid[:80, :100]
    rim = find_rim(np.where(np.hypot(u - 52, v - 41) < 20, 200, 30).astype(np.uint8), (52, 41))
    assert (*rim.center, rim.radius) == pytest.approx((52, 41, 20), abs=0.5)
    np.testing.assert_allclose(np.linalg.norm(rim.p, axis=1), 1, atol=0.05)
    windows = rim.windows(90.0)
    assert windows.shape == (12, 90, 2)
    middles = np.unwrap(np.arctan2(*windows.mean(axis=1).T[::-1]))
    np.testing.assert_allclose(np.abs(np.diff(middles)), np.pi / 6, atol=0.05)
    assert middles[0] == pytest.approx(0, abs=0.05)
    with pytest.raises(InputError, match="make it smaller"):
        find_rim(np.zeros((10, 1000), np.uint8), (5, 5))


@pytest.mark.parametrize("slope", [0.0, 1.0])
def test_places_along_a_line(slope):
    p = line_points(np.random.default_rng(0), slope, 50)
    np.testing.assert_allclose(p @ [-np.sin(slope), np.cos(slope)], 0, atol=1e-12)
    assert np.linalg.norm(p, axis=1).max() <= 1
