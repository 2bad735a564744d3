"""How far a map and its depths are from the truth, where it is known."""

import numpy as np

from lessons.disparity.pairs import Pictures


def judged(pictures: Pictures, disparity: np.ndarray) -> tuple[float, float, float]:
    """Return the share of wrong pixels, the mean error of the right ones, and the share of unknown
    pixels.
    """
    unknown = float(np.isnan(disparity).mean())
    truth = pictures.pair.disparity
    visible = pictures.pair.visible
    if truth is None or visible is None or not visible.any():
        return np.nan, np.nan, unknown
    off = np.abs(disparity - truth)[visible]
    right = off <= 1.0
    return float((off > 1.0).mean()), float(off[right].mean()) if right.any() else np.nan, unknown


def known_depths(pictures: Pictures, depth: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the depths found and the true ones, metres, of the pixels where both are known and
    finite.
    """
    true = pictures.true_depth
    known = np.isfinite(depth) & np.isfinite(true)
    return depth[known], true[known]


def depth_errors(pictures: Pictures, depth: np.ndarray) -> np.ndarray:
    """Return how far the depths that are known are from the true ones, metres; empty without
    truth.
    """
    depths, true = known_depths(pictures, depth)
    return np.abs(depths - true)


def flat_parts(pictures: Pictures, depth: np.ndarray) -> dict[float, np.ndarray]:
    """Return, for every depth that hundreds of pixels share exactly, how far theirs is off, metres;
    empty without truth.
    """
    visible = pictures.pair.visible
    true = np.round(pictures.true_depth, 9)
    if visible is None:
        return {}
    depths, counts = np.unique(true[visible & np.isfinite(true)], return_counts=True)
    parts = {}
    for z in depths[counts > 300]:
        here = visible & (true == z) & np.isfinite(depth)
        if here.any():
            parts[float(z)] = depth[here] - z
    return parts
