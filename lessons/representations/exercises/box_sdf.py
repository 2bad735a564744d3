"""Write the signed distance to a box: negative inside. The lesson stores boxes and a plate with it,
as a grid of distances, an octree or a network: see the presets 'Sharp edges' and 'The smaller of
two distances'.
"""

import numpy as np
from jaxtyping import Float

from lessons.representations.exercises import STUDENTS, rows_verdict, written
from workbench.exercise import (
    Function,
    Verdict,
    alternative,
    check,
    contract,
    left_alone,
    mistake,
    worst,
)
from workbench.geometry.fields import signed_distances


@contract(
    slot="box_sdf",
    preset="edges",
    examples=(
        ("box_sdf(np.array([[3.0, 0, 0], [4, 5, 0]]), np.array([1.0, 1, 1]))", "[2, 5]"),
        ("box_sdf(np.array([[0.0, 0, 0], [0, 0, 0.9]]), np.array([1.0, 2, 1]))", "[-1, -0.1]"),
    ),
)
def box_sdf(
    p: Float[np.ndarray, "n 3"], half_size: Float[np.ndarray, "3"]
) -> Float[np.ndarray, " n"]:
    """Return how far points are from the surface of a box about the origin, its edges along the
    axes: negative inside.

    Outside, the nearest point of the box is on a face, on an edge or at a corner. Inside, the
    nearest face decides.

    Args:
        p: Points, metres, one row each.
        half_size: Half of the box's edges along x, y and z, metres, all positive.

    Returns:
        One distance for each point, metres; 0 on the surface. The inputs stay as they are.
    """
    return signed_distances.box_sdf(p, half_size)


HINT = "With d = |p| − half_size: outside it is the length of max(d, 0), inside the largest d."


def verdict(
    candidate: Function, p: np.ndarray, half: np.ndarray, where: str, hint: str = HINT
) -> Verdict:
    """Judge the distances of points to one box."""
    right = signed_distances.box_sdf(p, half)
    return rows_verdict(
        candidate(p, half),
        right,
        lambda k: f"{where}, at {written(p[k])} of a box {written(half)}",
        hint,
    )


def outside(half: np.ndarray, beyond: int, rng: np.random.Generator, n: int = 12) -> np.ndarray:
    """Return points that lie beyond the box along so many axes: before a face, an edge or a
    corner.
    """
    p = rng.uniform(-0.9, 0.9, (n, 3)) * half
    for row in p:
        axes = rng.permutation(3)[:beyond]
        row[axes] = rng.choice([-1, 1], beyond) * (half[axes] + rng.uniform(0.2, 1.5, beyond))
    return p


BOX = np.array([0.5, 0.35, 0.25])


@check(2)
def outside_of_the_box(candidate: Function) -> Verdict:
    """Before faces, edges and corners the distance is that to the nearest point of the box."""
    rng = np.random.default_rng(STUDENTS)
    names = {1: "Before a face", 2: "Before an edge", 3: "Before a corner"}
    return worst(verdict(candidate, outside(BOX, k, rng), BOX, name) for k, name in names.items())


@check(2)
def inside_of_the_box(candidate: Function) -> Verdict:
    """Inside it is minus the distance to the nearest face."""
    p = np.random.default_rng(STUDENTS + 1).uniform(-0.95, 0.95, (30, 3)) * BOX
    return verdict(candidate, p, BOX, "Inside")


@check(1)
def inputs_are_left_alone(candidate: Function) -> Verdict:
    """Points and box are not changed."""
    p = np.random.default_rng(STUDENTS + 2).uniform(-1, 1, (30, 3))
    return left_alone(candidate, verdict(candidate, p, np.array([0.3, 0.5, 0.7]), "Somewhere"))


@mistake(
    "You left out the inside: your distance is 0 there. Add the largest of |p| − half_size where"
    " all are negative."
)
def nothing_inside(p: np.ndarray, half_size: np.ndarray) -> np.ndarray:
    """Only the outside."""
    return np.linalg.norm(np.maximum(np.abs(p) - half_size, 0), axis=1)


@mistake(
    "You take the largest coordinate outside as well. Before edges and corners the distance is the"
    " length of all that is beyond."
)
def largest_outside(p: np.ndarray, half_size: np.ndarray) -> np.ndarray:
    """Chebyshev everywhere."""
    return (np.abs(p) - half_size).max(axis=1)


@mistake("Your distance has no sign: inside it is positive. Inside is negative.")
def unsigned(p: np.ndarray, half_size: np.ndarray) -> np.ndarray:
    """Takes the absolute value."""
    return np.abs(signed_distances.box_sdf(p, half_size))


@mistake("Your sign is turned round: positive inside. In this lesson inside is negative.")
def turned_round(p: np.ndarray, half_size: np.ndarray) -> np.ndarray:
    """Positive inside."""
    return -signed_distances.box_sdf(p, half_size)


@mistake(
    "You take half_size for the whole edge, so that your box is half as large. It reaches from"
    " −half_size to half_size."
)
def halved_again(p: np.ndarray, half_size: np.ndarray) -> np.ndarray:
    """Halves what is half."""
    return signed_distances.box_sdf(p, half_size / 2)


@mistake(
    "You left out the absolute value of p: only the side of positive coordinates is right. The box"
    " is symmetric."
)
def one_side(p: np.ndarray, half_size: np.ndarray) -> np.ndarray:
    """Forgets the other side."""
    d = p - half_size
    return np.linalg.norm(np.maximum(d, 0), axis=1) + np.minimum(d.max(axis=1), 0)


@mistake(
    "You add up what is beyond along the axes. The distance is the length of that vector, not the"
    " sum of its parts."
)
def added_up(p: np.ndarray, half_size: np.ndarray) -> np.ndarray:
    """Manhattan outside."""
    d = np.abs(p) - half_size
    return np.maximum(d, 0).sum(axis=1) + np.minimum(d.max(axis=1), 0)


@alternative
def by_nearest_point(p: np.ndarray, half_size: np.ndarray) -> np.ndarray:
    """Clamps each point into the box; inside, the nearest of six faces."""
    answer = np.empty(len(p))
    for k, q in enumerate(p):
        near = np.minimum(np.maximum(q, -half_size), half_size)
        away = float(np.linalg.norm(q - near))
        answer[k] = away if away > 0 else -min(np.min(half_size - q), np.min(half_size + q))
    return answer
