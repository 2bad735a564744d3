"""Lessons by path: a folder anywhere is a package of its own, with its exercises; what it clashes
with is named.
"""

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from workbench import open_recording
from workbench.cli import main
from workbench.errors import AuthorError, InputError
from workbench.exercise.finding import exercises_of
from workbench.publish.sources import sources_of
from workbench.run.links import show_command
from workbench.run.loading import lesson_given, load
from workbench.run.timeline import Timeline

ROOT = Path(__file__).resolve().parents[1]
CIRCLE = ROOT / "tests" / "authors" / "circle"


@pytest.fixture
def folder(tmp_path) -> Path:
    """A lesson's folder outside the project, with imports of its own files."""
    return Path(
        shutil.copytree(CIRCLE, tmp_path / "circle", ignore=shutil.ignore_patterns("__pycache__"))
    )


def change(file: Path, old: str, new: str) -> None:
    text = file.read_text(encoding="utf-8")
    assert old in text
    file.write_text(text.replace(old, new), encoding="utf-8")


def first_caption(lesson) -> str:
    timeline = Timeline(lesson, lesson.params())
    timeline.extend()
    return timeline[0].caption.text


def test_a_folder_is_loaded_anew_each_time_and_keeps_what_runs(folder):
    before = load(folder)
    stamp = (folder / "draw.py").stat()
    # as long as before, in the same second
    change(folder / "draw.py", "The algebraic", "THE ALGEBRAIC")
    os.utime(folder / "draw.py", ns=(stamp.st_atime_ns, stamp.st_mtime_ns))
    after = load(folder / "lesson.py")
    assert "The algebraic" in first_caption(before)
    assert "THE ALGEBRAIC" in first_caption(after)
    assert not list(folder.rglob("__pycache__"))


def test_two_folders_of_one_name_are_two_lessons(folder, tmp_path):
    other = Path(shutil.copytree(folder, tmp_path / "elsewhere" / "circle"))
    change(other / "state.py", "0.3, 1.0]", "0.3, 9.0]")
    captions = [first_caption(load(place)) for place in (folder, other, folder)]
    assert ["radius 8.9" in caption or "radius 9.0" in caption for caption in captions] == [
        False,
        True,
        False,
    ]


def test_an_error_in_a_file_of_the_folder_is_told_by_that_file_and_line(folder):
    change(folder / "draw.py", "import numpy as np\n", "import numpy as np\n1 / 0\n")
    before = set(sys.modules)
    with pytest.raises(
        AuthorError, match=r"circle/draw\.py, line 4: ZeroDivisionError: .* in `1 / 0`"
    ):
        load(folder)
    assert not [
        name for name in set(sys.modules) - before if name.startswith("lesson_") and "." in name
    ]
    (folder / "draw.py").write_text("def (:\n")
    with pytest.raises(AuthorError, match=r"circle/draw\.py, line 1: SyntaxError"):
        load(folder)


@pytest.mark.parametrize(
    ("name", "message"), [("none", "no such file or folder"), ("empty", "without a lesson.py")]
)
def test_what_is_no_lesson_is_said(tmp_path, name, message):
    (tmp_path / "empty").mkdir()
    with pytest.raises(InputError, match=message):
        lesson_given(str(tmp_path / name))


def test_a_name_of_the_catalogue_is_refused_with_both_places(folder):
    change(folder / "lesson.py", 'name="circle"', 'name="icp"')
    with pytest.raises(
        InputError, match=r"circle: its name 'icp' is taken by lesson icp \(.*lessons/icp/.*\.py\)"
    ):
        lesson_given(str(folder))


