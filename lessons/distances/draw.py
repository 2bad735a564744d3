"""What one step looks like: balls and scatters in the plane, fronts and errors on what ways lead
over.
"""

import numpy as np

from lessons.distances.captions import caption
from lessons.distances.charts import beside
from lessons.distances.plane import HALF
from lessons.distances.state import Ball, Found, Front, Landmarks, Scatter, State, Subject, Trials
from lessons.distances.subjects import true_way
from workbench.algorithms.surfaces.heat_method import HeatState
from workbench.certain import sure
from workbench.data.thinning import every
from workbench.geometry.polylines import at_height, between, rectangle, segments
from workbench.scene import Classes, Color, Field, Label, Mesh, Points, Primitive, Scene, Segments

MOST_EDGES, MOST_ARROWS = 2500, 900
SQUARE = np.array([-HALF, -HALF]), np.array([HALF, HALF])
# the stereo camera's landmarks lie 4 to 6 m ahead of it: shown about the origin
AHEAD = np.array([0.0, -4.0])


def draw(state: State) -> Scene:
    """Return the picture of one step."""
    result = state.now
    match result:
        case Front() | Found() | HeatState():
            scene = _ways(state)
        case Ball():
            scene = _ball(result)
        case Trials():
            scene = _trials(result)
        case Scatter():
            scene = _scatter(result)
        case Landmarks():
            scene = _landmarks(result)
    return {"caption": caption(state)} | scene | beside(state)


def _ways(state: State) -> dict[str, Primitive]:
    result = state.now
    subject = sure(state.subject)
    color = _color(state, subject)
    scene: dict[str, Primitive] = {}
    if len(subject.faces):
        scene["nodes"] = Mesh(subject.p, subject.faces, color, name=subject.name)
    else:
        scene["nodes"] = Points(subject.p, color, subject.radius, name=subject.name)
    up = subject.radius * (np.array([0.0, 0, 1]) if subject.tip is not None else np.zeros(3))
    scene["source"] = Points(
        subject.p[[subject.source]] + up, "highlight", 1.8 * subject.radius, name="source"
    )
    if subject.tip is not None and not subject.free.all():
        foot = np.array([subject.tip[0], -0.5])
        scene["wall"] = Segments(
            at_height(between(foot, subject.tip)) + up, "neutral", 8.0, name="wall"
        )
    elif 0 < len(subject.edges) <= MOST_EDGES and len(subject.faces):
        scene["edges"] = Segments(
            subject.p[subject.edges], "neutral", 1.0, opacity=0.5, name="edges"
        )
    if len(subject.shortcuts):
        ends = subject.p[subject.edges[subject.shortcuts]]
        scene["shortcuts"] = Segments(ends, "wrong", 5.0, name="edges that leave the surface")
    if isinstance(result, Front):
        trial = np.isfinite(result.d) & ~result.accepted
        scene["trial"] = Points(subject.p[trial] + up, "source", subject.radius, name="on trial")
    if isinstance(result, HeatState) and result.phase == "directions":
        scene |= _arrows(subject, result)
    if isinstance(result, Found):
        goal = subject.goal
        if len(result.path) > 1:
            scene["way"] = Segments(
                segments(result.path) + 2 * up, "highlight", 5.0, name="shortest way found"
            )
            goal = int(np.argmin(np.linalg.norm(subject.p - result.path[-1], axis=1)))
        if goal >= 0:
            scene["goal"] = Points(
                subject.p[[goal]] + up, "truth", 2.0 * subject.radius, name="goal"
            )
            way = true_way(subject, goal)
            if len(way):
                scene["true way"] = Segments(segments(way) + 2 * up, "truth", 3.0, name="true way")
    return scene


def _color(state: State, subject: Subject) -> Color:
    result = state.now
    if isinstance(result, Found) and np.isfinite(result.error).any():
        percent = 100 * result.error
        reach = max(float(np.nanpercentile(np.abs(percent), 98)), 0.1)
        return Field(percent, -reach, reach, "error to the truth", "%", "diverging")
    if isinstance(result, HeatState) and result.phase != "distances":
        u = np.log10(np.maximum(result.u / result.u.max(), 1e-12))
        return Field(u, -12.0, 0.0, "heat, log₁₀")
    if isinstance(result, Found | HeatState):
        d = result.d
    else:
        d = np.where(result.accepted, result.d, np.nan)  # type: ignore[union-attr]
    truth = subject.truth[np.isfinite(subject.truth)]
    known = d[np.isfinite(d)]
    top = float(truth.max()) if len(truth) else float(known.max(initial=0.0))
    return Field(np.where(np.isfinite(d), d, np.nan), 0.0, max(top, 1e-6), "distance", "m")


def _arrows(subject: Subject, heat: HeatState) -> dict[str, Primitive]:
    some = every(len(subject.faces), MOST_ARROWS)
    middle = subject.p[subject.faces[some]].mean(axis=1)
    tip = middle + 0.8 * subject.h * heat.X[some]
    return {
        "directions": Segments(between(middle, tip), "source", 2.5, name="away from the heat"),
        "directions/tips": Points(tip, "source", 0.07 * subject.h),
    }


