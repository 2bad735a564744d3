"""A mesh pulled to points: gradients by differences through points drawn on it, and what its terms
do.
"""

import numpy as np
import pytest

from tests.algorithms.gradients import assert_gradient, descended
from workbench.algorithms.learning import mesh_fitting
from workbench.algorithms.learning.mesh_fitting import Term, fit_mesh
from workbench.data.shapes.surfaces import sphere
from workbench.geometry.meshes import edges as edges_of
from workbench.geometry.meshes.mesh_energies import (
    edge_energy,
    face_pairs,
    laplacian_energy,
    normal_energy,
    umbrella,
)
from workbench.geometry.points.sampling import places_on_faces, points_on_faces

NOTHING: dict[Term, float] = {"laplacian": 0.0, "normal": 0.0, "edge": 0.0}
BALL = sphere(42)
GIVEN = sphere(162).p * [1.0, 0.7, 0.5]
NONE = np.empty((0, 3))


@pytest.mark.parametrize(
    "weights", [NOTHING, {"laplacian": 2.0, "normal": 0.3, "edge": 0.5}], ids=["data", "all"]
)
def test_gradients_are_those_of_differences_where_points_stay_in_their_faces(monkeypatch, weights):
    """Which face a point is drawn on jumps with the areas; the gradient is that of points that move
    with their corners.
    """
    rng = np.random.default_rng(1)
    training = fit_mesh(
        0.8 * BALL.p, BALL.faces, GIVEN, truth=NONE, weights=weights, counts=(0, 1), rng=rng
    )
    values, gradient = descended(monkeypatch, mesh_fitting, lambda: training)
    places = places_on_faces(values, BALL.faces, np.random.default_rng(2).random((150, 3)))
    monkeypatch.setattr(mesh_fitting, "places_on_faces", lambda *_: places)
    L = umbrella(BALL.faces, 42)
    edges = edges_of(BALL.faces)
    pairs = face_pairs(BALL.faces)

    def with_energies() -> tuple[float, np.ndarray]:
        loss, slope = gradient()
        loss += weights["laplacian"] * laplacian_energy(values, L)[0]
        loss += weights["normal"] * normal_energy(values, BALL.faces, pairs)[0]
        loss += weights["edge"] * edge_energy(values, edges)[0]
        return loss, slope

    assert_gradient(values, with_energies, rng, tolerance=1e-5)


def test_points_lie_where_the_shares_of_the_corners_say():
    u = np.random.default_rng(3).random((200, 3))
    k, shares = places_on_faces(BALL.p, BALL.faces, u)
    np.testing.assert_allclose(shares.sum(axis=1), 1)
    assert shares.min() >= 0
    p = np.einsum("nk,nkx->nx", shares, BALL.p[BALL.faces[k]])
    np.testing.assert_allclose(p, points_on_faces(BALL.p, BALL.faces, u), atol=1e-14)


def test_a_ball_becomes_an_ellipsoid_and_a_laplacian_shrinks_it():
    def end(laplacian: float = 0.0):
        states = list(
            fit_mesh(
                BALL.p,
                BALL.faces,
                GIVEN,
                truth=GIVEN,
                weights={**NOTHING, "laplacian": laplacian},
                counts=(0, 30),
                rng=np.random.default_rng(4),
            )
        )
        np.testing.assert_array_equal(states[0].p, BALL.p)
        assert states[-1].to_given == states[-1].to_truth
        return states[-1]

    free = end()
    smooth = end(laplacian=50.0)
    assert free.to_given < 0.03
    assert np.ptp(smooth.p, axis=0).prod() < 0.8 * np.ptp(free.p, axis=0).prod()


def test_without_a_truth_the_distance_to_it_is_nan():
    first = next(
        fit_mesh(
            BALL.p,
            BALL.faces,
            GIVEN,
            truth=NONE,
            weights=NOTHING,
            counts=(0, 1),
            rng=np.random.default_rng(5),
        )
    )
    assert np.isnan(first.to_truth)
