"""What is true of a robust fit, from the rows and the truth that a state carries: distances,
errors, draws needed.
"""

import functools
import itertools
import math
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
    """Return how far the true rows, free of noise, are from an estimate: it holds all of its
    parameters.
    """
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
    """Return the fewest draws of which one is clean with this confidence, by doubling and
    halving.
    """
    clean, low, high = share**size, 0, 1
    while 1.0 - (1.0 - clean) ** high < confidence:
        low, high = high, 2 * high
    while high - low > 1:
        middle = (low + high) // 2
        low, high = (low, middle) if 1.0 - (1.0 - clean) ** middle >= confidence else (middle, high)
    return high


def most_trusted(state) -> tuple[int, float]:
    """Return PROSAC's termination length and the share of votes in it, from the definition (its
    sec. 2.2, eq. 7 to 9).

    At least twenty rows; a wrong model has each row beside the sample with 5 %, and so many or more
    with less than 5 %.
    """
    best, m, found = state.now.best, state.subject.model.sample_size, (0, 0.0)
    by_trust = sorted(range(len(best.inliers)), key=lambda row: -state.subject.quality[row])
    votes = [bool(best.inliers[row]) for row in by_trust]
    for n in range(20, len(votes) + 1):
        votes_here = sum(votes[:n])
        tail = sum(
            math.comb(n - m, i - m) * 0.05 ** (i - m) * 0.95 ** (n - i)
            for i in range(max(votes_here, m), n + 1)
        )
        if votes_here > m and tail < 0.05 and votes_here / n >= found[1]:
            found = (n, votes_here / n)
    return found


def share_for_stop(state) -> float:
    """Return the share of inliers that the run takes for the truth: of the most trusted in PROSAC,
    otherwise of all.
    """
    best = state.now.best
    trusting = state.params.sampler == "PROSAC"
    return (
        most_trusted(state)[1] if trusting else np.count_nonzero(best.inliers) / len(best.inliers)
    )


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
    """Return the share of the true rows beyond the limit of the final model, and of the true
    one.
    """
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


def at_true_share(run: Run, size: int) -> float:
    return enough_for(clean(run, 1), size, run.params.confidence)
