"""What a step of RANSAC says."""

import numpy as np

from lessons.ransac.state import State
from workbench.scene import Caption

COUNTS = ("no", "one", "two", "three", "four", "five", "six", "seven")


def caption_of(state: State) -> Caption:
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


def length(value: float, unit: str) -> str:
    """Return a distance in the unit that suits it."""
    if unit == "px":
        return f"{value:.3g} px"
    return f"{value:.3g} m" if value >= 0.1 or value == 0.0 else f"{1000.0 * value:.3g} mm"


def _sample(state: State) -> Caption:
    now, noun = state.now, state.subject.noun
    how = "you picked" if state.chosen else "drawn by chance" if state.params.sampler == "uniform" else "drawn by trust"
    return Caption(f"Sample {now.iteration}: {COUNTS[len(now.sample)]} {noun}, {how}.{_in_truth(state)}")


def _in_truth(state: State) -> str:
    known = state.subject.is_inlier
    if known is None:
        return ""
    wrong = int(np.count_nonzero(~known[state.now.sample]))
    if wrong == 0:
        return " In truth all of them are inliers."
    return f" In truth {COUNTS[wrong]} of them {'is an outlier' if wrong == 1 else 'are outliers'}."


def _degenerate(state: State) -> Caption:
    model = state.subject.model
    text = f"Sample {state.now.iteration} is degenerate: {model.degenerate_when}, so it gives no {model.name}."
    return Caption(f"{text} It counts as drawn.", "wrong")


def _model(state: State) -> Caption:
    now, model, noun = state.now, state.subject.model, state.subject.noun
    return Caption(
        f"Sample {now.iteration} gives a {model.name} through its {COUNTS[len(now.sample)]} {noun} (purple). Now every"
        f" other one of the {len(state.subject.p):,} {noun} may vote."
    )


def _inliers(state: State) -> Caption:
    now, trial, noun = state.now, state.now.trial, state.subject.noun
    assert trial is not None
    who = "Your sample" if state.chosen else f"Sample {now.iteration}"
    text = f"{who}: {trial.count:,} of {len(trial.inliers):,} {noun} lie within {_limit(state)} of its"
    text += f" {state.subject.model.name}{_score(state, trial.score)}."
    if now.best is not None and trial.score <= now.best.score:
        text += f" The best so far has {_points(state, now.best)}: it stays."
    return Caption(text + (_in_truth(state) if now.phase == "inliers" else ""))


def _best(state: State) -> Caption:
    now, best = state.now, state.now.best
    assert best is not None
    share = best.count / len(best.inliers)
    text = f"New best after {now.iteration} samples: {_points(state, best)}, {100.0 * share:.0f} % of all. "
    asked = f"{100.0 * state.params.confidence:g} % confidence"
    if now.needed >= state.params.most_samples:
        text += f"{asked} would ask for more than the {state.params.most_samples:,} samples allowed"
    else:
        text += f"If that is the share of inliers, {now.needed:,.0f} samples give {asked}"
    text += _error(state, ", ") + "."
    return Caption(text, "good")


def _refit(state: State) -> Caption:
    best, before, model = state.now.best, state.before, state.subject.model
    assert best is not None
    text = "Refit: "
    if before is not None:
        text += f"least squares on the {before.count:,} inliers, then counted anew: {before.count:,} → {best.count:,}"
        if len(state.subject.p_true):
            old = np.sqrt(np.square(model.distances(before.estimate, state.subject.p_true)).mean())
            text += f"; error to the truth {length(float(old), model.unit)} → {length(state.best_error, model.unit)}"
    return Caption(text + ".", "good")


def _stop(state: State) -> Caption:
    now, unit = state.now, state.subject.model.unit
    assert now.stop is not None
    text = f"Stop after {now.iteration:,} samples: {now.stop.message}. "
    if now.best is None:
        return Caption(text + "A larger inlier distance or more samples may help.", "wrong")
    text += f"{now.best.count:,} of {len(now.best.inliers):,} {state.subject.noun} are inliers"
    text += f", {length(now.best.rms, unit)} off"
    if not np.isfinite(state.best_error):
        return Caption(text + ".")
    text += f". Error to the truth: RANSAC {length(state.best_error, unit)}"
    text += "".join(f", {rival.name} {length(rival.error, unit)}" for rival in state.rivals)
    if is_right(state):
        return Caption(text + ".", "good")
    return Caption(text + ". It looks settled, and it is wrong.", "wrong")


def is_right(state: State) -> bool:
    """Tell whether the best is the true model, but for noise: nearer than the noise allows single rows to be."""
    pixels = state.subject.model.unit == "px"
    sigma = state.params.noise_pixels if pixels else state.params.noise
    return bool(state.best_error < max(sigma, 0.5 if pixels else 0.005))


def _limit(state: State) -> str:
    return length(state.inlier_distance, state.subject.model.unit)


def _points(state: State, fit) -> str:
    return f"{fit.count:,} inliers{_score(state, fit.score)}"


def _score(state: State, score: float) -> str:
    return "" if state.params.score == "count" else f" ({state.params.score} score {score:,.0f})"


def _error(state: State, joint: str) -> str:
    if not np.isfinite(state.best_error):
        return ""
    return f"{joint}error to the truth {length(state.best_error, state.subject.model.unit)}"
