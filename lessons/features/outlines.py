"""Matching two outlines: log-polar bins, histograms, costs, and the cheapest assignment."""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from lessons.features.silhouettes import horse
from lessons.features.state import STEPS_ALONG, Outlined, Params
from workbench.algorithms.transport import best_assignment
from workbench.geometry.features.shape_context import context_costs, shape_contexts

COUNT = 100
SIZE = 0.5
LARGER = 1.2
NOISE = 0.002
PICKED = 12


def outline_steps(params: Params) -> Iterator[Outlined]:
    """Yield the steps from two outlines to their matches."""
    first = horse(COUNT, SIZE)
    c, s = np.cos(np.radians(params.turn)), np.sin(np.radians(params.turn))
    second = LARGER * first @ np.array([[c, s], [-s, c]])
    second = second + NOISE * np.random.default_rng(params.seed).standard_normal(second.shape)
    step = Outlined(phase="outlines", first=first, second=second, picked=PICKED)
    yield step
    yield replace(step, phase="bins")
    along = params.angles == "along the outline"
    f_first, f_second = (shape_contexts(p, along_tangent=along) for p in (first, second))
    step = replace(step, phase="histogram", f_first=f_first, f_second=f_second)
    yield step
    costs = context_costs(f_first, f_second)
    step = replace(step, phase="costs", costs=costs)
    yield step
    rows, columns = best_assignment(costs)
    pairs = np.column_stack([rows, columns])
    apart = np.abs((rows - columns + COUNT // 2) % COUNT - COUNT // 2)
    yield replace(step, phase="matched", pairs=pairs, right=apart <= STEPS_ALONG)
