"""The exercises of this lesson: the distance to a box, a Bézier patch, and where a field changes
sign.
"""

from collections.abc import Callable

import numpy as np

from workbench.exercise import HiddenSeed, Verdict, fail, full, partial

# seeds of what a student sees run, and of what only a grader does
STUDENTS = 61
GRADERS = HiddenSeed(5179)


def rows_verdict(
    got: np.ndarray,
    right: np.ndarray,
    label: Callable[[int], str],
    hint: str,
    *,
    good: float = 1e-6,
    fair: float = 1e-3,
) -> Verdict:
    """Judge numbers or points row by row, by the one that is farthest off, m, and say what came and
    what is right.

    Args:
        got: The answer.
        right: The right one.
        label: Says what a row is, as a message begins.
        hint: What to look at where it is wrong.
        good: Metres up to which all points are earned.
        fair: The same for half of them.
    """
    if not len(right):
        return full("Nothing came in, nothing came out.")
    off = np.abs(got - right).reshape(len(right), -1)
    off = np.where(np.isfinite(off), off, np.inf).max(axis=1)
    k = int(off.argmax())
    message = f"{label(k)}: {written(got[k])}, right is {written(right[k])}"
    if off[k] <= good:
        return full(f"{message}.")
    return (
        partial(0.5, f"{message}: close. {hint}") if off[k] <= fair else fail(f"{message}. {hint}")
    )


def written(value: np.ndarray) -> str:
    """Write a number or a point."""
    numbers = [f"{entry:.4g}" for entry in np.atleast_1d(value)]
    return numbers[0] if len(numbers) == 1 else f"({', '.join(numbers)})"
