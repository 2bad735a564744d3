"""Presets and questions: what to look for, and why it happens."""

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from lessons.fitting.captions import square
from lessons.fitting.fit_studies import AWAY
from lessons.fitting.state import Params, State
from workbench.algorithms.least_squares import Walked
from workbench.lesson import Choice, Preset, Question, View
from workbench.numerals import angle, fixed, length

HOME = Params()
ESCAPE = Params(start=(2.5, 0.0, 0.0), start_radius=1.0)
LEAP = Params(start=(-1.5, 0.8, 0.0), start_radius=1.0, method="Gauss-Newton")
ALIKE = Params(errors="alike in neighbours")
STEEP = Params(stage="line", noise=0.1)
EDGE = Params(
    stage="robust", loss="squares", points=300, noise=0.01, outliers=0.3, reach=2.0, side="both"
)
TUKEY = Params(stage="robust", points=300, noise=0.01, outliers=0.5, loss="Tukey")
LARGE = Params(arc=360.0, noise=0.3, method="Gauss-Newton", rest="a trillionth")

VIEW = View(eye=(0.2, -0.01, 3.4), target=(0.2, 0.0, 0.0), grid=None, axes=False)
WIDE = View(eye=(0.0, -0.01, 9.5), target=(0.0, 0.0, 0.0), grid=None, axes=False)
BROAD = View(eye=(0.0, -0.01, 12.5), target=(0.0, 0.0, 0.0), grid=None, axes=False)
CENTER = View(eye=(0.0, -0.001, 0.6), target=(0.0, 0.0, 0.0), grid=None, axes=False)
HALF = View(eye=(0.45, -0.003, 1.8), target=(0.45, 0.0, 0.0), grid=None, axes=False)
ROUND = View(eye=(2.6, -2.8, 2.0), target=(0.0, 0.0, 0.0), grid=None, axes=False)
TABLE = View(eye=(1.7, -2.6, 1.5), target=(0.0, 0.0, 0.1), grid=None, axes=False)

PRESETS: tuple[Preset[Params], ...] = (
    Preset(
        "home",
        "Down to the circle",
        "Each step solves a linear problem around the current circle. Watch the promise beside what"
        " becomes of it.",
        HOME,
        0,
    ),
    Preset(
        "repetition",
        "Measured three hundred times",
        "The ellipse is what the covariance says of the centre. The blue dots are centres of fits"
        " to points measured anew.",
        Params(start_radius=0.8),
        -1,
        CENTER,
    ),
    Preset(
        "twenty",
        "Twenty degrees",
        "On so short an arc the radius is nearly free. The bell of the covariance reaches below 0,"
        " where no circle is.",
        Params(arc=20.0),
        -1,
        WIDE,
        breaks=True,
    ),
    Preset(
        "alike",
        "Neighbours err alike",
        "Errors of the same size, but ten neighbours share theirs. The covariance takes them as"
        " independent.",
        ALIKE,
        10,
        HALF,
        breaks=True,
    ),
    Preset(
        "escape",
        "Downhill all the way",
        "The start lies beyond the points. No step raises the sum of squares: watch it beside the"
        " grey curve, and R.",
        ESCAPE,
        5,
        WIDE,
        breaks=True,
    ),
    Preset(
        "jumps",
        "Every step taken",
        "Gauss-Newton takes each step. The first raises the sum from 148 m² to 1,200 m², and after"
        " four R is 427 km.",
        LEAP,
        2,
        WIDE,
        breaks=True,
    ),
    Preset(
        "damped",
        "The same start, damped",
        "Levenberg-Marquardt from there tries each step out and keeps what lowers the sum. It comes"
        " home.",
        replace(LEAP, method="Levenberg-Marquardt"),
        2,
        WIDE,
    ),
    Preset(
        "basin",
        "Where one may start",
        "A grid of centres to start from, and points on a quarter of the circle. Green ones come"
        " home.",
        Params(stage="basin", start_radius=1.0),
        -1,
        BROAD,
    ),
    Preset(
        "basin-full",
        "All the way round",
        "Points all round the circle: Levenberg-Marquardt may start anywhere in the picture.",
        Params(stage="basin", start_radius=1.0, arc=360.0),
        -1,
        BROAD,
    ),
    Preset(
        "basin-jumps",
        "Without damping",
        "The same points and starts without damping: how many come home now, and where from?",
        Params(stage="basin", start_radius=1.0, arc=360.0, method="Gauss-Newton"),
        -1,
        BROAD,
    ),
    Preset(
        "large-errors",
        "Large errors, small steps",
        "Gauss-Newton is quick where residuals are small. Here they are not, and each step gains as"
        " little as the last.",
        LARGE,
        2,
    ),
    Preset(
        "short-arc",
        "Four fits in closed form",
        "Algebraic fits need no start. On shorter and shorter arcs, see which of them keeps the"
        " radius.",
        Params(stage="algebraic", arc=20.0),
        5,
        breaks=True,
    ),
    Preset(
        "bias",
        "Biased all round",
        "A full circle with errors of a tenth of R: the geometric fit is too large by σ² / 2,"
        " Taubin's by twice that.",
        Params(stage="algebraic", arc=360.0, noise=0.1, points=60),
        -1,
    ),
    Preset(
        "coin",
        "A sixth of a coin",
        "The rim of a real coin, 60° of it. Compare the radii of the fits with the whole rim's.",
        Params(stage="coin", arc=60.0),
        0,
        breaks=True,
    ),
    Preset(
        "line",
        "Which distance?",
        "A steep line with errors in x and in y: upright, level and perpendicular distances make"
        " three lines of it.",
        STEEP,
        0,
    ),
    Preset(
        "edge-on",
        "A plane on edge",
        "Least squares with far points on both sides, evenly: it takes the direction in which they"
        " lie for the plane.",
        EDGE,
        0,
        TABLE,
        breaks=True,
    ),
    Preset(
        "drift",
        "Huber lets them pull",
        "Half the points lie above the plane. Huber bounds how hard each of them pulls, and there"
        " are many.",
        Params(stage="robust", points=300, noise=0.01, outliers=0.5),
        -1,
        TABLE,
        breaks=True,
    ),
    Preset(
        "tukey",
        "Tukey from a bad start",
        "Beyond Tukey's corner a point does not pull at all. From least squares on, the wrong"
        " points are beyond it.",
        TUKEY,
        0,
        TABLE,
        breaks=True,
    ),
    Preset(
        "cascade",
        "Huber, then Tukey",
        "Huber's plane is near enough for Tukey to tell the points apart, and then those off the"
        " plane weigh nothing.",
        Params(stage="robust", points=300, noise=0.01, outliers=0.5, loss="Huber then Tukey"),
        -1,
        TABLE,
    ),
    Preset(
        "sphere",
        "A cap of a sphere",
        "Four unknowns, and the same three lines of mathematics.",
        Params(shape="sphere", points=200, arc=120.0),
        0,
        ROUND,
    ),
    Preset(
        "cylinder",
        "A pipe",
        "Five unknowns: two shifts and two tilts of the axis, and the radius.",
        Params(shape="cylinder", points=300, arc=180.0, start_tilt=30.0),
        0,
        ROUND,
    ),
)


