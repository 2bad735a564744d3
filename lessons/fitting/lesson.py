"""Fitting: walk down the sum of squares.

What it teaches: a fit makes squared distances small. Linear problems are solved in one step, others
by repeating a linear one around the current guess. Which distance is squared, where one starts, and
how much a far point may pull decide the answer more than the solver does; and what a covariance
promises can be compared with measuring anew.
"""

from collections.abc import Iterator
from pathlib import Path

import numpy as np

from lessons.fitting.draw import draw
from lessons.fitting.exercises.circle_linearised import circle_linearised
from lessons.fitting.exercises.damped_step import damped_step
from lessons.fitting.exercises.huber_weights import huber_weights
from lessons.fitting.presets import PRESETS, VIEW
from lessons.fitting.questions import QUESTIONS
from lessons.fitting.stages import Linearised, Weights, basin, lines, rivals, trust, walk
from lessons.fitting.state import Now, Params, State
from lessons.fitting.subjects import subject_of
from workbench.algorithms.least_squares import DampedStep
from workbench.certain import sure
from workbench.lesson import Lesson, Sweep


def run(
    params: Params,
    *,
    circle_linearised: Linearised = circle_linearised,
    damped_step: DampedStep = damped_step,
    huber_weights: Weights = huber_weights,
) -> Iterator[State]:
    """Yield the steps of one stage."""
    rng = np.random.default_rng(params.seed)
    subject = subject_of(params, rng)
    moments: Iterator[Now]
    if params.stage == "descent":
        kind = sure(subject.kind)
        moments = walk(
            params,
            subject,
            rng,
            linearise=circle_linearised if kind.name == "circle" else kind.linearise,
            step=damped_step,
        )
    elif params.stage == "basin":
        moments = basin(params, subject)
    elif params.stage in ("algebraic", "coin"):
        moments = rivals(params, subject, rng)
    elif params.stage == "line":
        moments = lines(params, subject, rng)
    else:
        moments = trust(params, subject, huber_weights)
    for moment in moments:
        yield State(params, subject, moment)


lesson = Lesson(
    name="fitting",
    title="Fitting",
    summary="Find the circle or the plane that suits noisy points best, and see how hard one far "
    "point pulls at it.",
    page=Path(__file__).with_name("page.md"),
    params=Params,
    run=run,
    draw=draw,
    order=600,
    chapter="Estimate",
    minutes=25,
    needs=("pairs",),
    view=VIEW,
    presets=PRESETS,
    questions=QUESTIONS,
    first_step=3,
    opening=0,
    sweeps=(Sweep("arc", (360.0, 180.0, 90.0, 60.0, 45.0)),),
    telling="Sum of squares",
)
