"""The first failing case: of which run it is, where it ends, and where its recording lies."""

import pytest

from workbench.exercise.failing import AFTER, failing_run, record_failing
from workbench.exercise.finding import find_exercise
from workbench.exercise.sandbox import SandboxedFunction
from workbench.lesson import catalog
from workbench.recording import open_recording

ICP = catalog()["icp"]
SLIDES = """import numpy as np

def align_rigid(p_target, p_source):
    T = np.eye(4)
    T[:3, 3] = (p_target - p_source).mean(axis=0)
    return T
"""
STAYS = """import numpy as np

def point_to_plane_step(p_target, p_source, n_target):
    return np.eye(4)
"""


@pytest.fixture
def handed(tmp_path):
    path = tmp_path / "mine.py"
    path.write_text(SLIDES)
    return path


def test_the_default_run_comes_first_and_a_few_steps_beyond_the_difference(handed):
    with SandboxedFunction(handed, "align_rigid") as student:
        run = failing_run(find_exercise("align_rigid"), student)
    assert run is not None
    timeline, at = run
    assert timeline.params == ICP.params()
    assert (at, len(timeline), timeline.finished) == (1, at + AFTER + 1, False)


def test_the_preset_that_a_function_is_watched_at_comes_before_the_default(handed):
    handed.write_text(STAYS)
    exercise = find_exercise("point_to_plane_step")
    assert exercise.contract.preset == "plane"
    with SandboxedFunction(handed, "point_to_plane_step") as student:
        run = failing_run(exercise, student)
    assert run is not None
    assert run[0].params == ICP.preset("plane").params


def test_the_recording_lies_beside_the_file_or_where_it_is_wanted(handed, tmp_path):
    exercise = find_exercise("align_rigid")
    beside = record_failing(exercise, handed)
    assert beside == tmp_path / "mine.rrd"
    recording = open_recording(beside)
    assert recording.complete
    with SandboxedFunction(handed, "align_rigid") as student:
        run = failing_run(exercise, student)
    assert run is not None
    timeline, at = run
    last_alike = timeline[at - 1].caption.text
    assert (recording.captions[0], len(recording)) == (last_alike, len(timeline) - at + 1)
    wanted = tmp_path / "other.rrd"
    assert record_failing(exercise, handed, wanted) == wanted
    assert open_recording(wanted).complete
    assert record_failing(exercise, handed, tmp_path / "none" / "other.rrd") is None
