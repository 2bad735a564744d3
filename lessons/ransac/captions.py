"""What a step of RANSAC says."""

import numpy as np

from lessons.ransac.state import State
from workbench.algorithms.robust.ransac import Stop
from workbench.certain import sure
from workbench.numerals import counted, length, percent, pixels
from workbench.scene import Caption

COUNTS = ("no", "one", "two", "three", "four", "five", "six", "seven")

BY_CHANCE = (
    " So few of the most trusted vote for it that chance can explain it: it cannot end the run."
)


def caption(state: State) -> Caption:
    """Return what just happened, with its numbers."""
    return {
        "sample": _sample,
        "degenerate": _degenerate,
        "model": _model,
        "inliers": _inliers,
        "best": _best,
        "refit": _refit,
        "stop": _stop,
    }[state.now.phase](state)


def _sample(state: State) -> Caption:
    now, noun = state.now, state.subject.noun
    how = (
        "you picked"
        if state.chosen
        else "drawn by chance"
        if state.params.sampler == "uniform"
        else "drawn by trust"
    )
    proportion = _proportion(state) if now.iteration == 1 else ""
    return Caption(
        f"Sample {now.iteration}: {COUNTS[len(now.sample)]} {noun},"
        f" {how}.{_in_truth(state)}{proportion}"
    )


def _in_truth(state: State) -> str:
    """Say how many rows of the sample are outliers in truth; the sentence can stand anywhere."""
    known, size = state.subject.is_inlier, len(state.now.sample)
    if known is None:
        return ""
    wrong = int(np.count_nonzero(~known[state.now.sample]))
    which = "none" if wrong == 0 else "all" if wrong == size else COUNTS[wrong]
    are = "is an outlier" if wrong == 1 else "are outliers"
    return f" Of its {COUNTS[size]} {state.subject.noun} {which} {are} in truth."


def _degenerate(state: State) -> Caption:
    model = state.subject.model
    text = (
        f"Sample {state.now.iteration} is degenerate: {model.degenerate_when}, so it gives no"
        f" {model.name}."
    )
    return Caption(f"{text} It counts as drawn.")


def _model(state: State) -> Caption:
    now, model, noun = state.now, state.subject.model, state.subject.noun
    return Caption(
        f"Sample {now.iteration} gives a {model.name} through its {COUNTS[len(now.sample)]} {noun}"
        f" (purple). Now all {len(state.subject.p):,} {noun} vote: yes from those within"
        f" {_limit(state)} of it."
    )


def _inliers(state: State) -> Caption:
    now, trial, noun = state.now, sure(state.now.trial), state.subject.noun
    who = "Your sample" if state.chosen else f"Sample {now.iteration}"
    text = (
        f"{who}: {trial.count:,} of {len(trial.inliers):,} {noun} lie within {_limit(state)} of its"
    )
    text += f" {state.subject.model.name}{_score(state, trial.score)}."
    if now.best is not None and trial.score <= now.best.score:
        text += f" The best so far has {_points(state, now.best)}: it stays."
    return Caption(text + (_in_truth(state) if now.phase == "inliers" else ""))


def _best(state: State) -> Caption:
    now, best = state.now, sure(state.now.best)
    share = best.count / len(best.inliers)
    text = (
        f"New best after {counted(now.iteration, 'sample')}: {_points(state, best)},"
        f" {percent(share, 0)} of all"
    )
    text += f" {state.subject.noun}.{_trusted(state)}"
    if text.endswith(BY_CHANCE):
        return Caption(text + _to_the_truth(state))
    asked = f"{100.0 * state.params.confidence:g} % confidence that one of them is free of outliers"
    if now.needed >= state.params.most_samples:
        allowed = counted(state.params.most_samples, "sample")
        text += f" If that is the share of inliers, the {allowed} allowed give no {asked}."
    else:
        text += (
            f" If that is the share of inliers, {counted(round(now.needed), 'sample')} give"
            f" {asked}."
        )
    return Caption(text + _to_the_truth(state))


