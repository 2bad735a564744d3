"""What depth_from_disparity is graded by besides the checks that a student sees."""

import numpy as np

from lessons.disparity.exercises import GRADERS
from lessons.disparity.exercises.depth_from_disparity import depth_verdict
from workbench.exercise import Function, Verdict, check, fail, full, number, partial, worst


@check(3, public=False)
def two_cameras(candidate: Function) -> Verdict:
    """Points seen by two cameras come back to the depths at which they are."""
    rng = np.random.default_rng(GRADERS())
    verdicts = []
    for f, baseline in ((350.0, 0.06), (1200.0, 0.54)):
        x = rng.uniform(-1, 1, 40)
        Z = rng.uniform(0.8, 40.0, 40)
        seen_left = f * x / Z
        seen_right = f * (x - baseline) / Z
        verdicts.append(depth_verdict(candidate(seen_left - seen_right, f, baseline), Z))
    return worst(verdicts)


@check(1, public=False)
def smaller_pictures(candidate: Function) -> Verdict:
    """In pictures shrunk four times, f and d shrink, and the depth is the same; no disparities give
    no depths.
    """
    d = np.random.default_rng(GRADERS() + 1).uniform(3.0, 80.0, (3, 4, 2))
    if candidate(np.empty(0), 900.0, 0.15).size:
        return fail("No disparities came in, and depths came out; right are 0 of them.")
    return worst(
        depth_verdict(candidate(d / k, 900.0 / k, 0.15), 135.0 / d, f"1/{k} size: ") for k in (1, 4)
    )


@check(3, public=False)
def infinite_and_unknown(candidate: Function) -> Verdict:
    """0 is infinitely far, nan stays nan, a negative disparity is nan, and a hundredth of a pixel
    is far away.
    """
    wanted = [
        (0.0, np.inf),
        (np.nan, np.nan),
        (-3.5, np.nan),
        (0.01, 5000.0),
        (-0.01, np.nan),
        (1e-6, 5e7),
    ]
    wrong = []
    lots = candidate(np.array([[d for d, _ in wanted], [d for d, _ in wanted]]), 500.0, 0.1)[1]
    for (d, right), in_a_map in zip(wanted, lots, strict=True):
        got = float(candidate(np.array([d, 10.0]), 500.0, 0.1)[0])
        alone = float(candidate(np.full(3, d), 500.0, 0.1)[1])
        got = next(
            (
                depth
                for depth in (alone, float(in_a_map))
                if not np.isclose(depth, right, equal_nan=True)
            ),
            got,
        )
        if not np.isclose(got, right, rtol=1e-6, equal_nan=True):
            wrong.append(f"for d = {number(d)} yours is {number(got)} m, right is {number(right)}")
    if not wrong:
        return full("0 gives inf, nan gives nan, -3.5 and -0.01 give nan, 0.01 gives 5,000 m.")
    message = "; ".join(wrong).capitalize() + "."
    return partial((3 - len(wrong)) / 3, message) if len(wrong) < 3 else fail(message)
