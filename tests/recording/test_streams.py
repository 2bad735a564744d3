"""Recording many runs in one process leaves no threads behind, and small files."""

import os
import sys
from dataclasses import replace
from itertools import islice

import pytest

from tests import fake
from workbench.lesson import catalog
from workbench.recording.streams import application_id
from workbench.recording.write import record_bytes
from workbench.timeline import Timeline


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


def test_a_rigid_run_of_20k_points_and_50_steps_stays_below_a_megabyte():
    icp = catalog()["icp"]
    long = Timeline(replace(icp, run=lambda params: islice(icp.run(params), 50)), icp.params(points=20_000)).complete()
    assert len(long) == 50
    assert len(record_bytes(long)) < 1_000_000


def test_progress_is_told_step_by_step():
    told = []
    record_bytes(Timeline(fake.lesson, fake.Params()).complete(), progress=lambda *words: told.append(words))
    assert told == [("recorded", k, 6) for k in range(1, 7)]
