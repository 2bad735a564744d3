"""What one step looks like: the target, the cameras that could have seen it, the picture, and the
errors.
"""

import functools
from dataclasses import dataclass

import numpy as np

from lessons.pose.captions import caption
from lessons.pose.state import Repeated, State, Subject, Target
from workbench.algorithms.cameras.camera_search import Searched
from workbench.algorithms.robust import ransac
from workbench.certain import as_a
from workbench.geometry.cameras import camera_center, project
from workbench.geometry.motions import apply, inverse
from workbench.geometry.points.metrics import rms
from workbench.geometry.polylines import between
from workbench.lesson import View
from workbench.numerals import angle, coordinates, length, pixels
from workbench.scene import (
    Camera,
    Chart,
    Classes,
    Color,
    Mesh,
    Picture,
    Points,
    Primitive,
    Role,
    Scene,
    Segments,
    Table,
    is_rigid,
)

VIEW = View(eye=(7.2, -0.9, 3.15), target=(0.6, 0.0, 0.25), grid=None, axes=False, fov_degrees=40.0)
CLOSE = View(eye=(0.1, -0.4, 0.3), target=(0.06, 0.0, 0.0), grid=None, axes=False, fov_degrees=40.0)
ABOVE = View(eye=(9.5, -6.0, 5.5), target=(0.8, 0.6, 1.7), grid=None, axes=False, fov_degrees=40.0)
ALONG = View(eye=(7.5, -14.0, 8.5), target=(5.2, 5.0, 1.8), grid=None, axes=False, fov_degrees=40.0)


@dataclass(frozen=True, eq=False)
class Look:
    """How a kind of target is drawn: seen from where, the photograph where and how wide, points and
    cameras how large.
    """

    view: View
    screen: np.ndarray
    width: float
    radius: float
    depth: float


LOOKS: dict[Target, Look] = {
    "box": Look(VIEW, VIEW.facing(1.75, -0.7), 2.3, 0.02, 0.45),
    "marker": Look(CLOSE, CLOSE.facing(0.13, 0.0), 0.16, 0.0035, 0.02),
    "street": Look(ALONG, ALONG.facing(5.8, -1.5), 8.2, 0.08, 1.2),
    "triangle": Look(ABOVE, ABOVE.facing(2.6, 0.3), 2.8, 0.02, 0.45),
}
# residuals are drawn so many times as long while their RMS is below so many pixels
ENLARGED = 10
SMALL = 4.0
QUARTIC = Chart("Quartic", "v = s₃ / s₁", "scaled")
PICTURE_ERROR = Chart("RMS error in the picture", unit="px")
TURN_ERROR = Chart("Rotation error", unit="°")
CENTRE_ERROR = Chart("Error of the centre", unit="m")
TURNS = Chart("Rotation errors in other pictures", "degrees", "pictures")
ANEW = Chart("Random cameras, as many points", "degrees", "% within")
SOLUTIONS = Chart("Solutions of random triples", "how many", "triples")


def draw(state: State) -> Scene:
    """Return the picture of one step."""
    subject, step = state.subject, state.now
    scene: dict[str, Primitive] = {"caption": caption(state), **_still(subject)}
    photograph = as_a(Picture, scene["picture"])
    scene |= _pixels(state, photograph)
    if subject.T_true is not None:
        scene["truth"] = _camera(subject, subject.T_true, "truth", name="true camera")
    if isinstance(step, Searched):
        scene |= _three(state, step) | _candidates(state, step)
    elif (
        isinstance(step, ransac.State) and len(step.sample) and step.phase not in ("refit", "stop")
    ):
        scene["sample"] = Points(
            subject.p_shown[step.sample],
            "highlight",
            2.0 * LOOKS[subject.kind].radius,
            name="sample",
        )
    if isinstance(step, Repeated):
        return scene | _repeated(subject, step)
    if state.T is not None and is_rigid(state.T):
        scene["estimate"] = _camera(subject, state.T, "source", name="estimate")
        root = isinstance(step, Searched) and step.phase == "root"
        if not root and subject.T_true is not None and subject.body is not None:
            seen = _as_seen(subject, state.T)
            scene["seen"] = Segments(seen, "source", 2.5, name="target, if the camera stood still")
    return scene | _numbers(state)


@functools.lru_cache(maxsize=64)
def _still(subject: Subject) -> dict[str, Primitive]:
    """Return what is the same in all steps: the target, its points, the photograph and where points
    were seen in it.
    """
    look = LOOKS[subject.kind]
    photograph = Picture(subject.photograph, "What the camera saw", look.width, look.screen)
    scene: dict[str, Primitive] = {
        "points": Points(subject.p_shown, "target", look.radius, name="known points"),
        "picture": photograph,
        "picture/border": Segments(photograph.border(0.001 * look.width), "neutral", 1.0),
    }
    if (body := subject.body) is not None:
        scene["target"] = Mesh(body.p, body.faces, "neutral", opacity=0.25, flat=True)
        scene["target/lines"] = Segments(body.lines, "neutral", 1.5)
    return scene


