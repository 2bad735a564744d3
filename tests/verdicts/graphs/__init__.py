"""What the graphs lesson says of its runs, decided from edges and nodes with dense matrices, apart
from its core.

Here is when a step is right; beside it are what captions say and the texts of presets and
questions.
"""

import numpy as np

from lessons.graphs.captions import caption
from tests.truths import decided
from tests.truths.graphs import correct, off
from tests.verdicts import Run
from tests.verdicts.graphs.captions import CAPTIONS, exact_error
from tests.verdicts.graphs.texts import LINES, WHYS
from workbench.algorithms.graphs.diffusion import Heat, Smoothed
from workbench.algorithms.graphs.spectral_cut import Cut
from workbench.algorithms.learning.graph_network import Layer, Trained

__all__ = ["CAPTIONS", "LINES", "WHYS", "caption", "right"]


def right(run: Run, k: int) -> bool | None:
    state = run.states[k]
    result = state.now
    last = k == len(run.states) - 1
    if isinstance(result, Heat):
        if np.abs(result.u).max() > 1 + 1e-9:
            return False
        return True if last and exact_error(run, k) < 0.01 else None
    if isinstance(result, Smoothed) and last:
        first = off(state, run.states[0].now.p)
        end = off(state, result.p)
        return decided(end < 0.9 * first, wrong=end > first)
    if not len(state.subject.classes) or not (
        last or (isinstance(result, Cut) and result.phase == "sign")
    ):
        return None
    if isinstance(result, Cut | Trained) or (
        isinstance(result, Layer) and result.features.shape[1] == 2
    ):
        share = correct(state) / len(state.subject.classes)
        return decided(share >= 0.9, wrong=share < 0.75)
    return None
