"""What one step looks like, stage by stage."""

from functools import cache

import numpy as np

from lessons.fitting.contours import REACH, on_contours
from lessons.fitting.state import State, Subject, Trusted, Walked
from lessons.fitting.words import caption, fate_of, off_best, predicted_span, straight_cost
from workbench.algorithms.fit_studies import Basin, Lines, Rivals, Spread
from workbench.algorithms.least_squares import Descent
from workbench.algorithms.robust import LOSSES
from workbench.algorithms.round_shapes import CIRCLE, CYLINDER
from workbench.data.thinning import every
from workbench.geometry.algebraic_fits import ALGEBRAIC
from workbench.geometry.clipping import plane_in_box
from workbench.geometry.lines_planes import line_angle
from workbench.geometry.motions import across
from workbench.geometry.polylines import between, circle, cylinder_rings, fan, near_arc, segments, sphere_rings
from workbench.numerals import angle, brief, fixed
from workbench.scene import Chart, Classes, Field, Mesh, Picture, Points, Primitive, Role, Scene, Segments, Table

COST = Chart("Sum of squares", unit="m²")
ERROR = Chart("Error to the truth", unit="m")
OFF = Chart("Distance to the best fit", unit="m")
DAMPING = Chart("Damping")
ALONG = Chart("Along the step", "share of the step", "m²")
AGAIN = Chart("Radii, measured anew", "R (m)", "how many")
HOME = Chart("Starts that come home", unit="%")
MEDIANS = Chart("Median radius by arc", "arc (°)", "of the true radius")
ANGLES = Chart("Angles, measured anew", "angle (°)", "how many")
PULL = Chart("How hard a point pulls", "distance (mm)", "weight × distance (mm)")
PLANE_ERROR = Chart("Error to the truth", unit="mm")
COLORS: dict[str, Role] = {
    "Kåsa": "wrong", "Pratt": "neutral", "Taubin": "source", "Hyper": "other", "geometric": "highlight",
    "upright": "wrong", "level": "other", "perpendicular": "source",
}  # fmt: skip


def draw(state: State) -> Scene:
    """Return the picture of one step."""
    scene: dict[str, Primitive] = {"caption": caption(state)}
    match state.now:
        case Walked():
            return scene | _points(state.subject) | _walked(state, state.now)
        case Spread():
            return scene | _points(state.subject) | _spread(state.subject, state.now)
        case Basin():
            return scene | _points(state.subject, 0.12, 0.05) | _basin(state.now)
        case Rivals():
            return scene | _rivals(state, state.now)
        case Lines():
            return scene | _points(state.subject) | _lines(state.subject, state.now)
        case Trusted():
            return scene | _trusted(state, state.now)


def solid(p: np.ndarray, z: float = 0.0) -> np.ndarray:
    """Return points in space: those in the plane at a height."""
    return p if p.shape[-1] == 3 else np.concatenate([p, np.full((*p.shape[:-1], 1), z)], axis=-1)


def _points(subject: Subject, z: float = 0.0, least: float = 0.01) -> dict[str, Primitive]:
    radius = max(float(np.clip(0.2 / np.sqrt(len(subject.p)), 0.01, 0.025)), least)
    scene: dict[str, Primitive] = {"points": Points(solid(subject.p, z), "target", radius, name="points")}
    if subject.truth is not None and subject.kind is not None:
        scene["truth"] = Segments(outline(subject, subject.truth), "truth", 2.0, name="truth")
    return scene


def outline(subject: Subject, unknown: np.ndarray) -> np.ndarray:
    """Return a circle, sphere or cylinder as segments; of a very large circle what is near; none where not finite."""
    if not np.isfinite(unknown).all() or abs(unknown[-1]) > 1e9:
        return np.empty((0, 2, 3))
    if subject.kind is CYLINDER:
        n_axis = unknown[3:6]
        p_axis = unknown[:3] - (unknown[:3] @ n_axis) * n_axis
        return cylinder_rings(p_axis, np.column_stack([*across(n_axis), n_axis]), abs(float(unknown[6])))
    if len(unknown) == 3:
        return segments(solid(near_arc(unknown, REACH)))
    return sphere_rings(unknown[:3], abs(float(unknown[3])))


