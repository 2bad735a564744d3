"""Points on a surface: first in one triangle, to see how, then on all faces, those of one half cut
in four.
"""

from collections.abc import Callable, Iterator

import numpy as np

from lessons.measures.state import Params, State, Subject
from workbench.algorithms.surfaces.monte_carlo import OnFaces, sample_faces
from workbench.geometry.meshes import face_areas
from workbench.geometry.meshes.measures import area_centroid

# upright, before the eye
TRIANGLE = np.array([[-1.0, 0.0, -0.6], [1.0, 0.0, -0.6], [0.0, 0.0, 1.1]])
IN_TRIANGLE = (50, 200, 800, 3200)


def samples(
    params: Params, subject: Subject, rng: np.random.Generator, *, points_on_faces: OnFaces
) -> Iterator[State]:
    """Yield points in a triangle, then points on the surface."""
    face = np.array([[0, 1, 2]])
    numbers = numbers_of(params, np.ones(1), rng)
    for sampled in sample_faces(
        TRIANGLE, face, IN_TRIANGLE, numbers=numbers, points_on_faces=points_on_faces
    ):
        yield State(
            params=params,
            subject=subject,
            now=sampled,
            in_triangle=True,
            quarters=quarters(sampled.q),
        )
    p, faces = with_small_half(subject.p, subject.faces)
    areas = face_areas(p, faces)
    small = p[faces].mean(axis=1)[:, 0] > 0
    numbers = numbers_of(params, areas, rng)
    middle = area_centroid(subject.p, subject.faces)
    counts = (
        *[n for n in (30, 100, 300, 1000, 3000, 10_000, 30_000) if n < params.throws],
        params.throws,
    )
    for sampled in sample_faces(p, faces, counts, numbers=numbers, points_on_faces=points_on_faces):
        yield State(
            params=params,
            subject=subject,
            now=sampled,
            half_share=float(areas[small].sum() / areas.sum()),
            middle=middle,
            half_hits=float(np.mean(sampled.q[:, 0] > 0)),
        )


def numbers_of(
    params: Params, areas: np.ndarray, rng: np.random.Generator
) -> Callable[[int], np.ndarray]:
    """Return what draws rows of three numbers, bent where the params ask for a mistake.

    The function that makes points of them stays the right one: were the root forgotten, it would
    see the square.
    """
    reached = np.cumsum(areas) / areas.sum()

    def numbers(count: int) -> np.ndarray:
        u = rng.random((count, 3))
        if params.pick == "all alike":
            k = np.floor(u[:, 0] * len(areas)).astype(int)
            u[:, 0] = reached[k] - areas[k] / areas.sum() / 2
        if params.place == "without the root":
            u[:, 1] **= 2
        elif params.place == "normalised":
            a, b, c = rng.random((3, count))
            u[:, 1] = ((b + c) / (a + b + c)) ** 2
            u[:, 2] = c / (b + c)
        return u

    return numbers


def quarters(q: np.ndarray) -> np.ndarray:
    """Return which share of points of the triangle lies in each of its three corner quarters, and
    in the middle one.
    """
    corner = at_corners(q)
    return np.append(corner.mean(axis=0), 1 - corner.any(axis=1).mean())


def at_corners(q: np.ndarray) -> np.ndarray:
    """Tell for points of the triangle whether they lie in each of its three corner quarters, (n,
    3).
    """
    a, b, c = TRIANGLE
    weights = np.linalg.lstsq(np.stack([b - a, c - a], axis=1), (q - a).T)[0].T
    return np.column_stack([1 - weights.sum(axis=1), weights]) > 0.5


def with_small_half(p: np.ndarray, faces: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the same surface with every face at x > 0 cut into four."""
    cut = p[faces].mean(axis=1)[:, 0] > 0
    a, b, c = faces[cut].T
    n = len(a)
    ab, bc, ca = (len(p) + k * n + np.arange(n) for k in range(3))
    middles = [(p[i] + p[j]) / 2 for i, j in ((a, b), (b, c), (c, a))]
    four = [
        np.stack(corners, axis=1)
        for corners in ((a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca))
    ]
    return np.concatenate([p, *middles]), np.concatenate([faces[~cut], *four])
