"""RANSAC: guess a model from the fewest points, count who agrees, keep the best guess, refit it.

What it teaches: a fit to all points is dragged off by those that do not belong; a guess from few
points is right whenever the few are, and a formula says how often one must guess. What wins is the
model with the most points near it: mind the distance that counts as near, the noise in the sample,
and models one did not mean.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import partial
from itertools import chain
from pathlib import Path

import numpy as np

from lessons.ransac.draw import draw
from lessons.ransac.presets import PRESETS, QUESTIONS, VIEW
from lessons.ransac.rows import subject_of
from lessons.ransac.state import Params, Rival, State, Subject
from workbench.algorithms.robust import HUBER, reweighted_fit
from workbench.algorithms.robust.models import PLANE, from_points
from workbench.algorithms.robust.ransac import Fit, Judge, iterations_needed, ransac
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
from workbench.lesson import Lesson, Sweep

SHOWN_IN_PARTS = 3  # samples


def run(
    params: Params,
    *,
    plane_from_points: Callable[[np.ndarray], np.ndarray] = plane_from_points,
    count_inliers: Callable[[np.ndarray, np.ndarray, float], float] = count_inliers,
    iterations_needed: Callable[[float, int, float], float] = iterations_needed,
) -> Iterator[State]:
    """Yield the steps of RANSAC. With the plane, its minimal fit and the count are the functions
    given here.

    The count gives the share of inliers for which the number of samples is asked, and is the score
    if that is "count". PROSAC asks for the largest share among the most trusted, whoever counts.
    """
    subject = subject_of(params)
    rng = np.random.default_rng(params.seed)
    distance = params.inlier_pixels if subject.model.unit == "px" else params.inlier_distance
    model = subject.model
    judge = Judge(
        p=subject.p, model=model, inlier_distance=distance, score=score_of(params, subject)
    )
    if model is PLANE:
        model = replace(PLANE, solve=from_points(checked(plane_from_points)))
        judge = counting(judge, count_inliers, decides=params.score == "count")
    chosen = chosen_sample(params, subject)
    rivals, before, degenerate = rivals_of(subject, distance), None, 0
    for now in ransac(
        subject.p,
        model,
        chain(chosen, samples_of(params, subject, rng)),
        judge,
        needed_for=iterations_needed,
        share_of=(lambda fit: subject.most_trusted(fit)[1]) if params.sampler == "PROSAC" else None,
        confidence=params.confidence,
        max_iterations=params.most_samples,
        local_refit=params.local_refit,
    ):
        degenerate += now.phase == "degenerate"
        if shown(params, now.phase, now.iteration):
            yield State(
                params=params,
                subject=subject,
                now=now,
                inlier_distance=distance,
                best_error=subject.error(now.best.estimate if now.best else None),
                chosen=bool(chosen) and now.iteration == 1,
                rivals=rivals,
                before=before,
                degenerate=degenerate,
            )
        before = now.best


def shown(params: Params, phase: str, iteration: int) -> bool:
    """Tell whether a part of a sample becomes a step."""
    if (
        params.steps == "every part"
        or iteration <= SHOWN_IN_PARTS
        or phase in ("best", "refit", "stop")
    ):
        return True
    return params.steps == "every sample" and phase in ("inliers", "degenerate")


def score_of(params: Params, subject: Subject) -> Score:
    """Return the score that the params name. An outlier may be anywhere in the window of the
    model.
    """
    span = float(np.linalg.norm(subject.high - subject.low))
    return {"count": count_score, "MSAC": msac_score, "MLESAC": partial(mlesac_score, span=span)}[
        params.score
    ]


def checked(
    plane_from_points: Callable[[np.ndarray], np.ndarray],
) -> Callable[[np.ndarray], np.ndarray]:
    """Return the function, made to say so when it does not give a plane."""

    def plane(p: np.ndarray) -> np.ndarray:
        found = np.asarray(plane_from_points(p), dtype=float)
        if found.shape != (4,):
            raise InputError(
                f"plane_from_points returned {found.shape} numbers; a plane is 4 numbers: a, b,"
                " c, d"
            )
        return found

    return plane


@dataclass(frozen=True, eq=False)
class Counted(Fit):
    """A fit whose inliers somebody counted: `votes` is what they say."""

    votes: int

    @property
    def count(self) -> int:
        """How many points are inliers, as it was counted."""
        return self.votes


def counting(
    judge: Judge, count_inliers: Callable[[np.ndarray, np.ndarray, float], float], *, decides: bool
) -> Callable[[np.ndarray], Fit]:
    """Return a judge whose inliers somebody counts; where that decides, the count is the score."""

    def counted(plane: np.ndarray) -> Fit:
        fit, votes = judge(plane), int(count_inliers(plane, judge.p, judge.inlier_distance))
        score = float(votes) if decides else fit.score
        return Counted(
            estimate=plane, distances=fit.distances, inliers=fit.inliers, score=score, votes=votes
        )

    return counted


def samples_of(params: Params, subject: Subject, rng: np.random.Generator) -> Iterator[np.ndarray]:
    """Return the samples that chance draws."""
    n, size = len(subject.p), subject.model.sample_size
    if params.sampler == "uniform":
        return uniform_samples(n, size, rng)
    if subject.quality is None:
        raise InputError(
            "PROSAC draws the most trusted first, and this file does not say whom to trust: set"
            " sampler to uniform"
        )
    return prosac_samples(subject.quality, size, rng)


def chosen_sample(params: Params, subject: Subject) -> list[np.ndarray]:
    """Return the sample that the person picked, once enough different points are."""
    picked = [row for row in dict.fromkeys(reversed(params.sample)) if 0 <= row < len(subject.p)]
    size = subject.model.sample_size
    return [np.array(picked[:size])] if len(picked) >= size else []


def rivals_of(subject: Subject, corner: float) -> tuple[Rival, ...]:
    """Return least squares over all rows, and Huber's fit with its corner at the inlier
    distance.
    """
    if len(subject.p) < subject.model.fewest:
        return ()
    with np.errstate(
        over="ignore", invalid="ignore"
    ):  # rows that determine nothing: what is not finite is left out below
        first, *_, last = reweighted_fit(
            subject.p, subject.model, HUBER, corner=corner, max_iterations=30
        )
    found = (("least squares", first.estimate), ("Huber", last.estimate))
    return tuple(
        Rival(name, estimate, subject.error(estimate))
        for name, estimate in found
        if np.isfinite(estimate).all()
    )


lesson = Lesson(
    name="ransac",
    title="RANSAC",
    summary=(
        "Guess a shape from a few points, count how many others agree, and keep the best guess."
    ),
    page=Path(__file__).with_name("page.md"),
    params=Params,
    run=run,
    draw=draw,
    order=700,
    chapter="Estimate",
    minutes=20,
    needs=("fitting",),
    view=VIEW,
    presets=PRESETS,
    questions=QUESTIONS,
    first_step=2,
    sweeps=(Sweep("outliers", (0.0, 0.15, 0.3, 0.45, 0.6, 0.7)),),
    telling="Error to the truth",
)
