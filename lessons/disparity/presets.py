"""Experiments that show where matching fails and why, and what to predict before looking."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import scipy

from lessons.disparity.pairs import setup_of
from lessons.disparity.state import Params, State
from lessons.disparity.truth import flat_parts
from workbench.certain import sure
from workbench.lesson import Choice, Preset, Question
from workbench.numerals import length, percent

HOME = Params()
BARE = Params(scene="plain wall", smoothness=0.0, pixel=(62, 60))
STRIPES = Params(scene="repeated pattern", smoothness=0.0, pixel=(80, 60))
POSTS = Params(scene="posts", pixel=(73, 60))
LARGE = Params(smoothness=0.0, noise=8.0, window=21, pixel=(120, 20))
HALF = Params(scene="planes", baseline=0.05, pixel=(80, 50))
PLANES = Params(scene="planes", pixel=(80, 50))
DOUBLE = Params(scene="planes", baseline=0.2, pixel=(80, 50))
BOARDS = Params(
    scene="boards at three depths",
    focal_length=640.0,
    baseline=0.125,
    max_disparity=84,
    pixel=(118, 30),
)
ONE_PIXEL = replace(BOARDS, disparity_error=1.0)
MOTORCYCLE = Params(scene="Motorcycle", cost="census", max_disparity=20, pixel=(104, 58))

LAST_CHOICE, CHECKED, SMOOTHED, DEPTH, LAST = -6, -5, -3, -2, -1
"""Where the last choice, the check, the last map, the depths and their error are, from the end of
every run.
"""

PRESETS: tuple[Preset[Params], ...] = (
    Preset(
        "spheres",
        "Three balls",
        "One pixel alone matches by chance: 74 % are wrong. Windows of 3 × 3 leave 12 %, the paths"
        " 2 %. The check finds four fifths of what is hidden.",
        HOME,
    ),
    Preset(
        "textureless",
        "A wall without texture",
        "On the bare wall the cost curve is flat, for every shift fits as well: noise decides, and"
        " over 90 % of it is wrong at a low cost.",
        BARE,
        LAST_CHOICE,
    ),
    Preset(
        "textureless-smooth",
        "The same, jumps forbidden",
        "With a high P2 the paths carry the disparity in from where there is texture. The bare wall"
        " is right, though its own costs still know nothing.",
        Params(scene="plain wall", smoothness=4.0, pixel=(62, 60)),
        LAST_CHOICE,
    ),
    Preset(
        "repeated",
        "A pattern that repeats",
        "Stripes 6 px apart give the curve a valley every 6 px, all equally deep: on four fifths of"
        " the pattern a wrong one wins.",
        STRIPES,
        LAST_CHOICE,
    ),
    Preset(
        "repeated-paths",
        "The same with paths",
        "Around the pattern the disparity is clear. The paths bring it in, and hardly a stripe"
        " stays wrong: the context decides, not the curve.",
        Params(scene="repeated pattern", pixel=(80, 60)),
        LAST_CHOICE,
    ),
    Preset(
        "occlusion",
        "Hidden from one camera",
        "Left of each post is a band that only the left camera sees. No answer there is right. The"
        " check gives up about four fifths of it, not all.",
        POSTS,
        CHECKED,
    ),
    Preset(
        "window-3",
        "Window 3: noise",
        "Nine pixels are too few against this noise: about a third of the map is wrong, scattered"
        " everywhere.",
        Params(smoothness=0.0, noise=8.0),
        LAST_CHOICE,
    ),
    Preset(
        "window-21",
        "Window 21",
        "A window of 441 pixels instead of nine, against the same noise. Compare the two maps:"
        " which pixels are wrong now?",
        LARGE,
        LAST_CHOICE,
    ),
    Preset(
        "baseline-half",
        "Half the baseline",
        "Cameras 5 cm apart: half the disparity everywhere, and half as far to search. What does"
        " that cost in depth?",
        HALF,
        LAST,
    ),
    Preset(
        "baseline-double",
        "Twice the baseline",
        "Cameras 20 cm apart: every disparity doubles, and an error of a pixel moves a depth half"
        " as much. Watch what else changes.",
        DOUBLE,
        LAST,
    ),
    Preset(
        "one-pixel",
        "One pixel too many",
        "Every disparity is made 1 px too large. The last step tells how far each board moves: by"
        " Z² / (f B), and measured.",
        ONE_PIXEL,
        SMOOTHED,
    ),
    Preset(
        "sky",
        "d = 0 is an answer",
        "The sky does not shift between the pictures: d = 0 means infinitely far. What is missing"
        " is NaN, and drawn grey.",
        replace(BOARDS, pixel=(80, 5)),
        DEPTH,
    ),
    Preset(
        "darker",
        "The right picture is darker",
        "Another exposure changes every grey value by 30 %. SAD compares grey values, and 94 % of"
        " the map is wrong.",
        Params(mistake="right picture darker"),
        LAST_CHOICE,
    ),
    Preset(
        "darker-census",
        "The same with census",
        "Census only asks which neighbours are darker than the middle, and a darker picture does"
        " not change that: about 2 % are wrong.",
        Params(mistake="right picture darker", cost="census"),
        LAST_CHOICE,
    ),
    Preset(
        "exchanged",
        "The sign: pictures exchanged",
        "With left and right exchanged the partner lies at u + |d|, and the search runs the other"
        " way: 94 % of the map is wrong.",
        Params(mistake="pictures exchanged"),
        LAST_CHOICE,
    ),
    Preset(
        "rows-off",
        "Rows that do not correspond",
        "The right picture is 2 rows too low. Matching only looks along the row, where the partner"
        " is not: two thirds are wrong.",
        Params(mistake="rows off by 2 px"),
        LAST_CHOICE,
    ),
    Preset(
        "motorcycle",
        "A real motorcycle",
        "Two photographs, a quarter of their size: f and doffs shrink with them, the baseline does"
        " not. 94 % of what both see is right.",
        MOTORCYCLE,
        DEPTH,
    ),
    Preset(
        "f-not-rescaled",
        "f of the large pictures",
        "The same disparities with the f of the full-size pictures: the cloud looks fine, and"
        " everything is 4 times too far.",
        Params(
            scene="Motorcycle",
            cost="census",
            max_disparity=20,
            pixel=(104, 58),
            mistake="f not rescaled",
        ),
        DEPTH,
    ),
)


def last_choice(states: Sequence[State]) -> State:
    """Return the state of the last map before the check."""
    return states[LAST_CHOICE]


def near_edges(state: State) -> tuple[float, float]:
    """Return the share of the wrong pixels, and of all pixels, within 10 px of a jump of the true
    disparity.
    """
    truth, visible = sure(state.setup.pair.disparity), sure(state.setup.pair.visible)
    jump = scipy.ndimage.maximum_filter(truth, 3) - scipy.ndimage.minimum_filter(truth, 3) > 2.0
    near = scipy.ndimage.maximum_filter(jump, (21, 21))
    wrong = (np.abs(state.disparity - truth) > 1.0) & visible
    return float(near[wrong].mean()) if wrong.any() else 0.0, float(near[visible].mean())


def hidden(params: Params) -> float:
    """Return the share of left pixels that the right camera does not see."""
    visible = sure(setup_of(params).pair.visible)
    return 1.0 - float(visible.mean())


def boards(state: State) -> dict[float, float]:
    """Return the median depth that was found for every board, by its true depth, metres."""
    return {round(true): true + float(np.median(off)) for true, off in flat_parts(state).items()}


def _quarter_why(states: Sequence[State]) -> str:
    found = boards(states[DEPTH])
    return (
        "Z = f B / d: a quarter of the disparity is four times the depth. The boards were found at"
        f" {length(found[5])} and {length(found[20])}."
    )


def _nearer(states: Sequence[State]) -> float:
    return 20.0 - boards(states[DEPTH])[20]


def _nearer_why(states: Sequence[State]) -> str:
    near, far = 1.0 - boards(states[DEPTH])[1], _nearer(states)
    return (
        "Its 4 px became 5, and Z = f B / d with f B = 80 made of 20 m 80 / 5 = 16 m: it came"
        f" {length(far)} nearer, {far / near:.0f} times as much as the board at 1 m"
        f" ({length(near)}). The formula Z² / (f B), which says 5 m, is the tangent: 1 px too small"
        " would have put it 6.67 m further. Either way the error grows with Z², not with Z."
    )


def mean_depths(states: Sequence[State]) -> tuple[float, float]:
    """Return the mean of the boards' depths, and the depth of their mean disparity, metres."""
    found, camera = boards(states[DEPTH]), states[DEPTH].setup.pair.camera
    fB = camera.f * camera.baseline
    return float(np.mean(list(found.values()))), fB / float(
        np.mean([fB / z for z in found.values()])
    )


