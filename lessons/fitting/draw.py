"""What one step looks like, stage by stage."""

from collections.abc import Callable
from typing import Any

import numpy as np

from lessons.fitting.captions import caption
from lessons.fitting.contours import REACH, on_contours
from lessons.fitting.fit_studies import AWAY, FATES, Basin, Lines, Rivals, Spread
from lessons.fitting.round_shapes import CIRCLE, CYLINDER, RoundShape, feet, outline
from lessons.fitting.state import State, Subject
from workbench.algorithms.least_squares import Descent, Walked
from workbench.algorithms.robust import LOSSES, Trusted
from workbench.certain import sure
from workbench.data.files.rims import Rim
from workbench.data.thinning import every
from workbench.geometry.clipping import plane_in_box
from workbench.geometry.motions import R_ROWS_DOWN, across, motion
from workbench.geometry.polylines import at_height, between, circle, fan, segments
from workbench.geometry.shapes.algebraic_fits import ALGEBRAIC
from workbench.geometry.shapes.lines_planes import line_angle
from workbench.numerals import angle, brief, fixed
from workbench.scene import (
    Chart,
    Classes,
    Field,
    Mesh,
    Picture,
    Points,
    Primitive,
    Role,
    Scene,
    Segments,
    Table,
)

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
    "Kåsa": "wrong",
    "Pratt": "neutral",
    "Taubin": "source",
    "Hyper": "other",
    "geometric": "highlight",
    "upright": "wrong",
    "level": "other",
    "perpendicular": "source",
}


def draw(state: State) -> Scene:
    """Return the picture of one step."""
    return {"caption": caption(state), **DRAWN[type(state.now)](state, state.now)}


def _points(subject: Subject, z: float = 0.0, least: float = 0.01) -> dict[str, Primitive]:
    radius = max(float(np.clip(0.2 / np.sqrt(len(subject.p)), 0.01, 0.025)), least)
    scene: dict[str, Primitive] = {
        "points": Points(at_height(subject.p, z), "target", radius, name="points")
    }
    if subject.truth is not None and subject.kind is not None:
        scene["truth"] = Segments(
            outline(subject.kind, subject.truth, REACH), "truth", 2.0, name="truth"
        )
    return scene


def _near(ends: np.ndarray) -> np.ndarray:
    """Return the segments that stay in the picture."""
    return ends[(np.abs(ends) < 3 * REACH).all(axis=(1, 2))]


def _distances(p: np.ndarray, at: np.ndarray) -> Segments:
    return Segments(
        _near(between(at_height(p), at_height(at))), "correspondence", 1.5, name="distances"
    )


def _walked(state: State, walked: Walked) -> dict[str, Primitive]:
    subject = state.subject
    descent = walked.now
    kind = sure(state.subject.kind)
    scene = _points(subject) | _estimate(kind, descent.unknown)
    if np.isfinite(descent.unknown).all() and descent.phase != "tried":
        scene["distances"] = _distances(subject.p, feet(kind, descent.unknown, subject.p))
    if descent.phase == "linearised" and subject.p.shape[1] == 2:
        some = every(len(subject.p), 9)
        n = descent.jacobian[some, :2]
        at = feet(kind, descent.unknown, subject.p)[some]
        along = 0.25 * np.column_stack([-n[:, 1], n[:, 0]])
        ends = _near(between(at_height(at - along, 0.01), at_height(at + along, 0.01)))
        scene["tangents"] = Segments(ends, "highlight", 3.0, name="tangents")
    if descent.trial is not None and descent.phase in ("tried", "rejected"):
        dashed = outline(kind, descent.trial, REACH)[::2]
        tried = descent.phase == "tried"
        scene["trial"] = Segments(
            dashed, "highlight" if tried else "wrong", 3.0, name="trial" if tried else "taken back"
        )
    if descent.stop and subject.straight is not None and abs(descent.unknown[-1]) > AWAY:
        scene["straight"] = Segments(
            _line(subject.straight, REACH), "neutral", 2.0, name="best straight line"
        )
    if kind is CIRCLE:
        scene |= on_contours(subject.p, walked)
    return scene | _walked_beside(subject, walked, descent)


