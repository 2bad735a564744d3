"""What the comparison with Pyodide calls different, without Pyodide."""

import pytest

from tests.computed.compared import apart, differences, verdict

HERE = {
    "stopped": None,
    "captions": ["a", "b"],
    "tones": ["info", "info"],
    "curves": {"rmse": [None, 2.0]},
}


def test_a_run_is_as_it_is():
    assert differences(HERE, {**HERE, "curves": {"rmse": [None, 2.0 + 1e-9]}}) == []


@pytest.mark.parametrize(
    "change",
    [
        {"error": "RuntimeError"},
        {"stopped": "an error"},
        {"captions": ["a"], "tones": ["info"]},
        {"captions": ["a", "c"]},
        {"tones": ["info", "wrong"]},
        {"curves": {}},
        {"curves": {"rmse": [None, 2.0001]}},
        {"curves": {"rmse": [1.0, 2.0]}},
    ],
)
def test_a_difference_is_told(change):
    assert differences(HERE, HERE | change)


def test_values_are_compared_by_their_size():
    assert apart(1e6, 1e6 + 1) == pytest.approx(1e-6)
    assert apart(0.0, 1e-9) == pytest.approx(1e-9)


def test_of_a_verdict_the_marks_count_and_not_the_words():
    assert verdict(["mistake", ["check", 0.5, "words"]]) == ["mistake", ["check", 0.5]]
    assert verdict([None]) == [None]
