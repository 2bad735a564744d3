"""The captions: what a step did, with its numbers, and whether it is right."""

from typing import Literal

import numpy as np

from lessons.distances.plane import WITHIN
from lessons.distances.state import Ball, Found, Front, Landmarks, Params, Scatter, State, Trials
from workbench.algorithms.surfaces.heat_method import HeatState
from workbench.certain import sure
from workbench.numerals import brief, counted, fixed, length, percent
from workbench.scene import Caption

# mean sizes of the relative error: up to the one it is right, above the other wrong
GOOD = 0.02
BAD = 0.06
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
    result = state.now
    match result:
        case Front():
            return Caption(_of_front(state, result))
        case HeatState():
            return Caption(_of_heat(state, result))
        case Found():
            return _of_found(state, result)
        case Ball():
            return Caption(_of_ball(state.params, result))
        case Trials():
            return _of_trials(result)
        case Scatter():
            return _of_scatter(state.params, result)
        case Landmarks():
            return Caption(_of_landmarks(result))


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


def _of_front(state: State, front: Front) -> str:
    subject = sure(state.subject)
    done = int(front.accepted.sum())
    trial = int((np.isfinite(front.d) & ~front.accepted).sum())
    where = int(subject.free.sum()) if len(subject.free) else len(front.d)
    if front.reach == 0:
        return (
            f"The source has the distance 0; {counted(trial, 'neighbour is', 'neighbours are')} on"
            " trial."
        )
    text = (
        f"Up to {length(front.reach)}: {done:,} of {where:,} nodes are accepted, their distance is"
        " final"
    )
    if trial:
        return f"{text}. {trial:,} are on trial: theirs may still fall."
    if done < where:
        return f"{text}; to the other {where - done:,} no way leads."
    return f"{text}."


def _of_heat(state: State, heat: HeatState) -> str:
    if heat.phase == "flow":
        far = float(np.log10(max(np.median(np.abs(heat.u)) / heat.u.max(), 1e-300)))
        return (
            f"Heat has flowed from the source for {brief(10.0**state.params.time, 2)} squared mean"
            f" edges. Half of the surface has less than 10 to the power of {fixed(far, 0)} of the"
            " strongest: its size says little, its direction all."
        )
    if heat.phase == "directions":
        return (
            f"On each of {len(heat.X):,} faces only the direction is kept, away from the heat, with"
            " length 1: so steep is a distance everywhere."
        )
    top = length(float(heat.d.max()))
    return (
        "The function whose slope is nearest to those directions, by one more linear system: up to"
        f" {top}."
    )


def tone_of(distances: Found) -> Literal["good", "wrong", "info"]:
    """Return whether distances are right: on average to 2 %, and wrong from 6 % on.

    Right distances that are no metric claim nothing.
    """
    known = np.abs(distances.error[np.isfinite(distances.error)])
    if not len(known) or (len(distances.asymmetry) and known.mean() <= GOOD):
        return "info"
    if known.mean() <= GOOD:
        return "good"
    return "wrong" if known.mean() > BAD else "info"


def _of_found(state: State, distances: Found) -> Caption:
    subject, by = sure(state.subject), way_of(state.params)
    reached = int(np.isfinite(distances.d).sum())
    where = int(subject.free.sum()) if len(subject.free) else len(distances.d)
    if not len(distances.truth):
        far = length(float(distances.d[np.isfinite(distances.d)].max()))
        return Caption(
            f"By {by}: the farthest of {reached:,} points that can be reached is {far} away. Nobody"
            " knows the truth here."
        )
    if not np.isfinite(distances.error).any():
        return Caption(
            f"By {by} {reached:,} of {where:,} nodes are reached, none of them far enough to be"
            " compared.",
            "wrong",
        )
    tone = tone_of(distances)
    known = np.abs(distances.error[np.isfinite(distances.error)])
    median = (
        f" (median {percent(float(np.median(known)))})" if way_of(state.params) == "heat" else ""
    )
    text = (
        f"By {by}: {percent(float(known.mean()))} off on average{median}, at worst"
        f" {_too(distances.worst)}"
    )
    if not len(subject.truth):
        text += ", beside ways over many points of the edges"
    if subject.goal >= 0 and np.isfinite(distances.d[subject.goal]):
        text += (
            f"; {length(float(distances.d[subject.goal]))} to the goal, in truth"
            f" {length(float(distances.truth[subject.goal]))}"
        )
    text += "."
    if subject.shortcuts.any():
        text += (
            f" {counted(int(subject.shortcuts.sum()), 'edge leaves', 'edges leave')} the surface."
        )
    if reached < where:
        text += f" {where - reached:,} nodes cannot be reached."
    if len(distances.asymmetry):
        text += (
            f" There and back differ by {percent(float(np.median(distances.asymmetry)))} in the"
            " median and"
        )
        text += (
            f" {percent(distances.asymmetry.max())} at most; {percent(distances.broken)} of the"
            " triples break the triangle"
        )
        text += " inequality."
    else:
        text += _of_weights(distances)
        text += {"good": " Right to 2 %.", "wrong": " That is wrong, also on average.", "info": ""}[
            tone
        ]
        text += _of_eight(distances)
    return Caption(text + _of_study(state, distances), tone)


