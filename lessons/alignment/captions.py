"""What a step says: what just happened, its numbers, and at the end whether the second scan has
come home.
"""

import numpy as np

from lessons.alignment.state import HOME_DEGREES, Params, State
from workbench.certain import sure
from workbench.numerals import angle, brief, fixed, length, percent
from workbench.scene import Caption

PARTS = (
    (1e-4, 1e2, " %"),
    (1e-7, 1e6, " millionths"),
    (1e-10, 1e9, " billionths"),
    (1e-12, 1e12, " trillionths"),
)
RULES = {
    "none": "Signs stay as the rotations happened to leave them.",
    "largest-entry": (
        "Axes 1 and 2 are turned so that their largest entry is positive; axis 3 is their cross"
        " product."
    ),
    "third-moment": (
        "Axes 1 and 2 point to where their third moment is positive; axis 3 is their cross product."
    ),
}


def caption(state: State) -> Caption:
    """Return the caption of a step."""
    now, moment = state.jacobi, state.moment
    if moment == "cloud" or now is None:
        return Caption(_of_cloud(state) if moment == "cloud" else _of_centroid(state))
    if moment == "covariance":
        return Caption(
            "The covariance as an ellipsoid, two standard deviations large. In the axes x, y, z of"
            f" the scan, the norm of its entries off the diagonal is {part(now.off)} of the norm of"
            " all."
        )
    if moment == "rotation":
        return Caption(_of_rotation(state))
    if moment == "order" and state.variances is not None:
        sizes = [length(float(np.sqrt(max(value, 0.0)))) for value in state.variances]
        return Caption(
            f"In the order of variance: standard deviations {sizes[0]}, {sizes[1]} and {sizes[2]}."
            " So far an axis is a line; no variance says which end is its tip."
        )
    if moment == "signs":
        return Caption(f"{RULES[state.params.signs]} {_skewness(state)}")
    return _of_turns(state) if state.turns is not None else _of_pose(state)


def _of_cloud(state: State) -> str:
    scans, params = state.scans, state.params
    n, m = len(scans.p_target), len(scans.p_source)
    counts = f"{n:,} points each" if n == m else f"{n:,} and {m:,} points"
    if scans.own:
        return (
            f"Two scans of your own, {counts}, one metre long here. Which turn takes the second to"
            f" the first?{_idle(params)}"
        )
    what = params.source.name if params.source is not None else f"one {params.shape}"
    return (
        f"Two scans of {what}, {counts}; the second is turned by {angle(params.turn)}. No point"
        f" knows its partner: which turn takes it back?{_idle(params)}"
    )


def _idle(params: Params) -> str:
    idle = [name.replace("_", " ") for name in params.idle]
    if not idle:
        return ""
    return (
        f" Your own clouds are open: {', '.join(idle)} {'has' if len(idle) == 1 else 'have'} no"
        " effect."
    )


def _of_centroid(state: State) -> str:
    x, y, z = (fixed(100 * value, 1) for value in state.p_centre)
    return (
        f"The centroid, the mean of the points, at ({x}, {y}, {z}) cm: it moves with its scan and"
        " settles the shift."
    )


def _of_rotation(state: State) -> str:
    now, before = sure(state.jacobi), sure(state.before)
    i, j = ("xyz"[k] for k in sure(now.plane))
    was = np.linalg.norm(before - np.diag(np.diag(before))) / np.linalg.norm(before)
    return (
        f"Rotation {state.rotations}: the frame turns by {angle(abs(np.degrees(now.angle)))} in its"
        f" {i}-{j} plane, to where variance is largest and least. Off the diagonal, as a share of"
        f" the norm: {part(float(was))} → {part(now.off)}."
    )


def part(share: float) -> str:
    """Write a share of what is off the diagonal, in per cent or in parts that suit it."""
    for least, factor, unit in PARTS:
        if share >= least:
            return f"{brief(factor * share, 2)}{unit}"
    return "nothing but rounding"


def _skewness(state: State) -> str:
    over = sure(state.moments) / np.maximum(sure(state.variances), 1e-12) ** 1.5
    return f"The moments were {fixed(float(over[0]), 2)} and {fixed(float(over[1]), 2)} (over σ³)."


def _of_pose(state: State) -> Caption:
    outcome = sure(state.outcome)
    near = f"its points lie {length(outcome.gap)} (RMS) from the nearest of the first"
    box = (
        f" The box along its axes holds {brief(state.box)} times the shape's own."
        if np.isfinite(state.box)
        else ""
    )
    if not np.isfinite(outcome.rotation):
        return Caption(
            f"Frame laid on frame: {near}. Nobody knows the truth here, and half a turn may look"
            " alike."
        )
    off = angle(outcome.rotation)
    if outcome.home:
        return Caption(
            f"Frame laid on frame: the second scan is {off} from the truth; {near}. It has come"
            f" home.{box}",
            "good",
        )
    return Caption(
        f"Frame laid on frame: {near}, and it is wrong, {off} from the truth.{box}", "wrong"
    )


def _of_turns(state: State) -> Caption:
    turns = sure(state.turns)
    scan = "a new scan each time" if state.params.fresh else "the same scan"
    return Caption(
        f"{len(turns.degrees)} random turns, {scan}, the same recipe:"
        f" {percent(float(turns.home.mean()), 0)} come home, within {HOME_DEGREES:g}°. The median"
        f" rotation error is {angle(float(np.median(turns.degrees)))}; axis 1 as a line is"
        f" {angle(float(np.median(turns.axes[:, 0])))} off."
    )
