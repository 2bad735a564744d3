"""Turned pictures: what lies where, and that a turn can be undone."""

import numpy as np

from lessons.features.silhouettes import horse
from lessons.features.turned_pictures import motorcycle_levels, places_in_turned, turned


def test_a_turned_picture_shows_what_was_there_where_it_is_said_to_be():
    left, right, disparity = motorcycle_levels()
    rng = np.random.default_rng(0)
    h, w = left.shape
    uv = np.column_stack([rng.integers(80, w - 80, 400), rng.integers(80, h - 80, 400)])
    for degrees in (0.0, 30.0):
        image = turned(right, np.radians(degrees))
        places = places_in_turned(uv, disparity, np.radians(degrees))
        known = np.isfinite(places).all(axis=1)
        at = np.rint(places[known]).astype(int)
        seen = image[at[:, 1], at[:, 0]]
        wanted = left[uv[known, 1], uv[known, 0]]
        assert known.mean() > 0.7
        assert np.corrcoef(seen, wanted)[0, 1] > 0.8
    assert turned(right, 0.0) is right


def test_a_quarter_turn_is_numpys():
    image = np.random.default_rng(1).uniform(0, 255, (21, 21))
    np.testing.assert_allclose(turned(image, np.pi / 2), np.rot90(image, -1), atol=1e-6)


def test_the_horse_is_evenly_outlined_about_its_middle():
    p = horse(100, 0.5)
    np.testing.assert_allclose(p.mean(axis=0), 0, atol=1e-12)
    assert np.abs(p).max() == 0.5
    steps = np.linalg.norm(np.roll(p, -1, axis=0) - p, axis=1)
    assert steps.max() < 1.3 * np.median(steps)
