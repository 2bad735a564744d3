"""What third parties install joins the course; what clashes or breaks is left out in one line, and the course is whole."""

import importlib.metadata
import os
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import pytest

from tests import fake
from tests.exercise.centroid import EXERCISE
from workbench import listing
from workbench.cli import main
from workbench.errors import LeftOutWarning
from workbench.exercise.starter import exercises, exercises_of
from workbench.lesson import catalog, course

ROOT = Path(__file__).resolve().parents[1]
OURS = {name: lesson.order for name, lesson in course().items()}
OUR_EXERCISES = [exercise.name for lesson in course().values() for exercise in lesson.exercises()]


def broken():
    raise SystemExit("no exercises today")


# what the entry points below name
icp = replace(fake.lesson, name="icp", summary="Not the course's.", order=1)
taken = replace(
    fake.lesson, name="spirals", exercises=lambda: (replace(EXERCISE, name="align_rigid", lesson="spirals"),)
)
good = replace(fake.lesson, exercises=lambda: (EXERCISE,))
same = replace(fake.lesson, name="other", exercises=lambda: (replace(EXERCISE, lesson="other"),))
strange = replace(fake.lesson, name="strange", exercises=lambda: (replace(EXERCISE, name="odd", lesson="icp"),))
failing = replace(fake.lesson, name="failing", exercises=broken)


@pytest.fixture
def install(monkeypatch):
    """Registers lessons of this module under the entry points of third parties; the catalogue is read anew."""

    def register(*values: str) -> None:
        entries = [
            importlib.metadata.EntryPoint(f"by-{i}", value, "workbench.lessons") for i, value in enumerate(values)
        ]
        for module in (importlib.metadata, listing):
            monkeypatch.setattr(module, "entry_points", lambda group: entries)

    catalog.cache_clear()
    yield register
    catalog.cache_clear()


@pytest.mark.parametrize(
    ("values", "said"),
    [
        (
            ["tests.test_third_parties:icp"],
            r"lesson by-0 \(tests.test_third_parties:icp\) .*'icp' is taken by lessons.icp",
        ),
        (
            ["tests.fake:lesson", "tests.test_third_parties:good"],
            r"lesson by-1 \(tests.test_third_parties:good\) .*'fake' is taken by by-0 \(tests.fake:lesson\)",
        ),
        (["tests.test_third_parties:nothing"], "lesson by-0 .*of type Lesson"),
    ],
)
def test_a_lesson_with_a_taken_name_is_left_out_and_both_places_are_named(capsys, install, values, said):
    install(*values)
    with pytest.warns(LeftOutWarning, match=said):
        assert main(["list"]) == 0
    lines = capsys.readouterr().out.splitlines()
    theirs = len(values) - 1
    assert len(lines) == len(OURS) + theirs
    assert {name: lesson.order for name, lesson in catalog().items() if name in OURS} == OURS
    assert not any("Not the course's" in line for line in lines)


@pytest.mark.parametrize(
    ("values", "said", "more"),
    [
        (["taken"], r"exercise align_rigid of lesson spirals \(tests.fake\) .* taken by lesson icp \(lessons.icp", []),
        (["good", "same"], r"exercise centroid of lesson other .* taken by lesson fake \(tests.fake\)", ["centroid"]),
        (["strange"], "exercise odd of lesson strange .* belongs to lesson 'icp'", []),
        (["failing"], "exercises of lesson failing .*: SystemExit: no exercises today", []),
    ],
)
def test_an_exercise_with_a_taken_name_is_left_out_and_both_places_are_named(capsys, install, values, said, more):
    install(*(f"tests.test_third_parties:{value}" for value in values))
    with pytest.warns(LeftOutWarning, match=said):
        assert main(["exercise"]) == 0
    listed = [line.split()[:2] for line in capsys.readouterr().out.splitlines()]
    assert sorted(name for _, name in listed) == sorted([*OUR_EXERCISES, *more])
    assert ["icp", "align_rigid"] in listed


def test_a_third_party_s_exercises_join_in_course_order(install):
    install("tests.test_third_parties:good")
    assert [exercise.name for exercise in exercises_of(good)] == ["centroid"]
    order = list(catalog())
    places = [order.index(exercise.lesson) for exercise in exercises().values()]
    assert places == sorted(places)


def test_what_is_left_out_is_one_line_where_a_person_reads_it(tmp_path):
    (tmp_path / "theirs.py").write_text(
        "from dataclasses import replace\nfrom tests.fake import lesson as other\nlesson = replace(other, name='icp')\n"
    )
    about = tmp_path / "theirs-1.0.dist-info"
    about.mkdir()
    (about / "METADATA").write_text("Metadata-Version: 2.1\nName: theirs\nVersion: 1.0\n")
    (about / "entry_points.txt").write_text("[workbench.lessons]\nmine = theirs:lesson\n")
    path = os.pathsep.join([str(tmp_path), str(ROOT)])
    words = [sys.executable, "-m", "workbench", "list"]
    done = subprocess.run(words, capture_output=True, text=True, check=False, env=os.environ | {"PYTHONPATH": path})
    assert done.returncode == 0
    assert done.stderr == "workbench: lesson mine (theirs:lesson) is left out: its name 'icp' is taken by lessons.icp\n"
    assert len(done.stdout.splitlines()) == len(OURS)
