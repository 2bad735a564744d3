"""What constraint_rows is graded by besides the checks that a student sees."""

from lessons.calibration.exercises import GRADERS, views
from lessons.calibration.exercises.constraint_rows import found, scaled
from workbench.exercise import Function, Verdict, check, worst


@check(2, public=False)
def other_homographies(candidate: Function) -> Verdict:
    """For other homographies, of any scale and sign, all entries are right: not scaled."""
    cases = [H for _, H in views(GRADERS(), 4)]
    return worst(found(candidate, H) for H in (*cases, 1e-5 * cases[0], -1e5 * cases[1]))


@check(2, public=False)
def rows_of_other_views(candidate: Function) -> Verdict:
    """For other pictures of a board all entries are right, so that the camera comes out."""
    return worst(found(candidate, scaled(H)) for _, H in views(GRADERS() + 1, 3))
