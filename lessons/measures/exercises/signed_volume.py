"""Write the volume inside a mesh: the sum of the signed tetrahedra between the origin of
coordinates and all faces. The lesson adds up its faces with it, the near ones first, from wherever
its origin was dragged to.
"""

import numpy as np
from jaxtyping import Float, Int

from lessons.measures.exercises import (
    STUDENTS,
    TETRAHEDRON,
    TRIANGLE,
    Mesh,
    blob,
    l_block,
    relative_verdict,
)
from workbench.exercise import (
    Function,
    Verdict,
    alternative,
    check,
    contract,
    left_alone,
    mistake,
    worst,
)
from workbench.geometry.meshes.measures import tetrahedra, volume_about


@contract(
    slot="signed_volume",
    examples=(
        (f"signed_volume({TETRAHEDRON})", "0.16667"),
        (f"signed_volume({TRIANGLE})", "0.16667"),
        ("signed_volume(np.eye(3), np.array([[0, 2, 1]]))", "-0.16667"),
    ),
)
def signed_volume(p: Float[np.ndarray, "v 3"], faces: Int[np.ndarray, "f 3"]) -> float:
    """Return the sum of the signed tetrahedra between the origin of coordinates and all faces, m^3.

    The tetrahedron of a face with corners a, b, c has the volume |a . (b x c)| / 6. It counts plus
    where the origin lies behind the face, on the side from which a, b, c run clockwise, and minus
    where it lies before it.

    Args:
        p: Vertices, metres, one row each.
        faces: Three vertex numbers per triangle, counterclockwise seen from outside.

    Returns:
        The sum: of a closed mesh its volume, negative where it is turned inside out. Of an open
        mesh it is the sum all the same, about the origin (0, 0, 0), and 0 where there are no faces.
        The inputs stay as they are.
    """
    return volume_about(p, faces, np.zeros(3))


VOLUME_HINT = "V = sum of a . (b x c) / 6 over the faces, signs kept."


def volume_verdict(candidate: Function, mesh: Mesh, case: str, hint: str = VOLUME_HINT) -> Verdict:
    """Judge the volume of a mesh, related to the volumes of all tetrahedra without their signs."""
    parts = tetrahedra(mesh[0], mesh[1], np.zeros(3))
    size = max(float(np.abs(parts).sum()) / 10, abs(float(parts.sum())))
    got = float(candidate(*mesh))
    return relative_verdict(case, got, float(parts.sum()), hint, good=1e-4, fair=0.1, size=size)


@check(2)
def closed_meshes(candidate: Function) -> Verdict:
    """Closed meshes around the origin have their volume, convex or not."""
    p, faces = l_block()
    moved = p - [0.2, 0.1, 0.25]
    return worst(
        (
            volume_verdict(candidate, (moved, faces), "An L-shaped block"),
            volume_verdict(candidate, blob(STUDENTS), "A bent ring"),
        )
    )


@check(2)
def origin_outside(candidate: Function) -> Verdict:
    """Where the origin lies outside, what lies between it and the mesh cancels."""
    hint = "Faces that look towards the origin count minus."
    return volume_verdict(
        candidate, blob(STUDENTS + 1, (3.0, -2.0, 1.0)), "A bent ring 3.7 m away", hint
    )


@check(1)
def mesh_of_the_volume_is_left_alone(candidate: Function) -> Verdict:
    """The vertices and faces that come in are not changed."""
    return left_alone(candidate, volume_verdict(candidate, blob(STUDENTS + 2), "A bent ring"))


@mistake(
    "You added up absolute values. Faces that look towards the origin count minus: keep each sign."
)
def unsigned(p: np.ndarray, faces: np.ndarray) -> float:
    """Adds up what has to cancel."""
    return float(np.abs(tetrahedra(p, faces, np.zeros(3))).sum())


@mistake(
    "You took the absolute value of the sum. A mesh that is turned inside out has a negative"
    " volume."
)
def size_only(p: np.ndarray, faces: np.ndarray) -> float:
    """Drops the sign at the end."""
    return abs(signed_volume(p, faces))


@mistake("Your sum is twice as large: a tetrahedron is a sixth of a . (b x c), not a third.")
def a_third(p: np.ndarray, faces: np.ndarray) -> float:
    """Divides by 3."""
    return 2 * signed_volume(p, faces)


@mistake(
    "Your sum is three times as large: half of a . (b x c) is no volume. A tetrahedron is a sixth"
    " of it."
)
def a_half(p: np.ndarray, faces: np.ndarray) -> float:
    """Divides by 2, as for areas."""
    return 3 * signed_volume(p, faces)


@mistake(
    "You left out the division by 6: a . (b x c) is the volume of a parallelepiped, six tetrahedra."
)
def undivided(p: np.ndarray, faces: np.ndarray) -> float:
    """Does not divide."""
    return 6 * signed_volume(p, faces)


@mistake(
    "Your sign is the wrong way round: a . (b x c) is positive where the origin lies behind a face."
)
def turned_round(p: np.ndarray, faces: np.ndarray) -> float:
    """Minus the sum."""
    return -signed_volume(p, faces)


@mistake(
    "Your tetrahedra have their tip in the middle of the vertices. Closed meshes do not mind; of an"
    " open one the contract asks for the sum about (0, 0, 0)."
)
def about_the_middle(p: np.ndarray, faces: np.ndarray) -> float:
    """Moves the origin."""
    return volume_about(p, faces, p.mean(axis=0))


@mistake(
    "You returned the volume of the convex hull. It fills every dent and hole: add up the faces"
    " instead."
)
def convex_hull(p: np.ndarray, faces: np.ndarray) -> float:
    """Volume of the hull of the vertices."""
    import scipy

    return float(scipy.spatial.ConvexHull(p).volume)


@alternative
def by_determinants(p: np.ndarray, faces: np.ndarray) -> float:
    """A determinant for each face."""
    return float(np.linalg.det(p[faces]).sum() / 6) if len(faces) else 0.0


@alternative
def by_heights(p: np.ndarray, faces: np.ndarray) -> float:
    """A third of area times the distance of each face's plane."""
    total = 0.0
    for i, j, k in faces:
        n = np.cross(p[j] - p[i], p[k] - p[i]) / 2
        total += n @ (p[i] + p[j] + p[k]) / 9
    return float(total)
