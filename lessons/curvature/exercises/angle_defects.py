"""Write the angle defects of a triangle mesh: how much the angles around each vertex miss a full
turn, or half a one on the border. The lesson lays a ring flat with the gap you return, and adds all
of them up to 2 pi chi.
"""

import numpy as np
from jaxtyping import Float, Int

from lessons.curvature.exercises import (
    STUDENTS,
    TETRAHEDRON,
    TRIANGLE,
    Mesh,
    border_of,
    box,
    irregular,
    some_rotation,
)
from workbench.exercise import (
    Function,
    Verdict,
    against,
    alternative,
    band,
    check,
    contract,
    left_alone,
    mistake,
)
from workbench.geometry.meshes import curvature, face_angles, on_boundary
from workbench.geometry.meshes.laplacian import mixed_areas


def defects_verdict(candidate: Function, mesh: Mesh, hint: str) -> Verdict:
    """Judge angle defects by the largest error in degrees, and say where it is."""
    p, faces = mesh
    got = candidate(p, faces)
    right = curvature.angle_defects(p, faces)
    off = np.degrees(np.abs(got - right))
    i = int(np.argmax(off))
    border = on_boundary(faces, len(p))
    place = "on the border" if border[i] else "inside the mesh"
    where = f"At vertex {i}, {place}, yours is {against(got[i], right[i])}. {hint}"
    return band("Largest error", float(off[i]), "degrees", good=0.01, fair=1.0, hint=where)


@contract(
    slot="angle_defects",
    examples=(
        (f"angle_defects({TETRAHEDRON})", "[3.6652, 3.6652, 3.6652, 1.5708]"),
        (f"angle_defects({TRIANGLE})", "[2.0944, 2.0944, 2.0944]"),
    ),
)
def angle_defects(
    p: Float[np.ndarray, "v 3"], faces: Int[np.ndarray, "f 3"]
) -> Float[np.ndarray, " v"]:
    """Return how much the angles around each vertex miss a flat turn, in radians.

    At a vertex inside the mesh that is 2 pi less the sum of the angles of its faces there, at a
    vertex on the border pi less that sum. The border are the vertices of those edges that only one
    face has; a closed mesh has none.

    Args:
        p: Vertices, metres, one row each.
        faces: Three vertex numbers per triangle, counterclockwise seen from outside. No edge has
            more than two faces.

    Returns:
        One angle defect per vertex, radians: not divided by an area. Positive at the tip of a cone,
        negative at a saddle. A face whose three vertices lie on one line has the angles 0, 0 and
        pi. A vertex that no face names counts as inside the mesh: nothing adds up to 2 pi there.
        The inputs stay as they are.
    """
    return curvature.angle_defects(p, faces)


DEFECT_HINT = "Inside the mesh: 2 pi less the angles at the vertex; on the border: pi less them."


@check(2)
def corners_of_a_box(candidate: Function) -> Verdict:
    """Each corner of a box misses a quarter turn, however long its edges are and however its sides
    are cut.
    """
    return defects_verdict(
        candidate, box(STUDENTS), f"Three right angles are there, of four. {DEFECT_HINT}"
    )


@check(2)
def flat_sheet(candidate: Function) -> Verdict:
    """A flat sheet has no defect inside nor along its straight border, and a quarter turn at its
    corners.
    """
    sheet = irregular("plane", STUDENTS, 60)
    return defects_verdict(
        candidate, (sheet.p @ some_rotation(STUDENTS).T, sheet.faces), DEFECT_HINT
    )


@check(1)
def mesh_is_left_alone(candidate: Function) -> Verdict:
    """The vertices and faces that come in are not changed."""
    return left_alone(candidate, defects_verdict(candidate, box(STUDENTS + 1), DEFECT_HINT))


@mistake(
    "You take the angles from 2 pi everywhere. On the border of a flat sheet they make half a turn:"
    " there the defect is pi less their sum."
)
def full_turn_on_the_border(p: np.ndarray, faces: np.ndarray) -> np.ndarray:
    """2 pi, also on the border."""
    return 2 * np.pi - sum_of_the_angles(p, faces)


@mistake(
    "You divided by the area. That is Gaussian curvature, 1/m²; the defect itself is an angle, in"
    " radians: curvature times area."
)
def curvature_returned(p: np.ndarray, faces: np.ndarray) -> np.ndarray:
    """Divides by the area."""
    return curvature.angle_defects(p, faces) / mixed_areas(p, faces)