def _averages(states: Sequence[State]) -> float:
    of_depths, of_disparities = mean_depths(states)
    return (
        2.0 if abs(of_depths - of_disparities) < 0.1 else 0.0 if of_depths > of_disparities else 1.0
    )


def _averages_why(states: Sequence[State]) -> str:
    of_depths, of_disparities = mean_depths(states)
    return (
        f"The mean of the depths is {length(of_depths)}, the mean disparity stands for"
        f" {length(of_disparities)}: 1 / d is not linear, and the near board has by far the"
        " largest d."
    )


def _edges(states: Sequence[State]) -> float:
    of_wrong, of_all = near_edges(last_choice(states))
    return 1.0 if of_wrong > 0.8 and of_wrong > 1.5 * of_all else 0.0


def _edges_why(states: Sequence[State]) -> str:
    state = last_choice(states)
    of_wrong, of_all = near_edges(state)
    return (
        f"{percent(state.wrong, 0)} of the map is wrong, and {percent(of_wrong, 0)} of that lies"
        f" within 10 px, half a window, of an edge, where only {percent(of_all, 0)} of all pixels"
        " are."
    )


QUESTIONS: tuple[Question[Params, State], ...] = (
    Question(
        "quarter",
        "A board 5 m away has a disparity of 16 px. Another has 4 px, a quarter of that. How far"
        " away is it?",
        lambda states: boards(states[DEPTH])[20],
        _quarter_why,
        BOARDS,
        unit="m",
        tolerance=1.0,
        step=DEPTH,
        wrong=(
            (
                1.2,
                1.3,
                (
                    "That is a quarter of the distance: nearer, with a smaller disparity. But far"
                    " things move less."
                ),
            ),
            (
                9.5,
                10.5,
                (
                    "That is twice as far. Z = f B / d has no root in it: a quarter of d is four"
                    " times Z."
                ),
            ),
            (
                75.0,
                85.0,
                (
                    "That is 16 times as far, the square of four. The square belongs to the error"
                    " of Z, not to Z."
                ),
            ),
        ),
    ),
    Question(
        "nearer",
        "Every disparity is measured 1 px too large: a board with 80 px, 1 m away, comes 12 mm"
        " nearer. How much nearer does the board with 4 px come?",
        _nearer,
        _nearer_why,
        ONE_PIXEL,
        unit="m",
        tolerance=0.4,
        step=LAST,
        wrong=(
            (
                4.6,
                5.2,
                (
                    "That is Z² / (f B), or 12 mm times 20²: the slope of 1 / d at 4 px. One pixel"
                    " of four is too long a step to follow a slope."
                ),
            ),
            (
                6.3,
                7.0,
                "That is a pixel too few: 80 / 3 = 26.7 m. A pixel too many leads the other way.",
            ),
            (
                0.2,
                0.3,
                (
                    "That is 20 times 12 mm, as if the error grew with the distance. It grows with"
                    " its square."
                ),
            ),
            (
                0.01,
                0.015,
                (
                    "That is what the near board moves. The same pixel is an eightieth of its"
                    " disparity, and a quarter of this one's."
                ),
            ),
            (15.0, 16.5, "That is where the board is seen now. Asked is how far it came."),
        ),
    ),
    Question(
        "averages",
        "Three boards have disparities of 80, 16 and 4 px. Average their depths, or average their"
        " disparities and take the depth of that: which is further?",
        _averages,
        _averages_why,
        BOARDS,
        choices=(
            "the mean of the depths",
            Choice(
                "the depth of the mean disparity",
                why=(
                    "The near board has 80 px of the 100: it nearly alone decides the"
                    " mean disparity, which therefore stands for something near."
                ),
            ),
            Choice(
                "both are the same",
                why="They would be if depth were proportional to disparity. It is one over it.",
            ),
        ),
        step=DEPTH,
    ),
    Question(
        "baseline",
        "The cameras move apart to twice the baseline. How many pixels does the right camera not"
        " see now?",
        lambda states: float(
            np.digitize(hidden(states[0].setup.params) / hidden(PLANES), [0.75, 1.5])
        ),
        lambda states: (
            f"{percent(hidden(PLANES), 1)} became {percent(hidden(states[0].setup.params), 1)}. The"
            " depths of the rest are about twice as exact: a longer baseline is a trade, not a"
            " gain."
        ),
        DOUBLE,
        choices=(
            Choice(
                "about half as many",
                why=(
                    "The errors of the depths halve. What is hidden does not: the two cameras see"
                    " past an edge from places further apart."
                ),
            ),
            Choice(
                "about as many",
                why=(
                    "The hidden band is as wide as the disparities of its two sides differ, and all"
                    " disparities change with the baseline."
                ),
            ),
            "about twice as many",
        ),
        step=CHECKED,
    ),
    Question(
        "window",
        "A window of 21 px instead of 3 against noise, without paths. Where are the pixels that"
        " stay wrong?",
        _edges,
        _edges_why,
        LARGE,
        choices=(
            Choice(
                "scattered everywhere",
                why="That is the fault of a small window. Over 441 pixels noise averages out.",
            ),
            "beside the edges of things",
        ),
        step=LAST_CHOICE,
    ),
)
