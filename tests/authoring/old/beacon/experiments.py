"""Runs worth seeing, and questions to answer before looking."""

from collections.abc import Sequence

import numpy as np

from workbench.lesson import Preset, Question

from .state import Params, State

EQUAL = Params(weights="equal")
STRAY = Params(outliers=2)

PRESETS: tuple[Preset[Params], ...] = (
    Preset(
        name="weighted",
        title="Weights by variance",
        line="The bad sensor hardly counts, and the error stays near a centimetre.",
        params=Params(),
    ),
    Preset(
        name="equal",
        title="Equal weights",
        line="The same fixes, but the bad sensor decides: the error is several times as large.",
        params=EQUAL,
        step=0,
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


def equal_error(states: Sequence[State]) -> float:
    """Return the error at the end, millimetres."""
    return 1000 * states[-1].error


def equal_reason(states: Sequence[State]) -> str:
    """Say what came out, and what the formula of the page says."""
    rms = 1000 * np.sqrt(3 * 15 * (0.02**2 + 0.2**2)) / 30  # three coordinates, 15 fixes by each sensor
    return f"It is {equal_error(states):.0f} mm; over all noise the formula says {rms:.0f} mm (RMS)."


def drop(states: Sequence[State]) -> str:
    """Say what the strays did to the estimate."""
    before, after = (1000 * states[k].error for k in (-5, -1))
    return f"Before them the error was {before:.0f} mm, at the end it is {after:.0f} mm."


QUESTIONS: tuple[Question[Params, State], ...] = (
    Question(
        name="how-far",
        text="15 fixes have σ = 2 cm, 15 have σ = 20 cm in each coordinate. All count the same. How far off is the mean?",
        answer=equal_error,
        why=equal_reason,
        params=EQUAL,
        unit="mm",
        tolerance=25.0,
    ),
    Question(
        name="what-becomes",
        text="Two of 30 fixes are of another beacon, 85 cm away. The weights do not know. What becomes of the estimate?",
        choices=("hardly moves", "moves by some 10 cm", "jumps to the other beacon"),
        answer=lambda states: 1 if 0.03 < states[-1].error < 0.4 else 0 if states[-1].error <= 0.03 else 2,
        why=drop,
        params=STRAY,
    ),
)
