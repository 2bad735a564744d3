"""Distances by heat: great circles, a plane, invariance, and in how far it is no metric."""

import numpy as np
import pytest

from workbench.algorithms.surfaces.heat_method import HeatMethod, heat_method, mean_edge_length
from workbench.data.shapes import surfaces
from workbench.geometry.meshes import corners
from workbench.geometry.meshes.laplacian import mixed_areas


def last(p, faces, source=0, *, times=1.0):
    *_, state = heat_method(corners(p, faces), source, times * mean_edge_length(p, faces) ** 2)
    return state


def off_great_circles(count):
    ball = surfaces.sphere(count)
    true = np.arccos(np.clip(ball.p @ ball.p[0], -1, 1))
    d = last(ball.p, ball.faces).d
    return (d / np.where(true > 0, true, 1) - 1)[true > 0.3]


def test_on_a_sphere_it_converges():
    mean = [100 * off_great_circles(count).mean() for count in (162, 642, 2562)]
    np.testing.assert_allclose(mean[1:], [-1.65, -0.92], atol=0.03)
    assert abs(mean[0]) > abs(mean[1]) > abs(mean[2])


def test_on_a_flat_sheet_it_is_straight_away_from_the_border():
    flat = surfaces.plane(900)
    source = int(np.argmin(np.linalg.norm(flat.p, axis=1)))
    true = np.linalg.norm(flat.p - flat.p[source], axis=1)
    d = last(flat.p, flat.faces, source).d
    inside = (true > 0.2) & (true < 0.8)
    assert np.abs(d[inside] / true[inside] - 1).mean() < 0.03


def test_directions_have_length_one_and_lead_away():
    ball = surfaces.sphere(642)
    states = list(heat_method(corners(ball.p, ball.faces), 0, 0.02))
    assert [state.phase for state in states] == ["flow", "directions", "distances"]
    X = states[1].X
    np.testing.assert_allclose(np.linalg.norm(X, axis=1), 1)
    middle = ball.p[ball.faces].mean(axis=1)
    away = middle * (middle @ ball.p[0])[:, None] - ball.p[0]
    far = np.linalg.norm(middle - ball.p[0], axis=1) > 0.3
    assert ((X * away).sum(axis=1)[far] > 0).mean() > 0.98
    assert states[-1].d[0] == 0
    assert (states[0].u > 0).all()


def test_it_moves_with_the_mesh_and_grows_with_it():
    rng = np.random.default_rng(0)
    ring = surfaces.torus(500, jitter=0.2, rng=rng)
    d = last(ring.p, ring.faces, 7).d
    Q, _ = np.linalg.qr(rng.normal(size=(3, 3)))
    faces = ring.faces if np.linalg.det(Q) > 0 else ring.faces[:, ::-1]
    np.testing.assert_allclose(last(3 * ring.p @ Q.T + 5, faces, 7).d, 3 * d, atol=1e-6)


def test_heat_adds_up_to_what_was_put_in():
    ball = surfaces.sphere(162)
    method = HeatMethod(corners(ball.p, ball.faces), 0.05)
    u = method.heat(np.array([0, 5]))
    np.testing.assert_allclose(mixed_areas(ball.p, ball.faces) @ u, 1)
    np.testing.assert_allclose(u[5, 0], u[0, 1])  # A + t L is symmetric


def test_it_is_nearly_a_metric():
    ball = surfaces.sphere(642, jitter=0.2, rng=np.random.default_rng(1))
    D = HeatMethod(corners(ball.p, ball.faces), mean_edge_length(ball.p, ball.faces) ** 2).between(
        np.arange(0, 640, 40)
    )
    assert (np.diag(D) == 0).all()
    uneven = np.abs(D - D.T)[np.triu_indices(16, 1)]
    assert 0 < uneven.max() < 0.1
    broken = (D[:, None, :] - D[:, :, None] - D[None] > 1e-6).mean()
    assert 0 < broken < 0.08


@pytest.mark.parametrize(("times", "low", "high"), [(0.01, -0.08, -0.01), (1.0, -0.03, 0.01)])
def test_too_short_a_time_comes_out_too_short(times, low, high):
    ball = surfaces.sphere(642)
    true = np.arccos(np.clip(ball.p @ ball.p[0], -1, 1))
    error = (last(ball.p, ball.faces, 0, times=times).d / np.where(true > 0, true, 1) - 1)[
        true > 0.3
    ]
    assert low < error.mean() < high
