"""Circles in closed form, for many sets at once: Kåsa, Pratt, Taubin, Al-Sharadqah and Chernov.

Each minimises the sum of squares of A (x² + y²) + B x + C y + D, which is 0 on the circle. All
zeros must be forbidden, and the fits differ in how: A = 1 (Kåsa), B² + C² - 4 A D = 1 (Pratt), the
mean squared slope 1 (Taubin), or the constraint whose bias cancels (Hyper).
"""

from typing import Literal, get_args

import numpy as np
from jaxtyping import Float

Algebraic = Literal["Kåsa", "Pratt", "Taubin", "Hyper"]
ALGEBRAIC: tuple[Algebraic, ...] = get_args(Algebraic)


def fit_algebraic(
    p: Float[np.ndarray, "*k n d"], kind: Algebraic = "Taubin"
) -> Float[np.ndarray, "*k c"]:
    """Return the circle (x, y, r), or with d = 3 the sphere, of least squared algebraic distances.

    Points on a line give all but Kåsa a very large circle, or numbers that are not finite.
    Reference: Al-Sharadqah and Chernov, Error analysis for circle fitting algorithms, 2009,
    sections 4, 5, 7 and 8; Chernov, Circular and linear regression, 2010, chapter 5.

    Raises:
        ValueError: If a set has fewer than d + 1 points, or "Hyper" is asked for a sphere.
        LinAlgError: If "Kåsa" is asked for a set exactly on a line or plane.
    """
    n, d = p.shape[-2:]
    if n <= d:
        raise ValueError(f"{d + 1} points are needed, got {n}")
    if kind == "Hyper" and d != 2:
        raise ValueError("the constraint of Hyper is made for circles")
    origin = p.mean(axis=-2, keepdims=True)
    q = p - origin
    z = np.square(q).sum(-1)
    mean_z = z.mean(-1)
    if kind == "Kåsa":
        normal = np.einsum("...ni,...nj->...ij", q, q)
        center = (
            np.linalg.solve(normal, np.einsum("...ni,...n->...i", q, z)[..., None])[..., 0] / 2.0
        )
        radius = np.sqrt(mean_z + np.square(center).sum(-1))
        return np.concatenate([center + origin[..., 0, :], radius[..., None]], axis=-1)
    unit = np.sqrt(mean_z)[..., None, None]  # lengths in which the points are of size one
    q = q / unit
    z = z / np.square(unit[..., 0])
    # The slope's constraint makes D what centres z, and leaves a plain least direction
    if kind == "Taubin":
        rows = np.concatenate([(z - 1.0)[..., None] / 2.0, q], axis=-1)
        a = np.linalg.svd(rows, full_matrices=False)[2][..., -1, :]
        A = a[..., 0] / 2.0
        B = a[..., 1:]
        D = -A
    else:
        a = _least_constrained(
            np.concatenate([z[..., None], q, np.ones((*z.shape, 1))], axis=-1), kind
        )
        A = a[..., 0]
        B = a[..., 1:-1]
        D = a[..., -1]
    with np.errstate(divide="ignore", invalid="ignore"):  # a line has A = 0
        center = -B / (2.0 * A[..., None])
        radius = np.sqrt(np.maximum(np.square(B).sum(-1) - 4.0 * A * D, 0.0)) / (2.0 * np.abs(A))
        circle = np.concatenate([center, radius[..., None]], axis=-1) * unit[..., 0]
    circle[..., :-1] += origin[..., 0, :]
    return circle


def _least_constrained(rows: np.ndarray, kind: Algebraic) -> np.ndarray:
    """Return the coefficients a that minimise |rows a|² where a N a = 1, N being the constraint."""
    _, s, Vt = np.linalg.svd(rows, full_matrices=False)
    size = rows.shape[-1]
    inverse_constraint = np.zeros((size, size))
    inverse_constraint[1:-1, 1:-1] = np.eye(size - 2)
    inverse_constraint[0, -1] = inverse_constraint[-1, 0] = 0.5 if kind == "Hyper" else -0.5
    if kind == "Hyper":
        inverse_constraint[-1, -1] = -2.0
    root = np.swapaxes(Vt, -1, -2) @ (s[..., None] * Vt)
    _, vectors = np.linalg.eigh(root @ inverse_constraint @ root)
    least = vectors[..., 1]  # one eigenvalue is negative, the next is the least allowed
    weights = np.where(s[..., -1:] > 1e-12 * s[..., :1], 1.0 / np.maximum(s, 1e-300), 0.0)
    coefficients = np.einsum(
        "...ji,...j->...i", Vt, weights * np.einsum("...ij,...j->...i", Vt, least)
    )
    exact = s[..., -1:] <= 1e-12 * s[..., :1]
    return np.where(exact, Vt[..., -1, :], coefficients)
