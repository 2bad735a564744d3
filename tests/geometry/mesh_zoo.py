"""Small meshes for tests."""

import numpy as np
import scipy

TETRAHEDRON = (
    np.array([[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]], dtype=float),
    np.array([[0, 1, 2], [0, 2, 3], [0, 3, 1], [1, 3, 2]]),
)

CUBE = (
    np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], dtype=float),
    np.array(
        [
            *([0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1]),
            *([2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4], [1, 5, 7], [1, 7, 3]),
        ]
    ),
)


def random_closed(rng, count, spread=0.5):
    """A closed mesh: the hull of random directions, each pulled to its own radius."""
    directions = rng.standard_normal((count, 3))
    directions /= np.linalg.norm(directions, axis=1, keepdims=True)
    hull = scipy.spatial.ConvexHull(directions)
    faces = hull.simplices.astype(np.int64)
    a, b, c = directions[faces].swapaxes(0, 1)
    inward = np.einsum("fx,fx->f", np.cross(b - a, c - a), hull.equations[:, :3]) < 0
    faces[inward] = faces[inward][:, ::-1]
    return directions * rng.uniform(1 - spread, 1 + spread, (count, 1)), faces


def strip(length):
    """A flat row of squares, each cut in two: every vertex is on the border."""
    p = np.array([[x, y, 0] for x in range(length + 1) for y in (0, 1)], dtype=float)
    a = 2 * np.arange(length)
    return p, np.concatenate([np.stack([a, a + 2, a + 3], 1), np.stack([a, a + 3, a + 1], 1)])
