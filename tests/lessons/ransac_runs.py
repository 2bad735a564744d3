"""Runs of the RANSAC lesson that its tests share, and what they read off them."""

import functools
from typing import TypeVar

import numpy as np

from lessons.ransac.captions import is_right
from lessons.ransac.lesson import lesson
from workbench.lesson import Look
from workbench.run.timeline import Timeline
from workbench.scene import Scene

Kind = TypeVar("Kind")


@functools.cache
def states_of(params):
    """The States of a run: with its params and its subject."""
    return Timeline(lesson, params).states()


def best(state):
    assert state.best is not None
    return state.best


def end(states):
    return next(state for state in states if state.phase == "stop")


def best_error(states) -> float:
    """How far the end of a run is from the truth."""
    return states.subject.error(best(end(states)).estimate)


def ends_right(states) -> bool:
    return is_right(states.params, states.subject, end(states))


def members(subject) -> np.ndarray:
    """Which rows were made from the model, which has to be known."""
    assert subject.is_inlier is not None
    return subject.is_inlier


def truth_of(subject) -> np.ndarray:
    assert subject.truth is not None
    return subject.truth


def part(scene, path: str, kind: type[Kind]) -> Kind:
    """The primitive at a path, which has to be of a kind."""
    primitive = scene[path]
    assert isinstance(primitive, kind)
    return primitive


def drawn(states, k: int) -> Scene:
    """The picture of a step."""
    look = Look(params=states.params, subject=states.subject, now=states[k], past=tuple(states[:k]))
    return lesson.form.draw(look)


def rivals(states):
    return {name: states.subject.error(rival) for name, rival in states.subject.rivals.items()}
