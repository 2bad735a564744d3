"""What a step in space says: one sentence, with the number that changed."""

import numpy as np

from lessons.axes.charts import CM2, skewness
from lessons.axes.space import HOME_DEGREES
from workbench.captions import Quantity, counted, degrees, fixed, metres, number, share
from workbench.certain import sure
from workbench.lesson import Look, say
from workbench.numerals import brief
from workbench.scene import Caption

PARTS = (
    (1e-4, 1e2, " %"),
    (1e-7, 1e6, " millionths"),
    (1e-10, 1e9, " billionths"),
    (1e-12, 1e12, " trillionths"),
)
RULES = {
    "none": "Without a rule",
    "largest-entry": "Largest entry",
    "third-moment": "Third moments",
}
PLACE = {"cloud": "scans", "order": "axes", "signs": "signs"}


def of_state(look: Look) -> Caption:
    """Return the caption of a step of the stages `space` and `turn`."""
    state = look.now
    rotated = look.now.jacobi
    place = PLACE.get(look.now.moment, "")
    match state.moment:
        case "cloud":
            p, q = look.subject.p_target, look.subject.p_source
            words = (
                f"Two scans of {look.subject.what}, {{n}} and {{m}}: no point knows its partner."
            )
            n, m = counted(len(p), "point"), counted(len(q), "point")
            return say(words, n=n, m=m, place=place)
        case "centroid":
            return say("Centroid on centroid settles the shift. A turn is left to find.")
        case "covariance":
            words = "The entries off the diagonal make {left} of the norm of C."
            return say(words, left=part(rotated.off), place=place)
        case "rotation":
            words = "Turn {n}: {turned} in its {i}-{j} plane leaves {left} off the diagonal."
            turned = degrees(abs(np.degrees(rotated.angle)))
            i, j = ("xyz"[k] for k in rotated.plane)
            given = {
                "n": state.rotations,
                "turned": turned,
                "i": i,
                "j": j,
                "left": part(rotated.off),
            }
            return say(words, **given)
        case "hand":
            i, j = rotated.plane
            words = f"Turned by {{turned}}, the {'xyz'[i]}-{'xyz'[j]} entry is {{entry}} cm²."
            entry = number(CM2 * rotated.A[i, j])
            return say(words, turned=degrees(np.degrees(rotated.angle)), entry=entry)
        case "order":
            a, b, c = (metres(float(np.sqrt(max(v, 0.0)))) for v in state.variances)
            words = "In the order of variance: standard deviations {a}, {b} and {c}."
            return say(words, a=a, b=b, c=c, place=place)
        case "frame":
            words = "Frame {k} of {n} leaves the points {gap} (RMS) from the nearest blue ones."
            gap = metres(state.frames[state.frame - 1].gap)
            return say(words, k=state.frame, n=len(state.frames), gap=gap)
        case "signs":
            first, second, _ = skewness(state)
            words = (
                f"{RULES[look.params.signs]}: frame {{k}}. The moments were {{one}} and {{two}}."
            )
            return say(words, k=state.frame, one=fixed(first, 2), two=fixed(second, 2), place=place)
        case "pose":
            return _of_pose(look)
    turns = sure(state.turns)
    words = "{home} of {n} random turns come home; the median error is {median}."
    home = share(float(turns.home.mean()), 0)
    median = degrees(float(np.median(turns.degrees)))
    return say(words, home=home, n=len(turns.degrees), median=median, place="many turns")


def part(left: float) -> Quantity:
    """Return a share of what is off the diagonal, in per cent or in parts that suit it."""
    for least, factor, unit in PARTS:
        if left >= least:
            return Quantity(left, f"{brief(factor * left, 2)}{unit}")
    return Quantity(left, "nothing but rounding")


def _of_pose(look: Look) -> Caption:
    state = look.now
    outcome = sure(look.now.outcome)
    gap = metres(outcome.gap)
    place = "frame on frame"
    if not np.isfinite(outcome.rotation):
        words = "Frame on frame: {gap} (RMS) to the nearest points. Nobody knows the truth here."
        return say(words, gap=gap, place=place)
    off = degrees(outcome.rotation)
    words = "Frame on frame: {off} from the truth, {gap} (RMS) to the nearest points."
    if look.subject.what == "one box":  # half a turn takes it to itself: its axes are lines
        words = "Axis 1, as a line, differs by {line} between these two scans."
        return say(words, line=degrees(float(sure(outcome.axes)[0]), 2), place=place)
    if np.isfinite(state.box):
        words = "The frame is {off} off, and its box holds {box} times the shape's own."
        return say(
            words, right=outcome.home, settled=False, off=off, box=number(state.box), place=place
        )
    return say(words, right=outcome.home, settled=False, off=off, gap=gap, place=place)


def of_race(look: Look) -> Caption:
    """Return the caption of a round of the stage `starts`."""
    race = look.now
    low, following = (metres(float(v)) for v in np.sort(race.rmse)[:2])
    if not look.past:
        words = "A start from each frame: the lowest RMSE is {low}, the next {following}."
        return say(words, low=low, following=following, place="starts")
    if not race.is_end:
        words = "Round {round} of ICP: the lowest RMSE is {low}, the next {following}."
        return say(words, round=race.round, low=low, following=following)
    if not race.is_told:
        words = "All four have stopped: the lowest RMSE is {low}, the next {following}."
        return say(words, low=low, following=following, place="stop")
    off = float(race.off[race.winner])
    words = "Frame {k} has the lowest RMSE, {low}, and is {off} from the truth."
    given = {"k": race.winner + 1, "low": low, "off": degrees(off)}
    return say(words, right=off < HOME_DEGREES, settled=False, place="truth", **given)
