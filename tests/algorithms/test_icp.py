"""ICP: laws of its cost, exact answers, stops with reasons, and real scans."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.algorithms.rabbits import SEEDS, rabbits, turned
from workbench.algorithms.registration.icp import Gate, State, Stop, bounding_corners, icp, nearest
from workbench.data.files import read_cloud, read_pose
from workbench.geometry.motions import apply, inverse, motion, rotation_angle
from workbench.geometry.motions.alignment import (
    align_affine,
    align_rigid,
    align_similarity,
    nearest_rotation,
)
from workbench.geometry.points.normals import point_normals
from workbench.tracing import listening


def degrees_off(T: np.ndarray, T_true: np.ndarray) -> float:
    return float(np.degrees(rotation_angle(nearest_rotation(T[:3, :3]) @ T_true[:3, :3].T)))


def last(states) -> State:
    *_, state = states
    return state


class TestLaws:
    @settings(max_examples=15, deadline=None)
    @given(
        seed=SEEDS,
        angle=st.floats(0, 180),
        keep=st.floats(0.4, 1),
        align=st.sampled_from([align_rigid, align_similarity, align_affine]),
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
    scans = rabbits()
    calls = []

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
