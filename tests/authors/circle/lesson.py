"""A circle through points that are not quite on it.

What it teaches: the fit that one linear system solves is not the one that makes the distances
smallest; on a short arc it gives circles that are far too small, and a few Gauss-Newton steps mend
that.
"""

from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np

from workbench.lesson import Lesson, View
from workbench.tracing import traced

from .draw import draw
from .exercises.fit_circle import fit_circle
from .presets import PRESETS, QUESTIONS
from .state import TRUE, Params, State


@traced
def refine(p: np.ndarray, circle: np.ndarray) -> Iterator[State]:
    """Yield the circle, and circles whose squared distances to the points get smaller:
    Gauss-Newton.
    """
    yield State(0, p, circle)
    for k in range(1, 40):
        r = np.linalg.norm(p - circle[:2], axis=1)
        J = np.column_stack(
            [(circle[:2] - p) / r[:, None], -np.ones(len(p))]
        )  # how each distance changes
        step = np.linalg.lstsq(J, circle[2] - r, rcond=None)[0]
        circle = circle + step
        yield State(k, p, circle)
        if np.abs(step).max() < 1e-9:
            return


def run(
    params: Params, *, fit_circle: Callable[[np.ndarray], np.ndarray] = fit_circle
) -> Iterator[State]:
    """Yield the algebraic circle through measured points, and its refinements."""
    rng = np.random.default_rng(params.seed)
    angles = np.radians(params.arc) * (np.arange(params.points) / params.points - 0.5)
    p = TRUE[:2] + TRUE[2] * np.column_stack([np.cos(angles), np.sin(angles)])
    p += params.noise * rng.standard_normal(p.shape)
    yield from refine(p, fit_circle(p))


lesson = Lesson(
    name="circle",
    title="A circle through points",
    summary=(
        "One linear system gives a circle, but not the nearest one: watch it grow on a short arc."
    ),
    page=Path(__file__).with_name("page.md"),
    params=Params,
    run=run,
    draw=draw,
    order=900,
    view=View(eye=(0.4, 0.3, 4.0), target=(0.4, 0.3, 0.0)),
    presets=PRESETS,
    questions=QUESTIONS,
)
