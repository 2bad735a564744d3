"""Runs worth seeing, and cameras."""

import numpy as np

from lessons.curvature import paper
from lessons.curvature.inputs import Input
from workbench.lesson import Preset, Sweep, View

UNFOLDING = (0.15, 0.35, 0.55, 0.75, 0.9)  # how far a ring is laid flat in the steps before it is
DEFECT = 2 + len(UNFOLDING)
GAUSSIAN, MEAN, PRINCIPAL, TOTAL = DEFECT + 1, DEFECT + 3, DEFECT + 4, DEFECT + 6
VIEW = View(eye=(2.05, -2.4, 1.9), target=(0.0, 0.0, -0.05), grid=None, axes=False)
TWICE = View(eye=(4.1, -4.8, 3.8), target=(0.0, 0.0, -0.1), grid=None, axes=False)
CLOSE = View(eye=(1.75, -2.35, 2.0), target=(0.52, -0.6, 0.8), grid=None, axes=False)
SIDE = View(eye=(2.95, 1.65, 1.4), target=(0.0, -0.1, -0.05), grid=None, axes=False)

CYLINDER = Input(surface="cylinder", vertices=800)
DOUBLE = Input(size=2.0)
INSIDE_OUT = Input(inside_out=True)
IRREGULAR = Input(vertices=5000, jitter=0.2)
PAPER = Input(stage="paper")
SPHERE_SUM = Input(surface="sphere", vertices=1000, jitter=0.25, noise=0.01)

SHEET = View(eye=(1.15, -4.3, 1.0), target=(1.15, 0.0, -0.05), grid=None, axes=False)
NEAR = View(eye=(1.5, -2.0, 1.0), target=(0.83, -0.88, 0.36), grid=None, axes=False)
BALLS = View(eye=(6.2, -7.26, 1.7), target=(0.0, 0.0, -0.15), grid=None, axes=False)
ROW = View(eye=(2.45, -2.85, 1.4), target=(0.0, 0.0, 0.05), grid=None, axes=False)
VIEWS = {
    "paper": SHEET,
    "close": CLOSE,
    "side": SIDE,
    "row": ROW,
    "near": NEAR,
    "twice": TWICE,
    "balls": BALLS,
}
CONE = int(np.argmin(np.abs(paper.HAND - 60.0)))

