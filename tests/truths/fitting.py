"""What is true of a run of the fitting lesson, by scipy and by differences, from the states
alone.
"""

import functools
from typing import Any

import numpy as np
import scipy

from workbench.algorithms.least_squares import Stop

FAR = 50.0


def distances(name: str, unknown: np.ndarray, p: np.ndarray) -> np.ndarray:
    """Signed distances of points from a circle, sphere or cylinder."""
    if name != "cylinder":
        return np.linalg.norm(p - unknown[:-1], axis=1) - unknown[-1]
    return (
        np.linalg.norm(np.cross(p - unknown[:3], unknown[3:6]), axis=1)
        / np.linalg.norm(unknown[3:6])
        - unknown[6]
    )


def least(state: Any) -> float:
    """The least sum of squares that scipy finds, from the truth and from the end of the lesson's
    own fit.
    """
    subject = state.subject
    starts = tuple(tuple(start) for start in (subject.truth, subject.best) if start is not None)
    return _least(subject.kind.name, subject.p.tobytes(), subject.p.shape[1], starts=starts)


@functools.lru_cache(maxsize=64)
def _least(
    name: str, points: bytes, columns: int, *, starts: tuple[tuple[float, ...], ...]
) -> float:
    p = np.frombuffer(points).reshape(-1, columns)
    solve = functools.partial(
        scipy.optimize.least_squares, x_scale="jac", xtol=1e-10, ftol=1e-10, gtol=1e-10
    )
    return min(
        2 * solve(lambda unknown: distances(name, unknown, p), start).cost for start in starts
    )


def straight(p: np.ndarray) -> float:
    """The sum of squared distances of points from the best straight line."""
    return float(np.linalg.svd(p - p.mean(axis=0), compute_uv=False)[-1] ** 2)


def cost(state: Any, unknown: np.ndarray) -> float:
    return float(np.square(distances(state.subject.kind.name, unknown, state.subject.p)).sum())


def plane_error(plane: np.ndarray) -> float:
    """RMS distance of z = 0, from -1 to 1 m on a grid, to a plane."""
    x, y = np.meshgrid(np.linspace(-1, 1, 9), np.linspace(-1, 1, 9))
    return float(np.sqrt(np.mean((plane[0] * x + plane[1] * y + plane[3]) ** 2)))


def radius_deviation(state: Any, unknown: np.ndarray) -> float:
    """The standard deviation of R by the covariance, from a Jacobian by differences in all numbers,
    redundant ones too.
    """
    name = state.subject.kind.name
    p = state.subject.p
    h = 1e-6
    J = np.column_stack(
        [
            (distances(name, unknown + h * e, p) - distances(name, unknown - h * e, p)) / (2 * h)
            for e in np.eye(len(unknown))
        ]
    )
    free = len(p) - (5 if name == "cylinder" else len(unknown))
    sigma2 = np.square(distances(name, unknown, p)).sum() / free
    return float(np.sqrt(sigma2 * np.linalg.pinv(J.T @ J, rcond=1e-10)[-1, -1]))


def wider(state: Any) -> float:
    """How many times as wide as predicted the middle 90 % of repeated radii lie."""
    spread = state.now
    low, high = np.quantile(spread.radii, [0.05, 0.95])
    return float((high - low) / (2 * 1.6448536 * np.sqrt(spread.covariance[-1, -1])))


def is_right(state: Any) -> bool | None:
    """Whether what a state shows is right, wrong, or not claimed to be either."""
    result = state.now
    match type(result).__name__:
        case "Walked":
            if result.now.stop is None or state.subject.best is None:
                return None
            if result.now.stop in (Stop.SINGULAR, Stop.DIVERGED):
                return False
            is_least = cost(state, result.now.unknown) <= 1.0011 * least(state)
            return None if is_least and abs(result.now.unknown[-1]) > FAR else bool(is_least)
        case "Spread":
            if len(result.radii) <= 100:
                return None
            low = abs(result.unknown[-1]) - 1.6449 * radius_deviation(state, result.unknown)
            return bool(1 / 1.5 <= wider(state) <= 1.5 and low >= 0)
        case "Trusted":
            if not result.last or state.subject.truth is None:
                return None
            return plane_error(result.now.estimate) < max(state.params.noise, 0.005)
    return None
