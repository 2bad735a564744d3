"""Recording many runs in one process leaves no threads behind, and small files."""

import os
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

import numpy as np
import pytest

from tests import fake
from workbench.knobs import Knob
from workbench.lesson import Lesson
from workbench.recording.streams import application_id
from workbench.recording.write import record_bytes
from workbench.scene import Caption, Points, Scalar, Scene
from workbench.timeline import Timeline
from workbench.watch import watched


@pytest.mark.skipif(sys.platform != "linux", reason="counts threads in /proc")
def test_recording_again_and_again_leaves_no_threads():
    timeline = Timeline(fake.lesson, fake.Params(steps=2)).complete()
    counts = []
    for _ in range(6):
        record_bytes(timeline)
        counts.append(len(os.listdir("/proc/self/task")))
    assert counts[-1] <= counts[1]


def test_layouts_belong_to_the_lesson():
    assert application_id("icp") != application_id("ransac")
    assert application_id("Chamfer_EMD") == "workbench-chamfer-emd-1"


@dataclass(frozen=True)
class Params:
    """A rigid run of the size the size bound speaks of."""

    seed: Annotated[int, Knob("Which points", 0, 9)] = 0


@watched
def turning(p: np.ndarray, q: np.ndarray) -> Iterator[tuple[int, np.ndarray, np.ndarray]]:
    """Yield fifty steps."""
    for k in range(50):
        yield k, p, q


def draw(state: tuple[int, np.ndarray, np.ndarray]) -> Scene:
    """Show two clouds of which one turns."""
    k, p, q = state
    return {
        "target": Points(q, "target", name="target"),
        "source": Points(p, "source", T_world_object=fake.turn_about_z(k / 50), name="source"),
        "rmse": Scalar(1.0 / (k + 1), "RMSE", "RMSE", "m"),
        "error": Scalar(50.0 - k, "Rotation error", "Rotation error", "deg", "truth"),
        "caption": Caption(f"Fit {k}: the source turned, RMSE {1 / (k + 1):.4f} m."),
    }


def run(params: Params) -> Iterator[tuple[int, np.ndarray, np.ndarray]]:
    """Turn 20,000 points."""
    rng = np.random.default_rng(params.seed)
    yield from turning(*rng.uniform(-1, 1, (2, 20_000, 3)))


RIGID = Lesson("rigid", "Rigid", "Turns.", Path("none.md"), Params, run, draw, 1)


def test_a_rigid_run_of_20k_points_and_50_steps_stays_below_a_megabyte():
    data = record_bytes(Timeline(RIGID, Params()).complete())
    assert len(data) < 1_000_000


def test_progress_is_told_step_by_step():
    told = []
    record_bytes(Timeline(fake.lesson, fake.Params()).complete(), progress=lambda *words: told.append(words))
    assert told == [("recorded", k, 6) for k in range(1, 7)]
