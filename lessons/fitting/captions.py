"""What a step says: what just happened, the number that changed, and in the end whether it is
right.
"""

from collections.abc import Callable
from typing import Any

import numpy as np

from lessons.fitting.fit_studies import AWAY, Basin, Lines, Rivals, Spread
from lessons.fitting.state import State
from workbench.algorithms.least_squares import Descent, Stop, Walked
from workbench.algorithms.robust import Settled, Trusted
from workbench.geometry.shapes.lines_planes import line_angle
from workbench.numerals import angle, area, brief, counted, fixed, length, percent, power_of_ten
from workbench.scene import Caption

AGREE = 1.5  # by which factor a span may differ from repetition
LEAST = 1e-3  # by which share of the least sum of squares an end may lie above it


def caption(state: State) -> Caption:
    """Return the caption of a step."""
    return WRITTEN[type(state.now)](state, state.now)


def radius_of(state: State, unknown: np.ndarray) -> str:
    """Write the radius."""
    r = abs(float(unknown[-1]))
    return length(r * state.subject.scale) if np.isfinite(r) else "no number"


def damping_in_words(damping: float) -> str:
    """Write a damping without an exponent."""
    return brief(damping) if damping >= 1e-4 else power_of_ten(round(np.log10(damping)))


def square(cost: float, scale: float = 1.0) -> str:
    """Write a sum of squares with its unit."""
    return area(cost * scale**2) if np.isfinite(cost) else "no number"


def _walked(state: State, walked: Walked) -> Caption:
    now = walked.now
    cost, scale = square(now.cost, state.subject.scale), state.subject.scale
    if now.stop is not None:
        return _stopped(state, now)
    if now.phase == "start":
        rms = length(scale * float(np.sqrt(now.cost / len(now.residuals))))
        return Caption(
            f"The start: R = {radius_of(state, now.unknown)}. The distances of"
            f" {counted(len(now.residuals), 'point')} have the sum of squares {cost}, {rms} RMS."
        )
    if now.phase == "linearised":
        shape = state.subject.kind.name if state.subject.kind else ""
        return Caption(
            f"Iteration {now.iteration}: the {shape} is replaced by its tangents at the places"
            " nearest to the points. Against them each distance is linear in the"
            f" {now.jacobian.shape[1]} unknowns."
        )
    if now.phase == "tried":
        promise = square(max(now.cost - now.predicted, 0.0), scale)
        gain = f", {percent(now.gain)} of the promised change" if now.gain > 0.0 else ""
        return Caption(
            f"The solution of the linear problem, tried out (dashed). It promised {promise} for"
            f" {cost}; the sum of squares is {square(now.trial_cost, scale)}{gain}."
        )
    if now.phase == "accepted":
        rose = (
            f", up from {square(now.before, scale)}: Gauss-Newton takes every step"
            if now.cost > now.before
            else ""
        )
        damped = f" The damping falls to {damping_in_words(now.damping)}." if now.damping else ""
        return Caption(
            f"Iteration {now.iteration}: the step is kept. R = {radius_of(state, now.unknown)}, sum"
            f" of squares {cost}{rose}.{damped}"
        )
    return Caption(
        f"Iteration {now.iteration}: the step is taken back, for it would raise the sum from {cost}"
        f" to {square(now.trial_cost, scale)}. The damping rises to"
        f" {damping_in_words(now.damping)}: the next one is shorter."
    )


def _stopped(state: State, now: Descent) -> Caption:
    assert now.stop is not None
    scale, least, straight = (
        state.subject.scale,
        state.subject.least_cost,
        state.subject.straight_cost,
    )
    after = counted(now.iteration, "iteration")
    if now.stop in (Stop.SINGULAR, Stop.DIVERGED):
        found = radius_of(state, now.unknown)
        return Caption(
            f"Stop after {after}, with R = {found}: {now.stop.message}. It is wrong.", "wrong"
        )
    rests = (
        "rests at"
        if now.stop is Stop.CONVERGED
        else "is not at rest, and no more are allowed; it is"
    )
    text = (
        f"After {after} the sum of squares {rests} {square(now.cost, scale)}, R ="
        f" {radius_of(state, now.unknown)}"
    )
    is_least = now.cost <= (1.0 + LEAST) * least + 1e-12
    if abs(now.unknown[-1]) > AWAY and now.cost < 1.5 * straight:
        text += (
            f": the best straight line has {square(straight, scale)} as well, and that is what this"
            " circle is."
        )
        if is_least or np.isnan(least):
            return Caption(f"{text} Nothing round fits better.")
        return Caption.verdict(f"{text} A circle of {square(least, scale)} exists.", right=False)
    if np.isnan(least):
        return Caption(f"{text}.")
    if not is_least:
        settled = now.stop is Stop.CONVERGED
        return Caption.verdict(
            f"{text}; the least is {square(least, scale)}.", right=False, settled=settled
        )
    truth = state.subject.truth
    off = (
        ""
        if truth is None
        else f" R is {length(abs(abs(float(now.unknown[-1])) - float(truth[-1])))} off the truth."
    )
    return Caption(f"{text}: the least there is, right.{off}", "good")


