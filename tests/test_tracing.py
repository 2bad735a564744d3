import numpy as np

from workbench.tracing import describe, listening, source_of, traced, untraced


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