def _on(photograph: Picture, subject: Subject, uv: np.ndarray) -> np.ndarray:
    """Return the places of pixels on the photograph, and no further from it than half its size."""
    w, h = photograph.size
    left_top = subject.window[:2]
    size = subject.window[2:] - subject.window[:2]
    inside = np.clip((uv - left_top) / size, -0.5, 1.5)
    assert photograph.width is not None
    return photograph.places(inside * [w, h] - 0.5, 0.01 * photograph.width)


def _pixels(state: State, photograph: Picture) -> dict[str, Primitive]:
    """Return where points were seen, and where the pose in question sees them."""
    subject, T, step = state.subject, state.T, state.now
    assert photograph.width is not None
    radius = 0.012 * photograph.width
    color = _votes(step)
    scene: dict[str, Primitive] = {
        "picture/seen": Points(_on(photograph, subject, subject.given.uv), color, radius)
    }
    if T is None:
        return scene
    uv = project(subject.given.p_world, T, subject.K)
    front = np.isfinite(uv).all(axis=1)
    if not front.any():
        return scene
    errors = subject.pixel_errors(T)[front]
    factor = ENLARGED if rms(errors) < SMALL else 1
    start = subject.given.uv[front]
    end = uv[front]
    ends = between(
        *(_on(photograph, subject, at) for at in (start, start + factor * (end - start)))
    )
    times = f", drawn {factor} times as long" if factor > 1 else ""
    scene["picture/residuals"] = Segments(ends, "wrong", 2.5, name=f"error in the picture{times}")
    scene["picture/calculated"] = Points(
        _on(photograph, subject, uv[front]), "source", 0.7 * radius
    )
    return scene


def _votes(step: object) -> Color:
    fit = (step.trial or step.best) if isinstance(step, ransac.State) else None
    return (
        "target"
        if fit is None
        else Classes.marking(~fit.inliers, "wrong", "outlier", others=("target", "inlier"))
    )


def _camera(subject: Subject, T: np.ndarray, color: Role, *, name: str) -> Camera:
    depth = LOOKS[subject.kind].depth
    return Camera(subject.K, 640, 480, subject.frame.shown_camera(T), depth, color=color, name=name)


def _three(state: State, search: Searched) -> dict[str, Primitive]:
    """Return the three points and their rays, from the true camera; then the quartic."""
    subject = state.subject
    if state.params.method != "P3P" or search.phase in ("step", "stop"):
        return {}
    scene: dict[str, Primitive] = {
        "three": Points(
            subject.p_shown[:3], "highlight", 1.6 * LOOKS[subject.kind].radius, name="three points"
        ),
    }
    if search.phase == "choose":
        scene["fourth"] = Points(
            subject.p_shown[3:4], "other", 1.6 * LOOKS[subject.kind].radius, name="the fourth point"
        )
    if subject.T_true is not None and search.phase in ("rays", "quartic"):
        eye = subject.frame.shown(camera_center(subject.T_true))
        scene["rays"] = Segments(
            between(eye, subject.p_shown[:3]), "highlight", 2.0, name="three rays"
        )
    if len(search.quartic):
        scene |= _curve(search)
    return scene


def _curve(search: Searched) -> dict[str, Primitive]:
    roots = search.lengths[:, 2] / search.lengths[:, 0]
    low, high = (roots.min(), roots.max()) if len(roots) else (0.8, 1.2)
    pad = max(0.35 * (high - low), 0.02)
    v = np.linspace(max(low - pad, 0.0), high + pad, 121)
    y = np.polyval(search.quartic, v)
    y = y / max(float(np.abs(y).max()), 1e-300)
    k = len(search.candidates)
    marks = tuple(float(root) for root in roots[k - 1 : k]) if search.phase == "root" else ()
    scene: dict[str, Primitive] = {
        "quartic": QUARTIC.curve(v, y, "quartic", "target", marks=marks),
        "quartic/zero": QUARTIC.curve(v[[0, -1]], np.zeros(2), "zero", "correspondence"),
    }
    if len(roots):
        scene["quartic/roots"] = QUARTIC.dots(roots, np.zeros(len(roots)), "roots", "highlight")
    return scene


