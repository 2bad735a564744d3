"""What a ray sees of a medium that emits and absorbs, sampled along it, and the gradient back to
density and colour.

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
    count: int,
    shift: Float[np.ndarray, "r s"] | float = 0.5,
) -> tuple[Float[np.ndarray, "r s d"], float]:
    """Return so many points on each ray, one in each equal part of its way, and the length of a
    part, m.

    Args:
        p: Where the rays begin.
        d: Their unit directions.
        reach: From where to where on the rays, m.
        count: How many.
        shift: Where in its part each lies, 0 to 1.
    """
    spacing = (reach[1] - reach[0]) / count
    t = reach[0] + spacing * (np.arange(count) + shift) * np.ones((len(p), 1))
    return p[:, None] + t[:, :, None] * d[:, None], spacing


def ray_weights(density: Float[np.ndarray, "r s"], spacing: float) -> Float[np.ndarray, "r s"]:
    """Return how much each sample counts in what its ray sees: w_i = T_i (1 - exp(-density_i
    spacing)).

    T_i = exp(-spacing sum_{j<i} density_j) is the share of light that passes all samples before. A
    row's sum is 1 minus what passes all of them.

    Args:
        density: Of r rays at s samples from near to far, 1/m, not negative.
        spacing: Between samples, m.

    Reference: Mildenhall et al. 2020, eq. 3.
    """
    depth = spacing * density
    return np.exp(-(np.cumsum(depth, axis=1) - depth)) * -np.expm1(-depth)


def seen(
    weights: Float[np.ndarray, "r s"], color: Float[np.ndarray, "r s 3"], behind: float = 1.0
) -> Float[np.ndarray, "r 3"]:
    """Return the colours of rays, of which what passes all samples sees the background.

    Args:
        weights: As of `ray_weights`.
        color: Of each sample.
        behind: The background, grey.
    """
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
    """Return the gradients by densities and colours, given that by the colours that the rays see.

    By density_i it is spacing times (T_{i+1} c_i - sum_{j>i} w_j c_j - T_end behind): light that is
    let through less, and what lies behind is seen less.

    Args:
        slope: The gradient by what is seen.
        density: Of the samples, 1/m.
        color: Of the samples.
        spacing: Between them, m.
        behind: The background.
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
