"""The exercises of this lesson: a circle's linear problem, the damped step, Huber's weights."""

import numpy as np

from workbench.exercise import HiddenSeed, Verdict, against, band, fail

# seeds of what a student sees run, and of what only a grader does
STUDENTS = 71
GRADERS = HiddenSeed(8610)


def entries(
    label: str,
    got: np.ndarray,
    right: np.ndarray,
    hint: str,
    *,
    good: float = 1e-6,
    fair: float = 1e-3,
) -> Verdict:
    """Judge numbers by the one that is farthest off, as a share of the largest right one, and say
    which it is.

    Args:
        label: What the numbers are.
        got: The answer.
        right: The right one.
        hint: What to look at.
        good: Up to where all points are earned.
        fair: Up to where half of them are.
    """
    size = float(np.abs(right).max()) or 1.0
    off = np.abs(got - right)
    at = np.unravel_index(int(np.argmax(np.where(np.isfinite(off), off, np.inf))), off.shape)
    where = ", ".join(str(int(k)) for k in at)
    entry = f"Entry [{where}] is {against(float(got[at]), float(right[at]), 4)}."
    if not np.isfinite(off[at]):
        return fail(f"{label}: {entry} {hint}")
    return band(
        f"{label}: off by a share of",
        float(off[at]) / size,
        "",
        good=good,
        fair=fair,
        hint=f"{entry} {hint}",
    )
