"""Jacobi's eigenvalue method: turn the frame in one plane after the other until it is diagonal.

Reference: Golub and Van Loan, Matrix Computations, 4th ed., 8.5 (classical Jacobi); Jacobi, Über
ein leichtes Verfahren, die in der Theorie der Säcularstörungen vorkommenden Gleichungen numerisch
aufzulösen, 1846.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from jaxtyping import Float

from workbench.tracing import traced

TOLERANCE = 1e-12
"""What may be left off the diagonal, of the norm of the whole matrix."""


@dataclass(frozen=True, eq=False)
class State:
    """The frame after one more rotation.

    Attributes:
        A: The matrix in the frame, V^T C V.
        V: The frame, its axes in columns.
        plane: The two axes that were turned, or None before the first rotation.
        angle: From the first of them towards the second, radians, at most a quarter of pi.
        off: Norm of what is off the diagonal of A, as a share of the norm of A.
    """

    A: Float[np.ndarray, "n n"]
    V: Float[np.ndarray, "n n"]
    plane: tuple[int, int] | None
    angle: float
    off: float


@traced
def jacobi(C: Float[np.ndarray, "n n"], tolerance: float = TOLERANCE) -> Iterator[State]:
    """Yield the frame as it is, and after each rotation, until C is diagonal in it.

    Each rotation makes the largest entry off the diagonal zero and brings earlier ones back,
    smaller: the sum of their squares falls by twice the square of that entry, and in the end
    quadratically.

    Args:
        C: A symmetric matrix.
    """
    A = C
    V = np.eye(len(C))
    norm = np.linalg.norm(C)
    yield State(A, V, None, 0.0, _off(A, norm))
    while True:
        aside = np.abs(np.triu(A, 1))
        i, j = divmod(int(aside.argmax()), len(A))
        if not aside[i, j] > tolerance * norm:  # also where a number is none
            return
        # 8.5.2: tan 2a = 2 A_ij / (A_ii - A_jj), of the two angles the smaller
        angle = 0.5 * np.arctan2(2 * A[i, j], A[i, i] - A[j, j])
        angle -= np.pi / 2 * np.sign(angle) if abs(angle) > np.pi / 4 else 0.0
        c, s = np.cos(angle), np.sin(angle)
        G = np.eye(len(A))
        G[[i, j, i, j], [i, j, j, i]] = c, c, -s, s
        A = G.T @ A @ G
        V = V @ G
        yield State(A, V, (i, j), float(angle), _off(A, norm))


def _off(A: np.ndarray, norm: float | np.floating) -> float:
    return float(np.linalg.norm(A - np.diag(np.diag(A))) / norm) if norm > 0 else 0.0
