"""Experiments with poses, and what to predict before looking."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from lessons.pose.draw import ABOVE
from lessons.pose.state import Params, Repeated, State
from lessons.pose.trials import TRIPLES
from workbench.algorithms.robust.ransac import iterations_needed
from workbench.certain import as_a, sure
from workbench.lesson import Choice, Preset, Question
from workbench.numerals import angle, fixed, percent

FOUR = Params(target="triangle", camera=(0.1, 0.05, 2.0), noise=0.0, refine=False)
MARKER = Params(target="marker", method="IPPE", noise=0.5)
TILTED = Params(target="marker", method="IPPE", noise=0.5, distance=4.0, tilt=60.0, seed=9)
FEW = Params(method="EPnP", points=4, refine=False, seed=18)
PLANE = Params(method="DLT", thickness=0.0)
HALF = Params(method="RANSAC", points=100, outliers=0.5)

PRESETS: tuple[Preset[Params], ...] = (
    Preset(
        "four",
        "Four cameras, one picture",
        "Four ways to put a triangle on three rays: each of the four cameras sees the three points"
        " where they were seen. Then a fourth point chooses.",
        FOUR,
        6,
        replace(ABOVE, eye=(7.2, -4.5, 4.3), target=(1.0, 0.65, 1.1)),
    ),
    Preset(
        "cylinder",
        "On the danger cylinder",
        "The camera is straight above the circle through the three points. Here two solutions run"
        " into one: half a pixel of noise moves the answer far, or loses it.",
        Params(target="triangle", camera=(1.0, 0.0, 4.0), noise=0.5, refine=False, seed=1),
        -1,
        breaks=True,
    ),
    Preset(
        "outside",
        "Off the danger cylinder",
        "The same triangle from twice as far beside its middle: the same noise moves the camera by"
        " centimetres.",
        Params(target="triangle", camera=(2.0, 0.0, 4.0), noise=0.5, refine=False),
        -1,
    ),
    Preset(
        "marker",
        "A square marker",
        "80 pixels wide and turned away by 40°: two poses, and perspective tells them apart, as the"
        " errors of both show.",
        MARKER,
        1,
    ),
    Preset(
        "tiny",
        "The same marker, four times as far",
        "20 pixels wide. Both poses fit to within the noise, and which of them fits better is left"
        " to chance: look at the normals in other pictures.",
        Params(target="marker", method="IPPE", noise=0.5, distance=4.0, seed=9),
        -1,
        breaks=True,
    ),
    Preset(
        "frontal",
        "A large marker, nearly frontal",
        "160 pixels wide and hardly turned: IPPE's two poses are two, but both refine to one."
        " Looking straight at it is no ambiguity in itself.",
        Params(target="marker", method="IPPE", noise=0.5, distance=0.5, tilt=10.0),
        2,
    ),
    Preset(
        "thin",
        "A thin box, by the linear transform",
        "A box of a tenth of the thickness. The linear transform lives on depth: see how far it is"
        " off, and what Gauss-Newton makes of that.",
        Params(method="DLT", thickness=0.1),
        1,
        breaks=True,
    ),
    Preset(
        "sheet",
        "A sheet",
        "6 mm thick: what the linear transform gives is no place to go down from. Look where the"
        " cameras of other pictures are.",
        Params(method="DLT", thickness=0.01),
        -1,
        breaks=True,
    ),
    Preset(
        "safe",
        "The same sheet, by SQPnP",
        "SQPnP looks for a rotation from the start, so it needs no depth: the same points, the same"
        " noise, and it ends right.",
        Params(method="SQPnP", thickness=0.01),
        -1,
    ),
    Preset(
        "few",
        "EPnP on four points",
        "Four points leave EPnP four vectors to mix and six distances to say how, and it may end in"
        " another mix. The last step compares it with SQPnP, on other points.",
        FEW,
        1,
        breaks=True,
    ),
    Preset(
        "map",
        "Coordinates of a map",
        "A street whose points are known from a map, its origin 10 km off, and the linear transform"
        " takes them as they are: many metres of error out of nothing but large numbers.",
        Params(target="street", method="DLT", origin=10.0, centred=False),
        1,
        breaks=True,
    ),
    Preset(
        "centred",
        "The same map, minus the mean",
        "Points are taken relative to their mean, and the motion is moved back at the end. Now the"
        " origin may be anywhere.",
        Params(target="street", method="DLT", origin=10.0),
        -1,
    ),
    Preset(
        "believed",
        "Two wrong points of twenty",
        "Two points are seen somewhere else, and least squares believes them. The error in the"
        " picture is large for all points, so it does not tell whom to blame.",
        Params(method="SQPnP", outliers=0.1),
        -1,
        breaks=True,
    ),
    Preset(
        "seventy",
        "70 % outliers",
        "Of 100 points of the street's map 70 are seen somewhere else. Only one sample of three in"
        " 37 is clean, and yet RANSAC needs only a few hundred of them: that is what P3P is for.",
        Params(target="street", method="RANSAC", points=100, outliers=0.7),
        -1,
    ),
)


def others(states: Sequence[State]) -> Repeated:
    """Return what was found in other pictures."""
    return as_a(Repeated, states[-1].now)


def most_frequent(states: Sequence[State]) -> int:
    """Return how many solutions most random triples have."""
    counts = sure(others(states).counts)
    return int(np.argmax(counts))


def swapped(states: Sequence[State]) -> float:
    """Return in which per cent of the pictures the wrong one of a plane's poses fitted better."""
    trials = others(states)
    return 100.0 * (trials.swapped or 0) / trials.pictures


