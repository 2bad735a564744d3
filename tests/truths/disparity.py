"""How right a run is, from the pictures' truth and the maps that a state carries."""

import functools
from typing import Any

import numpy as np

from lessons.disparity.lesson import lesson
from tests.verdicts import Run
from workbench.algorithms.stereo.disparity import Stage

CHOSEN, CHECKED = -6, -5  # from the end: the last map before the check, and the check


def off(state, disparity: np.ndarray | None = None) -> np.ndarray:
    """Return how far the pixels that both cameras see are off, pixels; NaN where a disparity is
    unknown.
    """
    pair = state.setup.pair
    return np.abs((state.disparity if disparity is None else disparity) - pair.disparity)[
        pair.visible
    ]


def wrong(state) -> float:
    """Return the percentage of the pixels that both see whose disparity is over 1 px off."""
    return 100.0 * float((off(state) > 1.0).mean())


def mean_error(state) -> float:
    """Return the mean error of those that are within 1 px."""
    errors = off(state)
    return float(errors[errors <= 1.0].mean())


def true_depth(setup) -> np.ndarray:
    camera, d = setup.pair.camera, setup.pair.disparity + setup.pair.camera.doffs
    return np.where(d > 0, camera.f * camera.baseline / np.where(d > 0, d, 1.0), np.inf)


def depths_off(state) -> tuple[np.ndarray, np.ndarray]:
    """Return the errors of the depths, metres, and the true ones, where both are known and
    finite.
    """
    true = true_depth(state.setup)
    known = np.isfinite(state.depth) & np.isfinite(true)
    return np.abs(state.depth[known] - true[known]), true[known]


@functools.lru_cache(maxsize=2)
def comparing(states: tuple) -> tuple[tuple[int, float], ...]:
    """Return for every slice how many pixels it fits better than all before it, and the mean lowest
    cost after it.
    """
    lowest, found = None, []
    for state in states:
        if state.stage is not Stage.COMPARE:
            break
        slice_ = np.where(np.isfinite(state.piece), state.piece, np.inf)
        fresh = slice_.size if lowest is None else int((slice_ < lowest).sum())
        lowest = slice_ if lowest is None else np.minimum(lowest, slice_)
        found.append((fresh, float(lowest[np.isfinite(lowest)].mean())))
    return tuple(found)


@functools.lru_cache(maxsize=8)
def states(params) -> tuple:
    return tuple(lesson.run(params))


def of_stage(run: Run, stage: Stage):
    return [state for state in run.states if state.stage is stage][-1]


def off_in(state, part: tuple[slice, slice]) -> float:
    return float((np.abs(state.disparity - state.setup.pair.disparity) > 1.0)[part].mean())


def hidden(state) -> np.ndarray:
    return ~state.setup.pair.visible


def given_up_of_hidden(run: Run) -> float:
    return float(np.isnan(run.states[CHECKED].disparity)[hidden(run.states[0])].mean())


def near_an_edge(run: Run) -> tuple[float, float]:
    """Return the share of the wrong pixels, and of all, that have a jump of the true disparity
    within 10 px.
    """
    state = run.states[CHOSEN]
    truth, visible = state.setup.pair.disparity, state.setup.pair.visible
    jump = np.zeros(truth.shape, bool)
    for axis in (0, 1):
        step = np.abs(np.diff(truth, axis=axis)) > 2.0
        jump[tuple(slice(1, None) if a == axis else slice(None) for a in (0, 1))] |= step
        jump[tuple(slice(None, -1) if a == axis else slice(None) for a in (0, 1))] |= step
    rows, columns = np.nonzero(jump)
    near = np.zeros(truth.shape, bool)
    for v, u in zip(rows, columns, strict=True):
        near[max(v - 10, 0) : v + 11, max(u - 10, 0) : u + 11] = True
    bad = (np.abs(state.disparity - truth) > 1.0) & visible
    return float(near[bad].mean()), float(near[visible].mean())


def pair_of(params) -> Any:
    """Return the made pair of a run, with its truth."""
    return next(iter(lesson.run(params))).setup.pair


def found_at(run: Run, step: int) -> dict[float, float]:
    """Return the median depth found of what truly stands at 1, 5 and 20 m."""
    state = run.states[step]
    true = np.round(true_depth(state.setup), 6)
    return {
        z: float(
            np.median(
                state.depth[(true == z) & state.setup.pair.visible & np.isfinite(state.depth)]
            )
        )
        for z in (1.0, 5.0, 20.0)
    }


def hidden_share(params) -> float:
    return 100 * float((~pair_of(params).visible).mean())
