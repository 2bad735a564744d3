"""What rays see: gradients by differences, laws of light, and media of which the answer is
known.
"""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from workbench.geometry.cameras.volume_rendering import ray_weights, samples_on, seen, through_seen


def medium(seed: int, rays: int = 4, samples: int = 9) -> tuple[np.ndarray, np.ndarray]:
    rng = np.random.default_rng(seed)
    density = rng.exponential(4.0, (rays, samples)) * (rng.random((rays, samples)) < 0.8)
    return density, rng.random((rays, samples, 3))


@pytest.mark.parametrize("behind", [0.0, 0.4, 1.0])
def test_gradients_by_density_and_colour_are_those_of_differences(behind):
    density, color = medium(1)
    slope = np.random.default_rng(2).normal(size=(4, 3))
    by_density, by_color = through_seen(slope, density, color, spacing=0.13, behind=behind)

    def value(density: np.ndarray, color: np.ndarray) -> np.ndarray:
        return (slope * seen(ray_weights(density, 0.13), color, behind)).sum(axis=1)

    for s in range(density.shape[1]):
        step = np.zeros_like(density)
        step[:, s] = 1e-6
        change = value(density + step, color) - value(density - step, color)
        np.testing.assert_allclose(by_density[:, s], change / 2e-6, atol=1e-8)
        for k in range(3):
            step = np.zeros_like(color)
            step[:, s, k] = 1e-6
            change = value(density, color + step) - value(density, color - step)
            np.testing.assert_allclose(by_color[:, s, k], change / 2e-6, atol=1e-8)


@given(st.integers(0, 10_000), st.floats(1e-4, 10.0))
def test_weights_and_what_passes_add_up_to_one(seed, spacing):
    density, _ = medium(seed)
    weights = ray_weights(density, spacing)
    assert np.all(weights >= 0)
    np.testing.assert_allclose(
        weights.sum(axis=1) + np.exp(-spacing * density.sum(axis=1)), 1, atol=1e-12
    )


def test_a_sample_cut_in_two_sees_the_same():
    density, color = medium(3)
    whole = seen(ray_weights(density, 0.2), color)
    parts = seen(ray_weights(np.repeat(density, 2, axis=1), 0.1), np.repeat(color, 2, axis=1))
    np.testing.assert_allclose(parts, whole, atol=1e-12)


def test_a_wall_hides_what_stands_behind_it_and_nothing_is_seen_of_nothing():
    density = np.array([[0.0, 1e6, 3.0, 3.0], [0, 0, 0, 0]])
    np.testing.assert_allclose(ray_weights(density, 0.1), [[0, 1, 0, 0], [0, 0, 0, 0]], atol=1e-12)
    color = np.broadcast_to([0.2, 0.5, 0.7], (2, 4, 3))
    np.testing.assert_allclose(
        seen(ray_weights(density, 0.1), color, 0.9), [[0.2, 0.5, 0.7], [0.9] * 3], atol=1e-12
    )


def test_weights_of_thin_fog_keep_their_digits():
    weights = ray_weights(np.full((1, 5), 1e-12), 0.5)
    np.testing.assert_allclose(weights, 5e-13, rtol=1e-9)


def test_samples_lie_in_equal_parts_of_the_way():
    p, d = np.array([[1.0, 2.0], [0, 0]]), np.array([[0.6, 0.8], [0, 1]])
    q, spacing = samples_on(p, d, (1.0, 3.0), count=4)
    assert spacing == 0.5
    np.testing.assert_allclose(
        np.linalg.norm(q - p[:, None], axis=2), np.tile([1.25, 1.75, 2.25, 2.75], (2, 1))
    )
    shifted, _ = samples_on(
        p, d, (1.0, 3.0), count=4, shift=np.random.default_rng(0).random((2, 4))
    )
    t = np.linalg.norm(shifted - p[:, None], axis=2)
    assert np.all(np.floor((t - 1) / spacing) == np.arange(4))
