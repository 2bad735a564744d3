"""Iterative closest point in the plane where a turn is all that is missing, so that its cost is a
curve.

Both lines lie about their common middle. Angles are degrees, counterclockwise; a cost is the root
mean square distance (RMSE) from each source point to its partner, in metres.

References: Besl and McKay, A method for registration of 3-D shapes, 1992, section IV.B; Chen and
Medioni, Object modelling by registration of multiple range images, 1992 (distances to lines).
"""

import bisect
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Literal

import numpy as np
import scipy
from jaxtyping import Float, Int

from workbench.algorithms.registration.icp import Stop
from workbench.geometry.points.metrics import rms

Flat = Float[np.ndarray, "n 2"]
Partners = Int[np.ndarray, "n"]

STRIDE = 6
"""Starts from one that `basin` tries to the next, until one does not come home."""


@dataclass(frozen=True, eq=False)
class State:
    """One sub-step: after `match` the partners are new, after `fit` the angle is.

    Attributes:
        phase: Which of the two just happened.
        iteration: Counted from 1.
        angle: Of the source now, degrees; it goes on beyond 180.
        partners: The target point of each source point; after `fit` those that the fit used.
        turned: By how much the last fit turned the source, degrees; 0 before the first.
        rmse: From the source points to these partners, metres.
        stop: Why this is the last state, or None.
    """

    phase: Literal["match", "fit"]
    iteration: int
    angle: float
    partners: Partners
    turned: float
    rmse: float
    stop: Stop | None = None


def turned(p: Flat, degrees: float) -> Flat:
    """Return points turned counterclockwise about the origin.

    Examples:
        >>> turned(np.array([[1.0, 0.0]]), 90.0).round(12).tolist()
        [[0.0, 1.0]]
    """
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    return p @ np.array([[c, s], [-s, c]])


def within_half(degrees: float) -> float:
    """Return the same direction as an angle above -180 and up to 180 degrees.

    Examples:
        >>> within_half(190.0), within_half(-180.0)
        (-170.0, 180.0)
    """
    return 180.0 - (180.0 - degrees) % 360.0


def nearest(p_target: Float[np.ndarray, "m 2"], p: Flat) -> Partners:
    """Return for each point the index of the nearest target point."""
    return scipy.spatial.distance.cdist(p, p_target, "sqeuclidean").argmin(axis=1).astype(np.intp)


def cost(p_target: Float[np.ndarray, "m 2"], p_source: Flat, degrees: float) -> float:
    """Return the RMSE to the nearest target points with the source turned by so much."""
    p = turned(p_source, degrees)
    return rms(np.linalg.norm(p - p_target[nearest(p_target, p)], axis=1))


def cost_of_pairs(p_match: Flat, p_source: Flat, degrees: float | np.ndarray) -> np.ndarray:
    """Return the RMSE of fixed pairs at angles: the root of a - b cos(angle - best).

    Args:
        p_match: The partner of each source point.
        p_source: The source points before they turn.
        degrees: One angle or many.

    Examples:
        >>> p = np.array([[1.0, 0.0], [-1.0, 0.0]])
        >>> cost_of_pairs(p, p, np.array([0.0, 60.0, 180.0])).round(12).tolist()
        [0.0, 1.0, 2.0]
    """
    sizes = float(np.mean(np.sum(p_match**2 + p_source**2, axis=1)))
    along, across = _pull(p_match, p_source)
    a = np.radians(degrees)
    square = sizes - 2.0 * (along * np.cos(a) + across * np.sin(a))
    return np.asarray(np.sqrt(np.maximum(square, 0.0)))


def best_turn(p_match: Flat, p_source: Flat) -> float:
    """Return the angle at which the RMSE of fixed pairs is least, degrees within (-180, 180].

    Examples:
        >>> p = np.array([[1.0, 0.0], [0.0, 2.0]])
        >>> round(best_turn(turned(p, 40.0), p), 9)
        40.0
    """
    along, across = _pull(p_match, p_source)
    return float(np.degrees(np.arctan2(across, along)))