def needed(states: Sequence[State], size: int) -> float:
    """Return how many samples of a size are needed at the true share of inliers."""
    clean = float(np.mean(~states[0].subject.given.is_outlier))
    return iterations_needed(clean, size, 0.99)


def _most_why(states: Sequence[State]) -> str:
    trials, most = others(states), most_frequent(states)
    assert trials.counts is not None
    return (
        f"{percent(trials.counts[most] / TRIPLES, 0)} of {TRIPLES:,} random triples have {most}. A"
        f" quartic has up to four real roots, and {percent(trials.counts[4] / TRIPLES, 1)} of the"
        " triples use them all; what you saw here is one of these."
    )


def _few_why(states: Sequence[State]) -> str:
    far = [percent(share, 0) for share in others(states).far]
    return (
        f"In {far[0]} by this implementation, by OpenCV's in about twice as many, and SQPnP's in"
        f" {far[1]} of the same pictures. Four points leave four null vectors, and Gauss-Newton on"
        " their weights begins at a linear guess, so it may end in another mix. From six points on"
        " there is one vector, and nothing to mix."
    )


def _plane_why(states: Sequence[State]) -> str:
    middle = angle(float(np.median(others(states).degrees)))
    return (
        f"By {middle} in the middle of 40 pictures. Of points in a plane the twelve numbers of the"
        " matrix are not determined: whole families fit, and noise picks one. The rotation in it"
        " means nothing."
    )


QUESTIONS: tuple[Question[Params, State], ...] = (
    Question(
        name="predict-solutions",
        text=(
            "Three known points leave up to four places for a camera. How many are there for most"
            " triples of points, drawn by chance?"
        ),
        answer=lambda states: most_frequent(states) - 1,
        why=_most_why,
        params=FOUR,
        choices=(
            Choice(
                "one",
                why=(
                    "Three laws of cosines are quadratic: of two lengths that fit, one is seldom"
                    " ruled out."
                ),
            ),
            "two",
            Choice(
                "three", why="Roots of the quartic come and go in pairs, so an odd number is rare."
            ),
            Choice(
                "four",
                why="A quartic has up to four roots. For most triples two of them are complex.",
            ),
        ),
    ),
    Question(
        name="predict-wrong",
        text=(
            "A marker is 20 pixels wide and turned away by 60°; the noise is half a pixel. In how"
            " many per cent of such pictures does the wrong one of its two poses fit better?"
        ),
        answer=swapped,
        why=lambda states: (
            f"In {fixed(swapped(states), 0)} % of the pictures. It is not looking straight at it"
            " that makes a marker ambiguous: at 20 pixels the two poses differ by less than the"
            " noise, however it is turned."
        ),
        params=TILTED,
        unit="%",
        tolerance=14.0,
        wrong=(
            (
                0.0,
                10.0,
                (
                    "A large marker so turned is unambiguous. At 20 pixels noise hides the"
                    " perspective that decides."
                ),
            ),
            (
                50.0,
                60.0,
                (
                    "Half would be chance alone. Some perspective is left, and it decides more"
                    " often than not."
                ),
            ),
        ),
    ),
    Question(
        name="predict-samples",
        text=(
            "Half of the points are wrong. Samples of three need 35 draws for 99 % confidence that"
            " one is clean. How many would samples of six need, which the linear transform takes?"
        ),
        answer=lambda states: needed(states, 6),
        why=lambda states: (
            f"0.5³ of the samples of three are clean, 0.5⁶ of those of six: {needed(states, 3):.0f}"
            f" and {needed(states, 6):.0f} samples for 99 %. Draw as few points as determine a"
            " pose."
        ),
        params=HALF,
        tolerance=60.0,
        wrong=(
            (
                65.0,
                75.0,
                (
                    "Twice the points, but not twice the samples: each further point halves the"
                    " share of clean ones."
                ),
            ),
            (
                140.0,
                225.0,
                "Each of the three further points halves the share of clean samples: 2 × 2 × 2.",
            ),
            (1000.0, 1400.0, "That squares 35. But one clean sample in 8 becomes one in 64."),
        ),
    ),
    Question(
        name="predict-few",
        text=(
            "EPnP takes any number of points from four on. Cameras turned at random see four random"
            " points each, with a noise of one pixel. In how many of the pictures is EPnP's"
            " rotation over 5° off?"
        ),
        answer=lambda states: float(np.digitize(others(states).far[0], [0.03, 0.5])),
        why=_few_why,
        params=FEW,
        choices=(
            Choice(
                "fewer than 3 %",
                why=(
                    "So it is from six points on. Four leave it a choice among mixes of four"
                    " vectors."
                ),
            ),
            "between 3 % and half of them",
            Choice(
                "more than half",
                why="Four points do determine a pose, and EPnP mostly finds the right mix.",
            ),
        ),
    ),
    Question(
        name="predict-plane",
        text=(
            "All points lie in one plane, and the linear transform makes a pose of them; then it is"
            " refined. How far is the rotation off?"
        ),
        answer=lambda states: float(np.digitize(np.median(others(states).degrees), [2.0, 20.0])),
        why=_plane_why,
        params=PLANE,
        choices=(
            Choice(
                "by less than 2°",
                why="Refining goes down from where it starts, and here it starts anywhere.",
            ),
            Choice(
                "by 2° to 20°",
                why="This is not noise made larger: the matrix itself is not determined.",
            ),
            "by more: it means nothing",
        ),
    ),
)
