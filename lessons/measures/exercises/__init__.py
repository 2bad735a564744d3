"""The exercises of this lesson: the volume of a mesh, points spread over it, and a volume by
chance.
"""

import numpy as np

from workbench.data.shapes import solids, surfaces
from workbench.exercise import HiddenSeed, Verdict, against, fail, full, partial
from workbench.geometry.motions import exp_so3

# seeds of what a student sees run, and of what only a grader does
STUDENTS = 31
GRADERS = HiddenSeed(9241)

Mesh = tuple[np.ndarray, np.ndarray]

TETRAHEDRON = "np.eye(4, 3), np.array([[0, 1, 2], [3, 1, 0], [3, 2, 1], [3, 0, 2]])"
TRIANGLE = "np.eye(3), np.array([[0, 1, 2]])"


def relative_verdict(
    quantity: str,
    got: float,
    right: float,
    hint: str,
    *,
    good: float,
    fair: float,
    size: float = 0.0,
) -> Verdict:
    """Judge one number by its relative error, in per cent, and say both numbers.

    Args:
        quantity: What the number is, as a message begins.
        got: The answer.
        right: The right one.
        hint: What to look at where it is wrong.
        good: Per cent of error up to which all points are earned.
        fair: The same for half of them.
        size: What the error is related to; the right answer where it is not given.
    """
    message = f"{quantity}: {against(got, right, 5)}"
    off = 100 * abs(got - right) / (size or abs(right))
    if off <= good:
        return full(f"{message}.")
    return partial(0.5, f"{message}: close. {hint}") if off <= fair else fail(f"{message}. {hint}")


def blob(seed: int, middle: tuple[float, float, float] = (0.0, 0.0, 0.0)) -> Mesh:
    """Return a lopsided closed mesh without symmetry, turned somehow, its triangles of different
    sizes.
    """
    rng = np.random.default_rng(seed)
    torus = surfaces.torus(180, 1.0, 0.4, jitter=0.2, rng=rng)
    p = torus.p * [1.0, 0.7, 1.6] + 0.25 * torus.p[:, [1, 2, 0]] ** 2
    return p @ exp_so3(rng.normal(size=3)).T + np.array(middle), torus.faces


def l_block() -> Mesh:
    """Return a block that is not convex: 0.475 m^2 of floor, half a metre high."""
    solid = solids.l_block()
    return solid.p, solid.faces


def without_a_side(p: np.ndarray, faces: np.ndarray) -> Mesh:
    """Return a mesh without the faces whose middle is among the upper third along x."""
    x = p[faces].mean(axis=1)[:, 0]
    return p, faces[x < np.quantile(x, 0.7)]
