"""Disparity: the same row of two pictures, shifted until it fits, tells how far away everything is.

What it teaches: a match is a valley in a curve of costs. Where the curve is flat (no texture), has
many valleys (a repeated pattern) or no right answer (hidden from one camera), neighbours must help,
or the pixel must be left out. Depth is one over disparity, so its error grows with the square of
the distance.
"""

import functools
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np

from lessons.disparity.draw import draw
from lessons.disparity.pairs import setup_of
from lessons.disparity.presets import PRESETS, QUESTIONS
from lessons.disparity.stage import VIEW
from lessons.disparity.state import Figures, Params, Setup, State
from lessons.disparity.truth import judged
from workbench.algorithms.stereo.cost_volume import (
    CostVolume,
    census_cost_volume,
    ncc_cost_volume,
    sad_cost_volume,
    ssd_cost_volume,
)
from workbench.algorithms.stereo.disparity import (
    Choose,
    DepthOf,
    Matching,
    Stage,
    match,
    reconstruct,
    usual_penalties,
)
from workbench.algorithms.stereo.disparity_map import winner_takes_all
from workbench.algorithms.stereo.semiglobal import energy
from workbench.geometry.cameras.stereo import depth_from_disparity
from workbench.lesson import Lesson, Sweep

OTHER_COSTS: dict[str, CostVolume] = {
    "SSD": ssd_cost_volume,
    "census": census_cost_volume,
    "NCC": ncc_cost_volume,
}

USUAL_ERROR = 0.5
"""Pixels: the disparity error whose effect is shown where no other was asked for."""


def run(
    params: Params,
    *,
    depth: DepthOf = depth_from_disparity,
    cost_volume: CostVolume = sad_cost_volume,
    choose: Choose = winner_takes_all,
) -> Iterator[State]:
    """Yield the steps from two pictures to a depth cloud; `cost_volume` is used where the knob says
    SAD.
    """
    setup = setup_of(params)
    compare = OTHER_COSTS.get(params.cost, cost_volume)
    penalties = (
        functools.partial(usual_penalties, smoothness=params.smoothness)
        if params.smoothness > 0
        else None
    )
    steps = match(
        setup.left, setup.right, setup.max_disparity, params.window, penalties, compare, choose
    )
    yield from states_of(setup, steps, depth)


def states_of(setup: Setup, steps: Iterator[Matching], depth_of: DepthOf) -> Iterator[State]:
    """Yield a state per step of the matching, then two of the depths."""
    state, before = None, None
    for now in steps:
        state = _of_matching(setup, now, depth_of, before)
        before = Figures(
            wrong=state.wrong, error=state.error, unknown=state.unknown, energy=state.energy
        )
        yield state
    assert state is not None
    params, camera = setup.params, setup.pair.camera
    disparity = state.disparity + params.disparity_error
    shown = abs(params.disparity_error) or USUAL_ERROR
    wrong, error, unknown = judged(setup, disparity)
    last = replace(
        state,
        stage=None,
        disparity=disparity,
        before=before,
        wrong=wrong,
        error=error,
        unknown=unknown,
    )
    for depths in reconstruct(disparity + camera.doffs, setup.f, camera.baseline, shown, depth_of):
        yield replace(
            last, depth=depths.depth, uncertainty=depths.uncertainty, disparity_error=shown
        )


def _of_matching(setup: Setup, now: Matching, depth_of: DepthOf, before: Figures | None) -> State:
    u, v = setup.pixel
    comparing = now.stage is Stage.COMPARE
    costs = np.full(setup.max_disparity + 1, np.nan)
    costs[: len(now.cost)] = now.cost[:, v, u]
    costs[~np.isfinite(costs)] = np.nan
    piece = now.cost[-1].astype(np.float32) if comparing else None
    camera = setup.pair.camera
    wrong, error, unknown = judged(setup, now.disparity)
    return State(
        setup=setup,
        stage=now.stage,
        disparity=now.disparity,
        depth=depth_of(now.disparity + camera.doffs, setup.f, camera.baseline),
        costs=costs,
        piece=piece,
        done=now.done,
        direction=now.direction,
        jumps=now.jumps,
        lowest=_mean_lowest(now) if comparing else np.nan,
        energy=np.nan if now.summed is None else energy(now.summed, now.disparity, *now.jumps),
        before=before,
        wrong=wrong,
        error=error,
        unknown=unknown,
    )


def _mean_lowest(now: Matching) -> float:
    chosen = np.clip(np.nan_to_num(now.disparity), 0, len(now.cost) - 1).astype(np.int64)
    lowest = np.take_along_axis(now.cost, chosen[None], axis=0)[0]
    return float(np.mean(lowest, where=np.isfinite(lowest)))


lesson = Lesson(
    name="disparity",
    title="Disparity and depth",
    summary="Shift one picture over the other until they agree. How far each pixel moved tells "
    "how far away it is.",
    page=Path(__file__).with_name("page.md"),
    params=Params,
    run=run,
    draw=draw,
    order=1300,
    chapter="See",
    minutes=20,
    needs=("epipolar",),
    view=VIEW,
    presets=PRESETS,
    questions=QUESTIONS,
    first_step=15,
    sweeps=(Sweep("window", (1, 3, 7, 13, 21)),),
    telling="Cost at the followed pixel",
)
