"""What happened at a stage, in words and numbers."""

import math

import numpy as np

from lessons.pinhole.state import Shot, State, name_of
from workbench.geometry.cameras.distortion import invertible_radius
from workbench.geometry.motions import apply
from workbench.numerals import coordinates, counted, fixed, fixed_or_power, length, pixels
from workbench.scene import Caption

VISIBLE = 0.5  # px: a smaller median error is not blamed on anybody
MISPLACED = 1e-3  # m, likewise on the way back
SAME = 1e-6  # m: what rounding leaves of a way out and back


def caption(state: State) -> Caption:
    """Return the followed point's numbers at this stage, and what is wrong, if anything is.

    A mistake that was asked for is no alarm.
    """
    wrong, params = blame(state), state.params
    text = _STAGES[state.now.stage](state) + (wrong or _remark(state))
    return Caption(
        text, "wrong" if wrong and params.mistake == "none" and params.k_follows else "info"
    )


def blame(state: State) -> str:
    """Return what is wrong at this stage, with its size; nothing while all is right."""
    params, now = state.params, state.now
    back = back_error(state)
    moved = now.stage == "camera" and not np.allclose(
        now.p_camera, apply(state.shot.T_camera_world, now.p_world)
    )
    if not (moved or state.error > VISIBLE or state.missed + state.false > 0 or back > MISPLACED):
        return ""
    if params.mistake != "none":
        why = MISTAKES[params.mistake]
    elif not params.k_follows and params.edit != "none":
        why = "K is still that of the full picture."
    else:
        why = "The calculation differs from the true camera."
    parts = []
    if state.error > VISIBLE:
        parts.append(f"the pixels are off by {pixels(state.error)} (median)")
    if state.missed:
        parts.append(f"{state.missed} of {len(now.p_world)} points lose their pixel")
    if state.false:
        parts.append(
            f"{counted(state.false, 'point has', 'points have')} a pixel that the true camera does"
            " not give"
        )
    if not parts and back > MISPLACED:
        parts.append(f"the points that come back are off by {length(back)} (median)")
    size = "; ".join(parts)
    return f" {why}" + (f" {size[0].upper()}{size[1:]}." if size else "")


def back_error(state: State) -> float:
    """Return the median distance of the points that came back from where they are, metres; 0 before
    that.
    """
    if not state.now.reached("back"):
        return 0.0
    miss = np.linalg.norm(state.now.p_back - state.now.p_world, axis=1)
    return float(np.median(miss[np.isfinite(miss)])) if np.isfinite(miss).any() else 0.0


MISTAKES = {
    "pose inverted": "The pose is inverted: camera-to-world stands where world-to-camera belongs.",
    "divides behind too": "What lies behind the camera was divided by its negative depth too.",
    "OpenGL axes": (
        "The pose is OpenGL's (y up, looking along −z): depths ahead are negative, dividing"
        " mirrors."
    ),
    "row before column": "(row, column) stands where (u, v) = (column, row) belongs.",
    "lens on pixels": (
        "The lens was given pixels, not normalised coordinates: r² is f² times too large."
    ),
    "t for the centre": "t is not where the camera is; C = −Rᵀt is.",
    "ray length for depth": "The length of the ray was taken for the depth Z.",
}


def _world(state: State) -> str:
    p, name = state.now.p_world[state.params.point], name_of(state.params.point)
    where = coordinates(p, 2)
    return (
        f"{len(state.now.p_world)} points of the street in world coordinates, z up. We follow"
        f" {name}: {where} m."
    )


def _camera(state: State) -> str:
    p = state.now.p_camera[state.params.point]
    return (
        "R p + t is the point in the camera's frame (x right, y down, z forward):"
        f" {coordinates(p, 2)} m. Its depth is Z = {depth(p[2])}; along its ray it is"
        f" {depth(_norm(p))} away."
    )


def _divide(state: State) -> str:
    k, z = state.params.point, state.now.p_camera[state.params.point, 2]
    if not np.isfinite(state.now.xy[k]).all():
        where = "is not in front of" if z <= 0 else "is in front of"
        return (
            f"The point {where} the camera, Z = {depth(z)}, and gets no place on the plane one"
            " metre in front."
        )
    return (
        f"Divided by Z = {depth(z)} the point is at (x, y) = {coordinates(state.now.xy[k], 3)} on"
        f" the plane one metre in front of the camera. {state.found} of {len(state.now.xy)} points"
        " have a place there."
    )


