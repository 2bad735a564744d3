"""Experiments that show what axes and pairs know and do not know, and what to predict before
looking.
"""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from lessons.alignment.state import AxesState, PairsState, Params, State, Turns
from workbench.certain import as_a, sure
from workbench.lesson import Choice, Preset, Question, View
from workbench.numerals import counted, fixed, length, percent

HOME = Params()
LARGEST = Params(signs="largest-entry")
FAR = Params(stray=(0.0, 10.0, 0.0))
PAIRS = Params(stage="pairs", noise=0.01)
MIRRORED = Params(stage="pairs", mirrored=True)
NEGATED = replace(MIRRORED, flip="whole")
SCALE = Params(stage="pairs", scale=1.5, noise=0.05)

VIEW = View(eye=(-0.75, -2.55, 1.1), target=(-0.62, 0.0, 0.12), grid=None, axes=False)
TOGETHER = View(eye=(-0.95, -2.3, 1.1), target=(-1.1, 0.0, 0.2), grid=None, axes=False)
WIDE = View(eye=(-1.7, -2.9, 1.7), target=(-0.75, 0.0, 0.3), grid=None, axes=False)
ABOVE = View(eye=(-1.05, -1.5, 2.0), target=(-1.2, 0.0, 0.0), grid=None, axes=False)
APART = View(eye=(-1.1, -3.6, 1.8), target=(-1.25, 0.0, 0.1), grid=None, axes=False)
LARGE = View(eye=(-1.1, -4.0, 1.9), target=(-1.1, 0.0, 0.15), grid=None, axes=False)
FIRST, FLIP = 3, 5  # steps: the first rotation; where a direction is turned round
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
    Preset(
        "pairs",
        "Pairs instead of axes",
        "Every point knows its partner, with 1 cm of noise. Vᵀ turns the second scan into its"
        " singular directions, U out of them.",
        PAIRS,
        3,
    ),
    Preset(
        "mirrored",
        "A mirror image",
        "The determinant is −1, and one direction has to be turned round. See what it costs with"
        " the least singular value.",
        MIRRORED,
        FLIP,
        TOGETHER,
    ),
    Preset(
        "wrong-flip",
        "The wrong direction turned round",
        "“Flip any column”: with the largest singular value the determinant is +1 as well. Compare"
        " the RMSE.",
        replace(MIRRORED, flip="largest"),
        FLIP,
        TOGETHER,
        breaks=True,
    ),
    Preset(
        "negated",
        "All of R negated",
        "−R has the determinant +1 too, and turns all three directions round. What does that cost?",
        NEGATED,
        4,
        TOGETHER,
        breaks=True,
    ),
    Preset(
        "flat",
        "A plate with noise",
        "Nothing is mirrored here, but nothing but noise tells a plate from its mirror image: see"
        " the determinant, a matter of chance.",
        Params(stage="pairs", shape="plate", points=200, noise=0.02),
        4,
        ABOVE,
        breaks=True,
    ),
    Preset(
        "scale",
        "Noise in both scans",
        "The first scan is 1.5 times as large; both have 5 cm of noise. Least squares blames the"
        " first scan alone, and the scale comes out too small.",
        SCALE,
        FLIP,
        LARGE,
        breaks=True,
    ),
    Preset(
        "scale-clean",
        "Noise in the first scan only",
        "Now the noise is where least squares expects it: the scale is 1.50 again. The ratio of"
        " sizes is not.",
        replace(SCALE, noisy="target"),
        -1,
        LARGE,
    ),
)


def of_axes(states: Sequence[State]) -> AxesState:
    """Return the last step of a run by axes."""
    return as_a(AxesState, states[-1])


def of_pairs(states: Sequence[State]) -> PairsState:
    """Return the last step of a run by pairs."""
    return as_a(PairsState, states[-1])


def turns_of(states: Sequence[State]) -> Turns:
    """Return what became of the many turns."""
    return sure(of_axes(states).turns)


def after_flip(states: Sequence[State]) -> float:
    """Return the RMSE once a direction is turned round, before any scale."""
    state = as_a(PairsState, states[FLIP])
    return state.now.rmse


def product(states: Sequence[State]) -> float:
    """Return the product of the scales there and back."""
    last = of_pairs(states)
    assert last.now.scale is not None
    return last.now.scale * last.back


def _why_product(states: Sequence[State]) -> str:
    last = of_pairs(states)
    assert last.now.scale is not None
    return (
        f"{fixed(last.now.scale, 3)} there and {fixed(last.back, 3)} back. Each way the scan that"
        " is moved counts as free of noise; its noise swells its size and shrinks the scale."
    )


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
    Question(
        "predict-negated",
        "A rabbit and its mirror image. The least direction turned round leaves an RMSE of 0.29 m."
        " What does −R leave, all three turned round?",
        answer=after_flip,
        why=lambda states: (
            f"{length(after_flip(states))}. Turning a direction round costs in proportion to its"
            " singular value, and now all three are paid for."
        ),
        params=NEGATED,
        step=FLIP,
        unit="m",
        tolerance=0.1,
        wrong=(
            (
                0.0,
                0.34,
                (
                    "The least direction is the cheapest, and now two dearer ones are turned round"
                    " as well."
                ),
            ),
            (
                0.45,
                0.55,
                (
                    "That counts three directions of the same cost, √3 · 0.29 m. The others cost"
                    " more than the least."
                ),
            ),
            (
                0.85,
                0.9,
                (
                    "Three times 0.29 m: but squares are added, not lengths, and the three do not"
                    " cost the same."
                ),
            ),
        ),
    ),
    Question(
        "predict-product",
        "True scale 1.5, noise of 5 cm in both scans. The scale from second to first, times the"
        " scale from first to second, makes …",
        answer=lambda states: float(np.digitize(product(states), [0.98, 1.02])),
        why=_why_product,
        params=SCALE,
        choices=(
            Choice("less than 1"),
            Choice(
                "1, one being the inverse of the other",
                "It would be so without noise. Each fit blames the noise on the other scan, so the"
                " two fits differ.",
            ),
            Choice(
                "more than 1",
                "Noise makes each scan look larger, but as the scan that is moved, which is then"
                " scaled down.",
            ),
        ),
    ),
)
