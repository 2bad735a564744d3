"""What plane_from_points is graded by besides the checks that a student sees."""

import numpy as np

from lessons.ransac.exercises import GRADERS
from lessons.ransac.exercises.plane_from_points import a_triangle, found, no_plane, plane_verdict
from workbench.exercise import Function, Verdict, check, worst
from workbench.geometry.motions import exp_so3


@check(2, public=False)
def moved_and_turned(candidate: Function) -> Verdict:
    """Points that are turned and moved take their plane along, whichever of them comes first."""
    rng = np.random.default_rng(GRADERS())
    verdicts = []
    for k in range(3):
        p = a_triangle(rng)
        R = exp_so3(rng.normal(size=3))
        t = rng.uniform(-3.0, 3.0, 3)
        plane = candidate(p)
        moved = p @ R.T + t
        taken = np.append(R @ plane[:3], plane[3] - R @ plane[:3] @ t)
        verdicts += [
            found(candidate, p, "Before the move"),
            plane_verdict(candidate(moved), taken, moved, "Turned and moved"),
        ]
        verdicts.append(found(candidate, np.roll(p, k, axis=0)[::-1].copy(), "In another order"))
    return worst(verdicts)


@check(2, public=False)
def upright_and_through_the_origin(candidate: Function) -> Verdict:
    """A wall, which has no height over the floor, and planes through the origin are found."""
    rng = np.random.default_rng(GRADERS() + 10)
    wall = np.array([[0.5, -1.0, 0.0], [2.0, 1.0, 0.0], [0.5, -1.0, 2.4]])
    through = a_triangle(rng)
    through[2] = 0.7 * through[0] - 0.4 * through[1]
    corner = a_triangle(rng)
    corner[0] = 0.0
    verdicts = [plane_verdict(candidate(wall), np.array([0.8, -0.6, 0.0, -1.0]), wall, "Wall")]
    for p, case in (
        (through, "A plane through the origin"),
        (corner, "The origin is one of the points"),
    ):
        verdicts.append(found(candidate, p, case))
    for k in range(
        12
    ):  # the planes of the axes, run round either way: two entries of the normal are 0
        level = np.column_stack([rng.normal(size=(3, 2)), np.zeros(3)])[:, np.roll([0, 1, 2], k)]
        verdicts.append(found(candidate, level, f"The plane of two axes, number {k}"))
    return worst(verdicts)


@check(2, public=False)
def small_large_and_far(candidate: Function) -> Verdict:
    """Sides of a micrometre and of a kilometre, and triangles a kilometre away, have a plane
    too.
    """
    rng = np.random.default_rng(GRADERS() + 20)
    verdicts = [
        found(candidate, a_triangle(rng, size), f"Sides of {size:g} m")
        for size in (1e-3, 1e-6, 1e3)
    ]
    far = a_triangle(rng) + np.array([800.0, -600.0, 50.0])
    thin = np.array([[0.0, 0.0, 1.0], [1.0, 0.0, 1.0], [0.5, 1e-4, 1.0]])
    verdicts.append(found(candidate, far, "1 km away"))
    for size, name in (
        ([1.0, 1.0, 1.0], "1 m"),
        ([1e-3, 1e-3, 1.0], "1 mm"),
        ([1e-6, 1e-6, 1e-6], "1 µm"),
    ):
        verdicts.append(
            found(candidate, thin * size, f"{name} long and a ten-thousandth of that high")
        )
    return worst(verdicts)


@check(2, public=False)
def nearly_on_a_line(candidate: Function) -> Verdict:
    """Points on one line but for rounding give four nan, near and a kilometre apart; thirty times
    the bound is a plane.
    """
    rng = np.random.default_rng(GRADERS() + 30)
    verdicts = []
    for size in (1.0, 1e3, 1e-3):
        direction, start = rng.normal(size=(2, 3))
        p = size * (start + np.outer([0.1, 0.7, -0.9], direction))
        verdicts.append(no_plane(candidate(p), f"On one line but for rounding, {size:g} m in size"))
    for k, size in enumerate(
        (1e3, 1e-3, 1e3, 1e-3, 1e3, 1e-3)
    ):  # long along each axis, and high along the next one
        p = np.zeros((3, 3))
        p[0, k % 3] = size
        p[1, k % 3] = 0.5 * size
        for share in (3e-8, 3e-11):  # of the squared longest side
            p[1, (k + 1) % 3] = share * size
            case = (
                f"{size:g} m long, the cross product {share / 1e-9:g} billionths of the squared"
                " longest side"
            )
            verdicts.append(
                found(candidate, p, case) if share > 1e-9 else no_plane(candidate(p), case)
            )
    return worst(verdicts)
