"""Made data: a beacon that two sensors measure by turns."""

import numpy as np

from .state import P_TRUE, Params

P_OTHER = P_TRUE + np.array([0.8, 0.3, 0.0])
"""Where another beacon is, metres."""
LEAST = 1e-3
"""Metres: no sensor is trusted more than this, so that a weight stays finite."""


def measured(params: Params, rng: np.random.Generator) -> tuple[np.ndarray, np.ndarray]:
    """Return the fixes (n, 3), metres, and their weights (n,): even rows by the good sensor, odd
    ones by the bad.
    """
    even = np.arange(params.fixes) % 2 == 0
    sigma = np.where(even, params.good, params.bad)
    p = P_TRUE + sigma[:, None] * rng.standard_normal((params.fixes, 3))
    strays = np.flatnonzero(even)[::-1][: params.outliers]
    p[strays] += P_OTHER - P_TRUE
    w = np.ones(params.fixes) if params.weights == "equal" else 1.0 / np.maximum(sigma, LEAST) ** 2
    return p, w
