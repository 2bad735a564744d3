"""Write the lens: where radial and tangential distortion move ideal image points. The lesson bends
the street's outlines with it; choose the presets barrel, pincushion and tangential to see it at
work.
"""

import numpy as np
from jaxtyping import Float

from lessons.pinhole.exercises import STUDENTS
from workbench.exercise import (
    Function,
    Verdict,
    alternative,
    band,
    beside,
    check,
    contract,
    left_alone,
    mistake,
    worst,
)
from workbench.geometry.cameras import distortion


@contract(
    slot="distort",
    examples=(
        (
            "distort(np.array([[0.5, 0.0], [0.0, 0.0]]), -0.2, 0.0, 0.0, 0.0)",
            "[[0.475, 0], [0, 0]]",
        ),
        ("distort(np.array([[0.5, 0.2]]), 0.0, 0.0, 0.01, 0.0)", "[[0.502, 0.2037]]"),
    ),
)
def distort(
    xy_camera: Float[np.ndarray, "n 2"], k1: float, k2: float, p1: float, p2: float
) -> Float[np.ndarray, "n 2"]:
    """Return where a lens puts ideal image points: Brown's model, with OpenCV's signs and order.

    With r^2 = x^2 + y^2 of the ideal point,

        x' = x (1 + k1 r^2 + k2 r^4) + 2 p1 x y + p2 (r^2 + 2 x^2)
        y' = y (1 + k1 r^2 + k2 r^4) + p1 (r^2 + 2 y^2) + 2 p2 x y

    Args:
        xy_camera: Ideal normalised coordinates (X/Z, Y/Z) in the camera frame, without unit: not
            pixels, and not yet multiplied by K. One point per row; there may be none (n = 0).
        k1: Radial coefficient of r^2; negative is barrel, positive pincushion distortion.
        k2: Radial coefficient of r^4.
        p1: Tangential coefficient that acts along y.
        p2: Tangential coefficient that acts along x.

    Returns:
        Distorted normalised coordinates, in a new array: the input stays as it is.
    """
    return distortion.distort(xy_camera, float(k1), float(k2), float(p1), float(p2))


F = 600.0  # pixels: the focal length at which errors of normalised coordinates are judged


DISTORT_HINT = "All terms use x, y and r^2 of the ideal point."


def some_rays(seed: int, n: int = 60) -> np.ndarray:
    """Return ideal points up to the corners of a picture of 53 by 43 degrees."""
    return np.random.default_rng(seed).uniform(-1, 1, (n, 2)) * [0.5, 0.4]


def bent(got: np.ndarray, right: np.ndarray, hint: str = DISTORT_HINT) -> Verdict:
    """Judge normalised coordinates by the pixels by which a camera with f = 600 px would be off."""
    error = F * float(np.linalg.norm(got - right, axis=1).max(initial=0.0))
    return band(
        "Largest error at f = 600 px",
        error,
        "px",
        good=0.01,
        fair=1.0,
        hint=beside(got, right, hint),
    )


def _bent(candidate: Function, xy: np.ndarray, *lens: float) -> Verdict:
    names = ", ".join(
        f"{name} = {k:g}" for name, k in zip(("k1", "k2", "p1", "p2"), lens, strict=True) if k
    )
    return bent(
        candidate(xy, *lens),
        distortion.distort(xy, *lens),
        f"With {names or 'no lens'}. {DISTORT_HINT}",
    )


@check(1)
def no_lens(candidate: Function) -> Verdict:
    """With all coefficients zero the points stay where they are, and the centre stays with any."""
    stays = candidate(np.zeros((1, 2)), -0.3, 0.1, 0.02, -0.01)
    return worst(
        [_bent(candidate, some_rays(STUDENTS), 0.0, 0.0, 0.0, 0.0), bent(stays, np.zeros((1, 2)))]
    )


@check(2)
def radial(candidate: Function) -> Verdict:
    """Radial terms: barrel, pincushion and r^4 are right."""
    lenses = ((-0.3, 0.0, 0.0, 0.0), (0.2, 0.0, 0.0, 0.0), (0.0, 0.4, 0.0, 0.0))
    return worst(_bent(candidate, some_rays(STUDENTS), *lens) for lens in lenses)


@check(2)
def tangential(candidate: Function) -> Verdict:
    """Tangential terms: p1 and p2 act along the right axes."""
    return worst(
        _bent(candidate, some_rays(STUDENTS), *lens)
        for lens in ((0.0, 0.0, 0.02, 0.0), (0.0, 0.0, 0.0, 0.02))
    )


