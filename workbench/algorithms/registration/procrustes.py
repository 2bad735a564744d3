"""The similarity that fits pairs best, in the steps of its formula: centre, SVD, no mirror, scale.

Reference: Umeyama, Least-squares estimation of transformation parameters between two point
patterns, 1991, eq. 38-43.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from typing import Any, Literal

import numpy as np
from jaxtyping import Float

from workbench.geometry.motions import apply, motion
from workbench.tracing import traced

Stage = Literal["pairs", "centre", "cross", "in", "out", "flip", "scale"]
Flip = Literal["least", "middle", "largest", "whole", "none"]
Scale = Callable[[np.ndarray, np.ndarray], float]
"""similarity_scale(p_target, p_source) -> how many times larger the target is."""

FLIPPED: dict[Flip, tuple[float, float, float]] = {
    "least": (1.0, 1.0, -1.0),
    "middle": (1.0, -1.0, 1.0),
    "largest": (-1.0, 1.0, 1.0),
    "whole": (-1.0, -1.0, -1.0),
    "none": (1.0, 1.0, 1.0),
}
"""The diagonal of S for a mirror image: which of the three directions change their sign."""


@dataclass(frozen=True, eq=False, kw_only=True)
class State:
    """What is known after one stage; what is not known yet is None.

    Attributes:
        T_target_source: The map so far; a mirror image while its determinant is negative.
        rmse: Root mean square distance of the pairs under it, m.
        H: Cross-covariance of target and source, m^2 (eq. 38).
        U: Its left singular vectors, directions in the target frame, in columns.
        D: Its singular values, m^2.
        V: Its right singular vectors, directions in the source frame, in columns; a rotation.
        mirror: Whether U V^T is a mirror image.
        S: The signs that were given to the three directions.
        scale: How many times larger the target is.
    """

    stage: Stage
    T_target_source: Float[np.ndarray, "4 4"]
    rmse: float
    H: Float[np.ndarray, "3 3"] | None = None
    U: Float[np.ndarray, "3 3"] | None = None
    D: Float[np.ndarray, "3"] | None = None
    V: Float[np.ndarray, "3 3"] | None = None
    mirror: bool | None = None
    S: Float[np.ndarray, "3"] | None = None
    scale: float | None = None


@traced
def procrustes(
    p_target: Float[np.ndarray, "n 3"],
    p_source: Float[np.ndarray, "n 3"],
    similarity_scale: Scale,
    *,
    flip: Flip = "least",
) -> Iterator[State]:
    """Yield the map from source to target after each stage; points in metres, pairs row by row.

    `flip` is the direction that changes its sign where the SVD gives a mirror image; only "least"
    is right.
    """
    m_target, m_source = p_target.mean(axis=0), p_source.mean(axis=0)

    def about_centroids(A: np.ndarray) -> np.ndarray:
        return motion(A, m_target - A @ m_source)  # eq. 41

    def left(T: np.ndarray) -> float:
        return float(np.sqrt(np.mean(np.sum((p_target - apply(T, p_source)) ** 2, axis=1))))

    state = State(stage="pairs", T_target_source=np.eye(4), rmse=left(np.eye(4)))
    yield state

    def after(stage: Stage, T: np.ndarray, **known: Any) -> State:
        return replace(state, stage=stage, T_target_source=T, rmse=left(T), **known)

    yield (state := after("centre", about_centroids(np.eye(3))))
    H = (p_target - m_target).T @ (p_source - m_source) / len(p_source)  # eq. 38
    U, D, Vt = _turning_in(H)
    yield (state := after("cross", state.T_target_source, H=H, U=U, D=D, V=Vt.T))
    yield (state := after("in", about_centroids(Vt)))
    mirror = bool(np.linalg.det(U) < 0)
    yield (state := after("out", about_centroids(U @ Vt), mirror=mirror))
    S = np.array(FLIPPED[flip] if mirror else FLIPPED["none"])  # eq. 43
    R = (U * S) @ Vt  # eq. 40
    yield (state := after("flip", about_centroids(R), S=S))
    scale = float(similarity_scale(p_target, p_source))  # eq. 42
    yield (state := after("scale", about_centroids(scale * R), scale=scale))


def _turning_in(H: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return the SVD with a V that is a rotation: a sign may change in both factors together."""
    U, D, Vt = np.linalg.svd(H)
    signs = np.sign(Vt[np.arange(3), np.abs(Vt).argmax(axis=1)])
    signs[2] *= np.sign(np.linalg.det(Vt) * signs.prod())
    return U * signs, D, Vt * signs[:, None]
