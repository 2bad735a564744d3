"""Runs worth seeing, cameras, and what to predict before looking."""

from dataclasses import replace

import numpy as np

from lessons.axes.flat import HAND, Outline, outline_of
from lessons.axes.inputs import Input
from lessons.axes.space import HOME_DEGREES, State, Turns
from lessons.axes.starts import Race
from workbench.certain import as_a, sure
from workbench.lesson import Choice, Preset, Question, States, Sweep, View
from workbench.numerals import angle, counted, length, percent

FLAT = Input(stage="flat")
LARGEST = Input(signs="largest-entry")
STRAY = Input(stray=(0.0, 2.0, 0.0))
NEARLY = Input(shape="box", fresh=True, side=0.99)
FRAMES = Input(stage="frames")
STARTS = Input(stage="starts", fresh=True)

VIEW = View(eye=(-0.75, -2.55, 1.1), target=(-0.62, 0.0, 0.12), grid=None, axes=False)
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
    "both": VIEW,
    "matrix": MATRIX,
    "four": FOUR,
    "globe": GLOBE,
    "together": TOGETHER,
    "apart": APART,
}
FIRST, POSE, TURNS = 3, -2, -1  # steps of the default run, or from the end
LEAST_LIKELY = 150.0  # degrees: what is farther off is about half a turn


def _preset(
    name: str,
    title: str,
    line: str,
    params: Input,
    step: int,
    view: View | None = None,
    *,
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
        Input(),
        FIRST,
    ),
    _preset(
        "shadow",
        "A line under the rabbit",
        "The shadow of 60 points on a line: its spread changes with the direction.",
        FLAT,
        at(30),
        FRONT,
    ),
    _preset(
        "one-aside",
        "One point 1 m behind the outline",
        "One of 61 points lies 1 m aside. The longest direction turns towards it.",
        replace(FLAT, aside=1.0),
        at(outline_of(1.0).longest),
        ASIDE,
        breaks=True,
    ),
    _preset(
        "two-aside",
        "The same point, 2 m behind the outline",
        "Squares count distance twice: the farther the point, the more of the axis it has.",
        replace(FLAT, aside=2.0),
        at(outline_of(2.0).longest),
        ASIDE,
        breaks=True,
    ),
    _preset(
        "by-hand",
        "One plane turned by hand",
        "The frame turns in one plane, and the entry of that plane passes through zero.",
        Input(stage="turn"),
        30,
        MATRIX,
    ),
    _preset(
        "frames",
        "All frames of one cloud",
        "The axes are lines. Each choice of tips that is right-handed brings the second scan over.",
        FRAMES,
        0,
        FOUR,
    ),
    _preset(
        "unsigned",
        "No rule at all",
        "The signs stay as the plane turns happened to leave them.",
        Input(signs="none"),
        TURNS,
        GLOBE,
        breaks=True,
    ),
    _preset(
        "signs",
        "A rule that looks at numbers",
        "The largest entry of each axis is made positive: the same scan gives the same signs. And"
        " the same scan, turned?",
        LARGEST,
        POSE,
        TOGETHER,
        breaks=True,
    ),
    _preset(
        "fresh",
        "Two scans, no point in common",
        "Third moments turn with the shape. Other points of the same rabbit have other moments: one"
        " of them is small, and its sign at stake.",
        Input(fresh=True),
        TURNS,
        GLOBE,
        breaks=True,
    ),
    _preset(
        "unlucky",
        "Another draw of the first scan",
        "The same rule and another seed: the small moment of the first scan has the other sign.",
        Input(fresh=True, seed=2),
        TURNS,
        GLOBE,
        breaks=True,
    ),
    _preset(
        "box",
        "A box has no front",
        "Half a turn takes a box to itself, so its third moments are 0 and chance gives them a"
        " sign.",
        Input(shape="box", fresh=True),
        POSE,
        TOGETHER,
        breaks=True,
    ),
    _preset(
        "vase",
        "A vase, turned",
        "Two of its variances are equal, so every direction across its own axis is a principal"
        " one.",
        Input(shape="vase", fresh=True),
        TURNS,
        GLOBE,
        breaks=True,
    ),
    _preset(
        "nearly",
        "Nearly equal sides",
        "Sides of 1 m and 0.99 m: their variances differ by less than sampling does.",
        NEARLY,
        POSE,
        TOGETHER,
        breaks=True,
    ),
    _preset(
        "cube",
        "The box of a cube",
        "All variances are equal. The box along principal axes is often taken for the smallest:"
        " compare its volume with the cube's.",
        Input(shape="cube", fresh=True),
        POSE,
        APART,
        breaks=True,
    ),
    _preset(
        "density",
        "The upper half twice as dense",
        "Principal axes are those of the points, not of the surface: no point of the second scan"
        " lies off the rabbit.",
        Input(density=2),
        POSE,
        TOGETHER,
        breaks=True,
    ),
    _preset(
        "part",
        "A fifth is missing",
        "The second scan saw 80 % of the rabbit. Centroid and axes are those of that part.",
        Input(seen=0.8),
        POSE,
        TOGETHER,
        breaks=True,
    ),
    _preset(
        "stray",
        "One stray point",
        "One point of 1,501 lies 2 m away. Axis 1 moves by 2° only, but the signs are made of"
        " cubes.",
        STRAY,
        0,
        None,
        breaks=True,
    ),
    _preset(
        "far",
        "The same point, 10 m away",
        "Squares listen most to the farthest point: one of 1,501 decides where axis 1 points.",
        Input(stray=(0.0, 10.0, 0.0)),
        FIRST,
        WIDE,
        breaks=True,
    ),
    _preset(
        "starts",
        "A start from each frame",
        "ICP from each of the frames, on two scans without a common point.",
        STARTS,
        0,
        FOUR,
    ),
    _preset(
        "starts-part",
        "Four starts, a fifth unseen",
        "The second scan saw 80 % of the rabbit, and both have 5 mm of noise. ICP mends the tilt.",
        replace(STARTS, seen=0.8, noise=0.005),
        0,
        FOUR,
    ),
    _preset(
        "starts-vase",
        "Four starts for a vase",
        "Its axes are a matter of chance, so none of the frames has to be near.",
        replace(STARTS, shape="vase"),
        0,
        FOUR,
        breaks=True,
    ),
)