def test_a_lesson_of_the_course_by_its_path_is_loaded_anew_with_all_its_modules():
    code = (
        "import sys; from pathlib import Path\nfrom workbench.lesson import find; from"
        " workbench.run.loading import lesson_given\nfrom workbench.exercise.finding import"
        " exercises_of\nold, new = find('ransac'),"
        " lesson_given(sys.argv[1])\nprint(new.params.__module__ == old.params.__module__,"
        " new.params is not old.params, new.draw is not old.draw, len(exercises_of(new)))"
    )
    words = [sys.executable, "-c", code, str(ROOT / "lessons" / "ransac")]
    done = subprocess.run(words, capture_output=True, text=True, check=True, cwd=ROOT)
    assert done.stdout.split() == ["True", "True", "True", "3"]


# commands -----------------------------------------------------------------------------------------


def test_a_folder_is_shown_recorded_and_opened_again(folder, tmp_path, monkeypatch, *, capsys):
    opened: list[tuple] = []
    monkeypatch.setattr("workbench.viewer.serving.serve", lambda *place, **_: opened.append(place))
    monkeypatch.chdir(tmp_path)
    assert main(["record", "circle", "--preset", "arc", "-o", "arc.rrd"]) == 0
    assert open_recording(tmp_path / "arc.rrd").lesson == "circle"
    assert main(["show", "--no-browser", "./circle/", "--points=9"]) == 0
    assert main(["reopen", "arc.rrd", "--lesson", str(folder)]) == 0
    assert [(params.points, params.arc) for _, params, _ in opened] == [(9, 360.0), (40, 60.0)]
    assert capsys.readouterr().err == ""
    lesson, params, _ = opened[0]
    assert show_command(lesson, params) == "workbench show circle --points=9"


def test_a_folder_s_exercise_is_handed_out_watched_checked_and_graded(
    folder, tmp_path, monkeypatch, *, capsys
):
    watched = []
    monkeypatch.setattr(
        "workbench.viewer.serving.serve", lambda *place, **more: watched.append(more["watched"])
    )
    monkeypatch.chdir(tmp_path)
    assert main(["exercise", "--lesson", "circle"]) == 0
    assert capsys.readouterr().out.startswith("circle       fit_circle ")
    assert main(["exercise", "fit_circle", "--lesson", "circle"]) == 0
    mine = tmp_path / "my_fit_circle.py"
    text = mine.read_text(encoding="utf-8")
    assert "workbench show circle --with my_fit_circle.py\n" in text
    assert "workbench check my_fit_circle.py --lesson circle\n" in text
    assert main(["check", str(mine), "--lesson", "circle", "--hidden"]) == 1
    wrong = (
        "x, y = p.mean(axis=0)\n    return np.array([x, y, np.linalg.norm(p - p.mean(axis=0),"
        " axis=1).mean()])"
    )
    mine.write_text(text.replace("raise NotImplementedError", wrong), encoding="utf-8")
    capsys.readouterr()
    assert main(["check", str(mine), "--lesson", "circle", "--hidden"]) == 1
    printed = capsys.readouterr().out
    assert "You took the mean of the points for the centre" in printed
    assert "my_fit_circle.rrd" in printed
    assert main(["show", "circle", "--with", str(mine)]) == 0
    watched[0].close()
    (tmp_path / "class").mkdir()
    mine.rename(tmp_path / "class" / "ada.py")
    assert main(["grade", "class", "--lesson", "circle", "--jobs=1"]) == 1
    result = json.loads(
        (tmp_path / "class" / "graded" / "students" / "ada.json").read_text(encoding="utf-8")
    )
    assert (result["error"], result["reports"][0]["mistake"]["name"]) == (None, "mean for centre")


def test_an_exercise_of_no_lesson_says_which_there_are(folder, capsys):
    assert main(["exercise", "fit_line", "--lesson", str(folder)]) == 2
    assert (
        capsys.readouterr().err
        == "workbench: no exercise is named 'fit_line'; did you mean fit_circle?\n"
    )


def test_what_a_folder_s_runs_depend_on_is_found(folder):
    names = {file.name for file in sources_of(load(folder))}
    assert {"lesson.py", "draw.py", "state.py", "page.md", "tracing.py", "spatial.py"} <= names
    assert len(exercises_of(load(folder))) == 1
