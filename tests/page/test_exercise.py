"""Exercises on a lesson's page: all of them in every lesson, and the words of the terminal about a
student's file.
"""

import html
import json
from dataclasses import replace

import pytest

from tests import fake
from workbench.exercise.finding import exercises, exercises_of
from workbench.exercise.grading import grade_function
from workbench.exercise.reports import counted, terminal
from workbench.exercise.starter import commands, starter, write_starter
from workbench.exercise.watching import WatchedFile
from workbench.lesson import catalog
from workbench.page.exercise import report_data, watched_html
from workbench.viewer.documents import lesson_page


@pytest.mark.parametrize("lesson", catalog().values(), ids=lambda lesson: lesson.name)
def test_every_lesson_s_page_has_its_exercises_and_knows_the_course(lesson):
    page = html.unescape(lesson_page(lesson, catalog()))
    assert exercises_of(lesson)
    for exercise in exercises_of(lesson):
        assert exercise.task in page
        assert starter(exercise) in page
        assert "\n".join(commands(exercise)) in page
    course = json.loads(page.partition("const COURSE = ")[2].partition(";")[0])
    assert [entry["name"] for entry in course] == list(catalog())
    assert 'data-address="?lesson=LESSON"' in page


def test_a_lesson_without_exercises_has_no_such_section():
    page = lesson_page(fake.lesson, {"fake": fake.lesson})
    assert 'id="exercise"' not in page


@pytest.mark.parametrize(
    "exercise", exercises_of(catalog()["icp"]), ids=lambda exercise: exercise.name
)
def test_what_the_checks_found_is_said_in_the_words_of_the_terminal(exercise):
    for function in (exercise.mistakes[0].function, exercise.alternatives[0]):
        report = grade_function(function, exercise, hidden=False, file="mine.py")
        data, text = report_data(report), terminal(report)
        assert data["said"] == counted(report)
        for check in data["checks"]:
            assert (
                f"{check['mark']} {check['word']:<7} {check['points']:>5}  {check['promise']}"
                in text
            )
            assert check["message"] in text
        assert data["mistake"] in text
        assert bool(data["mistake"]) == (report.mistake is not None)


@pytest.mark.parametrize("name", ["point_to_plane_step", "match"])
def test_a_watched_file_is_told_of_the_run_that_calls_it(name):
    exercise = exercises()[name]
    lesson = catalog()["icp"]
    page = watched_html(exercise, "mine.py", lesson, address=lambda run: f"?run={run}")
    calling, idle = page.partition('data-called="false"')[::2]
    assert "drives this lesson" in calling
    assert "drives this lesson" not in idle
    assert page.count(" hidden>") == 2  # neither is said before the run is known
    run = exercise.contract.preset or "default"
    title = (
        "Point-to-plane, from 35° away"
        if name == "point_to_plane_step"
        else "The run this lesson opens with"
    )
    assert f'<a class="run" href="?run={run}" data-run="{run}">' in idle
    assert title in idle


def test_what_is_found_of_a_watched_file_stands_before_the_text(tmp_path):
    lesson = catalog()["icp"]
    watched = WatchedFile(lesson, write_starter(exercises()["match"], tmp_path))
    page = lesson_page(watched.lesson, catalog(), watched)
    watched.close()
    assert page.index('class="report"') < page.index('class="wb"')
    assert page.count('id="exercise"') == 1


def test_what_a_student_wrote_cannot_end_up_as_html():
    (exercise, *_) = exercises_of(catalog()["icp"])
    evil = replace(exercise, task="<script>alert(1)</script>")
    page = watched_html(evil, "<img src=x>.py", catalog()["icp"], address=lambda run: f"?{run}")
    assert "<script>" not in page
    assert "<img" not in page
    assert report_data("the file is being checked") == {
        "said": "the file is being checked",
        "ran": "",
    }
