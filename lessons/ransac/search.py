"""The stage `search`: RANSAC itself, on any model, with the functions in its slots."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import partial
from itertools import chain

import numpy as np

from lessons.ransac.inputs import Input
from lessons.ransac.rows import Subject, built_in, rows_of
from workbench.algorithms.robust import HUBER, reweighted_fit
from workbench.algorithms.robust.models import PLANE, Model, from_points
from workbench.algorithms.robust.ransac import Fit, Judge, State, ransac
from workbench.algorithms.robust.ransac import iterations_needed as needed
from workbench.algorithms.robust.samplers import prosac_samples, uniform_samples
from workbench.algorithms.robust.scores import (
    Score,
    count_inliers,
    count_score,
    mlesac_score,
    msac_score,
)
from workbench.errors import InputError
from workbench.geometry.shapes.lines_planes import plane_from_points
from workbench.lesson import Slot, cached
from workbench.tracing import untraced

SHOWN_IN_PARTS = 3  # samples
SHARES = np.array([0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7])
METHODS = ("RANSAC", "Huber", "least squares")


def subject_of(params: Input) -> Subject:
    """Return the rows, without the voters of earlier winners, and what the rivals make of them.

    Raises:
        InputError: If a file cannot be used, or not with this model.
    """
    rows = with_limit(params, rows_of(params))
    for _ in range(params.taken):
        best = winner(params, rows)
        if best is None or len(rows.p) - best.count < rows.model.fewest:
            raise InputError("too few rows are left when the winner's voters are taken away")
        rows = rows.without(best.inliers)
    return replace(rows, rivals=rivals_of(rows))


def with_limit(params: Input, rows: Subject) -> Subject:
    """Return the rows with the distance at which one votes."""
    in_pixels = rows.model.unit == "px"
    return replace(rows, limit=params.inlier_pixels if in_pixels else params.inlier_distance)


def winner(params: Input, subject: Subject) -> Fit | None:
    """Return what a whole run ends with; nobody's own functions do its work."""
    with untraced():
        *_, end = _tries(params, subject, subject.model, judge=_judge(params, subject))
    return end.best


@cached
def errors_by_outliers(params: Input) -> np.ndarray:
    """Return the RMS error to the truth at each of SHARES, one row per method of METHODS."""
    errors = []
    for share in SHARES:
        rows = with_limit(params, built_in(params, float(share)))
        best = winner(params, rows)
        fits = {"RANSAC": best.estimate if best else None, **rivals_of(rows)}
        errors.append([rows.error(fits[name]) for name in METHODS])
    return np.array(errors).T


def search(
    params: Input,
    subject: Subject,
    *,
    plane_from_points: Slot = plane_from_points,
    count_inliers: Slot = count_inliers,
    iterations_needed: Slot = needed,
) -> Iterator[State]:
    """Yield the parts of RANSAC that are shown. On planes the functions given here do their
    work.
    """
    model = subject.model
    judge = _judge(params, subject)
    if model is PLANE:
        model = replace(PLANE, solve=from_points(_checked(plane_from_points)))
        judge = _counting(judge, count_inliers, decides=params.score == "count")
    tries = _tries(params, subject, model, judge=judge, needed_for=iterations_needed)
    yield from (state for state in tries if _shown(params, state))


def _tries(
    params: Input,
    subject: Subject,
    model: Model,
    *,
    judge: Callable[[np.ndarray], Fit],
    needed_for: Slot = needed,
) -> Iterator[State]:
    """Return all parts of RANSAC."""
    return ransac(
        subject.p,
        model,
        chain(chosen_sample(params, subject), _samples(params, subject)),
        judge=judge,
        needed_for=needed_for,
        share_of=(lambda fit: subject.trusted(fit)[1]) if params.sampler == "PROSAC" else None,
        confidence=params.confidence,
        max_iterations=params.most_samples,
        local_refit=params.local_refit,
    )


def chosen_sample(params: Input, subject: Subject) -> list[np.ndarray]:
    """Return the sample that the person picked, once enough different points are."""
    rows = dict.fromkeys(reversed(params.sample))
    picked = [row for row in rows if 0 <= row < len(subject.p)]
    size = subject.model.sample_size
    return [np.array(picked[:size], dtype=np.intp)] if len(picked) >= size else []


def rivals_of(subject: Subject) -> dict[str, np.ndarray]:
    """Return least squares over all rows, and Huber's fit with its corner at the inlier
    distance.
    """
    if len(subject.p) < subject.model.fewest:
        return {}
    with np.errstate(over="ignore", invalid="ignore"):  # rows that determine nothing
        first, *_, last = reweighted_fit(
            subject.p, subject.model, HUBER, corner=subject.limit, max_iterations=30
        )
    fits = {"least squares": first.estimate, "Huber": last.estimate}
    return {name: estimate for name, estimate in fits.items() if np.isfinite(estimate).all()}


def _shown(params: Input, state: State) -> bool:
    """Tell whether a part of a sample becomes a step."""
    if state.iteration <= SHOWN_IN_PARTS or state.phase in ("best", "refit", "stop"):
        return True
    if params.steps == "every sample":
        return state.phase in ("inliers", "degenerate")
    return params.steps == "every part"


def _judge(params: Input, subject: Subject) -> Judge:
    return Judge(
        p=subject.p,
        model=subject.model,
        inlier_distance=subject.limit,
        score=_score(params, subject),
    )


def _score(params: Input, subject: Subject) -> Score:
    """Return the score that the params name. An outlier may be anywhere in the model's window."""
    if params.score == "MLESAC":
        return partial(mlesac_score, span=float(np.linalg.norm(subject.high - subject.low)))
    return count_score if params.score == "count" else msac_score


def _checked(plane_from_points: Slot) -> Callable[[np.ndarray], np.ndarray]:
    """Return the function, made to say so when it does not give a plane."""

    def plane(p: np.ndarray) -> np.ndarray:
        numbers = np.asarray(plane_from_points(p), dtype=float)
        if numbers.shape != (4,):
            raise InputError(
                f"plane_from_points returned {numbers.shape} numbers; a plane is 4 numbers: a, b,"
                " c, d"
            )
        return numbers

    return plane


@dataclass(frozen=True, eq=False)
class Counted(Fit):
    """A fit whose votes somebody counted."""

    votes: int

    @property
    def count(self) -> int:
        """How many points vote, as it was counted."""
        return self.votes


def _counting(judge: Judge, count_inliers: Slot, *, decides: bool) -> Callable[[np.ndarray], Fit]:
    """Return a judge whose votes somebody counts; where that decides, the count is the score."""

    def counted(plane: np.ndarray) -> Fit:
        fit = judge(plane)
        votes = int(count_inliers(plane, judge.p, judge.inlier_distance))
        score = float(votes) if decides else fit.score
        return Counted(plane, fit.distances, fit.inliers, score, votes)

    return counted


def _samples(params: Input, subject: Subject) -> Iterator[np.ndarray]:
    rng = np.random.default_rng(params.seed)
    size = subject.model.sample_size
    if params.sampler == "uniform":
        return uniform_samples(len(subject.p), size, rng)
    if subject.quality is None:
        raise InputError(
            "PROSAC draws the most trusted first, and this file does not say whom to trust: set"
            " sampler to uniform"
        )
    return prosac_samples(subject.quality, size, rng)
