"""Write the update of fast marching: the distance of a node from two neighbours' distances, as if a
straight front came by. The lesson's front marches on what you return.
"""

import numpy as np
from jaxtyping import Float

from lessons.distances.exercises import STUDENTS, values_verdict
from workbench.algorithms.surfaces import fast_marching
from workbench.exercise import Function, Verdict, alternative, check, contract, left_alone, mistake

Values = Float[np.ndarray, " n"]


@contract(
    slot="eikonal_update",
    preset="marching",
    examples=(
        ("eikonal_update(np.array([1.0, 0.0]), np.array([1.0, 2.0]), 1.0)", "[1.7071, 1]"),
        ("eikonal_update(np.array([0.3, np.inf]), np.array([np.inf, 0.5]), 0.1)", "[0.4, 0.6]"),
    ),
)
def eikonal_update(a: Values, b: Values, h: float) -> Values:
    """Return for every node the u with (u - a)^2 + (u - b)^2 = h^2 that is neither below a nor
    below b.

    Where there is none, since a and b differ by h or more, the front comes along one axis: u =
    min(a, b) + h.

    Args:
        a: The smaller distance of the neighbours to the left and right, one entry per node; inf
            where there is none.
        b: That of those above and below, likewise. One of a and b is finite.
        h: Spacing of the grid, positive.

    Returns:
        One finite u per node. The inputs stay as they are.
    """
    return fast_marching.eikonal_update(a, b, h)


HINT = "(a + b + sqrt(2 h^2 - (a - b)^2)) / 2 where |a - b| < h, else min(a, b) + h."


def found(candidate: Function, a: np.ndarray, b: np.ndarray, h: float, label: str = "") -> Verdict:
    """Judge the updates of some nodes."""
    return values_verdict(candidate(a, b, h), fast_marching.eikonal_update(a, b, h), HINT, label)


def nodes(seed: int, count: int, h: float, apart: float) -> tuple[np.ndarray, np.ndarray, float]:
    """Return distances that differ by up to so many spacings."""
    rng = np.random.default_rng(seed)
    a = rng.uniform(0, 20 * h, count)
    return a, np.abs(a + rng.uniform(-apart, apart, count) * h), h


@check(2)
def a_front_at_an_angle(candidate: Function) -> Verdict:
    """Equal neighbours give a + h/√2, and unequal ones a front that leans."""
    return found(candidate, np.array([1.0, 1.0, 2.0]), np.array([1.0, 1.4, 1.3]), 1.0)


@check(2)
def a_front_along_an_axis(candidate: Function) -> Verdict:
    """Where neighbours differ by the spacing or more, only the smaller one counts."""
    return found(candidate, np.array([0.0, 3.0, 1.0]), np.array([2.0, 1.0, 2.0]), 1.0)


@check(1)
def inputs_are_left_alone(candidate: Function) -> Verdict:
    """The distances that come in are not changed."""
    return left_alone(candidate, found(candidate, *nodes(STUDENTS, 6, 0.5, 0.9)))


@mistake(
    "You went along one axis always, min(a, b) + h: that is Manhattan's distance. Use both"
    " neighbours where you can."
)
def smaller_and_h(a: np.ndarray, b: np.ndarray, h: float) -> np.ndarray:
    """Min + h."""
    return np.minimum(a, b) + h


@mistake(
    "You added h to the mean of both neighbours. A front that leans needs (u − a)² + (u − b)² = h²."
)
def mean_and_h(a: np.ndarray, b: np.ndarray, h: float) -> np.ndarray:
    """The mean, plus h."""
    return np.where(
        np.abs(a - b) < h, (np.minimum(a, 1e9) + np.minimum(b, 1e9)) / 2 + h, np.minimum(a, b) + h
    )


@mistake(
    "Where a and b differ by h or more your answer is no number. There the front comes along one"
    " axis: min(a, b) + h."
)
def no_fallback(a: np.ndarray, b: np.ndarray, h: float) -> np.ndarray:
    """The formula alone: the root of a negative number."""
    with np.errstate(invalid="ignore"):
        return (a + b + np.sqrt(2 * h * h - (a - b) ** 2)) / 2


@mistake(
    "Where 2 h² − (a − b)² was negative you put 0 for it, which gives the mean of a and b. There u"
    " = min(a, b) + h."
)
def clipped_root(a: np.ndarray, b: np.ndarray, h: float) -> np.ndarray:
    """The root of a negative number as 0."""
    a, b = np.minimum(a, 1e9), np.minimum(b, 1e9)
    return (a + b + np.sqrt(np.maximum(2 * h * h - (a - b) ** 2, 0.0))) / 2


@mistake(
    "You took the smaller solution of the quadratic. It lies below both neighbours: the front would"
    " run backwards."
)
def smaller_root(a: np.ndarray, b: np.ndarray, h: float) -> np.ndarray:
    """Minus the root."""
    d = np.where(np.abs(a - b) < h, np.nan_to_num(a - b, posinf=0, neginf=0), 0.0)
    low = np.minimum(a, b)
    return np.where(np.abs(a - b) < h, low + (np.abs(d) - np.sqrt(2 * h * h - d * d)) / 2, low + h)


@mistake(
    "You solved for a spacing of 1. The spacing is h: its square stands under the root, and h is"
    " added on one axis."
)
def spacing_of_one(a: np.ndarray, b: np.ndarray, h: float) -> np.ndarray:
    """H taken for 1."""
    return fast_marching.eikonal_update(a, b, 1.0)


@mistake(
    "You fell back to the larger neighbour plus h. Along one axis the front comes from the nearer"
    " one: min(a, b) + h."
)
def larger_fallback(a: np.ndarray, b: np.ndarray, h: float) -> np.ndarray:
    """Max + h on one axis."""
    high = np.where(np.isinf(np.maximum(a, b)), np.minimum(a, b), np.maximum(a, b))
    return np.where(np.abs(a - b) < h, fast_marching.eikonal_update(a, b, h), high + h)


@alternative
def node_by_node(a: np.ndarray, b: np.ndarray, h: float) -> np.ndarray:
    """In a loop."""
    u = np.empty(len(a))
    for k in range(len(a)):
        if abs(a[k] - b[k]) >= h:
            u[k] = min(a[k], b[k]) + h
        else:
            u[k] = (a[k] + b[k] + (2 * h**2 - (a[k] - b[k]) ** 2) ** 0.5) / 2
    return u


@alternative
def where_it_leans(a: np.ndarray, b: np.ndarray, h: float) -> np.ndarray:
    """The quadratic where it has its root, the rest first."""
    u = np.minimum(a, b) + h
    both = u > np.maximum(a, b)
    s = a[both] + b[both]
    d = a[both] - b[both]
    u[both] = (s + np.sqrt(2 * h**2 - d**2)) / 2
    return u
