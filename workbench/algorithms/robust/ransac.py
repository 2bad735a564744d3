"""RANSAC: guess a model from few points, count who agrees, keep the best guess, refit it.

Rows `p` are points or matches; distances are in the unit of the model.

Reference: Fischler and Bolles, Random Sample Consensus: A Paradigm for Model Fitting with
Applications to Image Analysis and Automated Cartography, 1981, section II.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from enum import Enum
from itertools import islice, pairwise
from typing import Literal

import numpy as np
from jaxtyping import Bool, Float, Int

from workbench.algorithms.robust.models import Model
from workbench.algorithms.robust.scores import Score, count_score
from workbench.tracing import traced

Phase = Literal["sample", "degenerate", "model", "inliers", "best", "refit", "stop"]

NO_ROWS = np.zeros(0, dtype=int)
NO_ROWS.setflags(write=False)
TOGETHER = 64  # samples that are solved at once, where the model can
DISTANCES_TOGETHER = 2**15  # distances that are measured at once


class Stop(Enum):
    """Why a run ended."""

    ENOUGH = "enough samples for the confidence asked for"
    MAX_ITERATIONS = "the maximum number of samples is reached"
    SAMPLES_USED_UP = "there are no more samples"
    NO_MODEL = "no sample gave a model with enough inliers"

    @property
    def message(self) -> str:
        """The reason in words."""
        return self.value


@dataclass(frozen=True, eq=False)
class Fit:
    """One estimate, the points' distances, which are inliers, and the score: more is better."""

    estimate: Float[np.ndarray, "..."]
    distances: Float[np.ndarray, " n"]
    inliers: Bool[np.ndarray, " n"]
    score: float

    @property
    def count(self) -> int:
        """How many points are inliers."""
        return int(np.count_nonzero(self.inliers))

    @property
    def rms(self) -> float:
        """Root mean square distance of the inliers; NaN where there are none."""
        kept = self.distances[self.inliers]
        return float(np.sqrt(kept @ kept / len(kept))) if len(kept) else float("nan")


@dataclass(frozen=True, eq=False)
class State:
    """One part of one try.

    Attributes:
        phase: A sample was drawn; it was degenerate; it gave a model; the inliers were counted;
            that was the best so far; the best was fitted again to its inliers; it is over.
        iteration: Samples drawn so far.
        needed: Samples needed for the confidence asked for, as far as is known.
        estimate: The model under test, from phase `model` on.
        trial: How the points take it, from phase `inliers` on.
        best: The best fit so far, if any.
        stop: Why this is the last state, or None.
    """

    phase: Phase
    iteration: int
    needed: float
    sample: Int[np.ndarray, " m"]
    estimate: Float[np.ndarray, "..."] | None
    trial: Fit | None
    best: Fit | None
    stop: Stop | None = None


def iterations_needed(inlier_ratio: float, sample_size: int, confidence: float) -> float:
    """Return how many samples give, with this confidence, at least one without an outlier.

    It is a whole number, at least 1; infinity where the inlier ratio is 0 (or so small that no
    number can hold the answer). A sample without an outlier need not give a good model: its points
    are noisy.

    Reference: Fischler and Bolles 1981, section II.B; Hartley and Zisserman, Multiple View
    Geometry, 2nd ed., eq. 4.18.

    Examples:
        >>> int(iterations_needed(0.5, 3, 0.99))  # half are inliers, a plane needs three
        35
    """
    clean = inlier_ratio**sample_size
    if clean >= 1.0:
        return 1
    if clean <= 0.0:
        return np.inf
    return max(1.0, np.ceil(np.log1p(-confidence) / np.log1p(-clean)))


@dataclass(frozen=True, eq=False)
class Judge:
    """Says how all rows take an estimate: inliers lie within `inlier_distance`."""

    p: Float[np.ndarray, "n d"]
    model: Model
    inlier_distance: float
    score: Score = count_score

    def __call__(self, estimate: Float[np.ndarray, "..."]) -> Fit:
        """Return the estimate's distances, inliers and score."""
        return self.each(estimate[None])[0]

    def each(self, estimates: Float[np.ndarray, "k ..."]) -> list[Fit]:
        """Return the fit of each estimate, bit by bit as one by one."""
        distances = self.model.distances(estimates, self.p)
        scores = self.score(distances, self.inlier_distance).tolist()
        return [
            Fit(estimate, own := row.copy(), own <= self.inlier_distance, float(score))
            for estimate, row, score in zip(estimates, distances, scores, strict=True)
        ]


