"""The stages of the lesson on axes beside the two scans: an outline that is turned, all frames,
and four starts for ICP.
"""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from scipy.spatial import cKDTree
from scipy.spatial.transform import Rotation

from lessons.axes.inputs import Input
from lessons.axes.lesson import lesson
from lessons.axes.scans import scans_of
from tests.lessons.axes_runs import HOME, made, preset, scene, states, subject, turns
from workbench.certain import sure
from workbench.geometry.motions.principal_axes import principal_axes


class TestFlat:
    def test_variance_and_covariance_are_those_of_the_turned_points(self):
        outline = subject("shadow")
        for held in preset("shadow")[::7]:
            c, s = np.cos(np.radians(held.direction)), np.sin(np.radians(held.direction))
            q = (outline.p - outline.p.mean(axis=0)) @ np.array([[c, -s], [s, c]])
            C = np.cov(q.T, bias=True)
            assert held.variance == pytest.approx(C[0, 0])
            assert held.covariance == pytest.approx(C[0, 1], abs=1e-12)

    def test_longest_and_shortest_are_at_right_angles(self):
        w, V = np.linalg.eigh(np.cov(subject("shadow").p.T, bias=True))
        along = np.degrees(np.arctan2(V[1], V[0])) % 180
        assert subject("shadow").longest == pytest.approx(along[1])
        assert along == pytest.approx([161, 71], abs=0.5)
        assert np.sqrt(w) == pytest.approx([0.243, 0.331], abs=1e-3)

    def test_the_question_stands_at_the_longest_and_the_shortest_shadow(self):
        outline, steps = subject("shadow"), preset("shadow")
        assert steps[24].direction == round(outline.longest)
        assert steps[54].direction == round(outline.longest) + 90

    def test_a_positive_direction_is_counterclockwise_for_the_eye(self):
        params, view = lesson.preset("shadow").params, lesson.preset("shadow").view
        assert view is not None
        away = view.eye[1] < 0  # then x runs to the right
        bar = scene(params, 10)["bar"].ends[0]
        rising = (bar[1] - bar[0])[[0, 2]]
        assert away
        assert rising[0] * rising[1] > 0

    def test_the_lines_at_the_ends_of_the_bar_touch_the_ellipse(self):
        params = lesson.preset("shadow").params
        outline = subject("shadow")
        for k in (0, 10, 24, 41):
            a = np.radians(preset("shadow")[k].direction)
            u = np.array([np.cos(a), np.sin(a)])
            shown = scene(params, k)
            ring = shown["ellipse/line"].ends.reshape(-1, 3)[:, [0, 2]] - outline.centre
            bar = shown["bar"].ends[0][:, [0, 2]] - outline.centre
            assert (ring @ u).max() == pytest.approx((bar @ u).max(), rel=2e-3)

    @pytest.mark.parametrize("name", ["one-aside", "two-aside"])
    def test_one_stray_point_turns_the_longest_direction(self, name):
        _, V = np.linalg.eigh(np.cov(subject(name).p.T, bias=True))
        longest = np.degrees(np.arctan2(V[1, 1], V[0, 1])) % 180
        assert longest == pytest.approx(subject(name).longest)
        opened = preset(name)[lesson.preset(name).step].direction
        assert abs(opened - longest) <= 1.5
        assert len(subject(name).p) == 61


class TestFrames:
    def test_the_entry_passes_zero_where_jacobi_turns_to(self):
        curve = scene(lesson.preset("by-hand").params, 0)["entry/curve"]
        i = int(np.flatnonzero(np.diff(np.sign(curve.y)))[0])
        at = np.interp(0.0, curve.y[i : i + 2], curve.x[i : i + 2])
        assert at == pytest.approx(np.degrees(states(HOME)[3].jacobi.angle), abs=0.05)

    def test_four_frames_half_turns_apart(self):
        frames = preset("frames")[-1].frames
        gaps = sorted(frame.gap for frame in frames)
        np.testing.assert_allclose(gaps, [0, 0.067, 0.083, 0.096], atol=5e-4)
        off = sorted(frame.rotation for frame in frames)
        np.testing.assert_allclose(off, [0, 180, 180, 180], atol=1e-6)

    @pytest.mark.parametrize(
        ("signs", "lit"), [("none", 180), ("largest-entry", 180), ("third-moment", 0)]
    )
    def test_the_lit_frame_is_the_one_that_the_rule_chooses(self, signs, lit):
        params = replace(HOME, signs=signs)
        state = next(step for step in states(params) if step.moment == "signs")
        assert state.frames[state.frame - 1].rotation == pytest.approx(lit, abs=1e-6)
        shown = scene(params, 12)
        bright = [k for k in range(1, 5) if shown[f"four/{k}/source"].opacity == 1.0]
        assert bright == [state.frame]

    def test_another_draw_changes_the_sign_of_the_small_moment(self):
        assert turns("unlucky").home.mean() < 0.1 < 0.85 < turns("fresh").home.mean()


class TestStarts:
    @pytest.mark.parametrize(("seed", "seen"), [(0, 0.8), (1, 1.0), (2, 0.8), (3, 1.0)])
    def test_the_lowest_rmse_is_home(self, seed, seen):
        ended = states(Input(stage="starts", fresh=True, seen=seen, seed=seed))[-1]
        assert ended.off[ended.winner] < 1.0
        low, following = np.sort(ended.rmse)[:2]
        assert low < 0.018 < 0.039 < following
        assert (ended.off < 10).sum() == 1

    def test_rmse_and_error_are_those_of_the_motions_shown(self):
        params = lesson.preset("starts").params
        scans = scans_of(params)
        ended = states(params)[-1]
        for k, T in enumerate(ended.T):
            moved = scans.p_source @ T[:3, :3].T + T[:3, 3]
            gaps = np.sort(cKDTree(scans.p_target).query(moved)[0])
            kept = gaps[: int(np.ceil(0.9 * len(gaps)))]
            assert ended.rmse[k] == pytest.approx(np.sqrt(np.mean(kept**2)), rel=5e-3)
            assert ended.off[k] == pytest.approx(degrees_off(T, scans), abs=1e-6)

    def test_without_a_frame_icp_ends_elsewhere(self):
        T, rmse = states(lesson.preset("starts").params)[-1].alone
        assert degrees_off(T, subject("starts")) > 150
        assert rmse == pytest.approx(0.0487, abs=5e-4)

    def test_at_seven_tenths_one_comes_home_and_at_six_none(self):
        base = lesson.preset("starts").params
        some, none = (states(replace(base, seen=v))[-1] for v in (0.7, 0.6))
        assert (some.off < 1).sum() == 1
        assert np.sort(some.rmse)[1] > 2 * some.rmse.min()
        assert (none.off > 60).all()
        assert np.sort(none.rmse)[1] < 1.15 * none.rmse.min()

    def test_a_vase_has_no_frame_that_is_near(self):
        assert (states(lesson.preset("starts-vase").params)[-1].off > 10).all()

    def test_students_axes_start_icp(self):
        params = lesson.preset("starts").params
        mine = made(params, principal_axes=lambda p: principal_axes(p) * [-1, -1, 1])
        assert mine[-1].off[mine[-1].winner] < 1.0


def degrees_off(T: np.ndarray, scans: Any) -> float:
    R = T[:3, :3] @ sure(scans.T_target_source)[:3, :3].T
    return float(np.degrees(Rotation.from_matrix(R).magnitude()))
