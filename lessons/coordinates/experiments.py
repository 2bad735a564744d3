"""Presets and questions: what to look for, and why it happens."""

from lessons.coordinates.state import Params, State
from workbench.lesson import Preset, Question, View

VIEW = View(eye=(2.1, -2.3, 1.7), target=(0.0, 0.0, 0.1), grid=None)
BALL = View(eye=(0.0, -3.1, 1.4), target=(0.0, 0.0, 0.0), grid=None, axes=False)
ABOVE = View(eye=(5.0, 0.0, 22.0), target=(5.0, 0.0, 0.0), grid=None, axes=False)
MERIDIAN = View(eye=(0.15, -2.6, 0.25), target=(0.15, 0.0, 0.1), grid=None, axes=False)
PASSING = View(eye=(14.0, -26.0, 10.0), target=(0.0, 0.0, 5.0), grid=2.0, axes=False)
PLANE = View(eye=(-2.5, -6.5, 4.8), target=(2.6, 0.3, 0.6), grid=None, axes=False)
SIDE = View(eye=(2.6, -2.6, 1.3), target=(0.0, -0.4, 0.0), grid=None, axes=False)

PRESETS: tuple[Preset[Params], ...] = (
    Preset(
        "home",
        "Three numbers, one point",
        "Each number moves the point on a way of its own: out, down, and round. Then walk past the axis and watch φ.",
        Params(),
        1,
    ),
    Preset(
        "poles",
        "Angles drawn evenly",
        "θ and φ are drawn evenly. Compare the pole with the equator, and the bars with the green line.",
        Params(stage="sphere"),
        10,
        BALL,
        breaks=True,
    ),
    Preset(
        "radar",
        "A banana of bearings",
        "Ranges are good to 2 cm, bearings to 20°. The points bend round the radar; see where their mean lies.",
        Params(stage="radar"),
        -1,
        ABOVE,
        breaks=True,
    ),
    Preset(
        "great-circle",
        "The map's straight line",
        "a straight line on the map, and the great circle.",
        Params(stage="globe"),
        8,
        BALL,
        breaks=True,
    ),
    Preset(
        "latitude",
        "Latitude is the plumb line's",
        "The plumb line does not go to the centre of a flattened globe. See where they differ most.",
        Params(stage="latitude"),
        9,
        MERIDIAN,
    ),
    Preset(
        "zenith",
        "Past the zenith",
        "A target passes 1° from the zenith. Compare how fast the pan axis turns with the line of sight.",
        Params(stage="mount"),
        0,
        PASSING,
    ),
    Preset(
        "infinity",
        "Two lines become parallel",
        "Their meeting runs away, and its vector just lies down.",
        Params(stage="projective"),
        3,
        PLANE,
    ),
    Preset(
        "near-far",
        "The eye steps back",
        "See how the orange picture nears the green one.",
        Params(stage="project"),
        0,
        SIDE,
    ),
)
QUESTIONS: tuple[Question[Params, State], ...] = ()
