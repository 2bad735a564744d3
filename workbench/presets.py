"""What a lesson lets people try and predict: presets, sweeps, and questions."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Generic, TypeVar

from workbench.view import View

P = TypeVar("P")
S = TypeVar("S")


@dataclass(frozen=True)
class Preset(Generic[P]):
    """A named set of params: what to look for, and why it happens, in one line.

    `step` is where it opens: an index, negative counts from the end; None opens at the lesson's
    first step worth seeing. `view` is its own camera, where the lesson's does not show what it is
    about. `breaks` says that it goes wrong on purpose: its captions stay calm.
    """

    name: str
    title: str
    line: str
    params: P
    step: int | None = None
    view: View | None = None
    breaks: bool = False


@dataclass(frozen=True)
class Sweep:
    """One param of a run at several values: a knob on pages that cannot compute too.

    `knob` is the name of a field of the inputs, `values` what it takes, in the order in which they
    are shown; `run` is the preset whose other params they have, or the default run.
    """

    knob: str
    values: tuple[Any, ...]
    run: str = "default"


class Choice(str):
    """A text to choose as an answer, and `why`: what is said to who chose it though it is wrong."""

    why: str

    def __new__(cls, text: str, why: str = "") -> "Choice":
        """Return the text with what is said to those who chose it wrongly."""
        choice = super().__new__(cls, text)
        choice.why = why
        return choice


@dataclass(frozen=True)
class Question(Generic[P, S]):
    """Predict before reveal: a question whose right answer is read off a run.

    Args:
        name: Its key in a browser's memory.
        text: The question.
        choices: The possible answers, plain texts or `Choice`s; empty means a number is asked for.
        answer: Reads the right answer off the run's `States` (a tuple of them, with `params` and
            `subject`): an index into choices, or a number.
        why: The sentence shown after answering, computed from the same states.
        params: The run that answers it.
        unit: The unit asked for, for numbers.
        tolerance: How far off a number still counts as right.
        step: Where the revealed run opens; None is the end of the run itself, before any tries of
            other starts.
        wrong: Known wrong numbers as (lowest, highest, what is said to those who gave one); none is
            within the tolerance.
        start: In a story, the step of its run at which the stage stands still while it is asked;
            `"stop"` is the end of the run itself.
        low, high: In a story, the ends of the slider for a number; with neither the answer is
            typed.
        stride: The step of that slider; None picks one.
        mark: The mark of the scene's chart along whose axis a number is predicted, by its name.
    """

    name: str
    text: str
    answer: Callable[[Any], float]
    why: Callable[[Any], str]
    params: P
    choices: tuple[str, ...] = ()
    unit: str = ""
    tolerance: float = 0.0
    step: int | None = None
    wrong: tuple[tuple[float, float, str], ...] = ()
    start: int | str = 0
    low: float | None = None
    high: float | None = None
    stride: float | None = None
    mark: str = ""

    def reply(self, given: float) -> str:
        """Return what is said to a known wrong answer; nothing where it is not known.

        Args:
            given: A number, or the index of a choice.
        """
        if self.choices:
            return getattr(self.choices[int(given)], "why", "")
        return next((words for low, high, words in self.wrong if low <= given <= high), "")