def _distort(state: State) -> str:
    k, f = state.params.point, state.shot.K[0, 0]
    moved = f * np.linalg.norm(state.now.xy_bent - state.now.xy, axis=1)
    if not any(state.shot.lens) and not (moved > VISIBLE).any():
        return "A lens without distortion: k₁ = k₂ = p₁ = p₂ = 0, and (x′, y′) = (x, y)."
    most = (
        f"the farthest goes {pixels(np.nanmax(moved))}"
        if np.isfinite(moved).any()
        else "nothing is"
    )
    if not np.isfinite(moved[k]):
        return f"The followed point has no place on the lens; {most}."
    nearer = _norm(state.now.xy_bent[k]) < _norm(state.now.xy[k])
    where = (
        ""
        if moved[k] < 0.05
        else f", {'nearer to' if nearer else 'further from'} the principal point"
    )
    return (
        f"The lens moves the point {pixels(moved[k])}{where}: (x′, y′) ="
        f" {coordinates(state.now.xy_bent[k], 3)}; {most}. It acts here, before f."
    )


def _pixels(state: State) -> str:
    k, h, w = state.params.point, *state.shot.picture.shape[:2]
    inside = np.all((state.now.uv > -0.5) & (state.now.uv < np.array([w, h]) - 0.5), axis=1)
    many = (
        f"{np.count_nonzero(inside)} of {len(state.now.uv)} points fall into the {w} × {h} picture."
    )
    if not np.isfinite(state.now.uv[k]).all():
        return f"K makes pixels of what is left; the followed point has none. {many}"
    u, v = (fixed_or_power(value, 1) for value in state.now.uv[k])
    return f"K (x′, y′, 1) is the pixel: column u = {u}, row v = {v}. {many}"


def _back(state: State) -> str:
    k, now = state.params.point, state.now
    if not np.isfinite(now.p_back[k]).all():
        return (
            "From pixels back to rays: the followed point has no pixel, so nothing leads back"
            " to it."
        )
    given = f"With its depth Z = {depth(now.p_camera[k, 2])}"
    if state.params.mistake == "ray length for depth":
        given = f"With {depth(_norm(now.p_camera[k]))} for its depth"
    miss = _norm(now.p_back[k] - now.p_world[k])
    off = "where we began" if miss < SAME else f"{length(miss)} from where we began"
    return (
        f"Back from the pixel: it gives a ray from {coordinates(now.p_center, 2)} m, but not how"
        f" far to go along it. {given} we come out {off}."
    )


_STAGES = {
    "world": _world,
    "camera": _camera,
    "divide": _divide,
    "distort": _distort,
    "pixels": _pixels,
    "back": _back,
}


def _remark(state: State) -> str:
    """Return one more sentence where this camera is a special one."""
    shot, params, stage = state.shot, state.params, state.now.stage
    fold, bare = invertible_radius(shot.lens), " Without the lens" if any(shot.lens) else ""
    if stage == "distort" and fold < 1.4:
        return (
            f" Beyond radius {fixed(fold, 3)} this model folds back; what lies there has no pixel."
        )
    if stage == "pixels" and params.dolly >= 10 and math.isfinite(shot.gap):
        start = f"{bare} no" if bare else " No"
        return (
            f"{start} corner in front of it is more than {pixels(shot.gap)} from its orthographic"
            " pixel."
        )
    if stage == "pixels" and params.dolly != 1:
        return _heights(shot)
    if stage == "pixels" and params.point in (3, 4) and np.isfinite(shot.vanishing).all():
        return (
            " The rails stay 1.5 m apart; their pictures run towards"
            f" {coordinates(shot.vanishing, 1)}."
        )
    if stage == "pixels" and shot.ball_ratio > 1.2:
        return (
            f"{bare or ' Here'} the ball's outline is {fixed(shot.ball_ratio, 2)} times as long as"
            " wide."
        )
    return ""


def _heights(shot: Shot) -> str:
    """Say what moving the camera did to the crate and the tower, as far as both pictures show
    them.
    """
    heights = {"crate": (shot.crate_before, shot.crate), "tower": (shot.tower_before, shot.tower)}
    said = [
        f"the {name} was {pixels(before)} high and is {pixels(now)} now"
        for name, (before, now) in heights.items()
        if math.isfinite(before) and math.isfinite(now)
    ]
    return f" T{'; '.join(said)[1:]}." if said else ""


def depth(metres: float) -> str:
    """Write a depth with as many decimals as the points beside it, unless that would say
    nothing.
    """
    return f"{fixed_or_power(metres, 2)} m" if abs(metres) >= 0.01 else length(metres)


def _norm(v: np.ndarray) -> float:
    return float(np.linalg.norm(v))
