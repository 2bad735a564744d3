"""Runs to begin with."""

from dataclasses import replace

import numpy as np

from lessons.axes.flat import HAND, outline_of
from lessons.axes.inputs import Input
from workbench.lesson import Preset, Sweep, View

FLAT = Input(stage="flat")
LARGEST = Input(signs="largest-entry")
STRAY = Input(stray=(0.0, 2.0, 0.0))
NEARLY = Input(shape="box", fresh=True, side=0.99)
FRAMES = Input(stage="frames")
STARTS = Input(stage="starts", fresh=True)

VIEW = View(eye=(-0.38, -3.2, 1.3), target=(-0.25, 0.0, 0.1), grid=None, axes=False)
BOTH = View(eye=(-0.75, -2.55, 1.1), target=(-0.62, 0.0, 0.12), grid=None, axes=False)
TOGETHER = View(eye=(-0.95, -2.3, 1.1), target=(-1.1, 0.0, 0.2), grid=None, axes=False)
WIDE = View(eye=(-1.7, -2.9, 1.7), target=(-0.75, 0.0, 0.3), grid=None, axes=False)
APART = View(eye=(-1.1, -3.6, 1.8), target=(-1.25, 0.0, 0.1), grid=None, axes=False)
FRONT = View(eye=(0.0, -2.15, 0.0), target=(0.0, 0.0, 0.0), grid=None, axes=False)
ASIDE = View(eye=(-0.65, -3.4, 0.0), target=(-0.65, 0.0, 0.0), grid=None, axes=False)
MATRIX = View(eye=(0.42, -2.15, 0.5), target=(0.42, 0.0, 0.05), grid=None, axes=False)
FOUR = View(eye=(0.0, -2.95, 0.2), target=(0.0, 0.0, -0.06), grid=None, axes=False)
GLOBE = View(eye=(-0.9, -2.75, 0.95), target=(-1.15, 0.0, 0.05), grid=None, axes=False)
VIEWS = {
    "flat": FRONT,
    "aside": ASIDE,
    "both": BOTH,
    "matrix": MATRIX,
    "four": FOUR,
    "globe": GLOBE,
    "together": TOGETHER,
    "apart": APART,
}
# steps of the default run, or from the end
FIRST = 3
POSE = -2
TURNS = -1
LEAST_LIKELY = 150.0  # degrees: what is farther off is about half a turn


def _preset(
    name: str,
    title: str,
    line: str,
    *,
    params: Input,
    step: int,
    view: View | None = None,
    breaks: bool = False,
) -> Preset[Input]:
    return Preset(
        name=name, title=title, line=line, params=params, step=step, view=view, breaks=breaks
    )


def at(direction: float) -> int:
    """Return the step at which the line has the direction nearest to this one, degrees."""
    return int(np.argmin(np.abs(HAND - direction)))


