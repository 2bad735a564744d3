"""Wrong answers that students give to the exercises of this lesson, and right ones that are written differently."""

import numpy as np

from workbench.exercise.model import Mistake
from workbench.geometry import curvature
from workbench.geometry.laplacian import mixed_areas
from workbench.geometry.meshes import face_angles, face_areas, on_boundary, vertex_normals

# angle_defects --------------------------------------------------------------------------------------------------------


def full_turn_everywhere(p: np.ndarray, faces: np.ndarray) -> np.ndarray:
    """2 pi, also on the border."""
    return 2 * np.pi - angle_sums(p, faces)


def curvature_returned(p: np.ndarray, faces: np.ndarray) -> np.ndarray:
    """Divides by the area."""
    return curvature.angle_defects(p, faces) / mixed_areas(p, faces)


def angle_sums(p: np.ndarray, faces: np.ndarray) -> np.ndarray:
    """The angles, not what they miss."""
    return np.bincount(faces.ravel(), face_angles(p, faces).ravel(), len(p))


def excess_returned(p: np.ndarray, faces: np.ndarray) -> np.ndarray:
    """The angles less a full turn."""
    return -curvature.angle_defects(p, faces)


def defects_in_degrees(p: np.ndarray, faces: np.ndarray) -> np.ndarray:
    """Converts what should stay in radians."""
    return np.degrees(curvature.angle_defects(p, faces))


def repeats_lost(p: np.ndarray, faces: np.ndarray) -> np.ndarray:
    """`total[faces[:, k]] += ...`: of the faces around a vertex only one counts, the last."""
    total, angles = np.zeros(len(p)), face_angles(p, faces)
    for k in range(3):
        total[faces[:, k]] += angles[:, k]
    return np.where(on_boundary(faces, len(p)), np.pi, 2 * np.pi) - total


def first_corner_only(p: np.ndarray, faces: np.ndarray) -> np.ndarray:
    """Every face gives its angle to its first vertex only."""
    total = np.bincount(faces[:, 0], face_angles(p, faces)[:, 0], len(p))
    return np.where(on_boundary(faces, len(p)), np.pi, 2 * np.pi) - total


def cosine_beyond_one(p: np.ndarray, faces: np.ndarray) -> np.ndarray:
    """Takes arccos of what rounding has made a little larger than 1."""
    total = np.zeros(len(p))
    for k in range(3):
        a, b = p[faces[:, (k + 1) % 3]] - p[faces[:, k]], p[faces[:, (k + 2) % 3]] - p[faces[:, k]]
        cosine = (a * b).sum(axis=1) / (np.linalg.norm(a, axis=1) * np.linalg.norm(b, axis=1))
        np.add.at(total, faces[:, k], np.arccos(cosine))
    return np.where(on_boundary(faces, len(p)), np.pi, 2 * np.pi) - total


DEFECT_MISTAKES = (
    Mistake(
        "2 pi on the border",
        full_turn_everywhere,
        "You take the angles from 2 pi everywhere. On the border of a flat sheet they make half a turn: there the defect "
        "is pi less their sum.",
    ),
    Mistake(
        "curvature returned",
        curvature_returned,
        "You divided by the area. That is Gaussian curvature, 1/m²; the defect itself is an angle, in radians: curvature "
        "times area.",
    ),
    Mistake(
        "sum of the angles",
        angle_sums,
        "You returned the sum of the angles around each vertex. The defect is what that sum misses: 2 pi less the sum.",
    ),
    Mistake(
        "sign",
        excess_returned,
        "Your defects have the wrong sign. At the tip of a cone the angles make less than a full turn, and the defect is "
        "positive: 2 pi less the sum.",
    ),
    Mistake("degrees", defects_in_degrees, "You returned degrees; the contract asks for radians."),
    Mistake(
        "repeated indices",
        repeats_lost,
        "`total[faces[:, k]] += angle` counts an index that occurs several times once only. Use np.add.at or np.bincount.",
    ),
    Mistake(
        "first corner only",
        first_corner_only,
        "Every face gives its angle to its first vertex only. It has three corners, and each belongs to another vertex.",
    ),
    Mistake(
        "cosine beyond 1",
        cosine_beyond_one,
        "All is right but faces without area: rounding makes their cosines a little larger than 1, and arccos gives nan. "
        "Clip them to [-1, 1], or take arctan2(|a x b|, a . b).",
    ),
)


