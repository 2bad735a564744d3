"""The exercises of this lesson: a rotation of six numbers, the gradient of Chamfer, and how much
samples of a ray count.
"""

import numpy as np

from workbench.exercise import HiddenSeed, Verdict, against, fail, full, partial

# seeds of what a student sees run, and of what only a grader does
STUDENTS = 61
GRADERS = HiddenSeed(9203)


def entries_verdict(got: np.ndarray, right: np.ndarray, hint: str, case: str = "") -> Verdict:
    """Judge numbers by the farthest off, relative to the largest: all points up to 1e-6, half up to
    1e-3.

    Args:
        got: The answer.
        right: The right one, of the same shape.
        hint: What to look at where it is wrong.
        case: How the message begins: the case.
    """
    if not right.size:
        return full(f"{case}nothing went in, and nothing came out.")
    size = max(float(np.abs(right).max()), 1e-12)
    off = np.where(np.isfinite(got), np.abs(got - right), np.inf) / size
    if off.max() <= 1e-6:
        return full(f"{case}all {got.size} numbers are right.")
    i = np.unravel_index(int(np.argmax(off)), off.shape)
    place = ", ".join(str(int(k)) for k in i)
    wrong = int((off > 1e-6).sum())
    message = (
        f"{case}{wrong} of {got.size} numbers are wrong: [{place}] is {against(got[i], right[i])}."
    )
    return (
        partial(0.5, f"{message} Close. {hint}") if off.max() <= 1e-3 else fail(f"{message} {hint}")
    )
