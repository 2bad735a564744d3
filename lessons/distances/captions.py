"""The captions: what a step did, with its numbers, and whether it is right."""

from typing import Literal

import numpy as np

from lessons.distances.plane import WITHIN
from lessons.distances.state import Ball, Found, Front, Landmarks, Params, Scatter, State, Trials
from workbench.algorithms.surfaces.heat_method import HeatState
from workbench.certain import sure
from workbench.numerals import brief, counted, fixed, length, percent
from workbench.scene import Caption

GOOD, BAD = (
    0.02,
    0.06,
)  # mean sizes of the relative error: up to the one it is right, above the other wrong
# edges of negative weight per vertex, a tenth of all edges: from there on they are named as a cause
MANY = 0.3
BALLS = {
    "euclid": "a disc",
    "manhattan": "a square on its corner",
    "chebyshev": "a square",
    "squared": "a disc as well, and only its radius is another number",
    "cosine": "a wedge that begins at the origin: length does not count",
    "mahalanobis": "an ellipse along the correlation",
}


def caption(state: State) -> Caption:
    """Return what happened in this step and why."""
    now = state.now
    match now:
        case Front():
            return Caption(_of_front(state, now))
        case HeatState():
            return Caption(_of_heat(state, now))
        case Found():
            return _of_found(state, now)
        case Ball():
            return Caption(_of_ball(state.params, now))
        case Trials():
            return _of_trials(now)
        case Scatter():
            return _of_scatter(state.params, now)
        case Landmarks():
            return Caption(_of_landmarks(now))


def way_of(params: Params) -> str:
    """Return what distances are computed by."""
    if params.stage == "grid":
        return (
            "fast marching" if params.neighbours == "march" else f"{params.neighbours} neighbours"
        )
    if params.stage == "roll":
        return f"{params.k} neighbours each"
    if params.method == "heat":
        return "heat"
    return "the edges" if not params.extra else f"{counted(params.extra, 'point')} on every edge"


def _of_front(state: State, now: Front) -> str:
    subject = sure(state.subject)
    done, trial = int(now.accepted.sum()), int((np.isfinite(now.d) & ~now.accepted).sum())
    where = int(subject.free.sum()) if len(subject.free) else len(now.d)
    if now.reach == 0:
        return (
            f"The source has the distance 0; {counted(trial, 'neighbour is', 'neighbours are')} on"
            " trial."
        )
    text = (
        f"Up to {length(now.reach)}: {done:,} of {where:,} nodes are accepted, their distance is"
        " final"
    )
    if trial:
        return f"{text}. {trial:,} are on trial: theirs may still fall."
    if done < where:
        return f"{text}; to the other {where - done:,} no way leads."
    return f"{text}."


def _of_heat(state: State, now: HeatState) -> str:
    if now.phase == "flow":
        far = float(np.log10(max(np.median(np.abs(now.u)) / now.u.max(), 1e-300)))
        return (
            f"Heat has flowed from the source for {brief(10.0**state.params.time, 2)} squared mean"
            f" edges. Half of the surface has less than 10 to the power of {fixed(far, 0)} of the"
            " strongest: its size says little, its direction all."
        )
    if now.phase == "directions":
        return (
            f"On each of {len(now.X):,} faces only the direction is kept, away from the heat, with"
            " length 1: so steep is a distance everywhere."
        )
    top = length(float(now.d.max()))
    return (
        "The function whose slope is nearest to those directions, by one more linear system: up to"
        f" {top}."
    )


def tone_of(now: Found) -> Literal["good", "wrong", "info"]:
    """Return whether distances are right: on average to 2 %, and wrong from 6 % on.

    Right distances that are no metric claim nothing.
    """
    known = np.abs(now.error[np.isfinite(now.error)])
    if not len(known) or (len(now.asymmetry) and known.mean() <= GOOD):
        return "info"
    return "good" if known.mean() <= GOOD else "wrong" if known.mean() > BAD else "info"


def _of_found(state: State, now: Found) -> Caption:
    subject, by = sure(state.subject), way_of(state.params)
    reached = int(np.isfinite(now.d).sum())
    where = int(subject.free.sum()) if len(subject.free) else len(now.d)
    if not len(now.truth):
        far = length(float(now.d[np.isfinite(now.d)].max()))
        return Caption(
            f"By {by}: the farthest of {reached:,} points that can be reached is {far} away. Nobody"
            " knows the truth here."
        )
    if not np.isfinite(now.error).any():
        return Caption(
            f"By {by} {reached:,} of {where:,} nodes are reached, none of them far enough to be"
            " compared.",
            "wrong",
        )
    tone = tone_of(now)
    known = np.abs(now.error[np.isfinite(now.error)])
    median = (
        f" (median {percent(float(np.median(known)))})" if way_of(state.params) == "heat" else ""
    )
    text = (
        f"By {by}: {percent(float(known.mean()))} off on average{median}, at worst"
        f" {_too(now.worst)}"
    )
    if not len(subject.truth):
        text += ", beside ways over many points of the edges"
    if subject.goal >= 0 and np.isfinite(now.d[subject.goal]):
        text += (
            f"; {length(float(now.d[subject.goal]))} to the goal, in truth"
            f" {length(float(now.truth[subject.goal]))}"
        )
    text += "."
    if subject.shortcuts.any():
        text += (
            f" {counted(int(subject.shortcuts.sum()), 'edge leaves', 'edges leave')} the surface."
        )
    if reached < where:
        text += f" {where - reached:,} nodes cannot be reached."
    if len(now.asymmetry):
        text += (
            f" There and back differ by {percent(float(np.median(now.asymmetry)))} in the"
            " median and"
        )
        text += (
            f" {percent(now.asymmetry.max())} at most; {percent(now.broken)} of the triples break"
            " the triangle"
        )
        text += " inequality."
    else:
        text += _of_weights(now)
        text += {"good": " Right to 2 %.", "wrong": " That is wrong, also on average.", "info": ""}[
            tone
        ]
        text += _of_eight(now)
    return Caption(text + _of_study(state, now), tone)


