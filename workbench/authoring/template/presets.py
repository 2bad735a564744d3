"""Runs worth seeing, and questions to answer before looking."""

import numpy as np

from workbench.lesson import Choice, Preset, Question, States
from workbench.numerals import length

from .draw import WEIGHTS, error_of
from .inputs import Fixes, Input, expected_error

STRAY = Input(weight=0.25, strays=2)

PRESETS = (
    Preset(
        name="weighted",
        title="Weights by variance",
        line="A fix of the bad sensor counts a quarter: no other weight does better on average.",
        params=Input(weight=0.25),
    ),
    Preset(
        name="ignored",
        title="The bad sensor left out",
        line="Every second fix counts nothing, as if it had not been made.",
        params=Input(weight=0.0),
    ),
    Preset(
        name="stray",
        title="Two fixes of another beacon",
        line="The last good fixes are of another beacon, and have full weight.",
        params=STRAY,
        step=-5,
        breaks=True,
    ),
)


def best_weight(states: States[Input, Fixes, object]) -> float:
    """Return the weight at which the expected error is smallest."""
    return float(WEIGHTS[np.argmin(expected_error(states.params, WEIGHTS))])


def why_best(states: States[Input, Fixes, object]) -> str:
    """Say what the best weight is, and why."""
    ratio = states.params.bad / states.params.good
    return (
        f"It is {best_weight(states):.2f}. The bad sensor errs {ratio:.0f} times as much, so its "
        f"variance is {ratio**2:.0f} times as large: a fix counts one over that."
    )


def what_became(states: States) -> float:
    """Return the index of the choice that describes where the strays left the estimate."""
    error = error_of(states[-1])
    if error < 0.03:
        return 0
    if error < 0.4:
        return 1
    return 2


def why_it_moved(states: States) -> str:
    """Say what the strays did to the estimate."""
    before, after = (length(error_of(states[k]), 2) for k in (-5, -1))
    return f"Before them the error was {before}, at the end it is {after}."


QUESTIONS = (
    Question(
        name="best-weight",
        text="The bad sensor errs twice as much. How much should its fix count?",
        answer=best_weight,
        why=why_best,
        params=Input(weight=0.25),
        tolerance=0.05,
        low=0.0,
        high=1.0,
        stride=0.01,
        mark="Expected error",
        start=-1,
        wrong=(
            (0.0, 0.1, "That throws half of the fixes away, and each of them says something."),
            (0.4, 0.6, "Twice the error, half the weight: but errors add up as squares."),
            (0.9, 1.0, "Then the noise of the bad sensor comes in with full weight."),
        ),
    ),
    Question(
        name="what-becomes",
        text="Two of the last fixes are of another beacon, 85 cm away. What happens?",
        choices=(
            Choice(
                "The estimate hardly moves",
                why="It would if strays counted less. They count like any good fix.",
            ),
            "The estimate moves by some 10 cm",
            Choice(
                "The estimate jumps to the other beacon",
                why="Two fixes would have to outweigh all the others for that.",
            ),
        ),
        answer=what_became,
        why=why_it_moved,
        params=STRAY,
        start=-5,
    ),
)