@traced
def ransac(
    p: Float[np.ndarray, "n d"],
    model: Model,
    samples: Iterator[np.ndarray],
    *,
    judge: Callable[[np.ndarray], Fit],
    needed_for: Callable[[float, int, float], float] = iterations_needed,
    share_of: Callable[[Fit], float] | None = None,
    confidence: float = 0.99,
    max_iterations: int = 1000,
    local_refit: bool = False,
) -> Iterator[State]:
    """Yield the states of RANSAC: for each sample its parts, then the rounds of the final refit.

    Args:
        samples: Rows to try, from `uniform_samples`, `prosac_samples`, or chosen. Of a model with
            `solve_each` some more are drawn than tried.
        judge: Says how all rows take an estimate: `Judge(p, model, inlier_distance, score)`.
        needed_for: The number of samples for an inlier ratio, a sample size and a confidence.
        share_of: The inlier ratio for which `needed_for` is asked, of each new best; by default
            that of all rows.
        confidence: With which probability one sample at least shall be free of outliers.
        max_iterations: Samples drawn at most.
        local_refit: Refit every new best at once (LO-RANSAC), not only the last.

    Raises:
        ValueError: If there are too few rows, of the wrong number of columns, or not finite ones.

    Reference: Fischler and Bolles 1981, section II; Chum, Matas and Kittler, Locally Optimized
    RANSAC, 2003 (`local_refit`).
    """
    check_rows(p, model)
    if model.solve_each is not None:
        ahead = Ahead(p, model, samples, judge=judge, needed_for=needed_for, most=max_iterations)
        model = replace(model, solve=ahead.solve)
        samples = ahead.samples()
        judge = ahead.judge
        needed_for = ahead.needed_for
    best = None
    needed = max_iterations
    stop = Stop.SAMPLES_USED_UP
    iteration = 0
    sample = NO_ROWS
    for iteration, sample in enumerate(samples, start=1):
        yield State("sample", iteration, needed, sample, None, None, best)
        estimates = model.solve(p[sample][None])
        if len(estimates) == 0:
            yield State("degenerate", iteration, needed, sample, None, None, best)
        for estimate in estimates:  # seven matches give up to three fundamental matrices
            yield State("model", iteration, needed, sample, estimate, None, best)
            trial = judge(estimate)
            yield State("inliers", iteration, needed, sample, estimate, trial, best)
            if trial.score > (best.score if best else 0.0):
                best = polished(p, model, trial, judge=judge) if local_refit else trial
                share = best.count / len(p) if share_of is None else share_of(best)
                # eq. 4.18
                needed = min(max_iterations, needed_for(share, model.sample_size, confidence))
                yield State("best", iteration, needed, sample, best.estimate, best, best)
        if iteration >= needed:
            stop = Stop.MAX_ITERATIONS if needed == max_iterations else Stop.ENOUGH
            break

    for refit in refit_rounds(p, model, best, judge=judge) if best else ():
        best = refit
        yield State("refit", iteration, needed, sample, best.estimate, best, best)
    yield State(
        "stop", iteration, needed, sample, None, None, best, stop if best else Stop.NO_MODEL
    )


