"""The charts and tables beside the street."""

import math
from dataclasses import replace

import numpy as np

from lessons.pinhole.captions import PinholeLook, depth
from lessons.pinhole.inputs import Input
from lessons.pinhole.shot import gap, heights
from workbench.geometry.cameras import camera_center
from workbench.geometry.cameras.distortion import distort, invertible_radius
from workbench.lesson import cached
from workbench.numerals import coordinates, fixed
from workbench.scene import Chart, Primitive, Table

HEIGHTS = Chart("Heights in the picture", "how many times the distance", "px", x_range=(0.5, 10.0))
GAP = Chart("Gap to orthographic", "how many times the distance", "px", x_range=(1.0, 50.0))
LENS = Chart("Radius with the lens", "radius without the lens", x_range=(0.0, 1.4))
ERROR = Chart("Error of this stage", unit="px")
BY = np.geomspace(0.5, 10.0, 40)
FARTHER = np.geomspace(1.0, 50.0, 18)
RADII = np.linspace(0.0, 1.4, 57)


@cached
def heights_by_dolly(params: Input) -> np.ndarray:
    """Return the heights (2, 40) of crate and tower for each of BY."""
    return np.array([heights(params, float(by)) for by in BY]).T


@cached
def gaps(params: Input) -> np.ndarray:
    """Return the gap to the orthographic picture for each of FARTHER."""
    return np.array([gap(params, float(by)) for by in FARTHER])


def charts(look: PinholeLook) -> dict[str, Primitive]:
    """Return the error of this stage, and the chart that tells most about this camera."""
    params, shot = look.params, look.subject
    parts: dict[str, Primitive] = {
        "error": ERROR.scalar(look.now.error, "median of all points", "truth")
    }
    if params.heights:
        crate, tower = heights_by_dolly(params)
        shown = np.isfinite(crate) & np.isfinite(tower)
        if shown.sum() > 1:
            chart = replace(HEIGHTS, y_range=(0.0, 1.1 * float(tower[shown].max())))
            parts["heights/crate"] = chart.whole(BY[shown], crate[shown], "crate", "target")
            parts["heights/tower"] = chart.whole(BY[shown], tower[shown], "tower", "source")
            if math.isfinite(shot.tower) and 0.5 <= params.dolly <= 10.0:
                parts["heights/here"] = chart.mark(params.dolly, shot.tower, "here", knob="dolly")
        return parts
    if params.dolly != 1 and math.isfinite(shot.gap):
        known = gaps(params)
        shown = np.isfinite(known)
        parts["gap/whole"] = GAP.whole(FARTHER[shown], known[shown], "largest gap", "truth")
        parts["gap/here"] = GAP.mark(params.dolly, shot.gap, "here", knob="dolly")
        return parts
    return parts | _lens(look)


def _lens(look: PinholeLook) -> dict[str, Primitive]:
    """Return the distorted over the ideal radius along +x; where it turns down the lens folds."""
    lens = look.subject.lens
    bent = distort(np.column_stack([RADII, np.zeros_like(RADII)]), *lens)[:, 0]
    fold = invertible_radius(lens)
    parts: dict[str, Primitive] = {
        "lens/whole": LENS.whole(RADII, bent, "this lens"),
        "lens/second": LENS.second(RADII, RADII, "no lens"),
    }
    r = float(np.linalg.norm(look.subject.xy[look.subject.k]))
    if r < RADII[-1]:
        parts["lens/here"] = LENS.mark(
            r, float(np.interp(r, RADII, bent)), "followed point", "highlight"
        )
    if fold < RADII[-1]:
        parts["lens/fold"] = LENS.band(fold, RADII[-1], "folded: no pixel", "wrong")
    return parts


def tables(look: PinholeLook) -> dict[str, Primitive]:
    """Return the followed point's journey so far, and what can be measured of the camera."""
    shot = look.subject
    state = look.now.now
    k = look.subject.k
    rows = [("in the world", f"{coordinates(state.p_world[k], 2)} m")]
    if state.reached("camera"):
        p = state.p_camera[k]
        rows += [
            ("in the camera frame", f"{coordinates(p, 2)} m"),
            ("depth Z · ray length", f"{depth(p[2])} · {depth(float(np.linalg.norm(p)))}"),
        ]
    if state.reached("divide"):
        rows.append(("x, y = X/Z, Y/Z", coordinates(state.xy[k], 4)))
    if state.reached("distort"):
        rows.append(("after the lens", coordinates(state.xy_bent[k], 4)))
    if state.reached("pixels"):
        rows += [
            ("pixel (u, v)", coordinates(state.uv[k], 1)),
            ("true pixel", coordinates(shot.uv[k], 1)),
        ]
    if state.reached("back"):
        metres = " m" * bool(np.isfinite(state.p_back[k]).all())
        rows.append(("back in the world", coordinates(state.p_back[k], 2) + metres))
    measured = (
        ("camera centre C = −Rᵀt", f"{coordinates(camera_center(shot.T_camera_world), 2)} m"),
        ("t of T_camera_world", f"{coordinates(shot.T_camera_world[:3, 3], 2)} m"),
        ("focal length f", f"{fixed(shot.K[0, 0], 1)} px"),
        ("principal point", coordinates(shot.K[:2, 2], 1)),
        ("the rails run towards", coordinates(shot.vanishing, 1)),
    )
    return {
        "point numbers": Table("The followed point", ("stage", shot.name), tuple(rows)),
        "camera numbers": Table("The true camera", ("what", "value"), measured),
    }
