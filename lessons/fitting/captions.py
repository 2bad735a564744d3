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
    descent = walked.now
    cost = square(descent.cost, state.subject.scale)
    scale = state.subject.scale
    if descent.stop is not None:
        return _stopped(state, descent)
    if descent.phase == "start":
        rms = length(scale * float(np.sqrt(descent.cost / len(descent.residuals))))
        return Caption(
            f"The start: R = {radius_of(state, descent.unknown)}. The distances of"
            f" {counted(len(descent.residuals), 'point')} have the sum of squares {cost}, {rms}"
            " RMS."
        )
    if descent.phase == "linearised":
        shape = state.subject.kind.name if state.subject.kind else ""
        return Caption(
            f"Iteration {descent.iteration}: the {shape} is replaced by its tangents at the places"
            " nearest to the points. Against them each distance is linear in the"
            f" {descent.jacobian.shape[1]} unknowns."
        )
    if descent.phase == "tried":
        promise = square(max(descent.cost - descent.predicted, 0.0), scale)
        gain = f", {percent(descent.gain)} of the promised change" if descent.gain > 0.0 else ""
        return Caption(
            f"The solution of the linear problem, tried out (dashed). It promised {promise} for"
            f" {cost}; the sum of squares is {square(descent.trial_cost, scale)}{gain}."
        )
    if descent.phase == "accepted":
        rose = (
            f", up from {square(descent.before, scale)}: Gauss-Newton takes every step"
            if descent.cost > descent.before
            else ""
        )
        damped = (
            f" The damping falls to {damping_in_words(descent.damping)}." if descent.damping else ""
        )
        return Caption(
            f"Iteration {descent.iteration}: the step is kept. R ="
            f" {radius_of(state, descent.unknown)}, sum of squares {cost}{rose}.{damped}"
        )
    return Caption(
        f"Iteration {descent.iteration}: the step is taken back, for it would raise the sum"
        f" from {cost} to {square(descent.trial_cost, scale)}. The damping rises to"
        f" {damping_in_words(descent.damping)}: the next one is shorter."
    )


def _stopped(state: State, descent: Descent) -> Caption:
    assert descent.stop is not None
    scale = state.subject.scale
    least = state.subject.least_cost
    straight = state.subject.straight_cost
    after = counted(descent.iteration, "iteration")
    if descent.stop in (Stop.SINGULAR, Stop.DIVERGED):
        radius = radius_of(state, descent.unknown)
        return Caption(
            f"Stop after {after}, with R = {radius}: {descent.stop.message}. It is wrong.", "wrong"
        )
    rests = (
        "rests at"
        if descent.stop is Stop.CONVERGED
        else "is not at rest, and no more are allowed; it is"
    )
    text = (
        f"After {after} the sum of squares {rests} {square(descent.cost, scale)}, R ="
        f" {radius_of(state, descent.unknown)}"
    )
    is_least = descent.cost <= (1.0 + LEAST) * least + 1e-12
    if abs(descent.unknown[-1]) > AWAY and descent.cost < 1.5 * straight:
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
        settled = descent.stop is Stop.CONVERGED
        return Caption.verdict(
            f"{text}; the least is {square(least, scale)}.", right=False, settled=settled
        )
    truth = state.subject.truth
    off = (
        ""
        if truth is None
        else f" R is {length(abs(abs(float(descent.unknown[-1])) - float(truth[-1])))} off the"
        " truth."
    )
    return Caption(f"{text}: the least there is, right.{off}", "good")


