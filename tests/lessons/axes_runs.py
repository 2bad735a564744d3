"""Runs of the lesson on axes that its tests share."""

from collections.abc import Mapping
from typing import Any

from lessons.axes.inputs import Input
from lessons.axes.lesson import lesson, run, setup
from lessons.axes.scans import scans_of
from lessons.axes.space import Turns
from tests.runs import finished

HOME = Input()


def states(params: Input) -> Any:
    return finished(lesson.name, params).states()


def preset(name: str) -> Any:
    return states(lesson.preset(name).params)


def subject(name: str) -> Any:
    return setup(lesson.preset(name).params)


def scene(params: Input, k: int) -> Mapping[str, Any]:
    return finished(lesson.name, params)[k].scene


def turns(name: str) -> Turns:
    return preset(name)[-1].turns


def made(params: Input, **slots: Any) -> list[Any]:
    """The steps of a run with functions of one's own, or of one that no other test looks at."""
    return list(run(params, scans_of(params), **slots))
