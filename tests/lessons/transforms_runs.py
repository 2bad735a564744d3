"""Runs of the lessons on transforms and rotations that their tests share."""

from typing import Any

from tests.runs import finished
from workbench.lesson import catalog


def states(lesson: str, name: str = "default") -> Any:
    return finished(lesson, catalog()[lesson].run_params(name)).states()


def scene(lesson: str, name: str, k: int) -> Any:
    return finished(lesson, catalog()[lesson].run_params(name))[k].scene


def of(lesson: str, params: Any) -> Any:
    return finished(lesson, params).states()
