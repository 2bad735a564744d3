"""The exercises of this lesson: coordinates of points, meetings of lines, ways on a sphere."""

from collections.abc import Sequence

import numpy as np

from workbench.exercise import HiddenSeed, Verdict, against, fail, full, partial
from workbench.numerals import brief

# seeds of what a student sees run, and of what only a grader does
STUDENTS = 61
GRADERS = HiddenSeed(8410)


def numbers(values: np.ndarray) -> str:
    """Write some numbers of an answer in brackets: small ones with their digits, what is none by
    its name.
    """
    return f"({', '.join(one(float(value)) for value in np.atleast_1d(values))})"


def one(value: float) -> str:
    """Write a number of an answer, very small ones in billionths."""
    if not np.isfinite(value):
        return f"{value:g}".replace("-", "−")
    return f"{brief(1e9 * value)} billionths" if 0 < abs(value) < 1e-4 else brief(value, 5)


def told(got: np.ndarray, right: np.ndarray) -> str:
    """Write an answer and the right one, with more digits where these few would not tell them
    apart.
    """
    yours, wanted = numbers(got), numbers(right)
    return (
        against(np.atleast_1d(got), np.atleast_1d(right), 5)
        if yours == wanted
        else f"{yours}, right is {wanted}"
    )


def row_by_row(
    asked: Sequence[str],
    got: np.ndarray,
    right: np.ndarray,
    off: np.ndarray,
    hint: str,
    *,
    good: float,
    fair: float,
) -> Verdict:
    """Judge the row that is farthest off, or is no number at all, and say what was asked, what came
    and what is right.

    Args:
        asked: What the call was, row by row, in words.
        got: The answer, a row or a number each.
        right: The right one.
        off: How far each row is off.
        hint: What to look at.
        good: Up to where all points are earned.
        fair: Up to where half of them are.
    """
    worst = int(np.argmax(np.where(np.isfinite(off), off, np.inf)))
    message = f"{asked[worst]}: your answer is {told(got[worst], right[worst])}."
    if off[worst] <= good:
        return full(f"All {len(off)} are right. The last: {asked[-1]}.")
    return (
        partial(0.5, f"Close. {message} {hint}")
        if off[worst] <= fair
        else fail(f"{message} {hint}")
    )
