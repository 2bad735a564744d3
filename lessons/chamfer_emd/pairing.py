"""Who belongs to whom, unrolled: under each flow its target as one row of points, the cloud as
another, joined.
"""

import numpy as np

from lessons.chamfer_emd.state import Side, State
from workbench.geometry.polylines import between
from workbench.scene import Classes, Label, Points, Primitive, Segments

WIDTH = 2.1
TARGET_ROW = -1.3
SOURCE_ROW = -2.0


def unrolled(
    state: State, side: Side, T_world_side: np.ndarray, *, nearest: bool
) -> dict[str, Primitive]:
    """Return both rows in the order of their angle, and the pairs between them, one to one or each
    with its nearest.
    """
    p_target = state.clouds.p_target
    target = _row(p_target, p_target, TARGET_ROW)
    source = _row(side.flow.p_moving, p_target, SOURCE_ROW)
    radius = min(0.02, 0.45 * WIDTH / max(len(target), len(source)))
    ends, used, words = _nearest(state, side) if nearest else _matched(state, side)
    classes = Classes.marking(~used, "wrong", "nearest to no place", others=("source", "source"))
    return {
        "target row": Points(target, "target", radius, T_world_side),
        "source row": Points(source, classes if nearest else "source", radius, T_world_side),
        "pairing": Segments(
            between(target[ends[0]], source[ends[1]]),
            "other" if nearest else "correspondence",
            1.5,
            T_world_side,
        ),
        "pairing words": Label(
            words, np.array([0.0, 0.0, SOURCE_ROW - 0.17]), "neutral", T_world_side
        ),
    }


def _nearest(state: State, side: Side) -> tuple[tuple[np.ndarray, np.ndarray], np.ndarray, str]:
    n, m = len(side.flow.p_moving), len(state.clouds.p_target)
    if state.params.lowers == "source to target":
        ends = side.near.a_to_b, np.arange(n)
        chosen = len(np.unique(side.near.a_to_b))
        return ends, np.ones(n, bool), f"{chosen} of {m} are somebody's nearest"
    used = side.served > 0
    ends = np.arange(m), side.near.b_to_a
    return ends, used, f"{np.count_nonzero(used)} of {n} serve all {m}"


def _matched(state: State, side: Side) -> tuple[tuple[np.ndarray, np.ndarray], np.ndarray, str]:
    n, m = len(side.flow.p_moving), len(state.clouds.p_target)
    words = f"{n} serve {m}, one to one" if n == m else f"{n} serve {m}, masses split"
    return (side.matching.i_b, side.matching.i_a), np.ones(n, bool), words


def _row(p: np.ndarray, p_target: np.ndarray, height: float) -> np.ndarray:
    """Return points side by side in the order of their angle around the target's middle, from its
    left side on.
    """
    x, _, z = (p - p_target.mean(axis=0)).T
    place = np.empty(len(p))
    place[np.lexsort((np.arange(len(p)), np.round(np.arctan2(z, x), 6)))] = (
        np.arange(len(p)) + 0.5
    ) / len(p) - 0.5
    return np.column_stack([WIDTH * place, np.zeros(len(p)), np.full(len(p), height)])