@check(1)
def rays_are_left_alone(candidate: Function) -> Verdict:
    """The points that come in are not changed."""
    return left_alone(candidate, _bent(candidate, some_rays(STUDENTS + 1), -0.2, 0.05, 0.01, -0.01))


@mistake(
    "You took p1 for p2. With p1 alone, x moves by 2 p1 x y and y by p1 (r^2 + 2 y^2): p1 acts"
    " along y."
)
def p1_and_p2_swapped(
    xy_camera: np.ndarray, k1: float, k2: float, p1: float, p2: float
) -> np.ndarray:
    """Takes p1 for p2."""
    return distortion.distort(xy_camera, k1, k2, p2, p1)


@mistake("Your radial factor is 1 + k1 r + k2 r^2. It has even powers only: 1 + k1 r^2 + k2 r^4.")
def radius_not_squared(
    xy_camera: np.ndarray, k1: float, k2: float, p1: float, p2: float
) -> np.ndarray:
    """Uses 1 + k1 r + k2 r^2."""
    r = np.linalg.norm(xy_camera, axis=1, keepdims=True)
    tangential = distortion.distort(xy_camera, 0.0, 0.0, p1, p2) - xy_camera
    return xy_camera * (1 + k1 * r + k2 * r**2) + tangential


@mistake("Your answer does not depend on p1 and p2: the tangential terms are missing.")
def tangential_forgotten(
    xy_camera: np.ndarray, k1: float, k2: float, p1: float, p2: float
) -> np.ndarray:
    """Bends along the radius only."""
    return distortion.distort(xy_camera, k1, k2)


@mistake(
    "You divide by the radial factor, as if you took the lens off. `distort` goes from ideal to"
    " distorted points: multiply."
)
def the_lens_taken_off(
    xy_camera: np.ndarray, k1: float, k2: float, p1: float, p2: float
) -> np.ndarray:
    """Divides where it must multiply, as who takes the lens off would."""
    s = np.sum(xy_camera**2, axis=1, keepdims=True)
    return (xy_camera - (distortion.distort(xy_camera, 0.0, 0.0, p1, p2) - xy_camera)) / (
        1 + k1 * s + k2 * s**2
    )


@mistake(
    "You compute the tangential terms from points that are bent already. All terms use the x, y and"
    " r of the ideal point."
)
def one_after_the_other(
    xy_camera: np.ndarray, k1: float, k2: float, p1: float, p2: float
) -> np.ndarray:
    """Computes the tangential terms from points that the radial ones have moved."""
    return distortion.distort(distortion.distort(xy_camera, k1, k2), 0.0, 0.0, p1, p2)


@mistake(
    "You returned by how much the points move. Return where they are afterwards: add the points"
    " themselves."
)
def displacement_only(
    xy_camera: np.ndarray, k1: float, k2: float, p1: float, p2: float
) -> np.ndarray:
    """Returns by how much, not to where."""
    return distortion.distort(xy_camera, k1, k2, p1, p2) - xy_camera


@mistake("You multiply k2 by r^2 as you do k1. It belongs to r^4, the square of r^2.")
def fourth_power_lost(
    xy_camera: np.ndarray, k1: float, k2: float, p1: float, p2: float
) -> np.ndarray:
    """Uses r^2 for k2 as well."""
    return distortion.distort(xy_camera, k1 + k2, 0.0, p1, p2)


@alternative
def distort_by_coordinates(
    xy_camera: np.ndarray, k1: float, k2: float, p1: float, p2: float
) -> np.ndarray:
    """Writes x and y out, as OpenCV's documentation does."""
    x, y = xy_camera[:, 0], xy_camera[:, 1]
    r2 = x**2 + y**2
    radial = 1 + k1 * r2 + k2 * r2**2
    x_bent = x * radial + 2 * p1 * x * y + p2 * (r2 + 2 * x**2)
    y_bent = y * radial + p1 * (r2 + 2 * y**2) + 2 * p2 * x * y
    return np.column_stack([x_bent, y_bent])


@alternative
def distort_in_the_complex_plane(
    xy_camera: np.ndarray, k1: float, k2: float, p1: float, p2: float
) -> np.ndarray:
    """Uses z = x + iy and q = p2 + i p1: z g + 2 Re(conj(q) z) z + q |z|^2."""
    z = xy_camera[:, 0] + 1j * xy_camera[:, 1]
    q = p2 + 1j * p1
    s = (z * z.conj()).real
    bent = z * (1 + k1 * s + k2 * s * s) + 2 * (q.conjugate() * z).real * z + q * s
    return np.stack([bent.real, bent.imag], axis=1)
