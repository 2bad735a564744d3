"""Write the mean-curvature normals of a mesh by the cotangent formula: at each vertex how its
neighbours pull, divided by its area. The lesson draws them, and reads H off as half their length
along the outward normal.
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
from workbench.data.shapes import surfaces
from workbench.data.shapes.surfaces import Surface
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
from workbench.geometry.meshes import curvature, on_boundary, vertex_normals
from workbench.geometry.meshes.laplacian import mixed_areas


@contract(
    slot="mean_curvature_normals",
    examples=(
        (
            f"mean_curvature_normals({TETRAHEDRON})",
            (
                "[[2.928, -0.536, -0.536], [-0.536, 2.928, -0.536], [-0.536, -0.536, 2.928],"
                " [-1.333, -1.333, -1.333]]"
            ),
        ),
        (f"mean_curvature_normals({TRIANGLE})", "np.full((3, 3), nan)"),
    ),
)
def mean_curvature_normals(
    p: Float[np.ndarray, "v 3"], faces: Int[np.ndarray, "f 3"]
) -> Float[np.ndarray, "v 3"]:
    """Return the mean-curvature normal 2 H n at each vertex, 1/m.

    For vertex i it is 1 / (2 A_i) times the sum over its edges ij of (cot a_ij + cot b_ij) (p_i -
    p_j). a_ij and b_ij are the angles opposite the edge, one in each of its two faces. A_i is the
    mixed area, made of a part of each face around:

    - of a face without an obtuse angle, the points nearer to this vertex than to the other two (its
      Voronoi part): (|ij|^2 cot k + |ik|^2 cot j) / 8 for vertex i, j and k being the angles at the
      other two;
    - of an obtuse face, half where the obtuse angle is at this vertex, a quarter where it is at
      another one.

    Args:
        p: Vertices, metres, one row each. Every vertex belongs to a face.
        faces: Three vertex numbers per triangle, counterclockwise seen from outside. No edge has
            more than two faces, and no face is without area.

    Returns:
        One vector per vertex, 1/m: on a sphere of radius r it points outward and is 2/r long; on a
        plane it is 0. It does not depend on which side is called outside. nan (all three) on the
        border, the vertices of edges that only one face has: it is not defined there. The inputs
        stay as they are.
    """
    return curvature.mean_curvature_normals(p, faces)


NORMAL_HINT = "Add up (cot a + cot b) (p_i - p_j) over the edges and divide by 2 A_i."


def _pulled(
    candidate: Function, mesh: Surface, hint: str = NORMAL_HINT, label: str = ""
) -> Verdict:
    """Judge 2 H n against the right answer on the same mesh."""
    right = curvature.mean_curvature_normals(mesh.p, mesh.faces)
    return curvature_verdict(
        candidate(mesh.p, mesh.faces), right, hint, good=0.1, fair=5, label=label
    )


@check(3)
def outward_on_spheres(candidate: Function) -> Verdict:
    """On a sphere of radius r the vectors point outward and are 2/r long."""
    verdicts = []
    for radius in (0.5, 3.0):
        ball = surfaces.sphere(162, radius)
        got = candidate(ball.p, ball.faces)
        right = 2 / radius * ball.normals
        verdicts.append(
            curvature_verdict(
                got, right, NORMAL_HINT, good=3, fair=12, label=f"Radius {radius:g} m: "
            )
        )
    return worst(verdicts)


@check(2)
def around_a_tube(candidate: Function) -> Verdict:
    """On a cylinder of radius r they are 1/r long, and nan on its border."""
    pipe = surfaces.cylinder(200)
    right = without_border(pipe, 2 * pipe.mean[:, None] * pipe.normals)
    return curvature_verdict(candidate(pipe.p, pipe.faces), right, NORMAL_HINT, good=1, fair=8)


@check(1)
def mesh_of_H_is_left_alone(candidate: Function) -> Verdict:
    """The vertices and faces that come in are not changed."""
    return left_alone(candidate, _pulled(candidate, surfaces.sphere(42)))


@mistake(
    "Your vectors have the right length and point the wrong way: on a sphere 2 H n points outward."
    " Take p_i - p_j, from the neighbour to the vertex."
)
def inward(p: np.ndarray, faces: np.ndarray) -> np.ndarray:
    """p_j - p_i."""
    return -curvature.mean_curvature_normals(p, faces)


@mistake(
    "Your vectors are half as long as asked: you returned H n. The contract asks for 2 H n, 2/r on"
    " a sphere."
)
def h_n(p: np.ndarray, faces: np.ndarray) -> np.ndarray:
    """H n."""
    return curvature.mean_curvature_normals(p, faces) / 2


@mistake(
    "Your vectors are twice too long. The sum over the edges is divided by twice the area: 1 /"
    " (2 A)."
)
def four_h_n(p: np.ndarray, faces: np.ndarray) -> np.ndarray:
    """Divides by the area, not by twice the area."""
    return 2 * curvature.mean_curvature_normals(p, faces)


@mistake(
    "You did not divide by the area: your vectors are the integral of 2 H n over each vertex' area,"
    " and shrink with the triangles."
)
def area_forgotten(p: np.ndarray, faces: np.ndarray) -> np.ndarray:
    """The integral over the vertex' area."""
    return curvature.mean_curvature_normals(p, faces) * mixed_areas(p, faces)[:, None]


@mistake(
    "You divided by a third of the faces around. The contract asks for the mixed area: the Voronoi"
    " part, or a half and two quarters of an obtuse face."
)
def a_third_of_each_face(p: np.ndarray, faces: np.ndarray) -> np.ndarray:
    """Divides by a third of the faces around."""
    return area_forgotten(p, faces) / thirds(p, faces)[:, None]


