"""Runs of the ICP lesson that its tests share, and own scans in two files."""

from collections.abc import Mapping
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

from lessons.icp.lesson import lesson, run
from lessons.icp.presets import HOME
from lessons.icp.state import Params, State, Try
from tests.runs import finished
from workbench.run.timeline import Timeline
from workbench.scene import Caption


def timeline(params: Params) -> Timeline:
    return finished(lesson.name, params)


def states(params: Params) -> tuple[State, ...]:
    return timeline(params).states()


@cache
def until_stop(params: Params) -> tuple[State, ...]:
    """Return the steps of ICP itself; the tries afterwards take most of a run's time."""
    found = []
    for state in run(params):
        found.append(state)
        if state.icp.stop:
            break
    return tuple(found)


def preset(name: str) -> tuple[State, ...]:
    return until_stop(lesson.preset(name).params)


def tries(name: str) -> tuple[Try, ...]:
    return states(lesson.preset(name).params)[-1].tries


def scene(params: Params, k: int) -> Mapping[str, Any]:
    return timeline(params)[k].scene


def true(state: State) -> np.ndarray:
    assert state.scans.T_truth is not None
    return state.scans.T_truth


def caption(params: Params, k: int) -> Caption:
    return timeline(params)[k].caption


def two_scans(folder: Path) -> Params:
    scans = states(HOME)[0].scans
    for name, p in (("a.xyz", scans.p_target), ("b.csv", scans.p_source)):
        np.savetxt(folder / name, 1000 * p + 5000, delimiter="," if name.endswith("csv") else " ")
    return Params(target=folder / "a.xyz", source=folder / "b.csv")
