"""Pictures of the stages in a plane: bearings, lines that become parallel, an object on a plane
through it.
"""

import numpy as np

from lessons.coordinates.captions import lies_on_both
from lessons.coordinates.parallels import Met, Seen
from lessons.coordinates.placing import Ranged
from lessons.coordinates.state import State, Thing
from workbench.certain import as_a
from workbench.geometry.cameras import intrinsics
from workbench.geometry.clipping import clip_lines, segments_inside
from workbench.geometry.motions import R_UPRIGHT, motion
from workbench.geometry.polylines import at_height, between, rectangle, segments
from workbench.geometry.two_views.homography import transform_pixels
from workbench.numerals import length
from workbench.scene import Camera, Chart, Mesh, Points, Primitive, Role, Segments, Table

OFF = Chart("Off the true point", unit="m")
LAST_ENTRY = Chart("w of the meeting", unit="for a vector of length 1")
KEPT = Chart("Four points on a line", unit="ratio")
SIZES = Chart("Wrong size", unit="%")
ORIGIN = np.zeros(3)
# of the plane w = 1 that is shown, metres
LOW = np.array([-2.0, -1.5])
HIGH = np.array([8.0, 2.5])
EYE_SHOWN, RAY = 4.0, 2.2  # metres


def ranged(radar: Ranged) -> dict[str, Primitive]:
    """Return measured points beside the true one and their means."""
    return {
        "range": Segments(_arc(radar), "correspondence", 1.5, name="the true range"),
        "radar": Points(ORIGIN[None], "neutral", 0.15, name="radar"),
        "points": Points(
            at_height(radar.p),
            "target",
            0.05 if len(radar.p) > 500 else 0.08,
            opacity=0.6,
            name="measurements",
        ),
        "true": Points(at_height(radar.true[None], 0.1), "truth", 0.2, name="true point"),
        "mean": Points(at_height(radar.mean[None], 0.1), "wrong", 0.2, name="mean of the points"),
        "debiased": Points(
            at_height(radar.debiased[None], 0.1), "source", 0.15, name="mean, divided"
        ),
        "off": OFF.scalar(
            float(np.linalg.norm(radar.mean - radar.true)), "mean of the points", "wrong"
        ),
        "expected": OFF.scalar(
            float(np.linalg.norm(radar.expected - radar.true)), "expected of it", "correspondence"
        ),
        "off divided": OFF.scalar(
            float(np.linalg.norm(radar.debiased - radar.true)), "divided by exp(−σ²/2)"
        ),
        "means": Table(
            "Means",
            ("of", "off the true point"),
            (
                ("the points", length(float(np.linalg.norm(radar.mean - radar.true)))),
                ("the same, divided", length(float(np.linalg.norm(radar.debiased - radar.true)))),
                ("range and bearing", length(float(np.linalg.norm(radar.polar_mean - radar.true)))),
            ),
        ),
    }


def _arc(radar: Ranged) -> np.ndarray:
    turn = np.linspace(-np.pi / 2, np.pi / 2, 61)
    return segments(at_height(radar.true[0] * np.column_stack([np.cos(turn), np.sin(turn)])))


