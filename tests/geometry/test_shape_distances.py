import numpy as np
import pytest
import scipy
from hypothesis import given, settings
from hypothesis import strategies as st

from workbench.data.files import read_cloud, read_pose
from workbench.geometry.motions import apply, exp_so3, motion
from workbench.geometry.points.shape_distances import (
    DEFINITIONS,
    Definition,
    chamfer,
    chamfer_gradient,
    f_score,
    hausdorff,
    index_mse,
    nearest_both_ways,
    one_sided,
    one_sided_gradient,
)

few = settings(max_examples=25, deadline=None)
seeds = st.integers(0, 10_000)
counts = st.integers(1, 30)


def clouds(seed, n, m):
    rng = np.random.default_rng(seed)
    return rng.normal(size=(n, 3)), rng.normal(size=(m, 3)) + 0.5


def all_distances(p_a, p_b):
    return scipy.spatial.distance.cdist(p_a, p_b)


@few
@given(seeds, counts, counts)
def test_each_definition_is_what_its_name_says(seed, n, m):
    p_a, p_b = clouds(seed, n, m)
    D = all_distances(p_a, p_b)
    d_a, d_b = D.min(1), D.min(0)
    near = nearest_both_ways(p_a, p_b)
    expected: dict[Definition, float] = {
        "mean of squares": np.mean(d_a**2) + np.mean(d_b**2),
        "mean of distances": np.mean(d_a) + np.mean(d_b),
        "sum of squares": np.sum(d_a**2) + np.sum(d_b**2),
        "sum of distances": np.sum(d_a) + np.sum(d_b),
    }
    assert set(expected) == set(DEFINITIONS)
    for definition, value in expected.items():
        assert near.chamfer(definition) == pytest.approx(value, rel=1e-12)
    assert chamfer(p_a, p_b) == pytest.approx(expected["mean of squares"], rel=1e-12)
    assert one_sided(p_a, p_b) == pytest.approx(np.mean(d_a**2), rel=1e-12)
    assert near.one_sided("sum of distances") == pytest.approx(np.sum(d_a), rel=1e-12)
    assert np.array_equal(near.a_to_b, D.argmin(1))
    assert np.array_equal(near.b_to_a, D.argmin(0))


@few
@given(seeds, counts, counts)
def test_hausdorff_agrees_with_scipy(seed, n, m):
    p_a, p_b = clouds(seed, n, m)
    both = max(
        scipy.spatial.distance.directed_hausdorff(p, q)[0] for p, q in ((p_a, p_b), (p_b, p_a))
    )
    assert hausdorff(p_a, p_b) == pytest.approx(both, rel=1e-12)


@few
@given(seeds, counts, counts)
def test_motions_change_nothing_and_scale_is_squared(seed, n, m):
    p_a, p_b = clouds(seed, n, m)
    rng = np.random.default_rng(seed)
    T = motion(exp_so3(rng.normal(size=3)), rng.normal(size=3))
    assert chamfer(apply(T, p_a), apply(T, p_b)) == pytest.approx(chamfer(p_a, p_b), rel=1e-9)
    assert chamfer(3 * p_a, 3 * p_b) == pytest.approx(9 * chamfer(p_a, p_b), rel=1e-12)
    assert hausdorff(3 * p_a, 3 * p_b) == pytest.approx(3 * hausdorff(p_a, p_b), rel=1e-12)
    assert f_score(3 * p_a, 3 * p_b, 1.5) == f_score(p_a, p_b, 0.5)


@few
@given(seeds, counts, counts)
def test_order_of_rows_and_of_clouds_does_not_matter(seed, n, m):
    p_a, p_b = clouds(seed, n, m)
    order = np.random.default_rng(seed).permutation(n)
    assert chamfer(p_a[order], p_b) == pytest.approx(chamfer(p_a, p_b), rel=1e-12)
    assert chamfer(p_b, p_a) == pytest.approx(chamfer(p_a, p_b), rel=1e-12)
    assert f_score(p_b, p_a, 0.7) == pytest.approx(f_score(p_a, p_b, 0.7))


def test_one_sided_sees_only_its_side():
    p = np.random.default_rng(0).normal(size=(40, 3))
    assert one_sided(p[:10], p) == 0.0
    assert one_sided(p, p[:10]) > 0.1