def _last(states: States) -> State:
    return as_a(State, states[-1])


def turns_of(states: States) -> Turns:
    """Return what became of the many turns."""
    return sure(_last(states).turns)


def _share(states: States) -> float:
    return 100.0 * float(turns_of(states).home.mean())


def _shortest(states: States) -> float:
    return (as_a(Outline, states.subject).longest + 90.0) % 180.0


def _off(states: States) -> float:
    return sure(_last(states).outcome).rotation


def _why_stray(states: States) -> str:
    first = angle(float(sure(sure(_last(states).outcome).axes)[0]))
    return (
        f"{angle(_off(states))}. Axis 1 turns by {first}, but the stray point's distance enters the"
        " third moment as a cube, and one moment has got the other sign."
    )


def _wins(states: States) -> float:
    race = as_a(Race, states[-1])
    if race.off[race.winner] < HOME_DEGREES:
        return 0.0
    return 2.0 if race.off[fallen_most(states)] < HOME_DEGREES else 1.0


def fallen_most(states: States) -> int:
    """Return the frame, from 0, whose RMSE has fallen most."""
    first = as_a(Race, states[0])
    return int(np.argmax(first.rmse - as_a(Race, states[-1]).rmse))


def _why_wins(states: States) -> str:
    race = as_a(Race, states[-1])
    low, following = (length(float(v)) for v in np.sort(race.rmse)[:2])
    return (
        f"Frame {race.winner + 1}: {low} against {following} and more, and it is"
        f" {angle(float(race.off[race.winner]))} from the truth. One of the four frames had to be"
        " near."
    )


