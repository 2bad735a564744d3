"""What gaussian_curvature is graded by besides the checks that a student sees."""

import numpy as np

from lessons.curvature.exercises import (
    GRADERS,
    box,
    curvature_verdict,
    irregular,
    some_rotation,
    with_a_flat_face,
)
from lessons.curvature.exercises.gaussian_curvature import GAUSSIAN_HINT
from workbench.data.shapes import surfaces
from workbench.exercise import Function, Verdict, check, worst
from workbench.geometry.meshes import curvature


@check(2, public=False)
def obtuse_faces(candidate: Function) -> Verdict:
    """On irregular meshes with obtuse faces the mixed areas are right."""
    hint = "Half of an obtuse face belongs to its obtuse corner, a quarter to each of the others."
    verdicts = []
    for k, name in enumerate(("torus", "catenoid")):
        mesh = irregular(name, GRADERS() + k)
        right = curvature.gaussian_curvature(mesh.p, mesh.faces)
        got = candidate(mesh.p, mesh.faces)
        verdicts.append(
            curvature_verdict(got, right, hint, good=0.1, fair=5, label=f"{name.capitalize()}: ")
        )
    return worst(verdicts)


@check(2, public=False)
def size_and_side(candidate: Function) -> Verdict:
    """Twice the size gives a quarter of K, a hundredth 10,000 times K; a motion or another outside
    change nothing.
    """
    mesh = irregular("saddle", GRADERS())
    right = curvature.gaussian_curvature(mesh.p, mesh.faces)
    p = mesh.p @ some_rotation(GRADERS()).T + np.array([5.0, -2.0, 1.0])
    cases = (
        ("Moved: ", (p, mesh.faces), right),
        ("Twice as large: ", (2 * p, mesh.faces), right / 4),
        ("A hundredth as large: ", (0.01 * p, mesh.faces), 1e4 * right),
        ("Inside out: ", (p, mesh.faces[:, ::-1].copy()), right),
    )
    return worst(
        curvature_verdict(candidate(*case), wanted, GAUSSIAN_HINT, good=0.1, fair=5, label=label)
        for label, case, wanted in cases
    )


@check(1, public=False)
def face_without_area(candidate: Function) -> Verdict:
    """A face without area adds its angles and no area."""
    ball = surfaces.sphere(42)
    hint = (
        "It is obtuse: its parts are a half and two quarters of nothing. Clip cosines, or take"
        " arctan2."
    )
    verdicts = []
    for mesh in (with_a_flat_face(ball.p, ball.faces), with_a_flat_face(*box(GRADERS()))):
        right = curvature.gaussian_curvature(*mesh)
        verdicts.append(curvature_verdict(candidate(*mesh), right, hint, good=0.1, fair=5))
    return worst(verdicts)
