"""Charts for paper: they say what the step's own plain data say, and nothing that is hidden."""

import re
from xml.etree import ElementTree

import numpy as np
import pytest

from workbench.lesson import catalog
from workbench.page.chart_svg import HIGH, ROW, WIDTH, charts_svg, telling_chart
from workbench.page.steps import Steps
from workbench.run.timeline import Timeline

AXIS = {"low": 0.0, "high": 10.0, "ticks": [0, 5], "words": ["0", "5"]}


def run_of(*things, series=(), end=None) -> dict:
    """A run of six steps, whose step 3 shows things."""
    steps = [{"shown": [] if k != 3 else [*range(len(things))]} for k in range(6)]
    chart = {"name": "rmse", "head": "", "yLabel": "RMSE (m)", "x": AXIS, "y": AXIS}
    return {
        "steps": steps,
        "things": list(things),
        "series": list(series),
        "charts": {"RMSE": chart} if series else {},
        "end": end,
    }


def series(values, **given) -> dict:
    usual = {"path": "rmse", "name": "rmse", "chart": "RMSE", "color": "#0072b2", "log": False}
    return usual | {"values": values} | given


def drawn(run: dict, *names: str, hide=()) -> tuple[ElementTree.Element, int]:
    inside, high = charts_svg(run, 3, names, hide=hide)
    return ElementTree.fromstring(f"<svg>{inside}</svg>"), high


def points(svg: ElementTree.Element) -> list[np.ndarray]:
    return [
        np.array([pair.split(",") for pair in polyline.attrib["points"].split()], float)
        for polyline in svg.iter("polyline")
    ]


def test_a_series_is_drawn_over_the_steps_with_a_line_at_the_step():
    svg, high = drawn(run_of(series=[series([0, 2, 4, 6, 8, 10])]), "rmse")
    (line,) = points(svg)
    assert high == HIGH
    steps = np.diff(line, axis=0)
    assert np.allclose(steps, steps[0], atol=0.1), "equal steps, equal rises"
    assert steps[0][0] > 0 > steps[0][1], "up is up"
    (mark,) = (
        element for element in svg.iter("line") if element.attrib["x1"] == element.attrib["x2"]
    )
    assert float(mark.attrib["x1"]) == pytest.approx(line[3, 0], abs=0.1)
    assert line[:, 0].max() <= WIDTH


def test_what_has_no_value_leaves_a_hole_and_a_logarithm_is_taken():
    svg, _ = drawn(run_of(series=[series([1, 10, None, 1000, -1, 1e5], log=True)]), "rmse")
    first, second, third = points(svg)
    assert (len(first), len(second), len(third)) == (2, 2, 2), "one value alone is a dot"
    rise = first[1, 1] - first[0, 1]
    assert second[0, 1] - first[0, 1] == pytest.approx(3 * rise, abs=0.2)
    assert third[0, 1] - first[0, 1] == pytest.approx(5 * rise, abs=0.2)


def test_tries_behind_the_end_of_the_run_are_left_out():
    (line,) = points(drawn(run_of(series=[series([0, 1, 2, 3, 4, 5])], end=4), "rmse")[0])
    assert len(line) == 5


def plot(**given) -> dict:
    whole = {"name": "cost", "color": "source", "x": [0, 5, 20], "y": [0, 10, 5]}
    mark = {"name": "now", "color": "target", "x": 5, "y": 99, "knob": "", "steps": ""}
    usual = {"kind": "plot", "name": "cost", "title": "Cost", "x_label": "angle", "y_label": "mm"}
    parts = {"near": None, "whole": [whole], "seconds": [], "marks": [mark], "bands": []}
    return usual | {"x": AXIS, "y": AXIS} | parts | given


def test_a_plot_has_its_curve_its_marks_and_stays_within_its_axes():
    svg, _ = drawn(run_of(plot()), "cost")
    (line,) = points(svg)
    assert len(line) == 2, "what lies beyond the axes is not drawn"
    (dot,) = svg.iter("circle")
    assert float(dot.attrib["cy"]) == pytest.approx(line[1, 1], abs=0.1)
    assert float(dot.attrib["cx"]) == pytest.approx(line[1, 0], abs=0.1)
    assert [label.text for label in svg.iter("text")][-1] == "mm, over angle"


def test_what_a_story_hides_is_hidden_on_paper_too():
    assert not list(drawn(run_of(plot()), "cost", hide=["mark"])[0].iter("circle"))
    assert not points(drawn(run_of(plot()), "cost", hide=["cost"])[0])


def test_charts_stand_below_each_other_and_what_is_not_there_is_left_out():
    run = run_of(plot(), series=[series([0, 1, 2, 3, 4, 5])])
    svg, high = drawn(run, "cost", "rmse", "nothing")
    assert high == 2 * ROW
    places = [group.attrib["transform"] for group in svg.findall("g")]
    assert places == ["translate(0 0)", f"translate(0 {ROW})"]
    assert charts_svg(run, 3, ["nothing"]) == ("", 0)
    assert charts_svg(run, 0, ["cost"]) == ("", 0)


def test_words_of_a_lesson_stay_words():
    odd = plot(x_label="<a>", y_label='"&"', x=AXIS | {"words": ["<b>", "5"]})
    inside, _ = charts_svg(run_of(odd), 3, ["cost"])
    assert "<a>" not in inside
    assert "<b>" not in inside
    ElementTree.fromstring(f"<svg>{inside}</svg>")


@pytest.mark.parametrize("name", ["fitting", "features", "graphs"])
def test_a_lesson_has_the_chart_that_it_says_tells_most(name):
    lesson = catalog()[name]
    timeline = Timeline(lesson, lesson.params()).complete()
    run = Steps(timeline).whole()
    k = len(timeline) - 1
    chart = telling_chart(run, k, lesson.telling)
    inside, high = charts_svg(run, k, [chart])
    assert high == HIGH
    assert re.search("<(polyline|circle|rect)", inside)
    assert (
        telling_chart({**run, "charts": {}, "things": []} | {"steps": [{"shown": []}]}, 0, "") == ""
    )