def _walked_beside(subject: Subject, walked: Walked, descent: Descent) -> dict[str, Primitive]:
    scene: dict[str, Primitive] = {"cost": COST.scalar(descent.cost, "estimate", log=True)}
    if subject.straight is not None:
        scene["straight cost"] = COST.scalar(
            subject.straight_cost, "best straight line", "neutral", log=True
        )
    if subject.truth is not None and np.isfinite(descent.unknown).all():
        scene["radius error"] = ERROR.scalar(
            abs(abs(descent.unknown[-1]) - subject.truth[-1]), "of the radius", log=True
        )
    off = subject.off_best(descent.unknown)
    if np.isfinite(off) and subject.truth is not None and subject.kind is not CYLINDER:
        scene["off"] = OFF.scalar(max(off, 1e-9), "estimate", log=True)
    if descent.damping:
        scene["damping"] = DAMPING.scalar(descent.damping, "λ", "other", log=True)
    if walked.along is not None:
        shares = walked.along.shares
        kept = np.minimum(walked.along.costs, 4.0 * descent.cost)
        scene["true costs"] = ALONG.curve(shares, kept, "true", marks=(1.0,))
        scene["promised costs"] = ALONG.curve(
            shares, walked.along.promised, "linear problem", "highlight"
        )
    return scene


def _estimate(kind: RoundShape, unknown: np.ndarray) -> dict[str, Primitive]:
    return {"estimate": Segments(outline(kind, unknown, REACH), "source", 4.0, name="estimate")}


def _spread(state: State, spread: Spread) -> dict[str, Primitive]:
    subject = state.subject
    kind = sure(state.subject.kind)
    unknown = spread.unknown
    d = state.subject.p.shape[1]
    scene = _points(subject) | _estimate(kind, unknown)
    axes = np.stack(across(unknown[3:6])) if kind is CYLINDER else np.eye(3)[:2]
    values, vectors = np.linalg.eigh(spread.covariance[:2, :2])
    ellipse = 2.448 * (circle() * np.sqrt(np.maximum(values, 0.0))) @ vectors.T @ axes + at_height(
        unknown[:d]
    )
    scene["ellipse"] = Segments(
        segments(ellipse), "highlight", 4.0, name="95 % of centres, by the covariance"
    )
    if len(spread.radii):
        near = np.abs(spread.centers).max(axis=1) < REACH
        scene["centers"] = Points(
            at_height(spread.centers[near]), "other", 0.0035, name="centres, measured anew"
        )
        low, high = spread.predicted
        edges = np.linspace(max(2 * low - high, 0.0), max(2 * high - low, 1e-6), 40)
        kept = np.clip(spread.radii, edges[0], edges[-1])
        scene["radii"] = AGAIN.histogram(
            kept * subject.scale, edges * subject.scale, "repetition", "other"
        )
        x = (edges[1:] + edges[:-1]) / 2
        width = edges[1] - edges[0]
        sd = spread.radius_deviation
        expected = (
            len(spread.radii)
            * width
            * np.exp(-0.5 * ((x - spread.radius) / sd) ** 2)
            / (sd * np.sqrt(2 * np.pi))
        )
        scene["bell"] = AGAIN.curve(x * subject.scale, expected, "covariance", "highlight")
    rows = [
        (
            name,
            f"{brief(float(np.degrees(sd)))}°"
            if name.startswith("tilt")
            else f"{brief(float(sd * subject.scale))} m",
        )
        for name, sd in zip(kind.names, np.sqrt(np.diag(spread.covariance)), strict=True)
    ]
    scene["table"] = Table("Standard deviations by the covariance", ("", "±"), tuple(rows))
    return scene


def _basin(state: State, basin: Basin) -> dict[str, Primitive]:
    fates = Classes(basin.fates, ("truth", "wrong", "neutral"), FATES)
    return _points(state.subject, 0.12, 0.05) | {
        "starts": Points(
            at_height(basin.starts[:, :2], -0.02), fates, 0.13, name="starts: centres"
        ),
        "share": HOME.scalar(100.0 * basin.share("comes home"), "home", "truth"),
        "lost": HOME.scalar(100.0 * basin.share("away or lost"), "away or lost", "wrong"),
    }


def _rivals(state: State, rivals: Rivals) -> dict[str, Primitive]:
    subject = state.subject
    scene = _points(subject)
    if subject.rim is not None:
        scene["photograph"] = _photograph(subject.rim)
        scene["rim"] = Points(
            at_height(subject.rim.p), "correspondence", 0.008, name="all of the rim"
        )
    names = list(rivals.circles)
    for name in names if rivals.arcs else names[-1:]:
        lines = outline(CIRCLE, rivals.circles[name], REACH)
        scene[f"circle/{name}"] = Segments(
            lines, COLORS[name], 3.0, name=f"{name}'s" if name in ALGEBRAIC else name
        )
    rows = tuple((name, fixed(c[2] * subject.scale, 3)) for name, c in rivals.circles.items())
    scene["table"] = Table(
        "Radius of these points (m)" if subject.rim is None else "Radius (of the rim's)",
        ("fit", "R"),
        rows,
    )
    if len(rivals.arcs) > 1:
        x, medians = np.array(rivals.arcs), np.array(rivals.medians)
        for k, name in enumerate(names):
            scene[f"median {name}"] = MEDIANS.curve(x, medians[:, k], name, COLORS[name])
    return scene


