"""Runs of the RANSAC lesson that its tests share, and what they read off them."""

import functools
from typing import TypeVar

import numpy as np

from lessons.ransac.lesson import lesson
from workbench.run.timeline import Timeline

Kind = TypeVar("Kind")


@functools.cache
def states_of(params):
    return Timeline(lesson, params).states()


def best(state):
    assert state.now.best is not None
    return state.now.best


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


def rivals(state):
    return {rival.name: rival.error for rival in state.rivals}
