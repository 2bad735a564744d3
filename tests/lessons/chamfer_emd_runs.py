"""Runs of the lesson on Chamfer and earth mover's that its tests share."""

from collections.abc import Mapping
from typing import Any

from lessons.chamfer_emd.lesson import lesson
from lessons.chamfer_emd.state import Params, State
from tests.runs import finished
from workbench.run.timeline import Timeline


def timeline(params: Params) -> Timeline:
    return finished(lesson.name, params)


def states(params: Params) -> tuple[State, ...]:
    return timeline(params).states()


def preset(name: str) -> tuple[State, ...]:
    return states(lesson.preset(name).params)


def line(name: str) -> str:
    return lesson.preset(name).line


def scene(params: Params, k: int) -> Mapping[str, Any]:
    return timeline(params)[k].scene
