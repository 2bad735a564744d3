"""What is true of a robust fit, from the rows and the truth that a state carries: distances, errors, draws needed."""

import dataclasses
import functools
import itertools
from collections.abc import Sequence

import numpy as np

from lessons.ransac.lesson import lesson
from tests.verdicts import Run


def apart(model: str, estimate: np.ndarray, p: np.ndarray) -> np.ndarray:
    """Return the distances of rows to an estimate, written here once more."""
    if model in ("line", "plane"):
        return np.abs(p @ estimate[:-1] + estimate[-1]) / np.linalg.norm(estimate[:-1])
    if model in ("circle", "sphere"):
        return np.abs(np.linalg.norm(p - estimate[:-1], axis=1) - estimate[-1])
    first, second = (np.column_stack([uv, np.ones(len(p))]) for uv in (p[:, :2], p[:, 2:]))
    if model == "homography":
        moved = first @ estimate.T
        return np.linalg.norm(moved[:, :2] / moved[:, 2:] - p[:, 2:], axis=1)
    lines, back = first @ estimate.T, second @ estimate
    slope = np.square(lines[:, :2]).sum(1) + np.square(back[:, :2]).sum(1)
    return np.abs((second * lines).sum(1)) / np.sqrt(slope)


def rms(values: np.ndarray) -> float:
    return float(np.sqrt(np.square(values).mean()))


def error(state, estimate: np.ndarray) -> float:
    """Return how far the true rows, free of noise, are from an estimate: it holds all of its parameters."""
    return rms(apart(state.subject.model.name, estimate, state.subject.p_true))


def is_right(state) -> bool:
    """Nearer to the truth than the noise lets single rows be."""
    if state.now.best is None:
        return False
    sigma = state.params.noise_pixels if state.subject.model.unit == "px" else state.params.noise
    return error(state, state.now.best.estimate) < sigma


def determines(sample: np.ndarray) -> bool:
    """Whether three points make a plane, or four matches a homography that some camera can see."""
    if sample.shape[1] == 3:
        return bool(np.linalg.matrix_rank(np.diff(sample, axis=0), tol=1e-9) > 1)
    corners = [sample[list(three)] for three in itertools.combinations(range(4), 3)]
    turned = [side(three[:, :2]) * side(three[:, 2:]) for three in corners]
    return all(turn > 0 for turn in turned) or all(turn < 0 for turn in turned)


def side(uv: np.ndarray) -> float:
    """Return on which side of two pixels the third is: as signed area."""
    (a, b), (c, d) = uv[1] - uv[0], uv[2] - uv[0]
    return float(a * d - b * c)


def enough_for(share: float, size: int, confidence: float) -> float:
    """Return the fewest draws of which one is clean with this confidence, by doubling and halving."""
    clean, low, high = share**size, 0, 1
    while 1.0 - (1.0 - clean) ** high < confidence:
        low, high = high, 2 * high
    while high - low > 1:
        middle = (low + high) // 2
        low, high = (low, middle) if 1.0 - (1.0 - clean) ** middle >= confidence else (middle, high)
    return high


@functools.lru_cache(maxsize=4)
def states(params) -> tuple:
    return tuple(lesson.run(params))


def drawn(run: Run) -> int:
    return run.states[-1].now.iteration


def last_error(run: Run) -> float:
    return error(run.states[-1], run.states[-1].now.best.estimate)


def error_of_rival(run: Run, name: str) -> float:
    state = run.states[-1]
    return error(state, next(rival.estimate for rival in state.rivals if rival.name == name))


def clean(run: Run, size: int) -> float:
    return float(run.states[-1].subject.is_inlier.mean()) ** size


def refused(run: Run) -> float:
    """Return the share of the true rows beyond the limit of the final model, and of the true one."""
    state = run.states[-1]
    inliers = state.subject.p[state.subject.is_inlier]
    beyond = apart("plane", state.now.best.estimate, inliers) > state.inlier_distance
    return float(beyond.mean())


def clutter_votes(run: Run) -> bool:
    """Over a third of the outliers lie within the limit."""
    state = run.states[-1]
    off = apart("plane", state.now.best.estimate, state.subject.p[~state.subject.is_inlier])
    return bool((off <= state.inlier_distance).mean() > 1 / 3)


def kept(found: Sequence) -> float:
    """Return the error of the best before the refit."""
    best = [state for state in found if state.now.phase == "best"][-1]
    return error(best, best.now.best.estimate)


def reached(found: Sequence) -> int:
    """Return after how many samples the best has four fifths of the inliers it ends with."""
    enough = 0.8 * np.count_nonzero(found[-1].now.best.inliers)
    return next(
        state.now.iteration
        for state in found
        if state.now.best is not None and np.count_nonzero(state.now.best.inliers) >= enough
    )


@functools.cache
def hundreds_by_chance(params) -> float:
    """Return how often chance needs a hundred samples at least, of five seeds."""
    return float(np.mean([reached(states(dataclasses.replace(params, seed=seed))) >= 100 for seed in range(5)]))


def at_true_share(run: Run, size: int) -> float:
    return enough_for(clean(run, 1), size, run.params.confidence)
