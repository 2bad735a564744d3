"""Runs that work, runs that break, and cameras."""

from dataclasses import replace

from lessons.ransac.inputs import Input
from workbench.lesson import Preset, Sweep, View

FLAT_SCENE = Input(stage="draws", points=60, noise=0.025, inlier_distance=0.05, most_samples=100)
PICK = replace(FLAT_SCENE, sample=(-1, -1, 3, 30), most_samples=40, seed=6)
TALLY = replace(FLAT_SCENE, who_is_right=True)
WIDER = replace(FLAT_SCENE, stage="band", who_is_right=True)
FAN = replace(FLAT_SCENE, stage="fan", who_is_right=True)
THIRTY = Input(outliers=0.3, seed=2)
SEVENTY = Input(outliers=0.7, seed=2)
TIGHT = Input(inlier_distance=0.004, steps="improvements")
LOOSE = Input(inlier_distance=0.3)
MSAC = Input(inlier_distance=0.15, score="MSAC")
WALL = Input(table="beside a wall")
NEXT = replace(WALL, taken=1, steps="improvements")
WALL_RACE = replace(WALL, steps="improvements")
WIRE = Input(table="with a wire", sample=(-1, 0, 1, 2))
NEAR = Input(sample=(-1, 482, 510, 3))
LOCAL = Input(outliers=0.6, local_refit=True, seed=7)
PROSAC = Input(model="homography", outliers=0.6, points=400, sampler="PROSAC")
MATCHES = Input(
    model="fundamental matrix", outliers=0.3, points=200, inlier_pixels=2.0, steps="improvements"
)

VIEW = View(eye=(0.8, -3.4, 1.6), target=(0.0, 0.0, 0.33), grid=None, axes=False)
EDGE = View(eye=(0.2, -3.6, 0.55), target=(0.0, 0.0, 0.4), grid=None, axes=False)
FLAT = View(eye=(0.0, -3.3, 0.76), target=(0.0, 0.0, 0.76), grid=None, axes=False)
STRIP = View(eye=(0.35, -3.3, 0.75), target=(0.35, 0.0, 0.75), grid=None, axes=False)
CORNER = View(eye=(-3.9, -0.9, 0.8), target=(0.0, 0.0, 0.5), grid=None, axes=False)
WIDE = View(eye=(0.9, -4.0, 1.8), target=(0.0, 0.0, 0.45), grid=None, axes=False)
IMAGES = View(eye=(0.0, -2.6, 0.25), target=(0.0, 0.0, 0.25), grid=None, axes=False)
VIEWS = {
    "space": WIDE,
    "corner": CORNER,
    "edge": EDGE,
    "flat": FLAT,
    "strip": STRIP,
    "images": IMAGES,
}

