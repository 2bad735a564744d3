"""What stands beside the scene: maps and windows, the cost curve of the followed pixel, and the
numbers per step.
"""

import math

import numpy as np

from lessons.disparity.captions import distance
from lessons.disparity.state import State
from workbench.algorithms.stereo.disparity import Stage
from workbench.data.windows import side_by_side
from workbench.geometry.cameras.stereo import depth_interval
from workbench.numerals import brief, fixed
from workbench.scene import PALETTE, Chart, Field, Picture, Primitive, Table

BINS = 12
PIXELS, COST = Chart("Pixels", unit="%"), Chart("Cost per pixel")


def beside(state: State) -> dict[str, Primitive]:
    """Return pictures, curves, numbers and the table of one step."""
    return {**_pictures(state), **_numbers(state), **_curves(state), "followed": _table(state)}


def _pictures(state: State) -> dict[str, Primitive]:
    setup = state.setup
    shown: dict[str, Primitive] = {}
    if state.piece is not None:
        costs = np.where(np.isfinite(state.piece), state.piece, np.nan).astype(np.float32)
        shown["map/slice"] = Picture(
            Field.magnitude(costs, "Cost", percent=98),
            f"Slice d = {state.done - 1} of the cost volume",
        )
    elif setup.pair.disparity is not None:
        off = (state.disparity - setup.pair.disparity).astype(np.float32)
        shown["map/error"] = Picture(
            Field(off, -3.0, 3.0, "Error to truth", "px", "diverging"), "Error to truth"
        )
    d = state.done - 1 if state.stage is Stage.COMPARE else state.chosen
    if math.isfinite(d):
        pair, window = setup.pair, setup.params.window
        frame = PALETTE["highlight"]
        image = side_by_side(pair.left, pair.right, setup.pixel, round(d), window, frame=frame)
        shown["windows"] = Picture(
            image, f"Left window, and right window {round(d)} px further left"
        )
    return shown


def _numbers(state: State) -> dict[str, Primitive]:
    return {
        "wrong": PIXELS.scalar(100 * state.wrong, "over 1 px off", "truth"),
        "unknown": PIXELS.scalar(100 * state.unknown, "unknown", "correspondence"),
        "lowest": COST.scalar(state.lowest, "mean lowest cost", "other"),
        "energy": COST.scalar(state.energy, "energy E(D)"),
    }


def _curves(state: State) -> dict[str, Primitive]:
    setup = state.setup
    camera, (u, v) = setup.pair.camera, setup.pixel
    x = np.arange(setup.max_disparity + 1.0)
    marks = (state.chosen,) if math.isfinite(state.chosen) else ()
    chart = Chart("Cost at the followed pixel", "disparity in px", "cost")
    shown: dict[str, Primitive] = {"costs": chart.curve(x, state.costs, "cost", marks=marks)}
    if setup.pair.disparity is not None and 0 <= setup.pair.disparity[v, u] <= setup.max_disparity:
        true = setup.pair.disparity[v, u : u + 1]
        shown["costs/truth"] = chart.dots(true, np.interp(true, x, state.costs), "truth", "truth")
    if state.stage is None and setup.metric:
        d = x[x + camera.doffs >= max(camera.f * camera.baseline / setup.far, 0.5)]
        if len(d):
            depth = setup.f * camera.baseline / (d + camera.doffs)
            law = Chart("Depth over disparity", "disparity in px", "m")
            shown["law"] = law.curve(d, depth, "Z = f B / d", marks=marks)
    if state.uncertainty is not None and setup.metric:
        shown |= _error_curves(state)
    return shown


def _error_curves(state: State) -> dict[str, Primitive]:
    """Return the predicted error over depth, and beside it the measured one where the truth is
    known.
    """
    setup = state.setup
    camera = setup.pair.camera
    known = np.isfinite(state.depth) & (state.depth <= setup.far)
    if not known.any():
        return {}
    chart = Chart("Depth error over depth", "depth in m", "m")
    z = np.linspace(0.0, float(state.depth[known].max()), 60)[1:]
    predicted = z * z / (setup.f * camera.baseline) * state.disparity_error
    name = f"Z² / (f B) · {brief(state.disparity_error)} px"
    shown: dict[str, Primitive] = {"error/predicted": chart.curve(z, predicted, name)}
    if setup.pair.visible is None:
        return shown
    known &= setup.pair.visible & np.isfinite(setup.true_depth)
    if known.sum() < 10 * BINS:
        return shown
    true = setup.true_depth[known]
    off = np.abs(state.depth[known] - true)
    edges = np.unique(np.quantile(true, np.linspace(0, 1, BINS + 1)))
    bins = np.clip(np.searchsorted(edges, true, "right") - 1, 0, max(len(edges) - 2, 0))
    middles = [
        (float(np.median(true[bins == k])), float(np.median(off[bins == k])))
        for k in np.unique(bins)
    ]
    x, y = np.array(sorted(set(middles))).T
    shown["error/measured"] = chart.dots(x, y, "measured median", "truth")
    return shown


def _table(state: State) -> Table:
    setup = state.setup
    camera, (u, v) = setup.pair.camera, setup.pixel
    depth = float(state.depth[v, u])
    rows = [
        ("disparity", _px(state.chosen)),
        ("depth", distance(depth) if setup.metric else "f and baseline are not known"),
    ]
    if setup.metric and 0 < depth < math.inf:
        error = state.disparity_error or 1.0
        d = np.array([setup.f * camera.baseline / depth])
        near, far = (
            float(z[0]) for z in depth_interval(d, setup.f, camera.baseline, disparity_error=error)
        )
        rows.append((f"± {brief(error)} px", f"{distance(near)} to {distance(far)}"))
    if setup.pair.disparity is not None:
        true = float(setup.pair.disparity[v, u])
        seen = (
            ""
            if setup.pair.visible is None or setup.pair.visible[v, u]
            else ", hidden from the right camera"
        )
        rows.append(
            (
                "truth",
                "unknown"
                if math.isnan(true)
                else f"{_px(true)}, {distance(float(setup.true_depth[v, u]))}{seen}",
            )
        )
    return Table(f"Left pixel ({u}, {v})", ("", "value"), tuple(rows))


def _px(d: float) -> str:
    return "unknown" if math.isnan(d) else f"{fixed(d, 2)} px"
