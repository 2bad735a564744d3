import numpy as np
import scipy

from workbench.geometry.refinement import levenberg_marquardt


def rosenbrock(x):
    return np.array([10 * (x[1] - x[0] ** 2), 1 - x[0]]), np.array(
        [[-20 * x[0], 10.0], [-1.0, 0.0]]
    )


def test_it_finds_the_valley_floor():
    np.testing.assert_allclose(
        levenberg_marquardt(rosenbrock, np.add, np.array([-1.2, 1.0]), steps=100), [1, 1], atol=1e-6
    )


def test_it_agrees_with_scipy_where_the_residual_is_not_zero():
    rng = np.random.default_rng(0)
    x = np.linspace(0, 3, 40)
    y = 2.0 * np.exp(-1.3 * np.linspace(0, 3, 40)) + 0.05 * rng.normal(size=40)

    def model(q):
        e = np.exp(-q[1] * x)
        return q[0] * e - y, np.column_stack([e, -q[0] * x * e])

    solution = levenberg_marquardt(model, np.add, np.array([1.0, 1.0]), tolerance=1e-14, steps=50)
    oracle = scipy.optimize.least_squares(
        lambda q: model(q)[0], [1.0, 1.0], xtol=1e-14, ftol=1e-14, gtol=1e-14
    )
    np.testing.assert_allclose(solution, oracle.x, atol=1e-7)


def test_the_cost_never_rises():
    costs = []

    def noted(x):
        residuals, jacobian = rosenbrock(x)
        costs.append((float(residuals @ residuals), x))
        return residuals, jacobian

    start = np.array([-1.2, 1.0])
    solution = levenberg_marquardt(noted, np.add, start, steps=7)
    end = rosenbrock(solution)[0]
    assert end @ end == min(cost for cost, _ in costs) < costs[0][0]


def test_a_singular_or_wild_problem_returns_its_best_and_does_not_raise():
    def flat(x):
        return np.array([1.0, 2.0]), np.zeros((2, 2))

    np.testing.assert_array_equal(levenberg_marquardt(flat, np.add, np.ones(2)), np.ones(2))

    def nan_beyond(x):
        return np.array([1.0 - x[0] if x[0] < 0.5 else np.nan]), np.array([[-1.0]])

    assert np.isfinite(levenberg_marquardt(nan_beyond, np.add, np.zeros(1))).all()
