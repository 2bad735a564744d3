"""Write the step of Levenberg and Marquardt. The lesson tries yours out at every iteration, keeps
it where it lowers the sum of squares, and asks for a shorter one where it does not.
"""

import numpy as np
from jaxtyping import Float

from lessons.fitting.exercises import STUDENTS, entries
from workbench.algorithms.least_squares import descent as least_squares
from workbench.exercise import (
    Function,
    Verdict,
    alternative,
    check,
    contract,
    left_alone,
    mistake,
    worst,
)


@contract(
    slot="damped_step",
    examples=(
        ("damped_step(array([3., 4.]), array([[1., 0.], [0., 2.]]), 0.0)", "[-3, -2]"),
        ("damped_step(array([3., 4.]), array([[1., 0.], [0., 2.]]), 1.0)", "[-1.5, -1]"),
    ),
)
def damped_step(
    residuals: Float[np.ndarray, " n"], jacobian: Float[np.ndarray, "n k"], damping: float
) -> Float[np.ndarray, " k"]:
    """Return the step that solves (JᵀJ + damping D) step = −Jᵀr, where D is the diagonal of JᵀJ and
    0 beside it.

    With damping 0 it is the step of Gauss and Newton, to where the linear problem is least.

    Args:
        residuals: r, what should become small.
        jacobian: J, by how much each of them changes per unit of each unknown. Its columns are
            independent.
        damping: 0 or more.
    """
    return least_squares.damped_step(residuals, jacobian, damping)


HINT = "Solve (JᵀJ + damping · diag(JᵀJ)) step = −Jᵀr."


def problem(seed: int, n: int = 20, k: int = 3) -> tuple[np.ndarray, np.ndarray]:
    """Return residuals and a Jacobian whose columns have sizes of their own."""
    rng = np.random.default_rng(seed)
    return rng.normal(size=n), rng.normal(size=(n, k)) * rng.uniform(0.5, 2.0, k) + 0.3


def judged(
    candidate: Function, residuals: np.ndarray, jacobian: np.ndarray, damping: float
) -> Verdict:
    """Judge a step by its entries."""
    right = least_squares.damped_step(residuals, jacobian, damping)
    return entries(
        f"Step with damping {damping:g}", candidate(residuals, jacobian, damping), right, HINT
    )


@check(2)
def without_damping(candidate: Function) -> Verdict:
    """Without damping it is the step of Gauss and Newton."""
    return judged(candidate, *problem(STUDENTS), 0.0)


@check(3)
def with_damping(candidate: Function) -> Verdict:
    """Damping adds to the diagonal, each entry in its own unit."""
    return worst(
        judged(candidate, *problem(STUDENTS + k), damping)
        for k, damping in enumerate((0.1, 1.0, 30.0))
    )


@check(1)
def inputs_are_left_alone(candidate: Function) -> Verdict:
    """Residuals and Jacobian are not changed."""
    return left_alone(candidate, judged(candidate, *problem(STUDENTS + 4), 0.5))


def normal(jacobian: np.ndarray) -> np.ndarray:
    """Return JᵀJ."""
    return jacobian.T @ jacobian


@mistake(
    "You added damping times the identity. Marquardt's matrix has the diagonal of JᵀJ, so that"
    " units do not matter."
)
def identity(residuals: np.ndarray, jacobian: np.ndarray, damping: float) -> np.ndarray:
    """Adds damping I."""
    return np.linalg.solve(
        normal(jacobian) + damping * np.eye(jacobian.shape[1]), -jacobian.T @ residuals
    )


@mistake("Your step has the wrong sign: it goes up. The right side is −Jᵀr.")
def uphill(residuals: np.ndarray, jacobian: np.ndarray, damping: float) -> np.ndarray:
    """Forgets the minus."""
    return -least_squares.damped_step(residuals, jacobian, damping)


@mistake(
    "You shortened Gauss and Newton's step by 1 + damping. Damping also turns the step: it goes"
    " into the matrix."
)
def shortened(residuals: np.ndarray, jacobian: np.ndarray, damping: float) -> np.ndarray:
    """Divides the step."""
    return least_squares.damped_step(residuals, jacobian, 0.0) / (1.0 + damping)


@mistake(
    "Your step does not depend on the damping. It belongs on the diagonal: JᵀJ + damping ·"
    " diag(JᵀJ)."
)
def undamped(residuals: np.ndarray, jacobian: np.ndarray, damping: float) -> np.ndarray:
    """Leaves the damping out."""
    return least_squares.damped_step(residuals, jacobian, 0.0)


@mistake(
    "You replaced the diagonal by damping times itself. It is added to it: the diagonal grows by 1"
    " + damping."
)
def replaced(residuals: np.ndarray, jacobian: np.ndarray, damping: float) -> np.ndarray:
    """Writes over the diagonal."""
    A = normal(jacobian)
    A.flat[:: len(A) + 1] *= damping
    return np.linalg.lstsq(A, -jacobian.T @ residuals, rcond=None)[0]


@mistake("You squared the damping. It is added as it is: damping · diag(JᵀJ).")
def squared_damping(residuals: np.ndarray, jacobian: np.ndarray, damping: float) -> np.ndarray:
    """Takes damping²."""
    return least_squares.damped_step(residuals, jacobian, damping**2)


@mistake("You took the lengths of J's columns for D. The diagonal of JᵀJ holds their squares.")
def roots(residuals: np.ndarray, jacobian: np.ndarray, damping: float) -> np.ndarray:
    """Takes the square root of the diagonal."""
    A = normal(jacobian)
    return np.linalg.solve(A + damping * np.diag(np.sqrt(np.diag(A))), -jacobian.T @ residuals)


@mistake("You add damping to every entry of JᵀJ. It belongs on the diagonal alone: use np.diag.")
def everywhere(residuals: np.ndarray, jacobian: np.ndarray, damping: float) -> np.ndarray:
    """Adds a number to a matrix."""
    return np.linalg.lstsq(normal(jacobian) + damping, -jacobian.T @ residuals, rcond=None)[0]


@mistake(
    "You return −Jᵀr, the way down, without the matrix: it has another unit than a step. Solve with"
    " JᵀJ."
)
def gradient(residuals: np.ndarray, jacobian: np.ndarray, damping: float) -> np.ndarray:
    """Goes down the gradient."""
    return -jacobian.T @ residuals


@alternative
def by_longer_rows(residuals: np.ndarray, jacobian: np.ndarray, damping: float) -> np.ndarray:
    """Solves a longer linear problem, without squaring the condition."""
    D = np.diag(np.linalg.norm(jacobian, axis=0))
    rows = np.vstack([jacobian, np.sqrt(damping) * D])
    return np.linalg.lstsq(rows, np.append(-residuals, np.zeros(len(D))), rcond=None)[0]


@alternative
def by_inverse(residuals: np.ndarray, jacobian: np.ndarray, damping: float) -> np.ndarray:
    """Multiplies by the inverse."""
    A = normal(jacobian)
    A[np.diag_indices(len(A))] *= 1.0 + damping
    return -np.linalg.inv(A) @ (jacobian.T @ residuals)
