"""The functions that students may write."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from workbench.algorithms.surfaces.fast_marching import Update

Mahalanobis = Callable[[np.ndarray, np.ndarray, np.ndarray], np.ndarray]
Shortest = Callable[[np.ndarray, np.ndarray, int, int], np.ndarray]


@dataclass(frozen=True, kw_only=True)
class Functions:
    """One of each kind."""

    mahalanobis: Mahalanobis
    shortest_distances: Shortest
    eikonal_update: Update
