"""Distances from cylinders: slopes by differences, five steps and no more, points that lie on
one.
"""

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.truths.fitting import distances
from workbench.geometry.motions import across
from workbench.geometry.shapes.cylinders import linearise_cylinder, retract_cylinder

seeds = st.integers(0, 2**32 - 1)


def a_cylinder(rng: np.random.Generator) -> np.ndarray:
    n = rng.normal(size=3)
    return np.concatenate([rng.normal(size=3), n / np.linalg.norm(n), [rng.uniform(0.2, 2.0)]])


@settings(max_examples=40, deadline=None)
@given(seed=seeds)
def test_the_slopes_are_those_of_the_distances(seed):
    rng = np.random.default_rng(seed)
    cylinder = a_cylinder(rng)
    p = rng.normal(size=(9, 3)) * 2
    h = 1e-6
    residuals, jacobian = linearise_cylinder(cylinder, p)
    np.testing.assert_allclose(residuals, distances("cylinder", cylinder, p), atol=1e-12)
    for k, e in enumerate(np.eye(5)):
        ahead, behind = (
            distances("cylinder", retract_cylinder(cylinder, s * h * e), p) for s in (1, -1)
        )
        np.testing.assert_allclose(
            jacobian[:, k],
            (ahead - behind) / (2 * h),
            atol=1e-5 / np.abs(residuals + cylinder[6]).min(),
        )


@settings(max_examples=40, deadline=None)
@given(seed=seeds)
def test_a_step_keeps_the_direction_a_unit_vector(seed):
    rng = np.random.default_rng(seed)
    moved = retract_cylinder(a_cylinder(rng), rng.normal(size=5))
    assert (
        np.linalg.norm(moved[3:6]) == np.float64(1.0) or abs(np.linalg.norm(moved[3:6]) - 1) < 1e-12
    )


def test_many_at_once_are_each_alone():
    rng = np.random.default_rng(0)
    cylinders = np.stack([a_cylinder(rng) for _ in range(4)])
    p = rng.normal(size=(4, 7, 3))
    residuals, jacobians = linearise_cylinder(cylinders, p)
    for k in range(4):
        alone = linearise_cylinder(cylinders[k], p[k])
        np.testing.assert_allclose(residuals[k], alone[0])
        np.testing.assert_allclose(jacobians[k], alone[1])


def test_seven_numbers_have_two_that_change_nothing():
    """The redundant Jacobian's two zeros: a slide along the axis and the length of the
    direction.
    """
    rng = np.random.default_rng(1)
    turn = rng.uniform(0, 2 * np.pi, 200)
    z = rng.uniform(-1, 1, 200)
    p = np.column_stack([np.cos(turn), np.sin(turn), z])
    cylinder = np.array([0.0, 0, 0, 0, 0, 1, 1])
    h = 1e-6
    J = np.column_stack(
        [
            (
                distances("cylinder", cylinder + h * e, p)
                - distances("cylinder", cylinder - h * e, p)
            )
            / (2 * h)
            for e in np.eye(7)
        ]
    )
    sizes = np.linalg.svd(J, compute_uv=False)
    assert (sizes[:5] > 1).all()
    assert (sizes[5:] < 1e-6).all()
    assert np.linalg.matrix_rank(linearise_cylinder(cylinder, p)[1]) == 5


def test_a_point_on_the_axis_has_no_slope_but_by_the_radius():
    cylinder = np.array([0.0, 0, 0, 0, 0, 1, 0.5])
    residuals, jacobian = linearise_cylinder(cylinder, np.array([[0.0, 0, 2]]))
    np.testing.assert_array_equal(residuals, [-0.5])
    np.testing.assert_array_equal(jacobian, [[0, 0, 0, 0, -1]])


@settings(max_examples=40, deadline=None)
@given(seed=seeds)
def test_across_makes_a_frame(seed):
    n = np.random.default_rng(seed).normal(size=3)
    n /= np.linalg.norm(n)
    R = np.stack([*across(n), n])
    np.testing.assert_allclose(R @ R.T, np.eye(3), atol=1e-12)
