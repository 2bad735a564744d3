"""How right a run is, from the pictures' truth and the maps that a state carries."""

import functools
from typing import Any

import numpy as np

from lessons.disparity.lesson import lesson
from tests.verdicts import Run
from workbench.algorithms.stereo.disparity import Stage

CHOSEN = -6  # from the end: the last map before the check


def off(run: Run, k: int) -> np.ndarray:
    """Return how far the pixels that both cameras see are off, pixels; NaN where a disparity is
    unknown.
    """
    pair = run.subject.pair
    return np.abs(run.states[k].disparity - pair.disparity)[pair.visible]


def wrong(run: Run, k: int) -> float:
    """Return the percentage of the pixels that both see whose disparity is over 1 px off."""
    return 100.0 * float((off(run, k) > 1.0).mean())


def true_depth(pair) -> np.ndarray:
    camera = pair.camera
    d = pair.disparity + pair.camera.doffs
    return np.where(d > 0, camera.f * camera.baseline / np.where(d > 0, d, 1.0), np.inf)


def depths_off(run: Run, k: int) -> tuple[np.ndarray, np.ndarray]:
    """Return the errors of the depths, metres, and the true ones, where both are known and
    finite.
    """
    true = true_depth(run.subject.pair)
    depth = run.states[k].depth
    known = np.isfinite(depth) & np.isfinite(true)
    return np.abs(depth[known] - true[known]), true[known]


def slice_of(run: Run, d: int) -> np.ndarray:
    """Return what each left pixel costs at a shift: grey differences, or as the run has them."""
    if run.params.cost != "SAD":
        return run.states[d].piece
    left = run.subject.left
    right = run.subject.right
    cost = np.full(left.shape, np.inf)
    cost[:, d:] = np.abs(left[:, d:] - right[:, : left.shape[1] - d])
    return cost


def fresh(run: Run, k: int) -> int:
    """Return how many pixels cost less at shift k than at any smaller one."""
    before = np.minimum.reduce([slice_of(run, d) for d in range(k)])
    return int((slice_of(run, k) < before).sum())


@functools.lru_cache(maxsize=8)
def run_of(params) -> Run:
    """Return another run."""
    return Run(params, tuple(lesson.form.states(params)), lesson.form.setup(params))


def of_stage(run: Run, stage: Stage) -> int:
    """Return the last step of a stage."""
    return [k for k, state in enumerate(run.states) if state.stage is stage][-1]


def off_in(run: Run, k: int, part: tuple[slice, slice]) -> float:
    return float((np.abs(run.states[k].disparity - run.subject.pair.disparity) > 1.0)[part].mean())


def hidden_given_up(run: Run, k: int) -> float:
    """Return the share of what only the left camera sees that has no disparity."""
    pair = run.subject.pair
    hidden = np.isfinite(pair.disparity) & ~pair.visible
    return float(np.isnan(run.states[k].disparity)[hidden].mean())


def near_an_edge(run: Run, k: int = CHOSEN) -> tuple[float, float]:
    """Return the share of the wrong pixels, and of all, that have a jump of the true disparity
    within 10 px.
    """
    truth = run.subject.pair.disparity
    visible = run.subject.pair.visible
    jump = np.zeros(truth.shape, bool)
    for axis in (0, 1):
        step = np.abs(np.diff(truth, axis=axis)) > 2.0
        jump[tuple(slice(1, None) if a == axis else slice(None) for a in (0, 1))] |= step
        jump[tuple(slice(None, -1) if a == axis else slice(None) for a in (0, 1))] |= step
    rows, columns = np.nonzero(jump)
    near = np.zeros(truth.shape, bool)
    for v, u in zip(rows, columns, strict=True):
        near[max(v - 10, 0) : v + 11, max(u - 10, 0) : u + 11] = True
    bad = (np.abs(run.states[k].disparity - truth) > 1.0) & visible
    return float(near[bad].mean()), float(near[visible].mean())


def pair_of(params) -> Any:
    """Return the made pair of a run, with its truth."""
    return lesson.form.setup(params).pair


def found_at(run: Run, step: int) -> dict[float, float]:
    """Return the median depth found of what truly stands at 1, 5 and 20 m."""
    pair = run.subject.pair
    depth = run.states[step].depth
    true = np.round(true_depth(pair), 6)
    return {
        z: float(np.median(depth[(true == z) & pair.visible & np.isfinite(depth)]))
        for z in (1.0, 5.0, 20.0)
    }


def hidden_share(pair) -> float:
    """Return the percentage of the left pixels that the right camera does not see."""
    return 100 * float((~pair.visible).mean())


def cost_at(run: Run, d: int) -> float:
    """Return the sum of grey differences of the followed pixel's window at a shift."""
    u, v = run.subject.pixel
    half = run.params.window // 2
    rows = slice(v - half, v + half + 1)
    left = run.subject.left[rows, u - half : u + half + 1]
    right = run.subject.right[rows, u - d - half : u - d + half + 1]
    return float(np.abs(left - right).sum())


def lowest_until(run: Run, d: int) -> int:
    """Return the shift of the lowest cost of those up to d."""
    return int(np.argmin([cost_at(run, shift) for shift in range(d + 1)]))


def wrong_along(run: Run, k: int, shifts: np.ndarray) -> float:
    """Return the share of a row's columns so far that are over 1 px off, of those both see."""
    pair = run.subject.pair
    n = run.states[k].columns
    v = run.subject.pixel[1]
    off = np.abs(shifts[:n] - pair.disparity[v, :n])[pair.visible[v, :n]]
    return float((off > 1.0).mean())
