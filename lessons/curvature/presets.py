"""Experiments that show what curvature is and what breaks its estimates, and what to predict before
looking.
"""

from collections.abc import Sequence

import numpy as np

from lessons.curvature.state import Params, State, at_stage
from workbench.certain import sure
from workbench.geometry.meshes.curvature import gaussian_curvature
from workbench.lesson import Choice, Preset, Question, View
from workbench.numerals import percent

UNFOLDING = (0.15, 0.35, 0.55, 0.75, 0.9)  # how far a ring is laid flat in the steps before it is
DEFECT = 2 + len(UNFOLDING)
GAUSSIAN, MEAN, PRINCIPAL, TOTAL = DEFECT + 1, DEFECT + 3, DEFECT + 4, DEFECT + 6
VIEW = View(eye=(2.05, -2.4, 1.9), target=(0.0, 0.0, -0.05), grid=None, axes=False)
TWICE = View(eye=(4.1, -4.8, 3.8), target=(0.0, 0.0, -0.1), grid=None, axes=False)
CLOSE = View(eye=(1.75, -2.35, 2.0), target=(0.52, -0.6, 0.8), grid=None, axes=False)
SIDE = View(eye=(2.95, 1.65, 1.4), target=(0.0, -0.1, -0.05), grid=None, axes=False)

CYLINDER = Params(surface="cylinder", vertices=800)
DOUBLE = Params(size=2.0)
INSIDE_OUT = Params(inside_out=True)
IRREGULAR = Params(vertices=6000, jitter=0.2)
SPHERE_SUM = Params(surface="sphere", vertices=1000, jitter=0.25, noise=0.01)

PRESETS: tuple[Preset[Params], ...] = (
    Preset(
        "unfold",
        "The gap, from close by",
        "One ring of a coarse ball is cut along an edge and laid flat. Every triangle keeps its"
        " shape: what the angles lack stays open.",
        Params(surface="sphere", vertices=60),
        1,
        CLOSE,
    ),
    Preset(
        "cylinder",
        "A rolled sheet",
        "A tube of radius r = 0.5 m, as rolled from paper; H is 1/2r = 1 m⁻¹. Go one stage back and"
        " ask the angles.",
        CYLINDER,
        MEAN,
    ),
    Preset(
        "catenoid",
        "Catenoid: H = 0, K < 0",
        "It bends as much to one side as to the other: the two cancel in H = (k₁ + k₂)/2 and not in"
        " K = k₁ k₂, negative everywhere.",
        Params(surface="catenoid", vertices=800),
        PRINCIPAL,
        SIDE,
    ),
    Preset(
        "double",
        "Twice as large",
        "Every length is doubled. Which numbers follow, and which have no unit and stay? Compare"
        " with the default run.",
        DOUBLE,
        GAUSSIAN,
        TWICE,
    ),
    Preset(
        "inside-out",
        "Inside out",
        "All triangles are turned round, and the normals with them. Compare the colours of K and of"
        " H with the default run.",
        INSIDE_OUT,
        MEAN,
    ),
    Preset(
        "no-area",
        "A defect is no curvature",
        "Taken for K, the defect is about a hundred times too small here, and about four times"
        " smaller still on a mesh four times as fine.",
        Params(vertices=1600, mistake="defect taken for K"),
        GAUSSIAN,
        breaks=True,
    ),
    Preset(
        "no-half",
        "The forgotten half",
        "The cotangent sum over area gives 2 H n. Without the half the unit sphere has H = 2 m⁻¹,"
        " and H² − K = 3 tears k₁ and k₂ apart.",
        Params(surface="sphere", mistake="H without the half"),
        MEAN,
        breaks=True,
    ),
    Preset(
        "border",
        "A vertex on the border",
        "Its angles are taken from π: what is missing says how the border turns, so K and H are"
        " left open (grey) there.",
        Params(surface="saddle", vertex=260),
        DEFECT,
    ),
    Preset(
        "border-2pi",
        "2π on the border",
        "A flat square should add up to 2π. Taken from 2π, each border vertex adds π that is not"
        " there, and the sum is far off.",
        Params(surface="plane", vertex=260, mistake="2 pi on the border"),
        TOTAL,
        breaks=True,
    ),
    Preset(
        "coarse",
        "Coarse",
        "With 60 vertices the relative error of K is about 10 % (RMS): few triangles have to tell"
        " how the tube bends.",
        Params(vertices=60),
        GAUSSIAN,
    ),
    Preset(
        "fine",
        "Fine",
        "With 6,000 well-spread vertices the relative error of K is 0.13 % (RMS): on a regular mesh"
        " it falls with the square of the edges.",
        Params(vertices=6000),
        GAUSSIAN,
    ),
    Preset(
        "noise",
        "Noise, amplified",
        "3 mm (sigma) off a tube of 40 cm, hardly visible, and K is off by more than its own size"
        " (RMS). A finer mesh makes it worse: last step.",
        Params(vertices=1600, noise=0.003),
        GAUSSIAN,
        breaks=True,
    ),
    Preset(
        "irregular",
        "Irregular triangles",
        "Vertices stray along the surface, never off it: no two triangles are alike. Will a finer"
        " mesh help the angles? The fit? See the last step.",
        IRREGULAR,
        GAUSSIAN,
        breaks=True,
    ),
    Preset(
        "sphere-sum",
        "A bumpy sphere",
        "Noise and jitter put K off by over five times its own size (RMS). What do the defects"
        " still add up to?",
        SPHERE_SUM,
        GAUSSIAN,
        breaks=True,
    ),
    Preset(
        "torus-sum",
        "A bumpy torus",
        "The same noise and jitter on a surface with a handle: gaps and overlaps cancel to the last"
        " digit.",
        Params(vertices=1000, jitter=0.25, noise=0.01),
        TOTAL,
        breaks=True,
    ),
)


