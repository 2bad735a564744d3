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


def off(now: Scanned) -> float:
    """How far the points of the source are from where they belong, RMS, metres."""
    assert now.T_target_source is not None
    assert now.scans.T_truth is not None
    p = now.scans.p_source
    return float(
        np.sqrt(
            np.mean(
                np.sum((moved(now.T_target_source, p) - moved(now.scans.T_truth, p)) ** 2, axis=1)
            )
        )
    )


def home(now: Scanned) -> bool:
    if now.T_target_source is None or now.scans.T_truth is None:
        return False
    return turn(now.T_target_source, now.scans.T_truth) < 4.0 and off(now) < 0.05


def share(now: Scanned | Pictured | Outlined) -> float | None:
    """The share of matches that are right, of those whose truth is known; None where there are
    none.
    """
    pairs = now.pairs
    if pairs is None or not len(pairs):
        return None
    if isinstance(now, Scanned):
        if now.scans.T_truth is None:
            return None
        q = moved(now.scans.T_truth, now.scans.p_source)[pairs[:, 0]]
        return float(np.mean(np.linalg.norm(q - now.scans.p_target[pairs[:, 1]], axis=1) < 0.05))
    if isinstance(now, Pictured):
        if now.uv_truth is None or now.uv_second is None:
            return None
        apart = np.linalg.norm(now.uv_truth[pairs[:, 0]] - now.uv_second[pairs[:, 1]], axis=1)
        apart = apart[np.isfinite(apart)]
        return float(np.mean(apart < 3.0)) if len(apart) else None
    n = len(now.first)
    steps = (pairs[:, 0] - pairs[:, 1]) % n
    return float(np.mean(np.minimum(steps, n - steps) <= 2))


def agreeing(now: Scanned) -> int:
    """How many matches the motion brings within 4 cm of each other."""
    assert now.T_target_source is not None
    assert now.pairs is not None
    q = moved(now.T_target_source, now.scans.p_source)[now.pairs[:, 0]]
    return int(np.sum(np.linalg.norm(q - now.scans.p_target[now.pairs[:, 1]], axis=1) <= 0.04))


def nearer(now: Scanned) -> int:
    """How many target points are more alike the picked one than the target point nearest to its
    true place.
    """
    assert now.f_source is not None
    assert now.f_target is not None
    assert now.scans.T_truth is not None
    place = moved(now.scans.T_truth, now.scans.p_source[[now.picked]])
    there = int(np.ravel(cKDTree(now.scans.p_target).query(place)[1])[0])
    apart = np.sqrt(((now.f_target - now.f_source[now.picked]) ** 2).sum(axis=1))
    return int((apart < apart[there]).sum())
