"""What happened at a stage, in words and numbers."""

import math

import numpy as np

from lessons.pinhole.state import State, name_of
from workbench.geometry.cameras import camera_center
from workbench.geometry.distortion import invertible_radius
from workbench.scene import Caption, Primitive, Table

VISIBLE = 0.5  # px; and metres beyond a millimetre on the way back


def caption(state: State) -> Caption:
    """Return the followed point's numbers at this stage, and what is wrong, if anything is."""
    wrong = blame(state)
    text = _STAGES[state.now.stage](state) + (wrong or _remark(state))
    return Caption(text, "wrong" if wrong else "info")


def tables(state: State) -> dict[str, Primitive]:
    """Return the followed point's journey so far, and what can be measured of the camera and in its picture."""
    shot, now, k = state.shot, state.now, state.params.point
    rows = [("in the world", f"{_triple(now.p_world[k])} m")]
    if now.reached("camera"):
        p = now.p_camera[k]
        rows += [("in the camera frame", f"{_triple(p)} m"), ("depth Z · ray length", f"{p[2]:.2f} · {_norm(p):.2f} m")]
    if now.reached("divide"):
        rows.append(("x, y = X/Z, Y/Z", _pair(now.xy[k], 4)))
    if now.reached("distort"):
        rows.append(("after the lens", _pair(now.xy_bent[k], 4)))
    if now.reached("pixels"):
        rows += [("pixel (u, v)", _pair(now.uv[k], 1)), ("true pixel", _pair(shot.uv[k], 1))]
    if now.reached("back"):
        rows.append(("back in the world", f"{_triple(now.p_back[k])} m"))
    h, w = shot.picture.shape[:2]
    measured = (
        ("camera centre C = −Rᵀt", f"{_triple(camera_center(shot.T_camera_world))} m"),
        ("t of T_camera_world", f"{_triple(shot.T_camera_world[:3, 3])} m"),
        ("focal length f", f"{shot.K[0, 0]:.1f} px"),
        ("principal point", _pair(shot.K[:2, 2], 1)),
        ("middle of the picture", _pair(np.array([w - 1, h - 1]) / 2, 1)),
        ("the rails meet at", _pair(shot.vanishing, 1)),
        ("crate, 1 m high", f"{shot.crate:.1f} px"),
        ("tower, 5 m high", f"{shot.tower:.1f} px"),
        ("the ball's outline", _ratio(shot.ball_ratio)),
    )
    return {
        "point numbers": Table("The followed point", ("stage", name_of(k)), tuple(rows)),
        "camera numbers": Table("The true camera", ("what", "value"), measured),
    }


def blame(state: State) -> str:
    """Return what is wrong at this stage, with its size; nothing while all is right."""
    params, now = state.params, state.now
    back = back_error(state)
    off = state.error > VISIBLE or state.missed + state.false > 0 or back > 1e-3
    inverted = now.stage == "camera" and params.mistake in ("pose inverted", "OpenGL axes")
    if not off and not inverted:
        return ""
    if params.mistake != "none":
        why = MISTAKES[params.mistake]
    elif not params.k_follows and params.edit != "none":
        why = "K is still that of the full picture."
    else:
        why = "The calculation differs from the camera."
    if back > 1e-3 and state.error <= VISIBLE:
        return f" {why} Half of the points come back more than {_length(back)} off."
    parts = [f"the median point is {_count(state.error)} px off"] * (state.error > VISIBLE)
    parts += [f"{state.missed} of {len(now.p_world)} points lose their pixel"] * (state.missed > 0)
    parts += [f"{_many(state.false)} a pixel although the camera cannot see {'it' if state.false == 1 else 'them'}"] * (
        state.false > 0
    )
    size = "; ".join(parts)
    return f" {why}" + (f" {size[0].upper()}{size[1:]}." if size else "")


def back_error(state: State) -> float:
    """Return the median distance of the points that came back from where they are, metres; 0 before that."""
    if not state.now.reached("back"):
        return 0.0
    miss = np.linalg.norm(state.now.p_back - state.now.p_world, axis=1)
    return float(np.median(miss[np.isfinite(miss)])) if np.isfinite(miss).any() else 0.0


MISTAKES = {
    "pose inverted": "The pose is inverted: camera-to-world stands where world-to-camera belongs.",
    "divides behind too": "What lies behind the camera was divided by its negative depth too.",
    "OpenGL axes": "The pose is OpenGL's (y up, looking along −z): depths are negative, and dividing anyway mirrors the"
    " picture.",
    "row before column": "(row, column) stands where (u, v) = (column, row) belongs.",
    "lens on pixels": "The lens was given pixels, not normalised coordinates: r² is f² times too large.",
    "t for the centre": "t is not where the camera is; C = −Rᵀt is.",
    "ray length for depth": "The length of the ray was taken for the depth Z.",
}


def _world(state: State) -> str:
    p, name = state.now.p_world[state.params.point], name_of(state.params.point)
    return (
        f"{len(state.now.p_world)} points of the street in world coordinates, z up. We follow {name}: {_triple(p)} m."
    )


