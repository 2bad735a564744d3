"""What mean_curvature_normals is graded by besides the checks that a student sees."""

import numpy as np

from lessons.curvature.exercises import (
    GRADERS,
    curvature_verdict,
    irregular,
    some_rotation,
    without_border,
)
from lessons.curvature.exercises.mean_curvature_normals import NORMAL_HINT, _pulled
from workbench.data.shapes import surfaces
from workbench.exercise import Function, Verdict, check, worst
from workbench.geometry.meshes import curvature


@check(2, public=False)
def irregular_faces(candidate: Function) -> Verdict:
    """On irregular meshes with obtuse faces the cotangents and areas are right."""
    return worst(
        _pulled(candidate, irregular(name, GRADERS() + k), label=f"{name.capitalize()}: ")
        for k, name in enumerate(("torus", "saddle"))
    )


@check(2, public=False)
def plane_and_soap_film(candidate: Function) -> Verdict:
    """They vanish on a plane however it is cut, and on a catenoid, whose two curvatures cancel."""
    sheet = irregular("plane", GRADERS(), 100)
    film = surfaces.catenoid(300)
    hint = f"Flat or balanced means 0. {NORMAL_HINT}"
    return worst(
        curvature_verdict(
            candidate(mesh.p, mesh.faces),
            without_border(mesh, np.zeros_like(mesh.p)),
            hint,
            good=good,
            fair=fair,
            size=2.0,
            label=label,
        )
        for label, mesh, good, fair in (("Plane: ", sheet, 0.1, 1), ("Catenoid: ", film, 2, 6))
    )


@check(2, public=False)
def turns_with_the_mesh(candidate: Function) -> Verdict:
    """They turn with the mesh, halve on one of twice the size, and stay where its outside is called
    inside.
    """
    mesh = irregular("torus", GRADERS() + 5, 100)
    right = curvature.mean_curvature_normals(mesh.p, mesh.faces)
    R = some_rotation(GRADERS() + 5)
    p = mesh.p @ R.T + np.array([1.0, -4.0, 2.0])
    cases = (
        ("Turned: ", (p, mesh.faces), right @ R.T),
        ("Twice as large: ", (2 * p, mesh.faces), right @ R.T / 2),
        ("A hundredth as large: ", (0.01 * p, mesh.faces), right @ R.T * 100),
        ("Inside out: ", (p, mesh.faces[:, ::-1].copy()), right @ R.T),
    )
    return worst(
        curvature_verdict(candidate(*case), wanted, NORMAL_HINT, good=0.1, fair=5, label=label)
        for label, case, wanted in cases
    )
