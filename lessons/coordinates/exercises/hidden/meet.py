"""What meet is graded by besides the checks that a student sees."""

import numpy as np

from lessons.coordinates.exercises import GRADERS, numbers, row_by_row
from lessons.coordinates.exercises.meet import HINT, judged, lines
from workbench.exercise import Function, Verdict, check, worst


@check(2, public=False)
def nearly_parallel(candidate: Function) -> Verdict:
    """Lines a millionth of a degree from parallel meet far away, and in the plane."""
    angle = np.radians(np.array([1.0, 1e-3, 1e-6, 0.0]))
    a = np.tile([0.0, 1.0, 0.0], (4, 1))
    b = np.column_stack([np.sin(angle), np.cos(angle), -2 * np.cos(angle)])
    return judged(candidate, a, b, f"Nearly parallel. {HINT}")


@check(2, public=False)
def other_lines(candidate: Function) -> Verdict:
    """Other lines meet too, and so do single ones, and lines of very small or very large
    numbers.
    """
    pair = lines(GRADERS() + 1, 1)
    a, b = lines(GRADERS(), 12)
    verdict = judged(candidate, *pair)
    if verdict.share < 1.0:
        return verdict
    scaled = [
        judged(candidate, factor * a, factor * b, f"Any scale is right. {HINT}")
        for factor in (2e-5, 1e7)
    ]
    return worst((judged(candidate, a, b), *scaled))


@check(1, public=False)
def one_line_twice(candidate: Function) -> Verdict:
    """A line and itself, also at another scale, give (0, 0, 0)."""
    a = np.array([[1.0, 2, 3], [0.0, 1, 0], [1.0, 0, -2]])
    got = candidate(a, a * [[1.0], [-2.0], [4.0]])
    off = np.abs(got).max(axis=1)
    asked = [f"The line {numbers(row)} and itself" for row in a]
    return row_by_row(asked, got, np.zeros((3, 3)), off, HINT, good=1e-9, fair=1e-9)
