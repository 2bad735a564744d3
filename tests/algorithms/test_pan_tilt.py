"""The mount's rates against their closed forms, and what a wrong azimuth does."""

import numpy as np
import pytest

from lessons.coordinates.pan_tilt import follow
from workbench.geometry.shapes.curvilinear import spherical_from_cartesian

V = np.array([10.0, 0.0, 0.0])


@pytest.mark.parametrize(("miss", "pan"), [(30.0, 99.2), (10.0, 325), (1.0, 3282), (0.1, 32_828)])
def test_the_pan_rate_is_speed_over_the_distance_from_the_axis(miss, pan):
    beside = 10 * np.tan(np.radians(miss))
    *_, last = follow(
        np.array([0, beside, 10.0]),
        V,
        np.linspace(-1, 1, 9),
        spherical_from_cartesian=spherical_from_cartesian,
    )
    assert np.degrees(last.pan_peak) == pytest.approx(pan, rel=1e-3)
    assert np.degrees(last.sight_peak) == pytest.approx(np.degrees(10 / np.hypot(10, beside)))
    assert np.degrees(last.sight_peak) < 57.3


def test_both_axes_together_turn_the_line_of_sight():
    for state in follow(
        np.array([1.0, 3.0, 8.0]),
        np.array([4.0, -2.0, 1.0]),
        np.linspace(-1, 1, 7),
        spherical_from_cartesian=spherical_from_cartesian,
    ):
        both = np.hypot(state.pan_rate * np.cos(state.tilt), state.tilt_rate)
        assert both == pytest.approx(state.sight_rate, rel=1e-6)
        assert state.off < 1e-12


def test_a_pan_across_half_a_turn_is_no_jump():
    states = list(
        follow(
            np.array([-5.0, 0.0, 3.0]),
            np.array([0.0, 1.0, 0.0]),
            np.array([-0.1, 0.0, 0.1]),
            spherical_from_cartesian=spherical_from_cartesian,
        )
    )
    assert np.ptp([state.pan for state in states]) > 6
    assert max(abs(state.pan_rate) for state in states) < 0.21


def test_a_wrong_azimuth_looks_past_the_target():
    def by_arctan(p):
        c = spherical_from_cartesian(p)
        c[:, 2] = np.arctan(p[:, 1] / p[:, 0])
        return c

    states = list(
        follow(
            np.array([0.0, 5.0, 5.0]), V, np.array([-0.5, 0.5]), spherical_from_cartesian=by_arctan
        )
    )
    assert [state.off > 0.5 for state in states] == [True, False]
