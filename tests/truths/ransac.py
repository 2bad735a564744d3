"""What is true of a robust fit, from the rows and the truth that a run carries: distances,
errors, draws needed.
"""

import math

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
    lines = first @ estimate.T
    back = second @ estimate
    slope = np.square(lines[:, :2]).sum(1) + np.square(back[:, :2]).sum(1)
    return np.abs((second * lines).sum(1)) / np.sqrt(slope)


def rms(values: np.ndarray) -> float:
    return float(np.sqrt(np.square(values).mean()))


def limit_of(run: Run) -> float:
    return (
        run.params.inlier_pixels if run.subject.model.unit == "px" else run.params.inlier_distance
    )


def votes_on(run: Run, estimate: np.ndarray) -> int:
    """Return how many rows lie within the limit of an estimate."""
    return int((apart(run.subject.model.name, estimate, run.subject.p) <= limit_of(run)).sum())


def error(run: Run, estimate: np.ndarray) -> float:
    """Return how far the true rows, free of noise, are from an estimate: it holds all of its
    parameters.
    """
    return rms(apart(run.subject.model.name, estimate, run.subject.p_true))


def is_right(run: Run, k: int) -> bool:
    """Nearer to the truth than the noise lets single rows be."""
    best = run.states[k].best
    if best is None:
        return False
    in_pixels = run.subject.model.unit == "px"
    return error(run, best.estimate) < (run.params.noise_pixels if in_pixels else run.params.noise)


def enough_for(share: float, size: int, confidence: float) -> float:
    """Return the fewest draws of which one is clean with this confidence, by doubling and
    halving.
    """
    clean = share**size
    low = 0
    high = 1
    while 1.0 - (1.0 - clean) ** high < confidence:
        low = high
        high = 2 * high
    while high - low > 1:
        middle = (low + high) // 2
        low, high = (low, middle) if 1.0 - (1.0 - clean) ** middle >= confidence else (middle, high)
    return high


def most_trusted(run: Run, k: int) -> tuple[int, float]:
    """Return PROSAC's termination length and the share of votes in it, from the definition (its
    sec. 2.2, eq. 7 to 9).

    At least twenty rows; a wrong model has each row beside the sample with 5 %, and so many or more
    with less than 5 %.
    """
    best = run.states[k].best
    m = run.subject.model.sample_size
    chosen = (0, 0.0)
    by_trust = sorted(range(len(best.inliers)), key=lambda row: -run.subject.quality[row])
    votes = [bool(best.inliers[row]) for row in by_trust]
    for n in range(20, len(votes) + 1):
        votes_here = sum(votes[:n])
        if votes_here <= m or votes_here / n < chosen[1]:
            continue
        tail = sum(
            math.comb(n - m, i - m) * 0.05 ** (i - m) * 0.95 ** (n - i)
            for i in range(votes_here, n + 1)
        )
        if tail < 0.05:
            chosen = (n, votes_here / n)
    return chosen


def share_for_stop(run: Run, k: int) -> float:
    """Return the share of votes that the run takes for the truth: of the most trusted in PROSAC,
    otherwise of all.
    """
    best = run.states[k].best
    if run.params.sampler == "PROSAC":
        return most_trusted(run, k)[1]
    return votes_on(run, best.estimate) / len(run.subject.p)


def finished(params) -> Run:
    """Return the run of some params."""
    states = lesson.form.states(params)
    return Run(params, tuple(states), lesson.form.setup(params))


def drawn(run: Run) -> int:
    return run.states[-1].iteration


def last_error(run: Run) -> float:
    return error(run, run.states[-1].best.estimate)


def error_of_rival(run: Run, name: str) -> float:
    return error(run, run.subject.rivals[name])


def clean(run: Run, size: int) -> float:
    return float(run.subject.is_inlier.mean()) ** size


def refused(run: Run) -> float:
    """Return the share of the true rows beyond the limit of the final model."""
    true = run.subject.p[run.subject.is_inlier]
    return float((apart("plane", run.states[-1].best.estimate, true) > limit_of(run)).mean())


def clutter_votes(run: Run) -> bool:
    """Over a third of the outliers lie within the limit."""
    others = run.subject.p[~run.subject.is_inlier]
    off = apart("plane", run.states[-1].best.estimate, others)
    return bool((off <= limit_of(run)).mean() > 1 / 3)


def kept(run: Run) -> float:
    """Return the error of the best before the refit."""
    best = [state for state in run.states if state.phase == "best"][-1]
    return error(run, best.best.estimate)


def at_true_share(run: Run, size: int) -> float:
    return enough_for(clean(run, 1), size, run.params.confidence)


def line_through(p: np.ndarray) -> np.ndarray:
    """Return the line (a, b, c) through two points, by homogeneous coordinates."""
    a, b, c = np.cross([*p[0], 1.0], [*p[1], 1.0])
    return np.array([a, b, c]) / np.hypot(a, b)
