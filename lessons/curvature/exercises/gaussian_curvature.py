"""Write Gaussian curvature at the vertices of a mesh: what the angles miss, divided by the area
that belongs to the vertex. The lesson colours the surface with it, and measures how wrong it is on
ever finer meshes.
"""

import numpy as np
from jaxtyping import Float, Int

from lessons.curvature.exercises import (
    TETRAHEDRON,
    TRIANGLE,
    border_of,
    curvature_verdict,
    thirds,
    without_border,
)
from lessons.curvature.exercises.angle_defects import sum_of_the_angles
from workbench.data.shapes import surfaces
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
from workbench.geometry.meshes import curvature, on_boundary
from workbench.geometry.meshes.laplacian import mixed_areas


@contract(
    slot="gaussian_curvature",
    examples=(
        (f"gaussian_curvature({TETRAHEDRON})", "[6.8041, 6.8041, 6.8041, 2.0944]"),
        (f"gaussian_curvature({TRIANGLE})", "[nan, nan, nan]"),
    ),
)
def gaussian_curvature(
    p: Float[np.ndarray, "v 3"], faces: Int[np.ndarray, "f 3"]
) -> Float[np.ndarray, " v"]:
    """Return Gaussian curvature K at each vertex: its angle defect over its mixed area, 1/m^2.

    The defect is 2 pi less the angles at the vertex. The mixed area is made of a part of each face
    around:

    - of a face without an obtuse angle, the points nearer to this vertex than to the other two (its
      Voronoi part): (|ij|^2 cot k + |ik|^2 cot j) / 8 for vertex i, j and k being the angles at the
      other two;
    - of an obtuse face, half where the obtuse angle is at this vertex, a quarter where it is at
      another one.

    Args:
        p: Vertices, metres, one row each. Every vertex belongs to a face.
        faces: Three vertex numbers per triangle, counterclockwise seen from outside. No edge has
            more than two faces.

    Returns:
        K, 1/m^2: positive on a sphere, 0 on a cylinder, negative on a saddle, whichever side is
        called outside; nan on the border (the vertices of edges that only one face has), where it
        is not defined. A face whose three vertices lie on one line gives its angles 0, 0 and pi,
        and no area. The inputs stay as they are.
    """
    return curvature.gaussian_curvature(p, faces)


GAUSSIAN_HINT = "K = (2 pi less the angles) / mixed area."


@check(3)
def spheres(candidate: Function) -> Verdict:
    """A sphere of radius r has K = 1/r² everywhere."""
    verdicts = []
    for radius in (0.5, 3.0):
        ball = surfaces.sphere(162, radius)
        got = candidate(ball.p, ball.faces)
        label = f"Radius {radius:g} m: "
        verdicts.append(
            curvature_verdict(got, ball.gaussian, GAUSSIAN_HINT, good=3, fair=12, label=label)
        )
    return worst(verdicts)


@check(2)
def tube(candidate: Function) -> Verdict:
    """A cylinder can be rolled out flat: K = 0 inside, nan on its border."""
    pipe = surfaces.cylinder(150)
    right = without_border(pipe, pipe.gaussian)
    return curvature_verdict(
        candidate(pipe.p, pipe.faces), right, GAUSSIAN_HINT, good=0.1, fair=2, size=4.0
    )


@check(1)
def mesh_of_K_is_left_alone(candidate: Function) -> Verdict:
    """The vertices and faces that come in are not changed."""
    ball = surfaces.sphere(42)
    right = curvature.gaussian_curvature(ball.p, ball.faces)
    return left_alone(
        candidate,
        curvature_verdict(candidate(ball.p, ball.faces), right, GAUSSIAN_HINT, good=0.1, fair=5),
    )


@mistake(
    "You returned the angle defect. It is curvature times area: divide it by the area that belongs"
    " to the vertex."
)
def defect_not_divided(p: np.ndarray, faces: np.ndarray) -> np.ndarray:
    """The angle defect."""
    return np.where(on_boundary(faces, len(p)), np.nan, curvature.angle_defects(p, faces))


@mistake(
    "You divided by a third of the faces around. That is near the mixed area where triangles are"
    " alike; the contract asks for the Voronoi part, or a half and two quarters of an obtuse face."
)
def a_third_of_each_face(p: np.ndarray, faces: np.ndarray) -> np.ndarray:
    """The defect over a third of the faces around."""
    return defect_not_divided(p, faces) / thirds(p, faces)


@mistake(
    "You divided by the whole area of the faces around. Each face is shared by three vertices;"
    " yours counts it three times."
)
def whole_faces(p: np.ndarray, faces: np.ndarray) -> np.ndarray:
    """The defect over the whole ring: every face counts three times."""
    return defect_not_divided(p, faces) / (3 * thirds(p, faces))


