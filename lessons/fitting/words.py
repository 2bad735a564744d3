"""What a step says: what just happened, the number that changed, and in the end whether it is right."""

import numpy as np

from lessons.fitting.state import State, Trusted, Walked
from workbench.algorithms.fit_studies import Basin, Lines, Rivals, Spread
from workbench.algorithms.least_squares import Descent, Stop
from workbench.algorithms.robust import Settled
from workbench.geometry.lines_planes import line_angle
from workbench.numerals import angle, brief, counted, fixed, length, percent
from workbench.scene import Caption

NINETY = 1.645  # standard deviations to each side that hold 90 % of normal errors
AGREE = 1.5  # by which factor a span may differ from repetition
LEAST = 1e-3  # by which share of the least sum of squares an end may lie above it
HOME = 1e-2  # metres from the best fit
FAR = 50.0  # metres of radius from which a circle is called straight


def caption(state: State) -> Caption:
    """Return the caption of a step."""
    match state.now:
        case Walked(now):
            return _walked(state, now)
        case Spread() as now:
            return _spread(state, now)
        case Basin() as now:
            return _basin(state, now)
        case Rivals() as now:
            return _rivals(state, now)
        case Lines() as now:
            return _lines(state, now)
        case Trusted() as now:
            return _trusted(state, now)


def square(cost: float, scale: float = 1.0) -> str:
    """Write a sum of squares with its unit."""
    if not np.isfinite(cost):
        return "no number"
    return f"{brief(cost * scale**2)} m²" if cost * scale**2 >= 1e-3 else f"{brief(1e6 * cost * scale**2)} mm²"


def radius_of(state: State, unknown: np.ndarray) -> str:
    """Write the radius."""
    r = abs(float(unknown[-1]))
    return length(r * state.subject.scale) if np.isfinite(r) else "no number"


def damping_in_words(damping: float) -> str:
    """Write a damping without an exponent."""
    return brief(damping) if damping >= 1e-4 else f"10{'⁻'}{_raised(round(-np.log10(damping)))}"


def _raised(n: int) -> str:
    return str(n).translate(str.maketrans("0123456789", "⁰¹²³⁴⁵⁶⁷⁸⁹"))


def _walked(state: State, now: Descent) -> Caption:
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
            f"Iteration {now.iteration}: the {shape} is replaced by its tangents at the places nearest to the"
            f" points. Against them each distance is linear in the {now.jacobian.shape[1]} unknowns."
        )
    if now.phase == "tried":
        promise = square(max(now.cost - now.predicted, 0.0), scale)
        return Caption(
            f"The solution of the linear problem, tried out (dashed). It promised {promise} for {cost}; the sum of"
            f" squares is {square(now.trial_cost, scale)}{_gain(now)}."
        )
    if now.phase == "accepted":
        rose = f", up from {square(now.before, scale)}: Gauss-Newton takes every step" if now.cost > now.before else ""
        damped = f" The damping falls to {damping_in_words(now.damping)}." if now.damping else ""
        return Caption(
            f"Iteration {now.iteration}: the step is kept. R = {radius_of(state, now.unknown)}, sum of squares"
            f" {cost}{rose}.{damped}"
        )
    return Caption(
        f"Iteration {now.iteration}: the step is taken back, for it would raise the sum from {cost} to"
        f" {square(now.trial_cost, scale)}. The damping rises to {damping_in_words(now.damping)}: the next one is"
        " shorter."
    )


def _gain(now: Descent) -> str:
    return f", {percent(now.gain)} of the promised change" if now.gain > 0.0 else ""


def straight_cost(state: State) -> float:
    """Return the sum of squares of the best straight line through points in the plane; NaN where there is none."""
    line = state.subject.straight
    return np.nan if line is None else float(np.square(state.subject.p @ line[:-1] + line[-1]).sum())


def off_best(state: State, unknown: np.ndarray) -> float:
    """Return how far the numbers of a fit are from those with the least squares, metres; NaN where these are not known."""
    best = state.subject.best
    return np.nan if best is None else float(np.abs(unknown - best).max())


def least_cost(state: State) -> float:
    """Return the least sum of squares; NaN where nobody knows it."""
    subject = state.subject
    if subject.best is None or subject.kind is None:
        return np.nan
    return float(np.square(subject.kind.linearise(subject.best, subject.p)[0]).sum())


