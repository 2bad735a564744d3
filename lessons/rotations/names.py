"""Names of one turn, and what goes wrong with each: every step is one value, or one reading."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np

from lessons.rotations.inputs import Input
from workbench.algorithms.interpolation import FromEuler, Rodrigues
from workbench.geometry.motions.alignment import degrees_between
from workbench.geometry.motions.rotations import (
    EulerOrder,
    axis_angle_from_rotation,
    euler_axes,
    euler_to_matrix,
    gimbal_margin,
    locked_family,
    matrix_from_quaternion,
    other_triple,
    quaternion_from_matrix,
    rotation_about,
)
from workbench.numerals import brief

PITCHES = np.arange(-90.0, 91.0, 2.0)  # degrees, all that the middle ring can do
ENDS = np.arange(0.0, 361.0, 5.0)
APARTS = np.arange(0.0, 181.0, 5.0)
PIECES = 60
CONVENTIONS: tuple[EulerOrder, ...] = ("xyz", "XYZ", "ZYX", "ZXZ")


@dataclass(frozen=True, eq=False, kw_only=True)
class Named:
    """One value of the number under the hand: degrees, and the 3x3 that it makes."""

    value: float
    R: np.ndarray


@dataclass(frozen=True, eq=False, kw_only=True)
class Read:
    """One reading: what it is called, its rotation, and how far that is from the right one,
    degrees.
    """

    name: str
    R: np.ndarray
    off: float


def rings(params: Input, euler_to_matrix: FromEuler) -> Iterator[Named]:
    """Yield the pitches of the middle ring; the other two angles are those of the params."""
    first, _, third = params.angles
    for pitch in PITCHES:
        R = euler_to_matrix(np.radians([first, pitch, third]), params.order)
        yield Named(value=float(pitch), R=np.asarray(R, float))


def chain(params: Input, rotation_from_axis_angle: Rodrigues) -> Iterator[Named]:
    """Yield the one turn that the three turns make, from 0 to its whole angle."""
    axis, whole = whole_turn(params)
    for share in np.linspace(0.0, 1.0, PIECES + 1):
        R = rotation_from_axis_angle(axis, float(share * whole))
        yield Named(value=float(np.degrees(share * whole)), R=np.asarray(R, float))


def whole_turn(params: Input) -> tuple[np.ndarray, float]:
    """Return the axis and the angle, radians, of the three turns together."""
    return axis_angle_from_rotation(euler_to_matrix(np.radians(params.angles), params.order))


def ends() -> Iterator[Named]:
    """Yield turns about the vertical, from none to a whole one."""
    for angle in ENDS:
        yield Named(value=float(angle), R=rotation_about("z", np.radians(angle)))


def means() -> Iterator[Named]:
    """Yield the mean of the entries of two rotations about the vertical, ever farther apart."""
    for apart in APARTS:
        R_end = rotation_about("z", np.radians(apart))
        yield Named(value=float(apart), R=0.5 * (np.eye(3) + R_end))


def readings(params: Input, euler_to_matrix: FromEuler) -> Iterator[Read]:
    """Yield the rotation as it is meant, and then each other reading of the same numbers."""
    R = np.asarray(euler_to_matrix(np.radians(params.angles), params.order), float)
    yield Read(name=f"{params.order} {in_degrees(np.radians(params.angles))}", R=R, off=0.0)
    for name, other in READINGS[params.compare](params, R):
        yield Read(name=name, R=other, off=degrees_between(other, R))


Other = tuple[str, np.ndarray]


def in_degrees(angles: np.ndarray) -> str:
    """Return a triple of angles as words, in degrees between -180 and 180."""
    around = (np.degrees(angles).round(2) + 180.0) % 360.0 - 180.0
    return "(" + ", ".join(brief(a, 5) for a in around.round(2)) + ")°"


def _conventions(params: Input, _: np.ndarray) -> list[Other]:
    angles = np.radians(params.angles)
    return [(f"read as {order}", euler_to_matrix(angles, order)) for order in CONVENTIONS]


def _fixed_and_own(params: Input, _: np.ndarray) -> list[Other]:
    other: EulerOrder = params.order.swapcase()  # type: ignore[assignment]
    backwards: EulerOrder = other[::-1]  # type: ignore[assignment]
    angles = np.radians(params.angles)
    named: tuple[tuple[EulerOrder, np.ndarray], ...] = (
        (backwards, angles[::-1]),
        (other, angles),
        (backwards, angles),
    )
    return [(f"{order} {in_degrees(a)}", euler_to_matrix(a, order)) for order, a in named]


def other_triples(params: Input) -> np.ndarray:
    """Return other angles for the same rotation: three of a family in gimbal lock, elsewhere the
    only other one.
    """
    angles = np.radians(params.angles)
    if gimbal_margin(angles, params.order) < 1e-12:
        return locked_family(angles, params.order, np.radians([40.0, 80.0, -60.0]))
    return other_triple(angles, params.order)[None]


def _other_triples(params: Input, _: np.ndarray) -> list[Other]:
    triples = other_triples(params)
    return [(in_degrees(triple), euler_to_matrix(triple, params.order)) for triple in triples]


def _transpose(_params: Input, R: np.ndarray) -> list[Other]:
    return [("Rᵀ: the axes turned, not the body", R.T)]


def _xyzw(_params: Input, R: np.ndarray) -> list[Other]:
    w, x, y, z = quaternion_from_matrix(R)
    misread = matrix_from_quaternion(np.array([z, w, x, y]))  # w x y z, taken for x y z w
    return [("wxyz read as xyzw", misread)]


READINGS: dict[str, Callable[[Input, np.ndarray], list[Other]]] = {
    "four conventions": _conventions,
    "fixed and own axes": _fixed_and_own,
    "other triples": _other_triples,
    "transpose": _transpose,
    "xyzw for wxyz": _xyzw,
}


def axles(params: Input, pitch: float) -> np.ndarray:
    """Return the axles (3, 3) of the three angles as rows, in the order of the letters."""
    first, _, third = params.angles
    return euler_axes(np.radians([first, pitch, third]), params.order)


def knob_degrees(axes: np.ndarray) -> float:
    """Return how many degrees the angles change, as the root of their squares, where the body turns
    by 1 degree in the worst direction; infinite in gimbal lock.
    """
    smallest = float(np.linalg.svd(axes, compute_uv=False)[-1])
    return 1.0 / smallest if smallest > 1e-7 else float("inf")
