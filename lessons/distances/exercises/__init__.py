"""The exercises of this lesson: Mahalanobis' distance, Dijkstra, and the update of fast
marching.
"""

import numpy as np

from workbench.exercise import HiddenSeed, Verdict, against, fail, full, partial

# seeds of what a student sees run, and of what only a grader does
STUDENTS = 23
GRADERS = HiddenSeed(7019)


def values_verdict(
    got: np.ndarray, right: np.ndarray, hint: str, label: str = "", *, fair: float = 1e-3
) -> Verdict:
    """Judge numbers by the one that is farthest off, relative to its size: all points up to 1e-6,
    half up to `fair`.

    Args:
        got: The answer.
        right: The right one, of the same shape; inf where inf is right.
        hint: What to look at where it is wrong.
        label: How the message begins: the case.
        fair: The error up to which half of the points are earned.
    """
    both = np.isinf(right) & (got == right)
    size = np.maximum(np.abs(np.where(np.isfinite(right), right, 1.0)), 1.0)
    difference = np.abs(np.where(both, 0.0, got) - np.where(both, 0.0, right))
    off = np.where(np.isfinite(difference), difference / size, np.inf)
    if not off.size or off.max() <= 1e-6:
        return full(f"{label}all {got.size} values are right.")
    i = int(np.argmax(off))
    wrong = int((off > 1e-6).sum())
    message = (
        f"{label}{wrong} of {got.size} values are wrong: [{i}] is {against(got[i], right[i])}."
    )
    return (
        partial(0.5, f"{message} Close. {hint}") if off.max() <= fair else fail(f"{message} {hint}")
    )
