"""A field on a grid: gradients by differences through rays and nodes, and what photographs tell."""

import numpy as np
import pytest

from tests.algorithms.gradients import assert_gradient, descended
from workbench.algorithms.learning import radiance_field
from workbench.algorithms.learning.radiance_field import CELLS, RadianceField, reconstruct
from workbench.geometry.cameras.volume_rendering import seen

REACH = (0.5, 3.5)


def rays(count: int, seed: int = 0) -> tuple[np.ndarray, np.ndarray]:
    """Rays from 2 m away to all parts of the grid, and past it."""
    rng = np.random.default_rng(seed)
    a = rng.uniform(0, 2 * np.pi, count)
    p = 2 * np.column_stack([np.cos(a), np.sin(a)])
    d = rng.uniform(-1.2, 1.2, (count, 2)) - p
    return p, d / np.linalg.norm(d, axis=1, keepdims=True)


def test_gradients_are_those_of_differences(monkeypatch):
    p, d = rays(60)
    rng = np.random.default_rng(1)
    colors = rng.random((60, 3))
    training = reconstruct(p, d, colors, reach=REACH, counts=(0, 1), rng=rng)
    values, gradient = descended(monkeypatch, radiance_field, lambda: training)
    values[:] = rng.normal(size=values.shape) - [1.5, 0, 0, 0]
    assert_gradient(values, gradient, rng, h=1e-5)


def test_a_field_is_linear_between_nodes_and_empty_beyond_the_grid():
    raw = np.random.default_rng(2).normal(size=(CELLS * CELLS, 4))
    field = RadianceField(raw=raw, reach=REACH)
    nodes = np.linspace(-1, 1, CELLS)
    grid = np.stack(np.meshgrid(nodes, nodes, indexing="ij"), axis=-1)
    density, color = field.at(grid)
    np.testing.assert_allclose(density, field.density, rtol=1e-4)
    np.testing.assert_allclose(color, field.color, rtol=1e-4)
    middle = grid[3, 4] + (nodes[1] - nodes[0]) * np.array([0.5, 0.0])
    mixed = (raw.reshape(CELLS, CELLS, 4)[3, 4] + raw.reshape(CELLS, CELLS, 4)[4, 4]) / 2
    assert field.at(middle[None, None])[0].item() == pytest.approx(10 * np.log1p(np.exp(mixed[0])))
    assert field.at(np.array([[[1.01, 0.0], [0, -2]]]))[0].max() < 0.05


def test_what_rays_see_is_their_weights_times_the_colours():
    field = RadianceField(raw=np.random.default_rng(3).normal(size=(CELLS * CELLS, 4)), reach=REACH)
    weights, colors = field.along(*rays(9))
    assert weights.shape == (9, radiance_field.SAMPLES)
    assert np.all(weights.sum(axis=1) <= 1 + 1e-12)
    assert seen(weights, np.ones((9, radiance_field.SAMPLES, 3))) == pytest.approx(1)
    assert np.all((colors >= 0) & (colors <= 1))


def test_a_black_disc_is_found_from_its_photographs():
    p, d = rays(1500, 4)
    across = p[:, 0] * d[:, 1] - p[:, 1] * d[:, 0]
    colors = np.where(np.abs(across) < 0.4, 0.0, 1.0)[:, None] * np.ones(3)
    *_, last = reconstruct(p, d, colors, reach=REACH, counts=(0, 40), rng=np.random.default_rng(5))
    inside, outside = (
        last.field.at(q[None])[0]
        for q in (np.array([[0.3, 0], [0, -0.3]]), np.array([[0.7, 0], [0, 0.7]]))
    )
    assert inside.min() > 3 * outside.max()
    assert last.loss < 0.05