def _ball(ball: Ball) -> dict[str, Primitive]:
    scene: dict[str, Primitive] = {
        "border": Segments(at_height(segments(rectangle(*SQUARE), closed=True)), "neutral", 1.0),
        "nodes": Points(at_height(ball.p), "target", 0.022, name="points"),
        "source": Points(
            at_height(ball.p[[ball.query]], 0.01), "highlight", 0.035, name="in the middle"
        ),
        "ball": Segments(
            at_height(_within(ball.rims[0])), "source", 4.0, name="ball by this distance"
        ),
        "euclid": Segments(
            at_height(_within(ball.rims[1])), "correspondence", 2.0, name="Euclid's"
        ),
    }
    if ball.nearest:
        first = int(np.argmin(ball.d))
        scene["nearest"] = Points(
            at_height(ball.p[[first]], 0.005), "source", 0.035, name="nearest by this distance"
        )
        scene["nearest/euclid"] = Points(
            at_height(ball.p[[ball.straight]], -0.005), "correspondence", 0.045, name="by Euclid's"
        )
        told = Classes.marking(
            ball.changed, "wrong", "another nearest", others=("neutral", "the same")
        )
        scene["queries"] = Points(at_height(ball.queries, -0.01), told, 0.009, name="queries")
    return scene


def _within(line: np.ndarray) -> np.ndarray:
    """Return the pieces of a line that do not leave the square by much."""
    pieces = segments(line)
    return pieces[(np.abs(pieces) <= 1.01 * HALF).all(axis=(1, 2))]


def _trials(trials: Trials) -> dict[str, Primitive]:
    a, b, c = 2 * HALF * trials.corners - HALF
    role = "wrong" if trials.sides[2] > trials.sides[0] + trials.sides[1] + 1e-9 else "truth"
    p = np.stack([a, b, c])
    out = p - p.mean(axis=0)
    beyond = at_height(p + 0.1 * out / np.maximum(np.linalg.norm(out, axis=1, keepdims=True), 1e-9))
    return {
        **{
            f"letters/{letter}": Label(letter, place, "target")
            for letter, place in zip("abc", beyond, strict=True)
        },
        "border": Segments(at_height(segments(rectangle(*SQUARE), closed=True)), "neutral", 1.0),
        "nodes": Points(at_height(p), "target", 0.035, name="a, b, c"),
        "over b": Segments(
            at_height(segments(p)), "correspondence", 4.0, name="from a over b to c"
        ),
        "straight": Segments(at_height(between(a, c)), role, 4.0, name="from a to c"),
    }


def _scatter(scatter: Scatter) -> dict[str, Primitive]:
    ids = np.where(
        scatter.outlier, np.where(scatter.flagged, 2, 3), np.where(scatter.flagged, 1, 0)
    ).astype(np.uint8)
    named = Classes(
        ids,
        ("target", "other", "source", "wrong"),
        (
            "of the scatter",
            "of it, beyond 95 %",
            "second cluster, beyond 95 %",
            "second cluster, within 95 %",
        ),
    )
    told: Color = (
        named if scatter.phase in ("told", "dimensions") or scatter.outlier.any() else "target"
    )
    return {
        "nodes": Points(at_height(scatter.p), told, 0.035, name="points"),
        "rim": Segments(at_height(segments(scatter.rim)), "source", 4.0, name="95 %"),
        "axes": Segments(
            at_height(np.array([[[-4.0, 0], [4, 0]], [[0, -4], [0, 4]]]), -0.01), "neutral", 1.0
        ),
    }


def _landmarks(sights: Landmarks) -> dict[str, Primitive]:
    seen = sights.seen[-len(sights.rims) :]
    new = slice(len(sights.true) - len(sights.rims), None)
    ends = sights.landmarks[sights.true[new]]
    wrong = sights.euclid[new] != sights.true[new]
    missed = sights.mahalanobis[new] != sights.true[new]

    def show(p: np.ndarray, height: float = 0.0) -> np.ndarray:
        return at_height(p + AHEAD - [0.0, 1.0], height)

    return {
        "nodes": Points(show(sights.landmarks), "target", 0.02, name="landmarks"),
        "seen": Points(show(seen, 0.01), "source", 0.012, name="measured"),
        "camera": Label("↓ 4 m to the camera", np.array([0.0, -1.25, 0.0]), "neutral"),
        "rims": Segments(
            show(np.stack([sights.rims[:, :-1], sights.rims[:, 1:]], axis=2).reshape(-1, 2, 2)),
            "correspondence",
            1.0,
            opacity=0.6,
            name="95 % of a measurement",
        ),
        "right": Segments(show(between(seen, ends)), "truth", 2.0, name="to the true landmark"),
        "euclid": Segments(
            show(between(seen, sights.landmarks[sights.euclid[new]])[wrong]),
            "wrong",
            3.0,
            name="wrong, by Euclid's distance",
        ),
        "missed": Segments(
            show(between(seen, sights.landmarks[sights.mahalanobis[new]])[missed], 0.005),
            "highlight",
            3.0,
            name="wrong, by Mahalanobis'",
        ),
    }
