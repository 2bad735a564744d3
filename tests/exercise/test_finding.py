"""Which exercises a lesson has, and for which a file is handed in: by what it says and defines."""

import dataclasses
import shutil
import subprocess
import sys
import types
from pathlib import Path

import pytest

from tests import fake
from workbench.errors import InputError, LeftOutWarning
from workbench.exercise import finding
from workbench.exercise.finding import exercises_in, find_exercise, said_for
from workbench.exercise.submission import Submission
from workbench.lesson import catalog, course
from workbench.run.loading import load

CIRCLE = Path(__file__).parents[1] / "authoring" / "circle"
NAMES = ("pose", "pose_step", "match")


@pytest.fixture(autouse=True)
def few(monkeypatch):
    known = {name: types.SimpleNamespace(name=name) for name in NAMES}
    monkeypatch.setattr(finding, "exercises", lambda: known)


def of(file: str, *defines: str, named: tuple[str, ...] = (), broken: str = "") -> Submission:
    return Submission(file, "", said=named, defines=frozenset(defines), broken=broken)


@pytest.mark.parametrize(
    ("given", "names"),
    [
        (of("a.py", "pose", "match"), []),
        (of("a.py", "pose", "match", named=("match",)), ["match"]),
        (of("a.py", "pose", named=("match", "none")), ["match"]),
        (of("a.py", named=("none",)), []),
        (of("my_match.py", "match"), ["match"]),
        (of("my_match.py", "match", "pose", named=("pose",)), ["pose"]),
        (of("my_match.py", "match", named=("pose",)), ["match"]),
        (of("week 3/Match (2).py", "match", "pose"), ["match"]),
        (of("match_and_pose.py", "match", "pose"), ["match", "pose"]),
        (of("my_pose_step.py", "pose", "pose_step"), ["pose_step"]),
        (of("pose_step_pose.py", "pose"), ["pose_step", "pose"]),
        (of("rematch.py", "match"), []),
        (of("match_homework.py", "pose"), []),
        (of("match_homework.py", "other"), ["match"]),
        (of("1_my_match.py", "pose"), ["match"]),
        (of("my_homework_match.py", "pose"), []),
        (of("my_pose_step.py"), ["pose_step"]),
    ],
)
def test_a_file_says_what_it_is_for_in_its_first_line_or_its_name(given, names):
    assert [exercise.name for exercise in said_for(given)] == names


@pytest.mark.parametrize(
    ("given", "expected"),
    [
        (of("a.py", "pose", "match", "other"), ["pose", "match"]),
        (of("my_match.py", "pose", "match"), ["match"]),
        (of("a.py", "other"), "a.py: defines none of the exercises' functions (pose, pose_step,"),
        (of("a.py", broken="a.py, line 3: no"), "a.py, line 3: no"),
        (of("my_match.py", "Match"), "my_match.py: is for match and defines no such function; it"),
        (of("my_pose_step.py", "posestep"), "defines posestep, which is another name"),
        (of("my_match.py", "a"), "my_match.py: is for match and defines no such function"),
        (
            of("match_pose.py", "pose"),
            "match_pose.py: is for match and defines no such function",
        ),
    ],
)
def test_a_file_is_graded_for_what_it_says_or_else_for_what_it_defines(given, expected):
    if isinstance(expected, list):
        assert [exercise.name for exercise in exercises_in(given)] == expected
    else:
        with pytest.raises(InputError) as told:
            exercises_in(given)
        assert expected in str(told.value)
        assert str(told.value).endswith("another name") or "another name" not in expected


def test_where_there_are_no_exercises_that_is_said(monkeypatch):
    monkeypatch.setattr(finding, "exercises", dict)
    with pytest.raises(InputError, match=r"the exercises' functions \(there are none\)$"):
        exercises_in(of("a.py", "pose"))


def test_of_two_names_in_a_file_s_name_the_longer_counts():
    names = ["step", "pose_step", "pose"]
    assert finding._in_words("my_pose_step.py", names) == ["pose_step"]
    assert finding._in_words("step_pose_step.py", names) == ["step", "pose_step"]


def test_an_exercise_is_found_by_its_name():
    assert find_exercise("match").name == "match"
    with pytest.raises(InputError, match=r"^no exercise is named 'mach'; did you mean match"):
        find_exercise("mach")


def test_names_are_those_of_a_lesson_where_one_is_given():
    lesson = catalog()["icp"]
    assert "match" in finding.known(lesson)
    assert "harris_response" not in finding.known(lesson)
    assert finding.exercises_in_folder(fake.lesson) == ()
    assert list(finding.known(lesson)) == [
        exercise.name for exercise in finding.exercises_of(lesson)
    ]


def test_exercises_are_in_the_order_of_the_run_s_keywords():
    for lesson in course().values():
        exercises = finding.exercises_of(lesson)
        slots = [lesson.form.slots.index(exercise.contract.slot) for exercise in exercises]
        assert slots == sorted(slots)
        assert finding.usable()[lesson.name] == exercises


def test_somebody_else_s_exercises_take_none_of_the_course_down(monkeypatch):
    lesson = dataclasses.replace(catalog()["icp"], name="other")
    places = {"match": "lesson icp (lessons.icp.inputs)"}
    with pytest.warns(LeftOutWarning, match="exercise match of lesson other .* is taken by lesson"):
        kept = finding._not_taken(lesson, places)
    assert kept
    assert "match" not in [exercise.name for exercise in kept]
    assert places[kept[0].name] == "lesson other (lessons.icp.inputs)"

    def stumbles(lesson):
        raise SystemExit(3)

    monkeypatch.setattr(finding, "exercises_in_folder", stumbles)
    with pytest.warns(LeftOutWarning, match="the exercises of lesson other .*: SystemExit: 3"):
        assert finding._not_taken(lesson, {}) == ()


def test_a_lesson_outside_the_catalogue_has_the_exercises_of_its_folder(tmp_path):
    assert finding.exercises_of(fake.lesson) == ()
    shutil.copytree(CIRCLE, tmp_path / "circle")
    hidden = tmp_path / "circle" / "exercises" / finding.HIDDEN
    hidden.mkdir()
    (hidden / "__init__.py").touch()  # it has no checks of this exercise
    lesson = load(tmp_path / "circle")
    (exercise,) = finding.exercises_of(lesson)
    assert exercise.name == "circle_distances"


def test_two_lessons_of_the_course_have_no_exercise_of_one_name(monkeypatch):
    icp = catalog()["icp"]
    twice = {"icp": icp, "other": dataclasses.replace(icp, name="other")}
    monkeypatch.setattr(finding, "course", lambda: twice)
    monkeypatch.setattr(
        finding, "_of_course", lambda name: finding.exercises_in_folder(twice[name])
    )
    message = (
        r"^exercise \w+ is in lesson icp \(lessons.icp.inputs\) and in lesson other .*: rename"
    )
    with pytest.raises(InputError, match=message):
        finding.usable.__wrapped__()


def test_an_exercise_of_no_keyword_is_refused(monkeypatch):
    lesson = dataclasses.replace(catalog()["icp"], run=lambda params, subject, *, f=abs: iter(()))
    with pytest.raises(InputError, match=r"run of lesson icp has no keyword '\w+'; it has: f$"):
        finding.exercises_in_folder(lesson)


def test_to_find_an_exercise_its_own_lesson_alone_is_imported():
    code = (
        "import sys; from workbench.exercise.finding import find_exercise;"
        " print(find_exercise('match').lesson, *sorted(m for m in sys.modules"
        " if m.startswith('lessons.') and m.endswith('.lesson')))"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.split() == ["icp", "lessons.icp.lesson"]
