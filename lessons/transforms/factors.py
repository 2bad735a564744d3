"""The stage `factors`: a map built factor by factor, its motion taken back, and second readings."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from lessons.transforms.composition import Factor, Invert, compose
from lessons.transforms.inputs import Body, Input
from workbench.geometry.meshes.invariants import Change, changes, measure
from workbench.geometry.motions import exp_so3, inverse, motion
from workbench.geometry.motions.affine import (
    perspective,
    reflection,
    scaling,
    shear,
    transform,
    translation,
)
from workbench.geometry.motions.alignment import align_rigid
from workbench.geometry.motions.rotations import euler_to_matrix
from workbench.numerals import brief
from workbench.scene import Role

SAME = 1e-9  # metres: what rounding leaves of two names for one motion
NO_SCALE = (1.0, 1.0, 1.0)
MOVE_FIRST = "translate, then rotate"


@dataclass(frozen=True, eq=False, kw_only=True)
class Ghost:
    """The body under another reading: its name, its 4x4, and how far its farthest vertex is from
    where it belongs, metres.
    """

    name: str
    T: np.ndarray
    distance: float

    @property
    def same(self) -> bool:
        """Whether both are one map of this body, up to rounding."""
        return self.distance < SAME

    @property
    def color(self) -> Role:
        """Green where both are the same, vermillion where they differ."""
        return "truth" if self.same else "wrong"


@dataclass(frozen=True, eq=False, kw_only=True)
class Built:
    """One more factor.

    Attributes:
        factor: What was multiplied on the left just now.
        T: All factors so far.
        T_world_body: The rigid ones among them.
        by_factor: What this factor changed on the body as it was before.
        by_all: What all factors so far changed on the body of the start.
        trail: Where the followed vertex was after every factor so far, (k, 3).
        complete: Whether this was the last factor of the map.
        ghost: The second reading of the complete map, or of its inverse, if one is asked for.
        left: After `undo`: how far the farthest vertex is from where it was before the motion,
            metres; else NaN.
    """

    factor: Factor
    T: np.ndarray
    T_world_body: np.ndarray
    by_factor: tuple[Change, ...]
    by_all: tuple[Change, ...]
    trail: np.ndarray
    complete: bool
    ghost: Ghost | None = None
    left: float = float("nan")


def shape_factors(params: Input) -> list[Factor]:
    """Return the factors that change the shape, those that do nothing left out."""
    factors = []
    if params.scale != NO_SCALE:
        x, y, z = (brief(factor, 6) for factor in params.scale)
        words = f"x × {x}, y × {y}, z × {z}"
        factors.append(Factor("scale", words, scaling(np.array(params.scale, float))))
    if params.shear:
        words = f"x + {brief(params.shear, 6)} z"
        factors.append(Factor("shear", words, shear("x", "z", params.shear)))
    if params.perspective:
        words = f"w = 1 + {brief(params.perspective, 6)} z"
        slope = np.array([0.0, 0.0, params.perspective])
        factors.append(Factor("perspective", words, perspective(slope)))
    if params.mirror != "none":
        normal = np.eye(3)["xyz".index(params.mirror)]
        words = f"{params.mirror} → −{params.mirror}"
        factors.append(Factor("mirror", words, reflection(normal)))
    return factors


def motion_factors(params: Input) -> list[Factor]:
    """Return the turns, the handle's turn if there is one, and the translation, in the chosen
    order; turns of 0° are left out.
    """
    angles = np.radians(params.angles)
    turns = []
    R_before = np.eye(3)
    for k, letter in enumerate(params.order):
        R = euler_to_matrix(np.where(np.arange(3) <= k, angles, 0.0), params.order)
        axis = f"the world's {letter}"
        if letter.isupper():
            axis = f"the body's own {letter.lower()}"
        if params.angles[k]:
            words = f"{brief(params.angles[k], 6)}° about {axis}"
            turns.append(Factor("turn", words, motion(R @ R_before.T, np.zeros(3))))
        R_before = R
    w = np.array(params.pose[3:], float)
    if w.any():
        words = f"{brief(float(np.degrees(np.linalg.norm(w))))}° about the handle's axis"
        turns.append(Factor("handle", words, motion(exp_so3(w), np.zeros(3))))
    t = np.array(params.pose[:3], float)
    x, y, z = (brief(value, 4) for value in t)
    move = Factor("translate", f"({x}, {y}, {z}) m", translation(t))
    return [move, *turns] if params.first == MOVE_FIRST else [*turns, move]


def product(factors: list[Factor]) -> np.ndarray:
    """Return the product of factors, the first one rightmost."""
    T = np.eye(4)
    for factor in factors:
        T = factor.matrix @ T
    return T


def build(params: Input, body: Body, invert_rigid: Invert) -> Iterator[Built]:
    """Yield the body after every factor, and with its motion taken back in the end."""
    shapes = shape_factors(params)
    motions = motion_factors(params)
    p = body.solid.p
    faces = body.solid.faces
    p_shaped = transform(product(shapes), p)
    begun = before = measure(p, faces)
    trail = np.empty((0, 3))
    last = len(shapes) + len(motions) + 1
    for state in compose(shapes, motions, invert_rigid):
        p_now = transform(state.T, p)
        after = measure(p_now, faces)
        trail = np.vstack([trail, p_now[body.followed(params.point)]])
        is_undone = state.factor.kind == "undo"
        complete = len(trail) == last
        ghost = None
        if is_undone:
            ghost = undo_ghost(params, body, state.T_world_body)
        elif complete:
            ghost = ghost_of(params, body, state.T)
        yield Built(
            factor=state.factor,
            T=state.T,
            T_world_body=state.T_world_body,
            by_factor=changes(before, after),
            by_all=changes(begun, after),
            trail=trail,
            complete=complete,
            ghost=ghost,
            left=_farthest(p_now, p_shaped) if is_undone else float("nan"),
        )
        before = after


def ghost_of(params: Input, body: Body, T: np.ndarray) -> Ghost | None:
    """Return the second reading of the whole map T, if one is asked for."""
    p_ours = transform(T, body.solid.p)
    if params.compare == "best rigid motion":
        other = align_rigid(p_ours, body.solid.p)
    elif params.compare == "the other order":
        factors = motion_factors(params)
        turns = [factor for factor in factors if factor.kind != "translate"]
        moves = [factor for factor in factors if factor.kind == "translate"]
        swapped = [*turns, *moves] if params.first == MOVE_FIRST else [*moves, *turns]
        other = product([*shape_factors(params), *swapped])
    else:
        return None
    name = params.compare
    return Ghost(name=name, T=other, distance=_farthest(transform(other, body.solid.p), p_ours))


def undo_ghost(params: Input, body: Body, T_world_body: np.ndarray) -> Ghost | None:
    """Return the body after a wrong inverse, to be compared with the body before the motion."""
    A = product(shape_factors(params))
    p = body.solid.p
    T = T_world_body @ A
    if params.compare == "undo by (Rᵀ, −t)":
        undone = motion(T_world_body[:3, :3].T, -T_world_body[:3, 3]) @ T
        missed = _farthest(transform(undone, p), transform(A, p))
        return Ghost(name="(Rᵀ, −t)", T=undone, distance=missed)
    if params.compare == "undo all as if rigid":
        undone = inverse(T) @ T
        missed = _farthest(transform(undone, p), p)
        return Ghost(name="(Mᵀ, −Mᵀt), with M the 3×3 of T,", T=undone, distance=missed)
    return None


def _farthest(p: np.ndarray, q: np.ndarray) -> float:
    return float(np.linalg.norm(p - q, axis=1).max())