def defects_by_cosines(p: np.ndarray, faces: np.ndarray) -> np.ndarray:
    """The arccos of clipped cosines; the border from the edges that only one face has."""
    total = np.zeros(len(p))
    for k in range(3):
        a, b = p[faces[:, (k + 1) % 3]] - p[faces[:, k]], p[faces[:, (k + 2) % 3]] - p[faces[:, k]]
        cosine = (a * b).sum(axis=1) / np.sqrt((a * a).sum(axis=1) * (b * b).sum(axis=1))
        np.add.at(total, faces[:, k], np.arccos(np.clip(cosine, -1, 1)))
    return np.where(border_of(len(p), faces), np.pi, 2 * np.pi) - total


def border_of(count: int, faces: np.ndarray) -> np.ndarray:
    """Which vertices have an edge with one face only."""
    half = np.sort(np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]), axis=1)
    edges, times = np.unique(half, axis=0, return_counts=True)
    return np.isin(np.arange(count), edges[times == 1])


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


# gaussian_curvature ---------------------------------------------------------------------------------------------------


def defect_not_divided(p: np.ndarray, faces: np.ndarray) -> np.ndarray:
    """The angle defect."""
    return np.where(on_boundary(faces, len(p)), np.nan, curvature.angle_defects(p, faces))


def thirds(p: np.ndarray, faces: np.ndarray) -> np.ndarray:
    """A third of every face."""
    return np.bincount(faces.ravel(), np.repeat(face_areas(p, faces) / 3, 3), len(p))


def divided_by_thirds(p: np.ndarray, faces: np.ndarray) -> np.ndarray:
    """The defect over a third of the faces around."""
    return defect_not_divided(p, faces) / thirds(p, faces)


def divided_by_whole_faces(p: np.ndarray, faces: np.ndarray) -> np.ndarray:
    """The defect over the whole ring: every face counts three times."""
    return defect_not_divided(p, faces) / (3 * thirds(p, faces))


def divided_by_voronoi(p: np.ndarray, faces: np.ndarray) -> np.ndarray:
    """The Voronoi formula also where a face is obtuse."""
    area = np.zeros(len(p))
    for k in range(3):
        i, j, o = faces[:, k], faces[:, (k + 1) % 3], faces[:, (k + 2) % 3]
        a, b = p[i] - p[o], p[j] - p[o]
        cotangent = (a * b).sum(axis=1) / np.linalg.norm(np.cross(a, b), axis=1)
        part = cotangent * ((p[i] - p[j]) ** 2).sum(axis=1) / 8
        np.add.at(area, i, part)
        np.add.at(area, j, part)
    return defect_not_divided(p, faces) / area


def value_on_the_border(p: np.ndarray, faces: np.ndarray) -> np.ndarray:
    """Divides the turning of the border by an area."""
    return curvature.angle_defects(p, faces) / mixed_areas(p, faces)


def half_turn_missed_on_the_border(p: np.ndarray, faces: np.ndarray) -> np.ndarray:
    """Does not know of a border."""
    return (2 * np.pi - angle_sums(p, faces)) / mixed_areas(p, faces)


def mean_for_gaussian(p: np.ndarray, faces: np.ndarray) -> np.ndarray:
    """H."""
    return curvature.mean_curvature(p, faces)


def mean_squared(p: np.ndarray, faces: np.ndarray) -> np.ndarray:
    """H squared, which is K on a sphere only."""
    return curvature.mean_curvature(p, faces) ** 2


GAUSSIAN_MISTAKES = (
    Mistake(
        "defect not divided",
        defect_not_divided,
        "You returned the angle defect. It is curvature times area: divide it by the area that belongs to the vertex.",
    ),
    Mistake(
        "a third of each face",
        divided_by_thirds,
        "You divided by a third of the faces around. That is near the mixed area where triangles are alike; the contract "
        "asks for the Voronoi part, or a half and two quarters of an obtuse face.",
    ),
    Mistake(
        "whole faces",
        divided_by_whole_faces,
        "You divided by the whole area of the faces around. Each face is shared by three vertices; yours counts it three "
        "times.",
    ),
    Mistake(
        "Voronoi in obtuse faces",
        divided_by_voronoi,
        "You took the Voronoi part of every face. In an obtuse face it reaches outside: half of such a face goes to its "
        "obtuse corner, a quarter to each of the others.",
    ),
    Mistake(
        "a value on the border",
        value_on_the_border,
        "You gave K on the border. There pi less the angles is how the border itself turns, no curvature of the surface: "
        "return nan.",
    ),
    Mistake(
        "no border",
        half_turn_missed_on_the_border,
        "You treat the border as if it were inside, so that a flat sheet seems to bend there. K is not defined on it: "
        "return nan.",
    ),
    Mistake(
        "mean curvature",
        mean_for_gaussian,
        "You returned the mean curvature H, 1/m. Gaussian curvature K is the product of the two principal curvatures, "
        "1/m²: on a cylinder it is 0.",
    ),
    Mistake(
        "mean curvature squared",
        mean_squared,
        "You returned H². That is K on a sphere only; a cylinder has K = 0, and a saddle K < 0.",
    ),
)


