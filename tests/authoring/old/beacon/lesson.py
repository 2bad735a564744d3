"""Where is the beacon? The mean of many measurements, each with the weight that it deserves.

What it teaches: weights of one over the variance give the best mean there is, equal weights waste the better sensor, and
no weights protect from a measurement that is of something else.

`state.py` has the inputs and the state, `fixes.py` the made data, `draw.py` and `words.py` the picture and its sentences,
`experiments.py` the presets and questions, `exercises/` what students write.
"""

from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np

from workbench.lesson import Lesson, View
from workbench.tracing import traced

from .draw import draw
from .exercises.weighted_centroid import weighted_centroid
from .experiments import PRESETS, QUESTIONS
from .fixes import measured
from .state import P_TRUE, Params, State

Centroid = Callable[[np.ndarray, np.ndarray], np.ndarray]


@traced
def average(p: np.ndarray, w: np.ndarray, weighted_centroid: Centroid) -> Iterator[State]:
    """Yield the weighted centroid of the first fix, of the first two, and so on."""
    for k in range(1, len(p) + 1):
        p_estimate = weighted_centroid(p[:k], w[:k])
        yield State(p=p[:k], w=w[:k], p_estimate=np.asarray(p_estimate, float))


def run(params: Params, *, weighted_centroid: Centroid = weighted_centroid) -> Iterator[State]:
    """Yield the estimate after every fix."""
    rng = np.random.default_rng(params.seed)
    p, w = measured(params, rng)
    yield from average(p, w, weighted_centroid)


lesson = Lesson(
    name="beacon",
    title="The weighted mean",
    summary="Two sensors, one beacon: every measurement counts, but not all of them count the same.",
    page=Path(__file__).with_name("page.md"),
    params=Params,
    run=run,
    draw=draw,
    order=900,
    view=View(eye=(1.6, -1.8, 1.5), target=tuple(P_TRUE.tolist())),
    presets=PRESETS,
    questions=QUESTIONS,
    first_step=-1,
)