def met(meeting: Met) -> dict[str, Primitive]:
    """Return the plane w = 1, both lines with the planes that they span with the origin, and the
    vector of their meeting.
    """
    scene: dict[str, Primitive] = {
        "plane": Segments(
            segments(at_height(rectangle(LOW, HIGH), 1.0), closed=True),
            "neutral",
            1.5,
            name="the plane w = 1",
        ),
        "origin": Points(ORIGIN[None], "neutral", 0.06, name="origin"),
        "rails": Segments(_grid(meeting.H), "neutral", 1, opacity=0.5),
    }
    roles: tuple[Role, Role] = ("target", "source")
    for k, (name, role) in enumerate(zip(("l", "l′"), roles, strict=True)):
        a, b, _ = meeting.lines[k]
        ends = (
            clip_lines(meeting.lines[[k]] / np.hypot(a, b), LOW, HIGH)
            if np.hypot(a, b) > 1e-9
            else np.empty((0, 2, 2))
        )
        if len(ends):
            p = at_height(ends[0], 1.0)
            scene[f"line/{k + 1}"] = Segments(p[None], role, 5, name=name)
            scene[f"fan/{k + 1}"] = Mesh(
                np.vstack([ORIGIN, p]), np.array([[0, 1, 2]]), role, opacity=0.2
            )
    horizon = meeting.horizon / max(float(np.hypot(*meeting.horizon[:2])), 1e-12)
    if meeting.H[2, 0] and len(ends := clip_lines(horizon[None], LOW, HIGH)):
        scene["horizon"] = Segments(at_height(ends[0], 1.0)[None], "highlight", 4, name="horizon")
    stops = meeting.places[:, :2] / meeting.places[:, 2:]
    scene["stops"] = Points(at_height(stops, 1.0), "target", 0.05, name="four points of l")
    x_h = meeting.x_h
    right = lies_on_both(meeting)
    if np.isfinite(x_h).all() and x_h.any():
        n = (
            x_h
            / np.linalg.norm(x_h)
            * (-1.0 if x_h[2] < 0 or (x_h[2] == 0 and x_h[0] < 0) else 1.0)
        )
        scene["meeting"] = Segments(
            between(ORIGIN, 8.0 * n), "truth" if right else "wrong", 5, name="l × l′"
        )
        scene["w"] = LAST_ENTRY.scalar(float(n[2]), "w", "truth" if right else "wrong")
        if n[2] > 0 and (np.abs(p := n[:2] / n[2]) < 12).all():
            scene["point"] = Points(
                np.append(p, 1.0)[None], "truth" if right else "wrong", 0.1, name="meeting"
            )
    scene["kept"] = KEPT.scalar(meeting.cross_ratio, "cross-ratio", "truth")
    scene["lengths"] = KEPT.scalar(meeting.ratio, "first to third over first to second")
    return scene


def _grid(H: np.ndarray) -> np.ndarray:
    """Return parallels along x and rungs across them, as a homography shows them."""
    t = np.linspace(0.0, 1.0, 13)
    lines = [np.column_stack([40.0 * t**2, np.full(13, y)]) for y in (-1.0, 0.0, 1.0, 2.0)]
    lines += [
        np.column_stack([np.full(13, x), -1.0 + 3.0 * t])
        for x in (0.0, 1.0, 2.0, 3.0, 4.0, 6.0, 8.0, 12.0, 20.0, 40.0)
    ]
    ends = np.concatenate([segments(transform_pixels(H, line)) for line in lines])
    return at_height(segments_inside(ends, LOW, HIGH), 1.0)


def seen(state: State, view: Seen) -> dict[str, Primitive]:
    """Return the object, its two pictures on the plane y = 0, and the rays to the eye."""
    thing = as_a(Thing, state.subject)
    scene: dict[str, Primitive] = {}
    if len(thing.lines):
        scene["object"] = Segments(thing.lines, "target", 2.5, name=thing.name)
        corners = np.unique(thing.lines.reshape(-1, 3).round(9), axis=0)
    else:
        scene["object"] = Points(thing.p, "target", 0.008, name=thing.name)
        corners = thing.p[:: max(1, len(thing.p) // 12)]
    scene["perspective"] = _picture(thing, view, "source", name="by the eye")
    scene["parallel"] = _picture(thing, None, "truth", name="by parallel rays")
    v = view.eye - corners
    reach = np.minimum(1.0, RAY / np.linalg.norm(v, axis=1, keepdims=True))
    scene["rays"] = Segments(
        between(corners, corners + reach * v),
        "correspondence",
        1.5,
        opacity=0.7,
        name="rays to the eye",
    )
    if -view.eye[1] < EYE_SHOWN:
        scene["eye"] = Camera(
            intrinsics(50.0, 31.5, 23.5), 64, 48, motion(R_UPRIGHT, view.eye), 0.15, name="eye"
        )
    scene["near"] = SIZES.scalar(100 * view.near, "near side", "source", log=True)
    scene["far"] = SIZES.scalar(-100 * view.far, "far side", "other", log=True)
    return scene


def _picture(thing: Thing, view: Seen | None, role: Role, *, name: str) -> Primitive:
    """Return the picture of an object on the plane y = 0: through the eye where there is one, else
    by parallel rays.
    """
    p = thing.lines.reshape(-1, 3) if len(thing.lines) else thing.p
    factor = np.ones(len(p)) if view is None else -view.eye[1] / (p[:, 1] - view.eye[1])
    flat = np.column_stack([p[:, 0] * factor, np.zeros(len(p)), p[:, 2] * factor])
    if len(thing.lines):
        return Segments(flat.reshape(-1, 2, 3), role, 4, name=name)
    return Points(flat, role, 0.008, name=name)
