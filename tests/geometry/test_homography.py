import numpy as np
import pytest
import scipy
from hypothesis import given, settings
from hypothesis import strategies as st

from workbench.geometry.two_views.homography import (
    fit_homographies,
    fit_homography,
    four_in_general_position,
    homogeneous,
    homographies_from_four,
    normalising_similarity,
    null_vector,
    null_vectors,
    refine_homography,
    transfer_distances,
    transform_pixels,
    warped_grid,
)

seeds = st.integers(0, 2**32 - 1)


def scene(seed: int, count: int = 30, sigma: float = 0.0):
    rng = np.random.default_rng(seed)
    H = np.eye(3) + rng.uniform(-1, 1, (3, 3)) * [[0.3, 0.3, 80], [0.3, 0.3, 80], [2e-4, 2e-4, 0]]
    uv_a = rng.uniform(0, 800, (count, 2))
    uv_b = transform_pixels(H, uv_a) + sigma * rng.normal(size=(count, 2))
    return H / np.linalg.norm(H), uv_a, uv_b


@settings(max_examples=50, deadline=None)
@given(seed=seeds)
def test_four_matches_without_noise_give_the_homography(seed):
    _, uv_a, uv_b = scene(seed, 4)
    H = homographies_from_four(uv_a, uv_b)
    if not four_in_general_position(uv_a, uv_b):
        assert np.isnan(H).all()
        return
    np.testing.assert_allclose(transfer_distances(H, uv_a, uv_b), 0.0, atol=1e-5)
    assert np.linalg.norm(H) == pytest.approx(1.0)


@settings(max_examples=30, deadline=None)
@given(seed=seeds)
def test_the_linear_transform_is_exact_without_noise(seed):
    H, uv_a, uv_b = scene(seed)
    fitted = fit_homography(uv_a, uv_b)
    np.testing.assert_allclose(fitted * np.sign(fitted[2, 2] * H[2, 2]), H, atol=1e-8)


def test_weight_zero_is_absence_and_weight_two_is_twice():
    _, uv_a, uv_b = scene(7, 12, sigma=2.0)
    weights = np.array([0.0] * 2 + [1.0] * 5 + [2.0] * 5)
    rows = np.r_[2:12, 7:12]
    for fit in (
        fit_homography,
        lambda a, b, w=None: refine_homography(fit_homography(a, b, w), a, b, weights=w, steps=40),
    ):
        ours = fit(uv_a, uv_b, weights)
        repeated = fit(uv_a[rows], uv_b[rows])
        tolerance = 0.05 if fit is fit_homography else 1e-3  # the normalisation sees all pixels
        np.testing.assert_allclose(
            transform_pixels(ours, uv_a), transform_pixels(repeated, uv_a), atol=tolerance
        )


def test_many_fitted_side_by_side_are_one_by_one():
    uv_a, uv_b = np.random.default_rng(0).uniform(0, 100, (2, 5, 12, 2))
    for H, a, b in zip(fit_homographies(uv_a, uv_b), uv_a, uv_b, strict=True):
        np.testing.assert_allclose(
            H * np.sign(H[2, 2]),
            (single := fit_homography(a, b)) * np.sign(single[2, 2]),
            atol=1e-12,
        )


def test_it_agrees_with_skimage():
    """Its normalisation differs a little, and so does the answer, but by far less than the
    noise.
    """
    from skimage.transform import ProjectiveTransform

    _, uv_a, uv_b = scene(5, 40, sigma=2.0)
    peer = ProjectiveTransform.from_estimate(uv_a, uv_b).params
    ours = fit_homography(uv_a, uv_b)
    np.testing.assert_allclose(
        transform_pixels(ours, uv_a), transform_pixels(peer, uv_a), atol=2e-3
    )


def test_far_from_the_origin_nothing_is_lost():
    _, uv_a, uv_b = scene(6)
    H = fit_homography(uv_a + 1e5, uv_b - 1e5)
    assert transfer_distances(H, uv_a + 1e5, uv_b - 1e5).max() < 1e-4


