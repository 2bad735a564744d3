"""Presets and questions: what to look for, and why it happens."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from lessons.coordinates.captions import CAPS_AREA, in_caps, kilometres, per_second
from lessons.coordinates.state import Params, State
from workbench.lesson import Choice, Preset, Question, View
from workbench.numerals import fixed, percent

HOME = Params()
POLES = Params(stage="sphere")
DATELINE = Params(stage="globe", route="Suva – Apia")
ZENITH = Params(stage="mount")
CELL = 10  # the step of the default run that draws a cell

VIEW = View(eye=(2.1, -2.3, 1.7), target=(0.0, 0.0, 0.1), grid=None)
BALL = View(eye=(0.0, -2.9, 1.3), target=(0.0, 0.0, 0.0), grid=None, axes=False)
ABOVE = View(eye=(5.2, 0.0, 25.0), target=(5.2, 0.0, 0.0), grid=None, axes=False)
MERIDIAN = View(eye=(0.2, -2.7, 0.2), target=(0.2, 0.0, 0.05), grid=None, axes=False)
PASSING = View(eye=(9.0, -21.0, 8.0), target=(0.0, 0.0, 4.8), grid=2.0, axes=False)
PLANE = View(eye=(-1.5, -7.5, 5.5), target=(3.0, 0.4, 0.4), grid=None, axes=False)
SIDE = View(eye=(2.2, -2.3, 1.2), target=(0.0, -0.5, 0.0), grid=None, axes=False)

PRESETS: tuple[Preset[Params], ...] = (
    Preset(
        "home",
        "Three numbers, one point",
        "Each number moves the point on a way of its own: out, down, round. Then somebody walks"
        " past the axis: watch φ.",
        HOME,
        0,
    ),
    Preset(
        "cylindrical",
        "Round an axis",
        "ρ and φ go round the axis, z along it. The cells grow with ρ only; the walk past the axis"
        " is as sudden.",
        Params(system="cylindrical"),
        0,
    ),
    Preset(
        "cartesian",
        "No axis, no pole",
        "x, y and z have cells of one size and no special places: on the same walk no coordinate"
        " jumps.",
        Params(system="cartesian"),
        -2,
    ),
    Preset(
        "conventions",
        "One triple, three points",
        "The same three numbers as ISO, mathematicians and astronomers read them: a point each.",
        Params(convention="mathematics"),
        CELL + 1,
    ),
    Preset(
        "poles",
        "Angles drawn evenly",
        "θ and φ are drawn evenly. Compare a pole with the equator, and the bars with the green"
        " line.",
        POLES,
        6,
        BALL,
        breaks=True,
    ),
    Preset(
        "even",
        "Heights drawn evenly",
        "A band of the sphere has the area of its height, wherever it lies: draw z evenly in place"
        " of θ.",
        Params(stage="sphere", even="area"),
        -1,
        BALL,
    ),
    Preset(
        "banana",
        "A banana of bearings",
        "Ranges are good to 2 cm, bearings to 20°. The points bend round the radar, and their mean"
        " lies inside the bend.",
        Params(stage="radar"),
        -1,
        ABOVE,
    ),
    Preset(
        "great-circle",
        "The map's straight line",
        "One flies straight on the map, the other on the great circle. Compare their ways when both"
        " have arrived.",
        Params(stage="globe"),
        -2,
        BALL,
        breaks=True,
    ),
    Preset(
        "anchorage",
        "Farther north",
        "Meridians draw together towards the pole: the straight line of the map is 33.6 % longer"
        " here.",
        Params(stage="globe", route="Frankfurt – Anchorage"),
        -2,
        BALL,
        breaks=True,
    ),
    Preset(
        "equator",
        "Along the equator",
        "Near the equator degrees are alike: of 12,348 km the map's straight line is 10 m longer"
        " than the great circle.",
        Params(stage="globe", route="Quito – Kampala"),
        -2,
        BALL,
    ),
    Preset(
        "dateline",
        "Across the date line",
        "One place lies at 178° east, the other at 172° west: neighbours. See which way the"
        " numbers go.",
        DATELINE,
        4,
        BALL,
        breaks=True,
    ),
    Preset(
        "latitude",
        "The plumb line's angle",
        "The latitude of maps is the plumb line's, which misses the centre of a flattened globe."
        " See where it differs most.",
        Params(stage="latitude"),
        9,
        MERIDIAN,
    ),
    Preset(
        "saturn",
        "A flatter planet",
        "Saturn is flattened by a tenth: its two latitudes are up to 5.9° apart, 5,980 km along its"
        " clouds.",
        Params(stage="latitude", planet="Saturn"),
        -1,
        MERIDIAN,
    ),
    Preset(
        "zenith",
        "Past the zenith",
        "A target passes 1° from the zenith. Compare how fast the pan axis turns with how fast the"
        " line of sight does.",
        ZENITH,
        0,
        PASSING,
    ),
    Preset(
        "keyhole",
        "Ten times as near",
        "A tenth of a degree from the zenith: the line of sight is as calm as before, the pan axis"
        " turns ten times as fast.",
        Params(stage="mount", miss=0.1),
        -1,
        PASSING,
    ),
    Preset(
        "wide",
        "Far from the zenith",
        "Thirty degrees off, the pan axis turns twice as fast as the line of sight at most: 1 / sin"
        " 30°.",
        Params(stage="mount", miss=30.0),
        -1,
        PASSING,
    ),
    Preset(
        "infinity",
        "Two lines become parallel",
        "Their meeting runs away without end, and its vector l × l′ does nothing but lie down.",
        Params(stage="projective"),
        3,
        PLANE,
    ),
    Preset(
        "horizon",
        "Infinity in the picture",
        "A homography takes the plane as a camera would: the meeting of the parallels is a point"
        " like others.",
        Params(stage="projective"),
        -1,
        PLANE,
    ),
    Preset(
        "weights",
        "One point, many vectors",
        "(x, y, z, w) and w → 0: the point leaves, its name stays small. In the end, two vectors"
        " are averaged.",
        Params(system="homogeneous"),
        1,
    ),
    Preset(
        "near-far",
        "The eye steps back",
        "Where the eye is near, near things are large. See at what pace the orange picture becomes"
        " the green one.",
        Params(stage="project"),
        1,
        SIDE,
    ),
)


def last(states: Sequence[State]) -> Any:
    """Return what the last step knows."""
    return states[-1].now


def extra(states: Sequence[State]) -> float:
    """Return how much longer the straight line on the map is, per cent."""
    return 100 * (last(states).straight_length / last(states).circle_length - 1)


def without_density(states: Sequence[State]) -> float:
    """Return what the sides of all cells of a ball multiply to."""
    cell: Any = states[CELL].now
    return cell.solid[1]


QUESTIONS: tuple[Question[Params, State], ...] = (
    Question(
        "predict-poles",
        "Polar angle and azimuth are drawn evenly. Within 30° of a pole lie"
        f" {percent(CAPS_AREA, 1)} of the sphere's area: how many per cent of the points?",
        answer=lambda states: 100 * in_caps(last(states).p),
        why=lambda states: (
            f"{percent(in_caps(last(states).p), 1)}: 60° of the 180° that θ is drawn from. On the"
            " sphere that is as dense as 1 / sin θ."
        ),
        params=POLES,
        unit="%",
        tolerance=3.0,
        wrong=(
            (
                12.5,
                14.5,
                (
                    "That is their share of the area. Drawn evenly in θ, a band near the pole gets"
                    " as many as a wide one."
                ),
            ),
            (
                45.0,
                55.0,
                "All meridians meet at the poles, but the points are spread along each of them.",
            ),
            (16.0, 17.5, "That is one pole of two."),
        ),
    ),
    Question(
        "predict-way",
        "From Tokyo to London, straight on a map of latitude and longitude: how many per cent"
        " longer than the shortest way?",
        answer=extra,
        why=lambda states: (
            f"{fixed(extra(states), 1)} %: {kilometres(last(states).straight_length)} for"
            f" {kilometres(last(states).circle_length)}. A degree of longitude is short in the"
            " north, and the great circle goes there."
        ),
        params=Params(stage="globe", route="Tokyo – London"),
        unit="%",
        tolerance=5.0,
        wrong=(
            (
                0.0,
                3.0,
                (
                    "Straight is shortest on the paper. A degree of longitude on it has another"
                    " length at every latitude."
                ),
            ),
            (
                45.0,
                300.0,
                (
                    "The map does stretch the north that much, but the straight line on it stays"
                    " near the great circle."
                ),
            ),
        ),
        step=-2,
    ),
    Question(
        "predict-pan",
        "A target flies past 10 m above a camera at 10 m/s, 1° beside the zenith. The line of sight"
        " never turns faster than 57°/s. And the pan axis?",
        answer=lambda states: float(
            np.digitize(np.degrees(last(states).pan_peak), [100, 1000, 10_000])
        ),
        why=lambda states: (
            f"{per_second(last(states).pan_peak)} at its fastest: v / d with d = 17 cm, the"
            " distance from the axis, in place of 10 m from the camera."
        ),
        params=ZENITH,
        step=12,
        choices=(
            Choice(
                "57°/s at most, too",
                why=(
                    "The line of sight turns no faster. The pan axis has to turn nearly half round"
                    " meanwhile."
                ),
            ),
            Choice(
                "some hundred °/s",
                why="That is so 10° beside the zenith. Ten times as near is ten times as fast.",
            ),
            "some thousand °/s",
            Choice(
                "without bound",
                why=(
                    "Only for a target that passes exactly through the zenith. This one keeps a"
                    " distance from the pan axis."
                ),
            ),
        ),
    ),
    Question(
        "predict-ball",
        "The unit ball holds 4π/3 = 4.19 m³. Somebody integrates 1 dr dθ dφ over it, without r² sin"
        " θ. What comes out?",
        answer=without_density,
        why=lambda states: (
            f"{fixed(without_density(states), 2)}: 1 · π · 2π, the box of the coordinates. Cells at"
            " the centre and along the axis count as much as large ones."
        ),
        params=HOME,
        step=CELL,
        tolerance=0.8,
        wrong=(
            (
                4.0,
                4.4,
                "That is the true volume. It needs the factor r² sin θ, which was left out.",
            ),
            (9.0, 10.5, "φ goes round by 2π, not π: only θ ends at π."),
            (6.0, 6.6, "That is the range of φ alone. θ has a range of π."),
        ),
    ),
    Question(
        "predict-mean",
        "Suva lies at 178.5° E, Apia at 171.8° W, 1,150 km apart. Where is the place whose latitude"
        " and longitude are the means of theirs?",
        answer=lambda states: float(np.digitize(last(states).apart, [1e6, 1e7])),
        why=lambda states: (
            f"{kilometres(last(states).apart)} from the middle: (178.5 − 171.8) / 2 is 3.3° E, off"
            " Africa. Average the unit vectors, and go back to angles."
        ),
        params=DATELINE,
        choices=(
            Choice(
                "between them",
                why=(
                    "A mean lies between its numbers. 178.5 and −171.8 are far apart as numbers,"
                    " and near as places."
                ),
            ),
            Choice(
                "a quarter of the way round the Earth",
                why=(
                    "The two numbers are 350° apart, and their mean is 175° from either: that is"
                    " nearly half round."
                ),
            ),
            "about on the other side of the Earth",
        ),
    ),
)
