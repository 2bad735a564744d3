"""Runs worth seeing, and questions to answer before looking."""

from workbench.lesson import Preset, Question

from .state import Params, State

SHORT = Params(arc=60.0)
PRESETS = (
    Preset(
        "whole",
        "The whole circle",
        "Points all around: both fits agree to a few millimetres.",
        Params(),
    ),
    Preset(
        "arc",
        "A short arc",
        "Of 60° the algebraic circle is far too small; the refined one is not.",
        SHORT,
        step=1,
    ),
    Preset(
        "exact",
        "No noise",
        "Without noise the first circle is right, and nothing is left to refine.",
        Params(noise=0),
    ),
)
QUESTIONS: tuple[Question[Params, State], ...] = (
    Question(
        name="radius",
        text=(
            "The points cover 60° of a circle of radius 1 m. What radius does the algebraic fit"
            " give?"
        ),
        answer=lambda states: states[0].circle[2],
        why=lambda states: (
            f"It gives {states[0].circle[2]:.2f} m: far from the arc it trades distance for size."
        ),
        params=SHORT,
        unit="m",
        tolerance=0.05,
        step=0,
    ),
    Question(
        name="refined",
        text="And after the refinement: is the radius nearer to the truth?",
        choices=("nearer", "as far", "farther"),
        answer=lambda states: 0 if states[-1].error < states[0].error else 2,
        why=lambda states: (
            f"The error goes from {states[0].error:.3f} m to {states[-1].error:.3f} m."
        ),
        params=SHORT,
    ),
)