def _camera(state: State) -> str:
    p = state.now.p_camera[state.params.point]
    return (
        f"R p + t is the point in the camera's frame (x right, y down, z forward): {_triple(p)} m. Its depth is"
        f" Z = {p[2]:.2f} m; along its ray it is {_norm(p):.2f} m away."
    )


def _divide(state: State) -> str:
    k, z = state.params.point, state.now.p_camera[state.params.point, 2]
    if not np.isfinite(state.now.xy[k]).all():
        return f"The point lies behind the camera, Z = {z:.2f} m: no ray through the picture meets it, so it gets none."
    return (
        f"Divided by Z = {z:.2f} m the point is at (x, y) = {_pair(state.now.xy[k], 3)} on the plane one metre in front"
        f" of the camera. {state.found} of {len(state.now.xy)} points have a place there."
    )


def _distort(state: State) -> str:
    k, f = state.params.point, state.shot.K[0, 0]
    if not any(state.shot.lens):
        return "A lens without distortion: k1 = k2 = p1 = p2 = 0, and (x', y') = (x, y)."
    moved = f * np.linalg.norm(state.now.xy_bent - state.now.xy, axis=1)
    most = f"the farthest-moved point goes {_count(np.nanmax(moved))} px" if np.isfinite(moved).any() else "nothing is"
    if not np.isfinite(moved[k]):
        return f"The followed point has no place on the lens; {most}."
    inwards = _norm(state.now.xy_bent[k]) < _norm(state.now.xy[k])
    where = "" if moved[k] < 0.05 else " towards the middle" if inwards else " away from the middle"
    return (
        f"The lens moves the point {_count(moved[k])} px{where}, to (x', y') = {_pair(state.now.xy_bent[k], 3)};"
        f" {most}. It acts here, before f."
    )


def _pixels(state: State) -> str:
    k, h, w = state.params.point, *state.shot.picture.shape[:2]
    inside = np.all((state.now.uv > -0.5) & (state.now.uv < np.array([w, h]) - 0.5), axis=1)
    many = f"{np.count_nonzero(inside)} of {len(state.now.uv)} points fall into the {w} × {h} picture."
    if not np.isfinite(state.now.uv[k]).all():
        return f"K makes pixels of what is left; the followed point has none. {many}"
    u, v = state.now.uv[k]
    return f"K makes the pixel: f x' + cx gives column u = {u:.1f}, row v = {v:.1f}. {many}"


def _back(state: State) -> str:
    k, now = state.params.point, state.now
    if not np.isfinite(now.p_back[k]).all():
        return "From pixels back to rays: the followed point has no pixel, so nothing leads back to it."
    return (
        f"Back from the pixel: a ray leaves the camera at {_triple(now.p_center)} m, and every point on it has this pixel."
        f" With its depth we come out {_length(_norm(now.p_back[k] - now.p_world[k]))} from where we began."
    )


_STAGES = {
    "world": _world, "camera": _camera, "divide": _divide, "distort": _distort, "pixels": _pixels, "back": _back,
}  # fmt: skip


def _remark(state: State) -> str:
    """Return one more sentence where this camera is a special one."""
    shot, params, stage = state.shot, state.params, state.now.stage
    fold = invertible_radius(shot.lens)
    if stage == "distort" and fold < 1.4:
        return f" Beyond radius {fold:.2f} this model folds back; what lies there has no pixel."
    if stage == "pixels" and params.dolly >= 10 and math.isfinite(shot.gap):
        return f" No corner is more than {shot.gap:.1f} px from its orthographic pixel."
    if stage == "pixels" and params.dolly != 1:
        return (
            f" The crate is {shot.crate:.0f} px high as before; the tower was {shot.tower_before:.0f} px high and is"
            f" {shot.tower:.0f} px now."
        )
    if stage == "pixels" and params.point in (3, 4) and np.isfinite(shot.vanishing).all():
        return f" The rails stay 1.5 m apart; their pictures meet at {_pair(shot.vanishing, 1)}."
    if stage == "pixels" and shot.ball_ratio > 1.2:
        return f" The ball's outline is {shot.ball_ratio:.2f} times as long as wide."
    return ""


def _many(n: int) -> str:
    return "1 point has" if n == 1 else f"{n} points have"


def _triple(p: np.ndarray) -> str:
    return "(" + ", ".join(f"{value:.2f}" for value in p) + ")"


def _pair(p: np.ndarray, digits: int) -> str:
    return "none" if not np.isfinite(p).all() else "(" + ", ".join(f"{value:.{digits}f}" for value in p) + ")"


def _ratio(ratio: float) -> str:
    return f"{ratio:.3f} × as long as wide" if math.isfinite(ratio) else "not in the picture"


def _norm(v: np.ndarray) -> float:
    return float(np.linalg.norm(v))


def _length(metres: float) -> str:
    return f"{1000 * metres:.1f} mm" if metres < 0.1 else f"{metres:,.2f} m"


def _count(pixels: float) -> str:
    return f"{pixels:.1f}" if pixels < 100 else f"{pixels:,.0f}"