def _photograph(rim: Rim) -> Picture:
    """Lay the photograph under the points: the coin's centre at the origin, its radius 1 m."""
    h, w = rim.photograph.shape[:2]
    right, down = (np.array([w - 1, h - 1]) / 2 - rim.center) / rim.radius
    T_world_picture = motion(R_ROWS_DOWN, np.array([right, -down, -0.02]))
    return Picture(rim.photograph, "Coins", w / rim.radius, T_world_picture)


def _lines(state: State, fits: Lines) -> dict[str, Primitive]:
    subject = state.subject
    truth = sure(state.subject.truth)
    scene = _points(subject) | {"true line": Segments(_line(truth), "truth", 3.0, name="truth")}
    names = list(fits.lines)
    for name in names:
        scene[f"line/{name}"] = Segments(
            _line(fits.lines[name]), COLORS[name], 3.0, name=f"{name} distances"
        )
    if names and not fits.angles:
        a, b, c = fits.lines[names[-1]]
        off = subject.p @ np.array([a, b]) + c
        way = {"upright": np.array([0.0, 1.0 / b]), "level": np.array([1.0 / a, 0.0])}.get(
            names[-1], np.array([a, b])
        )
        scene["distances"] = _distances(subject.p, subject.p - np.outer(off, way))
    if names:
        told = (fits.lines | {"truth": truth}).items()
        rows = tuple((name, angle(float(np.degrees(line_angle(line))))) for name, line in told)
        scene["table"] = Table("Angles of these points", ("distances", "angle"), rows)
    for name, angles in fits.angles.items():
        both = np.percentile(np.concatenate(list(fits.angles.values())), [0.5, 99.5])
        edges = np.linspace(both[0], both[1] + 1e-6, 50)
        scene[f"angles {name}"] = ANGLES.histogram(angles, edges, name, COLORS[name])
    return scene


def _line(line: np.ndarray, half: float = 1.6) -> np.ndarray:
    middle = -line[2] * line[:2]
    way = half * np.array([-line[1], line[0]])
    return at_height(np.stack([middle - way, middle + way]))[None]


def _trusted(state: State, trusted: Trusted) -> dict[str, Primitive]:
    subject = state.subject
    scale = 1e3 * state.subject.scale
    low = np.minimum(subject.p.min(axis=0), -1.0) - 0.01
    high = np.maximum(subject.p.max(axis=0), 1.0) + 0.01
    trust = Field(trusted.now.weights, 0.0, 1.0, "weight")
    scene: dict[str, Primitive] = {"points": Points(subject.p, trust, 0.018, name="points")}
    planes: list[tuple[str, np.ndarray, Role]] = [("estimate", trusted.now.estimate, "source")]
    if subject.truth is not None:
        planes.append(("truth", subject.truth, "truth"))
    for name, plane, color in planes:
        corners = plane_in_box(plane, low, high)
        if len(corners):
            scene[name] = Segments(segments(corners, closed=True), color, 4.0, name=name)
            scene[f"{name}/surface"] = Mesh(
                corners, fan(len(corners)), color, opacity=0.25, flat=True
            )
    weights = LOSSES[trusted.loss.name].weights
    off = trusted.now.distances
    x = np.linspace(-1.0, 1.0, 161) * float(np.clip(np.abs(off).max(), 3e-3, 1.0))
    scene["pull"] = PULL.curve(scale * x, scale * x * weights(x, trusted.corner), trusted.loss.name)
    scene["pulls"] = PULL.dots(
        scale * off, scale * off * weights(off, trusted.corner), "points", "target"
    )
    error, squares_error = state.plane_errors
    if np.isfinite(error):
        scene["error"] = PLANE_ERROR.scalar(1e3 * error, "estimate", log=True)
        scene["squares"] = PLANE_ERROR.scalar(
            1e3 * squares_error, "least squares", "neutral", log=True
        )
    scene["loss"] = Chart("Sum of the losses").scalar(
        trusted.now.cost / trusted.corner**2, trusted.loss.name
    )
    return scene


DRAWN: dict[type, Callable[[State, Any], dict[str, Primitive]]] = {
    Walked: _walked,
    Spread: _spread,
    Basin: _basin,
    Rivals: _rivals,
    Lines: _lines,
    Trusted: _trusted,
}
