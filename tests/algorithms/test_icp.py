"""ICP: laws of its cost and its gates, exact answers, stops with reasons, and real scans."""

import numpy as np
import pytest
import scipy
from hypothesis import given, settings
from hypothesis import strategies as st

from workbench.algorithms.registration import icp as module
from workbench.algorithms.registration.icp import Gate, State, Stop, bounding_corners, icp, nearest
from workbench.data.files import read_cloud, read_pose
from workbench.data.shapes.clouds import pair
from workbench.geometry.motions import apply, exp_so3, inverse, motion, rotation_angle
from workbench.geometry.motions.alignment import (
    align_affine,
    align_rigid,
    align_similarity,
    nearest_rotation,
)
from workbench.geometry.points.normals import point_normals
from workbench.tracing import listening

SEEDS = st.integers(0, 1000)


def turned(degrees: float, axis=(0.0, 0.0, 1.0), t=(0.0, 0.0, 0.0)) -> np.ndarray:
    return motion(exp_so3(np.radians(degrees) * np.array(axis)), np.array(t))


def rabbits(degrees: float = 20, n: int = 400, seed: int = 0, **options):
    return pair("rabbit", n, turned(degrees), rng=np.random.default_rng(seed), **options)


def degrees_off(T: np.ndarray, T_true: np.ndarray) -> float:
    return float(np.degrees(rotation_angle(nearest_rotation(T[:3, :3]) @ T_true[:3, :3].T)))


def last(states) -> State:
    *_, state = states
    return state


class TestNearest:
    def test_it_agrees_with_looking_at_every_pair(self):
        rng = np.random.default_rng(0)
        for n in (1, 7, 3000):  # the last is searched by several threads
            p_target, p_source = rng.standard_normal((200, 3)), rng.standard_normal((n, 3))
            expected = scipy.spatial.distance.cdist(p_source, p_target).argmin(axis=1)
            np.testing.assert_array_equal(nearest(p_target, p_source), expected)

    def test_it_is_not_symmetric(self):
        p_target, p_source = (
            np.array([[0.0, 0, 0], [1.0, 0, 0]]),
            np.array([[0.4, 0, 0], [0.45, 0, 0]]),
        )
        assert nearest(p_target, p_source).tolist() == [0, 0]
        assert nearest(p_source, p_target).tolist() == [0, 1]

    @pytest.mark.parametrize(("a", "b"), [(0, 3), (3, 0)])
    def test_empty_clouds_are_refused(self, a, b):
        with pytest.raises(ValueError, match="no points"):
            nearest(np.zeros((a, 3)), np.zeros((b, 3)))

    def test_the_tree_is_built_once(self, monkeypatch):
        built = []

        class Counting(scipy.spatial.KDTree):
            def __init__(self, p, *args, **options):
                built.append(len(p))
                super().__init__(p, *args, **options)

        monkeypatch.setattr(scipy.spatial, "KDTree", Counting)
        scans = rabbits(n=300)
        states = list(icp(scans.p_target, scans.p_source[:200]))
        assert len(states) > 10
        assert built == [300, 200]  # the target's, and the order in which the source is visited


class TestGate:
    @settings(max_examples=50, deadline=None)
    @given(SEEDS, st.floats(0.05, 1), st.floats(1, 5), st.floats(0.1, 3))
    def test_the_smallest_limit_counts(self, seed, keep, medians, *, max_distance):
        distances = np.abs(np.random.default_rng(seed).standard_normal(50))
        limit = Gate(max_distance, keep, medians).limit(distances)
        near = np.sort(distances[distances <= max_distance])
        assert limit <= max_distance
        if len(near):
            kept = np.count_nonzero(distances <= limit)
            assert 1 <= kept <= int(np.ceil(keep * len(near)))
            assert limit <= medians * np.median(near) + 1e-12

    def test_trimming_keeps_exactly_the_closest_share(self):
        distances = np.random.default_rng(0).permutation(np.arange(1.0, 101.0))
        assert Gate(keep=0.7).limit(distances) == 70.0
        assert Gate(keep=1.0).limit(distances) == np.inf
        assert Gate(medians=3.0).limit(distances) == 151.5

    def test_perfect_matches_are_all_kept_by_the_median(self):
        distances = np.zeros(10)
        assert np.all(distances <= Gate(medians=3.0).limit(distances))

    @pytest.mark.parametrize(
        "values", [{"keep": 0.0}, {"keep": 1.5}, {"max_distance": 0.0}, {"medians": 0.5}]
    )
    def test_misuse_is_refused(self, values):
        with pytest.raises(ValueError, match="needed"):
            Gate(**values)


