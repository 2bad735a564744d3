"""Shape contexts: how the rest of an outline lies around each of its points, in log-polar bins.

Reference: Belongie, Malik and Puzicha, Shape Matching and Object Recognition Using Shape Contexts,
PAMI 2002, section 3.
"""

import numpy as np
from jaxtyping import Float

RINGS, SECTORS = 5, 12
# Of the rings, in mean distances; nearer points count to the first ring
EDGES = np.geomspace(0.125, 2.0, RINGS)

Outline = Float[np.ndarray, "n 2"]


def tangent_angles(p: Outline) -> Float[np.ndarray, " n"]:
    """Return a closed outline's direction at its points, from before to after, radians."""
    along = np.roll(p, -1, axis=0) - np.roll(p, 1, axis=0)
    return np.arctan2(along[:, 1], along[:, 0])


def shape_contexts(p: Outline, *, along_tangent: bool) -> Float[np.ndarray, "n 60"]:
    """Return one histogram per point of a closed outline: shares of others in 5 rings, 12 sectors.

    Distances count in means of all distances, up to two, so scale does not matter. Angles count
    from the x axis, or along the outline: then turns do not matter either (3.1 and 3.3.3).
    """
    n = len(p)
    v = p[None] - p[:, None]
    r = np.linalg.norm(v, axis=2)
    others = ~np.eye(n, dtype=bool)
    r = r / max(float(r[others].mean()), 1e-12)
    turn = np.arctan2(v[..., 1], v[..., 0]) - (tangent_angles(p)[:, None] if along_tangent else 0.0)
    ring = np.clip(np.searchsorted(EDGES, r, side="right") - 1, 0, RINGS - 1)
    sector = np.floor((turn % (2 * np.pi)) / (2 * np.pi) * SECTORS).astype(int) % SECTORS
    i, j = np.nonzero(others & (r <= EDGES[-1]))
    size = RINGS * SECTORS
    counts = np.bincount(
        i * size + ring[i, j] * SECTORS + sector[i, j], minlength=n * size
    ).reshape(n, size)
    return counts / np.maximum(counts.sum(axis=1, keepdims=True), 1)


def context_costs(
    a: Float[np.ndarray, "n d"], b: Float[np.ndarray, "m d"]
) -> Float[np.ndarray, "n m"]:
    """Return half the chi-squared distance of each pair of histograms, from 0 to 1 (3.1)."""
    sums = a[:, None] + b
    off = a[:, None] - b
    return 0.5 * (off * off / np.where(sums > 0, sums, 1.0)).sum(axis=-1)
