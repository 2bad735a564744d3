import numpy as np
import pytest

from lessons.distances.stages import finer_grids, finer_spheres
from workbench.cached import cached
from workbench.knobs import Params, knob
from workbench.lesson import catalog
from workbench.run.timeline import Timeline
from workbench.tracing import describe, listening, source_of, traced, untraced


class Few(Params):
    n: int = knob(3, "How many", 1, 9)


@traced
def inner(n):
    for i in range(n):
        square = i * i
        yield square, object()


@traced
def outer(n):
    yield "first"
    yield from inner(n)


def moments(generator):
    traces = []
    with listening() as last:
        for _ in generator:
            traces.append(last())
    return traces


def test_the_line_and_the_locals_of_the_yield_are_known():
    first = moments(inner(3))
    lines, start = source_of(inner)
    assert lines[0] == "def inner(n):"
    assert [lines[m.line - start].strip() for m in first] == ["yield square, object()"] * 3
    assert [{v.name: v.value for v in m.variables}["square"] for m in first] == ["0", "1", "4"]


def test_the_generator_that_did_the_work_is_reported():
    names = [m.function.__name__ for m in moments(outer(2))]
    assert names == ["outer", "inner", "inner"]


def test_a_run_inside_a_run_can_go_unwatched():
    @traced
    def around():
        yield "before"
        with untraced():
            *_, last = inner(3)
        yield last

    assert [m.function.__name__ for m in moments(around())] == ["around", "around"]


def test_what_is_kept_reports_nothing_when_it_is_computed_either():
    @cached
    def total(params):
        return sum(square for square, _ in inner(params.n))

    with listening() as last:
        assert total(Few(n=4)) == 14
        assert last() is None


@pytest.mark.parametrize(
    ("name", "preset", "kept"),
    [
        ("distances", "staircase", finer_grids),
        ("distances", "points", finer_spheres),
    ],
)
def test_a_step_s_code_does_not_depend_on_what_ran_before(name, preset, kept):
    lesson = catalog()[name]
    kept.cache_clear()
    first, again = (
        Timeline(lesson, lesson.preset(preset).params).complete().known() for _ in range(2)
    )
    for before, after in zip(first, again, strict=True):
        assert before.moment
        assert after.moment
        assert before.moment.function is after.moment.function
        assert before.moment.line == after.moment.line


def test_nobody_listening_records_nothing():
    list(inner(3))
    with listening() as last:
        assert last() is None


def test_locals_are_described_by_shape_and_range():
    assert describe("p", np.arange(12.0).reshape(4, 3)).shape == "4 × 3"
    assert describe("p", np.arange(12.0).reshape(4, 3)).value == "0 … 11"
    assert describe("keep", np.array([True, False, True, True, True])).value == "4 of 5 true"
    assert describe("n", 12_000).value == "12,000"
    assert describe("e", np.zeros((0, 3))).value == "empty"
    assert describe("T", None).value == "None"
