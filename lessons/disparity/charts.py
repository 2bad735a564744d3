"""What stands beside the scene: maps and windows, the cost curve of the followed pixel, and the
numbers per step.
"""

import math

import numpy as np

from lessons.disparity.captions import distance
from lessons.disparity.matching import MapLook, chosen
from workbench.algorithms.stereo.disparity import Stage
from workbench.data.windows import side_by_side
from workbench.geometry.cameras.stereo import depth_interval
from workbench.numerals import brief, fixed
from workbench.scene import PALETTE, Chart, Field, Picture, Primitive, Table

BINS = 12
PIXELS = Chart("Pixels", unit="%")
COST = Chart("Cost per pixel")


def beside(look: MapLook) -> dict[str, Primitive]:
    """Return pictures, curves, numbers and the table of one step."""
    return {**_pictures(look), **_numbers(look), **_curves(look), "followed": _table(look)}


def _pictures(look: MapLook) -> dict[str, Primitive]:
    pictures = look.subject
    shown: dict[str, Primitive] = {}
    if look.now.piece is not None:
        costs = np.where(np.isfinite(look.now.piece), look.now.piece, np.nan).astype(np.float32)
        shown["map/slice"] = Picture(
            Field.magnitude(costs, "Cost", percent=98),
            f"Slice d = {look.now.done - 1} of the cost volume",
        )
    elif pictures.pair.disparity is not None:
        off = (look.now.disparity - pictures.pair.disparity).astype(np.float32)
        shown["map/error"] = Picture(
            Field(off, -3.0, 3.0, "Error to truth", "px", "diverging"), "Error to truth"
        )
    d = look.now.done - 1 if look.now.stage is Stage.COMPARE else chosen(look)
    if math.isfinite(d):
        pair = pictures.pair
        window = look.params.window
        frame = PALETTE["highlight"]
        image = side_by_side(
            pair.left, pair.right, pictures.pixel, d=round(d), window=window, frame=frame
        )
        shown["windows"] = Picture(
            image, f"Left window, and right window {round(d)} px further left"
        )
    return shown


def _numbers(look: MapLook) -> dict[str, Primitive]:
    pair = look.subject.pair
    known: dict[str, Primitive] = {}
    if pair.disparity is not None and pair.visible is not None:
        hidden = np.isfinite(pair.disparity) & ~pair.visible
        given_up = 100 * float(np.isnan(look.now.disparity[hidden]).mean()) if hidden.any() else 0.0
        known["hidden"] = PIXELS.scalar(given_up, "hidden, found", "other")
    return known | {
        "wrong": PIXELS.scalar(100 * look.now.wrong, "over 1 px off", "truth"),
        "unknown": PIXELS.scalar(100 * look.now.unknown, "unknown", "correspondence"),
        "lowest": COST.scalar(look.now.lowest, "mean lowest cost", "other"),
        "energy": COST.scalar(look.now.energy, "energy E(D)"),
    }


def _curves(look: MapLook) -> dict[str, Primitive]:
    pictures = look.subject
    camera = pictures.pair.camera
    u, v = pictures.pixel
    x = np.arange(pictures.max_disparity + 1.0)
    marks = (chosen(look),) if math.isfinite(chosen(look)) else ()
    chart = Chart("Cost at the followed pixel", "disparity in px", "cost")
    shown: dict[str, Primitive] = {"costs": chart.curve(x, look.now.costs, "cost", marks=marks)}
    if (
        pictures.pair.disparity is not None
        and 0 <= pictures.pair.disparity[v, u] <= pictures.max_disparity
    ):
        true = pictures.pair.disparity[v, u : u + 1]
        shown["costs/truth"] = chart.dots(
            true, np.interp(true, x, look.now.costs), "truth", "truth"
        )
    if look.now.stage is None and pictures.metric:
        d = x[x + camera.doffs >= max(camera.f * camera.baseline / pictures.far, 0.5)]
        if len(d):
            depth = pictures.f * camera.baseline / (d + camera.doffs)
            law = Chart("Depth over disparity", "disparity in px", "m")
            shown["law"] = law.curve(d, depth, "Z = f B / d", marks=marks)
    if look.now.uncertainty is not None and pictures.metric:
        shown |= _error_curves(look)
    return shown


def _error_curves(look: MapLook) -> dict[str, Primitive]:
    """Return the predicted error over depth, and beside it the measured one where the truth is
    known.
    """
    pictures = look.subject
    camera = pictures.pair.camera
    known = np.isfinite(look.now.depth) & (look.now.depth <= pictures.far)
    if not known.any():
        return {}
    chart = Chart("Depth error over depth", "depth in m", "m")
    z = np.linspace(0.0, float(look.now.depth[known].max()), 60)[1:]
    predicted = z * z / (pictures.f * camera.baseline) * look.now.disparity_error
    name = f"Z² / (f B) · {brief(look.now.disparity_error)} px"
    shown: dict[str, Primitive] = {"error/predicted": chart.curve(z, predicted, name)}
    if pictures.pair.visible is None:
        return shown
    known &= pictures.pair.visible & np.isfinite(pictures.true_depth)
    if known.sum() < 10 * BINS:
        return shown
    true = pictures.true_depth[known]
    off = np.abs(look.now.depth[known] - true)
    edges = np.unique(np.quantile(true, np.linspace(0, 1, BINS + 1)))
    bins = np.clip(np.searchsorted(edges, true, "right") - 1, 0, max(len(edges) - 2, 0))
    middles = [
        (float(np.median(true[bins == k])), float(np.median(off[bins == k])))
        for k in np.unique(bins)
    ]
    x, y = np.array(sorted(set(middles))).T
    shown["error/measured"] = chart.dots(x, y, "measured median", "truth")
    return shown


def _table(look: MapLook) -> Table:
    pictures = look.subject
    camera = pictures.pair.camera
    u, v = pictures.pixel
    depth = float(look.now.depth[v, u])
    rows = [
        ("disparity", _px(chosen(look))),
        ("depth", distance(depth) if pictures.metric else "f and baseline are not known"),
    ]
    if pictures.metric and 0 < depth < math.inf:
        error = look.now.disparity_error or 1.0
        d = np.array([pictures.f * camera.baseline / depth])
        near, far = (
            float(z[0])
            for z in depth_interval(d, pictures.f, camera.baseline, disparity_error=error)
        )
        rows.append((f"± {brief(error)} px", f"{distance(near)} to {distance(far)}"))
    if pictures.pair.disparity is not None:
        true = float(pictures.pair.disparity[v, u])
        seen = (
            ""
            if pictures.pair.visible is None or pictures.pair.visible[v, u]
            else ", hidden from the right camera"
        )
        rows.append(
            (
                "truth",
                "unknown"
                if math.isnan(true)
                else f"{_px(true)}, {distance(float(pictures.true_depth[v, u]))}{seen}",
            )
        )
    return Table(f"Left pixel ({u}, {v})", ("", "value"), tuple(rows))


def _px(d: float) -> str:
    return "unknown" if math.isnan(d) else f"{fixed(d, 2)} px"
