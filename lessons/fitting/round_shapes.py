"""Circles, spheres and cylinders as least squares needs them: distances, their slopes, and what a
small step does.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal

import numpy as np
from jaxtyping import Float

from workbench.algorithms.least_squares import descend_many
from workbench.geometry.motions import across
from workbench.geometry.polylines import at_height, cylinder_rings, near_arc, segments, sphere_rings
from workbench.geometry.shapes.circles_spheres import linearise_sphere
from workbench.geometry.shapes.cylinders import linearise_cylinder, retract_cylinder

RoundName = Literal["circle", "sphere", "cylinder"]


@dataclass(frozen=True, kw_only=True)
class RoundShape:
    """A shape by its distances.

    Attributes:
        name: What it is called.
        linearise: From unknowns (*k, m) and points (*k, n, d) the distances and their slopes by a
            small step.
        retract: Gives the unknowns that a small step leads to.
        names: Of the entries of a small step; the first two move the centre, the last is the
            radius.
    """

    name: RoundName
    linearise: Callable[[np.ndarray, np.ndarray], tuple[np.ndarray, np.ndarray]]
    retract: Callable[[np.ndarray, np.ndarray], np.ndarray]
    names: tuple[str, ...]


CIRCLE = RoundShape(
    name="circle", linearise=linearise_sphere, retract=np.add, names=("x", "y", "R")
)
SPHERE = RoundShape(
    name="sphere", linearise=linearise_sphere, retract=np.add, names=("x", "y", "z", "R")
)
CYLINDER = RoundShape(
    name="cylinder",
    linearise=linearise_cylinder,
    retract=retract_cylinder,
    names=("shift", "shift across", "tilt", "tilt across", "R"),
)
ROUND_SHAPES: dict[RoundName, RoundShape] = {
    shape.name: shape for shape in (CIRCLE, SPHERE, CYLINDER)
}


def feet(
    shape: RoundShape, unknown: Float[np.ndarray, " m"], p: Float[np.ndarray, "n d"]
) -> Float[np.ndarray, "n d"]:
    """Return the places of a shape that are nearest to points.

    Args:
        shape: What it is.
        unknown: Its numbers.
        p: The points.

    Reference: a distance falls fastest straight towards its foot; its slopes by a shift of the
    centre tell that way.
    """
    residuals, jacobian = shape.linearise(unknown, p)
    ways = np.stack(across(unknown[3:6])) if shape is CYLINDER else np.eye(p.shape[1])
    return p + residuals[:, None] * (jacobian[:, : len(ways)] @ ways)


def outline(
    shape: RoundShape, unknown: Float[np.ndarray, " m"], reach: float
) -> Float[np.ndarray, "s 2 3"]:
    """Return a shape as segments in space; a circle lies at height 0.

    Args:
        shape: What it is.
        unknown: Its numbers; none are returned where one is not finite, or the radius is beyond
            10⁹.
        reach: Of a larger circle the arc nearest to the origin, half of it so long.

    Reference: as `linearise_sphere` and `linearise_cylinder`.
    """
    if not np.isfinite(unknown).all() or abs(unknown[-1]) > 1e9:
        return np.empty((0, 2, 3))
    if shape is CIRCLE:
        return segments(at_height(near_arc(unknown, reach)))
    if shape is SPHERE:
        return sphere_rings(unknown[:3], abs(float(unknown[3])))
    n_axis = unknown[3:6]
    p_axis = unknown[:3] - (unknown[:3] @ n_axis) * n_axis
    return cylinder_rings(
        p_axis, np.column_stack([*across(n_axis), n_axis]), abs(float(unknown[6]))
    )


def fit_round(
    shape: RoundShape,
    p: Float[np.ndarray, "k n d"],
    starts: Float[np.ndarray, "k m"],
    *,
    tolerance: float = 1e-9,
) -> Float[np.ndarray, "k m"]:
    """Return the unknowns with the least squared distances of sets of points, near as many starts.

    Args:
        shape: What is fitted.
        p: The sets.
        starts: The first unknowns of each.
        tolerance: As of `descend`.

    Reference: as `linearise_sphere` and `linearise_cylinder`.
    """
    *_, end = descend_many(
        lambda unknowns: shape.linearise(unknowns, p),
        shape.retract,
        starts,
        iterations=60,
        tolerance=tolerance,
    )
    return end.unknowns
