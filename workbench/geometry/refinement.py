"""Minimises a sum of squares by Levenberg-Marquardt on any space that has a retraction."""

from collections.abc import Callable
from typing import TypeVar

import numpy as np

Unknown = TypeVar("Unknown")


@np.errstate(over="ignore", invalid="ignore")  # a step that is not finite has failed, quietly
def levenberg_marquardt(
    linearise: Callable[[Unknown], tuple[np.ndarray, np.ndarray]],
    retract: Callable[[Unknown, np.ndarray], Unknown],
    start: Unknown,
    *,
    steps: int = 20,
    tolerance: float = 1e-7,
) -> Unknown:
    """Return the unknown near `start` whose residuals have the smallest sum of squares.

    `linearise` gives the residuals (n,) at an unknown and their Jacobian (n, k) by a small step;
    `retract` the unknown that such a step leads to. The damping scales with the diagonal of the
    normal matrix (Marquardt): units do not matter. The cost never rises. It stops when a step
    lowers it by less than the share `tolerance`.
    Reference: Nocedal and Wright, Numerical Optimization, 2nd ed., 10.3.
    """
    unknown = start
    damping = 1e-6
    residuals, jacobian = linearise(unknown)
    cost = residuals @ residuals
    for _ in range(steps):
        normal, gradient = jacobian.T @ jacobian, jacobian.T @ residuals
        normal.flat[:: len(normal) + 1] *= 1.0 + damping
        try:
            step = np.linalg.solve(normal, -gradient)
        except np.linalg.LinAlgError:
            damping *= 100.0
            continue
        trial = retract(unknown, step)
        trial_residuals, trial_jacobian = linearise(trial)
        trial_cost = trial_residuals @ trial_residuals
        if not trial_cost < cost:
            if np.abs(step).max(initial=0.0) < 1e-14:
                break
            damping *= 10.0
            continue
        settled = cost - trial_cost <= tolerance * cost
        unknown, residuals, jacobian, cost = trial, trial_residuals, trial_jacobian, trial_cost
        damping *= 0.1
        if settled:
            break
    return unknown
