"""Decides what the curvature lesson says: by brute force over the triangles, and against the
analytic surface.

Here is when a step is right; beside it are what captions say, the values that they carry, and the
texts of presets and questions.
"""

import numpy as np

from tests.truths.curvature import defect_here, facts, shown, slope, study
from tests.verdicts import Run
from tests.verdicts.curvature.captions import CAPTIONS, caption
from tests.verdicts.curvature.texts import LINES, WHYS
from tests.verdicts.curvature.values import VALUES

__all__ = ["CAPTIONS", "LINES", "VALUES", "WHYS", "caption", "right"]


def right(run: Run, k: int) -> bool | None:
    if run.params.stage != "mesh":
        return None
    run = shown(run)
    state = run.states[k]
    v = state.now.vertex
    if state.stage == "total":
        total = float(state.now.defects.sum())
        promised = 2 * np.pi * facts(state)[3]
        return abs(total - promised) < 1e-6
    if state.stage == "defect":
        return bool(abs(state.now.defects[v] - defect_here(state)) < 1e-6)
    if state.stage in ("gaussian", "mean"):
        estimate = state.now.K if state.stage == "gaussian" else state.now.H
        true = getattr(state.subject.truth, state.stage)[v]
        return bool(abs(estimate[v] - true) < 0.5 * abs(true))
    if state.stage == "finer":
        s = study(run)
        return bool((s.K.max() < 1e-8 or slope(s.K, s.counts) < -0.5) and s.H[-1] < 0.5)
    return None
