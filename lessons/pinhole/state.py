"""One step of the pinhole lesson."""

from dataclasses import dataclass

import numpy as np

from lessons.pinhole.params import Params
from lessons.pinhole.shot import Shot
from workbench.algorithms import pinhole
from workbench.data.street import street


@dataclass(frozen=True, eq=False)
class State:
    """One stage of all points through the calculation, beside the true shot.

    Attributes:
        params: The inputs.
        shot: The true camera and its photograph.
        now: How far the calculation has come.
        picture: The photograph with the calculated outlines and points on it.
        error: Median distance to the true pixels, as far as the stage tells, px; NaN before the division.
        found, missed, false: How many points have a calculated pixel; how many lack one that the camera does see;
            and how many have one that the camera does not see.
    """

    params: Params
    shot: Shot
    now: pinhole.State
    picture: np.ndarray
    error: float
    found: int
    missed: int
    false: int


def name_of(k: int) -> str:
    """Return what a point is called."""
    names = street().names
    return names[k] if k < len(names) else f"point {k}"
