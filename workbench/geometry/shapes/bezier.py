"""Bezier patches, polynomial or rational, by Bernstein polynomials or de Casteljau's halving.

A rational patch is a polynomial one in homogeneous coordinates (w x, w y, w z, w), divided by its
last.
Reference: Farin, Curves and Surfaces for CAGD, 5th ed., 2002: 4.1 (de Casteljau), 5.4 (degree
elevation), 12.1 (conics), 14.1 (patches). Piegl and Tiller, The NURBS Book, 2nd ed., 1997, 7.5
(circles) and 8.3 (surfaces of revolution).
"""

from math import comb

import numpy as np
from jaxtyping import Float


def bernstein(degree: int, t: Float[np.ndarray, " n"]) -> Float[np.ndarray, "n k"]:
    """Return the Bernstein polynomials of a degree at t: one row per t, which adds up to 1.

    Examples:
        >>> bernstein(2, np.array([0.5])).tolist()
        [[0.25, 0.5, 0.25]]
    """
    k = np.arange(degree + 1)
    return (
        np.array([comb(degree, i) for i in k]) * t[:, None] ** k * (1 - t[:, None]) ** (degree - k)
    )


def bezier_patch(
    control: Float[np.ndarray, "4 4 3"], uv: Float[np.ndarray, "n 2"]
) -> Float[np.ndarray, "n 3"]:
    """Return points, m, of a bicubic patch: sum over i, j of B_i(u) B_j(v) control[i, j]."""
    u, v = uv.T
    return np.einsum("ni,nj,ijx->nx", bernstein(3, u), bernstein(3, v), control)


def de_casteljau(
    control: Float[np.ndarray, "k d"], t: float
) -> tuple[Float[np.ndarray, "_ d"], ...]:
    """Return the control points of a curve, those that divide their legs at t, and so on to one.

    Examples:
        >>> [len(row) for row in de_casteljau(np.eye(4), 0.3)]
        [4, 3, 2, 1]
    """
    rows = [control]
    while len(rows[-1]) > 1:
        rows.append((1 - t) * rows[-1][:-1] + t * rows[-1][1:])
    return tuple(rows)


def raised(control: Float[np.ndarray, "3 ..."]) -> Float[np.ndarray, "4 ..."]:
    """Return the cubic's four control points for the curve of a quadratic's three (Farin, 5.4)."""
    a, b, c = control
    return np.stack([a, (a + 2 * b) / 3, (2 * b + c) / 3, c])


def raised_patch(control: Float[np.ndarray, "3 3 d"]) -> Float[np.ndarray, "4 4 d"]:
    """Return the control net of the bicubic patch that is the same surface as a biquadratic one."""
    return raised(raised(control).swapaxes(0, 1)).swapaxes(0, 1)


def quarter_circles(rational: bool) -> Float[np.ndarray, "4 k 3"]:
    """Return the unit circle as four arcs, each some control points (w x, w y, w).

    Rational arcs are quadratic and exact, the others cubic and right at ends and middle.
    """
    if rational:
        w = np.sqrt(0.5)
        first = np.array([[1.0, 0, 1], [w, w, w], [0, 1, 1]])
    else:
        leg = 4 / 3 * (np.sqrt(2) - 1)
        first = np.array([[1.0, 0, 1], [1, leg, 1], [leg, 1, 1], [0, 1, 1]])
    turn = np.array([[0.0, 1, 0], [-1, 0, 0], [0, 0, 1]])
    arcs = [first]
    for _ in range(3):
        arcs.append(arcs[-1] @ turn)
    return np.stack(arcs)


def torus_patches(ring: float, tube: float, rational: bool) -> Float[np.ndarray, "16 k k 4"]:
    """Return a torus as 16 patches (w x, w y, w z, w): u goes around z, v around the tube.

    Rational patches are exact and biquadratic, others bicubic.
    """
    arcs = quarter_circles(rational)
    patches = []
    for around in arcs:
        for across in arcs:
            out = ring * across[:, 2] + tube * across[:, 0]
            patches.append(
                np.stack(
                    [
                        around[:, :1] * out,
                        around[:, 1:2] * out,
                        around[:, 2:] * (tube * across[:, 1]),
                        around[:, 2:] * across[:, 2],
                    ],
                    axis=-1,
                )
            )
    return np.stack(patches)
