"""The lens: its inverse, where it has none, its symmetric Jacobian, and OpenCV's answers."""

import math

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from workbench.geometry.cameras.distortion import (
    NONE,
    Distortion,
    distort,
    invertible_radius,
    is_invertible,
    jacobian,
    undistort,
)

REAL = Distortion(-0.26637, -0.038589, 0.0017832, -0.00028122, 0.23839)  # data/calibration, rounded
FOLDING = Distortion(-0.3, 0.02, 0.004, -0.003)


def coefficients(most: float) -> st.SearchStrategy[float]:
    return st.floats(-most, most).map(lambda value: round(value, 4))


lenses = st.builds(
    Distortion,
    coefficients(0.5),
    coefficients(0.3),
    coefficients(0.05),
    coefficients(0.05),
    coefficients(0.2),
)
seeds = st.integers(0, 2**32 - 1)


def disc(rng: np.random.Generator, radius: float, n: int = 200) -> np.ndarray:
    r = radius * np.sqrt(rng.uniform(0, 1, n))
    angle = rng.uniform(0, 2 * np.pi, n)
    return np.column_stack([r * np.cos(angle), r * np.sin(angle)])


@settings(max_examples=50, deadline=None)
@given(lens=lenses, seed=seeds)
def test_undistort_inverts_to_1e_10_up_to_where_the_model_folds(lens, seed):
    xy = disc(np.random.default_rng(seed), 0.95 * min(invertible_radius(lens), 1.5))
    back = undistort(distort(xy, *lens), lens)
    assert np.abs(back - xy).max() < 1e-10
    assert np.abs(distort(back, *lens) - distort(xy, *lens)).max() < 1e-12


@settings(max_examples=50, deadline=None)
@given(lens=lenses, seed=seeds)
def test_the_jacobian_is_the_derivative_and_is_symmetric(lens, seed):
    xy = disc(np.random.default_rng(seed), 1.0, 20)
    step = 1e-5
    J = jacobian(xy, lens)
    for axis in range(2):
        move = step * np.eye(2)[axis]
        difference = (distort(xy + move, *lens) - distort(xy - move, *lens)) / (2 * step)
        np.testing.assert_allclose(J[:, :, axis], difference, atol=1e-7)
    np.testing.assert_array_equal(J[:, 0, 1], J[:, 1, 0])


@settings(max_examples=50, deadline=None)
@given(lens=lenses, seed=seeds)
@example(
    lens=Distortion(3.19, -0.8, 1.0, 0.0, -0.27), seed=0
)  # folds across q, before it folds against it
def test_the_jacobian_is_positive_inside_the_radius_and_singular_on_it(lens, seed):
    radius = invertible_radius(lens)
    inside = disc(np.random.default_rng(seed), min(radius, 3.0) * (1 - 1e-9))
    assert np.linalg.eigvalsh(jacobian(inside, lens)).min() > 0
    if math.isfinite(radius):
        angle = np.linspace(0, 2 * np.pi, 20_001)
        rim = radius * np.column_stack([np.cos(angle), np.sin(angle)])
        lowest = np.linalg.eigvalsh(jacobian(rim, lens)).min()
        assert abs(lowest) < 1e-6 * (1 + radius**6)


def test_the_radius_of_a_barrel_is_the_textbook_one():
    """d/dr (r + k1 r³) = 0 at r = 1 / sqrt(-3 k1)."""
    assert invertible_radius(Distortion(-0.3)) == pytest.approx(1 / math.sqrt(0.9), rel=1e-12)
    assert invertible_radius(NONE) == math.inf
    assert invertible_radius(Distortion(0.3)) == math.inf


def test_beyond_its_largest_picture_a_barrel_has_no_inverse():
    lens = Distortion(-0.3)
    rim = invertible_radius(lens)
    largest = distort(np.array([[rim, 0.0]]), *lens)[0, 0]
    answers = undistort(
        np.array([[0.999 * largest, 0.0], [1.001 * largest, 0.0], [0.0, 5.0]]), lens
    )
    assert np.isfinite(answers[0]).all()
    assert np.isnan(answers[1:]).all()


