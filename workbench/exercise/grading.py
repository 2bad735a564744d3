"""Judges a function by an exercise's checks, each on its own, and names the mistake it makes."""

import functools
import warnings
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from workbench.errors import one_line
from workbench.exercise.candidate import Call, Candidate
from workbench.exercise.model import Check, Exercise, Function, Mistake, Verdict, fail
from workbench.exercise.sandbox import CallBudget, Student, StudentError, Wall
from workbench.exercise.submission import Submission

Answer = Callable[[Function, Call], tuple[Any, str]]
"""answer(function, call) -> its value, or None and the name of the error."""


@dataclass(frozen=True)
class Outcome:
    """What one check found.

    Attributes:
        check: What was promised.
        verdict: How it was kept.
        kind: Why there was no answer to judge: a `kind` of StudentError (`timeout`, `died`, `raised`, `result`), or nothing.
    """

    check: Check
    verdict: Verdict
    kind: str = ""

    @property
    def points(self) -> float:
        """What was earned."""
        return self.check.points * self.verdict.share


@dataclass(frozen=True)
class Report:
    """What grading one function found.

    Attributes:
        exercise: What was asked.
        file: The student's file, as it was named.
        outcomes: One per check that was run.
        not_run: Checks that were not run here.
        mistake: The known mistake that the function makes, if it fails and one was recognised.
        concerned: The names of the checks in which it makes that mistake.
        printed: The beginning of what the student's code printed.
        wall: What shut the student's code in; nothing where it was ours.
    """

    exercise: Exercise
    file: str
    outcomes: tuple[Outcome, ...]
    not_run: tuple[Check, ...] = ()
    mistake: Mistake | None = None
    concerned: frozenset[str] = frozenset()
    printed: str = field(default="", repr=False)
    wall: Wall | None = None

    @property
    def points(self) -> float:
        """What was earned."""
        return sum(outcome.points for outcome in self.outcomes)

    @property
    def possible(self) -> float:
        """What the checks that were run are worth."""
        return sum(outcome.check.points for outcome in self.outcomes)

    @property
    def is_full(self) -> bool:
        """Whether every check that was run earned all its points."""
        return all(outcome.verdict.share == 1.0 for outcome in self.outcomes)


def grade_file(
    given: Path | Submission,
    exercise: Exercise,
    *,
    hidden: bool = True,
    wall: Wall | None = None,
    megabytes: int | None = None,
) -> Report:
    """Grade a student's file in a process of its own.

    Args:
        given: The file, or what was read of it.
        exercise: What is asked.
        hidden: Whether hidden checks are run too.
        wall: What shuts the process in; the best of this machine by default.
        megabytes: Address space of the process; MEGABYTES by default.

    Raises:
        InputError: If the file cannot be read or does not load; the message names the line.
    """
    seconds = exercise.contract.seconds
    room = {} if megabytes is None else {"megabytes": megabytes}
    with Student(given, exercise.name, seconds=seconds, wall=wall, budget=CallBudget(seconds), **room) as student:
        student.start()
        return grade_function(student, exercise, hidden=hidden, file=student.submission.file)


def grade_function(function: Function, exercise: Exercise, *, hidden: bool = True, file: str = "") -> Report:
    """Grade a callable: a student's function in its process, or one of ours.

    Args:
        function: Called with the checks' arguments.
        exercise: What is asked of it.
        hidden: Whether hidden checks are run too.
        file: How the report names it.
    """
    outcomes: list[Outcome] = []
    failing: dict[str, list[Call]] = {}
    calls: list[Call] = []
    for check in exercise.checks:
        if check.public or hidden:
            candidate = Candidate(function, exercise.reference)
            outcomes.append(_judged(check, candidate))
            calls += candidate.calls
            if outcomes[-1].verdict.share < 1.0:
                failing[check.name] = candidate.calls
    mistake = None
    answer = functools.cache(lambda function, call: _answer(function, call.args))
    for asked in (
        (calls, *failing.values()) if failing else ()
    ):  # who makes two mistakes makes only one of them somewhere
        mistake = mistake or recognised(asked, exercise, answer)
    concerned = frozenset(
        name for name, asked in failing.items() if mistake and _makes(mistake, asked, exercise, answer)
    )
    ours = not isinstance(function, Student)
    return Report(
        exercise,
        file,
        tuple(outcomes),
        tuple(check for check in exercise.checks if not (check.public or hidden)),
        mistake,
        concerned,
        "" if ours else function.printed(),
        None if ours else function.wall,
    )