def _candidates(state: State, search: Searched) -> dict[str, Primitive]:
    """Return the motions to choose from, as cameras with the rays to their points, and for planes
    as planes.
    """
    subject = state.subject
    scene = dict[str, Primitive]()
    if search.phase not in ("root", "both", "choose"):
        return scene
    rows = []
    for k, T in enumerate(search.candidates, 1):
        if not (np.isfinite(T).all() and is_rigid(T)):
            continue
        if state.T is None or np.abs(T - state.T).max() > 1e-9:
            scene[f"candidates/{k}"] = _camera(subject, T, "other", name="possible camera")
        if search.phase == "both" and subject.T_true is not None and subject.body is not None:
            seen = _as_seen(subject, T)
            scene[f"candidates/{k}/seen"] = Segments(
                seen, "other", 2.5, name="what it would see" if k == 1 else ""
            )
        elif state.params.method == "P3P":
            eye = subject.frame.shown(camera_center(T))
            last = k == len(search.candidates) and search.phase == "root"
            ends = between(eye, subject.p_shown[:3])
            scene[f"candidates/{k}/rays"] = Segments(
                ends, "highlight" if last else "correspondence", 2.0 if last else 1.0
            )
        degrees, _ = subject.off(T)
        miss = state.judged(T)
        where = subject.frame.shown(camera_center(T))
        off = "" if np.isnan(degrees) else angle(degrees)
        rows.append(
            (f"{k}", coordinates(where, 2), pixels(miss) if np.isfinite(miss) else "behind", off)
        )
    judged = "4th point" if state.params.method == "P3P" else "RMS error"
    scene["numbers/candidates"] = Table(
        "Possible cameras", ("", "centre (m)", judged, "off"), tuple(rows)
    )
    return scene


def _as_seen(subject: Subject, T: np.ndarray) -> np.ndarray:
    """Return the lines of the target where the true camera would have to see them, were this its
    pose.
    """
    assert subject.T_true is not None
    assert subject.body is not None
    ends = subject.body.lines.reshape(-1, 3) + subject.frame.centre
    return subject.frame.shown(apply(inverse(subject.T_true) @ T, ends)).reshape(-1, 2, 3)


def _repeated(subject: Subject, trials: Repeated) -> dict[str, Primitive]:
    scene: dict[str, Primitive] = {}
    if not len(trials.Ts):
        return scene
    right = subject.near(trials.degrees, trials.metres)
    color = Classes.marking(~right, "wrong", "wrong", others=("source", "right"))
    centres = np.stack([subject.frame.shown(camera_center(T)) for T in trials.Ts])
    if subject.kind == "marker":
        assert subject.T_true is not None
        tips = np.stack(
            [(inverse(subject.T_true) @ T)[:3, :3] @ [0.0, 0.0, 0.12] for T in trials.Ts]
        )
        scene["normals"] = Segments(
            between(np.zeros(3), tips), color, 1.5, name="normals of the marker"
        )
    else:
        near = np.linalg.norm(centres, axis=1) < 20.0
        if near.any():
            kept = Classes(color.ids[near], color.roles, color.names)
            scene["centres"] = Points(
                centres[near], kept, 1.5 * LOOKS[subject.kind].radius, name="cameras found"
            )
    scene["turns"] = TURNS.histogram(trials.degrees, 30, "pictures", "source")
    if trials.anew is not None:
        x = np.linspace(0.0, 30.0, 121)
        for name, color, degrees in zip(
            ("EPnP", "SQPnP"), ("source", "target"), trials.anew, strict=True
        ):
            scene[f"anew/{name}"] = ANEW.curve(
                x, 100.0 * (degrees <= x[:, None]).mean(axis=1), name, color
            )
    if trials.counts is not None:
        scene["solutions"] = SOLUTIONS.histogram(
            np.repeat(np.arange(5), trials.counts), np.arange(6) - 0.5, "triples", "target"
        )
    return scene


def _numbers(state: State) -> dict[str, Primitive]:
    """Return the error in the picture and those to the truth, and the pose in numbers."""
    subject, T = state.subject, state.T
    if T is None:
        return {}
    error = state.rms if np.isfinite(state.rms) else np.nan
    scene: dict[str, Primitive] = {"error": PICTURE_ERROR.scalar(error, "all points", log=True)}
    degrees, metres = state.off
    if np.isfinite(degrees):
        scene["error/turn"] = TURN_ERROR.scalar(degrees, "to the truth", "truth", log=True)
        scene["error/centre"] = CENTRE_ERROR.scalar(metres, "to the truth", "truth", log=True)
    rows = [("t", coordinates(T[:3, 3], 3)), ("C = −Rᵀt", coordinates(camera_center(T), 3))]
    if subject.T_true is not None:
        rows += [
            ("true C", coordinates(camera_center(subject.T_true), 3)),
            ("C is off by", length(metres)),
        ]
    scene["numbers"] = Table("The pose, metres", ("", "value"), tuple(rows))
    return scene
