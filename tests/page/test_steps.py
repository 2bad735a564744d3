"""The data of a run's steps: equal things once, in any order asked for, by many at once."""

from concurrent.futures import ThreadPoolExecutor
from typing import Any

import numpy as np

from tests import fake
from workbench.page.legend import legend_html
from workbench.page.plots import line_of
from workbench.page.steps import Steps
from workbench.run.timeline import Timeline
from workbench.scene import Chart, Field, Picture


def test_steps_are_the_same_in_whatever_order_they_are_asked_for():
    timeline = Timeline(fake.lesson, fake.Params()).complete()
    forward, backward = Steps(timeline), Steps(timeline)
    told = [forward.step(k) for k in range(len(timeline))]
    for k in reversed(range(len(timeline))):
        step = backward.step(k)
        assert step["caption"] == told[k]["caption"]
        assert [backward.things[n] for n in step["shown"]] == [
            forward.things[n] for n in told[k]["shown"]
        ]
    assert len(forward.things) == len(backward.things)


def test_a_step_is_made_once_for_all_who_ask():
    timeline = Timeline(fake.lesson, fake.Params()).complete()
    steps = Steps(timeline)
    with ThreadPoolExecutor(8) as pool:
        made = list(pool.map(steps.step, [2] * 40))
    assert all(step is made[0] for step in made)


def test_the_code_of_a_step_is_its_moment():
    timeline = Timeline(fake.lesson, fake.Params()).complete()
    steps = Steps(timeline)
    for k, step in enumerate(timeline.known()):
        assert step.moment is not None
        code = steps.code(k)
        assert code is not None
        _, first = step.moment.source
        assert first + code["line"] == step.moment.line
        assert [row[0] for row in code["locals"]] == [
            variable.name for variable in step.moment.variables
        ]
        assert f'data-line="{code["line"]}"' in steps.things[code["source"]]["html"]


def test_the_legend_names_what_is_in_space_and_a_picture_beside_has_a_bar_of_its_own():
    field = Field(np.zeros((2, 3)), 0.0, 31.0, "Disparity", "px")
    assert "Disparity" in legend_html({"map": Picture(field, width=1.0)}, None)
    assert legend_html({"map": Picture(field)}, None) == ""


def test_a_line_is_written_once_for_all_steps_with_its_numbers(monkeypatch):
    written = []

    def noted(curve):
        written.append(curve.name)
        return line_of(curve)

    monkeypatch.setattr("workbench.page.steps.line_of", noted)
    x = np.arange(5.0)
    chart = Chart("Cost")
    steps = Steps(Timeline(fake.lesson, fake.Params()))

    def shown(y: np.ndarray, name: str = "c", color: Any = "source") -> list[int]:
        scene = {"line": chart.whole(x.copy(), y, name, color), "here": chart.mark(1.0, y[1], "m")}
        (n,) = steps._shown(scene)
        return steps.things[n]["whole"]

    first = shown(x**2)
    assert shown(x**2) == first
    assert written == ["c"]
    assert len({*first, *shown(x**3), *shown(x**2, "d"), *shown(x**2, "c", "wrong")}) == 4
    assert shown(np.append(x[:-1], np.nan) ** 2) != first