def test_a_quadrangle_that_no_camera_sees_is_refused():
    square = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
    crossed = square[[0, 2, 1, 3]]
    mirrored = square[:, ::-1].copy()
    line = np.array([[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [0.0, 1.0]])
    double = square[[0, 0, 1, 2]]
    assert four_in_general_position(square, 300 * square + 20)
    assert four_in_general_position(square, mirrored)
    for bad in (crossed, line, double, np.zeros((4, 2))):
        assert not four_in_general_position(square, bad)
        assert not four_in_general_position(bad, square)
        assert np.isnan(homographies_from_four(square, bad)).all()
    both = homographies_from_four(np.stack([square, line]), np.stack([square, square]))
    assert np.isnan(both[1]).all()
    np.testing.assert_allclose(both[0] / both[0, 2, 2], np.eye(3), atol=1e-12)


def test_a_pixel_that_goes_to_infinity_is_infinitely_far():
    H = np.array([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 0.0, -1.0]])
    p = np.array([[1.0, 0.0], [0.0, 0.0]])
    assert np.isnan(transform_pixels(H, p)[0]).all()
    np.testing.assert_array_equal(np.isinf(transfer_distances(H, p, p)), [True, False])


@settings(max_examples=15, deadline=None)
@given(seed=seeds)
def test_refinement_reaches_the_optimum_of_the_transfer_distance(seed):
    _, uv_a, uv_b = scene(seed, 40, sigma=2.0)
    weights = np.random.default_rng(seed).random(40) + 0.1
    start = fit_homography(uv_a, uv_b, weights)
    refined = refine_homography(start, uv_a, uv_b, weights=weights, steps=30)

    def cost(H):
        return float(weights @ transfer_distances(H, uv_a, uv_b) ** 2)

    def residuals(h):
        off = transform_pixels(np.append(h, 1.0).reshape(3, 3), uv_a) - uv_b
        return (np.sqrt(weights)[:, None] * off).ravel()

    x_scale = np.array([1, 1, 100, 1, 1, 100, 1e-3, 1e-3])
    oracle = scipy.optimize.least_squares(
        residuals, (start / start[2, 2]).ravel()[:8], x_scale=x_scale
    )
    assert cost(refined) <= cost(start) * (1 + 1e-12)
    assert cost(refined) <= 2 * oracle.cost * (1 + 1e-6)


def test_normalised_pixels_have_the_promised_spread():
    uv = np.random.default_rng(0).uniform(0, 4000, (2, 50, 2))
    for pixels, T in zip(uv, normalising_similarity(uv), strict=True):
        moved = (homogeneous(pixels) @ T.T)[:, :2]
        np.testing.assert_allclose(moved.mean(0), 0, atol=1e-9)
        assert np.linalg.norm(moved, axis=1).mean() == pytest.approx(np.sqrt(2))
    assert np.isfinite(normalising_similarity(np.ones((5, 2)))).all()


def test_too_few_matches_are_refused():
    with pytest.raises(ValueError, match="at least 4"):
        fit_homography(np.zeros((3, 2)), np.zeros((3, 2)))


def test_a_grid_stays_a_grid_under_the_identity_and_goes_where_its_corners_go():
    size = np.array([640.0, 480.0])
    ends = warped_grid(np.eye(3), size, cells=4, pieces=3)
    assert len(ends) == 2 * 5 * 12
    # along the columns or the rows
    assert np.isclose(np.diff(ends, axis=1)[:, 0] / size, 0).any(axis=1).all()
    H = np.array([[1.1, 0.1, 20], [-0.05, 0.9, 5], [1e-4, -2e-4, 1]])
    np.testing.assert_allclose(
        warped_grid(H, size, cells=4, pieces=3),
        transform_pixels(H, ends.reshape(-1, 2)).reshape(-1, 2, 2),
    )


@pytest.mark.parametrize("columns", [2, 4, 9])
def test_the_null_vectors_of_many_small_matrices_are_those_of_each(columns):
    rng = np.random.default_rng(columns)
    A = rng.normal(size=(60, columns + 1, columns))
    A[:20] *= np.geomspace(1.0, 1e-6, columns)  # a clear least direction
    A[20] = 0.0
    A[21, :, 0] = A[21, :, -1]  # singular
    A[22] = np.eye(columns + 1, columns)  # no direction is the least
    vectors = null_vectors(A)
    np.testing.assert_allclose(np.linalg.norm(vectors, axis=1), 1.0)
    least = np.linalg.svd(A)[1][:, -1]
    lengths = np.linalg.norm(A @ vectors[..., None], axis=(1, 2))
    np.testing.assert_allclose(lengths, least, rtol=1e-9, atol=1e-14)
    for vector, A_one in zip(vectors[:20], A[:20], strict=True):
        known = null_vector(A_one)
        np.testing.assert_allclose(vector * np.sign(vector @ known), known, atol=1e-12)


def test_no_matrices_have_no_null_vectors():
    assert null_vectors(np.zeros((0, 4, 4))).shape == (0, 4)
