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
    result = state.now
    match result:
        case Front():
            return _so_far(state, result.d, result.accepted)
        case Found():
            return _so_far(state, result.d, np.isfinite(result.d)) | _found(state, result)
        case Ball():
            return _nearest(state.params, result)
        case Trials():
            return _axioms(result)
        case Scatter():
            return _scatter(result)
        case Landmarks():
            return {
                "by euclid": RIGHT.scalar(
                    100 * _right(result, result.euclid), "nearest by Euclid's distance", "source"
                ),
                "by mahalanobis": RIGHT.scalar(
                    100 * _right(result, result.mahalanobis), "by Mahalanobis'", "truth"
                ),
            }
        case _:
            return {}


def _right(sights: Landmarks, told: np.ndarray) -> float:
    return float((told == sights.true).mean())


def _so_far(state: State, d: np.ndarray, accepted: np.ndarray) -> dict[str, Primitive]:
    subject = state.subject
    if subject is None or not len(subject.truth):
        return {}
    error = relative(np.where(accepted, d, np.inf), subject.truth)
    known = error[np.isfinite(error)]
    worst = float(known[np.abs(known).argmax()]) if len(known) else float("nan")
    return {"worst": WORST.scalar(100 * worst, "worst error", "truth")}


def _found(state: State, distances: Found) -> dict[str, Primitive]:
    known = 100 * distances.error[np.isfinite(distances.error)]
    scene: dict[str, Primitive] = {}
    if len(known):
        low, high = float(min(known.min(), 0.0)), float(max(known.max(), 0.0))
        if high - low < 1e-6:
            low = -1.0
            high = 1.0
        scene["errors"] = SPREAD.histogram(known, np.linspace(low, high, 25), "nodes", "truth")
    of_grid = state.params.stage == "grid"
    chart = Chart(
        FINER.format("grids" if of_grid else "spheres"),
        "log₁₀ spacing (m)",
        "log₁₀ worst error (%)",
    )
    for (name, (x, y)), role in zip(distances.study.items(), ROLES, strict=False):
        scene[f"finer/{name}"] = chart.curve(x, y, name, role)
    if distances.times is not None:
        scene["times"] = TIME.curve(
            *distances.times, "mean error", "truth", marks=(state.params.time,)
        )
    if len(distances.asymmetry):
        scene["metric"] = Table(
            "Is heat distance a metric?",
            ("axiom", "broken"),
            (
                (
                    "d(a, b) = d(b, a)",
                    f"by {percent(float(np.median(distances.asymmetry)))} (median),"
                    f" {percent(float(distances.asymmetry.max()))} at most",
                ),
                ("d(a, c) ≤ d(a, b) + d(b, c)", f"by {percent(distances.broken)} of the triples"),
            ),
        )
    return scene | _goal(state, distances)


def _goal(state: State, distances: Found) -> dict[str, Primitive]:
    subject = sure(state.subject)
    if subject.goal < 0 or not np.isfinite(distances.d[subject.goal]):
        return {}
    straight = float(np.linalg.norm(subject.p[subject.goal] - subject.p[subject.source]))
    rows = [
        ("straight through", length(straight)),
        ("found", length(float(distances.d[subject.goal]))),
    ]
    if len(distances.truth):
        rows.append(("in truth", length(float(distances.truth[subject.goal]))))
    return {"to the goal": Table("From source to goal", ("way", "length"), tuple(rows))}


def _nearest(params: Params, ball: Ball) -> dict[str, Primitive]:
    scene: dict[str, Primitive] = {
        "radius": Chart("Radius of the ball").scalar(ball.radius, "radius")
    }
    if ball.nearest:
        rows = [(name, f"point {index}") for name, index in ball.nearest.items()]
        if params.stretch > 1:
            rows.append(("euclid, both in metres", f"point {ball.straight}"))
        scene["nearest by"] = Table("Nearest to the purple point", ("by", "nearest"), tuple(rows))
    return scene


def _axioms(trials: Trials) -> dict[str, Primitive]:
    rows = tuple(
        (name, "never" if share == 0 else percent(share)) for name, share in trials.axioms.items()
    )
    ab, bc, ac = trials.sides
    sides = (
        ("d(a, b)", brief(ab)),
        ("d(b, c)", brief(bc)),
        ("d(a, c)", brief(ac)),
        ("d(a, b) + d(b, c)", brief(ab + bc)),
    )
    return {
        "broken": BROKEN.scalar(100 * trials.broken / trials.tried, "broken", "wrong"),
        "axioms": Table("Axioms of a metric", ("axiom", "broken in"), rows),
        "sides": Table("This triple", ("", ""), sides),
    }


def _scatter(scatter: Scatter) -> dict[str, Primitive]:
    if scatter.shares is not None:
        x = np.arange(1.0, len(scatter.shares[0]) + 1)
        return {
            "shares": SHARES.dots(
                x, 100 * scatter.shares[0], f"counted within {WITHIN:g}", "source"
            ),
            "true shares": SHARES.curve(x, 100 * scatter.shares[1], "chi-squared", "truth"),
        }
    if scatter.phase != "told":
        return {}
    return {"radii": RADII.histogram(scatter.d, 30, "points", "source", marks=(scatter.limit,))}
