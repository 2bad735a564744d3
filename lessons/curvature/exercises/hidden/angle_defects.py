"""What angle_defects is graded by besides the checks that a student sees."""

import numpy as np

from lessons.curvature.exercises import (
    GRADERS,
    Mesh,
    box,
    irregular,
    some_rotation,
    with_a_flat_face,
)
from lessons.curvature.exercises.angle_defects import DEFECT_HINT, defects_verdict
from workbench.data.shapes import surfaces
from workbench.exercise import Function, Verdict, band, check, full, number, worst
from workbench.geometry.meshes import euler_characteristic


def renumbered(p: np.ndarray, faces: np.ndarray, rng: np.random.Generator) -> Mesh:
    """Return the same mesh with its vertices, its faces and their first corners in another
    order.
    """
    place = rng.permutation(len(p))
    moved = np.empty_like(p)
    moved[place] = p
    turned = np.array(
        [
            np.roll(face, k)
            for face, k in zip(place[faces], rng.integers(0, 3, len(faces)), strict=True)
        ]
    )
    return moved, turned[rng.permutation(len(faces))]


FLAT_HINT = (
    "If a face without area gives nan: clip cosines to [-1, 1], or take arctan2(|a x b|, a . b)."
)


@check(3, public=False)
def gauss_bonnet(candidate: Function) -> Verdict:
    """All defects add up to 2 pi (V - E + F): on a sphere, a torus, a tube, a sheet, whatever the
    mesh.
    """
    verdicts = []
    for k, name in enumerate(("sphere", "torus", "cylinder", "saddle")):
        mesh = irregular(name, GRADERS() + k)
        p = surfaces.with_noise(mesh, 0.02, np.random.default_rng(GRADERS() + k)).p
        chi = euler_characteristic(mesh.faces)
        total = float(np.degrees(candidate(p, mesh.faces).sum()))
        comparison = (
            f"On a {name} with noise your sum is {number(total, 6)} degrees, right is {360 * chi}:"
            " error"
        )
        verdict = band(
            comparison, abs(total - 360 * chi), "degrees", good=0.01, fair=1.0, hint=DEFECT_HINT
        )
        verdicts.append(
            full("The four sums are 720, 0, 0 and 360 degrees.")
            if verdict.share == 1.0
            else verdict
        )
    return worst(verdicts)


@check(2, public=False)
def defects_go_with_the_mesh(candidate: Function) -> Verdict:
    """Moved, enlarged, made as small as a grain, turned inside out or numbered anew, every vertex
    keeps its defect.
    """
    rng = np.random.default_rng(GRADERS())
    mesh = irregular("catenoid", GRADERS(), 120)
    p = 3.0 * mesh.p @ some_rotation(GRADERS()).T + rng.normal(size=3)
    cases = [
        (mesh.p, mesh.faces),
        (p, mesh.faces),
        (p, mesh.faces[:, ::-1].copy()),
        renumbered(p, mesh.faces, rng),
    ]
    return worst(
        defects_verdict(candidate, case, DEFECT_HINT)
        for case in (*cases, (1e-3 * mesh.p, mesh.faces))
    )


ALONG_THE_DIAGONAL = (
    np.array([[0.0, 0, 0], [4, 4, 4], [4, 0, 0], [0, 4, 0]]),
    np.array([[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]]),
)
"""A tetrahedron with an edge along (1, 1, 1): on every machine that vector's length, squared, is a
little less than 3.
"""


@check(1, public=False)
def flat_faces_and_lone_vertices(candidate: Function) -> Verdict:
    """A face without area has angles 0, 0 and pi, and a vertex without faces a defect of 2 pi."""
    ball = surfaces.sphere(42)
    verdicts = []
    for k in range(16):  # which cosines rounding takes beyond 1 depends on how the mesh is turned
        p, faces = with_a_flat_face(ball.p @ some_rotation(GRADERS() + k).T, ball.faces)
        verdicts.append(
            defects_verdict(candidate, (np.concatenate([p, [[3.0, 0.0, 0.0]]]), faces), FLAT_HINT)
        )
    first = np.concatenate(
        [[[3.0, 0, 0]], ball.p[:7], [[0, 3.0, 0]], ball.p[7:], [[0, 0, 3.0], [1, 3.0, 0]]]
    )
    # four vertices without faces, wherever they stand
    shifted = ball.faces + np.where(ball.faces < 7, 1, 2)
    verdicts.append(defects_verdict(candidate, (first, shifted), DEFECT_HINT))
    verdicts.append(defects_verdict(candidate, with_a_flat_face(*box(GRADERS())), FLAT_HINT))
    verdicts.append(defects_verdict(candidate, with_a_flat_face(*ALONG_THE_DIAGONAL), FLAT_HINT))
    return worst(verdicts)
