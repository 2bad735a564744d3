"""The stage of one row: a window slides along the right picture, and its cost is drawn below it, on
the same pixels.
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from lessons.disparity.above import eyes, stand
from lessons.disparity.inputs import Input
from lessons.disparity.matching import OTHER_COSTS
from lessons.disparity.pairs import SIZE, Pictures, taken
from workbench.algorithms.stereo.cost_volume import CostVolume, sad_cost_volume
from workbench.captions import number
from workbench.data.views.stereo import grey
from workbench.geometry.motions import motion
from workbench.geometry.polylines import between
from workbench.lesson import Look, cached, say
from workbench.numerals import length
from workbench.scene import Chart, Label, Picture, Points, Primitive, Role, Scene, Segments, dashed

# Columns to the right, rows down, seen from -y.
FACING = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0]])
# metres of the drawing: where the strips begin, and their width
LEFT_EDGE = -1.6
WIDE = 2.15
TOPS = {"left": 1.08, "right": 0.5}
TALL = 0.42  # of a strip
CHART = (-0.95, 0.85)  # where the cost 0 is, and how high the largest is drawn
LAYER = 0.006
# grey levels a pixel: a window that differs by less is drawn lower than the full height
FULL = 40.0
DOT = 0.02
BLOCK = 12  # pixels in which a pixel of a strip is drawn, so that it stays sharp
# columns that are shown left of the last partner, and right of the pixel
BESIDE = 6
AFTER = 8
PLATE = (1.14, 0.78, 0.84)  # the whole left picture: its middle to the right and up, and its width
EYES = (0.86, -0.95)
APART = 0.5
REACH = 1.1
KINDS = {
    "texture": ("spheres", (54, 80)),
    "bare wall": ("plain wall", (62, 60)),
    "stripes": ("repeated pattern", (80, 60)),
}
COLORS: dict[str, Role] = {"texture": "truth", "bare wall": "target", "stripes": "wrong"}
COSTS = Chart("Cost of each shift", "shift", "grey levels", x_unit="px")
THREE = Chart("Costs at three places", "shift", "grey levels", x_unit="px")
SHIFT = Chart("Shift", unit="px")
COST = Chart("Cost")


@dataclass(frozen=True, eq=False)
class Slid:
    """One shift d (px) that was tried; the costs (n,) of all, of which those up to d are known."""

    d: int
    costs: np.ndarray

    @property
    def known(self) -> np.ndarray:
        """The costs of the shifts tried so far."""
        return self.costs[: self.d + 1]

    @property
    def best(self) -> int:
        """The shift of the lowest of them."""
        return int(np.nanargmin(self.known)) if np.isfinite(self.known).any() else 0


RowLook = Look[Input, Pictures, Slid]


def run(
    params: Input, pictures: Pictures, cost_volume: CostVolume = sad_cost_volume
) -> Iterator[Slid]:
    """Yield one shift after the other for the followed pixel."""
    compare = OTHER_COSTS.get(params.cost, cost_volume)
    volume = costs_of_row(pictures, compare, params.window)
    costs = volume[:, pictures.pixel[0]].astype(float)
    costs[~np.isfinite(costs)] = np.nan
    costs[pictures.pixel[0] + 1 :] = np.nan
    for d in range(pictures.max_disparity + 1):
        yield Slid(d, costs)


def costs_of_row(pictures: Pictures, compare: CostVolume, window: int) -> np.ndarray:
    """Return the costs (d, w) of the followed row, from as many rows as they depend on."""
    v = pictures.pixel[1]
    more = window // 2 + 2
    first = max(0, v - more)
    rows = slice(first, v + more + 1)
    left = pictures.left[rows]
    right = pictures.right[rows]
    return compare(left, right, pictures.max_disparity, window)[:, v - first]


@cached
def three_curves(params: Input) -> dict[str, np.ndarray]:
    """Return the costs by shift of a pixel with texture, on a bare wall, and on stripes."""
    curves = {}
    for name, (scene, (u, v)) in KINDS.items():
        pair = taken(scene, 150.0, 0.1, noise=4.0, seed=params.seed)
        rows = slice(v - params.window // 2 - 2, v + params.window // 2 + 3)
        volume = sad_cost_volume(grey(pair.left[rows]), grey(pair.right[rows]), 31, params.window)
        curves[name] = volume[:, params.window // 2 + 2, u]
    return curves


@dataclass(frozen=True, eq=False)
class Strips:
    """The two strips, and where a column of the pictures is on both."""

    left: Picture
    right: Picture
    first: int
    middle: int

    def column(self, u: float | np.ndarray) -> np.ndarray:
        """Return how far right a column stands in the drawing."""
        w = self.left.size[0] / BLOCK
        return LEFT_EDGE + WIDE * (np.asarray(u, float) - self.first + 0.5) / w


def blocks(image: np.ndarray, high: int, wide: int) -> np.ndarray:
    """Return a picture in which each pixel is a block of so many."""
    return np.repeat(np.repeat(image, high, axis=0), wide, axis=1)


def on_strip(at: np.ndarray) -> np.ndarray:
    """Return where pixels of a strip are in its picture, in which each is a block of pixels."""
    return BLOCK * (np.asarray(at, float) + 0.5) - 0.5


def strips_of(look: Look[Input, Pictures, Slid]) -> Strips:
    """Return what is shown of the row in both pictures."""
    pictures = look.subject
    u, v = look.subject.pixel
    h, w = pictures.left.shape
    half = look.params.window // 2
    first = max(0, u - pictures.max_disparity - BESIDE)
    last = min(w, u + max(AFTER, half + 2))
    count = last - first
    tall = max(3, 2 * round(TALL / WIDE * count / 2) + 1)  # rows: square pixels
    rows = np.clip(np.arange(v - tall // 2, v + tall // 2 + 1), 0, h - 1)
    shown = []
    for side in ("left", "right"):
        cut = (pictures.pair.left if side == "left" else pictures.pair.right)[rows, first:last]
        middle = TOPS[side] - WIDE * tall / count / 2
        pose = motion(FACING, np.array([LEFT_EDGE + WIDE / 2, 0.0, middle]))
        shown.append(Picture(blocks(cut, BLOCK, BLOCK), f"{side} row", WIDE, pose))
    return Strips(shown[0], shown[1], first, tall // 2)


def draw(look: RowLook) -> Scene:
    """Return both strips, the cost curve below them, and the two rays that cross."""
    state = look.now
    pictures = look.subject
    strips = strips_of(look)
    costs = state.costs
    words = "Shift {d}: no partner so far left."
    cost = float(costs[state.d])
    values: dict[str, Any] = {"d": state.d}
    if math.isfinite(cost):
        words = "Shift {d}: the cost is {cost}; the lowest so far is {lowest} at {best}."
        values |= {"cost": number(cost), "best": state.best}
        values["lowest"] = number(float(costs[state.best]))
    return {
        **_rows(look, strips),
        **_curve(look, strips),
        **_plate(look),
        **_crossed(look),
        **_charts(look),
        "shift": SHIFT.scalar(state.d, "shift"),
        "cost": COST.scalar(cost, "cost at this shift"),
        "lowest": COST.scalar(float(costs[state.best]), "lowest so far", "highlight"),
        "caption": say(words, **values),
    } | _truth(look, strips, pictures)


def _rows(look: RowLook, strips: Strips) -> dict[str, Primitive]:
    u = look.subject.pixel[0] - strips.first
    scene: dict[str, Primitive] = {"left/strip": strips.left, "right/strip": strips.right}
    for side, at in (("left", u), ("right", u - look.now.d)):
        picture = strips.left if side == "left" else strips.right
        color: Role = "highlight" if side == "left" else "source"
        half = BLOCK * look.params.window / 2
        middle = on_strip(np.array([at, strips.middle]))
        scene[f"{side}/edge"] = Segments(
            picture.border(LAYER), "target" if side == "left" else "source", 2.0
        )
        place = picture.places(on_strip(np.array([2.0, -1.0])))
        scene[f"{side}/name"] = Label(
            f"{side} row", place, "target" if side == "left" else "source"
        )
        if at >= 0:
            box = picture.box(middle - half, middle + half, 2 * LAYER)
            name = "the pixel and its window" if side == "left" else "compared with"
            scene[f"{side}/window"] = Segments(box, color, 4.0, name=name)
    return scene


def _height(look: RowLook, costs: np.ndarray) -> np.ndarray:
    """Return how high costs are drawn: the low ones of a bare wall are not enlarged."""
    params = look.params
    full = FULL * params.window**2 if params.cost == "SAD" else 1e-9
    top = max(float(np.nanmax(look.now.costs, initial=0.0)), full)
    return CHART[0] + CHART[1] * costs / top


def _curve(look: RowLook, strips: Strips) -> dict[str, Primitive]:
    """Return the cost of the shifts tried so far, each below the column that it compares."""
    state = look.now
    u = look.subject.pixel[0]
    shifts = np.flatnonzero(np.isfinite(state.known))
    foot = CHART[0]
    ends = strips.column(np.array([u - len(state.costs) + 1.0, u]))
    axis = stand(np.array([[[ends[0], foot], [ends[1], foot]]]))
    scene: dict[str, Primitive] = {
        "axis": Segments(axis, "neutral", 1.5, opacity=0.7),
        "axis/name": Label(
            "cost of each shift", stand(np.array([LEFT_EDGE + 0.22, foot + CHART[1]])), "highlight"
        ),
    }
    for d in range(0, len(state.costs), 10):
        text = f"d = {d}" if d == 0 else str(d)
        at = stand(np.array([float(strips.column(u - d)), foot - 0.09]))
        scene[f"axis/{d}"] = Label(text, at, "neutral")
    if not len(shifts):
        return scene
    p = stand(
        np.column_stack([strips.column(u - shifts), _height(look, state.costs[shifts])]), 0.01
    )
    scene["costs"] = Points(p, "highlight", DOT, name="cost of a shift")
    if len(p) > 1:
        scene["costs/line"] = Segments(between(p[:-1], p[1:]), "highlight", 1.5, opacity=0.6)
    if state.d in shifts:
        top = strips.right.places(
            on_strip(np.array([u - state.d - strips.first, 2 * strips.middle + 0.5]))
        )
        down = np.array([top, p[-1]])
        scene["costs/down"] = dashed(down, "source", dash=0.03)
        scene["costs/here"] = Points(
            p[-1:] + np.array([0, -0.006, 0]), "source", 1.7 * DOT, name="here"
        )
    best = p[shifts.tolist().index(state.best)]
    below = np.array([best[0], 0.0, foot - 0.22])
    scene["costs/best"] = Label(f"lowest: d = {state.best}", below, "highlight")
    scene["costs/lowest"] = Segments(
        np.array([[best, below + np.array([0.0, 0.0, 0.05])]]), "highlight", 1.5
    )
    return scene


def _plate(look: RowLook) -> dict[str, Primitive]:
    """Return the whole left picture, and which row of it is looked at."""
    pictures = look.subject
    u, v = look.subject.pixel
    h, w = pictures.left.shape
    right, up, width = PLATE
    width = min(width, 0.63 * w / h)
    pose = motion(FACING, np.array([right, 0.0, up]))
    plate = Picture(pictures.pair.left, "left picture", width, pose)
    row = plate.places(np.array([[[-0.5, v], [w - 0.5, v]]]), LAYER)
    spot = plate.places(np.array([[u, v]]), 2 * LAYER)
    return {
        "left/picture": plate,
        "left/row": Segments(row, "highlight", 1.5, opacity=0.8),
        "left/pixel": Points(spot, "highlight", DOT),
    }


def _crossed(look: RowLook) -> dict[str, Primitive]:
    """Return both cameras from above, and where the two rays of this shift cross.

    The drawing is sheared so that the left ray points straight up, and stretched across: lines stay
    straight and cross where they do.
    """
    pictures = look.subject
    state = look.now
    camera = pictures.pair.camera
    depths = camera.depth(np.arange(state.d + 1.0))
    near = depths[(depths <= pictures.far) & np.isfinite(state.known)]
    foot = np.array(EYES)
    top = foot + np.array([0.0, REACH])
    scene = eyes(EYES, APART) | {
        "left ray": Segments(stand(np.array([[foot, top]])), "target", 2.5, name="left ray")
    }
    if len(near):
        tried = foot + np.column_stack([np.zeros(len(near)), REACH * near / pictures.far])
        scene["tried"] = Points(stand(tried, 0.005), "highlight", 0.6 * DOT)
    here = float(depths[-1])
    if not here > 0 or pictures.pixel[0] < state.d:
        return scene
    eye = foot + np.array([APART, 0.0])
    towards = np.array([-APART, REACH * min(here, 1e6) / pictures.far])
    end = eye + towards * min(1.0, REACH / towards[1])
    scene["right ray"] = Segments(
        stand(np.array([[eye, end]]), 0.004), "source", 2.5, name="right ray"
    )
    if here <= pictures.far:
        scene["crossing"] = Points(stand(end[None], 0.01), "source", 1.7 * DOT, name="crossing")
        if pictures.metric:
            scene["crossing/name"] = Label(
                length(here), stand(end + np.array([-0.2, 0.02])), "source"
            )
    return scene


def _charts(look: RowLook) -> dict[str, Primitive]:
    """Return the cost of each shift tried so far, and the curves of three kinds of place."""
    pictures = look.subject
    state = look.now
    scene: dict[str, Primitive] = {}
    shifts = np.arange(len(state.costs), dtype=float)
    ends = (0.0, float(shifts[-1]))
    costs, three = (replace(chart, x_range=ends) for chart in (COSTS, THREE))
    tried = np.flatnonzero(np.isfinite(state.known))
    top = 1.06 * float(state.costs[np.isfinite(state.costs)].max(initial=0.0))
    if top > 0.0:
        unit = "grey levels" if look.params.cost == "SAD" else "cost"
        costs = replace(costs, unit=unit, y_range=(0.0, top))
    if len(tried):
        scene["tried/whole"] = costs.whole(shifts[tried], state.costs[tried], "tried", "highlight")
    if state.d in tried:
        cost = float(state.costs[state.d])
        scene["tried/mark"] = costs.mark(state.d, cost, "here", "source", steps="shift")
    if pictures.left.shape == SIZE[::-1] and look.params.cost == "SAD":
        for name, values in three_curves(look.params).items():
            color = COLORS[name]
            scene[f"three/{name}"] = three.whole(np.arange(len(values)), values, name, color)
        if math.isfinite(cost := float(state.costs[state.d])):
            scene["three/mark"] = three.mark(state.d, cost, "here", "source", steps="shift")
    return scene


def _truth(look: RowLook, strips: Strips, pictures: Pictures) -> dict[str, Primitive]:
    """Return where the true partner is, where it is known and seen."""
    u, v = pictures.pixel
    pair = pictures.pair
    if pair.disparity is None or pair.visible is None or not pair.visible[v, u]:
        return {}
    at = u - float(pair.disparity[v, u])
    if look.params.mistake != "none" or at < strips.first:
        return {}
    x = float(strips.column(at))
    ends = np.array([[[x, CHART[0] - 0.03], [x, CHART[0] + CHART[1]]]])
    return {
        "truth": Segments(stand(ends), "truth", 2.0, opacity=0.8, name="true partner"),
        "jump": SHIFT.scalar(float(pair.disparity[v, u]), "true jump", "truth"),
    }
