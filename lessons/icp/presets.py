"""Runs that work and runs that break ICP, and cameras."""

from dataclasses import replace

import numpy as np

from lessons.icp.flat import HAND
from lessons.icp.inputs import Input
from workbench.lesson import Preset, Sweep, View

BY_HAND = Input(stage="flat", by="hand", start_angle=-66.0)
FROM_45 = Input(stage="flat", start_angle=45.0)
FROM_75 = Input(stage="flat", start_angle=75.0)
FAR = Input(start_angle=120.0)
VASE = Input(shape="vase", start_angle=90.0, gate="all")
PLANE = Input(fit="point-to-plane")
OUTLIERS = Input(outliers=0.3, keep=1.0)
KEEP_70 = replace(OUTLIERS, keep=0.7)
OVERLAP = Input(
    start_angle=20.0,
    overlap=0.8,
    noise=0.0,
    points=5000,
    fit="point-to-plane",
    gate="max-distance",
)
OVERLAP_TIGHT = replace(OVERLAP, max_distance=0.02)
RINGS = Input(
    shape="lidar",
    start_angle=0.7,
    start_shift=0.5,
    fit="point-to-plane",
    noise=0.02,
    thinning="chance",
    planes="all",
)
FRONT = View(eye=(0.0, 2.15, 0.0), target=(0.0, 0.0, 0.0), grid=None, axes=False)
VIEW = View(eye=(0.85, 1.25, 0.55), target=(0.05, 0.0, 0.18), grid=None, axes=False)
NEAR = View(eye=(0.75, 0.75, 0.75), target=(0.12, 0.0, 0.4), grid=None, axes=False)
ABOVE = View(eye=(0.4, 1.0, 2.0), target=(0.0, 0.05, 0.0), grid=None, axes=False)
SIDE = View(eye=(1.25, -1.45, 0.95), target=(0.08, -0.08, 0.0), grid=None, axes=False)
WALL = View(eye=(1.9, -1.9, 1.3), target=(0.0, -0.1, 0.0), grid=None, axes=False)
STREET = View(eye=(0.55, -0.95, 1.0), target=(0.0, 0.0, -0.05), grid=None, axes=False)
VIEWS = {
    "front": FRONT,
    "rabbit": VIEW,
    "near": NEAR,
    "above": ABOVE,
    "side": SIDE,
    "wall": WALL,
    "street": STREET,
}
START = int(np.argmin(np.abs(HAND - BY_HAND.start_angle)))  # where the hand begins