def test_a_folded_point_comes_back_as_the_one_inside():
    """Two ideal points share a distorted one; the lens is only believed inside its disc."""
    lens = Distortion(-0.3)
    outside = np.array([[1.4, 0.0]])
    assert not is_invertible(outside, lens)[0]
    back = undistort(distort(outside, *lens), lens)
    assert np.linalg.norm(back) < invertible_radius(lens)
    np.testing.assert_allclose(distort(back, *lens), distort(outside, *lens), atol=1e-12)


def test_answers_outside_the_reach_of_newtons_first_steps_are_found():
    """Near the fold plain Newton jumps over it; every point just inside must still come back."""
    angle = np.linspace(0, 2 * np.pi, 400)
    xy = 0.995 * invertible_radius(FOLDING) * np.column_stack([np.cos(angle), np.sin(angle)])
    np.testing.assert_allclose(undistort(distort(xy, *FOLDING), FOLDING), xy, atol=1e-10)


@settings(max_examples=20, deadline=None)
@given(lens=lenses, seed=seeds, angle=st.floats(0, 6.28))
def test_turning_the_points_and_the_tangential_terms_turns_the_picture(lens, seed, angle):
    c, s = math.cos(angle), math.sin(angle)
    R = np.array([[c, -s], [s, c]])
    xy = disc(np.random.default_rng(seed), 1.0, 20)
    p2, p1 = R @ np.array([lens.p2, lens.p1])
    turned = distort(xy @ R.T, lens.k1, lens.k2, float(p1), float(p2), lens.k3)
    np.testing.assert_allclose(turned, distort(xy, *lens) @ R.T, atol=1e-12)


def test_agrees_with_opencv():
    cv2 = pytest.importorskip("cv2", reason="opencv-python-headless is not installed")
    xy = disc(np.random.default_rng(0), 0.8, 500)
    p = np.column_stack([xy, np.ones(len(xy))])
    theirs = cv2.projectPoints(p, np.zeros(3), np.zeros(3), np.eye(3), np.array(REAL))[0][:, 0]
    np.testing.assert_allclose(distort(xy, *REAL), theirs, atol=1e-13)
    stop = (cv2.TERM_CRITERIA_COUNT | cv2.TERM_CRITERIA_EPS, 100, 1e-15)
    back = cv2.undistortPoints(theirs[:, None], np.eye(3), np.array(REAL), criteria=stop)[:, 0]
    np.testing.assert_allclose(undistort(theirs, REAL), back, atol=1e-10)


def test_more_rows_than_one_chunk_and_none_at_all():
    xy = disc(np.random.default_rng(1), 0.7, 20_001)
    np.testing.assert_allclose(undistort(distort(xy, *REAL), REAL), xy, atol=1e-12)
    np.testing.assert_array_equal(distort(xy, *REAL)[9000:9001], distort(xy[9000:9001], *REAL))
    assert distort(np.zeros((0, 2)), *REAL).shape == (0, 2)
    assert undistort(np.zeros((0, 2)), REAL).shape == (0, 2)


def test_no_lens_changes_nothing_and_inputs_stay_as_they_were():
    xy = disc(np.random.default_rng(2), 5.0)
    before = xy.copy()
    np.testing.assert_array_equal(undistort(xy, NONE), xy)
    np.testing.assert_array_equal(distort(xy), xy)
    undistort(xy, FOLDING)
    distort(xy, *FOLDING)
    np.testing.assert_array_equal(xy, before)


def test_nan_rows_stay_nan_and_harm_no_others():
    xy = disc(np.random.default_rng(3), 0.7, 50)
    bent = distort(xy, *REAL)
    bent[7] = np.nan
    back = undistort(bent, REAL)
    assert np.isnan(back[7]).all()
    np.testing.assert_allclose(np.delete(back, 7, 0), np.delete(xy, 7, 0), atol=1e-10)
    assert not is_invertible(bent, REAL)[7]