def turn_along_lines(p_match: Flat, p: Flat, n_match: Flat) -> float:
    """Return the turn, degrees, that brings points nearest to lines through their partners.

    To first order a small turn w moves p by w times p turned by 90 degrees; the sum of the squared
    distances along the normals is least for this w.

    Args:
        p_match: The partner of each point.
        p: The points where they stand now.
        n_match: Unit normals at the partners.
    """
    lever = p[:, 0] * n_match[:, 1] - p[:, 1] * n_match[:, 0]
    gap = np.einsum("ij,ij->i", p_match - p, n_match)
    return float(np.degrees((lever * gap).sum() / (lever**2).sum()))


def icp_turn(
    p_target: Float[np.ndarray, "m 2"],
    p_source: Flat,
    start: float,
    *,
    n_target: Float[np.ndarray, "m 2"] | None = None,
    max_iterations: int = 100,
    tolerance: float = 0.05,
) -> Iterator[State]:
    """Yield the states of ICP that turns the source and never shifts it, from a start to a stop.

    Args:
        p_target: The line that stays, about the middle, metres.
        p_source: The line to be turned, about the same middle.
        start: Its angle at the start, degrees.
        n_target: Unit normals of the target. With them a fit uses lines, without them points.
        max_iterations: Match and fit at most this often.
        tolerance: Converged when a fit turns by no more, degrees.

    Note:
        Without normals no sub-step raises the RMSE: `cost` falls to the bottom of a valley.
    """
    angle = float(start)
    by = 0.0
    last_seen: dict[bytes, int] = {}
    for iteration in range(1, max_iterations + 1):
        p = turned(p_source, angle)
        partners = nearest(p_target, p)
        q = p_target[partners]
        yield State("match", iteration, angle, partners, by, rms(np.linalg.norm(p - q, axis=1)))
        by = (
            within_half(best_turn(q, p_source) - angle)
            if n_target is None
            else turn_along_lines(q, p, n_target[partners])
        )
        angle += by
        stop = Stop.MAX_ITERATIONS if iteration == max_iterations else None
        key = partners.tobytes()
        if abs(by) <= tolerance:
            stop = Stop.CONVERGED
        elif last_seen.get(key, iteration) < iteration - 1:
            stop = Stop.CIRCLING
        last_seen[key] = iteration
        left = rms(np.linalg.norm(turned(p_source, angle) - q, axis=1))
        yield State("fit", iteration, angle, partners, by, left, stop)
        if stop:
            return


def basin(
    end_of: Callable[[float], float], *, within: float = 5.0, step: float = 1.0
) -> tuple[float, float]:
    """Return the lowest and the highest start, around 0, from which a run ends at 0, degrees.

    To either side every sixth start is tried until one does not come home, and the edge before it
    is found by halving: a gap of fewer than six starts can be missed.

    Args:
        end_of: Gives the end of a run by its start, both degrees.
        within: How near to 0 an end counts as there.
        step: Between the starts that are told apart.
    """

    def elsewhere(start: float) -> bool:
        return abs(within_half(end_of(start))) > within

    ends = []
    for outwards in (-step, step):
        starts = outwards * np.arange(180.0 // step + 1.0)  # the first, 0, is home
        tried = range(STRIDE, len(starts), STRIDE)
        away = next((k for k in tried if elsewhere(starts[k])), len(starts))
        home = (away - 1) // STRIDE * STRIDE
        last = bisect.bisect_left(starts, True, lo=home + 1, hi=away, key=elsewhere) - 1
        ends.append(float(starts[last]))
    return ends[0], ends[1]


def _pull(p_match: np.ndarray, p_source: np.ndarray) -> tuple[float, float]:
    """Return the mean of the products along and across: how strongly pairs hold, and turn."""
    (x, y), (u, v) = p_source.T, p_match.T
    n = len(p_source)
    return float((u * x + v * y).sum()) / n, float((x * v - y * u).sum()) / n