def _of_weights(distances: Found) -> str:
    """Return what negative weights did, where they did harm."""
    if not distances.below and not (
        tone_of(distances) != "good" and distances.negative > MANY * len(distances.d)
    ):
        return ""
    below = f" {percent(distances.below)} of the distances are below 0." if distances.below else ""
    edges = counted(distances.negative, "edge has", "edges have")
    return f"{below} {edges} a negative weight: the angles opposite are more than 180° together."


def _of_eight(distances: Found) -> str:
    if not np.isfinite(distances.eight):
        return ""
    nearer = "nearer to the truth" if abs(distances.eight) < abs(distances.worst) else "farther off"
    return f" Ways to 8 neighbours are {nearer} on this grid: at worst {_too(distances.eight)}."


def _of_study(state: State, distances: Found) -> str:
    charts = []
    if distances.study:
        on = (
            "from a corner of empty squares, ever finer"
            if state.params.stage == "grid"
            else "on ever finer spheres"
        )
        charts.append(f"the same {on}")
    if distances.times is not None:
        charts.append("the mean error by how long heat flows")
    return f" In the charts: {'; '.join(charts)}." if charts else ""


def _too(error: float) -> str:
    return f"{percent(abs(error))} too {'long' if error > 0 else 'short'}"


def _of_ball(params: Params, ball: Ball) -> str:
    if params.metric in ("p", "p-sum"):
        shape = (
            "a star with its arms along the axes" if params.p < 1 else "a rounded square or disc"
        )
        shape += f", p = {params.p:g}"
    else:
        shape = BALLS[params.metric]
    if params.stretch > 1:
        shape += ", but for the unit of y"
    if not ball.nearest:
        return f"All within {brief(ball.radius)} of the purple point by this distance: {shape}."
    mine = int(np.argmin(ball.d))
    in_metres = ", with both in metres," if params.stretch > 1 else ""
    text = (
        f"The ball touches its first point, {mine}: the nearest by this distance,"
        f" {brief(ball.radius)} away. By Euclid's{in_metres} it is"
        f" {'the same' if mine == ball.straight else f'point {ball.straight}'}."
    )
    return (
        f"{text} Of {len(ball.changed)} other queries {percent(float(ball.changed.mean()))} have"
        " another nearest."
    )


def _of_trials(trials: Trials) -> Caption:
    ab, bc, ac = trials.sides
    text = f"{trials.tried:,} triples tried: {_broken(trials)} the triangle inequality."
    if ac > ab + bc + 1e-9:
        text += f" Here the way from a to c is {brief(ac)}, over b it is {brief(ab + bc)}."
    others = [name for name, share in list(trials.axioms.items())[:3] if share > 0]
    text += f" Also broken: {', '.join(others)}." if others else ""
    if trials.broken or others:
        return Caption(f"{text} No metric.", "wrong")
    return Caption(f"{text} Nothing speaks against a metric.")


def _broken(trials: Trials) -> str:
    return f"{percent(trials.broken / trials.tried)} break" if trials.broken else "none breaks"


def _of_scatter(params: Params, scatter: Scatter) -> Caption:
    n = len(scatter.p)
    out = int(scatter.outlier.sum())
    match scatter.phase:
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
            return _of_flags(scatter)
        case _:
            counts, _ = sure(scatter.shares)
            return Caption(
                f"How many points lie within {WITHIN:g} standard deviations, by dimension: from"
                f" {percent(counts[0], 1)} in one down to {percent(counts[-1], 1)} in ten."
            )


def _of_flags(scatter: Scatter) -> Caption:
    text = (
        f"Beyond {fixed(scatter.limit, 2)} lie"
        f" {percent(float(scatter.flagged[~scatter.outlier].mean()))} of the scatter"
    )
    if not scatter.outlier.any():
        return Caption(
            f"{text}. By chance it should be 5 %. The largest distance is"
            f" {fixed(float(scatter.d.max()), 2)}."
        )
    caught = int((scatter.flagged & scatter.outlier).sum())
    all_ = int(scatter.outlier.sum())
    mean = fixed(float(scatter.d[scatter.outlier].mean()), 2)
    text += f" and {caught:,} of {all_:,} of the second cluster, at {mean} on average."
    if caught >= 0.9 * all_:
        return Caption(f"{text} It is found.", "good")
    return Caption(
        f"{text} It hides itself: the covariance is partly its own.",
        "wrong" if caught < all_ / 2 else "info",
    )


def _of_landmarks(sights: Landmarks) -> str:
    near, told = (
        percent(float((chosen == sights.true).mean()))
        for chosen in (sights.euclid, sights.mahalanobis)
    )
    return (
        f"{len(sights.true):,} measurements, off far more in depth than across. The nearest"
        f" landmark by Euclid's distance is the right one for {near}, by Mahalanobis' for {told}."
    )
