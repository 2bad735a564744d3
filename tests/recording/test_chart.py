"""Charts drawn by hand: ticks are round, everything stays inside the frame."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from workbench.recording.chart import (
    BOTTOM,
    LEFT,
    LEGEND_WIDTH,
    RIGHT,
    TOP,
    WIDTH,
    bar_of,
    chart_curves,
    chart_frame,
    color_bar,
    legend_height,
    legend_names,
    scales,
)
from workbench.scene import PALETTE, Curve, Field, color_map

finite = st.floats(-1e6, 1e6)


def curve(x, y, **looks) -> Curve:
    return Curve(np.array(x, float), np.array(y, float), "a", "chart", "x", **looks)


def drawn(*curves: Curve):
    """Return the lines and the dots of a chart."""
    return chart_curves(*scales(curves), dict(enumerate(curves)))


def words_of(*curves: Curve):
    """Return the words around a chart."""
    names = [(curve.name, PALETTE[curve.color]) for curve in curves]
    return chart_frame(*scales(curves), "x", names=names)[1]


@given(
    st.lists(st.tuples(finite, finite | st.just(float("nan"))), min_size=1, max_size=20),
    st.sampled_from(["line", "dots", "bars"]),
)
def test_everything_stays_inside_the_frame(points, kind):
    x, y = np.array(points).T
    lines, dots = drawn(curve(np.sort(x), y, kind=kind, marks=(float(x[0]),)))
    places = [np.array(strip) for strip in lines.strips.as_arrow_array().to_pylist()]
    places.append(np.array(dots.positions.as_arrow_array().to_pylist()).reshape(-1, 2))
    whole = np.concatenate(places)
    assert (whole >= (LEFT - 0.01, TOP - 0.01)).all()
    assert (whole <= (RIGHT + 0.01, BOTTOM + 0.01)).all()


def test_a_gap_splits_a_line_and_a_lonely_value_is_a_dot():
    lines, dots = drawn(curve(range(6), [1, 2, np.nan, 3, np.nan, 4]))
    assert len(lines.strips.as_arrow_array()) == 1
    assert len(dots.positions.as_arrow_array()) == 2


def test_bars_stand_on_zero():
    lines, _ = drawn(curve([0, 1], [2, 4], kind="bars"))
    feet = [max(y for _, y in strip) for strip in lines.strips.as_arrow_array().to_pylist()]
    tops = [min(y for _, y in strip) for strip in lines.strips.as_arrow_array().to_pylist()]
    assert feet == pytest.approx([BOTTOM, BOTTOM])
    assert BOTTOM - tops[1] == pytest.approx(2 * (BOTTOM - tops[0]), rel=1e-6)


def test_the_frame_of_a_chart_changes_with_its_range_alone():
    original, same_range = curve([0, 1, 2], [0, 1, 2]), curve([0, 1, 2], [0, 2, 1])
    assert scales([original]) == scales([same_range])
    assert scales([original]) != scales([curve([0, 1, 2], [0, 1, 3])])
    assert {"0", "1", "2", "x", "a"} <= set(words_of(original).labels.as_arrow_array().to_pylist())


def test_a_colour_bar_has_its_ends_its_unit_and_its_colours():
    field = Field(np.zeros(1), -2.0, 2.0, "Offset", "m", "diverging")
    bar, ends = color_bar(**bar_of(field), at=(0.0, 0.0), width=100.0)
    assert ends.labels.as_arrow_array().to_pylist() == ["−2", "Offset (m)", "2"]
    colors = bar.colors.as_arrow_array().to_pylist()
    first, last = color_map("diverging", np.array([0.0, 1.0]))
    assert [colors[0] >> 24, colors[0] >> 16 & 255, colors[0] >> 8 & 255] == list(first)
    assert [colors[-1] >> 24, colors[-1] >> 16 & 255, colors[-1] >> 8 & 255] == list(last)


def test_a_long_legend_takes_more_rows():
    entries = tuple((f"a rather long name {i}", PALETTE["target"]) for i in range(9))
    _, names = legend_names(entries)
    places = np.array(names.positions.as_arrow_array().to_pylist())
    assert places[:, 0].max() < LEGEND_WIDTH
    assert legend_height(entries, 0) > legend_height(entries[:2], 0)
    assert legend_height(entries, 1) > legend_height(entries, 0)
    assert legend_height((), 0) == 0


def test_the_colours_of_a_legend_stand_above_its_names():
    dashes, names = legend_names((("source", PALETTE["source"]), ("target", PALETTE["target"])))
    ends = np.array(dashes.strips.as_arrow_array().to_pylist())
    places = np.array(names.positions.as_arrow_array().to_pylist())
    assert (ends[..., 1].max(axis=1) < places[:, 1]).all()
    np.testing.assert_allclose(ends[..., 0].mean(axis=1), places[:, 0])


def test_the_names_of_many_curves_stay_on_the_canvas():
    names = ["estimate", "95 % interval", "its lower end", "truth"]
    words = words_of(
        *(Curve(np.arange(3.0), np.arange(3.0), name, "errors", "x") for name in names)
    )
    labels = words.labels.as_arrow_array().to_pylist()
    across = [words.positions.as_arrow_array().to_pylist()[labels.index(name)][0] for name in names]
    half = [3.3 * len(name) for name in names]
    assert across[0] - half[0] >= 0
    assert across[-1] + half[-1] <= WIDTH
    assert (np.diff(across) > np.add(half[1:], half[:-1])).all()