def typical(values: np.ndarray) -> float:
    """Return the median of what is known."""
    return float(np.nanmedian(values))


def _why_cylinder(states: Sequence[State]) -> str:
    K, H = typical(at_stage(states, "gaussian").now.K), typical(at_stage(states, "mean").now.H)
    return (
        f"K = {abs(K):.3f} m⁻² and H = {H:.3f} m⁻¹: a sheet of paper rolls into a tube without"
        " stretching, so no angle changes."
    )


def _size_ratio(states: Sequence[State]) -> float:
    """Return how K at twice the size compares with K of the same mesh at its own size."""
    now = at_stage(states, "gaussian").now
    return float(np.nanmedian(now.K / gaussian_curvature(now.p / DOUBLE.size, now.faces)))


def _signs(states: Sequence[State]) -> tuple[bool, bool]:
    """Return whether K and H at the vertex have another sign than on the surface as it was made."""
    state = at_stage(states, "mean")
    K, H, surface, v = state.now.K, state.now.H, sure(state.subject.truth), state.now.vertex
    # Made outside out, K is the same and H the other way round (`inside_out`).
    return bool(K[v] * surface.gaussian[v] < 0), bool(H[v] * -surface.mean[v] < 0)


def _finer_ratio(states: Sequence[State]) -> float:
    study = sure(at_stage(states, "finer").study)
    return float(study.K[0] / study.K[-1])


def _why_finer(states: Sequence[State]) -> str:
    study = sure(at_stage(states, "finer").study)
    return (
        f"It goes from {percent(study.K[0], 1)} to {percent(study.K[-1], 1)} (RMS). The triangles"
        " shrink but keep their odd shapes, and so does the error of defect / area; that of the"
        f" quadric fit falls to {percent(study.K_fit[-1], 1)}."
    )