def _stopped(state: State, now: Descent) -> Caption:
    assert now.stop is not None
    scale, least, straight = state.subject.scale, least_cost(state), straight_cost(state)
    after = counted(now.iteration, "iteration")
    if now.stop in (Stop.SINGULAR, Stop.DIVERGED):
        return Caption(f"Stop after {after}: {now.stop.message}. It is wrong.", "wrong")
    rests = "rests at" if now.stop is Stop.CONVERGED else "is, with no more iterations allowed,"
    text = f"After {after} the sum of squares {rests} {square(now.cost, scale)}, R = {radius_of(state, now.unknown)}"
    is_least = now.cost <= (1.0 + LEAST) * least + 1e-12
    if abs(now.unknown[-1]) > FAR and now.cost < 1.5 * straight:
        text += f": the best straight line has {square(straight, scale)} as well, and that is what this circle is."
        if is_least or np.isnan(least):
            return Caption(f"{text} Nothing round fits better.")
        return Caption.verdict(f"{text} A circle of {square(least, scale)} exists.", right=False)
    if np.isnan(least):
        return Caption(f"{text}.")
    if not is_least:
        settled = now.stop is Stop.CONVERGED
        return Caption.verdict(f"{text}; the least is {square(least, scale)}.", right=False, settled=settled)
    truth = state.subject.truth
    off = "" if truth is None else f" R is {length(abs(abs(float(now.unknown[-1])) - float(truth[-1])))} off the truth."
    return Caption(f"{text}: the least there is, right.{off}", "good")


def predicted_span(now: Spread) -> tuple[float, float]:
    """Return where the middle 90 % of radii should lie by the covariance, metres."""
    sd = float(np.sqrt(now.covariance[-1, -1]))
    return abs(float(now.unknown[-1])) - NINETY * sd, abs(float(now.unknown[-1])) + NINETY * sd


def repeated_span(now: Spread) -> tuple[float, float]:
    """Return where the middle 90 % of radii do lie in repetition, metres."""
    low, high = np.percentile(now.radii, [5.0, 95.0])
    return float(low), float(high)


def _spread(state: State, now: Spread) -> Caption:
    scale = state.subject.scale
    sd = float(np.sqrt(now.covariance[-1, -1])) * scale
    if not len(now.radii):
        return Caption(
            f"The covariance s² (JᵀJ)⁻¹ says R = {radius_of(state, now.unknown)} ± {length(sd)}. It takes the errors"
            f" as independent and the problem as straight. The errors seem to have s = {length(now.sigma * scale)},"
            f" the condition number of JᵀJ is {brief(now.condition)}."
        )
    low, high = (length(x * scale, 4) for x in predicted_span(now))
    found = tuple(length(x * scale, 4) for x in repeated_span(now))
    how = "measured anew" if state.subject.p_true is not None else "drawn anew from the points"
    text = (
        f"{counted(len(now.radii), 'time')} {how} and fitted again: the middle 90 % of radii reach from {found[0]} to"
        f" {found[1]}. The covariance said {low} to {high}"
    )
    if len(now.radii) < 100:
        return Caption(f"{text}.")
    times = wider(now)
    if 1 / AGREE <= times <= AGREE:
        return Caption(f"{text}: about right.", "good")
    off = (
        f"too narrow by a factor of {brief(times, 2)}"
        if times > 1.0
        else f"too wide by a factor of {brief(1 / times, 2)}"
    )
    return Caption(f"{text}, {off}. It is wrong.", "wrong")


def wider(now: Spread) -> float:
    """Return how many times as wide as predicted the middle 90 % of radii lie."""
    (a, b), (c, d) = repeated_span(now), predicted_span(now)
    return (b - a) / (d - c)


def fate_of(now: Basin) -> np.ndarray:
    """Return for each start whether it came home (0), is done or lost elsewhere (1), or is still under way (2)."""
    unknowns = now.now.unknowns * [1.0, 1.0, 1.0]
    unknowns[:, 2] = np.abs(unknowns[:, 2])
    home = (np.abs(unknowns - now.best * np.array([1.0, 1.0, np.sign(now.best[2])])) < HOME).all(axis=1)
    return np.where(home, 0, np.where(now.now.done | (unknowns[:, 2] > FAR), 1, 2))