class Ahead:
    """Knows what the samples to come give: many are solved at once, and their estimates judged.

    An estimate that is none of theirs, of a refit, is judged alone.
    """

    def __init__(
        self,
        p: Float[np.ndarray, "n d"],
        model: Model,
        samples: Iterator[np.ndarray],
        *,
        judge: Callable[[np.ndarray], Fit],
        needed_for: Callable[[float, int, float], float],
        most: int,
    ):
        self._p, self._model, self._judge = p, model, judge
        self._needed_for, self._most = needed_for, most
        self._needed: float = most
        self._to_come = iter(samples)
        self._of_sample: dict[bytes, np.ndarray] = {}
        self._estimates = np.zeros((0,))
        self._place: dict[bytes, int] = {}
        self._fits: dict[int, Fit] = {}

    def samples(self) -> Iterator[np.ndarray]:
        """Yield the samples; with the first of each batch all of it is solved, but no more than
        are left to try.
        """
        tried = 0
        while batch := list(islice(self._to_come, self._next_batch(tried))):
            tried += len(batch)
            rows = self._p[np.array(batch)]
            assert self._model.solve_each is not None
            self._estimates, of_sample = self._model.solve_each(rows)
            ends = np.searchsorted(of_sample, np.arange(len(batch) + 1)).tolist()
            self._of_sample = {
                sample.tobytes(): self._estimates[first:last]
                for sample, (first, last) in zip(rows, pairwise(ends), strict=True)
            }
            self._place = {estimate.tobytes(): i for i, estimate in enumerate(self._estimates)}
            self._fits = {}
            yield from batch

    def _next_batch(self, tried: int) -> int:
        return max(1, int(min(TOGETHER, self._needed - tried)))

    def needed_for(self, inlier_ratio: float, sample_size: int, confidence: float) -> float:
        """Return how many samples are needed, and remember it."""
        needed = self._needed_for(inlier_ratio, sample_size, confidence)
        self._needed = min(self._most, needed)
        return needed

    def solve(self, asked: Float[np.ndarray, "1 m d"]) -> Float[np.ndarray, "j ..."]:
        """Return the estimates through one sample."""
        estimates = self._of_sample.get(asked.tobytes())
        return self._model.solve(asked) if estimates is None else estimates

    def judge(self, estimate: Float[np.ndarray, "..."]) -> Fit:
        """Return how all rows take an estimate; it and the next ones are judged together."""
        i = self._place.get(estimate.tobytes())
        if i is None or not isinstance(self._judge, Judge):
            return self._judge(estimate)
        if i not in self._fits:
            together = max(1, DISTANCES_TOGETHER // len(self._p))
            fits = self._judge.each(self._estimates[i : i + together])
            self._fits = dict(enumerate(fits, start=i))
        return self._fits[i]


def refit_rounds(
    p: Float[np.ndarray, "n d"], model: Model, fit: Fit, *, judge: Callable[[np.ndarray], Fit]
) -> Iterator[Fit]:
    """Yield least-squares fits, each to the inliers of the one before, ten at most.

    No round lowers the MSAC score: the fit lowers the squared distances of the old inliers, and the
    new inliers are the choice that lowers the truncated sum further.

    Reference: Hartley and Zisserman, Multiple View Geometry, 2nd ed., 4.7.1 (guided refit,
    alternated until it converges).
    """
    for _ in range(10):
        if fit.count < model.fewest:
            return
        again = judge(model.refit(np.compress(fit.inliers, p, axis=0), start=fit.estimate))
        if not np.isfinite(again.estimate).all():
            return
        yield again
        if (again.inliers == fit.inliers).all():
            return
        fit = again


def polished(
    p: Float[np.ndarray, "n d"], model: Model, fit: Fit, *, judge: Callable[[np.ndarray], Fit]
) -> Fit:
    """Return the fit after its refit rounds, or as it was if they lower its score."""
    *_, last = fit, *refit_rounds(p, model, fit, judge=judge)
    return last if last.score >= fit.score else fit


def check_rows(p: Float[np.ndarray, "n d"], model: Model) -> None:
    """Raise an error unless the model can be fitted to these rows.

    Raises:
        ValueError: If there are too few rows, of the wrong number of columns, or not finite ones.
    """
    if p.shape[1] != model.columns:
        raise ValueError(
            f"a {model.name} is fitted to rows of {model.columns} numbers, not {p.shape[1]}"
        )
    if len(p) < model.sample_size:
        raise ValueError(
            f"a {model.name} needs {model.sample_size} points, there are only {len(p)}"
        )
    if not np.isfinite(p).all():
        raise ValueError("some coordinates are not finite; drop those rows first")
