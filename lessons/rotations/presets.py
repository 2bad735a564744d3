"""Runs worth seeing, and cameras."""

from dataclasses import replace

import numpy as np

from lessons.rotations.inputs import Input
from lessons.rotations.names import APARTS, ENDS, PITCHES
from workbench.lesson import Preset, Sweep, View

VIEW = View(eye=(2.6, -3.9, 2.2), target=(0.85, 0.2, 0.32), grid=None, axes=False)
RINGS = View(eye=(2.2, -2.9, 1.3), target=(0.0, 0.0, 0.0), grid=None, axes=False)
NEAR = View(eye=(2.2, -2.6, 1.5), target=(0.0, 0.0, 0.35), grid=None, axes=False)
HELD = View(eye=(2.9, -2.1, 2.0), target=(0.15, 0.1, 0.4), grid=None, axes=False)
CORNER = View(eye=(3.0, -1.2, 1.7), target=(0.1, -0.1, 0.25), grid=None, axes=False)
ABOVE = View(eye=(-0.5, -2.6, 3.1), target=(-0.45, 0.0, 0.2), grid=None, axes=False)
GLOBE = View(eye=(2.4, -2.9, 1.6), target=(0.0, 0.0, 0.1), grid=None, axes=False)
NEEDLE = View(eye=(1.6, -2.6, 1.2), target=(0.0, 0.0, 0.45), grid=None, axes=False)
VIEWS = {
    "rings": RINGS,
    "near": NEAR,
    "held": HELD,
    "corner": CORNER,
    "above": ABOVE,
    "globe": GLOBE,
    "needle": NEEDLE,
    "wide": VIEW,
}

NO_TURN = (0.0, 0.0, 0.0)
HERE = (0.0, 0.0, 0.0, *NO_TURN)
THREE = (40.0, 30.0, 70.0)
LOCKED = (30.0, 90.0, 50.0)

GIMBAL = Input(stage="rings", angles=LOCKED)
RINGED = Input(stage="rings", angles=THREE)
FIXED_OWN = Input(stage="readings", angles=THREE, compare="fixed and own axes")
CHAIN = Input(stage="chain", angles=(90.0, 0.0, 90.0))
HALVES = Input(stage="names")
MEAN = Input(stage="mean")
WOBBLE = Input(angles=NO_TURN, angles_end=(170.0, 40.0, 160.0), method="Euler angles", pose=HERE)
AVERAGE = Input(
    angles=(0.0, 0.0, 170.0), angles_end=(0.0, 0.0, -170.0), method="Euler angles", pose=HERE
)
ENTRIES = Input(angles=NO_TURN, angles_end=(0.0, 0.0, 170.0), method="matrix entries", pose=HERE)
MINUS_Q = Input(angles=NO_TURN, angles_end=(0.0, 0.0, 60.0), method="slerp to -q", pose=HERE)

THIRTY = int(np.argmin(np.abs(PITCHES - THREE[1])))
LEVEL = int(np.argmin(np.abs(PITCHES)))
SIXTY = int(np.argmin(np.abs(ENDS - 60.0)))
TWENTY = int(np.argmin(np.abs(APARTS - 20.0)))