def _spread(state: State, spread: Spread) -> Caption:
    scale = state.subject.scale
    if not len(spread.radii):
        sd = length(spread.radius_deviation * scale)
        return Caption(
            f"The covariance s² (JᵀJ)⁻¹ says R = {radius_of(state, spread.unknown)} ± {sd}. It"
            " takes the errors as independent and the problem as straight. The errors seem to have"
            f" s = {length(spread.sigma * scale)}, the condition number of JᵀJ is"
            f" {brief(spread.condition)}."
        )
    low, high = (length(x * scale) for x in spread.predicted)
    repeated = tuple(length(x * scale) for x in spread.repeated)
    how = "measured anew" if state.subject.p_true is not None else "drawn anew from the points"
    text = (
        f"{counted(len(spread.radii), 'time')} {how} and fitted again: the middle 90 % of radii"
        f" reach from {repeated[0]} to {repeated[1]}. The covariance said {low} to {high}"
    )
    if len(spread.radii) < 100:
        return Caption(f"{text}.")
    times = spread.wider
    is_possible = spread.predicted[0] >= 0.0
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


def _basin(state: State, basin: Basin) -> Caption:
    if basin.now.iteration == 0:
        r = length(state.params.start_radius * state.subject.scale)
        text = f"{len(basin.starts)} starts: a grid of centres, all with R = {r}."
        return Caption(f"{text} {state.params.method} goes down from each.")
    share, under_way = basin.share("comes home"), basin.share("under way")
    after = counted(basin.now.iteration, "iteration")
    text = f"After {after} {percent(share)} of the starts are within 1 cm of the best circle"
    if under_way:
        return Caption(f"{text}, {percent(under_way)} are under way.")
    return Caption(f"{text}. The others ended elsewhere." if share < 1.0 else f"{text}: every one.")


def _rivals(state: State, rivals: Rivals) -> Caption:
    name, circle = list(rivals.circles.items())[-1]
    coin = state.subject.rim is not None
    if not rivals.arcs:
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
        fit = FITS[name]
        return Caption(f"{fit} R = {r}{known}.")
    medians = dict(zip(rivals.circles, rivals.medians[-1], strict=True))
    shares = ", ".join(f"{name} {fixed(r, 3)}" for name, r in medians.items())
    where = f"{rivals.draws} {'windows round the coin' if coin else 'draws'}"
    of = "the whole rim's radius" if coin else "the true radius"
    return Caption(
        f"Arcs of {angle(rivals.arcs[-1])}, {where}: the median R is, as a share of {of}, {shares}."
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


def _lines(state: State, fits: Lines) -> Caption:
    slope = angle(state.params.slope)
    if not fits.lines:
        return Caption(
            f"{counted(len(state.subject.p), 'point')} of a line at {slope}, with errors in x and"
            " in y. Which distance shall be squared?"
        )
    if fits.angles:
        means = ", ".join(f"{name} {angle(float(np.median(a)))}" for name, a in fits.angles.items())
        return Caption(
            f"{len(fits.angles['upright'])} times measured anew, median angles: {means}. The truth"
            f" is {slope}."
        )
    name, line = list(fits.lines.items())[-1]
    tilt = angle(float(np.degrees(line_angle(line))))
    why = {
        "upright": "regression of y on x, which takes x as exact",
        "level": "regression of x on y, which takes y as exact",
        "perpendicular": "the same however the axes are turned",
    }[name]
    return Caption(f"Least squares of the {name} distances, {why}: {tilt}. The truth is {slope}.")


def _trusted(state: State, trusted: Trusted) -> Caption:
    fit, (error, squares_error) = trusted.now, state.plane_errors
    off = "" if np.isnan(error) else f" RMS error to the truth {length(error)}"
    if fit.iteration == 0:
        text = f"Least squares: all {len(fit.weights)} points pull in proportion to their distance."
    elif trusted.loss.name == "squares":
        text = "All points weigh 1 again: the plane stays, and there is nothing to repeat."
    else:
        text = (
            f"{trusted.loss.name}, round {fit.iteration}:"
            f" {counted(int(np.count_nonzero(fit.weights < 0.5)), 'point')} of {len(fit.weights)}"
            f" weigh less than half, by a corner of {length(trusted.corner * state.subject.scale)}."
        )
    if not trusted.last or not off:
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