QUESTIONS: tuple[Question, ...] = (
    Question(
        name="second",
        text="The shadow is longest along the line at 71°. Along which line is it shortest?",
        answer=lambda states: float(abs(_shortest(states) - 161.0) > 0.5),
        why=lambda states: (
            f"{angle(_shortest(states), 3)}. The shadow depends on an ellipse alone, and the two"
            " axes of an ellipse are at right angles."
        ),
        params=FLAT,
        start=at(71),
        step=at(161),
        choices=(
            Choice("161°, at a right angle"),
            Choice(
                "It depends on the shape",
                "Where the longest direction lies depends on the shape. The shortest one then has"
                " no choice left.",
            ),
            Choice("19°", "That is 90° − 71°. Go on by 90° in place of that: 71° + 90°."),
        ),
    ),
    Question(
        name="predict-rotations",
        text=(
            "A turn makes one of three entries off the diagonal zero, and the next one brings it"
            " back, smaller. After how many turns is nothing but rounding left?"
        ),
        answer=lambda states: float(_last(states).rotations),
        why=lambda states: (
            f"{counted(_last(states).rotations, 'turn')}: slowly at first; in the end each round of"
            " three squares what is left."
        ),
        params=Input(),
        start=FIRST,
        step=10,
        tolerance=2.0,
        low=1,
        high=40,
        stride=1,
        wrong=(
            (
                1,
                4,
                (
                    "There are three entries, but a turn brings the earlier ones back, smaller."
                    " Each has to be made zero more than once."
                ),
            ),
            (15, 200, "Once the entries are small, three turns square what is left."),
        ),
    ),
    Question(
        name="predict-frames",
        text=(
            "Three lines are given, in the order of variance. How many right-handed frames have"
            " them as axes?"
        ),
        answer=lambda states: float(len(_last(states).frames)),
        why=lambda states: (
            f"{len(_last(states).frames)}: each line has two ends, and of the eight choices half"
            " are left-handed. They are half a turn apart."
        ),
        params=FRAMES,
        start=0,
        step=-1,
        tolerance=0.5,
        low=1,
        high=10,
        stride=1,
        wrong=(
            (1, 1, "As lines they are given, but nothing says which end of a line is the tip."),
            (2, 2, "Front and back is one choice of two. A second axis has two ends as well."),
            (3, 3, "There are three lines, but each of them has two ends."),
            (8, 8, "Three lines with two ends each make eight, but half of these are left-handed."),
        ),
    ),
    Question(
        name="predict-signs",
        text=(
            "Signs by the largest entry, as many libraries do. The same scan is turned at random,"
            " 100 times. How many of the 100 come home?"
        ),
        answer=_share,
        why=lambda states: (
            f"{percent(_share(states) / 100.0, 0)}, as by chance, one frame of four. The rule is"
            " deterministic, but it looks at coordinates, and a turn changes them."
        ),
        params=LARGEST,
        start=POSE,
        step=TURNS,
        unit="%",
        tolerance=8.0,
        low=0,
        high=100,
        stride=1,
        wrong=(
            (
                0,
                10,
                "Some come home by chance: four frames are possible, and one of them is right.",
            ),
            (45, 55, "There are two signs to get right, those of axes 1 and 2: half of a half."),
            (90, 100, "The rule gives the same signs for the same numbers. A turn changes them."),
        ),
    ),
    Question(
        name="one-stray",
        text=(
            "One more point, 2 m away from 1,500, turns axis 1 by 2°. How far is the frame off,"
            " with signs by third moments?"
        ),
        answer=lambda states: float(np.digitize(_off(states), [HOME_DEGREES, LEAST_LIKELY])),
        why=_why_stray,
        params=STRAY,
        start=0,
        step=POSE,
        choices=(
            Choice(
                "2° as well",
                "The axes do turn by 2°, as lines. But a frame has tips, and a rule with cubes in"
                " it chooses them.",
            ),
            Choice(
                "About 45°",
                "A frame can be off by little, as its lines are, or by about half a turn.",
            ),
            Choice("About 180°"),
        ),
    ),
    Question(
        name="which-wins",
        text="All four runs of ICP have stopped, and each has its RMSE. Which one is home?",
        answer=_wins,
        why=_why_wins,
        params=STARTS,
        start=-2,
        step=-1,
        choices=(
            Choice("The one with the lowest RMSE"),
            Choice(
                "Nobody can tell by the RMSE",
                "Alone a small RMSE proves nothing. Beside three rivals it does, if one of the four"
                " starts was near.",
            ),
            Choice(
                "The one whose RMSE fell most, however low it ends",
                "That one began high up, and it stops in a wrong valley: it is half a turn off. Not"
                " the way down counts, but where it ends.",
            ),
        ),
    ),
)

SWEEPS = (
    Sweep("signs", ("none", "largest-entry", "third-moment")),
    Sweep("side", (0.6, 0.8, 0.9, 0.95, 0.99), run="nearly"),
    Sweep("seen", (0.5, 0.6, 0.7, 0.8, 1.0), run="starts"),
)
