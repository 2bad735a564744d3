"""Judges a function by an exercise's checks, each on its own, and names the mistake it makes."""

from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING

from workbench.errors import one_line
from workbench.exercise.candidate import Candidate
from workbench.exercise.forbidden import forbidden_use
from workbench.exercise.judging import changed
from workbench.exercise.model import Check, Exercise, Function, Mistake, Verdict, fail
from workbench.exercise.naming import concerned, diagnose
from workbench.exercise.seeds import drawn_from
from workbench.exercise.student import StudentError, StudentFunction
from workbench.exercise.submission import Submission

if TYPE_CHECKING:
    from workbench.exercise.sandbox import Wall


@dataclass(frozen=True)
class Outcome:
    """What one check found.

    Attributes:
        verdict: How the promise was kept.
        kind: Why there was no answer to judge: a `kind` of StudentError, `forbidden`, or nothing.
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
        file: The student's file, as it was named.
        outcomes: One per check that was run.
        not_run: Checks that were not run here.
        mistake: The known mistake that the function makes, if it fails and one was recognised.
        concerned: The names of the checks in which it makes that mistake.
        printed: The beginning of what the student's code printed.
        wall: What shut the student's code in; nothing where it was ours.
        seed: The teacher's number for the hidden checks, None where it was the usual one.
    """

    exercise: Exercise
    file: str
    outcomes: tuple[Outcome, ...]
    not_run: tuple[Check, ...] = ()
    mistake: Mistake | None = None
    concerned: frozenset[str] = frozenset()
    printed: str = field(default="", repr=False)
    wall: "Wall | None" = None
    seed: int | None = None

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

    @property
    def is_refused(self) -> bool:
        """Whether nothing was run, since the file uses what the contract forbids."""
        return any(outcome.kind == "forbidden" for outcome in self.outcomes)

    @property
    def said_once(self) -> str:
        """The sentence that all of several checks say; nothing where they differ."""
        messages = {outcome.verdict.message for outcome in self.outcomes}
        return messages.pop() if len(messages) == 1 and self.outcomes[1:] else ""


def grade_file(
    given: Path | Submission,
    exercise: Exercise,
    *,
    hidden: bool = True,
    wall: "Wall | None" = None,
    megabytes: int | None = None,
    seed: int | None = None,
) -> Report:
    """Grade a student's file in a process of its own.

    Args:
        wall: What shuts the process in; the best of this machine by default.
        megabytes: Address space of the process; MEGABYTES by default.
        seed: What the hidden checks are drawn from, 0 or more; None takes their usual seeds.

    Raises:
        InputError: If the file cannot be read or does not load; the message names the line.
    """
    from workbench.exercise.sandbox import CallBudget, SandboxedFunction  # a browser has none

    seconds = exercise.contract.seconds
    room = {} if megabytes is None else {"megabytes": megabytes}
    with SandboxedFunction(
        given, exercise.name, seconds=seconds, wall=wall, budget=CallBudget(seconds), **room
    ) as student:
        return grade_function(
            student, exercise, hidden=hidden, file=student.submission.file, seed=seed
        )


def grade_function(
    function: Function,
    exercise: Exercise,
    *,
    hidden: bool = True,
    file: str = "",
    seed: int | None = None,
) -> Report:
    """Grade a callable: a student's function, or one of ours; as `grade_file`."""
    if isinstance(function, StudentFunction):
        reason = forbidden_use(function.submission, exercise)
        if reason:
            return _refused(reason, exercise, hidden, file=file, wall=function.wall, seed=seed)
        function.start()
    outcomes: list[Outcome] = []
    asked: dict[str, Candidate] = {}
    with drawn_from(seed):
        for check in exercise.checks:
            if check.public or hidden:
                asked[check.name] = Candidate(function, exercise.reference)
                outcomes.append(_judged(check, asked[check.name]))
    outcomes = _inputs_looked_at(outcomes, asked)
    failing = {outcome.check.name for outcome in outcomes if outcome.verdict.share < 1.0}
    calls = {name: candidate.calls for name, candidate in asked.items()}
    mistake = diagnose(calls, failing, exercise)
    ours = not isinstance(function, StudentFunction)
    return Report(
        exercise,
        file,
        tuple(outcomes),
        tuple(check for check in exercise.checks if not (check.public or hidden)),
        mistake,
        frozenset() if mistake is None else concerned(mistake, calls, failing, exercise=exercise),
        "" if ours else function.printed(),
        None if ours else function.wall,
        seed,
    )


def _refused(
    reason: str,
    exercise: Exercise,
    hidden: bool,
    *,
    file: str,
    wall: "Wall | None",
    seed: int | None,
) -> Report:
    """Return the report on a file that uses what is forbidden: every check says why."""
    run = [check for check in exercise.checks if check.public or hidden]
    outcomes = tuple(Outcome(check, fail(reason), "forbidden") for check in run)
    return Report(
        exercise,
        file,
        outcomes,
        tuple(check for check in exercise.checks if check not in run),
        wall=wall,
        seed=seed,
    )


def _judged(check: Check, candidate: Candidate) -> Outcome:
    """One failure, crash or time-out costs this check only."""
    try:
        verdict = check.judge(candidate)
        return Outcome(check, Verdict(verdict.share, one_line(verdict.message)))
    except StudentError as error:
        return Outcome(check, fail(str(error)), error.kind)
    except (
        Exception
    ) as error:  # a check of ours that stumbles over an odd answer must not stop a batch
        return Outcome(
            check,
            fail(one_line(f"The answer could not be judged ({type(error).__name__}: {error}).")),
        )


def _inputs_looked_at(outcomes: list[Outcome], asked: dict[str, Candidate]) -> list[Outcome]:
    """Let the check that inputs stay as they are fail where any call of any check changed them."""
    changing = [args for candidate in asked.values() for args in candidate.changing]
    return [
        replace(outcome, verdict=changed(changing[0]))
        if changing and asked[outcome.check.name].looks_at_inputs and outcome.verdict.share == 1.0
        else outcome
        for outcome in outcomes
    ]
