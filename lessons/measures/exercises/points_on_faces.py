"""Write what spreads points evenly over a mesh: each row of three random numbers becomes one point.
The lesson fills a triangle with it, then the whole surface, and looks where the points' mean lies.
"""

import numpy as np
from jaxtyping import Float, Int

from lessons.measures.exercises import STUDENTS, blob, relative_verdict
from workbench.exercise import (
    Function,
    Verdict,
    alternative,
    check,
    contract,
    fail,
    full,
    left_alone,
    mistake,
    partial,
)
from workbench.geometry.meshes import face_areas
from workbench.geometry.points import sampling

CORNERS = "np.array([[0.0, 0, 0], [3, 0, 0], [0, 3, 0]]), np.array([[0, 1, 2]])"


@contract(
    slot="points_on_faces",
    preset="alike",
    examples=(
        (f"points_on_faces({CORNERS}, np.full((2, 3), 0.4)).shape", "(2, 3)"),
        (f"points_on_faces({CORNERS}, np.full((1, 3), 0.4))[:, 2]", "[0]"),
    ),
)
def points_on_faces(
    p: Float[np.ndarray, "v 3"], faces: Int[np.ndarray, "f 3"], u: Float[np.ndarray, "n 3"]
) -> Float[np.ndarray, "n 3"]:
    """Return a point on the mesh for each row of numbers: evenly spread, as the rows are over the
    unit cube.

    The first number picks the face, each as likely as it is large. The second and the third place
    the point in it: with s the square root of the second and t the third it is (1 - s) a + s (1 -
    t) b + s t c. (Another way to place it that is as even earns as much.)

    Args:
        p: Vertices, metres, one row each.
        faces: Three vertex numbers per triangle, corners a, b, c. Some may have no area.
        u: n rows of three numbers, 0 <= u < 1. They are all the chance there is: the same row gives
            the same point.

    Returns:
        n points, metres, in the order of the rows. The inputs stay as they are.
    """
    return sampling.points_on_faces(p, faces, u)


AREA_HINT = (
    "Pick a face by where the first number falls among the running sums of the areas, over their"
    " total."
)
PLACE_HINT = "Near a corner there is less room: take the square root of the second number."


def even(count: int, seed: int) -> np.ndarray:
    """Return rows that fill the unit cube evenly, count x count x count, each somewhere in its
    cell.
    """
    rng = np.random.default_rng(seed)
    cell = np.stack(np.meshgrid(*[np.arange(count)] * 3, indexing="ij"), axis=-1).reshape(-1, 3)
    return rng.permutation((cell + rng.random(cell.shape)) / count)


def weights_of(q: np.ndarray, triangle: np.ndarray) -> np.ndarray:
    """Return the weights of a triangle's corners at points of its plane."""
    a, b, c = triangle
    weights = np.linalg.lstsq(np.stack([b - a, c - a], axis=1), (q - a).T)[0].T
    return np.column_stack([1 - weights.sum(axis=1), weights])


def nothing(quantity: str, got: float, hint: str) -> Verdict:
    """Judge a length that should be 0, up to a thousandth of a millimetre."""
    return relative_verdict(quantity, max(got, 0.0), 0.0, hint, good=1e-4, fair=1e-1, size=1.0)


def share_verdict(
    case: str, got: np.ndarray, right: np.ndarray, hint: str, good: float, fair: float
) -> Verdict:
    """Judge shares of points by the largest difference, in per cent of all."""
    k = int(np.abs(got - right).argmax())
    message = (
        f"{case}: {100 * got[k]:.1f} % of the points lie in one of the parts, right is"
        f" {100 * right[k]:.1f} %"
    )
    off = 100 * abs(got[k] - right[k])
    if off <= good:
        return full(f"{message}.")
    return partial(0.5, f"{message}: close. {hint}") if off <= fair else fail(f"{message}. {hint}")


@check(2)
def points_lie_in_the_triangle(candidate: Function) -> Verdict:
    """All points of one triangle lie in its plane and inside it."""
    triangle = np.array([[1.0, 0, 0], [0, 2, 0.5], [-1, -1, 2]])
    q = candidate(triangle, np.array([[0, 1, 2]]), even(8, STUDENTS))
    weights = weights_of(q, triangle)
    off = max(float(np.linalg.norm(weights @ triangle - q, axis=1).max()), float(-weights.min()))
    return nothing("Farthest off the triangle, m", off, "Weights are not negative and add up to 1.")


@check(2)
def a_triangle_is_filled_evenly(candidate: Function) -> Verdict:
    """In one triangle each of its sixteen equal parts gets as many points."""
    return filled(candidate, np.array([[0.0, 0, 0], [2, 0, 0], [0.5, 1.5, 0.3]]), STUDENTS)


def filled(candidate: Function, triangle: np.ndarray, seed: int) -> Verdict:
    """Judge how evenly a triangle is filled, by the shares of points in sixteen equal parts."""
    q = candidate(triangle, np.array([[0, 1, 2]]), even(20, seed))
    level = np.clip(np.floor(4 * weights_of(q, triangle)), 0, 3).astype(int)
    shares = np.bincount(np.ravel_multi_index(level.T, (4, 4, 4)), minlength=64) / len(q)
    parts = np.array([i + j + k in (2, 3) for i, j, k in np.ndindex(4, 4, 4)])
    return share_verdict(
        "In one triangle", shares[parts], np.full(16, 1 / 16), PLACE_HINT, 1.0, 2.0
    )


