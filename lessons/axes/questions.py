"""What to predict before looking."""

import numpy as np

from lessons.axes.flat import Outline
from lessons.axes.inputs import Input
from lessons.axes.presets import (
    FIRST,
    FLAT,
    FRAMES,
    LARGEST,
    LEAST_LIKELY,
    POSE,
    STARTS,
    STRAY,
    TURNS,
    at,
)
from lessons.axes.space import HOME_DEGREES, State, Turns
from lessons.axes.starts import Race
from workbench.certain import as_a, sure
from workbench.lesson import Choice, Question, States
from workbench.numerals import angle, counted, length, percent


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
