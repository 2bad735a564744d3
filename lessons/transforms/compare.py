"""Second readings of the same numbers: each the picture of one mistake, or of two names for one
thing.
"""

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from lessons.transforms.body import Numbers
from lessons.transforms.state import Body, Compare, Ghost, Params
from workbench.geometry.motions import inverse, motion
from workbench.geometry.motions.affine import transform
from workbench.geometry.motions.alignment import align_rigid
from workbench.geometry.motions.rotations import (
    EulerOrder,
    gimbal_margin,
    locked_family,
    matrix_from_quaternion,
    other_triple,
    quaternion_from_matrix,
)
from workbench.numerals import brief

BEHIND, ALONG = (
    np.array([-1.6, 1.4, 0.0]),
    np.array([0.95, 0.58, 0.0]),
)  # a row across the first view, metres
CONVENTIONS: tuple[EulerOrder, ...] = ("xyz", "XYZ", "ZYX", "ZXZ")


def ghosts_of(params: Params, body: Body, numbers: Numbers, A: np.ndarray) -> tuple[Ghost, ...]:
    """Return the second readings of the whole map, to be compared with the body before it is taken
    back.

    Args:
        params: Which comparison is asked for.
        body: What is moved.
        numbers: The rigid part of the map.
        A: The part of the map that changes the shape.
    """
    make = _READINGS.get(params.compare)
    p_ours = transform(numbers.motion() @ A, body.solid.p)
    if params.compare == "best rigid motion":
        return (_ghost("best rigid motion", align_rigid(p_ours, body.solid.p), body, p_ours),)
    if make is None:
        return ()
    ghosts = tuple(_ghost(name, other @ A, body, p_ours) for name, other in make(numbers))
    if params.compare == "four conventions":  # in a row behind the body
        return tuple(replace(g, apart=BEHIND + (k - 1.5) * ALONG) for k, g in enumerate(ghosts))
    return ghosts


def undo_ghosts_of(
    params: Params, body: Body, T_world_body: np.ndarray, A: np.ndarray
) -> tuple[Ghost, ...]:
    """Return the body after a wrong inverse, to be compared with the body before the motion."""
    T = T_world_body @ A
    if params.compare == "undo by (Rᵀ, −t)":
        T_body_wrong = motion(T_world_body[:3, :3].T, -T_world_body[:3, 3])
        return (_ghost("(Rᵀ, −t)", T_body_wrong @ T, body, transform(A, body.solid.p)),)
    if params.compare == "undo all as if rigid":
        return (_ghost("(Mᵀ, −Mᵀt), with M the 3×3 of T,", inverse(T) @ T, body, body.solid.p),)
    return ()


def _ghost(name: str, T: np.ndarray, body: Body, p_ours: np.ndarray) -> Ghost:
    distance = float(np.linalg.norm(transform(T, body.solid.p) - p_ours, axis=1).max())
    return Ghost(name=name, T=T, distance=distance)


def in_degrees(angles: np.ndarray) -> str:
    """Write a triple of angles in degrees between -180 and 180, to a hundredth of a degree."""
    around = (np.degrees(angles).round(2) + 180.0) % 360.0 - 180.0
    return "(" + ", ".join(brief(a, 5) for a in around.round(2)) + ")°"


def _other_order(numbers: Numbers) -> list[tuple[str, np.ndarray]]:
    return [(numbers.swapped().first, numbers.swapped().motion())]


def _four_conventions(numbers: Numbers) -> list[tuple[str, np.ndarray]]:
    return [(f"read as {order}", replace(numbers, order=order).motion()) for order in CONVENTIONS]


def _fixed_and_own(numbers: Numbers) -> list[tuple[str, np.ndarray]]:
    other: EulerOrder = numbers.order.swapcase()  # type: ignore[assignment]
    backwards: EulerOrder = other[::-1]  # type: ignore[assignment]
    angles = numbers.angles[::-1]
    return [
        (
            f"{backwards} {in_degrees(angles)}",
            replace(numbers, order=backwards, angles=angles).motion(),
        ),
        (f"{other} {in_degrees(numbers.angles)}", replace(numbers, order=other).motion()),
    ]


def other_triples(numbers: Numbers) -> np.ndarray:
    """Return other angles for the same rotation: three of a family in gimbal lock, elsewhere the
    only other one.
    """
    if gimbal_margin(numbers.angles, numbers.order) < 1e-12:
        return locked_family(numbers.angles, numbers.order, np.radians([40.0, 80.0, -60.0]))
    return other_triple(numbers.angles, numbers.order)[None]


def _other_triples(numbers: Numbers) -> list[tuple[str, np.ndarray]]:
    return [
        (in_degrees(triple), replace(numbers, angles=triple).motion())
        for triple in other_triples(numbers)
    ]


def _transpose(numbers: Numbers) -> list[tuple[str, np.ndarray]]:
    T = numbers.motion()
    return [("Rᵀ: the axes turned, not the body", motion(T[:3, :3].T, T[:3, 3]))]


def _xyzw(numbers: Numbers) -> list[tuple[str, np.ndarray]]:
    T = numbers.motion()
    w, x, y, z = quaternion_from_matrix(T[:3, :3])
    misread = matrix_from_quaternion(np.array([z, w, x, y]))  # w x y z, taken for x y z w
    return [("wxyz read as xyzw", motion(misread, T[:3, 3]))]


_READINGS: dict[Compare, Callable[[Numbers], list[tuple[str, np.ndarray]]]] = {
    "the other order": _other_order,
    "four conventions": _four_conventions,
    "fixed and own axes": _fixed_and_own,
    "other triples": _other_triples,
    "transpose": _transpose,
    "xyzw for wxyz": _xyzw,
}
