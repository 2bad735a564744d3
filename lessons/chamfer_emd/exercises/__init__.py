"""The exercises of this lesson: one side of Chamfer, both sides, earth mover's distance. Judged by
relative error.
"""

import numpy as np

from workbench.exercise import (
    Function,
    HiddenSeed,
    Verdict,
    against,
    fail,
    full,
    number,
    partial,
    refused,
    worst,
)
from workbench.geometry.motions import apply, exp_so3, motion

# seeds of what a student sees run, and of what only a grader does
STUDENTS = 53
GRADERS = HiddenSeed(7718)


Cloud = np.ndarray


ZERO = 1e-7  # metres, or square metres: what counts as 0


def value_verdict(got: float, right: float, unit: str, hint: str, label: str = "") -> Verdict:
    """Judge a distance by its relative error: all points up to 0.01 %, half up to 1 %; a distance
    of 0 by itself.
    """
    yours = f"{label}yours" if label else "Yours"
    if right == 0.0:
        if abs(got) <= ZERO:
            return full(f"{label}{number(got, 2)} {unit}, as good as 0.")
        return fail(f"{yours} is {number(got)} {unit}, right is 0. {hint}")
    off = 100 * abs(got - right) / right
    if off <= 0.01:
        return full(f"{label}{number(got)} {unit}, right within 0.01 %.")
    message = f"{yours} is {against(got, right, 5, unit=unit)}: {number(off, 3)} % off"
    if off <= 1:
        return partial(0.5, f"{message}, close; full marks need 0.01 %. {hint}")
    return fail(f"{message}. {hint}")


def two_clouds(seed: int, n: int, m: int) -> tuple[Cloud, Cloud]:
    """Return n and m points of two lumps, half a metre in size, that overlap."""
    rng = np.random.default_rng(seed)
    return rng.normal(size=(n, 3)) * [0.5, 0.3, 0.2], rng.normal(size=(m, 3)) * [0.3, 0.5, 0.2] + [
        0.3,
        -0.1,
        0.2,
    ]


def moved_together(seed: int, p_a: Cloud, p_b: Cloud, metres: float) -> tuple[Cloud, Cloud]:
    """Return both clouds after one random turn, and a shift by this far."""
    w, v = np.random.default_rng(seed).normal(size=(2, 3))
    T = motion(exp_so3(w), metres * v / np.linalg.norm(v))
    return apply(T, p_a), apply(T, p_b)


def reordered(seed: int, p: Cloud) -> Cloud:
    """Return the points in another order."""
    return np.random.default_rng(seed).permutation(p)


def no_points_refused(candidate: Function) -> Verdict:
    """Judge calls with an empty cloud on either side, or on both."""
    none, some = np.empty((0, 3)), np.ones((4, 3))
    calls = (
        (none, some, "An empty p_a"),
        (some, none, "An empty p_b"),
        (none, none, "Two empty clouds"),
    )
    return worst(refused(candidate, p_a, p_b, what=label) for p_a, p_b, label in calls)


PAIR = "np.array([[0.0, 0, 0], [1, 0, 0]])"


def all_distances(p_a: np.ndarray, p_b: np.ndarray) -> np.ndarray:
    """Return the distance of every point of a to every point of b, (n, m)."""
    return np.sqrt(np.sum((p_a[:, None] - p_b[None]) ** 2, axis=2))


def rows_of_both(p_a: np.ndarray, p_b: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return both clouds as if row k of one belonged to row k of the other, the shorter one over
    again.
    """
    k = np.arange(max(len(p_a), len(p_b)))
    return p_a[k % len(p_a)], p_b[k % len(p_b)]