def feet(subject: Subject, unknown: np.ndarray) -> np.ndarray:
    """Return the nearest places of a circle, sphere or cylinder to the points."""
    assert subject.kind is not None
    residuals, jacobian = subject.kind.linearise(unknown, subject.p)
    ways = np.stack(across(unknown[3:6])) if subject.kind is CYLINDER else np.eye(subject.p.shape[1])
    return subject.p + residuals[:, None] * (jacobian[:, : len(ways)] @ ways)


def _near(ends: np.ndarray) -> np.ndarray:
    """Return the segments that stay in the picture."""
    return ends[(np.abs(ends) < 3 * REACH).all(axis=(1, 2))]


def _walked(state: State, walked: Walked) -> dict[str, Primitive]:
    subject, now = state.subject, walked.now
    scene: dict[str, Primitive] = {"estimate": Segments(outline(subject, now.unknown), "source", 4.0, name="estimate")}
    if np.isfinite(now.unknown).all() and now.phase != "tried":
        at = solid(feet(subject, now.unknown))
        scene["distances"] = Segments(_near(between(solid(subject.p), at)), "correspondence", 1.5, name="distances")
    if now.phase == "linearised" and subject.p.shape[1] == 2:
        some = every(len(subject.p), 9)
        n, at = now.jacobian[some, :2], feet(subject, now.unknown)[some]
        along = 0.25 * np.column_stack([-n[:, 1], n[:, 0]])
        ends = _near(between(solid(at - along, 0.01), solid(at + along, 0.01)))
        scene["tangents"] = Segments(ends, "highlight", 3.0, name="tangents")
    if now.trial is not None and now.phase in ("tried", "rejected"):
        dashed, tried = outline(subject, now.trial)[::2], now.phase == "tried"
        scene["trial"] = Segments(
            dashed, "highlight" if tried else "wrong", 3.0, name="trial" if tried else "taken back"
        )
    if now.stop and subject.straight is not None and abs(now.unknown[-1]) > 50.0:
        a, b, c = subject.straight
        middle, way = -c * np.array([a, b]), np.array([-b, a])
        ends = solid(np.stack([middle - REACH * way, middle + REACH * way]))[None]
        scene["straight"] = Segments(ends, "neutral", 2.0, name="best straight line")
    if subject.kind is CIRCLE:
        scene |= on_contours(subject.p, walked)
    return scene | _walked_beside(state, walked, now)


def _walked_beside(state: State, walked: Walked, now: Descent) -> dict[str, Primitive]:
    subject = state.subject
    scene: dict[str, Primitive] = {"cost": COST.scalar(now.cost, "estimate", log=True)}
    if subject.straight is not None:
        scene["straight cost"] = COST.scalar(straight_cost(state), "best straight line", "neutral", log=True)
    if subject.truth is not None and np.isfinite(now.unknown).all():
        scene["radius error"] = ERROR.scalar(abs(abs(now.unknown[-1]) - subject.truth[-1]), "of the radius", log=True)
    if np.isfinite(off_best(state, now.unknown)) and subject.truth is not None and subject.kind is not CYLINDER:
        scene["off"] = OFF.scalar(max(off_best(state, now.unknown), 1e-9), "estimate", log=True)
    if now.damping:
        scene["damping"] = DAMPING.scalar(now.damping, "λ", "other", log=True)
    if walked.along is not None:
        shares, kept = walked.along.shares, np.minimum(walked.along.costs, 4.0 * now.cost)
        scene["true costs"] = ALONG.curve(shares, kept, "true", marks=(1.0,))
        scene["promised costs"] = ALONG.curve(shares, walked.along.promised, "linear problem", "highlight")
    return scene


