"""What the lesson yields: both flows side by side, and everything that is measured of each cloud."""

import functools
from dataclasses import dataclass

import numpy as np

from lessons.chamfer_emd.clouds import Clouds, yardsticks
from lessons.chamfer_emd.params import Params
from workbench.algorithms.flow import Distance, Flow
from workbench.algorithms.transport import Matching, best_matching, blurred_earth_movers
from workbench.geometry.shape_distances import DEFINITIONS, Definition, Nearest, index_mse, nearest_both_ways


@dataclass(frozen=True, eq=False)
class Numbers:
    """Distances of one cloud to the target. Metres, and square metres where the name says squared.

    Attributes:
        chamfer: By the function in the slot: ours is the mean of squares, both sides.
        definitions: Two-sided Chamfer by the name of its definition.
        to_target, to_source: One-sided Chamfer by the function in its slot: from the cloud to the target, and back.
        earth_movers: By the function in the slot: ours is exact.
        hausdorff, f_score: As named.
        index_mse: Mean squared distance of rows with the same index; NaN where the counts differ.
        astray: The share of the cloud's mass whose place in the best one-to-one matching is farther than `Params.near`.
    """

    chamfer: float
    definitions: dict[Definition, float]
    to_target: float
    to_source: float
    earth_movers: float
    hausdorff: float
    f_score: float
    index_mse: float
    astray: float


@dataclass(frozen=True, eq=False)
class Measures:
    """The three functions that students may replace."""

    chamfer: Distance
    earth_movers: Distance
    one_sided: Distance


@dataclass(frozen=True, eq=False)
class Side:
    """One of the two flows at one step: where it is, its numbers, and who is matched to whom."""

    flow: Flow
    numbers: Numbers
    near: Nearest
    matching: Matching
    p_target: np.ndarray
    blur: float

    @functools.cached_property
    def sinkhorn(self) -> float:
        """The cost of Sinkhorn's blurred plan, metres; found when first asked for: nothing else depends on it."""
        return blurred_earth_movers(self.flow.p_moving, self.p_target, self.blur, max_sweeps=200, tolerance=1e-4)

    @property
    def served(self) -> np.ndarray:
        """How many target points have each point of the cloud as their nearest."""
        return np.bincount(self.near.b_to_a, minlength=len(self.flow.p_moving))


@dataclass(frozen=True, eq=False)
class State:
    """One step of both flows; the one that ended first waits for the other.

    Attributes:
        step: Counted from 0, the start.
        params: The inputs.
        clouds: Source and target.
        left: The flow that lowers Chamfer, or one side of it.
        right: The flow that lowers the earth mover's distance.
        before: The numbers of both clouds one step earlier, or None.
        yardsticks: Numbers of known changes of the target, by name; the same in all steps.
        last: Whether both flows have ended.
    """

    step: int
    params: Params
    clouds: Clouds
    left: Side
    right: Side
    before: tuple[Numbers, Numbers] | None
    yardsticks: dict[str, Numbers]
    last: bool


def measured(now: Flow, before: Side | None, p_target: np.ndarray, params: Params, measures: Measures) -> Side:
    """Measure a flow where it is, or return what was measured where it has been waiting."""
    if before is not None and before.flow is now:
        return before
    near, matching = nearest_both_ways(now.p_moving, p_target), best_matching(now.p_moving, p_target)
    now_numbers = numbers(now.p_moving, p_target, near, matching, params, measures)
    return Side(now, now_numbers, near, matching, p_target, params.blur)


def numbers(
    p: np.ndarray, p_target: np.ndarray, near: Nearest, matching: Matching, params: Params, measures: Measures
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
        astray=float(matching.mass[matching.distances > params.near].sum()),
    )


def numbers_of_yardsticks(clouds: Clouds, params: Params, measures: Measures) -> dict[str, Numbers]:
    """Measure the target after each of the known changes."""
    p_target = clouds.p_target
    return {
        name: numbers(p, p_target, nearest_both_ways(p, p_target), best_matching(p, p_target), params, measures)
        for name, p in yardsticks(clouds, params)
    }