def _of_weights(now: Found) -> str:
    """Return what negative weights did, where they did harm."""
    if not now.below and not (tone_of(now) != "good" and now.negative > MANY * len(now.d)):
        return ""
    below = f" {percent(now.below)} of the distances are below 0." if now.below else ""
    edges = counted(now.negative, "edge has", "edges have")
    return f"{below} {edges} a negative weight: the angles opposite are more than 180° together."


def _of_eight(now: Found) -> str:
    if not np.isfinite(now.eight):
        return ""
    nearer = "nearer to the truth" if abs(now.eight) < abs(now.worst) else "farther off"
    return f" Ways to 8 neighbours are {nearer} on this grid: at worst {_too(now.eight)}."


def _of_study(state: State, now: Found) -> str:
    charts = []
    if now.study:
        on = (
            "from a corner of empty squares, ever finer"
            if state.params.stage == "grid"
            else "on ever finer spheres"
        )
        charts.append(f"the same {on}")
    if now.times is not None:
        charts.append("the mean error by how long heat flows")
    return f" In the charts: {'; '.join(charts)}." if charts else ""


def _too(error: float) -> str:
    return f"{percent(abs(error))} too {'long' if error > 0 else 'short'}"


def _of_ball(params: Params, now: Ball) -> str:
    if params.metric in ("p", "p-sum"):
        shape = (
            "a star with its arms along the axes" if params.p < 1 else "a rounded square or disc"
        )
        shape += f", p = {params.p:g}"
    else:
        shape = BALLS[params.metric]
    if params.stretch > 1:
        shape += ", but for the unit of y"
    if not now.nearest:
        return f"All within {brief(now.radius)} of the purple point by this distance: {shape}."
    mine = int(np.argmin(now.d))
    in_metres = ", with both in metres," if params.stretch > 1 else ""
    text = (
        f"The ball touches its first point, {mine}: the nearest by this distance,"
        f" {brief(now.radius)} away. By Euclid's{in_metres} it is"
        f" {'the same' if mine == now.straight else f'point {now.straight}'}."
    )
    return (
        f"{text} Of {len(now.changed)} other queries {percent(float(now.changed.mean()))} have"
        " another nearest."
    )


def _of_trials(now: Trials) -> Caption:
    ab, bc, ac = now.sides
    text = f"{now.tried:,} triples tried: {_broken(now)} the triangle inequality."
    if ac > ab + bc + 1e-9:
        text += f" Here the way from a to c is {brief(ac)}, over b it is {brief(ab + bc)}."
    others = [name for name, share in list(now.axioms.items())[:3] if share > 0]
    text += f" Also broken: {', '.join(others)}." if others else ""
    if now.broken or others:
        return Caption(f"{text} No metric.", "wrong")
    return Caption(f"{text} Nothing speaks against a metric.")


def _broken(now: Trials) -> str:
    return f"{percent(now.broken / now.tried)} break" if now.broken else "none breaks"


def _of_scatter(params: Params, now: Scatter) -> Caption:
    n, out = len(now.p), int(now.outlier.sum())
    match now.phase:
        case "points":
            second = f" and a second cluster of {out}" if out else ""
            whose = "of all points" if params.estimate == "sample" else "of the closest half"
            return Caption(
                f"{n - out:,} points of a correlated scatter{second}. The ellipse should hold 95 %:"
                f" it is made of the covariance {whose}."
            )
        case "centred":
            return Caption("The mean is taken to the origin: distances are from there.")
        case "turned":
            return Caption(
                "Turned to the ellipse's own axes, coordinates are no longer correlated."
            )
        case "scaled":
            return Caption(
                "Each axis over its standard deviation: the ellipse is a circle, Mahalanobis'"
                " distance Euclid's."
            )
        case "told":
            return _of_flags(now)
        case _:
            counts, _ = sure(now.shares)
            return Caption(
                f"How many points lie within {WITHIN:g} standard deviations, by dimension: from"
                f" {percent(counts[0], 1)} in one down to {percent(counts[-1], 1)} in ten."
            )


def _of_flags(now: Scatter) -> Caption:
    text = (
        f"Beyond {fixed(now.limit, 2)} lie {percent(float(now.flagged[~now.outlier].mean()))} of"
        " the scatter"
    )
    if not now.outlier.any():
        return Caption(
            f"{text}. By chance it should be 5 %. The largest distance is"
            f" {fixed(float(now.d.max()), 2)}."
        )
    caught, all_ = int((now.flagged & now.outlier).sum()), int(now.outlier.sum())
    mean = fixed(float(now.d[now.outlier].mean()), 2)
    text += f" and {caught:,} of {all_:,} of the second cluster, at {mean} on average."
    if caught >= 0.9 * all_:
        return Caption(f"{text} It is found.", "good")
    return Caption(
        f"{text} It hides itself: the covariance is partly its own.",
        "wrong" if caught < all_ / 2 else "info",
    )


def _of_landmarks(now: Landmarks) -> str:
    near, told = (
        percent(float((chosen == now.true).mean())) for chosen in (now.euclid, now.mahalanobis)
    )
    return (
        f"{len(now.true):,} measurements, off far more in depth than across. The nearest landmark"
        f" by Euclid's distance is the right one for {near}, by Mahalanobis' for {told}."
    )
