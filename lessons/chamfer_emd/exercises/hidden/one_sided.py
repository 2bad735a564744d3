"""What one_sided is graded by besides the checks that a student sees."""

import numpy as np

from lessons.chamfer_emd.exercises import (
    GRADERS,
    no_points_refused,
    two_clouds,
    value_verdict,
)
from lessons.chamfer_emd.exercises.hidden import same_when_moved
from lessons.chamfer_emd.exercises.one_sided import SIDE_HINT, side_found
from workbench.exercise import Function, Verdict, check, worst
from workbench.geometry.points import shape_distances


@check(2, public=False)
def side_of_uneven_clouds(candidate: Function) -> Verdict:
    """Few points that look at many, many at few, and a single one each are all measured."""
    sizes = ((5, 200), (200, 5), (1, 30), (30, 1), (1, 1))
    return worst(
        side_found(candidate, *two_clouds(GRADERS() + k, n, m), f"{n} points to {m}: ")
        for k, (n, m) in enumerate(sizes)
    )


@check(2, public=False)
def side_grows_with_the_square(candidate: Function) -> Verdict:
    """Three times the size is nine times the distance; points of a that are twice count twice,
    those of b once.
    """
    p_a, p_b = two_clouds(GRADERS() + 10, 50, 40)
    right = shape_distances.one_sided(p_a, p_b)
    three = value_verdict(
        candidate(3 * p_a, 3 * p_b), 9 * right, "m²", SIDE_HINT, "Three times the size: "
    )
    twice = value_verdict(
        candidate(np.vstack([p_a, p_a]), p_b), right, "m²", SIDE_HINT, "Points of a twice: "
    )
    some = side_found(candidate, np.vstack([p_a, p_a[:20]]), p_b, "Some points of a twice: ")
    equal = side_found(candidate, p_a, np.vstack([p_b[:9], p_b]), "Some points of b twice: ")
    return worst(
        (
            three,
            twice,
            some,
            equal,
            side_found(candidate, 0.01 * p_a, 0.01 * p_b, "Of a centimetre: "),
        )
    )


@check(2, public=False)
def side_of_moved_clouds(candidate: Function) -> Verdict:
    """In another order of rows, turned, and a thousand kilometres away, the distance is the
    same.
    """
    clouds = two_clouds(GRADERS() + 20, 60, 60)
    return same_when_moved(candidate, clouds, shape_distances.one_sided(*clouds), SIDE_HINT)


@check(1, public=False)
def side_without_points(candidate: Function) -> Verdict:
    """A cloud without points is refused."""
    return no_points_refused(candidate)
