"""What the fitting lesson draws: feet and tangents, ellipses, a coin's rim, contours and the way
across them.
"""

import numpy as np
import pytest

from lessons.fitting.lesson import lesson
from lessons.fitting.state import Params
from tests.lessons.fitting_runs import of, states
from workbench.algorithms.least_squares import Walked
from workbench.scene import Curve, Points, Segments, Table

# pictures -----------------------------------------------------------------------------------------


def test_feet_lie_on_the_shape_and_tangents_touch_it():
    for name in ("home", "sphere", "cylinder"):
        state = of(name)[1]
        scene = lesson.draw(state)
        ends = scene["distances"]
        assert isinstance(ends, Segments)
        feet = ends.ends[:, 1, : state.subject.p.shape[1]]
        off, _ = state.subject.kind.linearise(state.now.now.unknown, feet)
        np.testing.assert_allclose(off, 0, atol=1e-9)
    tangents = lesson.draw(of("home")[1])["tangents"]
    assert isinstance(tangents, Segments)
    middles = tangents.ends.mean(axis=1)[:, :2] - [0.5, 0.4]
    np.testing.assert_allclose(np.linalg.norm(middles, axis=1), 0.7)


def test_the_ellipse_holds_most_centres_measured_anew():
    state = of("repetition")[-1]
    spread = state.now
    off = spread.centers - spread.centers.mean(axis=0)
    inside = np.einsum("ki,ij,kj->k", off, np.linalg.inv(spread.covariance[:2, :2]), off) < 2.448**2
    assert inside.mean() > 0.9
    scene = lesson.draw(state)
    assert isinstance(scene["table"], Table)
    bars, bell = scene["radii"], scene["bell"]
    assert isinstance(bars, Curve)
    assert isinstance(bell, Curve)
    assert bars.y.sum() == 300
    assert bell.y.sum() == pytest.approx(300, rel=0.05)


def test_the_coins_rim_lies_on_the_photograph():
    scene = lesson.draw(of("coin")[0])
    picture, rim = scene["photograph"], scene["rim"]
    assert isinstance(rim, Points)
    coin = of("coin")[0].subject.rim
    uv = coin.center + coin.radius * rim.p[:, :2] * [1, -1]
    np.testing.assert_allclose(picture.places(uv)[:, :2], rim.p[:, :2], atol=1e-9)  # type: ignore[union-attr]


def cost_of_centre(p: np.ndarray, centre: np.ndarray) -> float:
    return float(len(p) * np.linalg.norm(p - centre, axis=1).var())


def test_contours_are_where_centres_are_equally_good():
    state = of("home")[0]
    valley = lesson.draw(state)["valley"]
    assert isinstance(valley, Segments)
    costs = np.array(
        [cost_of_centre(state.subject.p, at) for at in valley.ends[::7, :, :2].mean(axis=1)]
    )
    octaves = np.log2(costs / costs.max())
    assert np.median(np.abs(octaves - octaves.round())) < 0.01
    # the innermost are a few cells wide
    assert np.percentile(np.abs(octaves - octaves.round()), 97) < 0.05
    assert len(np.unique(octaves.round())) >= 7
    # the same points, made once
    assert all(lesson.draw(other)["valley"] is valley for other in of("escape")[::4])
    assert "valley" not in lesson.draw(of("sphere")[0])


@pytest.mark.parametrize("name", ["home", "escape"])
def test_the_way_goes_down_across_the_contours(name):
    walked = [state for state in of(name) if isinstance(state.now, Walked)]
    p = walked[0].subject.p
    down = [cost_of_centre(p, unknown[:2]) for unknown in walked[-1].now.kept[:8]]
    assert (np.diff(down) < 1e-6).all()
    assert len(walked[-1].now.kept) == 1 + sum(
        state.now.now.phase == "accepted" for state in walked
    )
    between_both = [cost_of_centre(p, np.array([x, 0.0])) for x in np.linspace(0.3, 2.5, 12)]
    assert max(between_both) > 2.5 * max(between_both[0], between_both[-1])  # a hill


def test_each_kind_of_step_is_seen_on_the_contours():
    far = Params(start=(0.9, 0.6, 0.0), start_radius=0.3, arc=45.0)
    seen = {
        state.now.now.phase: (state, lesson.draw(state))
        for state in states(far)
        if isinstance(state.now, Walked)
    }
    for phase, color, name in (
        ("tried", "highlight", "trial"),
        ("rejected", "wrong", "taken back"),
    ):
        state, scene = seen[phase]
        step, circle = scene["way/step"], scene["trial"]
        assert isinstance(step, Segments)
        assert isinstance(circle, Segments)
        assert step.color == circle.color == color
        assert circle.name == name
        np.testing.assert_allclose(
            step.ends[0, :, :2], [state.now.now.unknown[:2], state.now.now.trial[:2]]
        )
    assert "way/step" not in seen["accepted"][1]
    assert len(seen["rejected"][0].now.taken_back) >= 1
    centres = seen["rejected"][1]["way/taken back"]
    assert isinstance(centres, Points)
    np.testing.assert_allclose(centres.p[-1, :2], seen["rejected"][0].now.now.trial[:2])


def test_a_way_that_leaves_the_picture_is_cut():
    way = lesson.draw(of("escape")[-1])["way"]
    assert isinstance(way, Segments)
    assert np.abs(way.ends).max() == pytest.approx(4.5)
    assert np.abs(of("escape")[-1].now.kept).max() > 1e4
