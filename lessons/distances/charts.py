"""What stands beside the picture: errors to the truth, what they shrink with, and who is near by
which distance.
"""

import numpy as np

from lessons.distances.plane import WITHIN
from lessons.distances.stages import relative
from lessons.distances.state import Ball, Found, Front, Landmarks, Params, Scatter, State, Trials
from workbench.certain import sure
from workbench.numerals import brief, length, percent
from workbench.scene import Chart, Primitive, Role, Table

WORST = Chart("Worst error so far", unit="%")
FINER = "Error of ever finer {}"
TIME = Chart("Error over the time of heat", "log₁₀ of the time in squared edges", "mean error (%)")
SPREAD = Chart("Errors", "error to the truth (%)", "nodes")
BROKEN = Chart("Triangle inequality broken", unit="% of triples")
SHARES = Chart("Within 2 of the mean", "dimensions", "% of points")
RADII = Chart("Mahalanobis distances", "standard deviations", "points")
RIGHT = Chart("Right landmark", unit="% of measurements")
ROLES: tuple[Role, ...] = ("wrong", "source", "other", "target", "highlight")


def beside(state: State) -> dict[str, Primitive]:
    """Return the charts and tables of a step."""
    now = state.now
    match now:
        case Front():
            return _so_far(state, now.d, now.accepted)
        case Found():
            return _so_far(state, now.d, np.isfinite(now.d)) | _found(state, now)
        case Ball():
            return _nearest(state.params, now)
        case Trials():
            return _axioms(now)
        case Scatter():
            return _scatter(now)
        case Landmarks():
            return {
                "by euclid": RIGHT.scalar(
                    100 * _right(now, now.euclid), "nearest by Euclid's distance", "source"
                ),
                "by mahalanobis": RIGHT.scalar(
                    100 * _right(now, now.mahalanobis), "by Mahalanobis'", "truth"
                ),
            }
        case _:
            return {}


def _right(now: Landmarks, told: np.ndarray) -> float:
    return float((told == now.true).mean())


def _so_far(state: State, d: np.ndarray, accepted: np.ndarray) -> dict[str, Primitive]:
    subject = state.subject
    if subject is None or not len(subject.truth):
        return {}
    error = relative(np.where(accepted, d, np.inf), subject.truth)
    known = error[np.isfinite(error)]
    worst = float(known[np.abs(known).argmax()]) if len(known) else float("nan")
    return {"worst": WORST.scalar(100 * worst, "worst error", "truth")}


def _found(state: State, now: Found) -> dict[str, Primitive]:
    known = 100 * now.error[np.isfinite(now.error)]
    scene: dict[str, Primitive] = {}
    if len(known):
        low, high = float(min(known.min(), 0.0)), float(max(known.max(), 0.0))
        if high - low < 1e-6:
            low, high = -1.0, 1.0
        scene["errors"] = SPREAD.histogram(known, np.linspace(low, high, 25), "nodes", "truth")
    of_grid = state.params.stage == "grid"
    chart = Chart(
        FINER.format("grids" if of_grid else "spheres"),
        "log₁₀ spacing (m)",
        "log₁₀ worst error (%)",
    )
    for (name, (x, y)), role in zip(now.study.items(), ROLES, strict=False):
        scene[f"finer/{name}"] = chart.curve(x, y, name, role)
    if now.times is not None:
        scene["times"] = TIME.curve(*now.times, "mean error", "truth", marks=(state.params.time,))
    if len(now.asymmetry):
        scene["metric"] = Table(
            "Is heat distance a metric?",
            ("axiom", "broken"),
            (
                (
                    "d(a, b) = d(b, a)",
                    f"by {percent(float(np.median(now.asymmetry)))} (median),"
                    f" {percent(float(now.asymmetry.max()))} at most",
                ),
                ("d(a, c) ≤ d(a, b) + d(b, c)", f"by {percent(now.broken)} of the triples"),
            ),
        )
    return scene | _goal(state, now)


def _goal(state: State, now: Found) -> dict[str, Primitive]:
    subject = sure(state.subject)
    if subject.goal < 0 or not np.isfinite(now.d[subject.goal]):
        return {}
    straight = float(np.linalg.norm(subject.p[subject.goal] - subject.p[subject.source]))
    rows = [("straight through", length(straight)), ("found", length(float(now.d[subject.goal])))]
    if len(now.truth):
        rows.append(("in truth", length(float(now.truth[subject.goal]))))
    return {"to the goal": Table("From source to goal", ("way", "length"), tuple(rows))}


def _nearest(params: Params, now: Ball) -> dict[str, Primitive]:
    scene: dict[str, Primitive] = {
        "radius": Chart("Radius of the ball").scalar(now.radius, "radius")
    }
    if now.nearest:
        rows = [(name, f"point {index}") for name, index in now.nearest.items()]
        if params.stretch > 1:
            rows.append(("euclid, both in metres", f"point {now.straight}"))
        scene["nearest by"] = Table("Nearest to the purple point", ("by", "nearest"), tuple(rows))
    return scene


def _axioms(now: Trials) -> dict[str, Primitive]:
    rows = tuple(
        (name, "never" if share == 0 else percent(share)) for name, share in now.axioms.items()
    )
    ab, bc, ac = now.sides
    sides = (
        ("d(a, b)", brief(ab)),
        ("d(b, c)", brief(bc)),
        ("d(a, c)", brief(ac)),
        ("d(a, b) + d(b, c)", brief(ab + bc)),
    )
    return {
        "broken": BROKEN.scalar(100 * now.broken / now.tried, "broken", "wrong"),
        "axioms": Table("Axioms of a metric", ("axiom", "broken in"), rows),
        "sides": Table("This triple", ("", ""), sides),
    }


def _scatter(now: Scatter) -> dict[str, Primitive]:
    if now.shares is not None:
        x = np.arange(1.0, len(now.shares[0]) + 1)
        return {
            "shares": SHARES.dots(x, 100 * now.shares[0], f"counted within {WITHIN:g}", "source"),
            "true shares": SHARES.curve(x, 100 * now.shares[1], "chi-squared", "truth"),
        }
    if now.phase != "told":
        return {}
    return {"radii": RADII.histogram(now.d, 30, "points", "source", marks=(now.limit,))}
