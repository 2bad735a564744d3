"""The stored outline is the rim of the rabbit seen from the side."""

import numpy as np

from workbench.data.rabbit_outline import along, normals_along, rabbit_outline
from workbench.data.shapes.rabbit import rabbit_field


def test_every_point_of_it_is_the_rim_of_the_rabbit_along_y():
    y = np.linspace(-0.35, 0.35, 701)
    for x, z in rabbit_outline():
        field = rabbit_field(np.column_stack([np.full_like(y, x), y, np.full_like(y, z)]))[0]
        assert abs(field.min()) < 1e-3


def test_it_runs_counterclockwise_and_evenly():
    p = rabbit_outline()
    q = np.roll(p, -1, axis=0)
    assert np.sum(p[:, 0] * q[:, 1] - p[:, 1] * q[:, 0]) > 0
    gaps = np.linalg.norm(q - p, axis=1)
    assert gaps.max() < 0.025  # even along the rim, so shorter only across the tips of the ears
    assert np.percentile(gaps, 10) > 0.022


def test_along_keeps_to_the_line_and_starts_where_it_is_told():
    square = np.array([[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]])
    assert along(square, 16, 0.5)[:2].tolist() == [[0.5, 0.0], [1.5, 0.0]]
    assert len(along(square, 7)) == 7


def test_normals_point_outwards():
    p = along(rabbit_outline(), 60)
    n = normals_along(p)
    assert np.allclose(np.linalg.norm(n, axis=1), 1.0)
    assert np.mean(np.einsum("ij,ij->i", n, p - p.mean(axis=0)) > 0) > 0.7