@check(2)
def large_faces_get_more(candidate: Function) -> Verdict:
    """Of two faces the three times larger one gets three times as many points, a face without area
    none.
    """
    p = np.array(
        [
            [0.0, 0, 0],
            [1, 0, 0],
            [0, 1, 0],
            [0, 0, 5],
            [3, 0, 5],
            [0, 1, 5],
            [0, 0, 2],
            [1, 0, 2],
            [2, 0, 2],
        ]
    )
    q = candidate(p, np.array([[6, 7, 8], [0, 1, 2], [3, 4, 5]]), even(12, STUDENTS + 1))
    shares = np.array([(np.abs(q[:, 2] - z) < 1e-6).mean() for z in (2, 0, 5)])
    return share_verdict("Three faces", shares, np.array([0, 0.25, 0.75]), AREA_HINT, 1.0, 3.0)


@check(1)
def what_comes_in_is_left_alone(candidate: Function) -> Verdict:
    """Vertices, faces and numbers are not changed."""
    p, faces = blob(STUDENTS)
    u = even(6, STUDENTS + 2)
    q = candidate(p, faces, u)
    return left_alone(
        candidate,
        full("Points came back.") if np.isfinite(q).all() else fail("Some points are not finite."),
    )


def _placed(p: np.ndarray, faces: np.ndarray, k: np.ndarray, weights: np.ndarray) -> np.ndarray:
    return np.einsum("nk,nkx->nx", weights, p[faces[k]])


def _by_area(p: np.ndarray, faces: np.ndarray, u: np.ndarray) -> np.ndarray:
    reached = np.cumsum(face_areas(p, faces))
    return np.minimum(np.searchsorted(reached, u[:, 0] * reached[-1], side="right"), len(faces) - 1)


@mistake(
    "You pick all faces alike. Small faces then get as many points as large ones: weigh them by"
    " their areas."
)
def faces_alike(p: np.ndarray, faces: np.ndarray, u: np.ndarray) -> np.ndarray:
    """Picks by number."""
    k = np.minimum((u[:, 0] * len(faces)).astype(int), len(faces) - 1)
    s = np.sqrt(u[:, 1])
    t = u[:, 2]
    return _placed(p, faces, k, np.column_stack([1 - s, s * (1 - t), s * t]))


@mistake("You left out the square root. Half of all points then lie in the quarter at corner a.")
def without_the_root(p: np.ndarray, faces: np.ndarray, u: np.ndarray) -> np.ndarray:
    """Takes the second number as it is."""
    s, t = u[:, 1], u[:, 2]
    return _placed(p, faces, _by_area(p, faces, u), np.column_stack([1 - s, s * (1 - t), s * t]))


@mistake(
    "You divided three numbers by their sum. Such weights crowd in the middle of the triangle."
)
def normalised(p: np.ndarray, faces: np.ndarray, u: np.ndarray) -> np.ndarray:
    """Takes the numbers as weights."""
    whole = u.sum(axis=1, keepdims=True)
    weights = np.where(whole > 0, u / np.where(whole > 0, whole, 1), 1 / 3)
    return _placed(p, faces, _by_area(p, faces, u), weights)


@mistake(
    "You filled the parallelogram on two edges: half of your points lie beyond the third. Fold them"
    " back, or take the root."
)
def parallelogram(p: np.ndarray, faces: np.ndarray, u: np.ndarray) -> np.ndarray:
    """Does not fold."""
    s, t = u[:, 1], u[:, 2]
    return _placed(p, faces, _by_area(p, faces, u), np.column_stack([1 - s - t, s, t]))


@mistake(
    "You picked the faces by area and then took their middles: a point belongs anywhere in its"
    " face."
)
def middles(p: np.ndarray, faces: np.ndarray, u: np.ndarray) -> np.ndarray:
    """Only middles."""
    return p[faces].mean(axis=1)[_by_area(p, faces, u)]


@alternative
def row_by_row(p: np.ndarray, faces: np.ndarray, u: np.ndarray) -> np.ndarray:
    """A loop over rows, with Heron's formula."""
    areas = []
    for face in faces:
        a, b, c = (float(np.linalg.norm(p[face[i]] - p[face[i - 1]])) for i in range(3))
        half = (a + b + c) / 2
        areas.append(max(half * (half - a) * (half - b) * (half - c), 0.0) ** 0.5)
    q = np.empty((len(u), 3))
    total = sum(areas)
    for row, (pick, s, t) in enumerate(u):
        k = 0
        left = pick * total
        while k < len(faces) - 1 and left >= areas[k]:
            left -= areas[k]
            k += 1
        a, b, c = p[faces[k]]
        q[row] = a + np.sqrt(s) * (b - a) + np.sqrt(s) * t * (c - b)
    return q
