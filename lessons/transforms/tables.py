"""The numbers beside the picture: the 4×4, what survived, one point and one direction, the rotation's other names."""

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
from workbench.numerals import ROUND_OFF, brief, fixed, fixed_row
from workbench.scene import Table


def matrix(T: np.ndarray, title: str) -> Table:
    """Show a 4×4; its columns are where the axes and the origin go."""
    header = ("x axis", "y axis", "z axis", "origin")
    return Table(title, header, tuple(tuple(fixed(value, 2) for value in line) for line in T))


def amount(change: Change) -> str:
    """Say in a few words what became of a measure."""
    if change.kept:
        return "kept"
    if change.name == "orientation":
        return "flipped"
    if change.unit == "rad":
        return f"up to {brief(np.degrees(change.amount))}°"
    most = "up to " if change.name == "edge lengths" else ""  # area and volume are one number each
    return f"{most}{brief(100 * change.amount)} %"


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
        tuple((name, *(fixed(value, 2) for value in values)) for name, *values in lines),
    )


def in_other_numbers(T: np.ndarray, T_world_body: np.ndarray, order: EulerOrder) -> Table:
    """Show the rotation in a 4×4 under its other names; what stretches or mirrors is split off first.

    A projective map has no such parts: then the rotation is that of its rigid factors alone.
    """
    affine = np.array_equal(T[3], (0, 0, 0, 1))
    parts = decompose(T if affine else T_world_body)
    R = parts.rotation
    axis, angle = axis_angle_from_rotation(R)
    rows = [
        (f"Euler {order}", ", ".join(f"{fixed(a, 1)}°" for a in np.degrees(matrix_to_euler(R, order)))),
        ("axis", fixed_row(axis, 2) if angle > ROUND_OFF else "any"),
        ("angle", f"{fixed(np.degrees(angle), 1)}°"),
        ("quaternion w, x, y, z", fixed_row(quaternion_from_matrix(R), 2)),
    ]
    if affine:
        stretches = fixed_row(np.linalg.eigvalsh(parts.stretch)[::-1], 2)
        rows += [
            ("stretch" + ", mirrored at the origin" * (parts.mirror < 0), stretches),
            ("det T", fixed(float(np.linalg.det(T[:3, :3])), 2)),
        ]
    return Table("The rotation, in other numbers", ("name", "numbers"), tuple(rows))
