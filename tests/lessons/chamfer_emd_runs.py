"""Runs of the lesson on Chamfer and earth mover's that its tests share."""

from collections.abc import Mapping
from typing import Any

from lessons.chamfer_emd.clouds import clouds_of
from lessons.chamfer_emd.inputs import Input
from lessons.chamfer_emd.lesson import lesson
from lessons.chamfer_emd.state import Clouds, State, beside_its_clouds
from tests.runs import finished
from workbench.certain import as_a
from workbench.run.timeline import Timeline


def timeline(params: Input) -> Timeline:
    return finished(lesson.name, params)


def states(params: Input) -> list[State]:
    """Return the steps of the flows, each beside its clouds."""
    steps = timeline(params).states()
    clouds = as_a(Clouds, steps.subject)
    return [beside_its_clouds(params, clouds, step) for step in steps]


def flows(params: Input, **slots: Any) -> list[State]:
    """Return the steps of the flows with other functions in the slots."""
    clouds = clouds_of(params)
    return [beside_its_clouds(params, clouds, step) for step in lesson.run(params, clouds, **slots)]


def held(preset: str) -> tuple[Any, ...]:
    """Return the steps of a stage that is turned by hand."""
    return timeline(lesson.preset(preset).params).states()


def preset(name: str) -> list[State]:
    return states(lesson.preset(name).params)


def line(name: str) -> str:
    return lesson.preset(name).line


def scene(params: Input, k: int) -> Mapping[str, Any]:
    return timeline(params)[k].scene
