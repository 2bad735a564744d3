"""What one step of the disparity lesson holds: the map so far, the costs at the followed pixel, and how wrong all is."""

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from lessons.disparity.pairs import Setup
from workbench.algorithms.disparity import DepthOf, Matching, Stage, reconstruct
from workbench.algorithms.semiglobal import energy

USUAL_ERROR = 0.5
"""Pixels: the disparity error whose effect is shown where no other was asked for."""


@dataclass(frozen=True, eq=False)
class State:
    """One step.

    Args:
        setup: The pair and the knobs.
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
        wrong: Share of the pixels that both cameras see whose disparity is over 1 px off; NaN without truth.
        error: Mean error of the others, pixels; NaN without truth.
        unknown: Share of pixels without a disparity.
        uncertainty: How far `disparity_error` moves each depth, metres, in the last step.
        disparity_error: The error of a disparity for which that is, pixels.
        before: The step before.
    """

    setup: Setup
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
    before: "Figures | None" = None

    @property
    def chosen(self) -> float:
        """The disparity of the followed pixel, NaN where it is unknown."""
        u, v = self.setup.pixel
        return float(self.disparity[v, u])


@dataclass(frozen=True)
class Figures:
    """The numbers of a step that the next one is compared with."""

    wrong: float
    error: float
    unknown: float
    energy: float


def states_of(setup: Setup, steps: Iterator[Matching], depth_of: DepthOf) -> Iterator[State]:
    """Yield a state per step of the matching, then two of the depths."""
    state, before = None, None
    for now in steps:
        state = _of_matching(setup, now, depth_of, before)
        before = Figures(state.wrong, state.error, state.unknown, state.energy)
        yield state
    assert state is not None
    params, camera = setup.params, setup.pair.camera
    disparity = state.disparity + params.disparity_error
    shown = abs(params.disparity_error) or USUAL_ERROR
    wrong, error, unknown = _judged(setup, disparity)
    last = replace(state, stage=None, disparity=disparity, before=before, wrong=wrong, error=error, unknown=unknown)
    for depths in reconstruct(disparity + camera.doffs, setup.f, camera.baseline, shown, depth_of):
        yield replace(last, depth=depths.depth, uncertainty=depths.uncertainty, disparity_error=shown)


def _of_matching(setup: Setup, now: Matching, depth_of: DepthOf, before: Figures | None) -> State:
    u, v = setup.pixel
    comparing = now.stage is Stage.COMPARE
    costs = np.full(setup.max_disparity + 1, np.nan)
    costs[: len(now.cost)] = now.cost[:, v, u]
    costs[~np.isfinite(costs)] = np.nan
    piece = now.cost[-1].astype(np.float32) if comparing else None
    camera = setup.pair.camera
    wrong, error, unknown = _judged(setup, now.disparity)
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


def _judged(setup: Setup, disparity: np.ndarray) -> tuple[float, float, float]:
    """Return the share of wrong pixels, the mean error of the right ones, and the share of unknown pixels."""
    unknown = float(np.isnan(disparity).mean())
    truth, visible = setup.pair.disparity, setup.pair.visible
    if truth is None or visible is None or not visible.any():
        return np.nan, np.nan, unknown
    off = np.abs(disparity - truth)[visible]
    right = off <= 1.0
    return float((off > 1.0).mean()), float(off[right].mean()) if right.any() else np.nan, unknown