def _spread(subject: Subject, now: Spread) -> dict[str, Primitive]:
    d, unknown = subject.p.shape[1], now.unknown
    assert subject.kind is not None
    scene: dict[str, Primitive] = {"estimate": Segments(outline(subject, unknown), "source", 4.0, name="estimate")}
    axes = np.stack(across(unknown[3:6])) if subject.kind is CYLINDER else np.eye(3)[:2]
    values, vectors = np.linalg.eigh(now.covariance[:2, :2])
    ellipse = 2.448 * (circle() * np.sqrt(np.maximum(values, 0.0))) @ vectors.T @ axes + solid(unknown[:d])
    scene["ellipse"] = Segments(segments(ellipse), "highlight", 4.0, name="95 % of centres, by the covariance")
    if len(now.radii):
        near = np.abs(now.centers).max(axis=1) < REACH
        scene["centers"] = Points(solid(now.centers[near]), "other", 0.0035, name="centres, measured anew")
        low, high = predicted_span(now)
        edges = np.linspace(max(2 * low - high, 0.0), max(2 * high - low, 1e-6), 40)
        kept = np.clip(now.radii, edges[0], edges[-1])
        scene["radii"] = AGAIN.histogram(kept * subject.scale, edges * subject.scale, "repetition", "other")
        x, sd = (edges[1:] + edges[:-1]) / 2, float(np.sqrt(now.covariance[-1, -1]))
        bell = np.exp(-0.5 * ((x - abs(unknown[-1])) / sd) ** 2) / (sd * np.sqrt(2 * np.pi))
        expected = len(now.radii) * (edges[1] - edges[0]) * bell
        scene["bell"] = AGAIN.curve(x * subject.scale, expected, "covariance", "highlight")
    rows, sds = [], np.sqrt(np.diag(now.covariance))
    for name, sd in zip(subject.kind.names, sds, strict=True):
        is_angle = name.startswith("tilt")
        value = f"{brief(float(np.degrees(sd)))}°" if is_angle else f"{brief(float(sd * subject.scale))} m"
        rows.append((name, value))
    scene["table"] = Table("Standard deviations by the covariance", ("", "±"), tuple(rows))
    return scene


def _basin(now: Basin) -> dict[str, Primitive]:
    fates = fate_of(now)
    roles: tuple[Role, ...] = ("truth", "wrong", "neutral")
    ids = Classes(fates.astype(np.uint8), roles, ("comes home", "away or lost", "under way"))
    return {
        "starts": Points(solid(now.starts[:, :2], -0.02), ids, 0.13, name="starts: centres"),
        "share": HOME.scalar(100.0 * float((fates == 0).mean()), "home", "truth"),
        "lost": HOME.scalar(100.0 * float((fates == 1).mean()), "away or lost", "wrong"),
    }


def _rivals(state: State, now: Rivals) -> dict[str, Primitive]:
    subject = state.subject
    scene = _points(subject)
    if subject.photograph is not None:
        scene["photograph"] = _photograph(subject)
        assert subject.p_true is not None
        scene["rim"] = Points(solid(subject.p_true), "correspondence", 0.008, name="all of the rim")
    names = list(now.circles)
    for name in names if now.arcs else names[-1:]:
        lines = outline(subject, now.circles[name])
        scene[f"circle/{name}"] = Segments(lines, COLORS[name], 3.0, name=f"{name}'s" if name in ALGEBRAIC else name)
    rows = tuple((name, fixed(c[2] * subject.scale, 3)) for name, c in now.circles.items())
    scene["table"] = Table("Radius of these points (m)" if subject.photograph is None else "Radius (of the rim's)",
                           ("fit", "R"), rows)  # fmt: skip
    if len(now.arcs) > 1:
        x, medians = np.array(now.arcs), np.array(now.medians)
        for k, name in enumerate(names):
            scene[f"median {name}"] = MEDIANS.curve(x, medians[:, k], name, COLORS[name])
    return scene


@cache
def _turned_down() -> np.ndarray:
    """Return the pose of a picture that lies on the ground, its rows going down the page."""
    return np.diag([1.0, -1.0, -1.0, 1.0])