def gaussian_by_corners(p: np.ndarray, faces: np.ndarray) -> np.ndarray:
    """Angles, areas and shares corner by corner."""
    a, b, c = (p[faces[:, k]] for k in range(3))
    double = np.linalg.norm(np.cross(b - a, c - a), axis=1)
    defect, area = np.full(len(p), 2 * np.pi), np.zeros(len(p))
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
    return np.where(border_of(len(p), faces), np.nan, defect / area)


def gaussian_by_circumcentres(p: np.ndarray, faces: np.ndarray) -> np.ndarray:
    """Face by face, the Voronoi part as two triangles with the circumcentre."""
    defect, area = np.full(len(p), 2 * np.pi), np.zeros(len(p))
    for face in faces:
        a, b, c = p[face]
        n = np.cross(b - a, c - a)
        whole = np.linalg.norm(n) / 2
        ends = [(b - a, c - a), (c - b, a - b), (a - c, b - c)]
        angles = [np.arctan2(2 * whole, x @ y) for x, y in ends]
        np.subtract.at(defect, face, angles)
        if max(angles) > np.pi / 2:
            np.add.at(area, face, [whole / 2 if angle > np.pi / 2 else whole / 4 for angle in angles])
            continue
        u, v = b - a, c - a
        centre = a + ((u @ u) * np.cross(v, n) + (v @ v) * np.cross(n, u)) / (2 * n @ n)
        for i, corner, (x, y) in zip(face, (a, b, c), ends, strict=True):
            out = centre - corner
            area[i] += (np.linalg.norm(np.cross(x, out)) + np.linalg.norm(np.cross(out, y))) / 4
    return np.where(border_of(len(p), faces), np.nan, defect / area)


# mean_curvature_normals -----------------------------------------------------------------------------------------------


def inward(p: np.ndarray, faces: np.ndarray) -> np.ndarray:
    """p_j - p_i."""
    return -curvature.mean_curvature_normals(p, faces)


def halved(p: np.ndarray, faces: np.ndarray) -> np.ndarray:
    """H n."""
    return curvature.mean_curvature_normals(p, faces) / 2


def doubled(p: np.ndarray, faces: np.ndarray) -> np.ndarray:
    """Divides by the area, not by twice the area."""
    return 2 * curvature.mean_curvature_normals(p, faces)


def area_forgotten(p: np.ndarray, faces: np.ndarray) -> np.ndarray:
    """The integral over the vertex' area."""
    return curvature.mean_curvature_normals(p, faces) * mixed_areas(p, faces)[:, None]


def pulled_by_thirds(p: np.ndarray, faces: np.ndarray) -> np.ndarray:
    """Divides by a third of the faces around."""
    return area_forgotten(p, faces) / thirds(p, faces)[:, None]


def cotangent_pull(p: np.ndarray, faces: np.ndarray, *, opposite: bool = True, both: bool = True) -> np.ndarray:
    """Every edge pulls its two ends by a cotangent."""
    total = np.zeros_like(p)
    for k in range(3):
        i, j, o = (faces[:, (k + m) % 3] for m in range(3))
        at, one, two = (o, i, j) if opposite else (i, j, o)
        a, b = p[one] - p[at], p[two] - p[at]
        pull = ((a * b).sum(axis=1) / np.linalg.norm(np.cross(a, b), axis=1))[:, None] * (p[i] - p[j])
        np.add.at(total, i, pull)
        if both:
            np.subtract.at(total, j, pull)
    total[on_boundary(faces, len(p))] = np.nan
    return total / (2 * mixed_areas(p, faces)[:, None])


def angle_beside_the_edge(p: np.ndarray, faces: np.ndarray) -> np.ndarray:
    """The cotangent of an angle at the edge, not opposite it."""
    return cotangent_pull(p, faces, opposite=False)


def one_cotangent(p: np.ndarray, faces: np.ndarray) -> np.ndarray:
    """Every edge counts with one of its two faces."""
    return cotangent_pull(p, faces, both=False)


def neighbours_averaged(p: np.ndarray, faces: np.ndarray) -> np.ndarray:
    """The vertex less the mean of its neighbours, over the area."""
    total, count = np.zeros_like(p), np.zeros(len(p))
    for k in range(3):
        np.add.at(total, faces[:, k], p[faces[:, (k + 1) % 3]])
        np.add.at(count, faces[:, k], 1)
    total = p - total / count[:, None]
    total[on_boundary(faces, len(p))] = np.nan
    return total / mixed_areas(p, faces)[:, None]


