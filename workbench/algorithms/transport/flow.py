"""One cloud flows to another, by gradient descent on a distance between them; metres, one frame.

References: Polyak, Introduction to optimization, 1987, section 5.3 (the step for a function whose
least value is known); Fan, Su and Guibas, A Point Set Generation Network, 2017, section 3.3
(Chamfer and earth mover's as losses).
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from enum import Enum

import numpy as np
from jaxtyping import Float

from workbench.tracing import traced

Distance = Callable[[np.ndarray, np.ndarray], float]
"""distance(p_moving, p_target) -> a number that is not negative, and 0 for equal clouds."""
Gradient = Callable[[np.ndarray, np.ndarray], np.ndarray]
"""gradient(p_moving, p_target) -> the distance's gradient with respect to p_moving, (n, 3)."""

_ARRIVED = 1e-12
_SHORTEST = 1e-5  # metres: steps that move the points less count as none
_STRAIGHT = 0.9  # of the fall that a slope promises: what falls so much falls in a straight line


class Stop(Enum):
    """Why a flow ended."""

    ARRIVED = "arrived: the distance is zero"
    SETTLED = "settled: no step along the gradient lowers the distance any more"
    MAX_STEPS = "the maximum number of steps is reached"

    @property
    def message(self) -> str:
        """The reason in words."""
        return self.value


@dataclass(frozen=True, eq=False)
class Flow:
    """The moving cloud after some steps.

    Attributes:
        value: Its distance to the target.
        slope: The gradient of that distance with respect to p_moving.
        moved: How far the points went in this step, root mean square, metres.
        stop: Why this is the last state, or None.
    """

    step: int
    p_moving: Float[np.ndarray, "n 3"]
    value: float
    slope: Float[np.ndarray, "n 3"]
    moved: float
    stop: Stop | None = None


@traced
def flow(
    p_moving: Float[np.ndarray, "n 3"],
    p_target: Float[np.ndarray, "m 3"],
    distance: Distance,
    *,
    gradient: Gradient,
    longest_step: float = 0.06,
    share: float = 0.6,
    max_steps: int = 60,
) -> Iterator[Flow]:
    """Yield the cloud as it slides down a distance to the target, until nothing lowers it further.

    The value never rises. A flow that settles above zero is in a local minimum of the distance.

    Args:
        gradient: With respect to p_moving: one's own, or `partial(numeric_gradient, distance)`.
        longest_step: No step moves the points farther than this, root mean square, metres.
        share: Of Polyak's step length; 1 aims at zero at once.

    Raises:
        ValueError: If longest_step or share is not positive.
    """
    if not (longest_step > 0 and share > 0):
        raise ValueError(f"longest_step and share are positive, not {longest_step} and {share}")
    value = distance(p_moving, p_target)
    moved = 0.0

    for step in range(max_steps + 1):
        slope = gradient(p_moving, p_target)
        length = min(polyak_length(value, slope, share), length_of(longest_step, slope))
        p_next, value_next = descend(
            distance, gradient, p_moving, p_target=p_target, value=value, slope=slope, length=length
        )
        stop = why_stop(value, value_next, step == max_steps)
        yield Flow(step, p_moving, value, slope, moved, stop)
        if stop:
            return
        moved = rms(p_next - p_moving)
        p_moving, value = p_next, value_next


def descend(
    distance: Distance,
    gradient: Gradient,
    p_moving: Float[np.ndarray, "n 3"],
    *,
    p_target: Float[np.ndarray, "m 3"],
    value: float,
    slope: Float[np.ndarray, "n 3"],
    length: float,
) -> tuple[Float[np.ndarray, "n 3"], float]:
    """Return the cloud one step down the slope and its distance; as it was where no step lowers it.

    The points move by `length * slope`. A step that is too long is tried once more, half as far,
    against the mean of the slopes at its two ends: for a point that passed a kink, such as its own
    place, these cancel and it stays, while the others go on. That is kept where the distance falls
    in a straight line, as it does between kinks. Else the step is halved until the distance is
    lower.

    Reference: Nocedal and Wright, Numerical Optimization, 2nd ed., algorithm 3.1, with plain
    decrease as the condition; the mean over a kink after Wolfe, A method of conjugate subgradients
    for minimizing nondifferentiable functions, 1975.
    """
    if length * rms(slope) <= _SHORTEST:
        return p_moving, value
    p_next = p_moving - length * slope
    value_next = distance(p_next, p_target)
    if value_next < value:
        return p_next, value_next

    length /= 2
    mean = (slope + gradient(p_next, p_target)) / 2
    if rms(mean) < rms(slope):
        p_next = p_moving - length * mean
        value_next = distance(p_next, p_target)
        if value_next < value - _STRAIGHT * length * np.vdot(mean, mean):
            return p_next, value_next

    while length * rms(slope) > _SHORTEST:
        p_next = p_moving - length * slope
        value_next = distance(p_next, p_target)
        if value_next < value:
            return p_next, value_next
        length /= 2
    return p_moving, value


def polyak_length(value: float, slope: Float[np.ndarray, "n 3"], share: float) -> float:
    """Return `share` of Polyak's step length for a least value of zero; 0 without a slope.

    The whole of it reaches zero at once where the distance falls like a cone, and goes half the way
    where it falls like a square (Polyak 1987, section 5.3).
    """
    squared = float(np.vdot(slope, slope))
    return share * value / squared if squared > 0 else 0.0


def length_of(move: float, slope: Float[np.ndarray, "n 3"]) -> float:
    """Return the step length that moves the points by `move` metres, root mean square."""
    steepness = rms(slope)
    return move / steepness if steepness > 0 else 0.0


def rms(v: Float[np.ndarray, "n 3"]) -> float:
    """Return the root mean square of the lengths of the rows."""
    return float(np.sqrt(np.vdot(v, v) / len(v)))


def why_stop(value: float, value_next: float, at_limit: bool) -> Stop | None:
    """Return the reason to stop, or None to go on."""
    if value <= _ARRIVED:
        return Stop.ARRIVED
    if not value_next < value:
        return Stop.SETTLED
    return Stop.MAX_STEPS if at_limit else None


def numeric_gradient(
    distance: Distance,
    p_a: Float[np.ndarray, "n 3"],
    p_b: Float[np.ndarray, "m 3"],
    *,
    h: float = 1e-6,
) -> Float[np.ndarray, "n 3"]:
    """Return the gradient of any distance by p_a, by central differences of 2 h metres.

    It asks for the distance twice per coordinate. A coordinate in which all points of both clouds
    agree is left at zero: by symmetry no distance between clouds in a plane pulls them out of it.
    """
    slope = np.zeros_like(p_a)
    free = np.flatnonzero(np.ptp(np.concatenate([p_a, p_b]), axis=0) > 0)
    p = p_a.copy()
    for i in range(len(p)):
        for axis in free:
            p[i, axis] = p_a[i, axis] + h
            above = distance(p, p_b)
            p[i, axis] = p_a[i, axis] - h
            slope[i, axis] = (above - distance(p, p_b)) / (2 * h)
            p[i, axis] = p_a[i, axis]
    return slope
