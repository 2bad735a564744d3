import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from lessons.ransac.robust_scenes import match_scene
from workbench.geometry.two_views.epipolar import (
    epipolar_constraints,
    epipolar_lines,
    epipoles,
    fit_fundamental,
    fundamental_from_cameras,
    fundamentals_from_seven,
    orientation_agrees,
    rank_two,
    real_cubic_roots,
    refine_fundamental,
    sampson_distances,
)
from workbench.geometry.two_views.homography import homogeneous

seeds = st.integers(0, 2**32 - 1)


def views(seed: int, count: int, sigma: float = 0.0):
    scene = match_scene(np.random.default_rng(seed), count=count, outlier_ratio=0.0, sigma=sigma)
    return scene.truth, scene.p[:, :2].copy(), scene.p[:, 2:].copy()


def same_up_to_sign(F, G, atol):
    np.testing.assert_allclose(F * np.sign((F * G).sum()), G, atol=atol)


@settings(max_examples=30, deadline=None)
@given(seed=seeds)
def test_true_matches_satisfy_the_constraint_and_lie_on_their_lines(seed):
    F, uv_first, uv_second = views(seed, 20)
    assert np.linalg.norm(F) == pytest.approx(1.0)
    assert np.linalg.det(F) == pytest.approx(0.0, abs=1e-12)
    np.testing.assert_allclose(sampson_distances(F, uv_first, uv_second), 0.0, atol=1e-7)
    for G, a, b in ((F, uv_first, uv_second), (F.T, uv_second, uv_first)):
        np.testing.assert_allclose((epipolar_lines(G, a) * homogeneous(b)).sum(1), 0.0, atol=1e-7)


def test_the_epipole_has_no_line_and_one_place_no_geometry():
    # a camera that moved ahead: the epipole is (3, 5)
    F = np.array([[0.0, -1.0, 5.0], [1.0, 0.0, -3.0], [-5.0, 3.0, 0.0]])
    assert np.isnan(epipolar_lines(F, np.array([[3.0, 5.0]]))).all()
    with pytest.raises(ValueError, match="one place"):
        fundamental_from_cameras(np.eye(3), np.eye(3), np.eye(4))


@settings(max_examples=20, deadline=None)
@given(seed=seeds)
def test_the_sampson_distance_is_the_first_order_distance_to_the_constraint(seed):
    F, uv_first, uv_second = views(seed, 5, sigma=0.01)
    for a, b, distance in zip(
        uv_first, uv_second, sampson_distances(F, uv_first, uv_second), strict=True
    ):
        gradient = np.concatenate([(F.T @ np.append(b, 1))[:2], (F @ np.append(a, 1))[:2]])
        moved = np.concatenate([a, b]) - distance * gradient / np.linalg.norm(gradient)
        left = sampson_distances(F, moved[None, :2], moved[None, 2:])[0]
        assert abs(left) <= 1e-2 * abs(distance) + 1e-9


def test_several_matrices_and_single_precision():
    F, uv_first, uv_second = views(1, 30, sigma=1.0)
    many = np.stack([F, F + 1e-4, F.T])
    rows = sampson_distances(many, uv_first, uv_second)
    for row, G in zip(rows, many, strict=True):
        np.testing.assert_allclose(row, sampson_distances(G, uv_first, uv_second))
    single = sampson_distances(
        F.astype(np.float32), uv_first.astype(np.float32), uv_second.astype(np.float32)
    )
    assert single.dtype == np.float32
    np.testing.assert_allclose(single, rows[0], atol=2e-3)


@settings(max_examples=40, deadline=None)
@given(seed=seeds)
def test_seven_matches_without_noise_give_the_matrix_among_few(seed):
    F, uv_first, uv_second = views(seed, 40)
    matrices = fundamentals_from_seven(uv_first[:7], uv_second[:7])
    matrices = matrices[np.isfinite(matrices).all((1, 2))]
    assert len(matrices) in (1, 3)
    np.testing.assert_allclose(np.linalg.det(matrices), 0.0, atol=1e-9)
    np.testing.assert_allclose(
        sampson_distances(matrices, uv_first[:7], uv_second[:7]), 0.0, atol=1e-4
    )
    assert np.abs(sampson_distances(matrices, uv_first, uv_second)).max(axis=1).min() < 0.05
    assert orientation_agrees(F[None], uv_first, uv_second)[0]


