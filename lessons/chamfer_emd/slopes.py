"""Which way a distance falls, also where the distance is a student's function that gives its value only."""

import numpy as np

from lessons.chamfer_emd.params import Lowers
from lessons.chamfer_emd.states import Measures
from workbench.algorithms import transport
from workbench.algorithms.flow import Distance, Gradient, numeric_gradient
from workbench.algorithms.transport import earth_movers_gradient
from workbench.geometry import shape_distances
from workbench.geometry.shape_distances import chamfer_gradient, one_sided_gradient

_AROUND = 0.05  # metres: how far the points are moved to see whether two distances are the same
_TOLERANCE = 1e-9


def left(lowers: Lowers, measures: Measures) -> tuple[Distance, Gradient]:
    """Return the distance that the left flow lowers, and its gradient with respect to the moving cloud."""
    one_sided, ours = measures.one_sided, shape_distances.one_sided
    if lowers == "source to target":
        return one_sided, slope_of(one_sided, ours, one_sided_gradient)
    if lowers == "target to source":
        return swapped(one_sided), slope_of(swapped(one_sided), swapped(ours), one_sided_back_gradient)
    return measures.chamfer, slope_of(measures.chamfer, shape_distances.chamfer, chamfer_gradient)


def right(measures: Measures) -> tuple[Distance, Gradient]:
    """Return the distance that the right flow lowers, and its gradient with respect to the moving cloud."""
    return measures.earth_movers, slope_of(measures.earth_movers, transport.earth_movers, earth_movers_gradient)


def slope_of(distance: Distance, ours: Distance, gradient: Gradient) -> Gradient:
    """Return the gradient of a distance: ours wherever the distance equals ours, here and nearby, else by differences.

    So a right function flows exactly as ours does, at three calls a step, and a wrong one flows where it leads.
    """
    if distance is ours:
        return gradient

    def slope(p: np.ndarray, p_target: np.ndarray) -> np.ndarray:
        same = all(np.isclose(distance(q, p_target), ours(q, p_target), _TOLERANCE, _TOLERANCE) for q in around(p))
        return gradient(p, p_target) if same else numeric_gradient(distance, p, p_target)

    return slope


def around(p: np.ndarray) -> tuple[np.ndarray, ...]:
    """Return the cloud, and the cloud with every point moved a little, twice."""
    v = _AROUND * np.random.default_rng(0).normal(size=(2, *p.shape))
    return p, p + v[0], p + v[1]


def swapped(distance: Distance) -> Distance:
    """Return the distance with its two clouds changed over."""
    return lambda p, p_target: distance(p_target, p)


def one_sided_back_gradient(p: np.ndarray, p_target: np.ndarray) -> np.ndarray:
    """Return the gradient of the side from the target back to the cloud: that of both sides less the other one."""
    return chamfer_gradient(p, p_target) - one_sided_gradient(p, p_target)
