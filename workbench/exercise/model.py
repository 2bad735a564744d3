"""What an exercise is: the function to write, the checks that judge it, the known mistakes.

An exercise is one file, `exercises/NAME.py` in its lesson's folder: its docstring is the task,
`@contract` marks our function, `@check` what is judged, `@mistake` known wrong functions and
`@alternative` other right ones. A check gets the candidate, a callable that runs the student's
function in another process and gives back plain values, and returns a `Verdict`. It judges geometry
in degrees and metres, properties and contracts, never bits.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from types import ModuleType
from typing import Any

import numpy as np

from workbench.errors import InputError
from workbench.machinery.docstrings import summary_of
from workbench.numerals import brief, fixed_or_power

Function = Callable[..., Any]


@dataclass(frozen=True)
class Verdict:
    """What a check found: the share of its points, and one sentence with a number and any hint."""

    share: float
    message: str

    def __post_init__(self) -> None:
        if not 0.0 <= self.share <= 1.0 or not self.message.strip():
            raise ValueError(f"a verdict has a share from 0 to 1 and says something, not {self}")

    @property
    def word(self) -> str:
        """`pass`, `partial` or `fail`."""
        if self.share == 1.0:
            return "pass"
        return "partial" if self.share > 0.0 else "fail"


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
    """Judge a number that should be small: all points up to `good`, half up to `fair`, or none."""
    shown = f"{what} {number(value, 3)} {unit}".rstrip()
    limit = f"{brief(good)} {unit}".rstrip()
    if not math.isfinite(value):
        return fail(f"{shown}, which is no number to judge. {hint}")
    if value <= good:
        return full(f"{shown}, within {limit}.")
    if value <= fair:
        return partial(0.5, f"{shown}: close, full marks need {limit}. {hint}")
    return fail(f"{shown}, at most {limit} was asked for. {hint}")


def number(value: Any, digits: int = 4) -> str:
    """Write a number of an answer as messages do, several in brackets."""
    if getattr(value, "ndim", isinstance(value, (list, tuple))):
        return f"({', '.join(number(part, digits) for part in value)})"
    value = float(value)
    if not math.isfinite(value):
        return f"{value:g}".replace("-", "−")
    return brief(value, digits) if abs(value) < 1e7 else fixed_or_power(value, 0)


def against(got: Any, right: Any, digits: int = 4, *, unit: str = "") -> str:
    """Write an answer and the right one, "0.64, right is −0.64", with digits enough to differ."""
    behind = f" {unit}" if unit else ""
    for more in range(digits, 18):
        yours, wanted = number(got, more), number(right, more)
        if yours != wanted:
            return f"{yours}{behind}, right is {wanted}{behind}"
    off = float(np.max(np.abs(np.subtract(got, right, dtype=float)), initial=0.0))
    text = f"{number(got, digits)}{behind}, right is {number(right, digits)}{behind}"
    return f"{text} (off by {off:.2g}{behind})" if 0 < off < math.inf else text


@dataclass(frozen=True)
class Check:
    """One promise about the student's function.

    Args:
        name: Its key in reports.
        promise: What holds when it passes, one line.
        public: Whether a student sees it run; hidden ones run where a class is graded.
        judge: Calls the candidate and returns a verdict; the candidate's errors may pass through.
    """

    name: str
    promise: str
    points: float
    public: bool
    judge: Callable[[Function], Verdict]


def check(
    points: float, *, public: bool = True
) -> Callable[[Callable[[Function], Verdict]], Check]:
    """Make a check of a function of the candidate; its first paragraph is the promise."""

    def made(judge: Callable[[Function], Verdict]) -> Check:
        promise = summary_of(judge)
        if not promise:
            raise TypeError(
                f"check {judge.__name__} needs a docstring: the promise that the report shows"
            )
        return Check(judge.__name__, promise.rstrip("."), points, public, judge)

    return made


@dataclass(frozen=True, eq=False, kw_only=True)
class Contract:
    """The function that a student writes, as ours does it, signature and docstring included.

    Called, it answers as our function does. `contract` makes it, and tells of its attributes.
    """

    function: Function
    slot: str
    examples: tuple[tuple[str, str], ...] = ()
    seconds: float = 5.0
    either: Callable[[Any], Any] | None = None
    preset: str | None = None
    forbid: tuple[str, ...] = ()

    def __call__(self, *args: Any) -> Any:
        """Return what our function returns."""
        return self.function(*args)

    def others(self, value: Any) -> list[Any]:
        """Return the answers that are as right as this one; none for another kind."""
        try:
            made = [] if self.either is None else self.either(value)
        except (TypeError, ValueError):
            return []
        return made if isinstance(made, list) else [made]


def contract(
    *,
    slot: str,
    examples: tuple[tuple[str, str], ...] = (),
    seconds: float = 5.0,
    either: Callable[[Any], Any] | None = None,
    preset: str | None = None,
    forbid: tuple[str, ...] = (),
) -> Callable[[Function], Contract]:
    """Make the contract of an exercise of our function, which has the name of its file.

    Args:
        slot: The keyword of the lesson's run that the student's function replaces.
        examples: Calls with their results for the starter, both as text in Python.
        seconds: How long one call may take.
        either: Where several answers are right (a plane's normal may point to either side): makes
            the other of the one, or a list of the others.
        preset: The preset at which a student's own function is first watched, where the default run
            does not call it.
        forbid: Whole paths such as "scipy.spatial" that solve the task in one call: who uses them
            earns nothing.
    """
    return lambda function: Contract(
        function=function,
        slot=slot,
        examples=examples,
        seconds=seconds,
        either=either,
        preset=preset,
        forbid=forbid,
    )


@dataclass(frozen=True, eq=False)
class Mistake:
    """A plausible wrong function, called as such, and the sentence for a student who wrote it."""

    function: Function
    sentence: str

    @property
    def name(self) -> str:
        """The function's name, in words."""
        return self.function.__name__.replace("_", " ")

    @property
    def spares_the_rest(self) -> bool:
        """Whether the sentence says that all else is right: it is told only where that is so."""
        return self.sentence.startswith("All is right")

    def __call__(self, *args: Any) -> Any:
        """Return the wrong answer."""
        return self.function(*args)


def mistake(sentence: str) -> Callable[[Function], Mistake]:
    """Make a known mistake of a wrong function; the sentence says what is wrong and what to do."""
    return lambda function: Mistake(function, sentence)


@dataclass(frozen=True, eq=False)
class Alternative:
    """Another right solution, written differently; it keeps the checks honest."""

    function: Function

    def __call__(self, *args: Any) -> Any:
        """Return the right answer."""
        return self.function(*args)


def alternative(function: Function) -> Alternative:
    """Make an alternative of a right function."""
    return Alternative(function)


@dataclass(frozen=True, kw_only=True)
class Exercise:
    """One function for students to write: what a file in a lesson's `exercises` folder holds.

    Args:
        name: Of the exercise and of the student's function.
        task: What to do and why, two or three sentences: the docstring of the file.
        checks: The promises; public ones first.
        mistakes: At least three that students make.
        alternatives: Other right solutions.
    """

    name: str
    lesson: str
    task: str
    contract: Contract
    checks: tuple[Check, ...]
    mistakes: tuple[Mistake, ...] = ()
    alternatives: tuple[Function, ...] = ()

    def __post_init__(self) -> None:
        names = [item.name for item in self.checks]
        if not names or len(set(names)) != len(names):
            raise ValueError(f"exercise {self.name}: it needs checks, each with a name of its own")

    @property
    def reference(self) -> Function:
        """Our function."""
        return self.contract.function

    @property
    def file(self) -> str:
        """What the file is called in which a student hands the function in."""
        return f"my_{self.name}.py"

    @property
    def points(self) -> float:
        """What all checks are worth together."""
        return sum(item.points for item in self.checks)


def exercise_in(module: ModuleType, lesson: str, hidden: ModuleType | None = None) -> Exercise:
    """Return the exercise that a module defines by its decorators, in their order.

    Args:
        module: With the name of the exercise.
        lesson: The name of its lesson.
        hidden: Where more of its checks are, which students do not see.

    Raises:
        InputError: If it has no docstring, contract or check, or one name twice; names the file.
    """
    own = list(vars(module).values())
    contracts = [
        item for item in own if isinstance(item, Contract) and _is_of(item.function, module)
    ]
    checks = _checks_in(module) + (() if hidden is None else _checks_in(hidden))
    name = module.__name__.rpartition(".")[2]
    task = " ".join((module.__doc__ or "").split())
    if [item.function.__name__ for item in contracts] != [name]:
        raise InputError(
            f"{module.__file__}: it needs one function `{name}` with @contract: what a student"
            " writes"
        )
    if not task or not checks:
        raise InputError(
            f"{module.__file__}: it needs a docstring, the task, and functions with @check"
        )
    return Exercise(
        name=name,
        lesson=lesson,
        task=task,
        contract=contracts[0],
        checks=checks,
        mistakes=tuple(
            item for item in own if isinstance(item, Mistake) and _is_of(item.function, module)
        ),
        alternatives=tuple(
            item.function
            for item in own
            if isinstance(item, Alternative) and _is_of(item.function, module)
        ),
    )


def _checks_in(module: ModuleType) -> tuple[Check, ...]:
    checks = (item for item in vars(module).values() if isinstance(item, Check))
    return tuple(item for item in checks if _is_of(item.judge, module))


def _is_of(function: Function, module: ModuleType) -> bool:
    return function.__module__ == module.__name__
