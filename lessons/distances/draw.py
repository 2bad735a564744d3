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
AHEAD = np.array(
    [0.0, -4.0]
)  # the stereo camera's landmarks lie 4 to 6 m ahead of it: shown about the origin


def draw(state: State) -> Scene:
    """Return the picture of one step."""
    now = state.now
    match now:
        case Front() | Found() | HeatState():
            scene = _ways(state)
        case Ball():
            scene = _ball(now)
        case Trials():
            scene = _trials(now)
        case Scatter():
            scene = _scatter(now)
        case Landmarks():
            scene = _landmarks(now)
    return {"caption": caption(state)} | scene | beside(state)


def _ways(state: State) -> dict[str, Primitive]:
    now, subject = state.now, sure(state.subject)
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
    if isinstance(now, Front):
        trial = np.isfinite(now.d) & ~now.accepted
        scene["trial"] = Points(subject.p[trial] + up, "source", subject.radius, name="on trial")
    if isinstance(now, HeatState) and now.phase == "directions":
        scene |= _arrows(subject, now)
    if isinstance(now, Found):
        goal = subject.goal
        if len(now.path) > 1:
            scene["way"] = Segments(
                segments(now.path) + 2 * up, "highlight", 5.0, name="shortest way found"
            )
            goal = int(np.argmin(np.linalg.norm(subject.p - now.path[-1], axis=1)))
        if goal >= 0:
            scene["goal"] = Points(
                subject.p[[goal]] + up, "truth", 2.0 * subject.radius, name="goal"
            )
            way = true_way(subject, goal)
            if len(way):
                scene["true way"] = Segments(segments(way) + 2 * up, "truth", 3.0, name="true way")
    return scene


def _color(state: State, subject: Subject) -> Color:
    now = state.now
    if isinstance(now, Found) and np.isfinite(now.error).any():
        percent = 100 * now.error
        reach = max(float(np.nanpercentile(np.abs(percent), 98)), 0.1)
        return Field(percent, -reach, reach, "error to the truth", "%", "diverging")
    if isinstance(now, HeatState) and now.phase != "distances":
        u = np.log10(np.maximum(now.u / now.u.max(), 1e-12))
        return Field(u, -12.0, 0.0, "heat, log₁₀")
    d = now.d if isinstance(now, Found | HeatState) else np.where(now.accepted, now.d, np.nan)  # type: ignore[union-attr]
    truth = subject.truth[np.isfinite(subject.truth)]
    known = d[np.isfinite(d)]
    top = float(truth.max()) if len(truth) else float(known.max(initial=0.0))
    return Field(np.where(np.isfinite(d), d, np.nan), 0.0, max(top, 1e-6), "distance", "m")


def _arrows(subject: Subject, now: HeatState) -> dict[str, Primitive]:
    some = every(len(subject.faces), MOST_ARROWS)
    middle = subject.p[subject.faces[some]].mean(axis=1)
    tip = middle + 0.8 * subject.h * now.X[some]
    return {
        "directions": Segments(between(middle, tip), "source", 2.5, name="away from the heat"),
        "directions/tips": Points(tip, "source", 0.07 * subject.h),
    }


def _ball(now: Ball) -> dict[str, Primitive]:
    scene: dict[str, Primitive] = {
        "border": Segments(at_height(segments(rectangle(*SQUARE), closed=True)), "neutral", 1.0),
        "nodes": Points(at_height(now.p), "target", 0.022, name="points"),
        "source": Points(
            at_height(now.p[[now.query]], 0.01), "highlight", 0.035, name="in the middle"
        ),
        "ball": Segments(
            at_height(_within(now.rims[0])), "source", 4.0, name="ball by this distance"
        ),
        "euclid": Segments(at_height(_within(now.rims[1])), "correspondence", 2.0, name="Euclid's"),
    }
    if now.nearest:
        first = int(np.argmin(now.d))
        scene["nearest"] = Points(
            at_height(now.p[[first]], 0.005), "source", 0.035, name="nearest by this distance"
        )
        scene["nearest/euclid"] = Points(
            at_height(now.p[[now.straight]], -0.005), "correspondence", 0.045, name="by Euclid's"
        )
        told = Classes.marking(
            now.changed, "wrong", "another nearest", others=("neutral", "the same")
        )
        scene["queries"] = Points(at_height(now.queries, -0.01), told, 0.009, name="queries")
    return scene


def _within(line: np.ndarray) -> np.ndarray:
    """Return the pieces of a line that do not leave the square by much."""
    pieces = segments(line)
    return pieces[(np.abs(pieces) <= 1.01 * HALF).all(axis=(1, 2))]


def _trials(now: Trials) -> dict[str, Primitive]:
    a, b, c = 2 * HALF * now.corners - HALF
    role = "wrong" if now.sides[2] > now.sides[0] + now.sides[1] + 1e-9 else "truth"
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


def _scatter(now: Scatter) -> dict[str, Primitive]:
    ids = np.where(now.outlier, np.where(now.flagged, 2, 3), np.where(now.flagged, 1, 0)).astype(
        np.uint8
    )
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
    told: Color = named if now.phase in ("told", "dimensions") or now.outlier.any() else "target"
    return {
        "nodes": Points(at_height(now.p), told, 0.035, name="points"),
        "rim": Segments(at_height(segments(now.rim)), "source", 4.0, name="95 %"),
        "axes": Segments(
            at_height(np.array([[[-4.0, 0], [4, 0]], [[0, -4], [0, 4]]]), -0.01), "neutral", 1.0
        ),
    }


def _landmarks(now: Landmarks) -> dict[str, Primitive]:
    seen, new = now.seen[-len(now.rims) :], slice(len(now.true) - len(now.rims), None)
    ends = now.landmarks[now.true[new]]
    wrong = now.euclid[new] != now.true[new]
    missed = now.mahalanobis[new] != now.true[new]

    def show(p: np.ndarray, height: float = 0.0) -> np.ndarray:
        return at_height(p + AHEAD - [0.0, 1.0], height)

    return {
        "nodes": Points(show(now.landmarks), "target", 0.02, name="landmarks"),
        "seen": Points(show(seen, 0.01), "source", 0.012, name="measured"),
        "camera": Label("↓ 4 m to the camera", np.array([0.0, -1.25, 0.0]), "neutral"),
        "rims": Segments(
            show(np.stack([now.rims[:, :-1], now.rims[:, 1:]], axis=2).reshape(-1, 2, 2)),
            "correspondence",
            1.0,
            opacity=0.6,
            name="95 % of a measurement",
        ),
        "right": Segments(show(between(seen, ends)), "truth", 2.0, name="to the true landmark"),
        "euclid": Segments(
            show(between(seen, now.landmarks[now.euclid[new]])[wrong]),
            "wrong",
            3.0,
            name="wrong, by Euclid's distance",
        ),
        "missed": Segments(
            show(between(seen, now.landmarks[now.mahalanobis[new]])[missed], 0.005),
            "highlight",
            3.0,
            name="wrong, by Mahalanobis'",
        ),
    }
