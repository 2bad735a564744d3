"""Runs of the pinhole lesson that its tests share."""

import numpy as np

from lessons.pinhole.lesson import lesson, run
from lessons.pinhole.state import Params, State
from tests.runs import finished
from workbench.scene import PALETTE

ORANGE = np.array(PALETTE["source"])


def states(params: Params, **slots) -> list[State]:
    return list(run(params, **slots))


def preset(name: str) -> list[State]:
    return states(lesson.preset(name).params)


def orange(picture: np.ndarray) -> np.ndarray:
    return (picture == ORANGE).all(axis=2)


def tone(params: Params, step: int) -> str:
    return finished(lesson.name, params)[step].caption.tone
