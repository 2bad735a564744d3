"""The other stages: one number of a map that a hand turns; each step is one of its values."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np

from lessons.transforms.composition import Invert
from lessons.transforms.inputs import FRONT, Body, Input
from workbench.geometry.motions import motion
from workbench.geometry.motions.affine import perspective, shear, translation
from workbench.geometry.motions.rotations import rotation_about
from workbench.geometry.polylines import at_height, between, rectangle

TURNS = np.arange(0.0, 181.0, 3.0)  # degrees
SHARES = np.arange(0.0, 101.0, 2.5)  # per cent
SHEARS = np.arange(-30, 31) * 0.05
SLOPES = np.arange(31) * 0.02  # per metre
VALUES = {
    "columns": SHARES,
    "order": TURNS,
    "undo": TURNS,
    "shear": SHEARS,
    "shift": SHARES,
    "divide": SLOPES,
}


@dataclass(frozen=True, eq=False, kw_only=True)
class Held:
    """One value of the number under the hand.

    Attributes:
        value: Per cent, degrees or per metre, as the stage has it.
        T: The map now.
        T_other: What is compared with it: the other order, the wrong inverse after the motion, or
            what the direction with w = 1 is carried by; else the identity.
    """

    value: float
    T: np.ndarray
    T_other: np.ndarray


def hold(params: Input, invert_rigid: Invert) -> Iterator[Held]:
    """Yield the values of the stage, one after the other."""
    make = MAKERS[params.stage]
    for value in VALUES[params.stage]:
        T, T_other = make(params, float(value), invert_rigid)
        yield Held(value=float(value), T=T, T_other=T_other)


Pair = tuple[np.ndarray, np.ndarray]


def _columns(params: Input, value: float, _: Invert) -> Pair:
    """Return the map whose arrows have come so far from the axes to the tips."""
    tips = np.array([params.x_tip, params.y_tip, params.z_tip])
    columns = [arrived(np.eye(3)[k], tips[k], value / 100.0) for k in range(3)]
    return motion(np.column_stack(columns), np.zeros(3)), np.eye(4)


def arrived(v_from: np.ndarray, v_to: np.ndarray, share: float) -> np.ndarray:
    """Return an arrow on its way: its direction turns evenly, its length changes evenly; straight
    where there is no one direction to turn in.
    """
    length = float(np.linalg.norm(v_to))
    across = v_to - (v_to @ v_from) * v_from
    aside = float(np.linalg.norm(across))
    if aside < 1e-9:
        return (1.0 - share) * v_from + share * v_to
    turn = share * np.arctan2(aside, v_to @ v_from)
    ahead = np.cos(turn) * v_from + np.sin(turn) * across / aside
    return (1.0 + share * (length - 1.0)) * ahead


def moved_by(params: Input) -> np.ndarray:
    """Return the translation of the params (3,), metres."""
    return np.array(params.pose[:3], float)


def turn_of(value: float) -> np.ndarray:
    """Return the turn by so many degrees about the vertical as a 4x4."""
    return motion(rotation_about("z", np.radians(value)), np.zeros(3))


def _order(params: Input, value: float, _: Invert) -> Pair:
    R = turn_of(value)
    shift = translation(moved_by(params))
    return shift @ R, R @ shift


def _undo(params: Input, value: float, invert_rigid: Invert) -> Pair:
    """Return the motion taken back by the inverse, and by (Rᵀ, −t)."""
    T = translation(moved_by(params)) @ turn_of(value)
    return invert_rigid(T) @ T, motion(T[:3, :3].T, -T[:3, 3]) @ T


def _shear(_params: Input, value: float, _: Invert) -> Pair:
    return shear("x", "z", value), np.eye(4)


def _shift(params: Input, value: float, _: Invert) -> Pair:
    return translation(value / 100.0 * moved_by(params)), np.eye(4)


def _divide(_params: Input, value: float, _: Invert) -> Pair:
    return perspective(np.array([0.0, 0.0, value])), np.eye(4)


MAKERS: dict[str, Callable[[Input, float, Invert], Pair]] = {
    "columns": _columns,
    "order": _order,
    "undo": _undo,
    "shear": _shear,
    "shift": _shift,
    "divide": _divide,
}


def fronts(T: np.ndarray) -> Pair:
    """Return where the direction to the front goes, taken with w = 0 and with w = 1."""
    return (T @ np.append(FRONT, 0.0))[:3], (T @ np.append(FRONT, 1.0))[:3]


def upright_edges(body: Body) -> np.ndarray:
    """Return the edges (n, 2, 3) that stand upright, feet first; those of the box around the body
    where it has none.
    """
    ends = body.solid.lines
    lowest_first = np.argsort(ends[:, :, 2], axis=1, kind="stable")
    ends = np.take_along_axis(ends, lowest_first[:, :, None], axis=1)
    v = np.diff(ends, axis=1)[:, 0]
    rising = ends[(np.abs(v[:, :2]).max(axis=1) < 1e-9) & (v[:, 2] > 1e-9)]
    if len(rising):
        return rising
    low = body.solid.p.min(axis=0)
    high = body.solid.p.max(axis=0)
    corners = rectangle(low[:2], high[:2])
    return between(at_height(corners, low[2]), at_height(corners, high[2]))
