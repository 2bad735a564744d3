"""What signed_volume is graded by besides the checks that a student sees."""

import numpy as np

from lessons.measures.exercises import GRADERS, blob, relative_verdict, without_a_side
from lessons.measures.exercises.signed_volume import VOLUME_HINT, volume_verdict
from workbench.exercise import Function, Verdict, check, worst


@check(2, public=False)
def inside_out(candidate: Function) -> Verdict:
    """Turned inside out, a mesh has its volume with a minus sign, also one of a few centimetres."""
    p, faces = blob(GRADERS(), (0.3, 0.2, -0.1))
    hint = "The sign of the sum tells which side is called outside: keep it."
    turned = faces[:, ::-1].copy()
    large = volume_verdict(candidate, (p, turned), "A bent ring inside out", hint)
    return worst(
        (large, volume_verdict(candidate, (0.02 * p, turned), "A small bent ring inside out", hint))
    )


@check(2, public=False)
def open_meshes(candidate: Function) -> Verdict:
    """An open mesh gives the sum about the origin of coordinates."""
    mesh = without_a_side(*blob(GRADERS() + 1, (0.5, 1.0, 0.4)))
    hint = (
        "The tip of all tetrahedra is (0, 0, 0), not the middle of the vertices, and no hole is"
        " closed."
    )
    return worst(
        (
            volume_verdict(candidate, mesh, "A ring without its side", hint),
            volume_verdict(candidate, (mesh[0], mesh[1][:1]), "One triangle", hint),
            volume_verdict(
                candidate, (mesh[0], mesh[1][:1, ::-1].copy()), "One triangle turned over", hint
            ),
        )
    )


@check(1, public=False)
def no_faces(candidate: Function) -> Verdict:
    """Without faces the sum is 0."""
    got = float(candidate(np.eye(3), np.empty((0, 3), dtype=int)))
    return relative_verdict(
        "Three vertices and no face", got, 0.0, VOLUME_HINT, good=1e-6, fair=1e-3, size=1.0
    )
