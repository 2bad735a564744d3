"""What a ray sees of a medium that emits and absorbs, and the gradient to density and colour.

Spacings and reaches are metres, densities 1/m and not negative; samples go from near to far.
Reference: Mildenhall et al., NeRF, ECCV 2020, eq. 3; Max, Optical models for direct volume
rendering, 1995, section 4.
"""

from collections.abc import Callable

import numpy as np
from jaxtyping import Float

RayWeights = Callable[[np.ndarray, float], np.ndarray]
"""ray_weights(density, spacing) -> weights."""


def samples_on(
    p: Float[np.ndarray, "r d"],
    d: Float[np.ndarray, "r d"],
    reach: tuple[float, float],
    *,
    count: int,
    shift: Float[np.ndarray, "r s"] | float = 0.5,
) -> tuple[Float[np.ndarray, "r s d"], float]:
    """Return a point in each equal part of each ray's way, shifted by a share, and the spacing."""
    spacing = (reach[1] - reach[0]) / count
    t = reach[0] + spacing * (np.arange(count) + shift) * np.ones((len(p), 1))
    return p[:, None] + t[:, :, None] * d[:, None], spacing


def ray_weights(density: Float[np.ndarray, "r s"], spacing: float) -> Float[np.ndarray, "r s"]:
    """Return how much each sample counts for its ray: w_i = T_i (1 - exp(-density_i spacing)).

    T_i = exp(-spacing sum_{j<i} density_j) is what passes all samples before (NeRF, eq. 3).
    """
    depth = spacing * density
    return np.exp(-(np.cumsum(depth, axis=1) - depth)) * -np.expm1(-depth)


def seen(
    weights: Float[np.ndarray, "r s"], color: Float[np.ndarray, "r s 3"], behind: float = 1.0
) -> Float[np.ndarray, "r 3"]:
    """Return the colours of rays: what passes all samples sees the grey background."""
    return np.einsum("rs,rsc->rc", weights, color) + behind * (
        1 - weights.sum(axis=1, keepdims=True)
    )


def through_seen(
    slope: Float[np.ndarray, "r 3"],
    density: Float[np.ndarray, "r s"],
    color: Float[np.ndarray, "r s 3"],
    *,
    spacing: float,
    behind: float = 1.0,
) -> tuple[Float[np.ndarray, "r s"], Float[np.ndarray, "r s 3"]]:
    """Return the gradients by densities and colours, given that by the colours that rays see.

    By density_i it is spacing times (T_{i+1} c_i - sum_{j>i} w_j c_j - T_end behind).
    """
    depth = spacing * density
    passed = np.exp(-np.cumsum(depth, axis=1))
    weights = ray_weights(density, spacing)
    gain = np.einsum("rsc,rc->rs", color, slope)
    shown = weights * gain
    after = (
        shown[:, ::-1].cumsum(axis=1)[:, ::-1]
        - shown
        + passed[:, -1:] * behind * slope.sum(axis=1, keepdims=True)
    )
    return spacing * (passed * gain - after), weights[:, :, None] * slope[:, None]
