"""Many damped steps at once are Marquardt's, each of its own system."""

import numpy as np

from workbench.algorithms.least_squares.descent import _damped_steps


def test_each_step_solves_the_system_with_its_diagonal_raised():
    rng = np.random.default_rng(0)
    J = rng.normal(size=(5, 12, 3)) * [1.0, 50.0, 0.01]
    r = rng.normal(size=(5, 12))
    dampings = np.array([0.0, 1e-3, 0.1, 1.0, 30.0])
    for step, jacobian, residual, damping in zip(
        _damped_steps(r, J, dampings), J, r, dampings, strict=True
    ):
        normal = jacobian.T @ jacobian
        damped = normal + damping * np.diag(np.diag(normal))
        np.testing.assert_allclose(step, -np.linalg.solve(damped, jacobian.T @ residual), rtol=1e-8)
