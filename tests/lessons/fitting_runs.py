"""Runs of the fitting lesson that its tests share."""

from typing import Any

from lessons.fitting.lesson import lesson
from lessons.fitting.state import Params
from tests.runs import finished


def states(params: Params) -> tuple[Any, ...]:
    return finished(lesson.name, params).states()


def of(name: str) -> tuple[Any, ...]:
    return states(lesson.preset(name).params)
