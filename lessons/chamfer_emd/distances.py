"""The distances of the lesson: what each says of a cloud, and which way it falls.

A student's function in a slot gives its value only; which way it falls is then found by
differences.
"""

from dataclasses import dataclass

import numpy as np

from lessons.chamfer_emd.clouds import yardsticks
from lessons.chamfer_emd.inputs import Input, Lowers
from lessons.chamfer_emd.state import Clouds, Numbers, Side
from workbench.algorithms.transport import TransportPlan, best_matching, earth_movers_gradient
from workbench.algorithms.transport import exact as transport
from workbench.algorithms.transport.flow import Distance, Flow, Gradient, numeric_gradient
from workbench.geometry.points import shape_distances
from workbench.geometry.points.shape_distances import (
    DEFINITIONS,
    NearestPoints,
    chamfer_gradient,
    index_mse,
    nearest_both_ways,
    one_sided_gradient,
)

_AROUND = 0.05  # metres: how far the points are moved to see whether two distances are the same
_TOLERANCE = 1e-9


@dataclass(frozen=True, eq=False)
class Measures:
    """The three functions that students may replace."""

    chamfer: Distance
    earth_movers: Distance
    one_sided: Distance


def measured(
    flow: Flow, before: Side | None, p_target: np.ndarray, *, params: Input, measures: Measures
) -> Side:
    """Measure a flow where it is, or return what was measured where it has been waiting."""
    if before is not None and before.flow is flow:
        return before
    near = nearest_both_ways(flow.p_moving, p_target)
    matching = best_matching(flow.p_moving, p_target)
    now_numbers = numbers(
        flow.p_moving, p_target, near, matching=matching, params=params, measures=measures
    )
    return Side(
        flow=flow,
        numbers=now_numbers,
        near=near,
        matching=matching,
        p_target=p_target,
        blur=params.blur,
    )


def numbers(
    p: np.ndarray,
    p_target: np.ndarray,
    near: NearestPoints,
    *,
    matching: TransportPlan,
    params: Input,
    measures: Measures,
) -> Numbers:
    """Measure one cloud against the target by every distance of the lesson."""
    return Numbers(
        chamfer=measures.chamfer(p, p_target),
        definitions={name: near.chamfer(name) for name in DEFINITIONS},
        to_target=measures.one_sided(p, p_target),
        to_source=measures.one_sided(p_target, p),
        earth_movers=measures.earth_movers(p, p_target),
        hausdorff=near.hausdorff(),
        f_score=near.f_score(params.near),
        index_mse=index_mse(p, p_target) if len(p) == len(p_target) else float("nan"),
        out_of_place=float(matching.mass[matching.distances > params.near].sum()),
    )


def numbers_of_yardsticks(clouds: Clouds, params: Input, measures: Measures) -> dict[str, Numbers]:
    """Measure the target after each of the known changes."""
    p_target = clouds.p_target
    return {
        name: numbers(
            p,
            p_target,
            nearest_both_ways(p, p_target),
            matching=best_matching(p, p_target),
            params=params,
            measures=measures,
        )
        for name, p in yardsticks(clouds, params)
    }


def left(lowers: Lowers, measures: Measures) -> tuple[Distance, Gradient]:
    """Return the distance that the left flow lowers, and its gradient with respect to the moving
    cloud.
    """
    one_sided, ours = measures.one_sided, shape_distances.one_sided
    if lowers == "source to target":
        return one_sided, slope_of(one_sided, ours, one_sided_gradient)
    if lowers == "target to source":
        return swapped(one_sided), slope_of(
            swapped(one_sided), swapped(ours), one_sided_back_gradient
        )
    return measures.chamfer, slope_of(measures.chamfer, shape_distances.chamfer, chamfer_gradient)


def right(measures: Measures) -> tuple[Distance, Gradient]:
    """Return the distance that the right flow lowers, and its gradient with respect to the moving
    cloud.
    """
    return measures.earth_movers, slope_of(
        measures.earth_movers, transport.earth_movers, earth_movers_gradient
    )


def slope_of(distance: Distance, ours: Distance, gradient: Gradient) -> Gradient:
    """Return the gradient of a distance: ours wherever the distance equals ours, here and nearby,
    else by differences.

    So a right function flows exactly as ours does, at three calls a step, and a wrong one flows
    where it leads.
    """
    if distance is ours:
        return gradient

    def slope(p: np.ndarray, p_target: np.ndarray) -> np.ndarray:
        same = all(
            np.isclose(distance(q, p_target), ours(q, p_target), _TOLERANCE, _TOLERANCE)
            for q in around(p)
        )
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
    """Return the gradient of the side from the target back to the cloud: that of both sides less
    the other one.
    """
    return chamfer_gradient(p, p_target) - one_sided_gradient(p, p_target)
