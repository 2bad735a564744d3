"""The stage `mesh`: one mesh measured, and the errors on ever finer ones."""

from collections.abc import Iterator
from dataclasses import replace

from lessons.curvature import captions, drawing
from lessons.curvature.functions import Functions, with_mistake
from lessons.curvature.inputs import Input
from lessons.curvature.mesh import subject_of
from lessons.curvature.presets import UNFOLDING
from lessons.curvature.state import Step, Subject, state_of
from lessons.curvature.study import error_of, study_of
from workbench.algorithms.surfaces.curvature import Measured, measure_curvature
from workbench.lesson import Look
from workbench.scene import Caption, Scene


def setup(params: Input) -> Subject:
    """Return the mesh to measure.

    Raises:
        InputError: If an own mesh cannot be used.
    """
    return subject_of(params)


def run(params: Input, subject: Subject, functions: Functions) -> Iterator[Step]:
    """Yield the parts of measuring one mesh, then, where the truth is known, the errors on ever
    finer meshes.
    """
    functions = with_mistake(params, functions)
    errors: dict[str, float] = {}
    step = None
    for mesh in measure_curvature(
        subject.p,
        subject.faces,
        subject.front if params.vertex < 0 else params.vertex % len(subject.p),
        angle_defects=functions.defects,
        gaussian_curvature=functions.gaussian,
        mean_curvature_normals=functions.normals,
    ):
        errors = errors | new_errors(subject, mesh)
        step = Step(now=mesh, errors=errors)
        if mesh.stage == "defect":
            yield from (replace(step, unfolded=share) for share in UNFOLDING)
        yield step
    if step is not None and subject.truth is not None:
        yield replace(step, study=study_of(params, functions.gaussian, functions.normals))


def caption(look: Look[Input, Subject, Step]) -> Caption:
    """Say what was measured."""
    return captions.caption(state_of(look))


def draw(look: Look[Input, Subject, Step]) -> Scene:
    """Return the picture of one step."""
    return drawing.draw(state_of(look))


def new_errors(subject: Subject, mesh: Measured) -> dict[str, float]:
    """Return the errors that this stage lets one know."""
    surface, inside = subject.truth, subject.inside
    if surface is None:
        return {}
    if mesh.stage == "gaussian":
        return {"K": error_of(surface, inside, "gaussian", estimate=mesh.K)}
    if mesh.stage == "mean":
        return {"H": error_of(surface, inside, "mean", estimate=mesh.H)}
    if mesh.stage == "quadric" and mesh.quadrics is not None:
        K, H = mesh.quadrics.curvatures()
        both = (
            error_of(surface, inside, "gaussian", estimate=K),
            error_of(surface, inside, "mean", estimate=H),
        )
        return {"K by fit": both[0], "H by fit": both[1]}
    return {}
