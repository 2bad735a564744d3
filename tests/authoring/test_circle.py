"""A lesson as somebody outside writes it, after the guide: it holds its promises, records,
publishes, and is graded.
"""

from pathlib import Path

from workbench import open_recording
from workbench.authoring.exercise_promises import OF_EXERCISES
from workbench.authoring.promises import Subject
from workbench.authoring.validate import look_at
from workbench.cli import main
from workbench.exercise.finding import exercises_of
from workbench.exercise.grading import grade_function
from workbench.publish.site import publish
from workbench.run.loading import load

CIRCLE = Path(__file__).resolve().parents[1] / "authors" / "circle"
MOST_LINES = 310


def test_it_is_small():
    lines = sum(len(path.read_text(encoding="utf-8").splitlines()) for path in CIRCLE.rglob("*.py"))
    assert lines <= MOST_LINES


def test_it_holds_what_is_promised():
    lesson = load(CIRCLE)
    assert (len(lesson.presets), len(lesson.questions), len(exercises_of(lesson))) == (3, 2, 1)
    looked = list(look_at(Subject(lesson)))
    assert [line for line in looked if line is not None] == []
    assert len(looked) > 100 > len(OF_EXERCISES)


def test_it_is_recorded_and_published(tmp_path):
    assert main(["record", str(CIRCLE), "--preset", "arc", "-o", str(tmp_path / "arc.rrd")]) == 0
    assert "233.4 mm from the truth" in open_recording(tmp_path / "arc.rrd").captions[0]
    publish(tmp_path / "site", [load(CIRCLE)])
    page = (tmp_path / "site" / "circle" / "index.html").read_text(encoding="utf-8")
    assert "A circle through points" in page
    assert page.count("<math") > 10


def test_its_exercise_tells_right_from_wrong():
    (exercise,) = exercises_of(load(CIRCLE))
    reports = [grade_function(item.function, exercise) for item in exercise.mistakes]
    assert [report.mistake for report in reports] == list(exercise.mistakes)
    assert all(report.points < report.possible for report in reports)
    assert grade_function(exercise.alternatives[0], exercise).is_full
