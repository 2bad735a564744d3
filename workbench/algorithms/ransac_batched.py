"""RANSAC without steps: the same pieces as `ransac`, many samples at a time, for when only the answer is wanted.

Four things make it quick: the samples of a batch are solved at once; candidates meet a few hundred rows first, and only the
promising ones meet them all; rows are scored in single precision where that is exact enough; and the local refit of each
new best finds a good model, and with it the end, sooner.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float

from workbench.algorithms.models import Model
from workbench.algorithms.ransac import Fit, Judge, Stop, check_rows, iterations_needed, refit_rounds
from workbench.algorithms.robust import mixture_fit
from workbench.algorithms.samplers import draw_samples
from workbench.algorithms.scores import Score, msac_score

_PREVIEW = 400  # rows every candidate meets
_PROMISING = 4  # candidates that meet all rows
_BLOCK = 1 << 16  # distances computed at once: they stay in the cache
_WIDTHS = (2.5, 1.5, 1.0)  # of the local refit, in inlier distances: wide first, because the model of a sample is off
_REFITTED = 200  # rows the local refit uses at most


@dataclass(frozen=True, eq=False)
class Answer:
    """What a run found: the best fit after its refit, the samples it drew, and why it stopped."""

    best: Fit | None
    iterations: int
    stop: Stop


def ransac_batched(
    p: Float[np.ndarray, "n d"],
    model: Model,
    rng: np.random.Generator,
    *,
    inlier_distance: float,
    score: Score = msac_score,
    confidence: float = 0.99,
    max_iterations: int = 1000,
) -> Answer:
    """Return the best fit among as many samples as the confidence asks for, locally refitted.

    Args:
        p: The rows: points, or matches.
        model: What to fit.
        rng: Where chance comes from.
        inlier_distance: How far an inlier may be, in the unit of the model's distances.
        score: How good a candidate is.
        confidence: With which probability one sample at least shall be free of outliers.
        max_iterations: Samples drawn at most.

    Raises:
        ValueError: If there are too few rows, they have the wrong number of columns, or are not finite.
    Reference: Chum and Matas, Randomized RANSAC with T(d, d) test, 2002 (a preview on few rows); Lebeda, Matas and Chum,
        Fixing the Locally Optimized RANSAC, 2012 (the local refit).
    """
    check_rows(p, model)
    judge = Judge(p, model, inlier_distance, score)
    rows = scoring_rows(p, inlier_distance)
    preview = rows[rng.permutation(len(rows))[:_PREVIEW]] if len(rows) > 2 * _PREVIEW else rows
    best, drawn, needed, batch = None, 0, float(max_iterations), 80
    while drawn < needed:
        count = int(min(batch, needed - drawn))
        drawn, batch = drawn + count, min(2 * batch, 512)
        estimates = model.solve(p[draw_samples(len(p), model.sample_size, count, rng)])
        for estimate in promising(estimates, preview, rows, model, inlier_distance, score):
            trial = judge(estimate)
            if trial.score > (best.score if best else 0.0):
                best = locally_refitted(trial, judge, rng)
                needed = min(max_iterations, iterations_needed(best.count / len(p), model.sample_size, confidence))
    if best is None:
        return Answer(None, drawn, Stop.NO_MODEL)
    *_, last = best, *refit_rounds(p, model, best, judge, changing=0.005)
    estimate = mixture_fit(p, model, last.estimate, inlier_distance=inlier_distance)
    best = judge(estimate)
    return Answer(best, drawn, Stop.MAX_ITERATIONS if needed == max_iterations else Stop.ENOUGH)


def promising(
    estimates: np.ndarray, preview: np.ndarray, rows: np.ndarray, model: Model, inlier_distance: float, score: Score
) -> np.ndarray:
    """Return the estimate with the best score over all rows, out of the few with the best scores over the preview."""
    for few, kept in ((preview, _PROMISING), (rows, 1)):
        if len(estimates) > kept:
            estimates = estimates[np.argsort(-scored(estimates, few, model, inlier_distance, score))[:kept]]
    return estimates


def scored(estimates: np.ndarray, rows: np.ndarray, model: Model, inlier_distance: float, score: Score) -> np.ndarray:
    """Return the score of each estimate, in blocks small enough to stay in the cache."""
    estimates = estimates.astype(rows.dtype)
    block = max(1, _BLOCK // len(rows))
    return np.concatenate([
        score(model.distances(estimates[k : k + block], rows), inlier_distance) for k in range(0, len(estimates), block)
    ])  # fmt: skip


def locally_refitted(fit: Fit, judge: Judge, rng: np.random.Generator) -> Fit:
    """Return the fit after refits to rows within a distance that shrinks to the inlier distance; as it was if better."""
    p, model = judge.p, judge.model
    estimate, distances = fit.estimate, fit.distances
    for width in _WIDTHS:
        near = np.flatnonzero(distances <= width * judge.inlier_distance)
        if len(near) < model.fewest:
            return fit
        few = near if len(near) <= _REFITTED else rng.choice(near, _REFITTED, replace=False)
        estimate = model.refit(p[few], start=estimate)
        distances = model.distances(estimate, p)
    last = judge(estimate)
    return last if last.score > fit.score else fit


def scoring_rows(p: Float[np.ndarray, "n d"], inlier_distance: float) -> np.ndarray:
    """Return the rows in single precision, unless distances could then be wrong by a hundredth of the inlier distance."""
    coarse = 16.0 * np.finfo(np.float32).eps * np.abs(p).max() > 0.01 * inlier_distance
    return p if coarse else p.astype(np.float32)
