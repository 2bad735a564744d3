"""What to predict before looking, with what is said to known wrong answers."""

import numpy as np

from lessons.pinhole.inputs import Input
from lessons.pinhole.models import State
from lessons.pinhole.presets import (
    ASIDE,
    BEHIND,
    CAMERA,
    CROP_RIGHT,
    DISTORT,
    DIVIDE,
    DOLLY,
    FRAME,
    PIXELS,
    RADIAL,
    RAILS,
)
from lessons.pinhole.shot import Shot, heights, pinhole_of
from workbench.geometry.cameras import camera_center, project, vanishing_points
from workbench.geometry.cameras.distortion import distort
from workbench.lesson import Choice, Question, States
from workbench.numerals import coordinates, fixed

Run = States[Input, Shot, State]


def towers(states: Run) -> tuple[float, float]:
    """Return how tall the tower is in the picture before the dolly and now."""
    return heights(states.params, 1.0)[1], states.subject.tower


def _which_dolly(states: Run) -> float:
    before, after = towers(states)
    if after > 1.05 * before:
        return 0.0
    return 2.0 if after < 0.95 * before else 1.0


def _why_dolly(states: Run) -> str:
    before, after = towers(states)
    return (
        f"It grows from {before:.0f} to {after:.0f} px. Heights go with f / Z: f is three times as"
        " long, and the tower's Z, which was larger to begin with, did not grow three times."
    )


def _which_behind(states: Run) -> float:
    uv = states[PIXELS].now.uv[states.subject.k]
    (h, w) = states.subject.picture.shape[:2]
    if not np.isfinite(uv).all():
        return 0.0
    return 2.0 if (uv > -0.5).all() and uv[0] < w - 0.5 and uv[1] < h - 0.5 else 1.0


def _why_behind(states: Run) -> str:
    k = states.subject.k
    (u, v) = states[PIXELS].now.uv[k]
    z = states[CAMERA].now.p_camera[k, 2]
    return (
        f"At ({u:.0f}, {v:.0f}), well inside the picture. Z = {fixed(z, 2)} m turns both signs, and"
        " a lamp above the axis shows up below it. Only the sign of Z tells; the pixel does not."
    )


def _which_centre(states: Run) -> float:
    T = states.subject.T_camera_world
    places = (T[:3, 3], -T[:3, 3])
    near = (float(i) for i, p in enumerate(places) if np.linalg.norm(p - camera_center(T)) < 0.1)
    return next(near, 2.0)


def _why_centre(states: Run) -> str:
    T = states.subject.T_camera_world
    C = camera_center(T)
    t = T[:3, 3]
    return (
        f"It is at C = −Rᵀt = {coordinates(C, 2)} m. t is where the camera sees the world's origin,"
        f" along its own axes. Both are {fixed(float(np.linalg.norm(t)), 2)} m long, since R only"
        " turns."
    )


def moved_aside(states: Run) -> tuple[float, float]:
    """Return how far the step moves the vanishing point and a near point of the rail, px to the
    right.
    """
    near = states[-1].now.p_world[3:4]
    d = np.array([[0.0, 1.0, 0.0]])
    first = pinhole_of(RAILS, 1.0).T_camera_world
    last = states.subject.T_camera_world
    K = states.subject.K
    far = vanishing_points(d, last, K) - vanishing_points(d, first, K)
    return float(far[0, 0]), float((project(near, last, K) - project(near, first, K))[0, 0])


def _which_rails(states: Run) -> float:
    shift = moved_aside(states)[0]
    if abs(shift) < 0.5:
        return 1.0
    return 0.0 if shift < 0 else 2.0


def _why_rails(states: Run) -> str:
    far, near = moved_aside(states)
    return (
        f"It moves by {fixed(abs(far), 0)} px, while a near point of the rail moves by"
        f" {fixed(abs(near), 0)} px to the {'left' if near < 0 else 'right'}. A direction has no"
        " place (w = 0), so t drops out of K [R | t] (d, 0) = K R d."
    )


def bow_through_the_middle(states: Run) -> float:
    """Return how far a slanting straight edge through the middle is bent away from its line, px."""
    r = np.linspace(-0.7, 0.7, 29)
    line = np.array([np.cos(0.4), np.sin(0.4)])
    bent = distort(r[:, None] * line, *states.subject.lens)
    return float(states.subject.K[0, 0] * np.abs(bent @ [-line[1], line[0]]).max())


def _why_middle(states: Run) -> str:
    bow = bow_through_the_middle(states)
    return (
        f"It is bent by {fixed(bow, 0)} px. Each of its points moves along its radius, and for an"
        " edge through the middle that is the edge itself."
    )