def ended(states: Sequence[State]) -> Any:
    """Return the last moment of the descent."""
    return [state.now.now for state in states if isinstance(state.now, Walked)][-1]


def last(states: Sequence[State]) -> Any:
    """Return what the last step knows."""
    return states[-1].now


def wrong_end(states: Sequence[State]) -> float:
    """Return which choice tells the end of a descent: home, on another circle, or away for ever."""
    end = ended(states)
    if abs(end.unknown[-1]) > AWAY:
        return 2.0
    return 0.0 if states[0].subject.off_best(end.unknown) < 0.01 else 1.0


def iterations_to(states: Sequence[State], metres: float) -> int:
    """Return the first iteration whose circle is so near to the best one."""
    moments = [state.now.now for state in states if isinstance(state.now, Walked)]
    return min(m.iteration for m in moments if states[0].subject.off_best(m.unknown) < metres)


def against_squares(states: Sequence[State]) -> float:
    """Return whether a robust plane ends on the truth, nearer than least squares, or farther."""
    error, squares_error = states[-1].plane_errors
    if states[-1].plane_is_right:
        return 0.0
    return 1.0 if error < 0.95 * squares_error else 2.0


QUESTIONS: tuple[Question[Params, State], ...] = (
    Question(
        "predict-kasa",
        "Points on 45° of a circle, with errors of 2 % of R. Kåsa's fit is one linear system. What"
        " is its R, as a share of the true one, in the median of many draws?",
        answer=lambda states: last(states).medians[-1][0],
        why=lambda states: (
            f"{fixed(last(states).medians[-1][0], 2)}; Taubin's is"
            f" {fixed(last(states).medians[-1][2], 2)}. d² − R² is about 2 R times the distance, so"
            " a small circle makes it cheap to be off."
        ),
        params=Params(stage="algebraic", arc=45.0),
        tolerance=0.08,
        step=-1,
        wrong=(
            (
                0.9,
                1.0,
                (
                    "Errors average out, but the wrong distance does not: each draw makes the same"
                    " error. So near to 1 it comes on arcs of 90° and more."
                ),
            ),
            (
                1.0,
                3.0,
                (
                    "It is the other way round. (d − R)(d + R) is small where R is small, so small"
                    " circles are preferred."
                ),
            ),
        ),
    ),
    Question(
        "predict-end",
        "Levenberg-Marquardt starts beyond the points, at (2.5, 0). It takes back every step that"
        " raises the sum of squares. What becomes of the circle?",
        answer=wrong_end,
        why=lambda states: (
            f"After {ended(states).iteration} iterations R ="
            f" {length(abs(float(ended(states).unknown[-1])))}. The sum of squares fell to"
            f" {square(ended(states).cost)}, that of the best straight line:"
            f" {square(states[0].subject.straight_cost)}. A line is a circle with R without end,"
            " and lower still is only behind a hill."
        ),
        params=ESCAPE,
        choices=(
            Choice(
                "it comes home, only later",
                why=(
                    "That takes falling for arriving. Each step lowers the sum, and yet a way down"
                    " may lead elsewhere."
                ),
            ),
            Choice(
                "it rests on another circle",
                why="A circle to rest on would be a hollow, and there is no second one.",
            ),
            "it grows without end",
        ),
    ),
    Question(
        "predict-iterations",
        "With errors of 2 % of R the third iteration of Gauss-Newton is within 10 µm of the best"
        " fit, R being 1 m. Which iteration is with errors of 30 %?",
        answer=lambda states: float(iterations_to(states, 1e-5)),
        why=lambda states: (
            f"The {iterations_to(states, 1e-5)}th. What Gauss-Newton leaves out is each residual"
            " times its curvature: with large residuals every iteration keeps the same share of"
            " the error, however near it is."
        ),
        params=LARGE,
        tolerance=1.0,
        step=-4,
        wrong=(
            (
                3,
                3,
                (
                    "That would be so if speed did not depend on the errors. It does: the residuals"
                    " are what Gauss-Newton leaves out."
                ),
            ),
            (
                30,
                60,
                (
                    "15 times the error is not 15 times the work: each iteration keeps a share of"
                    " what is left."
                ),
            ),
        ),
    ),
    Question(
        "predict-slope",
        "A line at 60°, 2 m long, with errors of 10 cm in x and in y. How steep is the line that"
        " regression of y on x finds, in the median?",
        answer=lambda states: float(np.median(last(states).angles["upright"])),
        why=lambda states: (
            f"{angle(float(np.median(last(states).angles['upright'])))}: errors in x make it"
            " flatter, however many points there are. Perpendicular distances give"
            f" {angle(float(np.median(last(states).angles['perpendicular'])))}."
        ),
        params=STEEP,
        unit="deg",
        tolerance=1.5,
        wrong=(
            (
                59.5,
                60.5,
                (
                    "Errors in y average out. Errors in x do not: they make x wider, and the same"
                    " rise over more of x is flatter."
                ),
            ),
            (
                60.5,
                70.0,
                (
                    "That is the sense of the other regression, of x on y. Errors in x make y on x"
                    " flatter."
                ),
            ),
        ),
    ),
    Question(
        "predict-alike",
        "Ten neighbours share their error, all as large as before. How many times as wide as the"
        " covariance says do the radii lie, measured anew?",
        answer=lambda states: last(states).wider,
        why=lambda states: (
            f"{fixed(last(states).wider, 1)} times. Ten that err alike count as one: with a tenth"
            " of the points that would be √10 = 3.2, and s comes out too small besides."
        ),
        params=ALIKE,
        tolerance=1.2,
        wrong=(
            (
                0.9,
                1.1,
                (
                    "Each error is as large as before, but they no longer average out within a"
                    " group of ten."
                ),
            ),
            (
                9.0,
                11.0,
                "Ten count as one, that is true of the number of points. The ± goes with its root.",
            ),
        ),
    ),
    Question(
        "predict-tukey",
        "Half the points lie above the plane. Under Tukey's loss a far point does not pull at all."
        " It starts from least squares: where does it end?",
        answer=against_squares,
        why=lambda states: (
            f"{length(states[-1].plane_errors[0])} off, least squares"
            f" {length(states[-1].plane_errors[1])}. The plane of least squares lies among the"
            " wrong points: those of the true plane are the far ones from there."
        ),
        params=TUKEY,
        choices=(
            Choice(
                "on the plane",
                why=(
                    "It would from a start near the plane. From here the true points are the far"
                    " ones."
                ),
            ),
            Choice(
                "nearer to it than least squares",
                why=(
                    "So Huber's loss ends, which bounds the pull. Tukey's ends it, for the true"
                    " points as well."
                ),
            ),
            "no nearer than least squares",
        ),
    ),
)
