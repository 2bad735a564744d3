"""What to predict before looking."""

import numpy as np

from lessons.rotations.names import APARTS, Named, Read, axles
from lessons.rotations.poses import Moved
from lessons.rotations.presets import (
    AVERAGE,
    CHAIN,
    FIXED_OWN,
    GIMBAL,
    LEVEL,
    LOCKED,
    MEAN,
    MINUS_Q,
    TWENTY,
)
from workbench.certain import as_a
from workbench.geometry.motions import rotation_angle
from workbench.geometry.motions.rotations import triple_past_lock
from workbench.lesson import Choice, Question, States
from workbench.numerals import angle, brief, percent

FAR = int(np.argmin(np.abs(APARTS - 170.0)))


def directions_left(states: States) -> int:
    """Return in how many independent directions small changes of the three angles can turn the
    body at a pitch of 90 degrees.
    """
    pitch = as_a(Named, states[-1]).value
    return int(np.linalg.matrix_rank(axles(states.params, pitch), tol=1e-9))


def jump_out_of_lock() -> str:
    """Return the angles that turn the locked body by 1 degree in the lost direction, as words."""
    angles = np.degrees(triple_past_lock(np.radians(LOCKED), GIMBAL.order, np.radians(1.0)))
    around = (angles.round(2) + 180.0) % 360.0 - 180.0
    return "(" + ", ".join(brief(a, 5) for a in around.round(2)) + ")°"


def same_reading(states: States) -> int:
    """Return which of the readings is the same rotation, from 0 on."""
    return next(k for k, state in enumerate(states[1:]) if as_a(Read, state).off < 1e-6)


def _why_same(states: States) -> str:
    offs = [as_a(Read, state).off for state in states[1:]]
    wrong = " and ".join(angle(off) for off in offs if off > 1e-6)
    return (
        "Seen from the outermost ring, the last of the fixed turns comes first. So both the letters"
        f" and the numbers are in reverse. The other two are {wrong} off."
    )


def one_turn(states: States) -> float:
    """Return the angle of the whole chain, degrees, from the body itself."""
    return float(np.degrees(rotation_angle(as_a(Named, states[-1]).R)))


def turned(states: States) -> float:
    """Return how far the body turned in all, degrees."""
    return float(as_a(Moved, states[-1]).way.turned[-1])


def shortest(states: States) -> float:
    """Return the shortest turn between the poses, degrees."""
    return float(as_a(Moved, states[-1]).shortest.turned[-1])


def volume_left(states: States) -> float:
    """Return the volume of the mean 170 degrees apart, per cent."""
    return 100.0 * float(np.linalg.det(as_a(Named, states[FAR]).R))


QUESTIONS: tuple[Question, ...] = (
    Question(
        name="lost-direction",
        text=(
            "The middle ring is at 90°. In how many independent directions can small turns of the"
            " three rings turn the house?"
        ),
        answer=lambda states: float(directions_left(states) - 1),
        why=lambda states: (
            f"{directions_left(states)}. The outer and the inner ring turn about one line now. No"
            " pose is out of reach, but 1° in the lost direction needs a jump from (30, 90, 50)°"
            f" to {jump_out_of_lock()}."
        ),
        params=GIMBAL,
        start=LEVEL,
        choices=(
            Choice(
                "1",
                "Only two of the three rings share a line. The middle ring still has an axle of its"
                " own.",
            ),
            Choice("2"),
            Choice("3", "Three rings are three directions only while their axles are apart."),
        ),
    ),
    Question(
        name="same-turn",
        text=(
            "(40, 30, 70)° turns about fixed x, y and z. Which is the same turn about axes that the"
            " house carries along?"
        ),
        answer=lambda states: float(same_reading(states)),
        why=_why_same,
        params=FIXED_OWN,
        start=0,
        step=1,
        choices=(
            Choice("Z Y X with (70, 30, 40)°"),
            Choice(
                "X Y Z with (40, 30, 70)°",
                "Fixed or carried is not a matter of taste: after the first turn the axes differ.",
            ),
            Choice(
                "Z Y X with (40, 30, 70)°",
                "The letters are in reverse here and the numbers are not: 40° belongs to x.",
            ),
        ),
    ),
    Question(
        name="sum-of-turns",
        text="A quarter turn about x, then a quarter turn about z. How large is the one turn?",
        answer=one_turn,
        why=lambda states: (
            f"{angle(one_turn(states))}, about the line that is as far from x as from y and z."
            " Small turns nearly add as arrows do, large ones do not."
        ),
        params=CHAIN,
        start=0,
        unit="deg",
        tolerance=3.0,
        low=0.0,
        high=200.0,
        stride=1.0,
        wrong=(
            (88.0, 92.0, "The second turn does not replace the first one."),
            (
                125.0,
                129.0,
                "That is √2 · 90°: turns added as arrows. For two turns of 30° it is nearly true.",
            ),
            (178.0, 182.0, "Angles add up only where both turns are about one axis."),
        ),
    ),
    Question(
        name="long-way",
        text="The house is to turn by 60°, and slerp runs to −q. How far does the house turn?",
        answer=turned,
        why=lambda states: (
            f"{angle(turned(states))}. On the circle −q is 150° away from q₀, and the house turns"
            " twice that."
        ),
        params=MINUS_Q,
        start=0,
        unit="deg",
        tolerance=10.0,
        low=0.0,
        high=360.0,
        stride=10.0,
        wrong=(
            (50.0, 70.0, "Both names are one rotation, but the paths to them are not the same."),
            (
                140.0,
                160.0,
                "That is read off the circle. Its angles are halves: the house turns twice that.",
            ),
        ),
    ),
    Question(
        name="mean-heading",
        text=(
            "The heading is 170° at the start and −170° at the end, and the number is blended. How"
            " far does the house turn?"
        ),
        answer=turned,
        why=lambda states: (
            f"{angle(turned(states))}: the number runs down through 0°. The two headings are only"
            f" {angle(shortest(states))} apart."
        ),
        params=AVERAGE,
        start=0,
        unit="deg",
        tolerance=10.0,
        low=0.0,
        high=360.0,
        stride=10.0,
        wrong=(
            (0.0, 10.0, "The house does turn: the two headings are 20° apart."),
            (
                15.0,
                25.0,
                "That is the shortest turn, through 180°. The number knows no circle: it runs down"
                " from 170 to −170.",
            ),
            (160.0, 185.0, "That is half of the way, from 170 to 0. The number goes on to −170."),
        ),
    ),
    Question(
        name="mean-matrix",
        text=(
            "Two rotations are 170° apart, and the entries of their matrices are averaged. How much"
            " of its volume does the house keep?"
        ),
        answer=volume_left,
        why=lambda states: (
            f"{percent(volume_left(states) / 100.0)}: across the axis every length shrinks to cos"
            " 85° = 0.087, and the volume to its square."
        ),
        params=MEAN,
        start=TWENTY,
        step=FAR,
        unit="%",
        tolerance=2.0,
        low=0.0,
        high=100.0,
        stride=1.0,
        wrong=(
            (
                6.0,
                12.0,
                "Every length across the axis shrinks to 8.7 %. There are two such directions.",
            ),
            (
                40.0,
                60.0,
                "Halfway is not half. The entries are nearly opposite, and hardly anything is left"
                " of them.",
            ),
            (90.0, 100.0, "It would keep all if the mean of two rotations were a rotation."),
        ),
    ),
)
