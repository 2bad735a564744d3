"""A cell whose middle is on the surface is not inside."""

import numpy as np

from workbench.algorithms.spatial.octree import grow_octree


def test_the_surface_itself_is_outside():
    ball = lambda q: np.linalg.norm(q, axis=1) - np.sqrt(3) / 2  # noqa: E731
    plane = lambda q: q[:, 2] + 0.5  # noqa: E731
    levels = list(grow_octree(plane, np.full(3, -1.0), 2.0, depth=1))
    assert not levels[1].bits.any()  # the middles of the lower cells are at z = -0.5
    assert [level.bits.sum() for level in grow_octree(ball, np.full(3, -1.0), 2.0, depth=0)] == [1]