def normals_returned(p: np.ndarray, faces: np.ndarray) -> np.ndarray:
    """Unit normals."""
    normals = vertex_normals(p, faces)
    normals[on_boundary(faces, len(p))] = np.nan
    return normals


def pulled_on_the_border(p: np.ndarray, faces: np.ndarray) -> np.ndarray:
    """Does not know of a border."""
    total = np.zeros_like(p)
    for k in range(3):
        i, j, o = (faces[:, (k + m) % 3] for m in range(3))
        a, b = p[i] - p[o], p[j] - p[o]
        pull = ((a * b).sum(axis=1) / np.linalg.norm(np.cross(a, b), axis=1))[:, None] * (p[i] - p[j])
        np.add.at(total, i, pull)
        np.subtract.at(total, j, pull)
    return total / (2 * mixed_areas(p, faces)[:, None])


NORMAL_MISTAKES = (
    Mistake(
        "inward",
        inward,
        "Your vectors have the right length and point the wrong way: on a sphere 2 H n points outward. Take p_i - p_j, from "
        "the neighbour to the vertex.",
    ),
    Mistake(
        "H n",
        halved,
        "Your vectors are half as long as asked: you returned H n. The contract asks for 2 H n, 2/r on a sphere.",
    ),
    Mistake(
        "4 H n",
        doubled,
        "Your vectors are twice too long. The sum over the edges is divided by twice the area: 1 / (2 A).",
    ),
    Mistake(
        "area forgotten",
        area_forgotten,
        "You did not divide by the area: your vectors are the integral of 2 H n over each vertex' area, and shrink with the "
        "triangles.",
    ),
    Mistake(
        "a third of each face",
        pulled_by_thirds,
        "You divided by a third of the faces around. The contract asks for the mixed area: the Voronoi part, or a half and "
        "two quarters of an obtuse face.",
    ),
    Mistake(
        "angle beside the edge",
        angle_beside_the_edge,
        "You took the cotangent of an angle that the edge belongs to. It is that of the angles opposite the edge, one in "
        "each of its two faces.",
    ),
    Mistake(
        "one cotangent",
        one_cotangent,
        "Every edge of yours counts with one of its two faces only. Its weight is cot a + cot b, one angle from each face.",
    ),
    Mistake(
        "mean of the neighbours",
        neighbours_averaged,
        "You took the vertex less the mean of its neighbours. That mixes bending with how the neighbours are spread: weigh "
        "each by its two cotangents.",
    ),
    Mistake(
        "unit normals",
        normals_returned,
        "You returned normals of length 1. The length is what is asked for: 2 H, so that a sphere of radius r has 2/r.",
    ),
    Mistake(
        "a value on the border",
        pulled_on_the_border,
        "You gave vectors on the border. Half of the neighbours are missing there, and the sum pulls along the surface: "
        "return nan.",
    ),
)


def gradient_of_area(p: np.ndarray, faces: np.ndarray) -> np.ndarray:
    """How the area of the faces around grows when the vertex moves, over the area that belongs to it."""
    total, area = np.zeros_like(p), np.zeros(len(p))
    corner = [p[faces[:, k]] for k in range(3)]
    n = np.cross(corner[1] - corner[0], corner[2] - corner[0])
    double = np.linalg.norm(n, axis=1)
    for k in range(3):
        at, one, two = corner[k], corner[(k + 1) % 3], corner[(k + 2) % 3]
        np.add.at(total, faces[:, k], np.cross(n / double[:, None], two - one) / 2)
        here = ((one - at) * (two - at)).sum(axis=1)
        there = ((at - one) * (two - one)).sum(axis=1)
        far = ((at - two) * (one - two)).sum(axis=1)
        voronoi = (((one - at) ** 2).sum(axis=1) * far + ((two - at) ** 2).sum(axis=1) * there) / (8 * double)
        obtuse = np.minimum(there, far) < 0
        np.add.at(area, faces[:, k], np.where(here < 0, double / 4, np.where(obtuse, double / 8, voronoi)))
    total[border_of(len(p), faces)] = np.nan
    return total / area[:, None]


def by_the_laplacian(p: np.ndarray, faces: np.ndarray) -> np.ndarray:
    """The cotangent matrix, dense, applied to the coordinates."""
    weights = np.zeros((len(p), len(p)))
    for a, b, c in faces.tolist():
        for i, j, o in ((a, b, c), (b, c, a), (c, a, b)):
            u, v = p[i] - p[o], p[j] - p[o]
            weights[[i, j], [j, i]] += u @ v / np.linalg.norm(np.cross(u, v)) / 2
    pull = np.diag(weights.sum(axis=1)) @ p - weights @ p
    return np.where(border_of(len(p), faces)[:, None], np.nan, pull / mixed_areas(p, faces)[:, None])
