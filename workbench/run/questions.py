"""Answers questions: what was predicted, beside what the run says."""

import math
from dataclasses import dataclass
from typing import Any

from workbench.errors import AuthorError, InputError
from workbench.lesson import Lesson, Question
from workbench.machinery.authors import Blaming, at
from workbench.run.timeline import Timelines, stop_of


@dataclass(frozen=True)
class Answer:
    """What came of a prediction.

    Args:
        right: Whether it was right; False where nothing was predicted.
        value: The right answer: a number, or the index of a choice.
        truth: The right answer in words.
        why: The sentence that explains it.
        reply: What is said to a known wrong answer; empty for others.
        step: Where the run that shows it opens.
    """

    right: bool
    value: float
    truth: str
    why: str
    step: int
    reply: str = ""


def answer(lesson: Lesson, question: Question, given: Any, *, timelines: Timelines) -> Answer:
    """Compare a prediction (None: skipped, only tell) with the run that answers it; computes that
    run.

    Raises:
        InputError: If what was given is no answer to this question, or its run fails.
        AuthorError: If the question cannot be answered by that run, with the place in the lesson.
    """
    predicted = _predicted(question, given)
    timeline = timelines.get(lesson, question.params)
    states = timeline.states()
    owner = f"lesson {lesson.name}, question {question.name!r}"
    with Blaming(owner, question.answer):
        value = float(question.answer(states))
        wrong = _no_answer(question, value)
        if wrong:
            raise AuthorError(f"{owner}: {at(question.answer)}{wrong}")
    with Blaming(owner, question.why):
        why = str(question.why(states))
    step = stop_of(timeline) if question.step is None else timeline.opening(owner, question.step)
    if question.choices:
        right = predicted == value
        truth = str(question.choices[int(value)])
    else:
        right = abs(predicted - value) <= question.tolerance
        truth = f"{value:.4g} {question.unit}".rstrip()
    reply = "" if right or math.isnan(predicted) else question.reply(predicted)
    return Answer(right=right, value=value, truth=truth, why=why, step=step, reply=reply)


def _predicted(question: Question, given: Any) -> float:
    if given is None:
        return math.nan
    if question.choices:
        if given not in question.choices:
            raise InputError("choose one of the answers")
        return float(question.choices.index(given))
    try:
        return float(given)
    except (TypeError, ValueError, OverflowError):
        raise InputError("a number is asked for") from None


def _no_answer(question: Question, value: float) -> str | None:
    """Say why a value is no answer to a question, None when it is one."""
    if not math.isfinite(value):
        return f"its answer is {value}; a finite number is wanted"
    if question.choices and value not in range(len(question.choices)):
        last = len(question.choices) - 1
        return f"its answer is {value:g}; wanted is the index of one of its choices, 0 to {last}"
    return None
