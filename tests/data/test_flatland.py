"""The flat world: what is known of its discs, and what its cameras must see of them."""

import numpy as np
import pytest

from lessons.learning import flatland


def test_a_photograph_shows_each_disc_that_a_ray_hits_first_and_white_where_it_hits_none():
    angle = 0.7
    pixels = 61
    p, d = flatland.rays_of(angle, pixels)
    nearest = np.full(pixels, np.inf)
    hit = np.full(pixels, -1)
    clear = np.ones(pixels, bool)  # of borders
    for k, (x, y, radius) in enumerate(flatland.DISCS):
        v = np.array([x, y]) - p
        along = (v * d).sum(axis=1)
        miss = np.abs(v[:, 0] * d[:, 1] - v[:, 1] * d[:, 0])
        clear &= np.abs(miss - radius) > 0.03
        enters = np.where(
            miss < radius, along - np.sqrt(np.maximum(radius**2 - miss**2, 0)), np.inf
        )
        hit = np.where(enters < nearest, k, hit)
        nearest = np.minimum(nearest, enters)
    image = flatland.photograph(angle, pixels)
    assert image[hit < 0] == pytest.approx(1)
    assert set(hit[clear].tolist()) == {-1, 0, 1, 2}
    for k, color in enumerate(flatland.COLORS):
        seen = image[(hit == k) & clear]
        assert np.all(seen.argmax(axis=1) == color.argmax())


def test_light_through_a_disc_fades_as_beer_and_lambert_say():
    q = np.linspace(-0.28, 0.28, 2001)[:, None] * [1, 0] + flatland.DISCS[0, :2]
    density, _ = flatland.medium(q)
    assert density[1:-1].sum() * 0.56 / 2000 == pytest.approx(flatland.DENSITY * 0.56, rel=1e-3)
    density, color = flatland.medium(np.array([[0.9, 0.9], [0, 0]]))
    assert not density.any()
    assert not color.any()


def test_cameras_look_at_the_middle_and_reach_all_discs():
    for angle in (0.0, 2.0):
        p, d = flatland.rays_of(angle, 41)
        np.testing.assert_allclose((p + flatland.DISTANCE * d)[20], 0, atol=1e-12)
        # from left to right, seen from above: clockwise
        assert d[0, 0] * d[-1, 1] - d[0, 1] * d[-1, 0] < 0
        assert np.degrees(np.arccos(d[0] @ d[-1])) == pytest.approx(2 * flatland.HALF_VIEW)
    far = np.linalg.norm(flatland.DISCS[:, :2], axis=1) + flatland.DISCS[:, 2]
    assert flatland.REACH[0] < flatland.DISTANCE - far.max()
    assert flatland.REACH[1] > flatland.DISTANCE + far.max()


def test_photographs_are_shared_and_cannot_be_written_to():
    image = flatland.photograph(0.3, 20)
    assert flatland.photograph(0.3, 20) is image
    with pytest.raises(ValueError, match="read-only"):
        image[0] = 0
