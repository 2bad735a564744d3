"""Verdicts that many exercises need: the worst of several, motions in degrees and metres, errors asked for, inputs kept.

They know numpy only, so that what judges an answer is independent of the functions that made the right one.
"""

from collections.abc import Iterable
from typing import Any

import numpy as np

from workbench.exercise.candidate import Candidate
from workbench.exercise.model import Function, Verdict, band, fail, full, partial
from workbench.exercise.sandbox import StudentError

SKEWED = 1e-5  # how far R^T R may be from the identity: rounding, also of single precision


def worst(verdicts: Iterable[Verdict]) -> Verdict:
    """Return the verdict that earns least; the first of those where several do."""
    return min(verdicts, key=lambda verdict: verdict.share)


def rotation_verdict(R: np.ndarray, R_right: np.ndarray, hint: str, *, good: float = 0.1, fair: float = 2.0) -> Verdict:
    """Judge a rotation by the angle to the right one, in degrees; what is no rotation earns nothing."""
    off, det = float(np.abs(R.T @ R - np.eye(3)).max()), float(np.linalg.det(R))
    if off > SKEWED or det < 0:
        return fail(
            f"This is no rotation: R^T R differs from the identity by {off:.2g}, its determinant is {det:.3g}. {hint}"
        )
    return band("Rotation error", degrees_between(R, R_right), "degrees", good=good, fair=fair, hint=hint)


def motion_verdict(
    T: np.ndarray,
    T_right: np.ndarray,
    hint: str,
    *,
    p: np.ndarray | None = None,
    degrees: tuple[float, float] = (0.1, 2.0),
    metres: tuple[float, float] = (1e-3, 2e-2),
) -> Verdict:
    """Judge a motion by its rotation error in degrees and by how far it takes points from where they belong.

    Args:
        T: The answer.
        T_right: The right one.
        hint: What to look at where it is wrong.
        p: The points, in metres; the origin where they are not given.
        degrees: Up to where all, and up to where half the points are earned.
        metres: The same for the largest distance.
    """
    off = float(np.abs(T[3] - [0.0, 0.0, 0.0, 1.0]).max())
    if off > SKEWED:
        return fail(f"The last row of a motion is (0, 0, 0, 1), yours is off by {off:.3g}. {hint}")
    turned = rotation_verdict(T[:3, :3], T_right[:3, :3], hint, good=degrees[0], fair=degrees[1])
    p = np.zeros((1, 3)) if p is None else p
    away = np.linalg.norm(p @ (T - T_right)[:3, :3].T + (T - T_right)[:3, 3], axis=1).max()
    moved = band("Position error", float(away), "m", good=metres[0], fair=metres[1], hint=hint)
    if turned.share == moved.share == 1.0:
        return full(f"{turned.message} {moved.message}")
    return worst((turned, moved))


def degrees_between(R: np.ndarray, other: np.ndarray) -> float:
    """Return the angle between two rotations in degrees, exact at both ends."""
    D = R.T @ other
    sine = np.linalg.norm([D[2, 1] - D[1, 2], D[0, 2] - D[2, 0], D[1, 0] - D[0, 1]])
    return float(np.degrees(np.arctan2(sine, np.trace(D) - 1.0)))


def refused(candidate: Function, *args: Any, what: str) -> Verdict:
    """Judge a call on which the contract asks for a ValueError: all for one, half for an error of another name."""
    try:
        value = candidate(*args)
    except StudentError as error:
        if "ValueError" in error.errors:
            return full(f"{what} is refused with a ValueError.")
        if error.error in ("", "NotImplementedError"):
            raise
        return partial(0.5, f"{what} raised {error.error}; the contract asks for a ValueError.")
    said = "nothing" if value is None else f"an answer ({_short(value)})"
    return fail(f"{what} gave {said}; the contract asks for `raise ValueError`.")


def left_alone(candidate: Function, verdict: Verdict) -> Verdict:
    """Return the verdict on the last call's answer, or the failure to leave the arguments as they were."""
    if isinstance(candidate, Candidate) and candidate.changed_inputs:
        return fail(
            "Your function changed an array that it was given. Work on a copy: a /= b writes into a, a = a / b not."
        )
    if verdict.share < 1.0:
        return fail(f"The inputs are as they were, but the answer is not right. {verdict.message}")
    return full("The inputs are as they were.")


def _short(value: Any) -> str:
    text = " ".join(np.array2string(np.asarray(value), precision=3, threshold=12).split())
    return text if len(text) <= 80 else text[:77] + "..."
