"""A circle through points that are not quite on it.

What it teaches: the fit that one linear system solves is not the one that makes the distances smallest; on a short arc it
gives circles that are far too small, and a few Gauss-Newton steps mend that.
"""

from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np

from workbench.lesson import Lesson, View
from workbench.tracing import traced

from .draw import draw
from .exercises.fit_circle import fit_circle
from .experiments import PRESETS, QUESTIONS
from .state import CENTRE, RADIUS, Params, State, radii


@traced
def refine(p: np.ndarray, circle: np.ndarray) -> Iterator[State]:
    """Yield circles whose squared distances to the points get smaller: Gauss-Newton."""
    for k in range(2, 40):
        v = (circle[:2] - p) / radii(p, circle)[:, None]  # how each distance changes as the centre moves
        J = np.column_stack([v, -np.ones(len(p))])
        step = np.linalg.lstsq(J, circle[2] - radii(p, circle), rcond=None)[0]
        circle = circle + step
        yield State(k=k, p=p, circle=circle)
        if np.abs(step).max() < 1e-9:
            return


def run(params: Params, *, fit_circle: Callable[[np.ndarray], np.ndarray] = fit_circle) -> Iterator[State]:
    """Yield the points, the algebraic circle, and its refinements."""
    rng = np.random.default_rng(params.seed)
    angles = np.radians(params.arc) * (np.arange(params.points) / params.points - 0.5)
    p = CENTRE + RADIUS * np.column_stack([np.cos(angles), np.sin(angles)])
    p = p + params.noise * rng.standard_normal(p.shape)
    yield State(k=0, p=p)
    circle = np.asarray(fit_circle(p), float)
    yield State(k=1, p=p, circle=circle)
    yield from refine(p, circle)


lesson = Lesson(
    name="circle",
    title="A circle through points",
    summary="One linear system gives a circle, but not the nearest one: watch it grow on a short arc.",
    page=Path(__file__).with_name("page.md"),
    params=Params,
    run=run,
    draw=draw,
    order=900,
    view=View(eye=(0.4, 0.3, 4.0), target=(0.4, 0.3, 0.0)),
    presets=PRESETS,
    questions=QUESTIONS,
    first_step=1,
)