def test_many_samples_of_seven_give_what_each_gives_alone():
    _, uv_first, uv_second = views(2, 70, sigma=1.0)
    a, b = uv_first.reshape(2, 5, 7, 2), uv_second.reshape(2, 5, 7, 2)
    together = fundamentals_from_seven(a, b)
    assert together.shape == (2, 5, 3, 3, 3)
    for F, alone in zip(together[1, 3], fundamentals_from_seven(a[1, 3], b[1, 3]), strict=True):
        assert np.isnan(F).all() == np.isnan(alone).all()
        if np.isfinite(F).all():
            same_up_to_sign(F, alone, 1e-6)


def test_repeated_matches_give_no_matrix():
    _, uv_first, uv_second = views(3, 7)
    rows = [0, 1, 2, 3, 4, 5, 5]
    assert np.isnan(fundamentals_from_seven(uv_first[rows], uv_second[rows])).all()
    assert np.isnan(fundamentals_from_seven(np.ones((7, 2)), np.ones((7, 2)))).all()


def test_a_match_behind_one_camera_only_disagrees():
    F, uv_first, uv_second = views(4, 12)
    turned = uv_second.copy()
    epipole = np.linalg.svd(F.T)[2][-1]
    epipole = epipole[:2] / epipole[2]
    turned[3] = 2 * epipole - turned[3]  # on its line, but beyond the epipole
    assert orientation_agrees(F[None], uv_first, uv_second)[0]
    np.testing.assert_allclose(sampson_distances(F, uv_first, turned), 0.0, atol=1e-5)
    assert not orientation_agrees(F[None], uv_first, turned)[0]


@settings(max_examples=30, deadline=None)
@given(seed=seeds)
def test_eight_points_are_exact_without_noise(seed):
    F, uv_first, uv_second = views(seed, 30)
    same_up_to_sign(fit_fundamental(uv_first, uv_second), F, 1e-6)


def test_a_match_of_weight_zero_does_not_count():
    F, uv_first, uv_second = views(6, 40)
    uv_second[:3] += 50.0
    weights = np.r_[np.zeros(3), np.ones(37)]
    for fitted in (
        fit_fundamental(uv_first, uv_second, weights),
        refine_fundamental(F, uv_first, uv_second, weights=weights),
    ):
        same_up_to_sign(fitted, F, 1e-6)


def test_eight_points_agree_with_skimage():
    """Its normalisation differs a little, and so does the answer, but by far less than the
    noise.
    """
    from skimage.transform import FundamentalMatrixTransform

    _, uv_first, uv_second = views(5, 60, sigma=1.0)
    peer = FundamentalMatrixTransform.from_estimate(uv_first, uv_second).params
    ours, theirs = (
        sampson_distances(F, uv_first, uv_second)
        for F in (fit_fundamental(uv_first, uv_second), peer)
    )
    np.testing.assert_allclose(np.abs(ours), np.abs(theirs), atol=2e-3)


@settings(max_examples=15, deadline=None)
@given(seed=seeds)
def test_refinement_lowers_the_distances_and_stays_singular(seed):
    _, uv_first, uv_second = views(seed, 60, sigma=1.0)
    weights = np.random.default_rng(seed).random(60) + 0.1
    start = fit_fundamental(uv_first, uv_second, weights)
    refined = refine_fundamental(start, uv_first, uv_second, weights=weights, steps=50)

    def cost(F):
        return float(weights @ sampson_distances(F, uv_first, uv_second) ** 2)

    assert cost(refined) <= cost(start) * (1 + 1e-9)
    assert abs(np.linalg.det(refined)) < 1e-15
    rng = np.random.default_rng(seed)
    U, s, Vt = np.linalg.svd(refined)
    for _ in range(8):  # no singular matrix nearby is better
        W, Z = (np.eye(3) + 1e-5 * rng.normal(size=(3, 3)) for _ in range(2))
        near = np.linalg.qr(U @ W)[0] @ np.diag(s) @ np.linalg.qr((Vt @ Z).T)[0].T
        signs = [np.diag(x) for x in np.array(np.meshgrid([1, -1], [1, -1])).reshape(2, -1).T]
        assert min(cost(U @ np.diag([*np.diag(sign), 1.0]) @ U.T @ near) for sign in signs) >= cost(
            refined
        ) * (1 - 1e-5)


