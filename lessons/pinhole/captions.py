"""What happened at a stage: a sentence with its numbers, and what is wrong, if anything is."""

import math
from typing import Any

import numpy as np

from lessons.pinhole.inputs import Input
from lessons.pinhole.models import State
from lessons.pinhole.shot import Shot
from workbench.captions import Quantity, counted, fixed, metres, pixels
from workbench.geometry.cameras.distortion import invertible_radius
from workbench.geometry.motions import apply
from workbench.lesson import Look, say
from workbench.numerals import fixed as fixed_places
from workbench.numerals import fixed_or_power, length
from workbench.scene import Caption

VISIBLE = 0.5  # px: a smaller median error is not blamed on anybody
MISPLACED = 1e-3  # m, likewise on the way back
SAME = 1e-6  # m: what rounding leaves of a way out and back
PLACES = {
    "camera": "camera axes",
    "distort": "lens",
    "back": "way back",
}
MISTAKES = {
    "pose inverted": "The pose is inverted: camera-to-world stands where world-to-camera belongs.",
    "divides behind too": "What lies behind the camera was divided by its negative depth too.",
    "OpenGL axes": "The pose is OpenGL's, so depths ahead are negative and dividing mirrors.",
    "row before column": "(row, column) stands where (u, v) = (column, row) belongs.",
    "lens on pixels": "The lens was given pixels, so r² is f² times too large.",
    "t for the centre": "t is not where the camera is; C = −Rᵀt is.",
    "ray length for depth": "The length of the ray was taken for the depth Z.",
}
PinholeLook = Look[Input, Shot, State]
Told = tuple[str, dict[str, Any]]


def caption(look: PinholeLook) -> Caption:
    """Return the followed point's numbers at this stage, and what is wrong, if anything is.

    A mistake that was asked for is no alarm.
    """
    params = look.params
    stage = look.now.now.stage
    words, values = _STAGES[stage](look)
    more, others = blame(look)
    alarm = more and params.mistake == "none" and not params.forgets_k
    if not more:
        more, others = _remark(look)
    if stage == "pixels" and more and not alarm and params.mistake == "none":
        # what this camera is about, and not one of its points
        words = ""
        values = {}
    tone = "wrong" if alarm else "info"
    place = PLACES.get(stage, stage)
    return say((words + more).strip(), tone=tone, place=place, **values, **others)


def blame(look: PinholeLook) -> Told:
    """Return what is wrong at this stage, with its size; nothing while all is right."""
    params = look.params
    state = look.now
    calculated = look.now.now
    back = back_error(look)
    true = apply(look.subject.T_camera_world, calculated.p_world)
    moved = calculated.stage == "camera" and not np.allclose(calculated.p_camera, true)
    if not (moved or state.error > VISIBLE or state.missed + state.false or back > MISPLACED):
        return "", {}
    why = "The calculation differs from the true camera."
    if params.mistake != "none":
        why = MISTAKES[params.mistake]
    elif params.forgets_k:
        why = "K is still that of the full picture."
    if params.mistake == "none" and _slides(look):
        across, down = (pixels(float(by)) for by in _slid(look.subject))
        words = " The outlines are {across} too far right and {down} too low."
        return f" {why}{words}", {"across": across, "down": down}
    if state.error > VISIBLE:
        return f" {why} Half of the points are off by {{error}} or more.", {
            "error": pixels(state.error)
        }
    if state.missed:
        lost = counted(state.missed, "point loses its pixel", "points lose their pixel")
        return f" {why} {{missed}}.", {"missed": lost}
    if state.false:
        gained = counted(state.false, "point gets", "points get")
        them = "it" if state.false == 1 else "them"
        return f" {why} {{false}} a pixel, though the camera cannot see {them}.", {"false": gained}
    if back > MISPLACED:
        return f" {why} Half of the points come back {{apart}} off or more.", {
            "apart": metres(back)
        }
    return f" {why}", {}


def _slides(look: PinholeLook) -> bool:
    """Tell whether all pixels are off alike, by what the crop took away."""
    shot, params = look.subject, look.params
    if not params.forgets_k or params.edit != "cropped":
        return False
    return np.allclose(look.now.now.uv, shot.uv + _slid(shot), equal_nan=True)


def _slid(shot: Shot) -> np.ndarray:
    """Return how far the principal point of the full picture is from that of the edited one, px."""
    return shot.K_first[:2, 2] - shot.K[:2, 2]


def back_error(look: PinholeLook) -> float:
    """Return the median distance of points that came back from where they are; 0 before that."""
    state = look.now.now
    if not state.reached("back"):
        return 0.0
    miss = np.linalg.norm(state.p_back - state.p_world, axis=1)
    return float(np.median(miss[np.isfinite(miss)])) if np.isfinite(miss).any() else 0.0


def _world(look: PinholeLook) -> Told:
    if _is_cropped(look):
        return _cropped(look)
    deep = float(apply(look.subject.T_camera_world, look.now.now.p_world[look.subject.k])[2])
    words = f"We follow {look.subject.name}, "
    if deep < 0:
        return words + "{behind} behind the camera.", {"behind": metres(-deep)}
    return words + "{deep} deep in the street.", {"deep": metres(deep)}


def _is_cropped(look: PinholeLook) -> bool:
    """Tell whether what was done to the picture is told, and no mistake."""
    return "cropped" in look.params.edit and look.params.mistake == "none"