QUESTIONS: tuple[Question[Params, State], ...] = (
    Question(
        "which-rolled",
        "A sheet of paper is rolled into a tube of radius 0.5 m. What is its Gaussian curvature?",
        lambda states: float(
            np.argmin(
                np.abs(np.array([0.0, 2.0, 4.0]) - typical(at_stage(states, "gaussian").now.K))
            )
        ),
        _why_cylinder,
        CYLINDER,
        choices=(
            "zero",
            Choice(
                "2 m⁻²",
                why=(
                    "1 / r = 2 m⁻¹ is how the tube bends around its axis, the larger of two"
                    " curvatures. The other one, along the axis, counts too."
                ),
            ),
            Choice(
                "4 m⁻²",
                why=(
                    "1 / r² is that of a ball of this radius, which bends in both directions. A"
                    " tube is straight along its axis."
                ),
            ),
        ),
        step=GAUSSIAN,
    ),
    Question(
        "which-double",
        "The torus is made twice as large. What happens to its Gaussian curvature?",
        lambda states: float(
            np.argmin(np.abs(np.array([1.0, 0.5, 0.25, 0.125]) - _size_ratio(states)))
        ),
        lambda states: (
            f"It is {_size_ratio(states):.3f} times what it was: the angles stay, and each vertex"
            " has four times the area. H would be halved."
        ),
        DOUBLE,
        choices=(
            Choice(
                "it stays",
                why=(
                    "The angles stay, and with them the defects. But K is the defect for each"
                    " square metre."
                ),
            ),
            Choice(
                "it is halved",
                why="That is H, or one circle's 1 / r. K is the product of two such.",
            ),
            "a quarter is left",
            Choice(
                "an eighth is left",
                why="Volumes grow eightfold. What the defect is divided by is an area.",
            ),
        ),
        step=GAUSSIAN,
    ),
    Question(
        "which-sides",
        "All triangles are turned round, so that inside is outside. Which of K and H changes its"
        " sign?",
        lambda states: float(
            {(True, False): 0, (False, True): 1, (True, True): 2, (False, False): 3}[_signs(states)]
        ),
        lambda states: (
            "H turns with the normal. K is the product of k₁ and k₂, which both turn: minus times"
            " minus leaves it."
        ),
        INSIDE_OUT,
        choices=(
            Choice(
                "K",
                why=(
                    "K is the product of two curvatures. Both change their sign, so their product"
                    " does not."
                ),
            ),
            "H",
            Choice(
                "both",
                why=(
                    "Both circles bend to the other side now, but K is their product: minus times"
                    " minus."
                ),
            ),
            Choice(
                "neither",
                why=(
                    "The shape is the same, but H counts as positive where the surface bends away"
                    " from its normal, and the normal has turned."
                ),
            ),
        ),
        step=MEAN,
    ),
    Question(
        "which-finer",
        "A torus with irregular triangles, vertices exactly on it. Edges become four times shorter:"
        " the error of K from angle defects …",
        lambda states: float(
            np.argmin(np.abs(np.log(np.array([16.0, 4.0, 1.0]) / _finer_ratio(states))))
        ),
        _why_finer,
        IRREGULAR,
        choices=(
            Choice(
                "falls sixteenfold",
                why=(
                    "That is how it falls on regular meshes, where the errors of neighbouring"
                    " triangles cancel. Here they do not."
                ),
            ),
            Choice(
                "falls fourfold",
                why=(
                    "That would be first order in the edges. But the defect and its error shrink"
                    " just as the area does, so their quotient has no order at all."
                ),
            ),
            "hardly changes",
        ),
    ),
    Question(
        "which-sum",
        "A sphere, roughened by noise until K is off by more than its own size. To how many π do"
        " its angle defects add up?",
        lambda states: round(at_stage(states, "total").now.total / np.pi, 6),
        lambda states: (
            f"V − E + F = {at_stage(states, 'total').now.chi}, and 2π times that is 4π. No bump"
            " changes how the triangles hang together."
        ),
        SPHERE_SUM,
        unit="π",
        tolerance=0.01,
        wrong=(
            (
                0.0,
                0.1,
                (
                    "Noise makes as many gaps as overlaps, and these cancel. What is left is the"
                    " sum of the smooth sphere."
                ),
            ),
            (1.9, 2.1, "2 is V − E + F. The sum is 2π times that."),
            (12.4, 12.7, "That is the sum in radians. Asked is how many π it is."),
            (
                4.1,
                10000.0,
                "Each bump adds gaps at its top and overlaps at its foot, and the two cancel.",
            ),
        ),
        step=TOTAL,
    ),
)
