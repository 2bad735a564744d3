"""What an exercise is: the function a student writes, the checks that judge it, and the mistakes that are known.

A check gets the candidate, a callable that runs the student's function in another process and gives back plain values,
and returns a `Verdict`. It judges geometry in degrees and metres, properties and contracts, never bits.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

Function = Callable[..., Any]


@dataclass(frozen=True)
class Verdict:
    """What a check found: the share of its points that is earned, and one sentence with a number and, if any, a hint."""

    share: float
    message: str

    def __post_init__(self) -> None:
        if not 0.0 <= self.share <= 1.0 or not self.message.strip():
            raise ValueError(f"a verdict has a share from 0 to 1 and says something, not {self}")

    @property
    def word(self) -> str:
        """`pass`, `partial` or `fail`."""
        return "pass" if self.share == 1.0 else "partial" if self.share > 0.0 else "fail"


def full(message: str) -> Verdict:
    """Return the verdict that earns all points."""
    return Verdict(1.0, message)


def partial(share: float, message: str) -> Verdict:
    """Return a verdict that earns a share of the points."""
    return Verdict(share, message)


def fail(message: str) -> Verdict:
    """Return the verdict that earns nothing."""
    return Verdict(0.0, message)


def band(what: str, value: float, unit: str, *, good: float, fair: float, hint: str) -> Verdict:
    """Judge a number that should be small: all points up to `good`, half up to `fair`, none beyond or where it is NaN."""
    shown = f"{what} {value:.3g} {unit}".rstrip()
    if value <= good:
        return full(f"{shown}, within {good:g} {unit}".rstrip() + ".")
    if value <= fair:
        return partial(0.5, f"{shown}: close, full marks need {good:g} {unit}".rstrip() + f". {hint}")
    return fail(f"{shown}, at most {good:g} {unit} was asked for".rstrip() + f". {hint}")


@dataclass(frozen=True)
class Check:
    """One promise about the student's function.

    Args:
        name: Its key in reports.
        promise: What holds when it passes, one line; shown in reports.
        points: What it is worth.
        public: Whether a student sees it run; hidden ones run where a class is graded.
        judge: Calls the candidate and returns a verdict. It may let the candidate's errors pass through.
    """

    name: str
    promise: str
    points: float
    public: bool
    judge: Callable[[Function], Verdict]


def check(points: float, *, public: bool = True) -> Callable[[Callable[[Function], Verdict]], Check]:
    """Make a check of a function of the candidate: its name is the key, the first line of its docstring the promise."""

    def made(judge: Callable[[Function], Verdict]) -> Check:
        lines = (judge.__doc__ or "").strip().splitlines()
        if not lines:
            raise TypeError(f"check {judge.__name__} needs a docstring: the promise that the report shows")
        return Check(judge.__name__, lines[0].rstrip("."), points, public, judge)

    return made


@dataclass(frozen=True)
class Mistake:
    """A plausible wrong function, and the sentence for a student whose function gives what it gives."""

    name: str
    function: Function
    sentence: str


@dataclass(frozen=True)
class Exercise:
    """One function for students to write.

    Args:
        name: Its name in commands and files; the student's function has the same name.
        lesson: The lesson's name.
        slot: The keyword of the lesson's run that the student's function replaces.
        reference: Ours. The starter file takes its signature and docstring from it.
        task: What to do and why, two or three sentences.
        checks: The promises; public ones first.
        mistakes: At least three that students make.
        alternatives: Other right solutions, written differently; they keep the checks honest.
        examples: Calls with their results for the starter, as `(call in Python, result in Python)` text.
        seconds: How long one call may take.
    """

    name: str
    lesson: str
    slot: str
    reference: Function
    task: str
    checks: tuple[Check, ...]
    mistakes: tuple[Mistake, ...]
    alternatives: tuple[Function, ...] = ()
    examples: tuple[tuple[str, str], ...] = ()
    seconds: float = 5.0

    def __post_init__(self) -> None:
        names = [item.name for item in self.checks]
        if not names or len(set(names)) != len(names):
            raise ValueError(f"exercise {self.name}: it needs checks, each with a name of its own")

    @property
    def points(self) -> float:
        """What all checks are worth together."""
        return sum(item.points for item in self.checks)
