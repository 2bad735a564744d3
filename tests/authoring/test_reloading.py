"""A lesson that is edited: every save of one of its files is a new lesson, a broken one keeps the
lesson before.
"""

import os
import shutil
from dataclasses import replace
from pathlib import Path

import pytest

from workbench.authoring.reloading import Edited, carried
from workbench.errors import InputError
from workbench.exercise.finding import exercises_of
from workbench.exercise.starter import write_starter
from workbench.exercise.watching import WatchedFile
from workbench.run.loading import load
from workbench.run.timeline import Timeline

CIRCLE = Path(__file__).resolve().parents[1] / "authors" / "circle"


@pytest.fixture
def edited(tmp_path) -> Edited:
    folder = Path(
        shutil.copytree(CIRCLE, tmp_path / "circle", ignore=shutil.ignore_patterns("__pycache__"))
    )
    return Edited(folder, load(folder))


def save(edited: Edited, file: str, old: str, *, new: str) -> None:
    path = edited.path / file
    text = path.read_text(encoding="utf-8")
    stamp = path.stat()
    assert old in text
    path.write_text(text.replace(old, new), encoding="utf-8")
    # later by the least that there is
    os.utime(path, ns=(stamp.st_atime_ns, stamp.st_mtime_ns + 1))


@pytest.mark.parametrize(
    ("file", "old", "new"),
    [
        ("lesson.py", "through points", "THROUGH POINTS"),
        ("draw.py", "The algebraic", "THE ALGEBRAIC"),
        ("page.md", "# A circle", "# A CIRCLE"),
        ("exercises/fit_circle.py", "Write the", "WRITE THE"),
    ],
)
def test_a_save_of_any_of_its_files_is_a_new_lesson(edited, file, old, *, new):
    before = edited.lesson
    assert not edited.changed()
    save(edited, file, old, new=new)
    assert edited.changed()
    assert edited.trouble is None
    assert edited.lesson is not before
    assert not edited.changed()


def test_files_that_are_new_or_go_away_count_and_others_do_not(edited):
    (edited.path / "circle.rrd").write_bytes(b"a recording beside it")
    (edited.path / ".draw.py.swp").write_bytes(b"an editor's")
    assert not edited.changed()
    (edited.path / "captions.py").write_text("WORDS = ()")
    assert edited.changed()
    (edited.path / "captions.py").unlink()
    assert edited.changed()


@pytest.mark.parametrize(
    ("file", "old", "new", "message"),
    [
        ("draw.py", "def draw", "def (draw", "circle/draw.py, line 10: SyntaxError"),
        ("draw.py", "state.k else", "state.key else", "circle/draw.py, line 13: AttributeError"),
        ("lesson.py", 'name="circle"', 'name="icp"', "its name 'icp' is taken by lesson icp"),
        (
            "state.py",
            "5, 200)",
            "9, 5)",
            "Params.points: a number needs a knob with low < high",
        ),
        ("lesson.py", '"page.md"', '"no.md"', "no.md: No such file"),
    ],
)
def test_a_broken_save_keeps_the_lesson_and_says_where_until_it_is_mended(
    edited, file, old, *, new, message
):
    before = edited.lesson
    save(edited, file, old, new=new)
    assert edited.changed()
    assert edited.lesson is before
    assert message in str(edited.trouble)
    assert Timeline(before, before.params()).extend()
    save(edited, file, new, new=old)
    assert edited.changed()
    assert edited.trouble is None
    assert edited.lesson is not before


def test_a_file_is_followed_with_its_page(tmp_path):
    (tmp_path / "page.md").write_text("# One")
    file = tmp_path / "mine.py"
    source = (
        "from pathlib import Path\nfrom dataclasses import replace\nfrom tests.fake import lesson"
        " as other\n"
    )
    file.write_text(
        source + 'lesson = replace(other, name="mine", page=Path(__file__).with_name("page.md"))\n'
    )
    edited = Edited(file, load(file))
    (tmp_path / "other.py").write_text("x = 1")
    assert not edited.changed()
    (tmp_path / "page.md").write_text("# Two or more")
    assert edited.changed()
    assert edited.lesson.text() == "# Two or more"


def test_params_are_carried_over_as_far_as_they_go(edited):
    before = replace(edited.lesson.params(), points=150, arc=60.0, noise=0.05, seed=7)
    save(edited, "state.py", "5, 200)", new="5, 100)")
    save(edited, "state.py", "noise: Annotated[float", new="sigma: Annotated[float")
    save(edited, "lesson.py", "params.noise", new="params.sigma")
    save(edited, "presets.py", "noise=0", new="sigma=0")
    assert edited.changed()
    assert edited.trouble is None
    after = carried(before, edited.lesson)
    assert type(after) is edited.lesson.params
    assert (after.points, after.arc, after.sigma, after.seed) == (100, 60.0, 0.03, 7)


def test_a_student_s_file_drives_the_edited_lesson_too(edited, tmp_path):
    (exercise,) = exercises_of(edited.lesson)
    mine = write_starter(exercise, tmp_path)
    text = mine.read_text(encoding="utf-8").replace(
        "raise NotImplementedError", "return np.array([0.4, 0.3, 1.0])"
    )
    mine.write_text(text, encoding="utf-8")
    watched = WatchedFile(edited.lesson, mine)
    try:
        save(edited, "draw.py", "The algebraic fit", new="THE FIT")
        assert edited.changed()
        watched.follow(edited.lesson)
        timeline = Timeline(watched.lesson, watched.lesson.params())
        timeline.extend()
        assert "THE FIT of 40 points gives radius 1.000 m" in timeline[0].caption.text
        save(edited, "lesson.py", "fit_circle: Callable", new="fit: Callable")
        save(edited, "lesson.py", "refine(p, fit_circle(p))", new="refine(p, fit(p))")
        assert edited.changed()
        with pytest.raises(
            InputError, match="run of lesson circle has no keyword 'fit_circle'; it has: fit"
        ):
            watched.follow(edited.lesson)
        assert watched.lesson.name == "circle"
    finally:
        watched.close()
