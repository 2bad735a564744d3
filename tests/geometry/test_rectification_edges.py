"""A warped picture shows what the old one shows, up to the centres of its outermost pixels."""

import numpy as np
import pytest

from workbench.geometry.two_views.rectification import warp

PICTURE = np.random.default_rng(0).integers(0, 250, (5, 7, 3)).astype(np.uint8)


def moved(du: float, dv: float) -> np.ndarray:
    return np.array([[1.0, 0.0, du], [0.0, 1.0, dv], [0.0, 0.0, 1.0]])


def test_a_picture_that_is_not_moved_is_the_same():
    np.testing.assert_array_equal(warp(PICTURE, np.eye(3), (7, 5)), PICTURE)


@pytest.mark.parametrize(("du", "dv"), [(2, 0), (-2, 0), (0, 2), (0, -2), (3, -1), (-1, 3)])
def test_what_the_old_picture_does_not_show_is_grey(du, dv):
    warped = warp(PICTURE, moved(du, dv), (7, 5), around=9)
    for v in range(5):
        for u in range(7):
            seen = 0 <= u - du < 7 and 0 <= v - dv < 5
            expected = PICTURE[v - dv, u - du] if seen else [9, 9, 9]
            np.testing.assert_array_equal(warped[v, u], expected)


def test_between_pixels_colours_are_mixed_by_their_distances():
    warped = warp(PICTURE, moved(-0.25, -0.5), (6, 4))
    p = PICTURE.astype(float)
    across = 0.75 * p[:, :-1] + 0.25 * p[:, 1:]
    np.testing.assert_allclose(warped, 0.5 * across[:-1] + 0.5 * across[1:], atol=0.5)
