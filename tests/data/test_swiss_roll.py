"""The roll: an isometric sheet, there and back."""

import numpy as np

from lessons.distances.swiss_roll import rolled, swiss_roll


def test_points_lie_where_their_sheet_is_rolled_to():
    p, sheet = swiss_roll(500, np.random.default_rng(0))
    np.testing.assert_allclose(rolled(sheet), p, atol=1e-5)
    assert 0.9 < np.linalg.norm(p[:, :2], axis=1).max() <= 1
    again, _ = swiss_roll(500, np.random.default_rng(0))
    np.testing.assert_array_equal(again, p)


def test_short_ways_on_the_sheet_are_as_long_in_space():
    rng = np.random.default_rng(1)
    _, sheet = swiss_roll(200, rng)
    step = rng.normal(size=sheet.shape)
    step *= 1e-3 / np.linalg.norm(step, axis=1)[:, None]
    np.testing.assert_allclose(
        np.linalg.norm(rolled(sheet + step) - rolled(sheet), axis=1), 1e-3, rtol=2e-2
    )