PRESETS: tuple[Preset[Input], ...] = (
    _preset(
        "home",
        "Plane turns and the axes",
        "Each turn makes the largest entry off the diagonal zero and disturbs the others.",
        params=Input(),
        step=FIRST,
    ),
    _preset(
        "shadow",
        "A line under the rabbit",
        "The shadow of 60 points on a line: its spread changes with the direction.",
        params=FLAT,
        step=at(30),
        view=FRONT,
    ),
    _preset(
        "one-aside",
        "One point 1 m behind the outline",
        "One of 61 points lies 1 m aside. The longest direction turns towards it.",
        params=replace(FLAT, aside=1.0),
        step=at(outline_of(1.0).longest),
        view=ASIDE,
        breaks=True,
    ),
    _preset(
        "two-aside",
        "The same point, 2 m behind the outline",
        "Squares count distance twice: the farther the point, the more of the axis it has.",
        params=replace(FLAT, aside=2.0),
        step=at(outline_of(2.0).longest),
        view=ASIDE,
        breaks=True,
    ),
    _preset(
        "by-hand",
        "One plane turned by hand",
        "The frame turns in one plane, and the entry of that plane passes through zero.",
        params=Input(stage="turn"),
        step=30,
        view=MATRIX,
    ),
    _preset(
        "frames",
        "All frames of one cloud",
        "The axes are lines. Each choice of tips that is right-handed brings the second scan over.",
        params=FRAMES,
        step=0,
        view=FOUR,
    ),
    _preset(
        "unsigned",
        "No rule at all",
        "The signs stay as the plane turns happened to leave them.",
        params=Input(signs="none"),
        step=TURNS,
        view=GLOBE,
        breaks=True,
    ),
    _preset(
        "signs",
        "A rule that looks at numbers",
        "The largest entry of each axis is made positive: the same scan gives the same signs. And"
        " the same scan, turned?",
        params=LARGEST,
        step=POSE,
        view=TOGETHER,
        breaks=True,
    ),
    _preset(
        "fresh",
        "Two scans, no point in common",
        "Third moments turn with the shape. Other points of the same rabbit have other moments: one"
        " of them is small, and its sign at stake.",
        params=Input(fresh=True),
        step=TURNS,
        view=GLOBE,
        breaks=True,
    ),
    _preset(
        "unlucky",
        "Another draw of the first scan",
        "The same rule and another seed: the small moment of the first scan has the other sign.",
        params=Input(fresh=True, seed=2),
        step=TURNS,
        view=GLOBE,
        breaks=True,
    ),
    _preset(
        "box",
        "A box has no front",
        "Half a turn takes a box to itself, so its third moments are 0 and chance gives them a"
        " sign.",
        params=Input(shape="box", fresh=True),
        step=POSE,
        view=TOGETHER,
        breaks=True,
    ),
    _preset(
        "vase",
        "A vase, turned",
        "Two of its variances are equal, so every direction across its own axis is a principal"
        " one.",
        params=Input(shape="vase", fresh=True),
        step=TURNS,
        view=GLOBE,
        breaks=True,
    ),
    _preset(
        "nearly",
        "Nearly equal sides",
        "Sides of 1 m and 0.99 m: their variances differ by less than sampling does.",
        params=NEARLY,
        step=POSE,
        view=TOGETHER,
        breaks=True,
    ),
    _preset(
        "cube",
        "The box of a cube",
        "All variances are equal. The box along principal axes is often taken for the smallest:"
        " compare its volume with the cube's.",
        params=Input(shape="cube", fresh=True),
        step=POSE,
        view=APART,
        breaks=True,
    ),
    _preset(
        "density",
        "The upper half twice as dense",
        "Principal axes are those of the points, not of the surface: no point of the second scan"
        " lies off the rabbit.",
        params=Input(density=2),
        step=POSE,
        view=TOGETHER,
        breaks=True,
    ),
    _preset(
        "part",
        "A fifth is missing",
        "The second scan saw 80 % of the rabbit. Centroid and axes are those of that part.",
        params=Input(seen=0.8),
        step=POSE,
        view=TOGETHER,
        breaks=True,
    ),
    _preset(
        "stray",
        "One stray point",
        "One point of 1,501 lies 2 m away. Axis 1 moves by 2° only, but the signs are made of"
        " cubes.",
        params=STRAY,
        step=0,
        view=None,
        breaks=True,
    ),
    _preset(
        "far",
        "The same point, 10 m away",
        "Squares listen most to the farthest point: one of 1,501 decides where axis 1 points.",
        params=Input(stray=(0.0, 10.0, 0.0)),
        step=FIRST,
        view=WIDE,
        breaks=True,
    ),
    _preset(
        "starts",
        "A start from each frame",
        "ICP from each of the frames, on two scans without a common point.",
        params=STARTS,
        step=0,
        view=FOUR,
    ),
    _preset(
        "starts-part",
        "Four starts, a fifth unseen",
        "The second scan saw 80 % of the rabbit, and both have 5 mm of noise. ICP mends the tilt.",
        params=replace(STARTS, seen=0.8, noise=0.005),
        step=0,
        view=FOUR,
    ),
    _preset(
        "starts-vase",
        "Four starts for a vase",
        "Its axes are a matter of chance, so none of the frames has to be near.",
        params=replace(STARTS, shape="vase"),
        step=0,
        view=FOUR,
        breaks=True,
    ),
)

SWEEPS = (
    Sweep("signs", ("none", "largest-entry", "third-moment")),
    Sweep("side", (0.6, 0.8, 0.9, 0.95, 0.99), run="nearly"),
    Sweep("seen", (0.5, 0.6, 0.7, 0.8, 1.0), run="starts"),
)