@mistake(
    "You returned the sum of the angles around each vertex. The defect is what that sum misses: 2"
    " pi less the sum."
)
def sum_of_the_angles(p: np.ndarray, faces: np.ndarray) -> np.ndarray:
    """The angles, not what they miss."""
    return np.bincount(faces.ravel(), face_angles(p, faces).ravel(), len(p))


@mistake(
    "Your defects have the wrong sign. At the tip of a cone the angles make less than a full turn,"
    " and the defect is positive: 2 pi less the sum."
)
def sign(p: np.ndarray, faces: np.ndarray) -> np.ndarray:
    """The angles less a full turn."""
    return -curvature.angle_defects(p, faces)


@mistake("You returned degrees; the contract asks for radians.")
def degrees(p: np.ndarray, faces: np.ndarray) -> np.ndarray:
    """Converts what should stay in radians."""
    return np.degrees(curvature.angle_defects(p, faces))


@mistake(
    "`total[faces[:, k]] += angle` counts an index that occurs several times once only. Use"
    " np.add.at or np.bincount."
)
def repeated_indices(p: np.ndarray, faces: np.ndarray) -> np.ndarray:
    """`total[faces[:, k]] += ...`: of the faces around a vertex only one counts, the last."""
    total = np.zeros(len(p))
    angles = face_angles(p, faces)
    for k in range(3):
        total[faces[:, k]] += angles[:, k]
    return np.where(on_boundary(faces, len(p)), np.pi, 2 * np.pi) - total


@mistake(
    "Every face gives its angle to its first vertex only. It has three corners, and each belongs to"
    " another vertex."
)
def first_corner_only(p: np.ndarray, faces: np.ndarray) -> np.ndarray:
    """Every face gives its angle to its first vertex only."""
    total = np.bincount(faces[:, 0], face_angles(p, faces)[:, 0], len(p))
    return np.where(on_boundary(faces, len(p)), np.pi, 2 * np.pi) - total


@mistake(
    "All is right but faces without area: rounding makes their cosines a little larger than 1, and"
    " arccos gives nan. Clip them to [-1, 1], or take arctan2(|a x b|, a . b)."
)
def cosine_beyond_1(p: np.ndarray, faces: np.ndarray) -> np.ndarray:
    """Takes arccos of what rounding has made a little larger than 1."""
    total = np.zeros(len(p))
    for k in range(3):
        a, b = p[faces[:, (k + 1) % 3]] - p[faces[:, k]], p[faces[:, (k + 2) % 3]] - p[faces[:, k]]
        cosine = (a * b).sum(axis=1) / (np.linalg.norm(a, axis=1) * np.linalg.norm(b, axis=1))
        np.add.at(total, faces[:, k], np.arccos(cosine))
    return np.where(on_boundary(faces, len(p)), np.pi, 2 * np.pi) - total


@alternative
def defects_in_loops(p: np.ndarray, faces: np.ndarray) -> np.ndarray:
    """Face by face, the angle as that of two directions in the complex plane of the face."""
    left = [2 * np.pi] * len(p)
    seen: dict[tuple[int, int], int] = {}
    for face in faces.tolist():
        for i, j, k in (face, face[1:] + face[:1], face[2:] + face[:2]):
            a, b = p[j] - p[i], p[k] - p[i]
            left[i] -= float(np.angle(complex(a @ b, np.linalg.norm(np.cross(a, b)))))
            edge = (min(i, j), max(i, j))
            seen[edge] = seen.get(edge, 0) + 1
    for i in {i for edge, times in seen.items() if times == 1 for i in edge}:
        left[i] -= np.pi
    return np.array(left)


@alternative
def defects_by_cosines(p: np.ndarray, faces: np.ndarray) -> np.ndarray:
    """The arccos of clipped cosines; the border from the edges that only one face has."""
    total = np.zeros(len(p))
    for k in range(3):
        a, b = p[faces[:, (k + 1) % 3]] - p[faces[:, k]], p[faces[:, (k + 2) % 3]] - p[faces[:, k]]
        cosine = (a * b).sum(axis=1) / np.sqrt((a * a).sum(axis=1) * (b * b).sum(axis=1))
        np.add.at(total, faces[:, k], np.arccos(np.clip(cosine, -1, 1)))
    return np.where(border_of(len(p), faces), np.pi, 2 * np.pi) - total
