"""The archive for a page's worker: it stands alone, is the same whenever it is made, and gives no
hidden check away.
"""

import ast
import json
import subprocess
import sys
import zipfile
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from workbench.computed import archive
from workbench.data.files import shipped_array, shipped_image
from workbench.errors import InputError
from workbench.exercise.finding import exercises_of
from workbench.exercise.starter import starter
from workbench.lesson import course, find


@pytest.fixture(scope="module")
def core(tmp_path_factory) -> Path:
    path = tmp_path_factory.mktemp("archive") / "core.zip"
    path.write_bytes(archive.packed(course().values()))
    return path


def test_no_hidden_check_is_in_it(core):
    hidden = {
        f"lessons/{lesson.name}/exercises/{exercise.name}.py {check.name}"
        for lesson in course().values()
        for exercise in exercises_of(lesson)
        for check in exercise.checks
        if not check.public
    }
    assert len(hidden) > 100
    with zipfile.ZipFile(core) as packed:
        for name in packed.namelist():
            assert "/hidden/" not in name
            if name.startswith("lessons/") and name.endswith(".py"):
                tree = ast.parse(packed.read(name))
                checks = [
                    node
                    for node in ast.walk(tree)
                    if isinstance(node, ast.FunctionDef)
                    and any("check(" in ast.unparse(decorator) for decorator in node.decorator_list)
                ]
                assert not {f"{name} {node.name}" for node in checks} & hidden
                assert "public=False" not in packed.read(name).decode(), name


def test_it_tells_of_every_exercise_that_is_in_it(core):
    with zipfile.ZipFile(core) as packed:
        told = json.loads(packed.read("workbench/computed/exercises.json"))
        names = packed.namelist()
    for lesson in course().values():
        wanted = list(exercises_of(lesson))
        assert [entry["name"] for entry in told[lesson.name]] == [task.name for task in wanted]
        for entry, exercise in zip(told[lesson.name], wanted, strict=True):
            assert entry["starter"] == starter(exercise)
            assert bool(entry["preset"]) == bool(entry["title"])
            assert f"lessons/{lesson.name}/exercises/{exercise.name}.py" in names


def test_the_same_lessons_give_the_same_bytes():
    assert archive.packed([find("pairs")]) == archive.packed([find("pairs")])


def test_it_computes_from_its_own_files_alone(core, tmp_path):
    with zipfile.ZipFile(core) as packed:
        packed.extractall(tmp_path)
    code = f"""
import sys
sys.path[:] = [{str(tmp_path)!r}, *(path for path in sys.path if path)]
sys.modules["skimage"] = sys.modules["PIL"] = None
import jaxtyping, workbench
from workbench.computed.runner import open_lesson
assert all(module.__file__.startswith({str(tmp_path)!r}) for module in (jaxtyping, workbench))
runner = open_lesson("features")
print([one["name"] for one in runner.about()["exercises"]])
for values in ({{"part": "pictures", "describe": "SIFT", "turn": 30.0}}, {{"part": "outlines"}}):
    runner.run(values)
    while runner.more(1000.0):
        pass
    assert runner.timeline.stopped is None, runner.timeline.stopped
runner.run({{"part": "pictures", "describe": "SIFT", "turn": 31.0}})
while runner.more(1000.0):
    pass
print(runner.timeline.stopped)
"""
    done = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, cwd=tmp_path
    )
    assert done.returncode == 0, done.stderr[-2000:]
    lines = done.stdout.splitlines()
    assert lines[0] == str([exercise.name for exercise in exercises_of(find("features"))])
    assert "cannot be found in a browser" in lines[1]


def test_stored_pictures_are_the_samples(core, tmp_path, monkeypatch):
    wanted = {name: shipped_image(name) for name in archive.samples.PICTURES}
    numbers = shipped_array("motorcycle_disp.npz")
    with zipfile.ZipFile(core) as packed:
        for name in packed.namelist():
            if name.startswith("workbench/data/files/stored/"):
                (tmp_path / Path(name).name).write_bytes(packed.read(name))
    monkeypatch.setattr(archive.samples, "STORED", tmp_path)
    for name, image in wanted.items():
        np.testing.assert_array_equal(shipped_image(name), image)
    np.testing.assert_array_equal(shipped_array("motorcycle_disp.npz"), numbers)


def test_a_lesson_that_is_none_of_the_course_is_refused():
    with pytest.raises(InputError, match="none of the course"):
        archive.packed([replace(find("pairs"), title="Another")])
