"""Runs to begin with."""

from dataclasses import replace

from lessons.fitting.state import Params
from workbench.lesson import Preset, View

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
