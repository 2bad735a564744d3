"""How a surface bends, measured on triangles.

What it teaches: angles around a vertex that do not add up to a full turn *are* Gaussian curvature,
times area; the cotangent formula gives the mean-curvature normal; both follow from a few triangles
and suffer with them, which a fit to a neighbourhood does not; and the defects' sum knows nothing of
the mesh but its number of holes.
"""

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np

from lessons.curvature import balls, drawing, paper
from lessons.curvature.inputs import Input
from lessons.curvature.mesh import subject_of
from lessons.curvature.presets import GAUSSIAN, PRESETS, SWEEPS, UNFOLDING, VIEW, VIEWS
from lessons.curvature.questions import QUESTIONS
from lessons.curvature.state import Step, Subject, state_of
from lessons.curvature.study import error_of, study_of
from workbench.algorithms.surfaces.curvature import (
    Defects,
    Gaussian,
    MeanNormals,
    Measured,
    measure_curvature,
)
from workbench.geometry.meshes import curvature, on_boundary
from workbench.geometry.meshes.laplacian import mixed_areas
from workbench.lesson import Lesson, Look
from workbench.scene import Scene


def setup(params: Input) -> Subject | paper.Sheet | balls.Balls:
    """Return the mesh to measure, the ring of paper, or the four balls.

    Raises:
        InputError: If an own mesh cannot be used.
    """
    if params.stage == "paper":
        return paper.Sheet()
    return balls.balls() if params.stage == "balls" else subject_of(params)


def run(
    params: Input,
    subject: Subject | paper.Sheet | balls.Balls,
    *,
    angle_defects: Defects = curvature.angle_defects,
    gaussian_curvature: Gaussian = curvature.gaussian_curvature,
    mean_curvature_normals: MeanNormals = curvature.mean_curvature_normals,
) -> Iterator[Step | paper.Held | balls.Held]:
    """Yield the stages of measuring one mesh, then, where the truth is known, the errors on ever
    finer meshes; or the ring of paper between an overlap and a gap; or one ball after the other.
    """
    if isinstance(subject, paper.Sheet):
        yield from paper.hand()
        return
    defects, gaussian, normals = with_mistake(
        params, angle_defects, gaussian_curvature, mean_curvature_normals
    )
    if isinstance(subject, balls.Balls):
        yield from balls.run(subject, defects, gaussian)
        return
    errors: dict[str, float] = {}
    step = None
    for now in measure_curvature(
        subject.p,
        subject.faces,
        subject.front if params.vertex < 0 else params.vertex % len(subject.p),
        angle_defects=defects,
        gaussian_curvature=gaussian,
        mean_curvature_normals=normals,
    ):
        errors = errors | new_errors(subject, now)
        step = Step(now=now, errors=errors)
        if now.stage == "defect":
            yield from (replace(step, unfolded=share) for share in UNFOLDING)
        yield step
    if step is not None and subject.truth is not None:
        yield replace(step, study=study_of(params, gaussian, normals))


def draw(look: Look) -> Scene:
    """Return the picture of one step."""
    if isinstance(look.subject, paper.Sheet):
        return paper.draw(look)
    if isinstance(look.subject, balls.Balls):
        return balls.draw(look)
    return drawing.draw(state_of(look))


def new_errors(subject: Subject, now: Measured) -> dict[str, float]:
    """Return the errors that this stage lets one know."""
    surface, inside = subject.truth, subject.inside
    if surface is None:
        return {}
    if now.stage == "gaussian":
        return {"K": error_of(surface, inside, "gaussian", now.K)}
    if now.stage == "mean":
        return {"H": error_of(surface, inside, "mean", now.H)}
    if now.stage == "quadric" and now.quadrics is not None:
        K, H = now.quadrics.curvatures()
        both = error_of(surface, inside, "gaussian", K), error_of(surface, inside, "mean", H)
        return {"K by fit": both[0], "H by fit": both[1]}
    return {}


def with_mistake(
    params: Input, defects: Defects, gaussian: Gaussian, normals: MeanNormals
) -> tuple[Defects, Gaussian, MeanNormals]:
    """Return the three functions, one of them spoilt by the chosen mistake."""
    if params.mistake == "2 pi on the border":
        return (
            lambda p, faces: defects(p, faces) + np.pi * on_boundary(faces, len(p)),
            gaussian,
            normals,
        )
    if params.mistake == "defect taken for K":
        return defects, lambda p, faces: gaussian(p, faces) * mixed_areas(p, faces), normals
    if params.mistake == "H without the half":
        return defects, gaussian, lambda p, faces: 2 * normals(p, faces)
    return defects, gaussian, normals


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
