"""Runs of the ICP lesson that its tests share, and own scans in two files."""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

from lessons.icp.captions import turned
from lessons.icp.inputs import Input
from lessons.icp.lesson import draw, lesson, run, setup
from lessons.icp.scans import Scans
from lessons.icp.space import Try, edge
from tests.runs import finished
from workbench.algorithms.registration import icp
from workbench.geometry.motions.alignment import MotionError
from workbench.lesson import Look
from workbench.run.timeline import Timeline
from workbench.scene import Caption, Scene

HOME = Input()


@dataclass(frozen=True, eq=False)
class Seen:
    """A step in space with what it stands in: its error, its tries so far, its picture."""

    look: Look[Input, Scans, Any]

    @property
    def scans(self) -> Scans:
        return self.look.subject

    @property
    def icp(self) -> icp.State:
        """The last sub-step of ICP itself."""
        steps = [s for s in (*self.look.past, self.look.now) if isinstance(s, icp.State)]
        return steps[-1]

    @property
    def tries(self) -> tuple[Try, ...]:
        return tuple(s for s in (*self.look.past, self.look.now) if isinstance(s, Try))

    @property
    def error(self) -> MotionError:
        return self.scans.error(self.icp.T_target_source)

    @property
    def home(self) -> bool:
        return self.scans.at_home(self.error)

    @property
    def right(self) -> float:
        return self.scans.right_share(self.icp.indices, self.icp.kept)

    @property
    def turned(self) -> float:
        return turned(self.look, self.icp)

    @property
    def edge(self) -> float | None:
        return edge(self.tries, self.scans)

    @property
    def scene(self) -> Scene:
        return draw(self.look)


def seen(params: Input, **slots: Any) -> Iterator[Seen]:
    """Walk through a run in space."""
    subject = setup(params)
    past = ()
    assert isinstance(subject, Scans)
    for state in run(params, subject, **slots):
        yield Seen(Look(params=params, subject=subject, now=state, past=past))
        past = (*past, state)


def timeline(params: Input) -> Timeline:
    return finished(lesson.name, params)


@cache
def states(params: Input) -> tuple[Seen, ...]:
    return tuple(seen(params))


@cache
def until_stop(params: Input) -> tuple[Seen, ...]:
    """Return the steps of ICP itself; the tries afterwards take most of a run's time."""
    steps = []
    for state in seen(params):
        steps.append(state)
        if state.icp.stop:
            break
    return tuple(steps)


def end(steps: Any) -> Seen:
    """Return the last step of ICP itself."""
    return next(step for step in steps if step.icp.stop is not None)


def preset(name: str) -> tuple[Seen, ...]:
    return until_stop(lesson.preset(name).params)


def tries(name: str) -> tuple[Try, ...]:
    return states(lesson.preset(name).params)[-1].tries


def scene(params: Input, k: int) -> Any:
    return timeline(params)[k].scene


def true(state: Seen) -> np.ndarray:
    assert state.scans.T_truth is not None
    return state.scans.T_truth


def caption(params: Input, k: int) -> Caption:
    return timeline(params)[k].caption


def two_scans(folder: Path) -> Input:
    scans = setup(HOME)
    for name, p in (("a.xyz", scans.p_target), ("b.csv", scans.p_source)):
        delimiter = "," if name.endswith("csv") else " "
        np.savetxt(folder / name, 1000 * p + 5000, delimiter=delimiter)
    return Input(target=folder / "a.xyz", source=folder / "b.csv")