PRESETS: tuple[Preset[Input], ...] = (
    Preset(
        name="gimbal",
        title="Gimbal lock: pitch 90°",
        line="Raise the middle ring from 0° to 90°, and look at the outer and the inner axle.",
        params=GIMBAL,
        step=LEVEL,
        view=RINGS,
    ),
    Preset(
        name="three-rings",
        title="Three numbers on three rings",
        line="The inner ring is turned by 40°, the middle one by 30° and the outer one by 70°.",
        params=RINGED,
        step=THIRTY,
        view=RINGS,
    ),
    Preset(
        name="family",
        title="One pose, many triples",
        line="At a pitch of 90° a whole family of triples makes the same pose. Step through three.",
        params=Input(stage="readings", angles=LOCKED, compare="other triples"),
        step=1,
        view=HELD,
    ),
    Preset(
        name="conventions",
        title="Three numbers, four readings",
        line="(40, 30, 70)° are four different rotations under four conventions. Step on.",
        params=Input(stage="readings", angles=THREE),
        step=2,
        view=HELD,
    ),
    Preset(
        name="fixed-own",
        title="Fixed or carried axes",
        line="Turns about fixed axes, read in three ways as turns about carried axes.",
        params=FIXED_OWN,
        step=0,
        view=HELD,
    ),
    Preset(
        name="transpose",
        title="R taken for Rᵀ",
        line=(
            "The same numbers, read as turning the axes (passive) instead of the body (active): it"
            " turns the other way."
        ),
        params=Input(stage="readings", angles=(0.0, 0.0, 40.0), compare="transpose"),
        step=1,
        view=HELD,
    ),
    Preset(
        name="xyzw",
        title="wxyz read as xyzw",
        line="Both are four numbers of length 1, so nothing complains. Read where the house lies.",
        params=Input(stage="readings", angles=(0.0, 0.0, 40.0), compare="xyzw for wxyz"),
        step=1,
        view=HELD,
    ),
    Preset(
        name="chain",
        title="Two quarter turns are one turn",
        line="The two grey arcs are quarter turns, about x and then about z. Green is one arc.",
        params=CHAIN,
        step=0,
        view=CORNER,
    ),
    Preset(
        name="halves",
        title="The circle of half angles",
        line="q stands at half the angle of the turn, and −q on the opposite side.",
        params=HALVES,
        step=SIXTY,
        view=ABOVE,
    ),
    Preset(
        name="minus-q",
        title="q and −q",
        line="Both are the end's rotation. Slerp runs to −q here: look where it takes the house.",
        params=MINUS_Q,
        step=0,
        view=NEAR,
    ),
    Preset(
        name="one-axis",
        title="The shortest turn, by slerp",
        line=(
            "One axis leads from the first pose to the second, and the body turns about it at"
            " constant speed. The next experiment goes between the same two poses."
        ),
        params=replace(WOBBLE, method="slerp + lerp"),
        step=15,
        view=GLOBE,
    ),
    Preset(
        name="wobble",
        title="Euler angles wobble",
        line=(
            "Three angles at constant speed, yet the body leaves the shortest turn and changes its"
            " pace, because the axes of the angles move."
        ),
        params=WOBBLE,
        step=15,
        view=GLOBE,
    ),
    Preset(
        name="average",
        title="The mean of 170° and −170°",
        line=(
            "Two headings, and the number that names them is blended. Green is the shortest turn:"
            " watch where orange goes."
        ),
        params=AVERAGE,
        step=1,
        view=GLOBE,
    ),
    Preset(
        name="screw",
        title="Along a screw",
        line=(
            "Exp and log on SE(3) turn about a line that stays put and slide along it: the origin"
            " follows a helix, not a straight line as with slerp + lerp."
        ),
        params=Input(angles=NO_TURN, angles_end=(0.0, 0.0, 120.0), method="screw"),
        step=15,
    ),
    Preset(
        name="entries",
        title="Blend the matrix entries",
        line=(
            "Each entry of the matrix runs evenly to that of a rotation 170° away. Is what lies"
            " between a rotation? Step on, and look at the body and its volume."
        ),
        params=ENTRIES,
        step=3,
        view=NEEDLE,
        breaks=True,
    ),
    Preset(
        name="means",
        title="The mean of two matrices",
        line="Halfway between two rotations, by the mean of their entries, ever farther apart.",
        params=MEAN,
        step=TWENTY,
        view=NEEDLE,
    ),
)


SWEEPS = (
    Sweep("method", ("slerp + lerp", "Euler angles", "matrix entries", "slerp to -q", "screw")),
)
