"""Write what makes rotations of six numbers each: two columns made orthonormal, and a third. The
task `rotation` learns through your function; its gradient is ours.
"""

import numpy as np
from jaxtyping import Float

from lessons.learning.exercises import STUDENTS, entries_verdict
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
from workbench.geometry.motions import rotation_outputs

HINT = "u = a / |a|; v is b without its part along u, normalised; the third column is u × v."


@contract(
    slot="rotation_from_six",
    preset="rotation",
    examples=(
        (
            "rotation_from_six(array([[2., 0., 0., 1., 3., 0.]]))",
            "[[[1, 0, 0], [0, 1, 0], [0, 0, 1]]]",
        ),
        (
            "rotation_from_six(array([[0., 5., 0., 0., 1., 2.]]))",
            "[[[0, 0, 1], [1, 0, 0], [0, 1, 0]]]",
        ),
    ),
)
def rotation_from_six(y: Float[np.ndarray, "n 6"]) -> Float[np.ndarray, "n 3 3"]:
    """Return one rotation for each row of six numbers.

    The first three numbers, a, and the last three, b, become the first two columns: a normalised is
    u; b without its part along u, normalised, is v. The third column is u × v.

    Args:
        y: n rows; a and b are never zero, nor parallel.

    Returns:
        n rotation matrices, with u, v and u × v as columns. The input stays as it is.
    """
    return rotation_outputs.rotation_from_six(y)


def numbers(seed: int, count: int) -> np.ndarray:
    """Return rows of six numbers of many sizes."""
    rng = np.random.default_rng(seed)
    return rng.normal(size=(count, 6)) * np.exp(rng.normal(size=(count, 1)))


def found(candidate: Function, y: np.ndarray, case: str = "") -> Verdict:
    """Judge all entries by ours."""
    return entries_verdict(candidate(y), rotation_outputs.rotation_from_six(y), HINT, case)


@check(2)
def they_are_rotations(candidate: Function) -> Verdict:
    """All that comes out is orthonormal and turns without mirroring."""
    R = candidate(numbers(STUDENTS, 40))
    products = R.swapaxes(1, 2) @ R
    upright = entries_verdict(products, np.tile(np.eye(3), (len(R), 1, 1)), HINT, "RᵀR: ")
    return worst(
        (upright, entries_verdict(np.linalg.det(R), np.ones(len(R)), HINT, "Determinants: "))
    )


@check(2)
def the_right_ones(candidate: Function) -> Verdict:
    """Twenty rows give the rotations that they mean."""
    return found(candidate, numbers(STUDENTS + 1, 20))


@check(1)
def numbers_are_left_alone(candidate: Function) -> Verdict:
    """The numbers that come in are not changed."""
    return left_alone(candidate, found(candidate, numbers(STUDENTS + 2, 6)))


def _unit(v: np.ndarray) -> np.ndarray:
    return v / np.linalg.norm(v, axis=1, keepdims=True)


def _columns(u: np.ndarray, v: np.ndarray) -> np.ndarray:
    return np.stack([u, v, np.cross(u, v)], axis=2)


@mistake("Your third column is v × u: the determinant is −1, a mirror image. Exchange the two.")
def crossed_the_wrong_way(y: np.ndarray) -> np.ndarray:
    """Mirrors."""
    R = rotation_outputs.rotation_from_six(y)
    return R * [1.0, 1.0, -1.0]


@mistake(
    "You normalised b, but left in its part along u: the columns are not at right angles. Take (u ·"
    " b) u off first."
)
def without_gram_and_schmidt(y: np.ndarray) -> np.ndarray:
    """Only normalises."""
    return _columns(_unit(y[:, :3]), _unit(y[:, 3:]))


@mistake(
    "You put u, v and u × v into rows. They are columns: what you return is the inverse of the"
    " rotation."
)
def rows_for_columns(y: np.ndarray) -> np.ndarray:
    """Transposed."""
    return rotation_outputs.rotation_from_six(y).swapaxes(1, 2)


@mistake("You did not normalise v after taking off its part along u: its column is not 1 long.")
def second_not_normalised(y: np.ndarray) -> np.ndarray:
    """Leaves the length of the second."""
    u = _unit(y[:, :3])
    return _columns(u, y[:, 3:] - (u * y[:, 3:]).sum(axis=1, keepdims=True) * u)


@mistake(
    "You took (a · b) a off b, with a as it came. The part along a is (u · b) u, with u normalised."
)
def projected_on_the_long_vector(y: np.ndarray) -> np.ndarray:
    """Projects before normalising."""
    a, b = y[:, :3], y[:, 3:]
    return _columns(_unit(a), _unit(b - (a * b).sum(axis=1, keepdims=True) * a))


@mistake("You read the six numbers as pairs. The first three are a, the last three b.")
def read_in_pairs(y: np.ndarray) -> np.ndarray:
    """Every other number."""
    return rotation_outputs.rotation_from_six(y.reshape(-1, 3, 2).swapaxes(1, 2).reshape(-1, 6))


@mistake("You began with b: then a is bent to fit. The first three numbers keep their direction.")
def began_with_the_second(y: np.ndarray) -> np.ndarray:
    """Makes a orthogonal to b."""
    v = _unit(y[:, 3:])
    return _columns(_unit(y[:, :3] - (v * y[:, :3]).sum(axis=1, keepdims=True) * v), v)


@alternative
def row_by_row(y: np.ndarray) -> np.ndarray:
    """Loops over rows."""
    R = np.empty((len(y), 3, 3))
    for k, six in enumerate(y):
        u = six[:3] / np.sqrt(six[:3] @ six[:3])
        v = six[3:] - (u @ six[3:]) * u
        R[k, :, 0] = u
        R[k, :, 1] = v / np.sqrt(v @ v)
        R[k, :, 2] = np.cross(R[k, :, 0], R[k, :, 1])
    return R


@alternative
def by_two_products(y: np.ndarray) -> np.ndarray:
    """Takes the third direction first."""
    u = _unit(y[:, :3])
    w = _unit(np.cross(y[:, :3], y[:, 3:]))
    return np.stack([u, np.cross(w, u), w], axis=2)