def _judged(check: Check, candidate: Candidate) -> Outcome:
    """One failure, crash or time-out costs this check only."""
    try:
        verdict = check.judge(candidate)
        return Outcome(check, Verdict(verdict.share, one_line(verdict.message)))
    except StudentError as error:
        return Outcome(check, fail(str(error)), error.kind)
    except Exception as error:  # a check of ours that stumbles over an odd answer must not stop a batch
        return Outcome(check, fail(one_line(f"The answer could not be judged ({type(error).__name__}: {error}).")))


def _makes(mistake: Mistake, calls: Sequence[Call], exercise: Exercise, answer: Answer) -> bool:
    return max(_telling(calls, exercise, form, answer) for form in exercise.forms(mistake)) > 0


def recognised(calls: Sequence[Call], exercise: Exercise, answer: Answer) -> Mistake | None:
    """Return the mistake whose answers equal those of the calls and differ from the right ones; None if there is none.

    Where the contract asks for an error, or leaves the answer open so that right solutions differ, another answer than
    the mistake's does not speak against it.

    Args:
        calls: What the student's function was asked, and what it said.
        exercise: Whose mistakes are compared.
        answer: Gives what one of our functions says to a call.
    """
    best, most = None, 0
    for mistake in exercise.mistakes:
        telling = max(_telling(calls, exercise, form, answer) for form in exercise.forms(mistake))
        if telling > most:
            best, most = mistake, telling
    return best


def _telling(calls: Sequence[Call], exercise: Exercise, wrong: Function, answer: Answer) -> int:
    """Return how many calls were answered as a wrong function does where it is wrong; 0 where one speaks against it."""
    telling = 0
    for call in calls:
        right, mistaken = answer(exercise.reference, call), answer(wrong, call)
        if _alike((call.value, call.error), mistaken):
            telling += not _alike(mistaken, right)
        elif not right[1] and all(_alike(answer(other, call), right) for other in exercise.alternatives):
            return 0
    return telling


def _answer(function: Function, args: tuple[Any, ...]) -> tuple[Any, str]:
    try:
        with np.errstate(all="ignore"), warnings.catch_warnings(action="ignore"):
            return function(*(np.array(arg, copy=True) if isinstance(arg, np.ndarray) else arg for arg in args)), ""
    except Exception as error:
        return None, type(error).__name__


def _alike(a: tuple[Any, str], b: tuple[Any, str]) -> bool:
    (value_a, error_a), (value_b, error_b) = a, b
    if error_a or error_b:
        return error_a == error_b
    return values_alike(value_a, value_b)


def values_alike(a: Any, b: Any) -> bool:
    """Tell whether two answers are the same within rounding: nested tuples, arrays, numbers."""
    if isinstance(a, (tuple, list)) or isinstance(b, (tuple, list)):
        listed = isinstance(a, (tuple, list)) and isinstance(b, (tuple, list)) and len(a) == len(b)
        if listed:
            return all(values_alike(x, y) for x, y in zip(a, b, strict=True))
    try:
        first, second = np.asarray(a, dtype=float), np.asarray(b, dtype=float)
    except (TypeError, ValueError):
        return a is None and b is None
    scale = max(1e-12, float(np.abs(second[np.isfinite(second)]).max(initial=0.0)))
    return first.shape == second.shape and bool(
        np.allclose(first, second, rtol=1e-6, atol=1e-7 * scale, equal_nan=True)
    )
