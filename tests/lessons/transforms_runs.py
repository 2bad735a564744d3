"""Runs of the transforms lesson that its tests share."""

import numpy as np

from lessons.transforms.lesson import lesson
from lessons.transforms.presets import complete
from lessons.transforms.state import Built, Moved, Params
from tests.runs import finished
from workbench.geometry.motions.rotations import axis_angle_from_rotation
from workbench.run.timeline import Timeline

MOVE = Params(half="move between two poses")


def timeline(params: Params) -> Timeline:
    return finished(lesson.name, params)


def built(params: Params) -> Built:
    return complete(timeline(params).states())


def moved(params: Params) -> list[Moved]:
    return [state for state in timeline(params).states() if isinstance(state, Moved)]


def preset(name: str) -> Params:
    return lesson.preset(name).params


def opened(name: str):
    shown = lesson.preset(name)
    assert shown.step is not None
    return timeline(shown.params)[shown.step]


def opened_at(params: Params, step: int):
    return timeline(params)[step]


def exp_axis(start: Moved, end: Moved) -> tuple[np.ndarray, np.ndarray]:
    """A point and the direction of the line about which a motion turns, by solving for what the
    turn leaves alone.
    """
    T = end.T_world_body @ np.linalg.inv(start.T_world_body)
    n = axis_angle_from_rotation(T[:3, :3])[0]
    along = n * (n @ T[:3, 3])
    return np.linalg.lstsq(np.eye(3) - T[:3, :3], T[:3, 3] - along)[0], n


def survivors(state: Built) -> set[str]:
    return {change.name for change in state.by_factor if change.kept}