PRESETS: tuple[Preset[Input], ...] = (
    Preset(
        name="paper",
        title="A ring of paper",
        line=("Six triangles around a point, from an overlap to a gap: a saddle, flat, a cone."),
        params=PAPER,
        step=CONE,
        view=SHEET,
    ),
    Preset(
        name="unfold",
        title="The gap, from close by",
        line=(
            "One ring of a coarse ball is cut along an edge and laid flat. Every triangle keeps "
            "its shape: what the angles lack stays open."
        ),
        params=Input(surface="sphere", vertices=60),
        step=1,
        view=CLOSE,
    ),
    Preset(
        name="balls",
        title="Smaller gaps, the same K",
        line=(
            "Four balls of radius 1 m, ever finer. The gap at a vertex shrinks with its cell, and "
            "their quotient settles on 1 m⁻²."
        ),
        params=Input(stage="balls"),
        step=3,
        view=BALLS,
    ),
    Preset(
        name="cylinder",
        title="A rolled sheet",
        line=(
            "A tube of radius r = 0.5 m, as rolled from paper; H is 1/2r = 1 m⁻¹. Go one stage "
            "back and ask the angles."
        ),
        params=CYLINDER,
        step=MEAN,
    ),
    Preset(
        name="catenoid",
        title="Catenoid: H = 0, K < 0",
        line=(
            "It bends as much to one side as to the other: the two cancel in H = (k₁ + k₂)/2 and "
            "not in K = k₁ k₂, negative everywhere."
        ),
        params=Input(surface="catenoid", vertices=800),
        step=PRINCIPAL,
        view=SIDE,
    ),
    Preset(
        name="double",
        title="Twice as large",
        line=(
            "Every length is doubled. Which numbers follow, and which have no unit and stay? "
            "Compare with the default run."
        ),
        params=DOUBLE,
        step=GAUSSIAN,
        view=TWICE,
    ),
    Preset(
        name="inside-out",
        title="Inside out",
        line=(
            "All triangles are turned round, and the normals with them. Compare the colours of K "
            "and of H with the default run."
        ),
        params=INSIDE_OUT,
        step=MEAN,
    ),
    Preset(
        name="no-area",
        title="A defect is no curvature",
        line="Taken for K, the defect is about a hundred times too small here, and about four times"
        " smaller still on a mesh four times as fine.",
        params=Input(vertices=1600, mistake="defect taken for K"),
        step=GAUSSIAN,
        breaks=True,
    ),
    Preset(
        name="no-half",
        title="The forgotten half",
        line=(
            "The cotangent sum over area gives 2 H n. Without the half the unit sphere has H = 2 "
            "m⁻¹, and H² − K = 3 tears k₁ and k₂ apart."
        ),
        params=Input(surface="sphere", mistake="H without the half"),
        step=MEAN,
        breaks=True,
    ),
    Preset(
        name="border",
        title="A vertex on the border",
        line=(
            "Its angles are taken from π: what is missing says how the border turns, so K and H "
            "are left open (grey) there."
        ),
        params=Input(surface="saddle", vertex=260),
        step=DEFECT,
    ),
    Preset(
        name="border-2pi",
        title="2π on the border",
        line=(
            "A flat square should add up to 2π. Taken from 2π, each border vertex adds π that is "
            "not there, and the sum is far off."
        ),
        params=Input(surface="plane", vertex=260, mistake="2 pi on the border"),
        step=TOTAL,
        breaks=True,
    ),
    Preset(
        name="coarse",
        title="Coarse",
        line=(
            "With 60 vertices the relative error of K is about 10 % (RMS): few triangles have to "
            "tell how the tube bends."
        ),
        params=Input(vertices=60),
        step=GAUSSIAN,
    ),
    Preset(
        name="fine",
        title="Fine",
        line=(
            "With 6,000 well-spread vertices the relative error of K is 0.13 % (RMS): on a "
            "regular mesh it falls with the square of the edges."
        ),
        params=Input(vertices=6000),
        step=GAUSSIAN,
    ),
    Preset(
        name="noise",
        title="Noise, amplified",
        line=(
            "3 mm (sigma) off a tube of 40 cm, hardly visible, and K is off by more than its own "
            "size (RMS). A finer mesh makes it worse: last step."
        ),
        params=Input(vertices=1600, noise=0.003),
        step=GAUSSIAN,
        breaks=True,
    ),
    Preset(
        name="irregular",
        title="Irregular triangles",
        line=(
            "Vertices stray along the surface, never off it: no two triangles are alike. Will a "
            "finer mesh help the angles? The fit? See the last step."
        ),
        params=IRREGULAR,
        step=GAUSSIAN,
        breaks=True,
    ),
    Preset(
        name="sphere-sum",
        title="A bumpy sphere",
        line="Noise and jitter put K off by over five times its own size (RMS). What do the defects"
        " still add up to?",
        params=SPHERE_SUM,
        step=GAUSSIAN,
        breaks=True,
    ),
    Preset(
        name="torus-sum",
        title="A bumpy torus",
        line=(
            "The same noise and jitter on a surface with a handle: gaps and overlaps cancel to "
            "the last digit."
        ),
        params=Input(vertices=1000, jitter=0.25, noise=0.01),
        step=TOTAL,
        breaks=True,
    ),
)

SWEEPS = (
    Sweep("vertices", (60, 120, 250, 500, 1000, 2000)),
    Sweep("noise", (0.0, 0.003, 0.006, 0.01, 0.02), run="sphere-sum"),
    Sweep("noise", (0.0, 0.001, 0.002, 0.003), run="noise"),
)