def _photograph(subject: Subject) -> Picture:
    """Lay the photograph under the points: the coin's centre at the origin, its radius 1 m."""
    assert subject.photograph is not None
    h, w = subject.photograph.shape[:2]
    x, y, radius = subject.middle
    T = _turned_down().copy()
    T[:3, 3] = ((w - 1) / 2 - x) / radius, -((h - 1) / 2 - y) / radius, -0.02
    return Picture(subject.photograph, "Coins", width=w / radius, T_world_object=T)


def _lines(subject: Subject, now: Lines) -> dict[str, Primitive]:
    assert subject.truth is not None
    scene: dict[str, Primitive] = {"true line": Segments(_line(subject.truth), "truth", 3.0, name="truth")}
    names = list(now.lines)
    for name in names:
        scene[f"line/{name}"] = Segments(_line(now.lines[name]), COLORS[name], 3.0, name=f"{name} distances")
    if names and not now.angles:
        a, b, c = now.lines[names[-1]]
        off = subject.p @ np.array([a, b]) + c
        way = {"upright": np.array([0.0, 1.0 / b]), "level": np.array([1.0 / a, 0.0])}.get(names[-1], np.array([a, b]))
        scene["distances"] = Segments(
            _near(between(solid(subject.p), solid(subject.p - np.outer(off, way)))),
            "correspondence",
            1.5,
            name="distances",
        )
    if names:
        rows = tuple((name, angle(float(np.degrees(line_angle(line))))) for name, line in now.lines.items())
        truth = ("truth", angle(float(np.degrees(line_angle(subject.truth)))))
        scene["table"] = Table("Angles of these points", ("distances", "angle"), (*rows, truth))
    for name, angles in now.angles.items():
        both = np.percentile(np.concatenate(list(now.angles.values())), [0.5, 99.5])
        edges = np.linspace(both[0], both[1] + 1e-6, 50)
        scene[f"angles {name}"] = ANGLES.histogram(angles, edges, name, COLORS[name])
    return scene


def _line(line: np.ndarray) -> np.ndarray:
    middle, way = -line[2] * line[:2], np.array([-line[1], line[0]])
    return solid(np.stack([middle - 1.6 * way, middle + 1.6 * way]))[None]


def _trusted(state: State, now: Trusted) -> dict[str, Primitive]:
    subject, scale = state.subject, 1e3 * state.subject.scale
    low = np.minimum(subject.p.min(axis=0), -1.0) - 0.01
    high = np.maximum(subject.p.max(axis=0), 1.0) + 0.01
    weights = now.now.weights
    trust = Field(weights, 0.0, 1.0, "weight")
    scene: dict[str, Primitive] = {"points": Points(subject.p, trust, 0.018, name="points")}
    planes: list[tuple[str, np.ndarray, Role]] = [("estimate", now.now.estimate, "source")]
    if subject.truth is not None:
        planes.append(("truth", subject.truth, "truth"))
    for name, plane, color in planes:
        corners = plane_in_box(plane, low, high)
        if len(corners):
            scene[name] = Segments(segments(corners, closed=True), color, 4.0, name=name)
            scene[f"{name}/surface"] = Mesh(corners, fan(len(corners)), color, opacity=0.25, flat=True)
    loss, top = LOSSES[now.loss], float(np.clip(np.abs(now.now.distances).max(), 3e-3, 1.0))
    x = np.linspace(-top, top, 161)
    scene["pull"] = PULL.curve(scale * x, scale * x * loss.weights(x, now.corner), now.loss)
    scene["pulls"] = PULL.dots(
        scale * now.now.distances,
        scale * now.now.distances * loss.weights(now.now.distances, now.corner),
        "points",
        "target",
    )
    if np.isfinite(now.error):
        scene["error"] = PLANE_ERROR.scalar(1e3 * now.error, "estimate", log=True)
        scene["squares"] = PLANE_ERROR.scalar(1e3 * now.squares_error, "least squares", "neutral", log=True)
    scene["loss"] = Chart("Sum of the losses").scalar(now.now.cost / now.corner**2, now.loss)
    return scene
