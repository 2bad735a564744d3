"""Drawings that stand upright in space: points (x, y) of a plane as (x, depth, y), seen from +y.

A turn that is positive is counterclockwise in the plane, and to the right for an eye on +y: there a
drawing turns the way its mark moves on a chart.
"""

import numpy as np
from jaxtyping import Float

from workbench.geometry.polylines import segments

Flat = Float[np.ndarray, "n 2"]


def upright(p: Flat, depth: float = 0.0) -> Float[np.ndarray, "n 3"]:
    """Return points of a drawing in space, metres.

    Args:
        p: The points, metres.
        depth: How much nearer to the eye than the plane through the origin.

    Examples:
        >>> upright(np.array([[1.0, 2.0]]), 0.5).tolist()
        [[1.0, 0.5, 2.0]]
    """
    return np.column_stack([p[:, 0], np.full(len(p), depth), p[:, 1]])


def upright_turn(degrees: float) -> Float[np.ndarray, "4 4"]:
    """Return the motion that turns a drawing that stands upright, counterclockwise in its plane.

    Examples:
        >>> (upright_turn(90.0) @ [1.0, 0.0, 0.0, 1.0]).round(12).tolist()
        [0.0, 0.0, 1.0, 1.0]
    """
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    T = np.eye(4)
    T[[0, 0, 2, 2], [0, 2, 0, 2]] = c, -s, s, c
    return T


def outlined(p: Flat, depth: float = 0.0) -> Float[np.ndarray, "n 2 3"]:
    """Return the segments of a closed line that stands upright."""
    return segments(upright(p, depth), closed=True)


def on_dial(degrees: np.ndarray, radius: float) -> Float[np.ndarray, "n 2"]:
    """Return places on a circle about the origin: 0 is at the top, positive counterclockwise.

    Examples:
        >>> on_dial(np.array([0.0, 90.0]), 2.0).round(12).tolist()
        [[0.0, 2.0], [-2.0, 0.0]]
    """
    a = np.radians(90.0 + np.asarray(degrees, dtype=float))
    return radius * np.column_stack([np.cos(a), np.sin(a)])


def dial_arc(
    low: float, high: float, radius: float, *, depth: float = 0.0, every: float = 3.0
) -> Float[np.ndarray, "n 2 3"]:
    """Return the segments of an arc of a dial that stands upright, from one angle to another.

    Args:
        low: Where it begins, degrees.
        high: Where it ends, degrees.
        radius: Of the circle, metres.
        depth: How much nearer to the eye.
        every: The longest piece, degrees.
    """
    pieces = max(1, int(np.ceil(abs(high - low) / every)))
    return segments(upright(on_dial(np.linspace(low, high, pieces + 1), radius), depth))