PRESETS: tuple[Preset[Input], ...] = (
    Preset(
        name="pick-two",
        title="Two points make a line",
        line="Two points are drawn, and all who lie within 5 cm of their line vote for it.",
        params=PICK,
        step=0,
        view=FLAT,
    ),
    Preset(
        name="wider",
        title="An ever wider band",
        line="Points of the true line have a ring. Widen the band: who votes?",
        params=WIDER,
        step=1,
        view=FLAT,
    ),
    Preset(
        name="tally",
        title="A hundred draws",
        line="A sample is clean if both of its points have a ring. Each draw adds a dot.",
        params=TALLY,
        step=0,
        view=STRIP,
    ),
    Preset(
        name="fan",
        title="Two points and their noise",
        line="The noise of two points is drawn thirty times. Move the two apart.",
        params=FAN,
        step=1,
        view=FLAT,
    ),
    Preset(
        name="line",
        title="A line, seen flat",
        line="Two points determine a line. Who lies in the band around it votes for it: the band"
        " reaches the inlier distance to either side.",
        params=Input(model="line", points=150, noise=0.025, inlier_distance=0.05, seed=6),
        step=1,
        view=FLAT,
    ),
    Preset(
        name="thirty",
        title="30 % outliers: 13 samples",
        line="A third of all samples is clean, so 13 are enough here; the same outliers drag least"
        " squares 15 cm off (RMS).",
        params=THIRTY,
        step=2,
    ),
    Preset(
        name="seventy",
        title="70 % outliers: 126 samples",
        line="Only one sample in 37 is clean, so 126 are drawn; the plane is still only 3 mm off"
        " (RMS). Half is no limit.",
        params=SEVENTY,
        step=2,
    ),
    Preset(
        name="tight",
        title="Inlier distance too small",
        line="4 mm is a quarter of the noise: three in four true points are refused, 500 samples do"
        " not suffice, and the answer rests on the few that are left.",
        params=TIGHT,
        step=-1,
        breaks=True,
    ),
    Preset(
        name="loose",
        title="Inlier distance too large",
        line="0.3 m is 20 sigma: clutter votes too, 13 samples satisfy the formula, and the plane"
        " ends 4 cm off (RMS).",
        params=LOOSE,
        step=-1,
        breaks=True,
    ),
    Preset(
        name="msac",
        title="Too large, but nearness counts",
        line="A count cannot tell 1 mm from 149 mm. MSAC can: the sample that it keeps is 5 mm from"
        " the truth; the one that a count keeps is 49 mm off.",
        params=MSAC,
        step=0,
    ),
    Preset(
        name="two-planes",
        title="Two planes",
        line="A table beside a wall with twice as many points: the table is what we want. Watch on"
        " which of the two each new best lies.",
        params=WALL,
        step=2,
        breaks=True,
    ),
    Preset(
        name="race",
        title="Two planes, improvements only",
        line="The same run, one step for each new best. Change how many points the wall has.",
        params=WALL_RACE,
        step=-1,
        breaks=True,
    ),
    Preset(
        name="next",
        title="Two planes, the winner taken away",
        line="All who voted for the winner are taken away, and RANSAC runs on the points left"
        " over.",
        params=NEXT,
        step=-1,
    ),
    Preset(
        name="collinear",
        title="Three points on one line",
        line="You picked three points of a taut wire: a whole pencil of planes goes through them."
        " The sample is lost, and still counts as drawn.",
        params=WIRE,
        step=1,
        breaks=True,
    ),
    Preset(
        name="near-sample",
        title="Three inliers, close together",
        line="You picked three points that truly belong to the plane, close together. This is the"
        " plane through them: the next step counts who is near it.",
        params=NEAR,
        step=1,
    ),
    Preset(
        name="rivals",
        title="Least squares and Huber beside it",
        line="Squares listen most to the farthest points. Huber's loss bounds each pull but does"
        " not end it. Compare both planes with RANSAC's and the truth.",
        params=THIRTY,
        step=-2,
    ),
    Preset(
        name="local",
        title="Refit every new best",
        line="A sample carries the noise of three points; refitting each new best at once gathers"
        " its votes sooner: the run ends after 53 samples in place of 80.",
        params=LOCAL,
        step=0,
    ),
    Preset(
        name="prosac",
        title="The most trusted first",
        line="Matches have a quality, and PROSAC tries the most trusted first and counts votes"
        " among them to know when to stop: after 14 samples, where chance draws 375.",
        params=PROSAC,
        step=0,
        view=IMAGES,
    ),
    Preset(
        name="epipolar",
        title="Two views: a fundamental matrix",
        line="A match has only to lie near a line, not at a point, but seven at once must be free"
        " of outliers. Look what that takes even at 30 %.",
        params=MATCHES,
        step=-1,
        view=IMAGES,
    ),
)

SWEEPS = (
    Sweep("outliers", (0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7), run="thirty"),
    Sweep("wall", (0.7, 0.8, 1.0, 1.2, 1.5, 2.0), run="race"),
)
