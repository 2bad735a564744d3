"""The two clouds, and one step of both flows with all that is measured of it."""

import functools
from dataclasses import dataclass

import numpy as np

from lessons.chamfer_emd.inputs import Input
from workbench.algorithms.transport import TransportPlan, blurred_earth_movers
from workbench.algorithms.transport.flow import Flow
from workbench.geometry.points.shape_distances import Definition, NearestPoints
from workbench.lesson import Look


@dataclass(frozen=True, eq=False, kw_only=True)
class Clouds:
    """Source and target of a run in one frame, metres of the picture.

    Attributes:
        p_source: Where both flows start.
        p_target: Where they should go.
        name: What the source is, in words.
        scale: Metres of the picture per unit of an own cloud; 1 for built-in ones.
    """

    p_source: np.ndarray
    p_target: np.ndarray
    name: str
    scale: float


@dataclass(frozen=True, eq=False, kw_only=True)
class Numbers:
    """Distances of one cloud to the target. Metres, and square metres where the name says squared.

    Attributes:
        chamfer: By the function in the slot: ours is the mean of squares, both sides.
        definitions: Two-sided Chamfer by the name of its definition.
        to_target, to_source: One-sided Chamfer by the function in its slot: from the cloud to the
            target, and back.
        earth_movers: By the function in the slot: ours is exact.
        hausdorff, f_score: As named.
        index_mse: Mean squared distance of rows with the same index; NaN where the counts differ.
        out_of_place: The share of the cloud's mass whose place in the best one-to-one matching is
            farther than `Input.near`.
    """

    chamfer: float
    definitions: dict[Definition, float]
    to_target: float
    to_source: float
    earth_movers: float
    hausdorff: float
    f_score: float
    index_mse: float
    out_of_place: float


@dataclass(frozen=True, eq=False, kw_only=True)
class Side:
    """One of the two flows at one step: where it is, its numbers, and who is matched to whom."""

    flow: Flow
    numbers: Numbers
    near: NearestPoints
    matching: TransportPlan
    p_target: np.ndarray
    blur: float

    @functools.cached_property
    def sinkhorn(self) -> float:
        """The cost of Sinkhorn's blurred plan, metres; found when first asked for: nothing else
        depends on it.
        """
        return blurred_earth_movers(
            self.flow.p_moving, self.p_target, self.blur, max_sweeps=200, tolerance=1e-4
        )

    @property
    def served(self) -> np.ndarray:
        """How many target points have each point of the cloud as their nearest."""
        return np.bincount(self.near.b_to_a, minlength=len(self.flow.p_moving))


@dataclass(frozen=True, eq=False, kw_only=True)
class Step:
    """One step of both flows; the one that ended first waits for the other.

    Attributes:
        step: Counted from 0, the start.
        left: The flow that lowers Chamfer, or one side of it.
        right: The flow that lowers the earth mover's distance.
        before: The numbers of both clouds one step earlier, or None.
        yardsticks: Numbers of known changes of the target, by name; the same in all steps.
        last: Whether both flows have ended.
    """

    step: int
    left: Side
    right: Side
    before: tuple[Numbers, Numbers] | None
    yardsticks: dict[str, Numbers]
    last: bool


@dataclass(frozen=True, eq=False, kw_only=True)
class State(Step):
    """A step beside its clouds and its inputs: what captions, charts and pictures read."""

    params: Input
    clouds: Clouds


def beside_its_clouds(params: Input, clouds: Clouds, step: Step) -> State:
    """Return a step together with the clouds that it is of."""
    return State(
        params=params,
        clouds=clouds,
        step=step.step,
        left=step.left,
        right=step.right,
        before=step.before,
        yardsticks=step.yardsticks,
        last=step.last,
    )


def state_of(look: Look[Input, Clouds, Step]) -> State:
    """Return the step that is looked at, together with the clouds that it is of."""
    return beside_its_clouds(look.params, look.subject, look.now)
