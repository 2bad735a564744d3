"""Runs of the disparity lesson that its tests share."""

from collections.abc import Sequence
from functools import cache

import numpy as np

from lessons.disparity.lesson import lesson, run
from lessons.disparity.state import Params, State
from tests.runs import finished
from workbench.algorithms.stereo.disparity import Stage
from workbench.run.timeline import Timeline


def timeline(params: Params) -> Timeline:
    return finished(lesson.name, params)


@cache
def states(params: Params) -> tuple[State, ...]:
    return tuple(run(params))


def preset(name: str) -> tuple[State, ...]:
    return states(lesson.preset(name).params)


def of_stage(states: Sequence[State], stage: Stage) -> State:
    """The last state of a stage."""
    return [state for state in states if state.stage is stage][-1]


def truth_of(state: State) -> np.ndarray:
    assert state.setup.pair.disparity is not None
    return state.setup.pair.disparity


def visible_in(state: State) -> np.ndarray:
    assert state.setup.pair.visible is not None
    return state.setup.pair.visible


def off_in(state: State, rows: slice, columns: slice) -> float:
    """Return the share of a part of the map that is over 1 px off."""
    return float((np.abs(state.disparity - truth_of(state)) > 1.0)[rows, columns].mean())


BARE_PART = (slice(30, 90), slice(46, 88))
STRIPED_PART = (slice(30, 90), slice(60, 110))