def test_refinement_beats_eight_points_against_the_truth():
    errors = []
    for seed in range(15):
        scene = match_scene(np.random.default_rng(seed), count=200, outlier_ratio=0.0, sigma=1.0)
        linear = fit_fundamental(scene.p[:, :2], scene.p[:, 2:])
        refined = refine_fundamental(linear, scene.p[:, :2], scene.p[:, 2:])
        errors.append(
            [
                np.sqrt(
                    np.square(sampson_distances(F, scene.p_true[:, :2], scene.p_true[:, 2:])).mean()
                )
                for F in (linear, refined)
            ]
        )
    linear, refined = np.median(errors, axis=0)
    assert refined < 0.95 * linear


def test_too_few_matches_are_refused():
    with pytest.raises(ValueError, match="at least 8"):
        fit_fundamental(np.zeros((7, 2)), np.zeros((7, 2)))


@settings(max_examples=50, deadline=None)
@given(roots=st.lists(st.floats(-5, 5), min_size=3, max_size=3), lead=st.floats(0.1, 10))
def test_real_roots_of_cubics_that_have_three(roots, lead):
    roots = np.sort(roots)
    if np.diff(roots).min() < 1e-2:
        return
    np.testing.assert_allclose(np.sort(real_cubic_roots(lead * np.poly(roots))), roots, atol=1e-6)


def test_a_cubic_with_one_real_root():
    roots = real_cubic_roots(np.poly([2.0, 1j, -1j]).real)
    np.testing.assert_array_equal(np.isnan(roots), [False, True, True])
    assert roots[0] == pytest.approx(2.0)


def test_the_real_pair_of_photographs_fits_its_truth(shared_data):
    pair = np.load(shared_data / "ransac" / "fountain-P11" / "gt_and_matches.npz")
    x1, x2 = pair["x1"].astype(float), pair["x2"].astype(float)
    distances = np.abs(sampson_distances(pair["F"], x1, x2))
    assert np.count_nonzero(distances < 1.0) == 1365


def test_the_equations_hold_and_rank_two_is_the_nearest():
    F, uv_first, uv_second = views(4, 12)
    rows = epipolar_constraints(homogeneous(uv_first), homogeneous(uv_second))
    np.testing.assert_allclose(
        rows @ F.ravel(), (homogeneous(uv_second) * (homogeneous(uv_first) @ F.T)).sum(1), atol=1e-6
    )
    G = np.random.default_rng(0).normal(size=(3, 3))
    near = rank_two(G)
    assert np.linalg.svd(near)[1][2] < 1e-12
    assert np.linalg.norm(G - near) == pytest.approx(np.linalg.svd(G)[1][2])


@settings(max_examples=20, deadline=None)
@given(seed=seeds)
def test_all_lines_go_through_the_epipoles(seed):
    F, uv_first, uv_second = views(seed, 9)
    first, second = epipoles(F)
    np.testing.assert_allclose(epipolar_lines(F, uv_first) @ second, 0.0, atol=1e-6)
    np.testing.assert_allclose(epipolar_lines(F.T, uv_second) @ first, 0.0, atol=1e-6)


def test_opencv_solves_eight_points_alike():
    cv2 = pytest.importorskip("cv2")
    for seed in range(3):
        _, uv_first, uv_second = views(seed, 40, sigma=1.0)
        theirs, _ = cv2.findFundamentalMat(uv_first, uv_second, cv2.FM_8POINT)
        theirs /= np.linalg.norm(theirs)
        ours = fit_fundamental(uv_first, uv_second)
        same_up_to_sign(theirs, ours, 1e-8)
