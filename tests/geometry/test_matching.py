"""Matches of descriptors, corners, keypoints and shape contexts beside scipy, OpenCV and loops."""

import numpy as np
import pytest
import scipy

from workbench.algorithms.transport import best_assignment
from workbench.data.shapes.rabbit import rabbit
from workbench.geometry.features import keypoints, matching
from workbench.geometry.features.shape_context import context_costs, shape_contexts


def test_nearest_both_ways_are_scipys(monkeypatch):
    rng = np.random.default_rng(0)
    a, b = rng.normal(size=(70, 6)) + 50, rng.normal(size=(45, 6)) + 50
    D = scipy.spatial.distance.cdist(a, b)
    for cells in (100, 10**7):
        monkeypatch.setattr(matching, "_CELLS", cells)
        nearest = matching.nearest_both_ways(a, b)
        np.testing.assert_array_equal(nearest.index, D.argmin(axis=1))
        np.testing.assert_array_equal(nearest.back, D.argmin(axis=0))
        np.testing.assert_allclose(
            np.column_stack([nearest.distance, nearest.second]), np.sort(D, axis=1)[:, :2]
        )


def test_planted_matches_are_found_and_nothing_else():
    rng = np.random.default_rng(1)
    a = 10 * rng.normal(size=(50, 8))
    order = rng.permutation(30)
    b = np.concatenate(
        [a[order] + 0.01 * rng.normal(size=(30, 8)), 10 * rng.normal(size=(20, 8)) + 300]
    )
    matches = matching.mutual_matches(a, b, 0.5)
    right = np.full(50, -1)
    right[order] = np.arange(30)
    np.testing.assert_array_equal(matches, right)
    kept = matching.filtered(matching.nearest_both_ways(a, b), "both", 0.5)
    np.testing.assert_array_equal(
        kept, np.column_stack([np.flatnonzero(right >= 0), right[right >= 0]])
    )


def test_each_filter_keeps_part_of_the_one_before():
    rng = np.random.default_rng(2)
    near = matching.nearest_both_ways(rng.normal(size=(80, 3)), rng.normal(size=(60, 3)))
    kept = {how: near.kept(how, 0.8) for how in ("nearest", "ratio", "mutual", "both")}
    assert kept["nearest"].all()
    np.testing.assert_array_equal(kept["both"], kept["ratio"] & kept["mutual"])
    assert 0 < kept["both"].sum() < min(kept["ratio"].sum(), kept["mutual"].sum())


def test_what_cannot_be_matched_is_refused():
    with pytest.raises(ValueError, match="empty"):
        matching.nearest_both_ways(np.zeros((0, 3)), np.zeros((2, 3)))
    near = matching.nearest_both_ways(np.eye(3), np.eye(3))
    with pytest.raises(ValueError, match="one index"):
        matching.filtered(near, "both", 0.9, mutual=np.array([0, 1, 3]))


def test_the_response_turns_with_the_picture_and_edges_are_negative():
    image = np.random.default_rng(3).uniform(0, 255, (30, 40))
    response = keypoints.harris_response(image)
    np.testing.assert_allclose(
        keypoints.harris_response(np.rot90(image)), np.rot90(response), rtol=1e-9, atol=1e-6
    )
    np.testing.assert_allclose(
        keypoints.harris_response(0.5 * image + 20), response / 16, rtol=1e-9, atol=1e-6
    )
    edge = np.where(np.arange(30) < 15, 0.0, 200.0) * np.ones((30, 1))
    assert keypoints.harris_response(edge).max() < 1e-6
    slanted = 200.0 * (np.add.outer(np.arange(40), np.arange(40)) < 40)
    assert keypoints.harris_response(slanted)[8:-8, 8:-8].max() < 1e-6
    square = np.zeros((30, 30))
    square[10:20, 10:20] = 200
    corners = keypoints.strongest(keypoints.harris_response(square), 10)
    # inside the bright square
    assert {tuple(c) for c in corners.tolist()} == {(11, 11), (18, 11), (11, 18), (18, 18)}