class TestLaws:
    @settings(max_examples=15, deadline=None)
    @given(
        SEEDS,
        st.floats(0, 180),
        st.floats(0.4, 1),
        st.sampled_from([align_rigid, align_similarity, align_affine]),
    )
    def test_the_cost_never_rises_from_anywhere(self, seed, angle, keep, *, align):
        scans = rabbits(angle, 150, seed, noise=0.01, outliers=0.1)
        states = list(
            icp(
                scans.p_target, scans.p_source, gate=Gate(keep=keep), align=align, max_iterations=25
            )
        )
        rmses = np.array([state.rmse for state in states])  # match, fit, match, fit, ...
        assert np.all(np.diff(rmses) <= 1e-12)

    @settings(max_examples=10, deadline=None)
    @given(SEEDS, st.booleans())
    def test_moving_both_clouds_moves_every_step(self, seed, plane):
        rng = np.random.default_rng(seed)
        scans = rabbits(25, 150, seed)
        T_new_target, T_new_source = (
            turned(d, a, rng.uniform(-5, 5, 3)) for d, a in ((50, (1, 0, 0)), (-70, (0, 1, 0)))
        )
        n = point_normals(scans.p_target) if plane else None
        states = list(icp(scans.p_target, scans.p_source, n_target=n, max_iterations=8))
        two = list(
            icp(
                apply(T_new_target, scans.p_target),
                apply(T_new_source, scans.p_source),
                T_new_target @ inverse(T_new_source),
                n_target=None if n is None else n @ T_new_target[:3, :3].T,
                max_iterations=8,
            )
        )
        for a, b in zip(states, two, strict=True):
            np.testing.assert_array_equal(a.indices, b.indices)
            np.testing.assert_allclose(
                T_new_target @ a.T_target_source @ inverse(T_new_source),
                b.T_target_source,
                atol=1e-8,
            )

    @pytest.mark.parametrize("plane", [False, True], ids=["point-to-point", "point-to-plane"])
    def test_the_same_points_moved_are_found_exactly(self, plane):
        p_target = rabbits(n=500).p_target
        T = turned(12, t=(0.02, -0.01, 0.03))
        n = point_normals(p_target) if plane else None
        end = last(icp(p_target, apply(inverse(T), p_target), n_target=n))
        assert end.stop is Stop.CONVERGED
        np.testing.assert_allclose(end.T_target_source, T, atol=1e-9)
        assert end.rmse < 1e-9
        assert end.overlap == 1.0
        np.testing.assert_array_equal(end.indices, np.arange(500))

    def test_it_is_right_far_from_the_origin(self):
        scans = rabbits(15, 400)
        near = last(icp(scans.p_target, scans.p_source))
        shift = motion(np.eye(3), np.array([1e6, -1e6, 1e6]))
        far = last(
            icp(apply(shift, scans.p_target), apply(shift, scans.p_source), shift @ inverse(shift))
        )
        end = inverse(shift) @ far.T_target_source @ shift
        assert degrees_off(end, near.T_target_source) < 0.1

    def test_similarity_and_affine_are_found(self):
        p_target = rabbits(n=500).p_target
        S = turned(5) @ np.diag([1.05, 1.05, 1.05, 1.0])
        end = last(
            icp(
                p_target,
                apply(np.linalg.inv(S), p_target),
                align=align_similarity,
                max_iterations=200,
            )
        )
        np.testing.assert_allclose(end.T_target_source, S, atol=1e-8)
        A = np.eye(4)
        A[0, 1], A[2, 2] = 0.05, 0.95
        end = last(
            icp(p_target, apply(np.linalg.inv(A), p_target), align=align_affine, max_iterations=200)
        )
        np.testing.assert_allclose(end.T_target_source, A, atol=1e-8)


