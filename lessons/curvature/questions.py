"""What to predict before looking, with known wrong answers."""

import numpy as np

from lessons.curvature import paper
from lessons.curvature.inputs import Input
from lessons.curvature.presets import (
    CYLINDER,
    DEFECT,
    DOUBLE,
    GAUSSIAN,
    INSIDE_OUT,
    IRREGULAR,
    MEAN,
    PAPER,
    SPHERE_SUM,
    TOTAL,
)
from lessons.curvature.state import Subject, at_stage
from workbench.certain import as_a, sure
from workbench.geometry.meshes.curvature import gaussian_curvature
from workbench.lesson import Choice, Question, States
from workbench.numerals import percent


def typical(values: np.ndarray) -> float:
    """Return the median of what is known."""
    return float(np.nanmedian(values))


def _why_cylinder(states: States) -> str:
    K, H = typical(at_stage(states, "gaussian").now.K), typical(at_stage(states, "mean").now.H)
    return (
        f"K = {abs(K):.3f} m⁻² and H = {H:.3f} m⁻¹: a sheet of paper rolls into a tube without"
        " stretching, so no angle changes."
    )


def _size_ratio(states: States) -> float:
    """Return how K at twice the size compares with K of the same mesh at its own size."""
    mesh = at_stage(states, "gaussian").now
    return float(np.nanmedian(mesh.K / gaussian_curvature(mesh.p / DOUBLE.size, mesh.faces)))


def _signs(states: States) -> tuple[bool, bool]:
    """Return whether K and H at the vertex have another sign than on the surface as it was made."""
    mesh = at_stage(states, "mean").now
    subject = as_a(Subject, states.subject)
    K = mesh.K
    H = mesh.H
    surface = sure(subject.truth)
    v = mesh.vertex
    # Made outside out, K is the same and H the other way round (`inside_out`).
    return bool(K[v] * surface.gaussian[v] < 0), bool(H[v] * -surface.mean[v] < 0)


def _finer_ratio(states: States) -> float:
    study = sure(at_stage(states, "finer").study)
    return float(study.K[0] / study.K[-1])


def _why_finer(states: States) -> str:
    study = sure(at_stage(states, "finer").study)
    return (
        f"It goes from {percent(study.K[0], 1)} to {percent(study.K[-1], 1)} (RMS). The triangles"
        " shrink but keep their odd shapes, and so does the error of defect / area; that of the"
        f" quadric fit falls to {percent(study.K_fit[-1], 1)}."
    )


def _outside_and_inside(states: States) -> tuple[float, float]:
    """Return all gaps and all overlaps of a mesh, each added up, degrees."""
    defects = np.degrees(at_stage(states, "defect").now.defects)
    return float(defects[defects > 0].sum()), float(-defects[defects < 0].sum())


def _which_inside(states: States) -> float:
    gaps, overlaps = _outside_and_inside(states)
    return float(np.digitize(overlaps / gaps, [0.98, 1.02]))


def _seven(states: States) -> float:
    """Return which answer holds for seven angles of 60 degrees: their gap is one of the run's."""
    gap = 360.0 - 7 * 60.0
    held = next(state for state in states if as_a(paper.Held, state).gap == gap)
    return float(1 - np.sign(held.gap))


QUESTIONS: tuple[Question, ...] = (
    Question(
        name="seven",
        text=(
            "Seven triangles with equal sides are put around one point. Compared with a full "
            "turn, their angles are …"
        ),
        answer=_seven,
        why=lambda states: (
            "Seven angles of 60° make 420°, so the ring overlaps by 60°. Here six larger triangles"
            f" overlap by the same 60°: {paper.TRIANGLES} times 70° is 420°, too."
        ),
        params=PAPER,
        choices=(
            Choice(
                "60° too small",
                why=("Five of them leave 60° open. Seven have more than a full turn."),
            ),
            Choice(
                "just right",
                why=("Six of them lie flat: 6 times 60° is 360°. The seventh is too much."),
            ),
            "60° too large",
        ),
        start=int(np.argmin(np.abs(paper.HAND))),
        step=int(np.argmin(np.abs(paper.HAND + 60.0))),
    ),
    Question(
        name="inside",
        text="All gaps of this torus add up to 715°. And all its overlaps?",
        answer=_which_inside,
        why=lambda states: (
            "{:.1f}° of gaps and {:.1f}° of overlaps. That they agree is no accident: the scene on"
            " all gaps together says why.".format(*_outside_and_inside(states))
        ),
        params=Input(),
        choices=(
            Choice(
                "less", why="There is less paper inside, but it is bent more for each square metre."
            ),
            "as much",
            Choice(
                "more", why="It is bent more for each square metre, but there is less paper inside."
            ),
        ),
        start=DEFECT,
        step=DEFECT,
    ),
    Question(
        name="which-rolled",
        text=(
            "A sheet of paper is rolled into a tube of radius 0.5 m. What is its Gaussian "
            "curvature?"
        ),
        answer=lambda states: float(
            np.argmin(
                np.abs(np.array([0.0, 2.0, 4.0]) - typical(at_stage(states, "gaussian").now.K))
            )
        ),
        why=_why_cylinder,
        params=CYLINDER,
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
        start=0,
        step=GAUSSIAN,
    ),
    Question(
        name="which-double",
        text="The torus is made twice as large. What happens to its Gaussian curvature?",
        answer=lambda states: float(
            np.argmin(np.abs(np.array([1.0, 0.5, 0.25, 0.125]) - _size_ratio(states)))
        ),
        why=lambda states: (
            f"It is {_size_ratio(states):.3f} times what it was: the angles stay, and each vertex"
            " has four times the area. H would be halved."
        ),
        params=DOUBLE,
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
        start=0,
        step=GAUSSIAN,
    ),
    Question(
        name="which-sides",
        text=(
            "All triangles are turned round, so that inside is outside. Which of K and H changes "
            "its sign?"
        ),
        answer=lambda states: float(
            {(True, False): 0, (False, True): 1, (True, True): 2, (False, False): 3}[_signs(states)]
        ),
        why=lambda states: (
            "H turns with the normal. K is the product of k₁ and k₂, which both turn: minus times"
            " minus leaves it."
        ),
        params=INSIDE_OUT,
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
        start=0,
        step=MEAN,
    ),
    Question(
        name="which-finer",
        text=(
            "A torus with irregular triangles, vertices exactly on it. Edges become four times "
            "shorter: the error of K from angle defects …"
        ),
        answer=lambda states: float(
            np.argmin(np.abs(np.log(np.array([16.0, 4.0, 1.0]) / _finer_ratio(states))))
        ),
        why=_why_finer,
        params=IRREGULAR,
        start=0,
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
        name="which-sum",
        text=(
            "A sphere, roughened by noise until K is off by more than its own size. To how many π"
            " do its angle defects add up?"
        ),
        answer=lambda states: round(at_stage(states, "total").now.total / np.pi, 6),
        why=lambda states: (
            f"V − E + F = {at_stage(states, 'total').now.chi}, and 2π times that is 4π. No bump"
            " changes how the triangles hang together."
        ),
        params=SPHERE_SUM,
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
                20.0,
                "Each bump adds gaps at its top and overlaps at its foot, and the two cancel.",
            ),
        ),
        start=0,
        step=TOTAL,
        low=0.0,
        high=20.0,
        stride=0.5,
    ),
)