def cotangent_pull(
    p: np.ndarray, faces: np.ndarray, *, opposite: bool = True, both: bool = True
) -> np.ndarray:
    """Every edge pulls its two ends by a cotangent."""
    total = np.zeros_like(p)
    for k in range(3):
        i, j, o = (faces[:, (k + m) % 3] for m in range(3))
        at, first, second = (o, i, j) if opposite else (i, j, o)
        a, b = p[first] - p[at], p[second] - p[at]
        pull = ((a * b).sum(axis=1) / np.linalg.norm(np.cross(a, b), axis=1))[:, None] * (
            p[i] - p[j]
        )
        np.add.at(total, i, pull)
        if both:
            np.subtract.at(total, j, pull)
    total[on_boundary(faces, len(p))] = np.nan
    return total / (2 * mixed_areas(p, faces)[:, None])


@mistake(
    "You took the cotangent of an angle that the edge belongs to. It is that of the angles opposite"
    " the edge, one in each of its two faces."
)
def angle_beside_the_edge(p: np.ndarray, faces: np.ndarray) -> np.ndarray:
    """The cotangent of an angle at the edge, not opposite it."""
    return cotangent_pull(p, faces, opposite=False)


@mistake(
    "Every edge of yours counts with one of its two faces only. Its weight is cot a + cot b, one"
    " angle from each face."
)
def one_cotangent(p: np.ndarray, faces: np.ndarray) -> np.ndarray:
    """Every edge counts with one of its two faces."""
    return cotangent_pull(p, faces, both=False)


@mistake(
    "You took the vertex less the mean of its neighbours. That mixes bending with how the"
    " neighbours are spread: weigh each by its two cotangents."
)
def mean_of_the_neighbours(p: np.ndarray, faces: np.ndarray) -> np.ndarray:
    """The vertex less the mean of its neighbours, over the area."""
    total = np.zeros_like(p)
    count = np.zeros(len(p))
    for k in range(3):
        np.add.at(total, faces[:, k], p[faces[:, (k + 1) % 3]])
        np.add.at(count, faces[:, k], 1)
    total = p - total / count[:, None]
    total[on_boundary(faces, len(p))] = np.nan
    return total / mixed_areas(p, faces)[:, None]


@mistake(
    "You returned normals of length 1. The length is what is asked for: 2 H, so that a sphere of"
    " radius r has 2/r."
)
def unit_normals(p: np.ndarray, faces: np.ndarray) -> np.ndarray:
    """Unit normals."""
    normals = vertex_normals(p, faces)
    normals[on_boundary(faces, len(p))] = np.nan
    return normals


@mistake(
    "You gave vectors on the border. Half of the neighbours are missing there, and the sum pulls"
    " along the surface: return nan."
)
def a_value_on_the_border(p: np.ndarray, faces: np.ndarray) -> np.ndarray:
    """Does not know of a border."""
    total = np.zeros_like(p)
    for k in range(3):
        i, j, o = (faces[:, (k + m) % 3] for m in range(3))
        a, b = p[i] - p[o], p[j] - p[o]
        pull = ((a * b).sum(axis=1) / np.linalg.norm(np.cross(a, b), axis=1))[:, None] * (
            p[i] - p[j]
        )
        np.add.at(total, i, pull)
        np.subtract.at(total, j, pull)
    return total / (2 * mixed_areas(p, faces)[:, None])


@alternative
def gradient_of_area(p: np.ndarray, faces: np.ndarray) -> np.ndarray:
    """How the area of the faces around grows when the vertex moves, over the area that belongs to
    it.
    """
    total = np.zeros_like(p)
    area = np.zeros(len(p))
    corner = [p[faces[:, k]] for k in range(3)]
    n = np.cross(corner[1] - corner[0], corner[2] - corner[0])
    double = np.linalg.norm(n, axis=1)
    for k in range(3):
        at = corner[k]
        first = corner[(k + 1) % 3]
        second = corner[(k + 2) % 3]
        np.add.at(total, faces[:, k], np.cross(n / double[:, None], second - first) / 2)
        here = ((first - at) * (second - at)).sum(axis=1)
        at_first = ((at - first) * (second - first)).sum(axis=1)
        at_second = ((at - second) * (first - second)).sum(axis=1)
        voronoi = (
            ((first - at) ** 2).sum(axis=1) * at_second
            + ((second - at) ** 2).sum(axis=1) * at_first
        ) / (8 * double)
        obtuse = np.minimum(at_first, at_second) < 0
        np.add.at(
            area, faces[:, k], np.where(here < 0, double / 4, np.where(obtuse, double / 8, voronoi))
        )
    edges = np.sort(np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]), axis=1)
    edges, times = np.unique(edges, axis=0, return_counts=True)
    total[np.unique(edges[times == 1])] = np.nan
    return total / area[:, None]


@alternative
def by_the_laplacian(p: np.ndarray, faces: np.ndarray) -> np.ndarray:
    """The cotangent matrix, dense, applied to the coordinates."""
    weights = np.zeros((len(p), len(p)))
    for a, b, c in faces.tolist():
        for i, j, o in ((a, b, c), (b, c, a), (c, a, b)):
            u, v = p[i] - p[o], p[j] - p[o]
            weights[[i, j], [j, i]] += u @ v / np.linalg.norm(np.cross(u, v)) / 2
    pull = np.diag(weights.sum(axis=1)) @ p - weights @ p
    return np.where(
        border_of(len(p), faces)[:, None], np.nan, pull / mixed_areas(p, faces)[:, None]
    )