def _to_the_truth(state: State) -> str:
    if not np.isfinite(state.best_error):
        return ""
    return f" RMS error to the truth {_distance(state, state.best_error)}."


def _refit(state: State) -> Caption:
    best, before = sure(state.now.best), state.before
    text = "Refit: "
    if before is not None:
        text += f"least squares on the {before.count:,} that voted for it, then all vote anew:"
        text += f" {before.count:,} → {best.count:,} votes"
        if len(state.subject.p_true):
            old = state.subject.error(before.estimate)
            text += (
                f"; RMS error to the truth {_distance(state, old)} →"
                f" {_distance(state, state.best_error)}"
            )
    return Caption(text + ".")


def _stop(state: State) -> Caption:
    now = state.now
    assert now.stop is not None
    text = f"Stop after {counted(now.iteration, 'sample')}: {now.stop.message}. "
    if now.best is None:
        return Caption(text + _why_none(state), "wrong")
    text += (
        f"{now.best.count:,} of {len(now.best.inliers):,} {state.subject.noun} are within"
        f" {_limit(state)}"
    )
    text += f" of the {state.subject.model.name}"
    if not np.isfinite(state.best_error):
        return Caption(
            f"{text}, RMS distance {_distance(state, now.best.rms)}.{_proportion(state)}"
        )
    text += f". RMS error to the truth: RANSAC {_distance(state, state.best_error)}"
    text += (
        "".join(f", {rival.name} {_distance(state, rival.error)}" for rival in state.rivals) + "."
    )
    return Caption.verdict(text, right=is_right(state), settled=now.stop is Stop.ENOUGH)


def _why_none(state: State) -> str:
    model = state.subject.model
    if state.degenerate == state.now.iteration:
        return (
            f"Every sample was degenerate ({model.degenerate_when}): such {state.subject.noun}"
            f" determine no {model.name}."
        )
    return "A larger inlier distance or more samples may help."


def _proportion(state: State) -> str:
    """Warn where the inlier distance and the size of somebody's own rows hardly belong together."""
    params, limit, unit = state.params, state.inlier_distance, state.subject.model.unit
    size = float(np.linalg.norm(np.ptp(state.subject.p, axis=0)))
    if (
        (params.cloud is None and params.matches is None)
        or size == 0.0
        or size / 5000.0 <= limit <= size / 10.0
    ):
        return ""
    few = "few" if limit < size / 10.0 else "nearly all"
    unsure = (
        "Are the matches in pixels?"
        if unit == "px"
        else f"Is the cloud in {params.cloud_unit} (cloud_unit)?"
    )
    return (
        f" Mind: the {state.subject.noun} extend over {_distance(state, size)}, so {few} of them"
        f" can be expected within {_limit(state)} of any {state.subject.model.name}. {unsure}"
    )


def is_right(state: State) -> bool:
    """Tell whether the best is the true model, but for noise: nearer than the noise allows single
    rows to be.
    """
    in_pixels = state.subject.model.unit == "px"
    sigma = state.params.noise_pixels if in_pixels else state.params.noise
    return bool(state.best_error < max(sigma, 0.5 if in_pixels else 0.005))


def _distance(state: State, value: float) -> str:
    """Write a distance to a model in the unit of its rows; of thousands of pixels two digits."""
    if state.subject.model.unit != "px":
        return length(value)
    return pixels(value if value < 1e3 else float(f"{value:.1e}"))


def _limit(state: State) -> str:
    return _distance(state, state.inlier_distance)


def _points(state: State, fit) -> str:
    return f"{counted(fit.count, 'vote')}{_score(state, fit.score)}"


def _trusted(state: State) -> str:
    """Say from which share PROSAC takes how many samples are needed."""
    if state.params.sampler != "PROSAC":
        return ""
    length, share = state.subject.most_trusted(sure(state.now.best))
    if not length:
        return BY_CHANCE
    return f" Of the {length:,} most trusted {percent(share, 0)} vote for it."


def _score(state: State, score: float) -> str:
    return "" if state.params.score == "count" else f" ({state.params.score} score {score:,.0f})"
