"""What stands beside the scene: maps and windows, the cost curve of the followed pixel, and the numbers per step."""

import math

import numpy as np

from lessons.disparity.state import State
from lessons.disparity.words import distance
from workbench.algorithms.disparity import Stage
from workbench.geometry.stereo import depth_interval
from workbench.numerals import brief, fixed
from workbench.scene import PALETTE, Curve, Field, Picture, Primitive, Scalar, Table

BINS = 12
GAP = 2
LEAST_SPAN = 60.0  # grey levels: noise alone shall not look like a texture


def beside(state: State) -> dict[str, Primitive]:
    """Return pictures, curves, numbers and the table of one step."""
    return {**_pictures(state), **_numbers(state), **_curves(state), "followed": _table(state)}


def _pictures(state: State) -> dict[str, Primitive]:
    setup = state.setup
    shown: dict[str, Primitive] = {}
    if state.piece is not None:
        known = state.piece[np.isfinite(state.piece)]
        slice_field = Field(_no_infinity(state.piece), 0.0, max(float(np.percentile(known, 98)), 1e-6), "Cost")
        shown["map/slice"] = Picture(slice_field, f"Slice d = {state.done - 1} of the cost volume")
    elif setup.pair.disparity is not None:
        off = (state.disparity - setup.pair.disparity).astype(np.float32)
        shown["map/error"] = Picture(Field(off, -3.0, 3.0, "Error to truth", "px", "diverging"), "Error to truth")
    d = state.done - 1 if state.stage is Stage.COMPARE else state.chosen
    if math.isfinite(d):
        pair, window = setup.pair, setup.params.window
        image = patches(pair.left, pair.right, setup.pixel, round(d), window)
        shown["windows"] = Picture(image, f"Left window, and right window {round(d)} px further left")
    return shown


def _numbers(state: State) -> dict[str, Primitive]:
    return {
        "wrong": Scalar(100 * state.wrong, "over 1 px off", "Pixels", "%", "truth"),
        "unknown": Scalar(100 * state.unknown, "unknown", "Pixels", "%", "correspondence"),
        "lowest": Scalar(state.lowest, "mean lowest cost", "Cost per pixel", "", "other"),
        "energy": Scalar(state.energy, "energy E(D)", "Cost per pixel", "", "source"),
    }


def _curves(state: State) -> dict[str, Primitive]:
    setup = state.setup
    camera, (u, v) = setup.pair.camera, setup.pixel
    x = np.arange(setup.max_disparity + 1.0)
    marks = (state.chosen,) if math.isfinite(state.chosen) else ()
    chart = "Cost at the followed pixel"
    shown: dict[str, Primitive] = {
        "costs": Curve(x, state.costs, "cost", chart, "disparity in px", "cost", "source", marks=marks)
    }
    if setup.pair.disparity is not None and 0 <= setup.pair.disparity[v, u] <= setup.max_disparity:
        true = setup.pair.disparity[v, u : u + 1]
        at = np.interp(true, x, state.costs)
        shown["costs/truth"] = Curve(true, at, "truth", chart, "disparity in px", "cost", "truth", "dots")
    if state.stage is None and setup.metric:
        d = x[x + camera.doffs >= max(camera.f * camera.baseline / setup.far, 0.5)]
        if len(d):
            depth = setup.f * camera.baseline / (d + camera.doffs)
            shown["law"] = Curve(
                d, depth, "Z = f B / d", "Depth over disparity", "disparity in px", "m", "source", marks=marks
            )
    if state.uncertainty is not None and setup.metric:
        shown |= _error_curves(state)
    return shown