def _spread(state: State, now: Spread) -> Caption:
    scale = state.subject.scale
    if not len(now.radii):
        sd = length(now.radius_deviation * scale)
        return Caption(
            f"The covariance s² (JᵀJ)⁻¹ says R = {radius_of(state, now.unknown)} ± {sd}. It takes"
            " the errors as independent and the problem as straight. The errors seem to have s ="
            f" {length(now.sigma * scale)}, the condition number of JᵀJ is {brief(now.condition)}."
        )
    low, high = (length(x * scale) for x in now.predicted)
    found = tuple(length(x * scale) for x in now.repeated)
    how = "measured anew" if state.subject.p_true is not None else "drawn anew from the points"
    text = (
        f"{counted(len(now.radii), 'time')} {how} and fitted again: the middle 90 % of radii reach"
        f" from {found[0]} to {found[1]}. The covariance said {low} to {high}"
    )
    if len(now.radii) < 100:
        return Caption(f"{text}.")
    times, is_possible = now.wider, now.predicted[0] >= 0.0
    agrees = 1 / AGREE <= times <= AGREE
    if agrees and is_possible:
        return Caption(f"{text}: about right.", "good")
    factor = (
        f"narrow by a factor of {brief(times, 2)}"
        if times > 1.0
        else f"wide by a factor of {brief(1 / times, 2)}"
    )
    off = ": about as wide" if agrees else f", too {factor}"
    nonsense = "" if is_possible else ", and no circle has a radius below 0"
    return Caption(f"{text}{off}{nonsense}. It is wrong.", "wrong")


def _basin(state: State, now: Basin) -> Caption:
    if now.now.iteration == 0:
        r = length(state.params.start_radius * state.subject.scale)
        text = f"{len(now.starts)} starts: a grid of centres, all with R = {r}."
        return Caption(f"{text} {state.params.method} goes down from each.")
    share, under_way = now.share("comes home"), now.share("under way")
    after = counted(now.now.iteration, "iteration")
    text = f"After {after} {percent(share)} of the starts are within 1 cm of the best circle"
    if under_way:
        return Caption(f"{text}, {percent(under_way)} are under way.")
    return Caption(f"{text}. The others ended elsewhere." if share < 1.0 else f"{text}: every one.")


def _rivals(state: State, now: Rivals) -> Caption:
    name, circle = list(now.circles.items())[-1]
    coin = state.subject.rim is not None
    if not now.arcs:
        r = (
            fixed(float(abs(circle[2])), 2) + " of the whole rim's"
            if coin
            else radius_of(state, circle)
        )
        known = (
            ""
            if state.subject.truth is None or coin
            else f", the truth is {length(float(state.subject.truth[2]))}"
        )
        what = FITS[name]
        return Caption(f"{what} R = {r}{known}.")
    medians = dict(zip(now.circles, now.medians[-1], strict=True))
    said = ", ".join(f"{name} {fixed(r, 3)}" for name, r in medians.items())
    where = f"{now.draws} {'windows round the coin' if coin else 'draws'}"
    of = "the whole rim's radius" if coin else "the true radius"
    return Caption(
        f"Arcs of {angle(now.arcs[-1])}, {where}: the median R is, as a share of {of}, {said}."
    )


FITS = {
    "Kåsa": (
        "Kåsa's fit, one linear system. It makes |d² − R²| small, about 2 R times the distance, so"
        " a small R pays:"
    ),
    "Pratt": "Pratt's fit makes the same small as a share of R:",
    "Taubin": "Taubin's fit divides it by its mean squared slope at the points:",
    "Hyper": "Hyper divides it such that the bias cancels:",
    "geometric": (
        "The geometric fit makes the distances themselves small, in iterations from Taubin's fit:"
    ),
}


def _lines(state: State, now: Lines) -> Caption:
    slope = angle(state.params.slope)
    if not now.lines:
        return Caption(
            f"{counted(len(state.subject.p), 'point')} of a line at {slope}, with errors in x and"
            " in y. Which distance shall be squared?"
        )
    if now.angles:
        means = ", ".join(f"{name} {angle(float(np.median(a)))}" for name, a in now.angles.items())
        return Caption(
            f"{len(now.angles['upright'])} times measured anew, median angles: {means}. The truth"
            f" is {slope}."
        )
    name, line = list(now.lines.items())[-1]
    found = angle(float(np.degrees(line_angle(line))))
    why = {
        "upright": "regression of y on x, which takes x as exact",
        "level": "regression of x on y, which takes y as exact",
        "perpendicular": "the same however the axes are turned",
    }[name]
    return Caption(f"Least squares of the {name} distances, {why}: {found}. The truth is {slope}.")


def _trusted(state: State, now: Trusted) -> Caption:
    fit, (error, squares_error) = now.now, state.plane_errors
    off = "" if np.isnan(error) else f" RMS error to the truth {length(error)}"
    if fit.iteration == 0:
        text = f"Least squares: all {len(fit.weights)} points pull in proportion to their distance."
    elif now.loss.name == "squares":
        text = "All points weigh 1 again: the plane stays, and there is nothing to repeat."
    else:
        text = (
            f"{now.loss.name}, round {fit.iteration}:"
            f" {counted(int(np.count_nonzero(fit.weights < 0.5)), 'point')} of {len(fit.weights)}"
            f" weigh less than half, by a corner of {length(now.corner * state.subject.scale)}."
        )
    if not now.last or not off:
        return Caption(f"{text}{off}." if off else text)
    text = f"{text}{off}, of least squares {length(squares_error)}."
    return Caption.verdict(text, right=state.plane_is_right, settled=fit.stop is Settled.CONVERGED)


WRITTEN: dict[type, Callable[[State, Any], Caption]] = {
    Walked: _walked,
    Spread: _spread,
    Basin: _basin,
    Rivals: _rivals,
    Lines: _lines,
    Trusted: _trusted,
}