class TestStates:
    def test_match_and_fit_take_turns_and_say_what_changed(self):
        scans = rabbits()
        states = list(icp(scans.p_target, scans.p_source, gate=Gate(keep=0.8)))
        assert [s.phase for s in states] == ["match", "fit"] * (len(states) // 2)
        assert [s.iteration for s in states] == [1 + i // 2 for i in range(len(states))]
        for match, fit in zip(states[::2], states[1::2], strict=True):
            np.testing.assert_array_equal(match.indices, fit.indices)
            p_moved = apply(fit.T_target_source, scans.p_source)
            d = np.linalg.norm(p_moved - scans.p_target[fit.indices], axis=1)
            np.testing.assert_allclose(fit.distances, d, atol=1e-12)
            assert fit.rmse == pytest.approx(np.sqrt(np.mean(d[fit.kept] ** 2)))
            assert np.all(match.distances[match.kept] <= match.limit)
            assert match.overlap == pytest.approx(0.8)
            assert fit.residual == fit.rmse
        for fit, match in zip(states[1::2], states[2::2], strict=False):
            np.testing.assert_array_equal(fit.T_target_source, match.T_target_source)
        assert [s.stop for s in states[:-1]] == [None] * (len(states) - 1)
        assert states[-1].stop is Stop.CONVERGED

    def test_the_residual_of_planes_is_the_distance_to_them(self):
        scans = rabbits()
        n = point_normals(scans.p_target)
        end = last(icp(scans.p_target, scans.p_source, n_target=n))
        gap = scans.p_target[end.indices] - apply(end.T_target_source, scans.p_source)
        assert end.residual == pytest.approx(
            np.sqrt(np.mean(np.sum(gap * n[end.indices], axis=1) ** 2))
        )
        assert end.residual < end.rmse

    def test_its_line_and_locals_can_be_watched(self):
        scans = rabbits(n=50)
        with listening() as moment:
            next(icp(scans.p_target, scans.p_source))
            seen = moment()
        assert seen is not None
        lines, first = seen.source
        assert "yield" in lines[seen.line - first]
        assert {"indices", "kept", "p_moved", "T_target_source"} <= {v.name for v in seen.variables}


class TestStops:
    def test_at_the_maximum_of_iterations(self):
        scans = rabbits()
        states = list(icp(scans.p_target, scans.p_source, max_iterations=3))
        assert len(states) == 6
        assert states[-1].stop is Stop.MAX_ITERATIONS

    @pytest.mark.parametrize("plane", [False, True])
    def test_when_too_few_matches_are_left(self, plane):
        scans = rabbits()
        n = point_normals(scans.p_target) if plane else None
        states = list(
            icp(scans.p_target, scans.p_source + 100.0, n_target=n, gate=Gate(max_distance=1.0))
        )
        assert [s.stop for s in states] == [Stop.TOO_FEW_MATCHES]
        assert np.isnan(states[0].rmse)
        assert states[0].overlap == 0.0

    def test_when_a_fit_is_not_finite(self):
        scans = rabbits()
        end = last(
            icp(
                scans.p_target,
                scans.p_source,
                align=lambda p_target, p_source: np.full((4, 4), np.nan),
            )
        )
        assert end.stop is Stop.NOT_FINITE
        assert np.isfinite(end.T_target_source).all()

    def test_when_it_goes_round_in_a_circle(self):
        p = np.random.default_rng(0).standard_normal((60, 3))
        turns = iter([turned(20), turned(-20)] * 10)
        end = last(icp(p, p, align=lambda p_target, p_source: next(turns)))
        assert end.stop is Stop.CIRCLING
        assert end.iteration <= 5

    def test_every_reason_is_a_sentence(self):
        assert all(len(stop.message) > 20 for stop in Stop)


class TestDegenerate:
    @pytest.mark.parametrize("n", [1, 2])
    def test_one_or_two_points_are_too_few(self, n):
        p = np.random.default_rng(0).standard_normal((n, 3))
        assert last(icp(p, p)).stop is Stop.TOO_FEW_MATCHES

    @pytest.mark.parametrize(
        "p",
        [
            np.outer(np.arange(20.0), [1.0, 2.0, 0.5]),
            np.random.default_rng(1).random((40, 3)) * [1, 1, 0],
            np.ones((9, 3)),
        ],
        ids=["collinear", "coplanar", "duplicates"],
    )
    def test_flat_and_thin_clouds_are_brought_together(self, p):
        end = last(icp(p, apply(turned(2, t=(0.01, 0, 0)), p)))
        assert end.stop is Stop.CONVERGED
        assert np.isfinite(end.T_target_source).all()
        assert np.linalg.det(end.T_target_source[:3, :3]) == pytest.approx(1.0)

    def test_nan_and_empty_are_refused_at_the_first_step(self):
        p = np.random.default_rng(0).standard_normal((9, 3))
        bad = p.copy()
        bad[4] = np.nan
        with pytest.raises(ValueError, match="not finite"):
            next(icp(p, bad))
        with pytest.raises(ValueError, match="no points"):
            next(icp(p[:0], p))


def test_corners_bound_the_motion_of_every_point():
    p = np.random.default_rng(0).standard_normal((100, 3))
    A = np.eye(4)
    A[:3] += np.random.default_rng(1).standard_normal((3, 4))
    most = np.linalg.norm(apply(A, bounding_corners(p)) - bounding_corners(p), axis=1).max()
    assert np.linalg.norm(apply(A, p) - p, axis=1).max() <= most + 1e-12


def test_ones_own_functions_are_called_with_target_first():
    scans, calls = rabbits(), []

    def match(p_target, p_source):
        calls.append((len(p_target), len(p_source)))
        return np.repeat(nearest(p_target, p_source), 2)[::2]  # however it lies in memory

    def align(p_target, p_source):
        calls.append("align")
        return align_rigid(p_target, p_source)

    p_source = scans.p_source[:300]
    theirs = list(icp(scans.p_target, p_source, match=match, align=align, max_iterations=4))
    assert calls == [(400, 300), "align"] * 4
    for a, b in zip(theirs, icp(scans.p_target, p_source, max_iterations=4), strict=True):
        np.testing.assert_array_equal(a.indices, b.indices)
        np.testing.assert_allclose(a.T_target_source, b.T_target_source, atol=1e-12)


class TestRealScans:
    """Final errors against the published poses, from the identity."""

    @pytest.fixture(scope="class")
    def bunny(self, shared_data):
        folder = shared_data / "icp"
        target, source = folder / "bun000.ply", folder / "bun045.ply"
        return (
            read_cloud(target),
            read_cloud(source)[::8],
            read_pose(folder / "bun.conf", target, source),
        )

    @pytest.fixture(scope="class")
    def lidar(self, shared_data):
        folder = shared_data / "icp"
        target, source = folder / "car_cloud400.csv", folder / "car_cloud401.csv"
        return (
            read_cloud(target),
            read_cloud(source)[::2],
            read_pose(folder / "carCloudList.csv", target, source),
        )

    @pytest.mark.parametrize("plane", [False, True], ids=["point-to-point", "point-to-plane"])
    @pytest.mark.parametrize("scans", ["bunny", "lidar"])
    def test_trimmed_icp_from_the_identity(self, request, scans, plane):
        p_target, p_source, T_true = request.getfixturevalue(scans)
        n = point_normals(p_target) if plane else None
        end = last(icp(p_target, p_source, n_target=n, gate=Gate(keep=0.9), tolerance=1e-5))
        assert end.stop is Stop.CONVERGED
        assert degrees_off(end.T_target_source, T_true) < 0.3
        off = np.linalg.norm(end.T_target_source[:3, 3] - T_true[:3, 3])
        assert off < (0.0005 if scans == "bunny" else 0.03)

    def test_without_trimming_the_bunny_is_over_a_degree_off(self, bunny):
        p_target, p_source, T_true = bunny
        end = last(icp(p_target, p_source, tolerance=1e-5))
        assert degrees_off(end.T_target_source, T_true) > 1.0


def test_the_matcher_leaves_its_arguments_alone():
    p = np.random.default_rng(0).standard_normal((30, 3))
    p.setflags(write=False)
    module.matcher(p, p)(p, p)


@pytest.mark.parametrize("step", [1.0, 0.1, 0.01, 0.001])
@pytest.mark.parametrize("m", [1, 2, 300])
def test_the_matcher_keeps_a_partner_only_while_no_other_is_nearer(m, step):
    rng = np.random.default_rng(m)
    p_target, p_source = rng.standard_normal((m, 3)), rng.standard_normal((500, 3))
    match = module.matcher(p_target, p_source)
    for _ in range(20):  # a walk, so that moves since the search add up and cancel
        expected = scipy.spatial.distance.cdist(p_source, p_target).argmin(axis=1)
        np.testing.assert_array_equal(match(p_target, p_source), expected)
        p_source = p_source + step * rng.standard_normal(p_source.shape)


@pytest.mark.parametrize("searched_before", [False, True])
def test_the_matcher_refuses_a_point_that_is_not_finite(searched_before):
    p = np.random.default_rng(0).standard_normal((30, 3))
    match = module.matcher(p, p)
    if searched_before:
        match(p, p)
    with pytest.raises(ValueError, match="finite"):
        match(p, np.where(np.arange(30)[:, None] == 3, np.nan, p))
