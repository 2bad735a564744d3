"""A lesson as `workbench new` wrote it before there was a second form: `authoring/old/beacon` is
left as it was.
"""

from pathlib import Path

import pytest

from workbench import open_recording
from workbench.cli import main
from workbench.exercise.finding import exercises_of
from workbench.exercise.grading import grade_function
from workbench.lesson import Lesson
from workbench.run.loading import load
from workbench.run.questions import answer
from workbench.run.timeline import Timeline, Timelines

BEACON = Path(__file__).resolve().parents[1] / "authoring" / "old" / "beacon"


@pytest.fixture(scope="module")
def lesson() -> Lesson:
    return load(BEACON)


def test_its_runs_come_to_their_ends(lesson):
    for params in (lesson.params(), *(preset.params for preset in lesson.presets)):
        run = Timeline(lesson, params).complete()
        assert (len(run), run.stopped, run.idle()) == (30, None, ())


def test_its_questions_are_answered(lesson):
    for question in lesson.questions:
        assert answer(lesson, question, None, timelines=Timelines()).why


def test_its_exercise_is_graded(lesson):
    (exercise,) = exercises_of(lesson)
    assert grade_function(exercise.reference, exercise).is_full
    assert not any(
        grade_function(mistake.function, exercise).is_full for mistake in exercise.mistakes
    )


def test_it_is_recorded_and_read_again(lesson, tmp_path):
    out = tmp_path / "equal.rrd"
    assert main(["record", str(BEACON), "--preset", "equal", "-o", str(out)]) == 0
    recording = open_recording(out)
    assert (recording.lesson, len(recording)) == ("beacon", 30)


def test_its_handout_is_written_and_judged(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert main(["exercise", "weighted_centroid", "--lesson", str(BEACON)]) == 0
    mine = tmp_path / "my_weighted_centroid.py"
    text = mine.read_text(encoding="utf-8")
    right = "if not w.any():\n        raise ValueError\n    return w @ p / w.sum()"
    mine.write_text(text.replace("raise NotImplementedError", right), encoding="utf-8")
    assert main(["check", str(mine), "--lesson", str(BEACON), "--hidden"]) == 0