def test_f_score_by_hand():
    p_a = np.array([[0.0, 0, 0], [1, 0, 0], [2, 0, 0], [9, 0, 0]])
    p_b = np.array([[0.1, 0, 0], [1.0, 0, 0]])
    # 2 of 4 points of a, 2 of 2 of b: harmonic mean of 1/2 and 1
    assert f_score(p_a, p_b, 0.1 + 1e-12) == pytest.approx(2 / 3)
    assert f_score(p_a, p_b + 50, 0.1) == 0.0
    assert f_score(p_a, p_a, 0.0) == 1.0


def test_chamfer_is_no_metric_even_without_squares():
    a = np.zeros((2, 3))
    b = np.array([[0.0, 0, 0], [1, 0, 0]])
    c = np.array([[1.0, 0, 0]] * 2)
    for definition in DEFINITIONS:
        ab, bc, ac = (
            nearest_both_ways(p, q).chamfer(definition) for p, q in ((a, b), (b, c), (a, c))
        )
        assert ac >= 2 * (ab + bc) - 1e-12, definition
    assert chamfer(a, c) == pytest.approx(2.0)
    assert chamfer(a, b) + chamfer(b, c) == pytest.approx(1.0)


def test_zero_for_different_weights():
    p = np.random.default_rng(1).normal(size=(20, 3))
    assert chamfer(p, np.concatenate([p, np.repeat(p[:1], 30, axis=0)])) == 0.0


def test_index_pairs_measure_the_order():
    p_a, p_b = clouds(3, 12, 12)
    assert index_mse(p_a, p_b) == pytest.approx(np.mean(np.sum((p_a - p_b) ** 2, axis=1)))
    assert index_mse(p_a, p_a) == 0.0
    assert index_mse(p_a, np.roll(p_a, 1, axis=0)) > 1.0
    with pytest.raises(ValueError, match="equal counts, not 12 and 11"):
        index_mse(p_a, p_b[:11])


@pytest.mark.parametrize("distance", [chamfer, one_sided])
def test_gradients_agree_with_finite_differences(distance):
    gradient = {chamfer: chamfer_gradient, one_sided: one_sided_gradient}[distance]
    for seed, (n, m) in enumerate([(1, 1), (7, 12), (12, 7), (20, 20)]):
        p_a, p_b = clouds(seed, n, m)
        slope = gradient(p_a, p_b)
        v = np.random.default_rng(seed).normal(size=p_a.shape)
        h = 1e-6
        along = (distance(p_a + h * v, p_b) - distance(p_a - h * v, p_b)) / (2 * h)
        assert np.vdot(slope, v) == pytest.approx(along, rel=1e-6, abs=1e-8)


def test_large_clouds_take_the_same_answer_in_tree_order():
    p_a, p_b = clouds(5, 6000, 5000)
    d_a, a_to_b = scipy.spatial.KDTree(p_b).query(p_a)
    near = nearest_both_ways(p_a, p_b)
    assert np.array_equal(near.a_to_b, a_to_b)
    assert np.array_equal(near.d_a, d_a)
    assert one_sided(p_a, p_b) == pytest.approx(np.mean(np.asarray(d_a) ** 2), rel=1e-12)


@pytest.mark.parametrize("distance", [chamfer, one_sided, hausdorff, index_mse])
def test_empty_and_not_finite_are_refused(distance):
    p = np.ones((3, 3))
    with pytest.raises(ValueError, match="no points"):
        distance(p, np.empty((0, 3)))
    with pytest.raises(ValueError, match="not finite"):
        distance(p, np.array([[0.0, 0, np.nan]] * 3))


def test_many_equal_points_and_points_on_a_line():
    p = np.zeros((50, 3))
    q = np.column_stack([np.linspace(0, 1, 50), np.zeros(50), np.zeros(50)])
    assert chamfer(p, p) == 0.0
    assert one_sided(p, q) == 0.0
    assert one_sided(q, p) == pytest.approx(np.mean(q[:, 0] ** 2))


def test_two_scans_of_the_bunny_overlap_as_documented(shared_data):
    scans = [shared_data / "icp" / name for name in ("bun000.ply", "bun045.ply")]
    p_target, p_source = (read_cloud(scan) for scan in scans)
    T_target_source = read_pose(shared_data / "icp" / "bun.conf", *scans)
    near = nearest_both_ways(apply(T_target_source, p_source), p_target)
    assert np.mean(near.d_a <= 1e-3) == pytest.approx(0.91, abs=0.01)
    assert (
        near.chamfer("mean of distances")
        < nearest_both_ways(p_source, p_target).chamfer("mean of distances") / 3
    )
