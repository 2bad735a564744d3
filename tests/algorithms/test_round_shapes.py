"""Circles, spheres and cylinders are found where scipy finds them, and exactly where the points are
exact.
"""

import numpy as np
import pytest

from lessons.fitting.fit_scenes import arc_points, cap_points, pipe_points
from lessons.fitting.round_shapes import (
    CIRCLE,
    CYLINDER,
    ROUND_SHAPES,
    SPHERE,
    feet,
    fit_round,
    outline,
)
from tests.truths.fitting import distances

STARTS = {
    "circle": np.array([0.2, 0.1, 0.8]),
    "sphere": np.array([0.2, 0.1, -0.1, 0.8]),
    "cylinder": np.array([0.2, 0.1, 0.0, 0.3, 0.0, np.sqrt(0.91), 0.8]),
}
PLACES = {"circle": arc_points, "sphere": cap_points, "cylinder": pipe_points}


@pytest.mark.parametrize("shape", ROUND_SHAPES.values(), ids=ROUND_SHAPES)
def test_exact_points_give_the_unit_shape(shape):
    p = PLACES[shape.name](np.radians(200), 80)
    fitted = fit_round(shape, p[None], STARTS[shape.name][None], tolerance=1e-14)[0]
    np.testing.assert_allclose(distances(shape.name, fitted, p), 0, atol=1e-6)
    assert fitted[-1] == pytest.approx(1.0, abs=1e-6)
    assert len(shape.names) == shape.linearise(fitted, p)[1].shape[1]


@pytest.mark.parametrize("shape", ROUND_SHAPES.values(), ids=ROUND_SHAPES)
def test_feet_and_outlines_lie_on_the_shape(shape):
    unknown = STARTS[shape.name]
    p = np.random.default_rng(0).normal(size=(40, 2 if shape is CIRCLE else 3))
    p_feet = feet(shape, unknown, p)
    np.testing.assert_allclose(distances(shape.name, unknown, p_feet), 0, atol=1e-9)
    np.testing.assert_allclose(
        np.linalg.norm(p_feet - p, axis=1), np.abs(distances(shape.name, unknown, p)), atol=1e-9
    )
    ends = outline(shape, unknown, 4.0)
    assert ends.shape[1:] == (2, 3)
    corners = ends.reshape(-1, 3)[:, : p.shape[1]]
    np.testing.assert_allclose(distances(shape.name, unknown, corners), 0, atol=1e-9)
    assert len(outline(shape, np.full(len(unknown), np.nan), 4.0)) == 0
    assert len(outline(shape, np.array([*unknown[:-1], 1e10]), 4.0)) == 0


def test_a_cylinder_is_scipys():
    import scipy

    p = pipe_points(np.radians(200), 80) + 0.02 * np.random.default_rng(0).normal(size=(80, 3))

    def away(x):
        line = np.array([x[0], x[1], 0.0, x[2], x[3], 1.0, x[4]])
        return distances("cylinder", line, p)

    oracle = scipy.optimize.least_squares(away, [0.1, 0.1, 0.1, 0.0, 0.9], xtol=1e-12, ftol=1e-12)
    fitted = fit_round(CYLINDER, p[None], STARTS["cylinder"][None], tolerance=1e-13)[0]
    assert np.square(distances("cylinder", fitted, p)).sum() == pytest.approx(
        2 * oracle.cost, rel=1e-6
    )
    assert fitted[6] == pytest.approx(oracle.x[4], abs=1e-5)


def test_sets_are_fitted_each_alone():
    p = cap_points(2.0, 50) + 0.02 * np.random.default_rng(1).normal(size=(3, 50, 3))
    starts = np.tile(STARTS["sphere"], (3, 1))
    np.testing.assert_allclose(
        fit_round(SPHERE, p, starts)[1], fit_round(SPHERE, p[1:2], starts[:1])[0], atol=1e-6
    )
    assert CIRCLE.names[-1] == "R"
