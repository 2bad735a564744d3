"""The numbers beside the picture: the 4x4, what survived, one point and one direction, the rotation's other names."""

import numpy as np

from lessons.transforms.body import FRONT
from lessons.transforms.states import Built, State
from workbench.geometry.affine import decompose, kind_of
from workbench.geometry.invariants import Change
from workbench.geometry.rotations import (
    EulerOrder,
    axis_angle_from_rotation,
    matrix_to_euler,
    quaternion_from_matrix,
)
from workbench.scene import Table


def number(value: float) -> str:
    """Write a number with two decimals, without a negative zero."""
    return f"{value + 0.0 if abs(value) >= 0.005 else 0.0:.2f}"


def row(values: np.ndarray) -> str:
    """Write some numbers in a row."""
    return ", ".join(number(value) for value in values)


def matrix(T: np.ndarray, title: str) -> Table:
    """Show a 4x4; its columns are where the axes and the origin go."""
    header = ("x axis", "y axis", "z axis", "origin")
    return Table(title, header, tuple(tuple(number(value) for value in line) for line in T))


def amount(change: Change) -> str:
    """Say in a few words what became of a measure."""
    if change.kept:
        return "kept"
    if change.name == "orientation":
        return "flipped"
    return f"±{np.degrees(change.amount):.3g}°" if change.unit == "rad" else f"±{100 * change.amount:.3g} %"


def invariants(state: State) -> Table:
    """Show which measures of the body survived, this factor and all of them."""
    if isinstance(state, Built):
        header = ("measured", "this factor", "all so far")
        lines = [(a.name, amount(a), amount(b)) for a, b in zip(state.by_factor, state.by_all, strict=True)]
        kinds = ("kind of map", kind_of(state.factor.matrix).value, kind_of(state.T).value)
        return Table("What survives", header, (kinds, *lines))
    lines = [(change.name, amount(change)) for change in state.by_all]
    return Table(
        "What survives", ("measured", "since the start"), (("kind of map", kind_of(state.T_world_body).value), *lines)
    )


def one_point(state: Built) -> Table:
    """Show the followed vertex (w = 1) and the direction to the front (w = 0) before and after the map."""
    columns = [np.append(state.body.p_point, 1.0), np.append(FRONT, 0.0)]
    p, v = columns
    after_p, after_v = state.T @ p, state.T @ v
    lines = zip("xyzw", p, after_p, v, after_v, strict=True)
    return Table(
        "A point and a direction",
        ("", f"vertex {state.body.point}", "T · vertex", "front", "T · front"),
        tuple((name, *(number(value) for value in values)) for name, *values in lines),
    )


def in_other_numbers(T: np.ndarray, order: EulerOrder) -> Table:
    """Show the rotation in a 4x4 under its other names; what stretches or mirrors is split off first."""
    parts = decompose(T)
    R = parts.rotation
    axis, angle = axis_angle_from_rotation(R)
    q = quaternion_from_matrix(R)
    stretches = np.linalg.eigvalsh(parts.stretch)[::-1]
    return Table(
        "The rotation, in other numbers",
        ("name", "numbers"),
        (
            (f"Euler {order}", ", ".join(f"{a + 0.0:.1f}°" for a in np.degrees(matrix_to_euler(R, order)).round(1))),
            ("axis", row(axis)),
            ("angle", f"{np.degrees(angle):.1f}°"),
            ("quaternion w, x, y, z", row(q)),
            ("stretch", row(stretches)),
            ("det T", number(float(np.linalg.det(T[:3, :3])))),
        ),
    )