@mistake(
    "You took the Voronoi part of every face. In an obtuse face it reaches outside: half of such a"
    " face goes to its obtuse corner, a quarter to each of the others."
)
def voronoi_in_obtuse_faces(p: np.ndarray, faces: np.ndarray) -> np.ndarray:
    """The Voronoi formula also where a face is obtuse."""
    area = np.zeros(len(p))
    for k in range(3):
        i = faces[:, k]
        j = faces[:, (k + 1) % 3]
        o = faces[:, (k + 2) % 3]
        a, b = p[i] - p[o], p[j] - p[o]
        cotangent = (a * b).sum(axis=1) / np.linalg.norm(np.cross(a, b), axis=1)
        part = cotangent * ((p[i] - p[j]) ** 2).sum(axis=1) / 8
        np.add.at(area, i, part)
        np.add.at(area, j, part)
    return defect_not_divided(p, faces) / area


@mistake(
    "You gave K on the border. There pi less the angles is how the border itself turns, no"
    " curvature of the surface: return nan."
)
def a_value_on_the_border(p: np.ndarray, faces: np.ndarray) -> np.ndarray:
    """Divides the turning of the border by an area."""
    return curvature.angle_defects(p, faces) / mixed_areas(p, faces)


@mistake(
    "You treat the border as if it were inside, so that a flat sheet seems to bend there. K is not"
    " defined on it: return nan."
)
def no_border(p: np.ndarray, faces: np.ndarray) -> np.ndarray:
    """Does not know of a border."""
    return (2 * np.pi - sum_of_the_angles(p, faces)) / mixed_areas(p, faces)


@mistake(
    "You returned the mean curvature H, 1/m. Gaussian curvature K is the product of the two"
    " principal curvatures, 1/m²: on a cylinder it is 0."
)
def mean_curvature(p: np.ndarray, faces: np.ndarray) -> np.ndarray:
    """H."""
    return curvature.mean_curvature(p, faces)


@mistake("You returned H². That is K on a sphere only; a cylinder has K = 0, and a saddle K < 0.")
def mean_curvature_squared(p: np.ndarray, faces: np.ndarray) -> np.ndarray:
    """H squared, which is K on a sphere only."""
    return curvature.mean_curvature(p, faces) ** 2


@alternative
def gaussian_by_corners(p: np.ndarray, faces: np.ndarray) -> np.ndarray:
    """Angles, areas and shares corner by corner."""
    a, b, c = (p[faces[:, k]] for k in range(3))
    double = np.linalg.norm(np.cross(b - a, c - a), axis=1)
    defect = np.full(len(p), 2 * np.pi)
    area = np.zeros(len(p))
    obtuse = np.zeros(len(faces), bool)
    dots = []
    for k in range(3):
        i, j, o = (faces[:, (k + m) % 3] for m in range(3))
        dots.append(((p[j] - p[i]) * (p[o] - p[i])).sum(axis=1))
        obtuse |= dots[k] < 0
        np.subtract.at(defect, i, np.arctan2(double, dots[k]))
    some = np.where(double > 0, double, 1.0)
    for k in range(3):
        i, j, o = (faces[:, (k + m) % 3] for m in range(3))
        to_j, to_o = ((p[j] - p[i]) ** 2).sum(axis=1), ((p[o] - p[i]) ** 2).sum(axis=1)
        voronoi = (to_j * dots[(k + 2) % 3] + to_o * dots[(k + 1) % 3]) / some / 8
        np.add.at(area, i, np.where(obtuse, double / np.where(dots[k] < 0, 4, 8), voronoi))
    edges = np.sort(np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]), axis=1)
    edges, times = np.unique(edges, axis=0, return_counts=True)
    on_border = np.isin(np.arange(len(p)), edges[times == 1])
    return np.where(on_border, np.nan, defect / area)


@alternative
def gaussian_by_circumcentres(p: np.ndarray, faces: np.ndarray) -> np.ndarray:
    """Face by face, the Voronoi part as two triangles with the circumcentre."""
    defect = np.full(len(p), 2 * np.pi)
    area = np.zeros(len(p))
    for face in faces:
        a, b, c = p[face]
        n = np.cross(b - a, c - a)
        whole = np.linalg.norm(n) / 2
        ends = [(b - a, c - a), (c - b, a - b), (a - c, b - c)]
        angles = [np.arctan2(2 * whole, x @ y) for x, y in ends]
        np.subtract.at(defect, face, angles)
        if max(angles) > np.pi / 2:
            np.add.at(
                area, face, [whole / 2 if angle > np.pi / 2 else whole / 4 for angle in angles]
            )
            continue
        u, v = b - a, c - a
        centre = a + ((u @ u) * np.cross(v, n) + (v @ v) * np.cross(n, u)) / (2 * n @ n)
        for i, corner, (x, y) in zip(face, (a, b, c), ends, strict=True):
            out = centre - corner
            area[i] += (np.linalg.norm(np.cross(x, out)) + np.linalg.norm(np.cross(out, y))) / 4
    return np.where(border_of(len(p), faces), np.nan, defect / area)
