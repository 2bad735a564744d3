"""Write what places the vertices of marching cubes: where the field is zero on an edge, given its
values at both ends. The lesson's surfaces from grids of distances, and from networks, have their
vertices from it.
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
)
from workbench.geometry import level_sets

ENDS = "np.array([[0.0, 0, 0]]), np.array([[4.0, 0, 0]])"


@contract(
    slot="edge_crossings",
    examples=(
        (f"edge_crossings({ENDS}, np.array([-1.0]), np.array([3.0]))", "[[1, 0, 0]]"),
        (f"edge_crossings({ENDS}, np.array([0.5]), np.array([-0.5]))", "[[2, 0, 0]]"),
    ),
)
def edge_crossings(
    p_a: Float[np.ndarray, "n 3"],
    p_b: Float[np.ndarray, "n 3"],
    f_a: Float[np.ndarray, " n"],
    f_b: Float[np.ndarray, " n"],
) -> Float[np.ndarray, "n 3"]:
    """Return where a field that is linear along each edge is zero.

    Args:
        p_a: One end of each edge, metres.
        p_b: The other end, metres.
        f_a: The field at `p_a`.
        f_b: The field at `p_b`, never of the same sign; either may be the positive one, and one of
            both may be 0.

    Returns:
        One point per edge, metres, between its ends. The inputs stay as they are.
    """
    return level_sets.edge_crossings(p_a, p_b, f_a, f_b)


HINT = "x = a + t (b − a) with t = f_a / (f_a − f_b): near the end whose value is small."


def edges(rng: np.random.Generator, n: int = 20, size: float = 1.0) -> tuple[np.ndarray, ...]:
    """Return edges in all directions, with values of different sign at their ends."""
    p_a = size * rng.uniform(-1, 1, (n, 3))
    p_b = p_a + size * rng.uniform(-1, 1, (n, 3))
    sign = rng.choice([-1.0, 1.0], n)
    return p_a, p_b, sign * rng.uniform(0.05, 1, n), -sign * rng.uniform(0.05, 1, n)


def verdict(
    candidate: Function, given: tuple[np.ndarray, ...], where: str, hint: str = HINT
) -> Verdict:
    """Judge the places on some edges."""
    p_a, p_b, f_a, f_b = given
    right = level_sets.edge_crossings(*given)

    def what(k: int) -> str:
        return (
            f"{where}, from {written(p_a[k])} with {written(f_a[k])} to {written(p_b[k])} with"
            f" {written(f_b[k])}"
        )

    return rows_verdict(candidate(*given), right, what, hint)


@check(2)
def places_on_edges(candidate: Function) -> Verdict:
    """Edges in all directions, with the positive end first or last."""
    return verdict(candidate, edges(np.random.default_rng(STUDENTS)), "On an edge")


@check(2)
def edges_of_a_grid(candidate: Function) -> Verdict:
    """Edges of a grid along x, y and z, of a plane's distances: all places lie on the plane."""
    rng = np.random.default_rng(STUDENTS + 1)
    normal = np.array([0.6, 0.64, 0.48])
    p_a = rng.uniform(-1, 1, (40, 3))
    p_b = p_a + 0.8 * np.eye(3)[rng.integers(0, 3, 40)]
    f_a, f_b = p_a @ normal - 0.1, p_b @ normal - 0.1
    cross = f_a * f_b < 0
    return verdict(candidate, (p_a[cross], p_b[cross], f_a[cross], f_b[cross]), "On a grid")


@check(1)
def inputs_are_left_alone(candidate: Function) -> Verdict:
    """Ends and values are not changed."""
    return left_alone(
        candidate, verdict(candidate, edges(np.random.default_rng(STUDENTS + 2)), "On an edge")
    )


def at(p_a: np.ndarray, p_b: np.ndarray, t: np.ndarray) -> np.ndarray:
    """Return the points a share t of the way from a to b."""
    return p_a + t[:, None] * (p_b - p_a)


@mistake(
    "You return the middle of each edge, whatever the values: that is what bits would give. Use f_a"
    " and f_b."
)
def middles(p_a: np.ndarray, p_b: np.ndarray, f_a: np.ndarray, f_b: np.ndarray) -> np.ndarray:
    """Ignores the values."""
    return (p_a + p_b) / 2


@mistake(
    "Your weights are swapped: the place lies near the end whose value is small, yours near the"
    " other."
)
def swapped(p_a: np.ndarray, p_b: np.ndarray, f_a: np.ndarray, f_b: np.ndarray) -> np.ndarray:
    """Measures from the wrong end."""
    return at(p_b, p_a, f_a / (f_a - f_b))


@mistake(
    "You divide by f_a + f_b, which has no meaning for values of different sign: divide by f_a −"
    " f_b."
)
def divided_by_the_sum(
    p_a: np.ndarray, p_b: np.ndarray, f_a: np.ndarray, f_b: np.ndarray
) -> np.ndarray:
    """Leaves the edge."""
    total = f_a + f_b
    return at(p_a, p_b, f_a / np.where(total == 0, 1.0, total))


@mistake(
    "You walk |f_a| metres along the edge. The surface may cross it at a slant: only the share of"
    " both values tells."
)
def walked(p_a: np.ndarray, p_b: np.ndarray, f_a: np.ndarray, f_b: np.ndarray) -> np.ndarray:
    """Takes the value for a way."""
    way = p_b - p_a
    return p_a + np.abs(f_a)[:, None] * way / np.linalg.norm(way, axis=1, keepdims=True)


@mistake("You go away from b: the sign of t is turned round. t = f_a / (f_a − f_b) is positive.")
def outwards(p_a: np.ndarray, p_b: np.ndarray, f_a: np.ndarray, f_b: np.ndarray) -> np.ndarray:
    """Divides by f_b - f_a."""
    return at(p_a, p_b, f_a / (f_b - f_a))


@mistake(
    "You weigh with the squares of the values. The field is linear along the edge: take them as"
    " they are."
)
def squared(p_a: np.ndarray, p_b: np.ndarray, f_a: np.ndarray, f_b: np.ndarray) -> np.ndarray:
    """Squares."""
    return at(p_a, p_b, f_a**2 / (f_a**2 + f_b**2))


@mistake("You return t itself or t (b − a): the way from a. Add a, for the place.")
def without_the_start(
    p_a: np.ndarray, p_b: np.ndarray, f_a: np.ndarray, f_b: np.ndarray
) -> np.ndarray:
    """Forgets where the edge begins."""
    return at(0 * p_a, p_b - p_a, f_a / (f_a - f_b))


@alternative
def by_weights(p_a: np.ndarray, p_b: np.ndarray, f_a: np.ndarray, f_b: np.ndarray) -> np.ndarray:
    """A weighted mean of the ends, edge by edge."""
    places = []
    for a, b, u, v in zip(p_a, p_b, np.abs(f_a), np.abs(f_b), strict=True):
        places.append((v * a + u * b) / (u + v))
    return np.array(places).reshape(-1, 3)
