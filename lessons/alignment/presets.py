"""Experiments that show what axes know and do not know, and what to predict before looking."""

from collections.abc import Sequence
from dataclasses import replace

from lessons.alignment.state import Params, State, Turns
from workbench.certain import sure
from workbench.lesson import Preset, Question, View
from workbench.numerals import counted, percent

HOME = Params()
LARGEST = Params(signs="largest-entry")
FAR = Params(stray=(0.0, 10.0, 0.0))

VIEW = View(eye=(-0.75, -2.55, 1.1), target=(-0.62, 0.0, 0.12), grid=None, axes=False)
TOGETHER = View(eye=(-0.95, -2.3, 1.1), target=(-1.1, 0.0, 0.2), grid=None, axes=False)
WIDE = View(eye=(-1.7, -2.9, 1.7), target=(-0.75, 0.0, 0.3), grid=None, axes=False)
APART = View(eye=(-1.1, -3.6, 1.8), target=(-1.25, 0.0, 0.1), grid=None, axes=False)
FIRST = 3  # the step of the first rotation
POSE, TURNS = -2, -1

PRESETS: tuple[Preset[Params], ...] = (
    Preset(
        "home",
        "Plane turns find the axes",
        "Each rotation makes the largest entry off the diagonal zero and disturbs the others. Step"
        " on, and read how fast what is left shrinks.",
        HOME,
        FIRST,
    ),
    Preset(
        "signs",
        "A rule that looks at numbers",
        "The largest entry of each axis is made positive: the same scan gives the same signs. And"
        " the same scan, turned?",
        LARGEST,
        POSE,
        TOGETHER,
        breaks=True,
    ),
    Preset(
        "fresh",
        "Two scans, no point in common",
        "Third moments turn with the shape. Other points of the same rabbit have other moments: one"
        " of them is small, and its sign at stake.",
        Params(fresh=True),
        TURNS,
        TOGETHER,
        breaks=True,
    ),
    Preset(
        "box",
        "A box has no front",
        "Half a turn takes a box to itself, so its third moments are 0 and chance gives them a"
        " sign. Compare what the points say with the truth.",
        Params(shape="box", fresh=True),
        POSE,
        TOGETHER,
        breaks=True,
    ),
    Preset(
        "vase",
        "A vase, turned",
        "Two of its variances are equal, so every direction across its own axis is a principal one."
        " Axis 1 stays; see where axis 2 goes.",
        Params(shape="vase", fresh=True),
        TURNS,
        TOGETHER,
        breaks=True,
    ),
    Preset(
        "nearly",
        "Nearly equal sides",
        "Sides of 1 m and 0.99 m: their variances differ by less than sampling does. Look at the"
        " axes in the table.",
        Params(shape="box", fresh=True, side=0.99),
        POSE,
        TOGETHER,
        breaks=True,
    ),
    Preset(
        "cube",
        "The box of a cube",
        "All variances are equal. The box along principal axes is often taken for the smallest:"
        " compare its volume with the cube's.",
        Params(shape="cube", fresh=True),
        POSE,
        APART,
        breaks=True,
    ),
    Preset(
        "density",
        "The upper half twice as dense",
        "Principal axes are those of the points, not of the surface: no point of the second scan"
        " lies off the rabbit.",
        Params(density=2),
        POSE,
        TOGETHER,
        breaks=True,
    ),
    Preset(
        "part",
        "A fifth is missing",
        "The second scan saw 80 % of the rabbit. Centroid and axes are those of that part.",
        Params(seen=0.8),
        POSE,
        TOGETHER,
        breaks=True,
    ),
    Preset(
        "stray",
        "One stray point",
        "One point of 1,501 lies 2 m away. Axis 1 moves by 2° only, but the signs are made of"
        " cubes.",
        Params(stray=(0.0, 2.0, 0.0)),
        POSE,
        breaks=True,
    ),
    Preset(
        "far",
        "The same point, 10 m away",
        "Squares listen most to the farthest point: one of 1,501 decides where axis 1 points.",
        FAR,
        FIRST,
        WIDE,
        breaks=True,
    ),
)


def of_axes(states: Sequence[State]) -> State:
    """Return the last step of a run."""
    return states[-1]


def turns_of(states: Sequence[State]) -> Turns:
    """Return what became of the many turns."""
    return sure(of_axes(states).turns)


QUESTIONS: tuple[Question[Params, State], ...] = (
    Question(
        "predict-rotations",
        "A rotation makes one of three entries off the diagonal zero, and the next one brings it"
        " back, smaller. After how many rotations is nothing but rounding left?",
        answer=lambda states: float(of_axes(states).rotations),
        why=lambda states: (
            f"{counted(of_axes(states).rotations, 'rotation')}: slowly at first; in the end each"
            " sweep of three squares what is left."
        ),
        params=HOME,
        step=10,
        tolerance=2.0,
        wrong=(
            (
                1,
                4,
                (
                    "There are three entries, but a rotation brings the earlier ones back, smaller."
                    " Each has to be made zero more than once."
                ),
            ),
            (
                15,
                200,
                (
                    "It is much faster: once the entries are small, three rotations square what is"
                    " left."
                ),
            ),
        ),
    ),
    Question(
        "predict-frames",
        "Three lines are given, in the order of variance. How many right-handed frames have them as"
        " axes?",
        answer=lambda states: float(of_axes(states).frames),
        why=lambda states: (
            f"{of_axes(states).frames}: each line has two ends, and of the eight choices half are"
            " left-handed. They are half a turn apart."
        ),
        params=replace(HOME, turn=60.0),
        step=POSE,
        tolerance=0.5,
        wrong=(
            (
                1,
                1,
                (
                    "As lines they are given, but each line has two ends, and nothing says which"
                    " one is the tip."
                ),
            ),
            (2, 2, "Front and back is one choice of two. A second axis has two ends as well."),
            (8, 8, "Three lines with two ends each make eight, but half of these are left-handed."),
        ),
    ),
    Question(
        "predict-signs",
        "Signs by the largest entry, as many libraries do. The same scan is turned at random, 100"
        " times: how many percent come home?",
        answer=lambda states: 100.0 * float(turns_of(states).home.mean()),
        why=lambda states: (
            f"{percent(float(turns_of(states).home.mean()), 0)}, as by chance, one frame of four."
            " The rule is deterministic, but it looks at coordinates, and a turn changes them."
        ),
        params=LARGEST,
        step=TURNS,
        unit="%",
        tolerance=8.0,
        wrong=(
            (
                0,
                10,
                "Some come home by chance: four frames are possible, and one of them is right.",
            ),
            (
                45,
                55,
                (
                    "There are two signs to get right, those of axes 1 and 2. Half of a half is a"
                    " quarter."
                ),
            ),
            (
                90,
                100,
                (
                    "The rule gives the same signs for the same numbers, but a turn changes the"
                    " numbers."
                ),
            ),
        ),
    ),
)
