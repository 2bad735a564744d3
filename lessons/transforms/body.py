"""The body that is moved, and the map that the params describe."""

from dataclasses import dataclass, replace

import numpy as np

from lessons.transforms.composition import Factor
from lessons.transforms.state import Body, First, Params
from workbench.algorithms.interpolation import FromEuler, Rodrigues
from workbench.data.files import read_mesh
from workbench.data.framing import frame
from workbench.data.shapes.solids import outlined, solid
from workbench.errors import InputError
from workbench.geometry.meshes.invariants import measure
from workbench.geometry.motions import exp_so3, motion
from workbench.geometry.motions.affine import perspective, reflection, scaling, shear, translation
from workbench.geometry.motions.rotations import EulerOrder, euler_to_matrix
from workbench.numerals import brief

MOST_FACES = 50_000


@dataclass(frozen=True, eq=False, kw_only=True)
class Numbers:
    """A map as numbers, in radians and metres: what is misread when a convention is."""

    angles: np.ndarray
    order: EulerOrder
    turn: np.ndarray
    offset: np.ndarray
    first: First

    def rotation(self) -> np.ndarray:
        """Return the three turns, then the turn of the handle."""
        return exp_so3(self.turn) @ euler_to_matrix(self.angles, self.order)

    def motion(self) -> np.ndarray:
        """Return the rigid part of the map."""
        R = self.rotation()
        return motion(R, self.offset if self.first == "rotate, then translate" else R @ self.offset)

    def swapped(self) -> "Numbers":
        """Return the same numbers with translation and rotation in the other order."""
        rotate_first = self.first == "rotate, then translate"
        return replace(
            self, first="translate, then rotate" if rotate_first else "rotate, then translate"
        )


def body_of(params: Params) -> Body:
    """Return the body, an own mesh scaled to one metre and put on the ground.

    Raises:
        InputError: If the own mesh cannot be used.
    """
    if params.mesh is None:
        made = solid(params.shape)
        name = params.shape
    else:
        p, faces = read_mesh(params.mesh)
        if len(faces) > MOST_FACES:
            raise InputError(
                f"{params.mesh.name}: {len(faces):,} faces; this lesson takes up to {MOST_FACES:,}"
            )
        made, name = outlined(frame(p, 1.0).standing(p).shown(p), faces, angle=0.6), "mesh"
    return Body(
        name=name,
        solid=made,
        measures=measure(made.p, made.faces),
        point=min(params.point, len(made.p) - 1),
    )


def numbers_of(params: Params) -> Numbers:
    """Return the rigid part of the params in radians."""
    return Numbers(
        angles=np.radians(params.angles),
        order=params.order,
        turn=np.array(params.pose[3:], float),
        offset=np.array(params.pose[:3], float),
        first=params.first,
    )


def shape_factors(params: Params) -> list[Factor]:
    """Return the factors that change the shape, those that do nothing left out."""
    factors = []
    if params.scale != (1.0, 1.0, 1.0):
        x, y, z = params.scale
        factors.append(
            Factor(
                "scale",
                f"x × {brief(x, 6)}, y × {brief(y, 6)}, z × {brief(z, 6)}",
                scaling(np.array(params.scale, float)),
            )
        )
    if params.shear:
        factors.append(
            Factor("shear", f"x + {brief(params.shear, 6)} z", shear("x", "z", params.shear))
        )
    if params.perspective:
        slope = np.array([0.0, 0.0, params.perspective])
        factors.append(
            Factor("perspective", f"w = 1 + {brief(params.perspective, 6)} z", perspective(slope))
        )
    if params.mirror != "none":
        normal = np.eye(3)["xyz".index(params.mirror)]
        factors.append(Factor("mirror", f"{params.mirror} → −{params.mirror}", reflection(normal)))
    return factors


def motion_factors(
    params: Params, euler_to_matrix: FromEuler, rotation_from_axis_angle: Rodrigues
) -> list[Factor]:
    """Return the three turns, the handle's turn if there is one, and the translation, in the chosen
    order.
    """
    numbers, turns, R_before = numbers_of(params), [], np.eye(3)
    for k, letter in enumerate(params.order):
        R = euler_to_matrix(np.where(np.arange(3) <= k, numbers.angles, 0.0), params.order)
        axis = f"the world's {letter}" if letter.islower() else f"the body's own {letter.lower()}"
        turns.append(
            Factor(
                "turn",
                f"{brief(params.angles[k], 6)}° about {axis}",
                motion(R @ R_before.T, np.zeros(3)),
            )
        )
        R_before = R
    angle = np.linalg.norm(numbers.turn)
    if angle > 0:
        R = rotation_from_axis_angle(numbers.turn, float(angle))
        turns.append(
            Factor(
                "handle",
                f"{brief(np.degrees(angle))}° about the handle's axis",
                motion(R, np.zeros(3)),
            )
        )
    x, y, z = params.pose[:3]
    move = Factor(
        "translate", f"({brief(x, 4)}, {brief(y, 4)}, {brief(z, 4)}) m", translation(numbers.offset)
    )
    return [*turns, move] if params.first == "rotate, then translate" else [move, *turns]
