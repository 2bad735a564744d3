"""Experiments, each the picture of one misconception, and what to predict before looking."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from lessons.transforms.body import numbers_of
from lessons.transforms.compare import in_degrees
from lessons.transforms.state import Built, Moved, Params, State
from workbench.geometry.motions.rotations import euler_axes, triple_past_lock
from workbench.lesson import Choice, Preset, Question, View
from workbench.numerals import angle, fixed, length, percent

VIEW = View(eye=(2.6, -3.9, 2.2), target=(0.85, 0.2, 0.32), grid=None, axes=False)
ROW = View(eye=(2.4, -4.4, 2.6), target=(0.6, 0.5, 0.35), grid=None, axes=False)
ONE = (1.0, 1.0, 1.0)
NO_TURN = (0.0, 0.0, 0.0)
AHEAD = (1.5, 0.0, 0.0, *NO_TURN)

ORDER = Params(scale=ONE, angles=(0.0, 0.0, 90.0), pose=AHEAD, compare="the other order")
GIMBAL = Params(scale=ONE, angles=(30.0, 90.0, 50.0), compare="other triples")
CONVENTIONS = Params(scale=ONE, angles=(40.0, 30.0, 70.0), compare="four conventions")
SHEAR = Params(scale=ONE, shear=0.8, angles=(0.0, 0.0, 40.0))
INVERSE = Params(
    scale=ONE, angles=(0.0, 0.0, -90.0), pose=(1.3, -0.5, 0.3, *NO_TURN), compare="undo by (Rᵀ, −t)"
)

WOBBLE = Params(
    half="move between two poses",
    angles=NO_TURN,
    angles_end=(170.0, 40.0, 160.0),
    method="Euler angles",
)
AVERAGE = Params(
    half="move between two poses",
    angles=(0.0, 0.0, 170.0),
    angles_end=(0.0, 0.0, -170.0),
    method="Euler angles",
)
ENTRIES = Params(
    half="move between two poses",
    angles=NO_TURN,
    angles_end=(0.0, 0.0, 170.0),
    method="matrix entries",
)

PRESETS: tuple[Preset[Params], ...] = (
    Preset(
        "order",
        "Rotate, then translate",
        "Step on, and the same two factors the other way round appear: a rotation turns"
        " about the world's origin, so it swings along whatever was translated before.",
        ORDER,
        -3,
    ),
    Preset(
        "gimbal",
        "Gimbal lock: pitch 90°",
        "Step on, and look at the three lines about which the angles turn the house. The"
        " pose is reached all the same, even by a whole family of triples (green).",
        GIMBAL,
        2,
    ),
    Preset(
        "conventions",
        "Three numbers, four readings",
        "(40, 30, 70)° are four different rotations under four conventions,"
        " drawn in a row behind: a triple without its order says nothing.",
        CONVENTIONS,
        -2,
        ROW,
    ),
    Preset(
        "fixed-own",
        "Fixed or carried axes",
        "xyz about fixed axes is ZYX about carried axes with the numbers in reverse"
        " (green, the same); XYZ with the same numbers is not.",
        Params(scale=ONE, angles=(40.0, 30.0, 70.0), compare="fixed and own axes"),
        -2,
    ),
    Preset(
        "mirror",
        "A reflection is no rotation",
        "Every length and angle survives, yet det is −1. The vermillion house is"
        " the best of all rigid motions, by the sum of squared distances: it does not fit.",
        Params(scale=ONE, mirror="x", compare="best rigid motion"),
        -2,
    ),
    Preset(
        "shear",
        "A shear",
        "Each horizontal layer slides as it is, the higher the farther. Step on, and read in the"
        " table what survives that.",
        SHEAR,
        0,
    ),
    Preset(
        "perspective",
        "Divide by w",
        "A projective map keeps straight lines straight, and cross-ratios on them, but no"
        " lengths, angles or parallels: the vertical edges of the box now run to one point.",
        Params(scale=ONE, perspective=0.5, shape="box", point=4),
        1,
    ),
    Preset(
        "transpose",
        "R taken for Rᵀ",
        "The same numbers, read as turning the axes (passive) instead of the body (active):"
        " it turns the other way, 80° from where it belongs.",
        Params(
            scale=ONE, angles=(0.0, 0.0, 40.0), pose=(1.8, 0.0, 0.0, *NO_TURN), compare="transpose"
        ),
        -2,
    ),
    Preset(
        "inverse",
        "Undo with (Rᵀ, −t)",
        "The translation must be turned back too: (Rᵀ, −Rᵀt) returns to the start. After"
        " this quarter turn (Rᵀ, −t) misses it by 1.97 m, farther than t is long (1.42 m).",
        INVERSE,
        -1,
        breaks=True,
    ),
    Preset(
        "hidden-scale",
        "A scale hidden in R",
        "With a scale of 1.3 in its 3×3, the transpose is no inverse: instead of"
        " going back to its size the house ends 1.3² = 1.69 times as long, wide and high.",
        Params(scale=(1.3, 1.3, 1.3), angles=(0.0, 0.0, 40.0), compare="undo all as if rigid"),
        -1,
        breaks=True,
    ),
    Preset(
        "xyzw",
        "wxyz read as xyzw",
        "Both are four numbers of length 1, so nothing complains: a turn of 40° about z has"
        " become one of 140° about x.",
        Params(
            scale=ONE,
            angles=(0.0, 0.0, 40.0),
            pose=(1.8, 0.0, 0.0, *NO_TURN),
            compare="xyzw for wxyz",
        ),
        -2,
    ),
    Preset(
        "direction",
        "A direction with w = 1",
        "The translation leaks into a direction that is given w = 1: the arrow to"
        " the front no longer points to the front.",
        Params(scale=ONE, angles=(0.0, 0.0, 20.0), compare="direction with w = 1"),
        -2,
        breaks=True,
    ),
    Preset(
        "minus-q",
        "q and −q",
        "Both are the end's rotation. Slerp to the wrong one still arrives, but turns 300° where"
        " 60° would do: check the sign of q₀ · q₁ first.",
        Params(
            half="move between two poses",
            angles=NO_TURN,
            angles_end=(0.0, 0.0, 60.0),
            method="slerp to -q",
        ),
        15,
    ),
    Preset(
        "one-axis",
        "The shortest turn, by slerp",
        "One axis leads from the first pose to the second, and the body turns"
        " about it at constant speed. The next experiment goes between the same two poses.",
        replace(WOBBLE, method="slerp + lerp"),
        15,
    ),
    Preset(
        "wobble",
        "Euler angles wobble",
        "Three angles at constant speed, yet the body leaves the shortest turn and changes"
        " its pace, because the axes of the angles move.",
        WOBBLE,
        15,
    ),
    Preset(
        "average",
        "The mean of 170° and −170°",
        "Two headings, 20° apart, and the number that names them is blended."
        " Green is the shortest turn: watch where orange goes.",
        AVERAGE,
        1,
    ),
    Preset(
        "entries",
        "Blend the matrix entries",
        "Each entry of the matrix runs evenly to that of a rotation 170° away."
        " Is what lies between a rotation? Step on, and look at the body and its volume.",
        ENTRIES,
        3,
        breaks=True,
    ),
    Preset(
        "screw",
        "Along a screw",
        "Exp and log on SE(3) turn about a line that stays put and slide along it: the origin"
        " follows a helix, not a straight line as with slerp + lerp.",
        Params(
            half="move between two poses",
            angles=NO_TURN,
            angles_end=(0.0, 0.0, 120.0),
            method="screw",
        ),
        15,
    ),
)


def complete(states: Sequence[State]) -> Built:
    """Return the step at which the map is complete."""
    return next(state for state in states if isinstance(state, Built) and state.complete)


def halfway(states: Sequence[State]) -> Moved:
    """Return the step nearest to t = 0.5."""
    return min(
        (state for state in states if isinstance(state, Moved)),
        key=lambda state: abs(state.t - 0.5),
    )


def directions_left(states: Sequence[State]) -> int:
    """Return in how many independent directions small changes of the three angles can turn the
    body.
    """
    state = complete(states)
    return int(np.linalg.matrix_rank(euler_axes(state.angles, state.params.order), tol=1e-9))


def jump_out_of_lock() -> np.ndarray:
    """Return the angles, radians, that turn the locked body by 1 degree more in the lost
    direction.
    """
    numbers = numbers_of(GIMBAL)
    return triple_past_lock(numbers.angles, numbers.order, np.radians(1.0))


def volume_kept(state: Built) -> float:
    """Return the volume now over the volume at the start."""
    return float(abs(np.linalg.det(state.T[:3, :3])))


def _sheared(states: Sequence[State]) -> float:
    volume = volume_kept(complete(states))
    return 1.0 if abs(volume - 1.0) < 1e-9 else 0.0 if volume < 1.0 else 2.0


def _end(states: Sequence[State]) -> Moved:
    last = states[-1]
    if not isinstance(last, Moved):
        raise ValueError("the run is one of building")
    return last


QUESTIONS: tuple[Question[Params, State], ...] = (
    Question(
        "which-order",
        "The house is turned 90° about the world's z and then moved 1.5 m along x. How far apart"
        " are the two results if it is moved first and turned afterwards?",
        answer=lambda states: complete(states).ghosts[0].distance,
        why=lambda states: (
            f"{length(complete(states).ghosts[0].distance)}: turned last, the translation swings"
            " round to the y axis, and (1.5, 0) and (0, 1.5) are √2 · 1.5 m apart."
        ),
        params=ORDER,
        unit="m",
        tolerance=0.15,
        step=-2,
        wrong=(
            (
                0.0,
                0.1,
                (
                    "They would agree if the order did not matter. A turn is about the world's"
                    " origin: it carries along what was moved before."
                ),
            ),
            (
                1.4,
                1.6,
                (
                    "That is how far each of the two is from the origin. They lie at right angles"
                    " to each other as seen from there."
                ),
            ),
            (
                2.9,
                3.1,
                (
                    "That would be so after half a turn: then the two lie on opposite sides of the"
                    " origin."
                ),
            ),
        ),
    ),
    Question(
        "lost-direction",
        "With the pitch at 90°, in how many independent directions can small changes of the three"
        " angles turn the house?",
        answer=lambda states: float(directions_left(states) - 1),
        why=lambda states: (
            f"{directions_left(states)}: angles 1 and 3 turn about the same line. No pose is out of"
            " reach, but 1° in the lost direction needs a jump from (30, 90, 50)° to"
            f" {in_degrees(jump_out_of_lock())}."
        ),
        params=GIMBAL,
        choices=(
            Choice(
                "1",
                "Only the first and the third angle turn about the same line. The second still has"
                " a line of its own.",
            ),
            Choice("2"),
            Choice(
                "3",
                "Three numbers are not yet three directions: at this pitch two of them turn about"
                " the same line.",
            ),
        ),
        step=-2,
    ),
    Question(
        "sheared-volume",
        "The house is sheared by 0.8: its top slides sideways. What happens to its volume?",
        answer=_sheared,
        why=lambda states: (
            f"It is {percent(volume_kept(complete(states)), 0)} of what it was: every horizontal"
            " layer only slides, and det ="
            f" {fixed(float(np.linalg.det(complete(states).T[:3, :3])), 2)}."
        ),
        params=SHEAR,
        choices=(
            Choice(
                "It shrinks",
                "Its upright edges lean and look squeezed, but base and height are what they were.",
            ),
            Choice("It stays"),
            Choice(
                "It grows", "Its upright edges get longer, but base and height are what they were."
            ),
        ),
        step=1,
    ),
    Question(
        "mean-heading",
        "Heading 170° at the start, −170° at the end, and the number is blended. How many degrees"
        " does the house turn?",
        answer=lambda states: float(_end(states).way.turned[-1]),
        why=lambda states: (
            f"{angle(_end(states).way.turned[-1])}: the number runs through 0°. The two headings"
            f" are only {angle(_end(states).shortest.turned[-1])} apart."
        ),
        params=AVERAGE,
        unit="deg",
        tolerance=10.0,
        wrong=(
            (0.0, 10.0, "The house does turn: the two headings are 20° apart."),
            (
                15.0,
                25.0,
                (
                    "That is the shortest turn, through 180°. The number knows nothing of it: it"
                    " runs from 170 down to −170."
                ),
            ),
            (160.0, 185.0, "That is half of the way: 170 to 0. The number goes on from 0 to −170."),
        ),
    ),
    Question(
        "mean-matrix",
        "Halfway between two rotations 170° apart, the entries of the matrices are averaged. How"
        " many percent of its volume does the house keep?",
        answer=lambda states: 100.0 * halfway(states).volume,
        why=lambda states: (
            f"{percent(halfway(states).volume)}: across the axis every length shrinks to cos 85° ="
            " 0.087, and the volume to its square."
        ),
        params=ENTRIES,
        unit="%",
        tolerance=2.0,
        step=15,
        wrong=(
            (
                6.0,
                12.0,
                (
                    "Every length across the axis shrinks to 8.7 %. There are two such directions,"
                    " so the volume shrinks to the square."
                ),
            ),
            (
                40.0,
                60.0,
                (
                    "The entries are halved between two opposite values, and those cancel nearly:"
                    " little is left of them."
                ),
            ),
            (
                90.0,
                100.0,
                (
                    "It would keep all of it if the average were a rotation. The average of two"
                    " rotation matrices is none."
                ),
            ),
        ),
    ),
)
