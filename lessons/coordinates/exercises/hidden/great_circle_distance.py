"""What great_circle_distance is graded by besides the checks that a student sees."""

import numpy as np

from lessons.coordinates.exercises import GRADERS, numbers, row_by_row
from lessons.coordinates.exercises.great_circle_distance import EARTH, HINT, judged, places, short
from workbench.exercise import Function, Verdict, check, worst


@check(2, public=False)
def other_places(candidate: Function) -> Verdict:
    """Other places are right, across the date line, near the poles and nearly opposite, on a marble
    too.
    """
    a = places(GRADERS(), 12)
    b = places(GRADERS() + 1, 12)
    a[:3] = [[10.0, 179.5], [-40.0, 170.0], [89.0, 0.0]]
    b[:3] = [[12.0, -179.0], [-41.0, -170.0], [88.0, 180.0]]
    # some kilometres from the antipode
    b[3] = (-a[3, 0] + 0.05, a[3, 1] + 180.02 - 360.0 * (a[3, 1] > 0))
    return worst((judged(candidate, a, b), judged(candidate, a, b, 0.005)))


@check(1, public=False)
def the_same_place(candidate: Function) -> Verdict:
    """A place and itself are 0 apart, antipodes half the circumference; a pole is one place at any
    longitude.
    """
    a = np.vstack([places(GRADERS() + 2, 40), [[0.0, 0.0], [90.0, 0.0]]])
    b = np.column_stack([-a[:, 0], np.where(a[:, 1] > 0, a[:, 1] - 180, a[:, 1] + 180)])
    b = np.vstack([a, [[90.0, -70.0]], b, [[-90.0, 80.0]]])
    a = np.vstack([a, [[90.0, 20.0]], a, [[90.0, 20.0]]])
    got = candidate(a, b, EARTH)
    right = np.repeat([0.0, np.pi * EARTH], len(a) // 2)
    asked = [f"{numbers(p)} to {numbers(q)}" for p, q in zip(a, b, strict=True)]
    hint = (
        "Near half way round, and near the start, an arc sine or cosine loses digits: take"
        f" arctan2. {HINT}"
    )
    return row_by_row(asked, got, right, np.abs(got - right), hint, good=0.5, fair=5.0)


@check(1, public=False)
def other_short_ways(candidate: Function) -> Verdict:
    """So are other places some millimetres and metres apart."""
    return worst(
        short(candidate, axis, metres) for axis, metres in ((1, 2e-3), (0, 5e-3), (0, 30.0))
    )
