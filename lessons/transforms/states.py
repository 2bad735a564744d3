"""What the two halves of the transforms lesson yield."""

from dataclasses import dataclass

import numpy as np

from lessons.transforms.body import Body
from lessons.transforms.compare import Ghost
from lessons.transforms.params import Params
from workbench.algorithms.composition import Factor
from workbench.geometry.invariants import Change


@dataclass(frozen=True, eq=False)
class Built:
    """One more factor.

    Attributes:
        params, body: What does not change during the run.
        factor: What was multiplied on the left just now.
        T: All factors so far.
        T_world_body: The rigid ones among them.
        turns: How many of the three turns are done.
        angles: The three angles, those still to come being zero, radians.
        by_factor: What this factor changed on the body as it was before.
        by_all: What all factors so far changed on the body of the start.
        trail: Where the followed vertex was after every factor so far, (k, 3).
        complete: Whether this was the last factor of the map.
        ghosts: The second readings of the complete map, once it is; after `undo`, of its inverse.
        left: After `undo`: how far the farthest vertex is from where it was before the motion, metres.
    """

    params: Params
    body: Body
    factor: Factor
    T: np.ndarray
    T_world_body: np.ndarray
    turns: int
    angles: np.ndarray
    by_factor: tuple[Change, ...]
    by_all: tuple[Change, ...]
    trail: np.ndarray
    complete: bool
    ghosts: tuple[Ghost, ...] = ()
    left: float = float("nan")


@dataclass(frozen=True, eq=False)
class Way:
    """A way between two poses, as far as it has been gone.

    Attributes:
        times: 0 at the start, 1 at the end, (n,).
        path: Where the followed vertex was at these times, (n, 3).
        turned: All turning from each time to the next added up, degrees, (n,).
        volume: Of the body, over its volume at the start; negative where it is mirrored, (n,).
    """

    times: np.ndarray
    path: np.ndarray
    turned: np.ndarray
    volume: np.ndarray


@dataclass(frozen=True, eq=False)
class Moved:
    """One time between two poses.

    Attributes:
        params, body: What does not change during the run.
        T_world_start, T_world_end: The two poses.
        T_world_body: The body now; for matrix entries an affine map.
        T_world_shortest: Where slerp and lerp have it now.
        way, shortest: The way taken up to now, and all of the way of slerp and lerp.
        off: The angle to the shortest turn's body, degrees.
        by_all: What differs from the body at the start.
    """

    params: Params
    body: Body
    T_world_start: np.ndarray
    T_world_end: np.ndarray
    T_world_body: np.ndarray
    T_world_shortest: np.ndarray
    way: Way
    shortest: Way
    off: float
    by_all: tuple[Change, ...]

    @property
    def t(self) -> float:
        """The time now."""
        return float(self.way.times[-1])

    @property
    def volume(self) -> float:
        """The body's volume now, over its volume at the start."""
        return float(self.way.volume[-1])


State = Built | Moved
