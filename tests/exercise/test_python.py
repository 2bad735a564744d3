"""What a student's process sees of this machine: the folders that its Python needs, once each."""

import os
import sys
from pathlib import Path

from workbench.exercise.sandbox import SandboxedFunction, isolation, python


def inside(path: str, tree: str) -> bool:
    return Path(tree) in (Path(path), *Path(path).parents)


def test_each_folder_is_bound_once_and_python_s_own_library_is_among_them():
    trees = python.here().trees
    system = (python._libraries(path) for path in python.SYSTEM if not os.path.islink(path))
    for path in (os.path.realpath(os.__file__), *filter(os.path.isdir, system)):
        assert any(inside(path, tree) for tree in trees)
    for tree in trees:
        assert not any(inside(tree, other) for other in trees if other != tree)


def test_of_a_system_s_libraries_only_those_of_its_machine_are_seen(tmp_path, monkeypatch):
    monkeypatch.setattr(sys.implementation, "_multiarch", "some-linux-gnu", raising=False)
    assert python._libraries(str(tmp_path)) == str(tmp_path)
    (tmp_path / "some-linux-gnu").mkdir()
    assert python._libraries(str(tmp_path)) == str(tmp_path / "some-linux-gnu")
    monkeypatch.delattr(sys.implementation, "_multiarch")
    assert python._libraries(str(tmp_path)).rstrip("/") == str(tmp_path)


def test_where_no_wall_stands_that_is_told_with_the_reasons(monkeypatch):
    monkeypatch.setattr(isolation, "_without", lambda name: f"no {name} here")
    wall = isolation.best.__wrapped__()
    assert not wall.holds
    assert wall.why.count(" here; no ") == 1


def test_a_function_does_not_see_how_its_process_was_started(tmp_path):
    given = tmp_path / "given.py"
    given.write_text("import sys\n\ndef f():\n    return len(sys.argv)\n")
    with SandboxedFunction(given, "f") as student:
        assert student() == 1