def _error_curves(state: State) -> dict[str, Primitive]:
    """Return the predicted error over depth, and beside it the measured one where the truth is known."""
    setup = state.setup
    camera = setup.pair.camera
    known = np.isfinite(state.depth) & (state.depth <= setup.far)
    if not known.any():
        return {}
    chart, labels = "Depth error over depth", ("depth in m", "m")
    z = np.linspace(0.0, float(state.depth[known].max()), 60)[1:]
    predicted = z * z / (setup.f * camera.baseline) * state.disparity_error
    name = f"Z² / (f B) · {brief(state.disparity_error)} px"
    shown: dict[str, Primitive] = {"error/predicted": Curve(z, predicted, name, chart, *labels, "source")}
    if setup.pair.visible is None:
        return shown
    known &= setup.pair.visible & np.isfinite(setup.true_depth)
    if known.sum() < 10 * BINS:
        return shown
    true = setup.true_depth[known]
    off = np.abs(state.depth[known] - true)
    edges = np.unique(np.quantile(true, np.linspace(0, 1, BINS + 1)))
    bins = np.clip(np.searchsorted(edges, true, "right") - 1, 0, max(len(edges) - 2, 0))
    middles = [(float(np.median(true[bins == k])), float(np.median(off[bins == k]))) for k in np.unique(bins)]
    x, y = np.array(sorted(set(middles))).T
    shown["error/measured"] = Curve(x, y, "measured median", chart, *labels, "truth", "dots")
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
        near, far = (float(z[0]) for z in depth_interval(d, setup.f, camera.baseline, error))
        rows.append((f"± {brief(error)} px", f"{distance(near)} to {distance(far)}"))
    if setup.pair.disparity is not None:
        true = float(setup.pair.disparity[v, u])
        seen = "" if setup.pair.visible is None or setup.pair.visible[v, u] else ", hidden from the right camera"
        rows.append(
            (
                "truth",
                "unknown" if math.isnan(true) else f"{_px(true)}, {distance(float(setup.true_depth[v, u]))}{seen}",
            )
        )
    return Table(f"Left pixel ({u}, {v})", ("", "value"), tuple(rows))


def _px(d: float) -> str:
    return "unknown" if math.isnan(d) else f"{fixed(d, 2)} px"


def _no_infinity(values: np.ndarray) -> np.ndarray:
    return np.where(np.isfinite(values), values, np.nan).astype(np.float32)


def framed(picture: np.ndarray, center: tuple[int, int], window: int) -> np.ndarray:
    """Return a copy of an RGB picture with a frame around the window at `center` (u, v), as far as it is inside."""
    u, v = center
    half = max(window // 2, 1) + 1
    h, w = picture.shape[:2]
    marked = picture.copy()
    rows, columns = np.mgrid[v - half : v + half + 1, u - half : u + half + 1]
    edge = np.maximum(np.abs(rows - v), np.abs(columns - u)) == half
    inside = edge & (rows >= 0) & (rows < h) & (columns >= 0) & (columns < w)
    marked[rows[inside], columns[inside]] = PALETTE["highlight"]
    return marked


def patches(left: np.ndarray, right: np.ndarray, uv: tuple[int, int], d: int, window: int) -> np.ndarray:
    """Return the windows around left (u, v) and right (u - d, v) side by side, both brightened alike, each framed.

    What lies outside the pictures is grey.
    """
    u, v = uv
    half = max(window // 2, 3) + 1
    cuts = [_cut(picture, x, v, half) for picture, x in ((left, u), (right, u - d))]
    low = float(np.min(cuts))
    span = max(float(np.max(cuts)) - low, LEAST_SPAN)
    bright = [np.rint((cut - low) * (255.0 / span)).astype(np.uint8) for cut in cuts]
    one, two = (framed(cut, (half, half), window) for cut in bright)
    gap = np.full((one.shape[0], GAP, 3), 255, np.uint8)
    return np.concatenate([one, gap, two], axis=1)


def _cut(picture: np.ndarray, u: int, v: int, half: int) -> np.ndarray:
    h, w = picture.shape[:2]
    rows, columns = np.mgrid[v - half : v + half + 1, u - half : u + half + 1]
    inside = (rows >= 0) & (rows < h) & (columns >= 0) & (columns < w)
    cut = np.full((*rows.shape, 3), 128, np.uint8)
    cut[inside] = picture[rows[inside], columns[inside]]
    return cut
