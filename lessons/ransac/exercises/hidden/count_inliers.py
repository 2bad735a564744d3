"""What count_inliers is graded by besides the checks that a student sees."""

import numpy as np

from lessons.ransac.exercises import GRADERS
from lessons.ransac.exercises.count_inliers import COUNT_HINT, a_layer, count_verdict
from workbench.exercise import Function, Verdict, check, worst
from workbench.geometry.motions import exp_so3


@check(2, public=False)
def turned_over(candidate: Function) -> Verdict:
    """The same plane with its normal turned over, and the points in another order, give the same
    count.
    """
    rng = np.random.default_rng(GRADERS() + 40)
    plane, p, signed = a_layer(rng)
    right = int((np.abs(signed) <= 0.07).sum())
    other = p[rng.permutation(len(p))]
    return worst(
        (
            count_verdict(candidate(plane, p, 0.07), right, len(p), "Within 0.07 m"),
            count_verdict(candidate(-plane, p, 0.07), right, len(p), "The normal turned over"),
            count_verdict(
                candidate(plane, other, 0.07), right, len(p), "The points in another order"
            ),
        )
    )


@check(2, public=False)
def cloud_and_plane_moved(candidate: Function) -> Verdict:
    """A cloud and its plane that are turned, moved and scaled together keep their count."""
    rng = np.random.default_rng(GRADERS() + 50)
    verdicts = []
    for scale in (1.0, 12.0, 0.05):
        plane, p, signed = a_layer(rng)
        R = exp_so3(rng.normal(size=3))
        t = rng.uniform(-4.0, 4.0, 3)
        moved = np.append(R @ plane[:3], scale * (plane[3] - R @ plane[:3] @ t))
        got = candidate(moved, scale * (p @ R.T + t), scale * 0.05)
        right = int((np.abs(signed) <= 0.05).sum())
        verdicts.append(
            count_verdict(got, right, len(p), f"Turned, moved, {scale:g} times as large")
        )
    return worst(verdicts)


@check(1, public=False)
def just_on_the_limit(candidate: Function) -> Verdict:
    """A point exactly as far as the inlier distance is an inlier, on both sides, and on the plane
    where that is 0.
    """
    heights = np.array([1.5, 0.5, 1.0, 1.75, 0.25, -2.0, -2.5])
    p = np.column_stack([np.arange(7.0), np.zeros(7), heights])
    hint = "Use <=, not <."
    plane = np.array([0.0, 0.0, 1.0, -1.0])
    limit = count_verdict(candidate(plane, p, 0.5), 3, 7, "Two exactly on the limit", hint)
    return worst(
        (limit, count_verdict(candidate(plane, p, 0.0), 1, 7, "Within 0 m, one on the plane", hint))
    )


@check(1, public=False)
def nothing_to_count(candidate: Function) -> Verdict:
    """No points, a plane of four nan, and a point with a nan count 0."""
    plane, p, signed = a_layer(np.random.default_rng(GRADERS() + 60), 20)
    right = int((np.abs(signed[1:]) <= 0.3).sum())
    near = p[0] - signed[0] * plane[:3]
    hint = f"{COUNT_HINT} That is never true of nan."
    verdicts = [
        count_verdict(candidate(plane, np.empty((0, 3)), 0.3), 0, 0, "No points"),
        count_verdict(
            candidate(np.full(4, np.nan), p[1:], 0.3), 0, 19, "A plane of four nan", hint
        ),
    ]
    for unknown in (1, 0, 2, slice(None)):
        p[0] = near
        p[0, unknown] = np.nan
        verdicts.append(
            count_verdict(candidate(plane, p, 0.3), right, 20, "One of them with a nan", hint)
        )
    return worst(verdicts)
