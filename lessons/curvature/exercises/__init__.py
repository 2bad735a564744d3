"""The exercises of this lesson: what the angles around a vertex miss, Gaussian curvature, the
mean-curvature normal.
"""

import numpy as np

from workbench.data.shapes import surfaces
from workbench.data.shapes.surfaces import Surface
from workbench.exercise import HiddenSeed, Verdict, against, band, fail, partial
from workbench.geometry.meshes import face_areas, on_boundary
from workbench.geometry.motions import exp_so3

# seeds of what a student sees run, and of what only a grader does
STUDENTS = 21
GRADERS = HiddenSeed(8123)


Mesh = tuple[np.ndarray, np.ndarray]


def irregular(name: str, seed: int, count: int = 150) -> Surface:
    """Return a built-in surface whose vertices were moved about on it, so that no two triangles are
    alike.
    """
    return surfaces.SURFACES[name](count, jitter=0.2, rng=np.random.default_rng(seed))


def with_a_flat_face(p: np.ndarray, faces: np.ndarray) -> Mesh:
    """Return the mesh with a vertex in the middle of the first face's first edge, and there a face
    without area.
    """
    a, b, c = faces[0]
    middle = len(p)
    new = np.array([[a, middle, c], [middle, b, c], [a, b, middle]])
    return np.concatenate([p, (p[[a]] + p[[b]]) / 2]), np.concatenate([faces[1:], new])


def box(seed: int) -> Mesh:
    """Return a box of edges from half a metre to two, two triangles per side."""
    p = np.array([[x, y, z] for x in (0.0, 1.0) for y in (0.0, 1.0) for z in (0.0, 1.0)])
    sides = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))
    faces = np.array([face for a, b, c, d in sides for face in ((a, b, c), (a, c, d))])
    return p * np.random.default_rng(seed).uniform(0.5, 2.0, 3), faces


def some_rotation(seed: int) -> np.ndarray:
    """Return a rotation by about half a turn about some axis."""
    return exp_so3(np.random.default_rng(seed).normal(size=3) * 1.5)


def curvature_verdict(
    got: np.ndarray,
    right: np.ndarray,
    hint: str,
    *,
    good: float,
    fair: float,
    size: float = 0.0,
    label: str = "",
) -> Verdict:
    """Judge numbers or vectors at the vertices in per cent; where `right` is nan, nan is asked for.

    Args:
        got: The answer.
        right: The right one; nan on the border.
        hint: What to look at where it is wrong.
        good: Per cent of error up to which all points are earned.
        fair: The same for half of them.
        size: What the error is related to; the largest of `right` where it is not given.
        label: How the message begins: the mesh.
    """
    got, right = got.reshape(len(got), -1), right.reshape(len(right), -1)
    inside = ~np.isnan(right).any(axis=1)
    lost = np.flatnonzero(inside & ~np.isfinite(got).all(axis=1))
    if lost.size:
        i = lost[0]
        message = (
            f"{label}{lost.size} of {inside.sum()} vertices inside the border have no finite value."
            f" At vertex {i} yours is"
        )
        return fail(f"{message} {against(got[i].squeeze(), right[i].squeeze())}. {hint}")
    away = np.zeros(len(got))
    away[inside] = np.linalg.norm(got[inside] - right[inside], axis=1)
    i = int(np.argmax(away))
    off = away.max()
    told = f"At vertex {i} yours is {against(got[i].squeeze(), right[i].squeeze())}. {hint}"
    size = size or float(np.linalg.norm(right[inside], axis=1).max())
    verdict = band(
        f"{label}largest error" if label else "Largest error",
        100 * float(off) / size,
        "%",
        good=good,
        fair=fair,
        hint=told,
    )
    stray = int((~np.isnan(got[~inside])).any(axis=1).sum())
    if stray and verdict.share > 0:
        message = (
            f"{label}{stray} of {(~inside).sum()} border vertices have a value; the contract asks"
            " for nan on the border."
        )
        return partial(
            0.5,
            (
                f"{message} The others are right."
                if verdict.share == 1.0
                else f"{message} {verdict.message}"
            ),
        )
    return verdict


def without_border(surface: Surface, right: np.ndarray) -> np.ndarray:
    """Return values at the vertices with nan on the border."""
    right = right.copy()
    right[on_boundary(surface.faces, len(surface.p))] = np.nan
    return right


TETRAHEDRON = "np.eye(4, 3), np.array([[0, 1, 2], [3, 1, 0], [3, 2, 1], [3, 0, 2]])"


TRIANGLE = "np.eye(3), np.array([[0, 1, 2]])"


def border_of(count: int, faces: np.ndarray) -> np.ndarray:
    """Which vertices have an edge with one face only."""
    half = np.sort(np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]), axis=1)
    edges, times = np.unique(half, axis=0, return_counts=True)
    return np.isin(np.arange(count), edges[times == 1])


def thirds(p: np.ndarray, faces: np.ndarray) -> np.ndarray:
    """A third of every face."""
    return np.bincount(faces.ravel(), np.repeat(face_areas(p, faces) / 3, 3), len(p))
