"""How far a map and its depths are from the truth, where it is known."""

import numpy as np

from lessons.disparity.state import Setup, State


def judged(setup: Setup, disparity: np.ndarray) -> tuple[float, float, float]:
    """Return the share of wrong pixels, the mean error of the right ones, and the share of unknown
    pixels.
    """
    unknown = float(np.isnan(disparity).mean())
    truth, visible = setup.pair.disparity, setup.pair.visible
    if truth is None or visible is None or not visible.any():
        return np.nan, np.nan, unknown
    off = np.abs(disparity - truth)[visible]
    right = off <= 1.0
    return float((off > 1.0).mean()), float(off[right].mean()) if right.any() else np.nan, unknown


def known_depths(state: State) -> tuple[np.ndarray, np.ndarray]:
    """Return the depths found and the true ones, metres, of the pixels where both are known and
    finite.
    """
    true = state.setup.true_depth
    known = np.isfinite(state.depth) & np.isfinite(true)
    return state.depth[known], true[known]


def depth_errors(state: State) -> np.ndarray:
    """Return how far the depths that are known are from the true ones, metres; empty without
    truth.
    """
    found, true = known_depths(state)
    return np.abs(found - true)


def flat_parts(state: State) -> dict[float, np.ndarray]:
    """Return, for every depth that hundreds of pixels share exactly, how far theirs is off, metres;
    empty without truth.
    """
    visible, true = state.setup.pair.visible, np.round(state.setup.true_depth, 9)
    if visible is None:
        return {}
    depths, counts = np.unique(true[visible & np.isfinite(true)], return_counts=True)
    parts = {}
    for depth in depths[counts > 300]:
        here = visible & (true == depth) & np.isfinite(state.depth)
        if here.any():
            parts[float(depth)] = state.depth[here] - depth
    return parts
