"""What points_on_faces is graded by besides the checks that a student sees."""

import numpy as np

from lessons.measures.exercises import GRADERS, blob, relative_verdict
from lessons.measures.exercises.points_on_faces import (
    AREA_HINT,
    PLACE_HINT,
    even,
    filled,
    nothing,
    weights_of,
)
from lessons.measures.samples import with_small_half
from workbench.exercise import Function, Verdict, check, fail, worst
from workbench.geometry.meshes import face_areas


@check(2, public=False)
def a_whole_surface(candidate: Function) -> Verdict:
    """On a mesh of faces of many sizes every part gets its share, face by face, and on one a
    thousandth as large.
    """
    p, faces = with_small_half(*blob(GRADERS()))
    q = candidate(p, faces, even(16, GRADERS()))
    areas = face_areas(p, faces)
    middle = areas @ p[faces].mean(axis=1) / areas.sum()
    size = float(np.linalg.norm(np.ptp(p, axis=0)))
    off = 100 * float(np.linalg.norm(q.mean(axis=0) - middle)) / size
    quantity = "Mean of the points off the surface's middle, % of the diagonal"
    large = relative_verdict(quantity, off, 0.0, AREA_HINT, good=0.8, fair=1.5, size=100)
    off = (
        float(
            np.linalg.norm(
                1000 * candidate(0.001 * p, faces, even(16, GRADERS())).mean(axis=0) - middle
            )
        )
        / size
    )
    small = relative_verdict(
        f"{quantity}, of a small one", 100 * off, 0.0, AREA_HINT, good=0.8, fair=1.5, size=100
    )
    return worst((large, small))


@check(2, public=False)
def other_triangles(candidate: Function) -> Verdict:
    """Long and small triangles are filled evenly too."""
    return worst(
        filled(candidate, triangle, GRADERS() + k)
        for k, triangle in enumerate(
            (
                np.array([[0.0, 0, 0], [10, 0, 0], [0, 0.1, 0]]),
                np.array([[5.0, 5, 5], [5, 5.01, 5], [5.01, 5, 5.01]]),
            )
        )
    )


@check(1, public=False)
def the_same_row_gives_the_same_point(candidate: Function) -> Verdict:
    """Rows do not know of each other: in another order they give the same points, and so they do
    again.
    """
    p, faces = blob(GRADERS() + 1)
    u = even(7, GRADERS() + 3)
    q = candidate(p, faces, u)
    again = candidate(p, faces, u[::-1].copy())
    off = float(np.linalg.norm(q - again[::-1], axis=1).max())
    hint = "Use the rows of u, in their order, and no numbers of your own."
    return worst(
        [nothing("The same rows give points apart by, m", off, hint), each_number_counts(candidate)]
    )


def each_number_counts(candidate: Function) -> Verdict:
    """Judge whether the second number and the third each move the point in its face, and the first
    does not.
    """
    triangle = np.array([[1.0, 0, 0], [0, 2, 0.5], [-1, -1, 2]])
    faces = np.array([[0, 1, 2]])
    u = np.array([[0.3, 0.4, 0.2], [0.6, 0.4, 0.2], [0.3, 0.7, 0.2], [0.3, 0.4, 0.6]])
    q = candidate(triangle, faces, u)
    moved = np.linalg.norm(q[1:] - q[0], axis=1)
    for k, name in ((1, "second"), (2, "third")):
        if moved[k] < 1e-3:
            return fail(
                f"Another {name} number moves the point by {moved[k]:.3g} m, right is more than 0."
                f" {PLACE_HINT}"
            )
    hint = (
        "With a single face the first number has nothing to pick, and it does not place the point."
    )
    return nothing(
        "In a single face another first number moves the point by, m", float(moved[0]), hint
    )


@check(1, public=False)
def numbers_at_the_ends(candidate: Function) -> Verdict:
    """0 and what is next to 1 give points of the mesh as well, one row one point, and no rows no
    points.
    """
    triangle = np.array([[1.0, 0, 0], [0, 2, 0.5], [-1, -1, 2]])
    faces = np.array([[0, 1, 2]])
    if len(candidate(triangle, faces, np.empty((0, 3)))):
        return fail("No rows came in, and points went out.")
    u = np.array(
        [[a, b, c] for a in (0.0, 1 - 1e-16) for b in (0.0, 1 - 1e-16) for c in (0.0, 1 - 1e-16)]
    )
    weights = weights_of(candidate(triangle, faces, u), triangle)
    single = weights_of(candidate(triangle, faces, np.array([[0.2, 0.5, 0.3]])), triangle)
    off = float(-min(weights.min(), single.min()))
    # ten times a tenth is not quite 1
    p = np.concatenate([[[0.0, 0, z], [1, 0, z], [0, 1, z]] for z in range(10)])
    x, y, z = candidate(p, np.arange(30).reshape(10, 3), u).T
    off = max(
        off, float(-np.min([x, y, 1 - x - y])), float(np.abs(z - np.rint(np.clip(z, 0, 9))).max())
    )
    return nothing(
        "Farthest off the triangles, in edges", off, "Look at rows of 0 and of nearly 1."
    )
