"""Where is the beacon? The mean of many measurements, each with the weight that it deserves.

What it teaches: a weight of one over the variance gives the best mean there is; a bad sensor that
counts too much is worse than none; no weight protects from a measurement of something else.

`inputs.py` has what a person sets, what a run is about and what a step is, `draw.py` the picture of
a step and its caption, `presets.py` the presets and questions, `page.md` the story, `exercises/`
what students write.
"""

from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np

from workbench.lesson import Lesson, Sweep, View
from workbench.tracing import traced

from .draw import draw
from .exercises.weighted_centroid import weighted_centroid
from .inputs import P_TRUE, Estimate, Fixes, Input, setup
from .presets import PRESETS, QUESTIONS

Centroid = Callable[[np.ndarray, np.ndarray], np.ndarray]
TARGET = tuple(P_TRUE.tolist())


@traced
def average(p: np.ndarray, w: np.ndarray, weighted_centroid: Centroid) -> Iterator[Estimate]:
    """Yield the weighted centroid of the first fix, of the first two, and so on."""
    for k in range(1, len(p) + 1):
        p_estimate = weighted_centroid(p[:k], w[:k])
        yield Estimate(k, np.asarray(p_estimate, float), w[:k])


def run(
    params: Input, fixes: Fixes, *, weighted_centroid: Centroid = weighted_centroid
) -> Iterator[Estimate]:
    """Yield the estimate after every fix."""
    w = np.where(fixes.is_good, 1.0, params.weight)
    yield from average(fixes.p, w, weighted_centroid)


lesson = Lesson(
    name="NAME",
    title="The weighted mean",
    summary="Two sensors, one beacon: every fix counts, but they do not all count the same.",
    page=Path(__file__).with_name("page.md"),
    params=Input,
    setup=setup,
    run=run,
    draw=draw,
    order=900,
    chapter="Estimate",
    minutes=6,
    view=View(eye=(0.9, -1.1, 0.9), target=TARGET),
    views={"wide": View(eye=(1.9, -1.8, 1.5), target=(0.5, 0.0, 0.4))},
    presets=PRESETS,
    questions=QUESTIONS,
    sweeps=(Sweep("weight", (0.0, 0.1, 0.25, 0.4, 0.55, 0.7, 0.85, 1.0), run="weighted"),),
    first_step=-1,
)
