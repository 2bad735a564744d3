"""What is true of a run on features, from its own arrays and the truth it carries, by scipy and
plain numpy.
"""

import numpy as np
from scipy.spatial import cKDTree
from scipy.spatial.transform import Rotation

from lessons.features.state import Outlined, Pictured, Scanned


def moved(T: np.ndarray, p: np.ndarray) -> np.ndarray:
    return (np.column_stack([p, np.ones(len(p))]) @ T.T)[:, :3]


def turn(T: np.ndarray, T_true: np.ndarray) -> float:
    """Degrees between two motions."""
    return float(np.degrees(Rotation.from_matrix(T[:3, :3] @ T_true[:3, :3].T).magnitude()))


def off(step: Scanned) -> float:
    """How far the points of the source are from where they belong, RMS, metres."""
    assert step.T_target_source is not None
    assert step.scans.T_truth is not None
    p = step.scans.p_source
    return float(
        np.sqrt(
            np.mean(
                np.sum((moved(step.T_target_source, p) - moved(step.scans.T_truth, p)) ** 2, axis=1)
            )
        )
    )


def home(step: Scanned) -> bool:
    if step.T_target_source is None or step.scans.T_truth is None:
        return False
    return turn(step.T_target_source, step.scans.T_truth) < 4.0 and off(step) < 0.05


def share(step: Scanned | Pictured | Outlined) -> float | None:
    """The share of matches that are right, of those whose truth is known; None where there are
    none.
    """
    pairs = step.pairs
    if pairs is None or not len(pairs):
        return None
    if isinstance(step, Scanned):
        if step.scans.T_truth is None:
            return None
        q = moved(step.scans.T_truth, step.scans.p_source)[pairs[:, 0]]
        return float(np.mean(np.linalg.norm(q - step.scans.p_target[pairs[:, 1]], axis=1) < 0.05))
    if isinstance(step, Pictured):
        if step.uv_truth is None or step.uv_second is None:
            return None
        apart = np.linalg.norm(step.uv_truth[pairs[:, 0]] - step.uv_second[pairs[:, 1]], axis=1)
        apart = apart[np.isfinite(apart)]
        return float(np.mean(apart < 3.0)) if len(apart) else None
    n = len(step.first)
    steps = (pairs[:, 0] - pairs[:, 1]) % n
    return float(np.mean(np.minimum(steps, n - steps) <= 2))


def agreeing(step: Scanned) -> int:
    """How many matches the motion brings within 4 cm of each other."""
    assert step.T_target_source is not None
    assert step.pairs is not None
    q = moved(step.T_target_source, step.scans.p_source)[step.pairs[:, 0]]
    return int(np.sum(np.linalg.norm(q - step.scans.p_target[step.pairs[:, 1]], axis=1) <= 0.04))


def nearer(step: Scanned) -> int:
    """How many target points are more alike the picked one than the target point nearest to its
    true place.
    """
    assert step.f_source is not None
    assert step.f_target is not None
    assert step.scans.T_truth is not None
    place = moved(step.scans.T_truth, step.scans.p_source[[step.picked]])
    partner = int(np.ravel(cKDTree(step.scans.p_target).query(place)[1])[0])
    apart = np.sqrt(((step.f_target - step.f_source[step.picked]) ** 2).sum(axis=1))
    return int((apart < apart[partner]).sum())