def _cropped(look: PinholeLook) -> Told:
    words = "The picture now begins {cut} columns further right"
    words += ", and is half as large." if "half" in look.params.edit else "."
    return words, {"cut": look.params.cut}


def _camera(look: PinholeLook) -> Told:
    if _is_cropped(look):
        return _cropped(look)
    z = _metres(look.now.now.p_camera[look.subject.k, 2])
    return f"In the camera's axes {look.subject.name} has a depth of Z = {{z}}.", {"z": z}


def _divide(look: PinholeLook) -> Told:
    k = look.subject.k
    state = look.now.now
    z = float(state.p_camera[k, 2])
    if not np.isfinite(state.xy[k]).all():
        where = "not in front of" if z <= 0 else "in front of"
        return f"Z = {{z}}: it is {where} the camera, and gets no place on the pane.", {
            "z": _metres(z)
        }
    x, y = (fixed(value, 3) for value in state.xy[k])
    words = f"Divided by its depth Z, {look.subject.name} has x = {{x}}, y = {{y}}."
    return words, {"x": x, "y": y}


def _distort(look: PinholeLook) -> Told:
    k = look.subject.k
    state = look.now.now
    shot = look.subject
    moved = shot.K[0, 0] * np.linalg.norm(state.xy_bent - state.xy, axis=1)
    if not any(shot.lens) and not (moved > VISIBLE).any():
        return "This lens bends nothing: x′ = x and y′ = y.", {}
    if not np.isfinite(moved).any():
        return "No point has a place behind the lens.", {}
    most = pixels(float(np.nanmax(moved)))
    if not np.isfinite(moved[k]):
        return "The followed point has no place behind the lens; the farthest moves {most}.", {
            "most": most
        }
    inward = np.linalg.norm(state.xy_bent[k]) < np.linalg.norm(state.xy[k])
    if moved[k] < 0.05:
        direction = ""
    elif inward:
        direction = " inwards"
    else:
        direction = " outwards"
    words = f"The lens moves {shot.name} by {{moved}}{direction}."
    return words, {"moved": pixels(float(moved[k]))}


def _pixels(look: PinholeLook) -> Told:
    uv = look.now.now.uv[look.subject.k]
    if not np.isfinite(uv).all():
        return "K makes pixels of what is left; the followed point has none.", {}
    u, v = (Quantity(float(value), fixed_or_power(value, 1)) for value in uv)
    words = f"K puts {look.subject.name} at column u = {{u}}, row v = {{v}}."
    return words, {"u": u, "v": v}


def _back(look: PinholeLook) -> Told:
    k = look.subject.k
    state = look.now.now
    if not np.isfinite(state.p_back[k]).all():
        return "The followed point has no pixel, so nothing leads back to it.", {}
    z = float(state.p_camera[k, 2])
    if look.params.mistake == "ray length for depth":
        z = float(np.linalg.norm(state.p_camera[k]))
    miss = float(np.linalg.norm(state.p_back[k] - state.p_world[k]))
    words = "The pixel gives a ray, but no depth. With {z} we come out "
    if miss < SAME:
        return words + "where we began.", {"z": _metres(z)}
    return words + "{miss} from where we began.", {"z": _metres(z), "miss": metres(miss)}


_STAGES = {
    "world": _world,
    "camera": _camera,
    "divide": _divide,
    "distort": _distort,
    "pixels": _pixels,
    "back": _back,
}


def _remark(look: PinholeLook) -> Told:
    """Return one more sentence where this camera is a special one."""
    shot = look.subject
    params = look.params
    stage = look.now.now.stage
    fold = invertible_radius(shot.lens)
    without = " without the lens" * any(shot.lens)
    if stage == "distort" and fold < 1.4:
        words = " Beyond radius {fold} there is no pixel."
        return words, {"fold": fixed(fold, 3)}
    if stage != "pixels":
        return "", {}
    if params.heights and math.isfinite(shot.crate) and math.isfinite(shot.tower):
        words = " The crate is {crate} high, the tower {tower}."
        values = {"crate": whole_pixels(shot.crate), "tower": whole_pixels(shot.tower)}
        return words, values
    if params.dolly >= 10 and math.isfinite(shot.gap):
        words = f" No corner in front is farther than {{gap}} from its orthographic pixel{without}."
        return words, {"gap": pixels(shot.gap)}
    if params.point in (3, 4) and np.isfinite(shot.vanishing).all():
        u, v = (fixed(value, 1) for value in shot.vanishing)
        return " The rails meet at ({rail_u}, {rail_v}).", {"rail_u": u, "rail_v": v}
    if shot.ball_ratio > 1.2:
        words = f" The ball's outline is {{ratio}} times as long as wide{without}."
        return words, {"ratio": fixed(shot.ball_ratio, 2)}
    return "", {}


def whole_pixels(value: float) -> Quantity:
    """Return a height in the picture without decimals, as the pane says it too."""
    return Quantity(value, f"{fixed_places(value, 0)} px")


def depth(value: float) -> str:
    """Write a depth with as many decimals as the points beside it, unless that would say
    nothing.
    """
    return f"{fixed_or_power(value, 2)} m" if abs(value) >= 0.01 else length(value)


def _metres(value: float) -> Quantity:
    return Quantity(float(value), depth(float(value)))
