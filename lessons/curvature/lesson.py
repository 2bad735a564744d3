"""How a surface bends, measured on triangles.

What it teaches: angles around a vertex that do not add up to a full turn *are* Gaussian curvature,
times area; the cotangent formula gives the mean-curvature normal; both follow from a few triangles
and suffer with them, which a fit to a neighbourhood does not; and the defects' sum knows nothing of
the mesh but its number of holes.
"""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

from lessons.curvature import balls, paper, whole_mesh
from lessons.curvature.functions import Functions
from lessons.curvature.inputs import Input
from lessons.curvature.presets import GAUSSIAN, PRESETS, SWEEPS, VIEW, VIEWS
from lessons.curvature.questions import QUESTIONS
from lessons.curvature.state import Subject
from workbench.algorithms.surfaces.curvature import Defects, Gaussian, MeanNormals
from workbench.geometry.meshes import curvature
from workbench.lesson import Lesson, Look
from workbench.scene import Scene

STAGES = {"mesh": whole_mesh, "paper": paper, "balls": balls}


def setup(params: Input) -> Subject | paper.Sheet | balls.Balls:
    """Return the mesh to measure, the ring of paper, or the four balls.

    Raises:
        InputError: If an own mesh cannot be used.
    """
    return STAGES[params.stage].setup(params)


def run(
    params: Input,
    subject: Any,
    *,
    angle_defects: Defects = curvature.angle_defects,
    gaussian_curvature: Gaussian = curvature.gaussian_curvature,
    mean_curvature_normals: MeanNormals = curvature.mean_curvature_normals,
) -> Iterator[Any]:
    """Yield the parts of measuring one mesh, then, where the truth is known, the errors on ever
    finer meshes; or the ring of paper between an overlap and a gap; or one ball after the other.
    """
    functions = Functions(angle_defects, gaussian_curvature, mean_curvature_normals)
    yield from STAGES[params.stage].run(params, subject, functions)


def draw(look: Look) -> Scene:
    """Return the picture of one step."""
    return STAGES[look.params.stage].draw(look)


lesson = Lesson(
    name="curvature",
    title="Curvature of a mesh",
    summary="On flat paper the angles around a point add up to 360°. On a curved surface they "
    "may not.",
    page=Path(__file__).with_name("page.md"),
    params=Input,
    setup=setup,
    run=run,
    draw=draw,
    order=1600,
    chapter="Measure",
    minutes=25,
    needs=("measures",),
    view=VIEW,
    views=VIEWS,
    presets=PRESETS,
    questions=QUESTIONS,
    first_step=GAUSSIAN,
    sweeps=SWEEPS,
    telling="K and its truth",
)
