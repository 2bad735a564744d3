"""Write the mean of points that do not count the same: the point from which the weighted squared
distances are smallest. The lesson takes your answer for the place of the beacon.
"""

import numpy as np

from workbench.exercise import (
    Function,
    Verdict,
    alternative,
    band,
    beside,
    check,
    contract,
    left_alone,
    mistake,
    refused,
    worst,
)

HINT = "Multiply each row by its weight, add up, and divide by the sum of the weights."


def cloud(seed: int, n: int = 20) -> tuple[np.ndarray, np.ndarray]:
    """Return points, metres, and weights that differ much."""
    rng = np.random.default_rng(seed)
    return rng.normal([2.0, -1.0, 0.5], 1.0, (n, 3)), rng.uniform(0.1, 10.0, n)


def judged(candidate: Function, p: np.ndarray, w: np.ndarray) -> Verdict:
    """Judge an answer by its distance to the right one."""
    got, right = candidate(p, w), weighted_centroid(p, w)
    off = 1000 * float(np.linalg.norm(got - right))
    return band(
        "Distance to the centroid", off, "mm", good=0.001, fair=0.1, hint=beside(got, right, HINT)
    )


@contract(
    slot="weighted_centroid",
    examples=(
        ("weighted_centroid(array([[0., 0., 0.], [2., 0., 0.]]), array([1., 1.]))", "[1, 0, 0]"),
        ("weighted_centroid(array([[0., 0., 0.], [2., 0., 0.]]), array([3., 1.]))", "[0.5, 0, 0]"),
    ),
)
def weighted_centroid(p: np.ndarray, w: np.ndarray) -> np.ndarray:
    """Return the weighted mean (3,) of points, metres.

    Args:
        p: One row (x, y, z) per point.
        w: One weight per point, none negative.

    Raises:
        ValueError: If the weights add up to 0.
    """
    if w.sum() == 0:
        raise ValueError("all weights are 0")
    return w @ p / w.sum()


@check(2)
def points_of_unequal_weight(candidate: Function) -> Verdict:
    """Points count as much as their weights say."""
    return judged(candidate, *cloud(1))


@check(1)
def inputs_are_left_alone(candidate: Function) -> Verdict:
    """The points and weights that come in are not changed."""
    return left_alone(candidate, judged(candidate, *cloud(2)))


@check(2, public=False)
def any_scale_of_the_weights(candidate: Function) -> Verdict:
    """A thousand times the weights, or a thousandth, change nothing."""
    p, w = cloud(3)
    return worst(judged(candidate, p, scale * w) for scale in (1000.0, 1.0, 0.001))


@check(1, public=False)
def no_weight_at_all(candidate: Function) -> Verdict:
    """Weights that are all 0 are refused."""
    return refused(candidate, np.ones((4, 3)), np.zeros(4), what="Four points of weight 0")


@mistake(
    "You took the plain mean: every point counts the same there. Multiply each row by its weight"
    " first."
)
def weights_ignored(p: np.ndarray, w: np.ndarray) -> np.ndarray:
    """Takes the mean of the rows."""
    return p.mean(axis=0)


@mistake(
    "You divided the weighted sum by the number of points. Divide it by the sum of the weights."
)
def divided_by_the_count(p: np.ndarray, w: np.ndarray) -> np.ndarray:
    """Divides by n."""
    return w @ p / len(p)


@mistake(
    "Your weights are squared. The weight itself is one over the variance already: use it as it is."
)
def weights_squared(p: np.ndarray, w: np.ndarray) -> np.ndarray:
    """Squares what is a square already."""
    return w**2 @ p / (w**2).sum()


@alternative
def by_numpy(p: np.ndarray, w: np.ndarray) -> np.ndarray:
    """The same by numpy's average, whose error is a ZeroDivisionError."""
    if not w.any():
        raise ValueError("all weights are 0")
    return np.average(p, axis=0, weights=w)
