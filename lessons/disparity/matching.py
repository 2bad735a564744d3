"""The stage of the whole pair: every shift, the window, the paths, the check, and the depths."""

import functools
from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from lessons.disparity.inputs import Input
from lessons.disparity.pairs import Pictures
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
from workbench.algorithms.stereo.semiglobal import energy
from workbench.geometry.cameras.stereo import depth_from_disparity
from workbench.lesson import Look

OTHER_COSTS: dict[str, CostVolume] = {
    "SSD": ssd_cost_volume,
    "census": census_cost_volume,
    "NCC": ncc_cost_volume,
}
USUAL_ERROR = 0.5
"""Pixels: the disparity error whose effect is shown where no other was asked for."""


@dataclass(frozen=True, eq=False, kw_only=True)
class State:
    """One step.

    Attributes:
        stage: What was just done to the map; None once it became depths.
        disparity: The map, pixels, NaN where unknown.
        depth: The depth it stands for, metres.
        costs: The costs of the followed pixel by disparity, NaN beyond what was compared.
        piece: The last slice of the cost volume, while comparing.
        done: Disparities compared, or directions added.
        direction: (rows down, columns right) of the direction added.
        jumps: P1 and P2.
        lowest: Mean of the lowest cost per pixel, while comparing.
        energy: E(D) per pixel; NaN while comparing.
        wrong: Share of the pixels that both cameras see whose disparity is over 1 px off; NaN
            without truth.
        error: Mean error of the others, pixels; NaN without truth.
        unknown: Share of pixels without a disparity.
        uncertainty: How far `disparity_error` moves each depth, metres, in the last step.
        disparity_error: The error of a disparity for which that is, pixels.
    """

    stage: Stage | None
    disparity: np.ndarray
    depth: np.ndarray
    costs: np.ndarray
    piece: np.ndarray | None
    done: int
    direction: tuple[int, int] | None
    jumps: tuple[float, float]
    lowest: float
    energy: float
    wrong: float
    error: float
    unknown: float
    uncertainty: np.ndarray | None = None
    disparity_error: float = 0.0


MapLook = Look[Input, Pictures, State]


def chosen(look: MapLook) -> float:
    """Return the disparity of the followed pixel, NaN where it is unknown."""
    u, v = look.subject.pixel
    return float(look.now.disparity[v, u])


def run(
    params: Input,
    pictures: Pictures,
    *,
    depth: DepthOf = depth_from_disparity,
    cost_volume: CostVolume = sad_cost_volume,
    choose: Choose | None = None,
) -> Iterator[State]:
    """Yield the steps from two pictures to a depth cloud; `cost_volume` is used where the knob says
    SAD.
    """
    matching = steps(params, pictures, cost_volume, choose=choose)
    yield from states_of(params, pictures, matching, depth_of=depth)


def steps(
    params: Input,
    pictures: Pictures,
    cost_volume: CostVolume = sad_cost_volume,
    *,
    choose: Choose | None = None,
) -> Iterator[Matching]:
    """Return the steps of the matching alone."""
    compare = OTHER_COSTS.get(params.cost, cost_volume)
    penalties = None
    if params.smoothness > 0:
        penalties = functools.partial(usual_penalties, smoothness=params.smoothness)
    left = pictures.left
    right = pictures.right
    most = pictures.max_disparity
    return match(
        left, right, most, window=params.window, penalties=penalties, compare=compare, choose=choose
    )


def states_of(
    params: Input, pictures: Pictures, matching: Iterator[Matching], *, depth_of: DepthOf
) -> Iterator[State]:
    """Yield a state per step of the matching, then two of the depths."""
    state = None
    for step in matching:
        state = _of_matching(pictures, step, depth_of)
        yield state
    assert state is not None
    camera = pictures.pair.camera
    disparity = state.disparity + params.disparity_error
    shown = abs(params.disparity_error) or USUAL_ERROR
    wrong, error, unknown = judged(pictures, disparity)
    last = replace(
        state, stage=None, disparity=disparity, wrong=wrong, error=error, unknown=unknown
    )
    for depths in reconstruct(
        disparity + camera.doffs,
        pictures.f,
        camera.baseline,
        disparity_error=shown,
        depth_of=depth_of,
    ):
        yield replace(
            last, depth=depths.depth, uncertainty=depths.uncertainty, disparity_error=shown
        )


def _of_matching(pictures: Pictures, step: Matching, depth_of: DepthOf) -> State:
    u, v = pictures.pixel
    comparing = step.stage is Stage.COMPARE
    whole = step.stage in (Stage.COMPARE, Stage.AGGREGATE, Stage.PATHS)
    kind = np.float32 if whole else np.float64  # these steps are many, and whole pixels
    costs = np.full(pictures.max_disparity + 1, np.nan)
    costs[: len(step.cost)] = step.cost[:, v, u]
    costs[~np.isfinite(costs)] = np.nan
    camera = pictures.pair.camera
    wrong, error, unknown = judged(pictures, step.disparity)
    depth = depth_of(step.disparity + camera.doffs, pictures.f, camera.baseline)
    return State(
        stage=step.stage,
        disparity=step.disparity.astype(kind),
        depth=depth.astype(kind),
        costs=costs,
        piece=step.cost[-1].astype(np.float32) if comparing else None,
        done=step.done,
        direction=step.direction,
        jumps=step.jumps,
        lowest=_mean_lowest(step) if comparing else np.nan,
        energy=np.nan
        if step.summed is None
        else energy(step.summed, step.disparity, step.jumps[0], P2=step.jumps[1]),
        wrong=wrong,
        error=error,
        unknown=unknown,
    )


def _mean_lowest(step: Matching) -> float:
    best = np.clip(np.nan_to_num(step.disparity), 0, len(step.cost) - 1).astype(np.intp)
    lowest = np.take_along_axis(step.cost, best[None], axis=0)[0]
    return float(np.mean(lowest, where=np.isfinite(lowest)))
