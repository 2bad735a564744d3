"""No number earns marks by being too large, too small or none: every exercise is given functions
that answer one number.
"""

from collections.abc import Callable
from typing import Any

import jaxtyping
import numpy as np
import pytest

from workbench.exercise.candidate import held_to_contract
from workbench.exercise.finding import exercises
from workbench.exercise.grading import grade_function
from workbench.exercise.model import Exercise, band
from workbench.exercise.reports import terminal
from workbench.exercise.sandbox import StudentError

NUMBERS = (1e308, -1e308, 1e200, 1e160, 1e100, 1e-200, 1e-320, 0.0, 1.0)
SHARE = 0.25


def filled(value: Any, number: float) -> Any:
    """Return an answer of the same kind and shape, of one number."""
    if isinstance(value, (tuple, list)):
        return tuple(filled(part, number) for part in value)
    kind = np.asarray(value).dtype.kind
    plain: float = number
    if kind == "b":
        plain = bool(number)
    elif kind in "iu":
        plain = int(np.clip(number, -(2**62), 2**62))
    return np.full(np.shape(value), plain) if isinstance(value, np.ndarray) else plain


def answering(exercise: Exercise, made: Callable[[tuple, Any], Any]) -> Callable[..., Any]:
    """Return a function that refuses what ours refuses, and else answers what is made of its
    arguments and our answer.
    """

    def answer(*args):
        return made(args, exercise.reference(*args))

    return answer


def its_own_input(args: tuple, right: Any) -> Any:
    """Return the first argument that has the shape of the answer, else the first."""
    return next((arg for arg in args if np.shape(arg) == np.shape(right)), args[0])


@pytest.mark.parametrize("exercise", exercises().values(), ids=lambda exercise: exercise.name)
def test_no_constant_and_no_input_returned_earns_over_a_quarter(exercise, monkeypatch):
    # checked shapes raise what no contract names
    monkeypatch.setattr(jaxtyping.config, "jaxtyping_disable", True)
    functions = {
        str(number): answering(exercise, lambda _, right, number=number: filled(right, number))
        for number in NUMBERS
    }
    functions["its input"] = answering(exercise, its_own_input)
    for answer, function in functions.items():
        report = grade_function(function, exercise)
        assert report.points <= SHARE * report.possible, f"{answer}\n{terminal(report)}"


@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf])
def test_a_verdict_on_what_is_no_number_fails(value):
    assert band("Error", value, "m", good=np.inf, fair=np.inf, hint="Look.").share == 0.0


@pytest.mark.parametrize("right", [0.5, 1e150])
def test_a_number_too_large_to_compute_with_is_no_answer(right):
    wanted = np.array([right, np.inf])
    held_to_contract(np.array([1e59 * max(1.0, right), np.inf]), wanted, "f")
    with pytest.raises(StudentError, match=r"\[0\] is 1e\+\d+, right is") as told:
        held_to_contract(np.array([1e61 * max(1.0, right), np.inf]), wanted, "f")
    assert told.value.kind == "result"
