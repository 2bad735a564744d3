"""Verdicts that many exercises need; they know numpy only.

So what judges an answer is independent of the functions that made the right one.
"""

from collections.abc import Iterable
from typing import Any

import numpy as np

from workbench.exercise.candidate import Candidate
from workbench.exercise.model import Function, Verdict, against, band, fail, full, number, partial
from workbench.exercise.student import StudentError

SKEWED = 1e-5  # how far R^T R may be from the identity: rounding, also of single precision


def worst(verdicts: Iterable[Verdict]) -> Verdict:
    """Return the verdict that earns least; the first of those where several do."""
    return min(verdicts, key=lambda verdict: verdict.share)


def rotation_verdict(
    R: np.ndarray,
    R_right: np.ndarray,
    hint: str,
    *,
    good: float = 0.1,
    fair: float = 2.0,
    name: str = "R",
) -> Verdict:
    """Judge a rotation by the angle to the right one, degrees; no rotation earns nothing."""
    hint = beside(R, R_right, hint, name)
    off = float(np.abs(R.T @ R - np.eye(3)).max())
    det = float(np.linalg.det(R))
    if off > SKEWED or det < 0:
        if off <= SKEWED:
            return fail(f"{name} mirrors: its determinant is {number(det, 3)}, right is 1. {hint}")
        told = f", its determinant is {against(det, 1.0, 3)}" if abs(det - 1.0) > SKEWED else ""
        return fail(
            f"{name} is no rotation: R^T R differs from the identity by {number(off, 2)}{told}."
            f" {hint}"
        )
    return band(
        "Rotation error", degrees_between(R, R_right), "degrees", good=good, fair=fair, hint=hint
    )


def motion_verdict(
    T: np.ndarray,
    T_right: np.ndarray,
    hint: str,
    *,
    p: np.ndarray | None = None,
    degrees: tuple[float, float] = (0.1, 2.0),
    metres: tuple[float, float] = (1e-3, 2e-2),
    name: str = "T",
) -> Verdict:
    """Judge a motion by its rotation error and by how far it takes points from where they belong.

    Args:
        p: The points, in metres; the origin where they are not given.
        degrees: Up to where all, and up to where half the points are earned.
        metres: The same for the largest distance.
    """
    off = float(np.abs(T[3] - [0.0, 0.0, 0.0, 1.0]).max())
    if off > SKEWED:
        return fail(f"The last row of {name} is {number(T[3])}, right is (0, 0, 0, 1). {hint}")
    turned = rotation_verdict(
        T[:3, :3], T_right[:3, :3], hint, good=degrees[0], fair=degrees[1], name=name
    )
    p = np.zeros((1, 3)) if p is None else p
    away = np.linalg.norm(p @ (T - T_right)[:3, :3].T + (T - T_right)[:3, 3], axis=1).max()
    told = beside(
        T[:3, 3],
        T_right[:3, 3],
        hint,
        "The rotation is right; the last column" if turned.share == 1 else "t",
    )
    moved = band("Position error", float(away), "m", good=metres[0], fair=metres[1], hint=told)
    if turned.share == moved.share == 1.0:
        return full(f"{turned.message} {moved.message}")
    return worst((turned, moved))


def degrees_between(R: np.ndarray, other: np.ndarray) -> float:
    """Return the angle between two rotations in degrees, exact at both ends."""
    D = R.T @ other
    sine = np.linalg.norm([D[2, 1] - D[1, 2], D[0, 2] - D[2, 0], D[1, 0] - D[0, 1]])
    return float(np.degrees(np.arctan2(sine, np.trace(D) - 1.0)))


def refused(candidate: Function, *args: Any, what: str) -> Verdict:
    """Judge a call that asks for a ValueError: all for one, half for another error."""
    try:
        value = candidate(*args)
    except StudentError as error:
        if "ValueError" in error.errors:
            return full(f"{what} is refused with a ValueError.")
        if error.error in ("", "NotImplementedError") or "ImportError" in error.errors:
            raise  # the function did not come to look at what it was given
        return partial(0.5, f"{what} raised {error.error}; the contract asks for a ValueError.")
    answer = "nothing" if value is None else f"an answer ({_short(value)})"
    return fail(f"{what} gave {answer}; the contract asks for `raise ValueError`.")


def left_alone(candidate: Function, verdict: Verdict) -> Verdict:
    """Return the verdict on the last call's answer, or that the call changed its arguments.

    The check that returns this one fails too where any call of another check changed them.
    """
    if isinstance(candidate, Candidate):
        candidate.looks_at_inputs = True
        if candidate.changing:
            return changed(candidate.changing[0])
    if verdict.share < 1.0:
        return fail(f"The inputs are as they were, but the answer is not right. {verdict.message}")
    return full("The inputs are as they were.")


def changed(args: tuple[Any, ...]) -> Verdict:
    """Return the failure to leave these arguments as they were."""
    arrays = [
        arg.ravel() for arg in args if isinstance(arg, np.ndarray) and arg.dtype.kind in "biuf"
    ]
    values = np.concatenate(arrays) if arrays else np.zeros(0)
    with np.errstate(invalid="ignore"):
        if np.isnan(values).any():
            detail = " with nan in it"
        elif np.isinf(values).any():
            detail = " with inf in it"
        elif any(array.size == 0 for array in arrays):
            detail = " without entries"
        else:
            detail = ""
    return fail(
        f"Your function changed an array{detail} that it was given. Work on a copy: a /= b writes"
        " into a, a = a / b not."
    )


def beside(got: Any, right: Any, hint: str, name: str = "") -> str:  # noqa: PLR0917
    """Return the hint behind the two numbers, yours and right, where an answer is farthest off.

    Of points in rows the whole row is told.
    """
    got, right = np.asarray(got, dtype=float), np.asarray(right, dtype=float)
    if got.shape != right.shape or got.size == 0:
        return hint
    with np.errstate(invalid="ignore"):
        off = np.abs(got - right)
    off = np.where(np.isnan(off), np.where(np.isnan(got) == np.isnan(right), 0.0, np.inf), off)
    if not off.any():
        return hint  # what is wrong is something else
    row = int(np.argmax(off.reshape(len(off), -1).max(axis=1))) if off.ndim else 0
    at = tuple(int(i) for i in np.unravel_index(int(np.argmax(off)), off.shape))
    where = f"{name}[{', '.join(map(str, at))}]"
    if right.ndim == 2 and right.shape[1] <= 3 and right.shape[0] != right.shape[1]:
        at = (row,)
        where = f"{name}[{row}]" if name else f"Row {row}"
    elif right.ndim == 0 or (right.ndim == 1 and right.size <= 4):
        at = ()
        where = name or "Yours"
    return f"{where} is {against(got[at], right[at])}. {hint}"


def _short(value: Any) -> str:
    text = " ".join(np.array2string(np.asarray(value), precision=3, threshold=12).split())
    return text if len(text) <= 80 else text[:77] + "..."
