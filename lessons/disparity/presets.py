"""Runs that work and runs that break."""

from dataclasses import replace

from lessons.disparity.cameras import FLAT
from lessons.disparity.inputs import Input
from workbench.lesson import Preset, Sweep

HOME = Input()
BARE = Input(scene="plain wall", smoothness=0.0, pixel=(62, 60))
STRIPES = Input(scene="repeated pattern", smoothness=0.0, pixel=(80, 60))
POSTS = Input(scene="posts", pixel=(73, 60))
LARGE = Input(smoothness=0.0, noise=8.0, window=21, pixel=(120, 20))
HALF = Input(scene="planes", baseline=0.05, pixel=(80, 50))
DOUBLE = Input(scene="planes", baseline=0.2, pixel=(80, 50))
BOARDS = Input(
    scene="boards at three depths",
    focal_length=640.0,
    baseline=0.125,
    max_disparity=84,
    pixel=(118, 30),
)
ONE_PIXEL = replace(BOARDS, disparity_error=1.0)
MOTORCYCLE = Input(scene="Motorcycle", cost="census", max_disparity=20, pixel=(104, 58))

JUMP = Input(stage="jump", focal_length=640.0, baseline=0.125)
SINGLE = Input(stage="row", window=1)
ROW = Input(stage="row")
BARE_ROW = replace(BARE, stage="row", smoothness=1.0)
STRIPED_ROW = replace(STRIPES, stage="row", smoothness=1.0)
PATH = Input(stage="path", scene="repeated pattern", pixel=(80, 60))
WINDOWS = Input(stage="windows")
NOISY_WINDOWS = Input(stage="windows", noise=8.0, pixel=(120, 20))
PRICES = Input(stage="penalties", scene="repeated pattern", pixel=(80, 60))
BASELINES = Input(stage="baselines", scene="posts")
NET = Input(stage="one pixel", focal_length=640.0, baseline=0.125)

LAST_CHOICE = -6
CHECKED = -5
SMOOTHED = -3
DEPTH = -2
LAST = -1
"""Where the last choice, the check, the last map, the depths and their error are, from the end of
every run of the whole map.
"""

