"""What a published run depends on: all that it reaches, and nothing else."""

import importlib
import sys
from pathlib import Path

import pytest

from workbench.lesson import catalog
from workbench.publish.sources import sources_digest, sources_of

ROOT = Path(__file__).resolve().parents[2]
LESSON = """
from dataclasses import dataclass
from pathlib import Path
from workbench.lesson import Lesson
from tiny_course import {uses}

@dataclass(frozen=True)
class Params:
    pass

def run(params):
    from tiny_course.{name}.late import helper
    yield helper()

def draw(state):
    return {{}}

lesson = Lesson(name="{name}", title="T", summary="S", page=Path(__file__).with_name("page.md"), params=Params, run=run,
                draw=draw, order=1)
"""  # noqa: E501


@pytest.fixture
def course(tmp_path, monkeypatch):
    """A package of two lessons, each with a module that only it uses, and one that both use through
    another.
    """
    root = tmp_path / "tiny_course"
    for name, uses in (("a", "for_a"), ("b", "for_b")):
        folder = root / name
        folder.mkdir(parents=True)
        (folder / "__init__.py").touch()
        (folder / "lesson.py").write_text(LESSON.format(name=name, uses=uses))
        (folder / "late.py").write_text("def helper(): pass")
        (folder / "page.md").write_text("# Page")
        (root / f"{uses}.py").write_text("from . import both")
    for name in ("__init__", "both", "nobody"):
        (root / f"{name}.py").touch()
    monkeypatch.syspath_prepend(tmp_path)
    yield root, [importlib.import_module(f"tiny_course.{name}.lesson").lesson for name in "ab"]
    for name in [name for name in sys.modules if name.startswith("tiny_course")]:
        del sys.modules[name]


@pytest.mark.parametrize(
    ("file", "changed"),
    [
        ("a/lesson.py", "a"),
        ("a/late.py", "a"),
        ("a/page.md", "a"),
        ("for_a.py", "a"),
        ("b/late.py", "b"),
        ("for_b.py", "b"),
        ("both.py", "ab"),
        ("__init__.py", "ab"),
        ("nobody.py", ""),
    ],
)
def test_a_change_counts_for_those_lessons_that_reach_it(course, file, changed):
    root, lessons = course
    before = [sources_digest(lesson) for lesson in lessons]
    (root / file).write_text((root / file).read_text() + "\n# changed\n")
    after = [sources_digest(lesson) for lesson in lessons]
    assert [x != y for x, y in zip(before, after, strict=True)] == ["a" in changed, "b" in changed]


def test_new_data_in_a_lessons_folder_counts(course):
    root, (lesson, _) = course
    before = sources_digest(lesson)
    (root / "a" / "scan.ply").write_text("ply")
    assert sources_digest(lesson) != before


DRAWS = ("draw.py", "drawing.py", "flat.py", "space.py")  # where lessons draw


@pytest.mark.parametrize("name", catalog())
def test_a_lesson_depends_on_what_runs_draws_records_and_renders_it(name):
    files = {str(file.relative_to(ROOT)) for file in sources_of(catalog()[name])}
    assert {
        f"lessons/{name}/page.md",
        f"lessons/{name}/lesson.py",
        *(f"lessons/{name}/{part}" for part in DRAWS if (ROOT / f"lessons/{name}/{part}").exists()),
        "workbench/run/timeline.py",
        "workbench/recording/sink.py",
        "workbench/recording/write.py",
        "workbench/wire/primitives.py",
        "workbench/wire/packing.py",
    } <= files
    others = tuple(f"lessons/{other}/" for other in catalog() if other != name)
    beside = (
        "workbench/cli.py",
        "workbench/commands/",
        "workbench/exercise/",
        "workbench/viewer/server.py",
        "workbench/publish/site.py",
    )
    assert not [file for file in files if file.startswith((*others, *beside))]


def test_a_lesson_depends_on_its_own_algorithms_only():
    icp, ransac = (
        {file.name for file in sources_of(catalog()[name])} for name in ("icp", "ransac")
    )
    assert "semiglobal.py" not in icp | ransac
    assert {"icp.py"} <= icp - ransac
    assert {"samplers.py", "scores.py"} <= ransac - icp
