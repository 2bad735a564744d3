"""Runs of the curvature lesson that its tests share, and what they read off them."""

from typing import TypeVar

from lessons.curvature.inputs import Input
from lessons.curvature.lesson import lesson
from lessons.curvature.mesh import subject_of
from lessons.curvature.state import State, Study, at_stage, beside_its_mesh
from tests.runs import finished
from workbench.run.timeline import Timeline
from workbench.scene import Field, Mesh, Scene

Kind = TypeVar("Kind")
STAGES = [
    "mesh",
    "ring",
    "defect",
    "gaussian",
    "normal",
    "mean",
    "principal",
    "quadric",
    "total",
    "finer",
]


def timeline(params: Input) -> Timeline:
    return finished(lesson.name, params)


def states(params: Input) -> list[State]:
    """Return the steps of a mesh, each beside it."""
    subject = subject_of(params)
    return [beside_its_mesh(params, subject, step) for step in timeline(params).states()]


def at(params: Input, stage: str) -> State:
    return at_stage(states(params), stage)


def scene(params: Input, stage: str):
    return next(step.scene for step in timeline(params).known() if step.state.stage == stage)


def part(kind: type[Kind], scene: Scene, path: str) -> Kind:
    """Return one thing of a picture, which must be of its kind."""
    primitive = scene[path]
    assert isinstance(primitive, kind)
    return primitive


def study_in(state: State) -> Study:
    assert state.study is not None
    return state.study


def surface_field(params: Input, stage: str) -> Field:
    color = part(Mesh, scene(params, stage), "surface").color
    assert isinstance(color, Field)
    return color


def preset(name: str) -> Input:
    return lesson.preset(name).params
