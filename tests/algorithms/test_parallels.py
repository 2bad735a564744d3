"""Homogeneous vectors, lines that become parallel, and an eye that steps back."""

import numpy as np
import pytest

from lessons.coordinates.parallels import scale_last, step_back, turn_parallel
from workbench.geometry.shapes.projective import meet


def test_any_factor_names_the_same_point_and_means_need_w_one():
    states = list(
        scale_last(np.array([1.0, 2.0, 3.0]), (1.0, 0.5, 0.0), 3 * np.array([0.0, 0.0, 0.0, 1.0]))
    )
    assert [state.p_h[3] for state in states[:-1]] == [1, 0.5, 0]
    mean = states[-1].mean_h
    assert mean is not None
    # a quarter of the way, not half
    np.testing.assert_allclose(mean[:3] / mean[3], [0.25, 0.5, 0.75])


def test_the_mean_of_vectors_of_the_page():
    mean = (np.array([1.0, 0, 1]) + np.array([0.0, 3, 3])) / 2
    np.testing.assert_allclose(mean[:2] / mean[2], [0.25, 0.75])


def test_the_meeting_runs_away_comes_to_infinity_and_back():
    angles = np.radians([10.0, 1.0, 1e-6, 0.0])
    tilts = (0.1, 0.4)
    states = list(turn_parallel(angles, tilts, 1.0, stops=np.array([0.0, 1, 3, 7]), meet=meet))
    np.testing.assert_allclose(
        [state.x_h[0] / state.x_h[2] for state in states[:3]], 1 / np.tan(angles[:3])
    )
    np.testing.assert_array_equal(states[3].x_h, [-1, 0, 0])
    for state, tilt in zip(states[4:], tilts, strict=True):
        np.testing.assert_allclose(state.x_h[:2] / state.x_h[2], [1 / tilt, 0], atol=1e-12)
        assert state.horizon @ state.x_h == pytest.approx(0, abs=1e-12)
        np.testing.assert_allclose(state.horizon[:2] / state.horizon[2], [-tilt, 0], atol=1e-12)
    np.testing.assert_allclose([state.cross_ratio for state in states], 9 / 7)
    assert states[-1].ratio < 2 < states[0].ratio == pytest.approx(3)
    for state in states:
        np.testing.assert_allclose(state.lines[0] @ state.places.T, 0, atol=1e-12)


@pytest.mark.parametrize(("times", "near"), [(2, 1.0), (10, 0.111), (20, 0.053), (100, 0.0101)])
def test_the_near_side_is_too_large(times, near):
    p = np.array([[1.0, -0.5, 0.0], [1.0, 0.0, 2.0], [1.0, 0.5, 0.0]])
    state = next(step_back(p, 0.5, [times]))
    assert state.near == pytest.approx(near, abs=1e-3)
    np.testing.assert_allclose(state.perspective[:, 0], [1 + state.near, 1, 1 + state.far])
    np.testing.assert_allclose(state.perspective[1], [1, 2])
    np.testing.assert_allclose(state.parallel, p[:, [0, 2]])