def test_patches_do_not_see_brightness_or_contrast():
    image = np.random.default_rng(4).uniform(0, 255, (40, 40))
    uv = np.array([[10, 12], [20, 25]])
    np.testing.assert_allclose(
        keypoints.patches(0.6 * image + 30, uv, 9), keypoints.patches(image, uv, 9), atol=1e-9
    )


OPEN3D = [175, 198, 282, 309, 310, 318, 339, 366, 416, 682]
"""compute_iss_keypoints of Open3D 0.20: an oracle to distrust, its spread is about the neighbours'
mean.
"""


def test_iss_keypoints_are_those_of_loops_about_the_point_and_not_open3ds():
    p = rabbit(800, np.random.default_rng(0))
    tree = scipy.spatial.KDTree(p)

    def by(about_mean: bool) -> set[int]:
        least = np.zeros(len(p))
        for i, near in enumerate(tree.query_ball_point(p, np.full(len(p), 0.2))):
            v = p[near] - (p[near].mean(axis=0) if about_mean else p[i])
            w = np.linalg.eigvalsh(v.T @ v / (len(near) - (not about_mean)))
            if len(near) > 5 and w[1] < 0.975 * w[2] and w[0] < 0.975 * w[1]:
                least[i] = w[0]
        around = tree.query_ball_point(p, np.full(len(p), 0.12))
        return {
            i
            for i in range(len(p))
            if least[i] > max((least[j] for j in around[i] if j != i), default=0.0)
        }

    ours = set(keypoints.iss_keypoints(p, 0.2, 0.12).tolist())
    assert ours == by(False)
    assert by(True) == set(OPEN3D)
    assert len(ours & set(OPEN3D)) < 0.2 * len(ours)


def test_shape_contexts_ignore_scale_and_along_the_tangent_a_turn():
    t = np.linspace(0, 2 * np.pi, 60, endpoint=False)
    p = np.column_stack([2 * np.cos(t) + 0.3 * np.cos(3 * t), np.sin(t) + 0.2 * np.sin(2 * t)])
    R = np.array([[0.6, -0.8], [0.8, 0.6]])
    for along in (False, True):
        own = shape_contexts(p, along_tangent=along)
        np.testing.assert_allclose(own.sum(axis=1), 1)
        assert (
            np.diag(context_costs(own, shape_contexts(7 * p + 3, along_tangent=along))).max() < 0.05
        )
        turned = np.diag(context_costs(own, shape_contexts(p @ R.T, along_tangent=along))).mean()
        assert (turned < 0.02) if along else (turned > 0.3)


def test_outlines_are_assigned_as_scipy_does():
    rng = np.random.default_rng(6)
    a, b = (shape_contexts(rng.normal(size=(40, 2)), along_tangent=False) for _ in range(2))
    cost = context_costs(a, b)
    rows, columns = best_assignment(cost)
    least = cost[scipy.optimize.linear_sum_assignment(cost)].sum()
    assert cost[rows, columns].sum() == pytest.approx(least)
    plainly = [
        [0.5 * sum((x - y) ** 2 / (x + y) for x, y in zip(f, g, strict=True) if x + y) for g in b]
        for f in a[:3]
    ]
    np.testing.assert_allclose(cost[:3], plainly, atol=1e-12)


def test_a_distance_that_is_the_ratio_times_the_second_is_not_less():
    """In integers nothing is left to rounding: 1 is not less than half of 2, wherever the
    descriptors lie.
    """
    for offset in (0.0, 100.0, -7.0):
        b = np.array([[1.0, 0], [0, 2], [9, 0]]) + offset
        a = np.full((1, 2), offset)
        assert matching.mutual_matches(a, b, 0.5).tolist() == [-1]
        assert matching.mutual_matches(a, b, 0.51).tolist() == [0]
        nearest = matching.nearest_both_ways(a, b[[1, 1, 0]])
        assert (nearest.index.tolist(), nearest.distance.tolist(), nearest.second.tolist()) == (
            [2],
            [1.0],
            [2.0],
        )
        assert matching.nearest_both_ways(a, b[[1, 1]]).index.tolist() == [0]
