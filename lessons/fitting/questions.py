"""What to predict before looking."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from lessons.fitting.captions import square
from lessons.fitting.fit_studies import AWAY
from lessons.fitting.presets import ALIKE, ESCAPE, LARGE, STEEP, TUKEY
from lessons.fitting.state import Params, State
from workbench.algorithms.least_squares import Walked
from workbench.lesson import Choice, Question
from workbench.numerals import angle, fixed, length


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
