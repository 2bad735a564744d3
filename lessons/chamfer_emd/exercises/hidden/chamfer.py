"""What chamfer is graded by besides the checks that a student sees."""

import numpy as np

from lessons.chamfer_emd.exercises import (
    GRADERS,
    no_points_refused,
    reordered,
    two_clouds,
)
from lessons.chamfer_emd.exercises.chamfer import CHAMFER_HINT, chamfer_found
from lessons.chamfer_emd.exercises.hidden import same_when_moved
from workbench.exercise import Function, Verdict, check, worst
from workbench.geometry.points import shape_distances


@check(2, public=False)
def uneven_clouds(candidate: Function) -> Verdict:
    """A side with few points weighs as much as one with many: 5 and 200 points, 1 and 30, 1 and
    1.
    """
    sizes = ((5, 200), (200, 5), (1, 30), (1, 1))
    return worst(
        chamfer_found(candidate, *two_clouds(GRADERS() + 30 + k, n, m), f"{n} and {m} points: ")
        for k, (n, m) in enumerate(sizes)
    )


@check(2, public=False)
def the_same_points(candidate: Function) -> Verdict:
    """Equal points are 0 apart, in any order, some of them twice; a missing half is not 0; what is
    twice counts twice.
    """
    p, _ = two_clouds(GRADERS() + 40, 50, 1)
    more = reordered(GRADERS(), np.vstack([p, p[:20]]))
    half = p[p[:, 0] < 0]
    return worst(
        (
            chamfer_found(candidate, p, more, "Equal points: "),
            chamfer_found(candidate, p, half, "Half missing in b: "),
            chamfer_found(candidate, half, p, "Half missing in a: "),
            chamfer_found(candidate, np.vstack([half, half[:9]]), p + 0.3, "Some of a twice: "),
            chamfer_found(candidate, p + 0.3, np.vstack([half, half[:9]]), "Some of b twice: "),
            chamfer_found(candidate, 0.01 * p, 0.01 * half, "Of a centimetre: "),
        )
    )


@check(2, public=False)
def moved_clouds(candidate: Function) -> Verdict:
    """In another order of rows, turned, and a thousand kilometres away, the distance is the
    same.
    """
    clouds = two_clouds(GRADERS() + 50, 60, 60)
    return same_when_moved(candidate, clouds, shape_distances.chamfer(*clouds), CHAMFER_HINT)


@check(1, public=False)
def clouds_without_points(candidate: Function) -> Verdict:
    """A cloud without points is refused."""
    return no_points_refused(candidate)