def _basin(state: State, now: Basin) -> Caption:
    fates, n = fate_of(now), len(now.starts)
    if now.now.iteration == 0:
        return Caption(
            f"{n} starts: a grid of centres, all with R = {length(state.params.start_radius * state.subject.scale)}."
            f" {state.params.method} goes down from each."
        )
    share = float((fates == 0).mean())
    after = counted(now.now.iteration, "iteration")
    text = f"After {after} {percent(share)} of the starts are within 1 cm of the best circle"
    if (fates == 2).any():
        return Caption(f"{text}, {percent(float((fates == 2).mean()))} are under way.")
    return Caption(f"{text}. The others ended elsewhere." if share < 1.0 else f"{text}: every one.")


def _rivals(state: State, now: Rivals) -> Caption:
    name, circle = list(now.circles.items())[-1]
    coin = state.subject.photograph is not None
    if not now.arcs:
        r = fixed(float(abs(circle[2])), 2) + " of the whole rim's" if coin else radius_of(state, circle)
        known = "" if state.subject.truth is None or coin else f", the truth is {length(float(state.subject.truth[2]))}"
        what = FITS[name]
        return Caption(f"{what} R = {r}{known}.")
    medians = dict(zip(now.circles, now.medians[-1], strict=True))
    said = ", ".join(f"{name} {fixed(r, 3)}" for name, r in medians.items())
    where = f"{now.draws} {'windows round the coin' if coin else 'draws'}"
    of = "the whole rim's radius" if coin else "the true radius"
    return Caption(f"Arcs of {angle(now.arcs[-1])}, {where}: the median R is, as a share of {of}, {said}.")


FITS = {
    "Kåsa": "Kåsa's fit, one linear system. It makes |d² − R²| small, about 2 R times the distance, so a small R pays:",
    "Pratt": "Pratt's fit makes the same small as a share of R:",
    "Taubin": "Taubin's fit divides it by its mean squared slope at the points:",
    "Hyper": "Hyper divides it such that the bias cancels:",
    "geometric": "The geometric fit makes the distances themselves small, in iterations from Taubin's fit:",
}


def _lines(state: State, now: Lines) -> Caption:
    slope = angle(state.params.slope)
    if not now.lines:
        return Caption(
            f"{counted(len(state.subject.p), 'point')} of a line at {slope}, with errors in x and in y. Which"
            " distance shall be squared?"
        )
    if now.angles:
        means = ", ".join(f"{name} {angle(float(np.median(a)))}" for name, a in now.angles.items())
        return Caption(
            f"{len(now.angles['upright'])} times measured anew, median angles: {means}. The truth is {slope}."
        )
    name, line = list(now.lines.items())[-1]
    found = angle(float(np.degrees(line_angle(line))))
    why = {
        "upright": "regression of y on x, which takes x as exact",
        "level": "regression of x on y, which takes y as exact",
        "perpendicular": "the same however the axes are turned",
    }[name]
    return Caption(f"Least squares of the {name} distances, {why}: {found}. The truth is {slope}.")


def is_right(state: State, now: Trusted) -> bool:
    """Tell whether the plane is nearer to the true one than the noise allows single points to be."""
    return bool(now.error < max(state.params.noise, 0.005))


def _trusted(state: State, now: Trusted) -> Caption:
    fit, scale = now.now, state.subject.scale
    off = "" if np.isnan(now.error) else f" RMS error to the truth {length(now.error)}"
    cut = int(np.count_nonzero(fit.weights < 0.5))
    if fit.iteration == 0:
        return Caption(
            f"Least squares: all {len(fit.weights)} points pull in proportion to their distance.{off}{'.' * bool(off)}"
        )
    text = (
        f"{now.loss}, round {fit.iteration}: {counted(cut, 'point')} of {len(fit.weights)} weigh less than half, by"
        f" a corner of {length(now.corner * scale)}."
    )
    if now.loss == "squares":
        text = "All points weigh 1 again: the plane stays, and there is nothing to repeat."
    if off and not now.last:
        text += f"{off}."
    if not now.last or not off:
        return Caption(text)
    return Caption.verdict(f"{text}{off}, of least squares {length(now.squares_error)}.", right=is_right(state, now),
                           settled=fit.stop is Settled.CONVERGED)  # fmt: skip
