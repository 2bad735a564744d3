"""Runs of the disparity lesson that its tests share."""

from collections.abc import Sequence
from functools import cache

import numpy as np

from lessons.disparity.inputs import Input
from lessons.disparity.lesson import lesson
from lessons.disparity.matching import State
from lessons.disparity.pairs import Pictures
from tests.runs import finished
from workbench.algorithms.stereo.disparity import Stage
from workbench.lesson import States
from workbench.run.timeline import Timeline

Maps = States[Input, Pictures, State]
PLANES = Input(scene="planes", pixel=(80, 50))


def timeline(params: Input) -> Timeline:
    return finished(lesson.name, params)


@cache
def states(params: Input) -> Maps:
    return Timeline(lesson, params).states()


def preset(name: str) -> Maps:
    return states(lesson.preset(name).params)


def of_stage(states: Sequence[State], stage: Stage) -> State:
    """The last state of a stage."""
    return [state for state in states if state.stage is stage][-1]


def truth_of(maps: Maps) -> np.ndarray:
    assert maps.subject.pair.disparity is not None
    return maps.subject.pair.disparity


def visible_in(maps: Maps) -> np.ndarray:
    assert maps.subject.pair.visible is not None
    return maps.subject.pair.visible


def chosen_of(maps: Maps, step: int) -> float:
    """The disparity of the followed pixel."""
    u, v = maps.subject.pixel
    return float(maps[step].disparity[v, u])


def off_in(maps: Maps, state: State, part: tuple[slice, slice]) -> float:
    """Return the share of a part of the map that is over 1 px off."""
    return float((np.abs(state.disparity - truth_of(maps)) > 1.0)[part].mean())


BARE_PART = (slice(30, 90), slice(46, 88))
STRIPED_PART = (slice(30, 90), slice(60, 110))