PRESETS: tuple[Preset[Input], ...] = (
    Preset(
        name="hand",
        title="Turned by hand",
        line="Each line leads to the nearest blue point. Turn the rabbit and read the RMSE.",
        params=BY_HAND,
        step=START,
        view=FRONT,
    ),
    Preset(
        name="from-45",
        title="In the flat, from 45°",
        line="Only a turn is missing, so the cost is a curve. Follow the ball.",
        params=FROM_45,
        step=0,
        view=FRONT,
    ),
    Preset(
        name="from-75",
        title="In the flat, from 75°",
        line="The same rules, from a start 30° farther away.",
        params=FROM_75,
        step=0,
        view=FRONT,
        breaks=True,
    ),
    Preset(
        name="lines-45",
        title="In the flat, along the lines",
        line="Points may slide along the outline, so each swing is larger.",
        params=replace(FROM_45, fit="point-to-plane"),
        step=0,
        view=FRONT,
    ),
    Preset(
        name="home",
        title="From 35° away",
        line="Compare what ICP sees, the RMSE, with what you want to know, the green errors.",
        params=Input(),
    ),
    Preset(
        name="far",
        title="From 120° away",
        line="Every fit lowers the RMSE. Compare it with the rotation error.",
        params=FAR,
        step=0,
        breaks=True,
    ),
    Preset(
        name="plane",
        title="Point-to-plane, from 35° away",
        line="Points may slide along the target's tangent planes. Count the rounds.",
        params=PLANE,
        step=0,
    ),
    Preset(
        name="symmetric",
        title="A vase turned about its axis",
        line="A surface of revolution, started 90° away about its own axis: watch the arrows.",
        params=VASE,
        step=0,
        view=SIDE,
        breaks=True,
    ),
    Preset(
        name="slide",
        title="Two planes slide",
        line=(
            "A floor and a wall hold everything but the slide along their common edge: the turn is"
            " off by less than 0.1°, and the source ends as far off as it started, 0.31 m."
        ),
        params=Input(
            shape="corner", start_angle=10.0, start_shift=0.3, fit="point-to-plane", keep=0.5
        ),
        step=0,
        view=WALL,
        breaks=True,
    ),
    Preset(
        name="overlap-fixed",
        title="Part seen by one scan only",
        line=(
            "A fixed gate of 0.1 m lets in matches of points that the target never saw, and they"
            " pull."
        ),
        params=OVERLAP,
        step=0,
        breaks=True,
    ),
    Preset(
        name="overlap-adaptive",
        title="The same with d < 3 medians",
        line=(
            "A gate that shrinks with the distances leaves a tenth of the fixed gate's rotation"
            " error, 0.06° of 0.63°."
        ),
        params=replace(OVERLAP, gate="3-medians"),
        step=0,
    ),
    Preset(
        name="overlap-tight",
        title="The same with a 0.02 m gate",
        line=(
            "A tight gate leaves 0.02°, but look at the starts: from 60° on too few good matches"
            " pass."
        ),
        params=OVERLAP_TIGHT,
        step=-1,
        breaks=True,
    ),
    Preset(
        name="outliers",
        title="Three in ten are outliers",
        line=(
            "Squared distances listen most to the farthest points: with all matches in use the"
            " source stays 15° off."
        ),
        params=OUTLIERS,
        step=0,
        breaks=True,
    ),
    Preset(
        name="keep-70",
        title="Outliers, and a gate that trims",
        line="Each fit leaves out a share of the matches, those that are farthest apart.",
        params=KEEP_70,
        step=0,
    ),
    Preset(
        name="outliers-trimmed",
        title="Outliers, trimmed a little more",
        line="The gate leaves out somewhat more than there are outliers, and ICP comes home.",
        params=replace(OUTLIERS, keep=0.65),
        step=0,
    ),
    Preset(
        name="rings-chance",
        title="A lidar's rings, thinned by chance",
        line=(
            "The scanner moved 0.5 m, and its rings moved with it. Most planes are laid through one"
            " ring, so rings lock onto rings: 0.49 m stay."
        ),
        params=RINGS,
        step=0,
        view=STREET,
        breaks=True,
    ),
    Preset(
        name="rings-voxel",
        title="The rings, thinned by voxels",
        line=(
            "The means of the points in each voxel, 1 % of the width: dense rings and sparse walls"
            " count alike, and 36 mm stay."
        ),
        params=replace(RINGS, thinning="voxel", voxel=1.0),
        step=0,
        view=STREET,
        breaks=True,
    ),
    Preset(
        name="rings-spread",
        title="The rings, and no plane through a line",
        line=(
            "Finer voxels of 0.2 %, and a point whose neighbours lie along a line does not pull:"
            " 6 mm stay."
        ),
        params=replace(RINGS, thinning="voxel", planes="spread"),
        step=0,
        view=STREET,
    ),
)

SWEEPS = (
    Sweep("start_angle", tuple(float(degrees) for degrees in range(0, 181, 30))),
    Sweep(
        "start_angle",
        (-180.0, -120.0, -90.0, -60.0, -30.0, 0.0, 30.0, 45.0, 60.0, 75.0, 90.0, 120.0, 150.0),
        run="from-75",
    ),
    Sweep("keep", (0.3, 0.5, 0.6, 0.65, 0.7, 0.8, 0.9, 1.0), run="keep-70"),
    Sweep("start_angle", (0.0, 45.0, 90.0, 135.0, 180.0), run="symmetric"),
)
