"""Runs of the pinhole lesson that its tests share."""

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from lessons.pinhole.inputs import Input
from lessons.pinhole.lesson import lesson, run, setup
from lessons.pinhole.models import State
from lessons.pinhole.shot import Shot
from tests.runs import finished
from workbench.lesson import Look, States
from workbench.scene import PALETTE

ORANGE = np.array(PALETTE["source"])


def states(params: Input, **slots: Any) -> States[Input, Shot, State]:
    shot = setup(params)
    return States.of(tuple(run(params, shot, **slots)), params=params, subject=shot)


def preset(name: str) -> States[Input, Shot, State]:
    return states(lesson.preset(name).params)


def look(seen: States[Input, Shot, State], k: int) -> Look[Input, Shot, State]:
    past: Sequence[State] = seen[:k]
    return Look(params=seen.params, subject=seen.subject, now=seen[k], past=tuple(past))


def question(name: str):
    return next(question for question in lesson.questions if question.name == name)


def orange(picture: np.ndarray) -> np.ndarray:
    return (picture == ORANGE).all(axis=2)


def tone(params: Input, step: int) -> str:
    return finished(lesson.name, params)[step].caption.tone


def with_(params: Input, **changes: Any) -> Input:
    return replace(params, **changes)
