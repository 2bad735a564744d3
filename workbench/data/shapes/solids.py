"""Small solids whose left and right, front and back differ. Metres, +Z up, foot at z = 0."""

from dataclasses import dataclass
from typing import Literal

import numpy as np
from jaxtyping import Float, Int

from workbench.geometry.meshes import face_normals
from workbench.geometry.polylines import segments

Shape = Literal["house", "L block", "box"]


@dataclass(frozen=True, eq=False)
class Solid:
    """A triangle mesh, counter-clockwise seen from outside, and the lines drawn on it."""

    p: Float[np.ndarray, "v 3"]
    faces: Int[np.ndarray, "f 3"]
    lines: Float[np.ndarray, "s 2 3"]


def outlined(
    p: Float[np.ndarray, "v 3"], faces: Int[np.ndarray, "f 3"], angle: float = 0.02
) -> Solid:
    """Return a mesh together with its sharp edges as lines."""
    return Solid(p, faces, p[sharp_edges(p, faces, angle)])


def solid(shape: Shape) -> Solid:
    """Return a solid by name."""
    return {"house": house, "L block": l_block, "box": box}[shape]()


def box(size: tuple[float, float, float] = (1.0, 0.7, 0.6)) -> Solid:
    """Return a box that stands on the origin; a mirror image of it is the same box."""
    x, y, z = size
    foot = np.array([[-x / 2, -y / 2], [x / 2, -y / 2], [x / 2, y / 2], [-x / 2, y / 2]])
    p = np.vstack([np.c_[foot, np.zeros(4)], np.c_[foot, np.full(4, z)]])
    return _of_polygons(
        p, ((3, 2, 1, 0), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7))
    )


def house() -> Solid:
    """Return a house with a door, ridge off the middle: no mirror and no turn keeps it."""
    p = np.vstack([box().p, [[0.15, -0.35, 1.0], [0.15, 0.1, 1.0]]])
    foot = (3, 2, 1, 0)
    sides = ((0, 1, 5, 8, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7))
    body = _of_polygons(p, (foot, *sides, (5, 6, 9, 8), (4, 8, 9, 7), (6, 7, 9)))
    x = [-0.35, -0.35, -0.1, -0.1]
    z = [0.0, 0.4, 0.4, 0.0]
    door = np.stack([x, np.full(4, -0.352), z], axis=1)  # just in front of the wall
    return Solid(body.p, body.faces, np.concatenate([body.lines, segments(door)]))


def l_block() -> Solid:
    """Return an L-shaped block; its mirror image is the same block turned over."""
    corners = np.array(
        [[-0.5, -0.35], [0.5, -0.35], [0.5, 0.0], [-0.1, 0.0], [-0.1, 0.35], [-0.5, 0.35]]
    )
    p = np.vstack([np.c_[corners, np.zeros(6)], np.c_[corners, np.full(6, 0.5)]])
    sides = tuple((i, (i + 1) % 6, (i + 1) % 6 + 6, i + 6) for i in range(6))
    return _of_polygons(p, ((3, 2, 1, 0), (5, 4, 3, 0), (6, 7, 8, 9), (6, 9, 10, 11), *sides))


def sharp_edges(
    p: Float[np.ndarray, "v 3"], faces: Int[np.ndarray, "f 3"], angle: float = 0.02
) -> Int[np.ndarray, "e 2"]:
    """Return the edges where faces meet at more than `angle`, radians, or that one face has."""
    ends = np.sort(faces[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
    edge, inverse = np.unique(ends, axis=0, return_inverse=True)
    total = np.zeros((len(edge), 3))
    np.add.at(total, inverse.ravel(), np.repeat(face_normals(p, faces), 3, axis=0))
    # Two unit normals at the angle a add up to a vector of length 2 cos(a / 2), a single one to
    # length 1.
    return edge[np.linalg.norm(total, axis=1) < 2.0 * np.cos(0.5 * angle)]


def _of_polygons(p: np.ndarray, polygons: tuple[tuple[int, ...], ...]) -> Solid:
    """Return a solid of convex polygons, each cut into a fan."""
    faces = np.array([(q[0], q[i], q[i + 1]) for q in polygons for i in range(1, len(q) - 1)])
    return outlined(p, faces)
