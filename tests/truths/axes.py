"""What is true of a run of the lesson on axes, with scipy from the scans and the truth that they
carry.
"""

import numpy as np
from scipy.spatial import KDTree
from scipy.spatial.transform import Rotation

from lessons.axes.scans import Scans
from lessons.axes.space import State

HOME = 10.0  # degrees


def degrees(R: np.ndarray, other: np.ndarray) -> float:
    """The angle between the rotations nearest to two matrices."""
    return float(
        np.degrees(
            (
                Rotation.from_matrix(unscaled(R)) * Rotation.from_matrix(unscaled(other)).inv()
            ).magnitude()
        )
    )


def unscaled(A: np.ndarray) -> np.ndarray:
    return A / np.cbrt(np.linalg.det(A))


def moved(scans: Scans, state: State) -> np.ndarray:
    assert state.outcome is not None
    T = state.outcome.T_target_source
    return scans.p_source @ T[:3, :3].T + T[:3, 3]


def turn_left(scans: Scans, state: State) -> float:
    """Degrees from the truth; NaN where no rotation is right, or the map is a mirror image."""
    assert state.outcome is not None
    T = state.outcome.T_target_source
    T_true = scans.T_target_source
    if T_true is None or np.linalg.det(T[:3, :3]) < 0:
        return float("nan")
    return degrees(T[:3, :3], T_true[:3, :3])


def to_nearest(scans: Scans, state: State) -> float:
    return float(
        np.sqrt(np.mean(np.asarray(KDTree(scans.p_target).query(moved(scans, state))[0]) ** 2))
    )


def eigenvectors(p: np.ndarray) -> np.ndarray:
    """Principal axes by numpy, columns by falling variance, any handedness."""
    return np.linalg.eigh(np.cov(p.T))[1][:, ::-1]


def many(state: State) -> np.ndarray:
    """Degrees from the truth of each of the many turns, from where their axes came to lie."""
    assert state.turns is not None
    assert state.axes_target is not None
    first, second = state.turns.tips[:, 0], state.turns.tips[:, 1]
    frames = np.stack([first, second, np.cross(first, second)], axis=2)
    return np.array([degrees(state.axes_target, frame) for frame in frames])
