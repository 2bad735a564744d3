import ast
import importlib.metadata
import subprocess
import sys
from types import ModuleType

import pytest

from tests import fake
from workbench.errors import InputError
from workbench.exercise.finding import exercises_of
from workbench.lesson import catalog, find, place_of
from workbench.run import listing
from workbench.run.listing import listed
from workbench.run.loading import load


@pytest.fixture
def registered(monkeypatch):
    """Registers entry points of third parties; the catalogue is read anew."""

    def register(*values: str) -> None:
        entries = [
            importlib.metadata.EntryPoint("theirs", value, "workbench.lessons") for value in values
        ]
        monkeypatch.setattr(importlib.metadata, "entry_points", lambda group: entries)

    catalog.cache_clear()
    yield register
    catalog.cache_clear()


def test_the_course_is_in_its_order():
    assert list(catalog())[:3] == ["transforms", "rotations", "coordinates"]
    assert list(catalog().values()) == sorted(catalog().values(), key=place_of)


def test_a_third_party_s_lesson_joins(registered):
    registered("tests.fake:lesson")
    assert catalog()["fake"] is fake.lesson


@pytest.mark.parametrize(
    ("value", "message"),
    [("no_such_module:lesson", "no_such_module"), ("tests.fake:run", "of type Lesson")],
)
def test_a_third_party_s_broken_lesson_is_left_out_and_named(registered, value, message):
    registered(value)
    with pytest.warns(UserWarning, match=f"lesson theirs .* is left out: .*{message}"):
        assert "icp" in list(catalog())


def test_a_lesson_from_a_file_or_a_line_that_says_why_not(tmp_path):
    file = tmp_path / "mine.py"
    with pytest.raises(InputError, match="no such file"):
        load(file)
    file.write_text("from tests.fake import lesson\n")
    assert load(file) is fake.lesson
    for text, message in (
        ("lesson = 3\n", "of type Lesson"),
        ("1 / 0\n", "ZeroDivisionError"),
        ("raise SystemExit(0)\n", "SystemExit"),
    ):
        file.write_text(text)
        with pytest.raises(InputError, match=f"mine.py: .*{message}"):
            load(file)
    with pytest.raises(
        InputError, match="no lesson is named 'nothing'; there are: transforms, rotations"
    ):
        find("nothing")


def test_exercises_are_imported_only_where_they_are_wanted():
    wanted = "lessons.icp.exercise"
    kept: ModuleType | None = sys.modules.pop(wanted, None)
    try:
        assert catalog()["icp"].name == "icp"
        assert wanted not in sys.modules
        assert [exercise.lesson for exercise in exercises_of(catalog()["icp"])] == ["icp"] * 3
    finally:
        if kept is not None:
            sys.modules[wanted] = kept


def test_the_list_that_is_read_off_the_source_is_the_catalogue():
    lines = [f"{lesson.name} {lesson.summary}" for lesson in catalog().values()]
    assert [" ".join(line.split()) for line in listed().splitlines()] == lines
    assert {"numpy", "workbench.lesson"}.isdisjoint(loaded_by("list"))


def test_the_list_asks_the_catalogue_where_the_source_does_not_tell(registered, monkeypatch):
    registered("tests.fake:lesson")
    monkeypatch.setattr(listing, "entry_points", importlib.metadata.entry_points)
    assert fake.lesson.summary in listed()
    head = ast.parse('lesson = Lesson(name="a", summary=f"{1}", order=3)')
    assert listing._head(head) is None


def loaded_by(command: str) -> set[str]:
    code = (
        f"import sys; sys.argv[1:] = [{command!r}]; from workbench.__main__ import main; main();"
        " print('|', *sys.modules)"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    return set(done.stdout.split("|")[-1].split())
