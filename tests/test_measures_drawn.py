"""What is drawn to measure: arcs, dimension lines, arrows and dashes have the lengths and angles
they say.
"""

import numpy as np
import pytest

from workbench.scene import Label, Segments, arc, arrows, circle, dashed, dimension

X, Y, Z = np.eye(3)


@pytest.mark.parametrize("degrees", [1.0, 35.0, -90.0, 270.0])
def test_an_arc_goes_as_far_as_it_says(degrees):
    primitives = arc("a", np.array([1.0, 2.0, 3.0]), 5 * X, degrees, about=2 * Z, radius=0.5)
    line = primitives["a"]
    assert isinstance(line, Segments)
    on_arc = line.ends[:-1]  # the last is the tick
    assert np.allclose(np.linalg.norm(on_arc - [1, 2, 3], axis=2), 0.5)
    assert np.allclose(on_arc[0, 0], [1.5, 2, 3])
    turn = np.radians(degrees)
    assert np.allclose(on_arc[-1, 1], [1 + 0.5 * np.cos(turn), 2 + 0.5 * np.sin(turn), 3])
    words = primitives["a/words"]
    assert isinstance(words, Label)
    assert words.text == f"{abs(degrees):g}°"
    middle = np.array([np.cos(turn / 2), np.sin(turn / 2), 0.0])
    assert np.allclose(words.p, [1, 2, 3] + 1.14 * 0.5 * middle)


def test_an_arc_without_words_has_none():
    assert list(arc("a", np.zeros(3), X, 30, about=Z, radius=1.0, text="")) == ["a"]


def test_a_circle_is_closed_and_across_its_axis():
    segments = circle(np.array([0.0, 0.0, 1.0]), np.array([1.0, 1.0, 0.0]), 2.0)
    assert np.allclose(segments.ends[0, 0], segments.ends[-1, 1])
    assert np.allclose(np.linalg.norm(segments.ends - [0, 0, 1], axis=2), 2.0)
    assert np.allclose((segments.ends - [0, 0, 1]) @ [1.0, 1.0, 0.0], 0.0)


def test_a_dimension_line_says_how_far_points_are_apart():
    primitives = dimension("d", np.zeros(3), 2.12 * X, aside=0.1 * Y)
    line, words = primitives["d"], primitives["d/words"]
    assert isinstance(line, Segments)
    assert isinstance(words, Label)
    assert words.text == "2.12 m"
    assert np.allclose(line.ends[0], [[0, 0.1, 0], [2.12, 0.1, 0]])
    assert len(line.ends) == 3  # with a tick at each end


def test_arrows_end_at_their_tips_with_heads_no_longer_than_half_of_them():
    tails = np.zeros((3, 3))
    tips = np.stack([X, 0.02 * Z, 0 * X])
    segments = arrows(tails, tips, head=0.06)
    assert np.allclose(segments.ends[:3, 1], tips)
    assert len(segments.ends) == 3 + 4 + 4  # one of no length has no head
    for barbs, tip, reach in ((segments.ends[3:7], X, 0.06), (segments.ends[7:], 0.02 * Z, 0.01)):
        assert np.allclose(barbs[:, 0], tip)
        assert np.allclose((barbs[:, 0] - barbs[:, 1]) @ (tip / np.linalg.norm(tip)), reach)


def test_dashes_lie_on_their_line_and_fill_half_of_it():
    corner = np.array([[0.0, 0, 0], [1, 0, 0], [1, 1, 0]])
    segments = dashed(corner, dash=0.05)
    drawn = np.linalg.norm(segments.ends[:, 1] - segments.ends[:, 0], axis=1)
    assert drawn.sum() == pytest.approx(1.0, abs=0.06)
    on_line = (segments.ends[..., 1] == 0) | np.isclose(segments.ends[..., 0], 1)
    assert on_line.all()