def _why_crop(states: Run) -> str:
    middle = (states.subject.picture.shape[1] - 1) / 2
    return (
        f"{states.subject.K[0, 2]:.2f} px: first 159.5 − 60 = 99.5, then (99.5 + 0.5) / 2 − 0.5,"
        f" since pixel centres are at integers. The middle of the picture is {middle} px."
    )


QUESTIONS: tuple[Question, ...] = (
    Question(
        name="predict-dolly",
        text="The camera backs off to three times its distance from the crate, and f becomes three"
        " times as long. The crate keeps its size. What does the tower behind it do in the"
        " picture?",
        answer=_which_dolly,
        why=_why_dolly,
        params=DOLLY,
        choices=(
            Choice("It grows"),
            Choice(
                "It keeps its size too",
                "It would if it stood at the crate's distance. Size goes with f / Z, and Z is"
                " another one for the tower.",
            ),
            Choice(
                "It shrinks",
                "It would if only the camera moved. The focal length has grown three times as"
                " well.",
            ),
        ),
        step=PIXELS,
    ),
    Question(
        name="predict-centre",
        text="T_camera_world of another camera has t = (−1.32, 1.96, 4.55) m. Where in the world"
        " is that camera?",
        answer=_which_centre,
        why=_why_centre,
        params=FRAME,
        start=CAMERA,
        choices=(
            Choice(
                "At t",
                "t is not a place in the world: it is the world's origin, given in the camera's"
                " frame.",
            ),
            Choice(
                "At −t",
                "It would be if the camera's axes were the world's. It is turned, so −t has to be"
                " turned back.",
            ),
            Choice("At neither of the two"),
        ),
        step=CAMERA,
    ),
    Question(
        name="predict-crop",
        text="60 columns and 40 rows are cut off at the left and top, then the picture is halved."
        " The principal point was at u = 159.5 px, where pixel centres are at integers. What is cx"
        " now?",
        answer=lambda states: float(states.subject.K[0, 2]),
        why=_why_crop,
        params=CROP_RIGHT,
        start=CAMERA,
        unit="px",
        tolerance=0.15,
        low=40.0,
        high=170.0,
        stride=0.25,
        step=PIXELS,
        wrong=(
            (
                49.7,
                50.1,
                "Nearly. The picture begins at −0.5 px, the left edge of pixel 0. Halving keeps"
                " this edge in place, and not the middle of pixel 0.",
            ),
            (
                64.0,
                65.5,
                "That is the middle of the new picture. The crop has moved the principal point"
                " away from the middle.",
            ),
            (
                79.0,
                80.5,
                "The picture was halved, but 60 columns are missing at the left too.",
            ),
            (
                99.0,
                100.5,
                "The crop is right. Then the picture was halved, and with it all its coordinates.",
            ),
            (
                159.0,
                160.0,
                "K must follow what is done to the picture: this is the old one.",
            ),
        ),
    ),
    Question(
        name="through-the-middle",
        text="This lens moves each point along its radius. A straight edge runs through the middle"
        " of the picture, slanting. How is it bent?",
        answer=lambda states: 2.0 if bow_through_the_middle(states) < 0.5 else 1.0,
        why=_why_middle,
        params=RADIAL,
        start=DIVIDE,
        choices=(
            Choice(
                "Most of all edges",
                "Its ends are far out and do move. But look at the direction in which they move.",
            ),
            Choice(
                "As much as other edges",
                "Other edges pass the middle at some distance, so their points move partly across"
                " the edge. Here none does.",
            ),
            Choice("Not at all"),
        ),
        step=DISTORT,
    ),
    Question(
        name="predict-rails",
        text="The camera steps 2 m to its right without turning. Where does the point go in which"
        " the rails seem to meet?",
        answer=_which_rails,
        why=_why_rails,
        params=ASIDE,
        choices=(
            Choice(
                "To the left in the picture",
                "Things nearby move to the left, by less the farther they are. This point is"
                " infinitely far away.",
            ),
            Choice("Nowhere: it stays"),
            Choice(
                "To the right in the picture",
                "That would be so if the camera turned to the left. It steps aside and keeps its"
                " direction.",
            ),
        ),
        step=PIXELS,
    ),
    Question(
        name="predict-behind",
        text="A lamp hangs 2.25 m behind the camera, and somebody divides by Z without looking at"
        " its sign. Where is its pixel?",
        answer=_which_behind,
        why=_why_behind,
        params=BEHIND,
        start=CAMERA,
        choices=(
            Choice(
                "Nowhere: the result is not a number",
                "Only Z = 0 gives no number. A negative Z divides like any other.",
            ),
            Choice(
                "Far outside the picture",
                "The size of x / Z does not depend on the sign of Z. Only the direction turns"
                " round.",
            ),
            Choice("In the picture, like any other"),
        ),
        step=PIXELS,
    ),
)
