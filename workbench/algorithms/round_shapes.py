"""Circles, spheres and cylinders as least squares needs them: distances, their slopes, and what a small step does."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal

import numpy as np
from jaxtyping import Float

from workbench.algorithms.least_squares import descend_many
from workbench.geometry.circles_spheres import linearise_sphere
from workbench.geometry.cylinders import linearise_cylinder, retract_cylinder

RoundName = Literal["circle", "sphere", "cylinder"]


@dataclass(frozen=True, kw_only=True)
class RoundShape:
    """A shape by its distances.

    Attributes:
        name: What it is called.
        linearise: From unknowns (*k, m) and points (*k, n, d) the distances and their slopes by a small step.
        retract: Gives the unknowns that a small step leads to.
        names: Of the entries of a small step; the first two move the centre, the last is the radius.
    """

    name: RoundName
    linearise: Callable[[np.ndarray, np.ndarray], tuple[np.ndarray, np.ndarray]]
    retract: Callable[[np.ndarray, np.ndarray], np.ndarray]
    names: tuple[str, ...]


CIRCLE = RoundShape(name="circle", linearise=linearise_sphere, retract=np.add, names=("x", "y", "R"))
SPHERE = RoundShape(name="sphere", linearise=linearise_sphere, retract=np.add, names=("x", "y", "z", "R"))
CYLINDER = RoundShape(
    name="cylinder",
    linearise=linearise_cylinder,
    retract=retract_cylinder,
    names=("shift", "shift across", "tilt", "tilt across", "R"),
)
ROUND_SHAPES: dict[RoundName, RoundShape] = {shape.name: shape for shape in (CIRCLE, SPHERE, CYLINDER)}


def fit_round(
    shape: RoundShape, p: Float[np.ndarray, "k n d"], starts: Float[np.ndarray, "k m"], *, tolerance: float = 1e-9
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
        lambda unknowns: shape.linearise(unknowns, p), shape.retract, starts, iterations=60, tolerance=tolerance
    )
    return end.unknowns