PRESETS: tuple[Preset[Input], ...] = (
    Preset(
        name="jump",
        title="One point on a rail",
        line="Two cameras, seen from above. The nearer the point, the further apart its two marks.",
        params=JUMP,
        step=11,
        view=FLAT,
    ),
    Preset(
        name="single-pixel",
        title="One pixel slides",
        line="A single pixel is compared with one pixel of the right row after the other.",
        params=SINGLE,
        step=0,
        view=FLAT,
    ),
    Preset(
        name="one-window",
        title="A window slides",
        line="Nine pixels are compared at once. The cost is drawn below the place it belongs to.",
        params=ROW,
        step=0,
        view=FLAT,
    ),
    Preset(
        name="bare-row",
        title="A window on a bare wall",
        line="Here all windows look alike, so every shift has about the same cost.",
        params=BARE_ROW,
        step=-1,
        view=FLAT,
    ),
    Preset(
        name="striped-row",
        title="A window on stripes",
        line="Here the window fits again after each stripe.",
        params=STRIPED_ROW,
        step=-1,
        view=FLAT,
    ),
    Preset(
        name="windows",
        title="The whole map, at eight windows",
        line="One map a window, each pixel for itself. Orange-red pixels are over 1 px off.",
        params=WINDOWS,
        step=1,
        view=FLAT,
    ),
    Preset(
        name="noisy-windows",
        title="Eight windows, twice the noise",
        line="The same three balls under twice the noise. Orange-red pixels are over 1 px off.",
        params=NOISY_WINDOWS,
        step=1,
        view=FLAT,
    ),
    Preset(
        name="path",
        title="A path along one row",
        line="The cheapest path runs over the costs of a row; a jump has its price.",
        params=PATH,
        step=19,
        view=FLAT,
    ),
    Preset(
        name="prices",
        title="The price of a jump",
        line="One map a price, after eight paths, on the pattern that repeats.",
        params=PRICES,
        step=0,
        view=FLAT,
    ),
    Preset(
        name="baselines",
        title="The shadow of a post",
        line="The right camera moves away. Orange-red is what only the left one sees.",
        params=BASELINES,
        step=2,
        view=FLAT,
    ),
    Preset(
        name="net",
        title="The net of whole pixels",
        line="Rays between neighbouring pixels cut the world into cells: no pixel tells where in"
        " its cell a thing is.",
        params=NET,
        step=8,
        view=FLAT,
    ),
    Preset(
        name="spheres",
        title="Three balls",
        line="One pixel alone often matches by chance. Windows of 3 × 3 leave 12 % wrong, and the"
        " paths 2 %. The check finds most of what is hidden.",
        params=HOME,
    ),
    Preset(
        name="textureless",
        title="A wall without texture",
        line="On the bare wall the cost curve is flat, for every shift fits as well: noise"
        " decides, and over 90 % of it is wrong at a low cost.",
        params=BARE,
        step=LAST_CHOICE,
    ),
    Preset(
        name="textureless-smooth",
        title="The same, jumps forbidden",
        line="With a high P2 the paths carry the disparity in from where there is texture. The"
        " bare wall is right, though its own costs still know nothing.",
        params=Input(scene="plain wall", smoothness=4.0, pixel=(62, 60)),
        step=LAST_CHOICE,
    ),
    Preset(
        name="repeated",
        title="A pattern that repeats",
        line="Stripes 6 px apart give the curve a valley every 6 px, all equally deep: on four"
        " fifths of the pattern a wrong one wins.",
        params=STRIPES,
        step=LAST_CHOICE,
    ),
    Preset(
        name="repeated-paths",
        title="The same with paths",
        line="Around the pattern the disparity is clear. The paths bring it in, and hardly a"
        " stripe stays wrong: the context decides, not the curve.",
        params=Input(scene="repeated pattern", pixel=(80, 60)),
        step=LAST_CHOICE,
    ),
    Preset(
        name="occlusion",
        title="Hidden from one camera",
        line="Left of each post is a band that only the left camera sees. No answer there is"
        " right. The check gives up about four fifths of it, not all.",
        params=POSTS,
        step=CHECKED,
    ),
    Preset(
        name="window-3",
        title="Window 3: noise",
        line="Nine pixels are too few against this noise: about a third of the map is wrong,"
        " scattered everywhere.",
        params=Input(smoothness=0.0, noise=8.0),
        step=LAST_CHOICE,
    ),
    Preset(
        name="window-21",
        title="Window 21",
        line="A window of 441 pixels instead of nine, against the same noise. Compare the two"
        " maps: which pixels are wrong now?",
        params=LARGE,
        step=LAST_CHOICE,
    ),
    Preset(
        name="baseline-half",
        title="Half the baseline",
        line="Cameras 5 cm apart: half the disparity everywhere, and half as far to search."
        " What does that cost in depth?",
        params=HALF,
        step=LAST,
    ),
    Preset(
        name="baseline-double",
        title="Twice the baseline",
        line="Cameras 20 cm apart: every disparity doubles, and an error of a pixel moves a"
        " depth half as much. Watch what else changes.",
        params=DOUBLE,
        step=LAST,
    ),
    Preset(
        name="one-pixel",
        title="One pixel too many",
        line="Every disparity is made 1 px too large. The last step tells how far each board"
        " moves: by Z² / (f B), and measured.",
        params=ONE_PIXEL,
        step=SMOOTHED,
    ),
    Preset(
        name="sky",
        title="d = 0 is an answer",
        line="The sky does not shift between the pictures: d = 0 means infinitely far. What is"
        " missing is NaN, and drawn grey.",
        params=replace(BOARDS, pixel=(80, 5)),
        step=DEPTH,
    ),
    Preset(
        name="darker",
        title="The right picture is darker",
        line="Another exposure changes every grey value by 30 %. SAD compares grey values, and"
        " 94 % of the map is wrong.",
        params=Input(mistake="right picture darker"),
        step=LAST_CHOICE,
    ),
    Preset(
        name="darker-census",
        title="The same with census",
        line="Census only asks which neighbours are darker than the middle, and a darker"
        " picture does not change that: about 2 % are wrong.",
        params=Input(mistake="right picture darker", cost="census"),
        step=LAST_CHOICE,
    ),
    Preset(
        name="exchanged",
        title="The sign: pictures exchanged",
        line="With left and right exchanged the partner lies at u + |d|, and the search runs"
        " the other way: 94 % of the map is wrong.",
        params=Input(mistake="pictures exchanged"),
        step=LAST_CHOICE,
    ),
    Preset(
        name="rows-off",
        title="Rows that do not correspond",
        line="The right picture is 2 rows too low. Matching only looks along the row, where"
        " the partner is not: two thirds are wrong.",
        params=Input(mistake="rows off by 2 px"),
        step=LAST_CHOICE,
    ),
    Preset(
        name="motorcycle",
        title="A real motorcycle",
        line="Two photographs, a quarter of their size: f and doffs shrink with them, the"
        " baseline does not. 94 % of what both see is right.",
        params=MOTORCYCLE,
        step=DEPTH,
    ),
    Preset(
        name="f-not-rescaled",
        title="f of the large pictures",
        line="The same disparities with the f of the full-size pictures: the cloud looks fine,"
        " and everything is 4 times too far.",
        params=Input(
            scene="Motorcycle",
            cost="census",
            max_disparity=20,
            pixel=(104, 58),
            mistake="f not rescaled",
        ),
        step=DEPTH,
    ),
)

SWEEPS = (Sweep("window", (1, 3, 7, 13, 21)),)
