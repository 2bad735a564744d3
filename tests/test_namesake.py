"""Another distribution with a package `workbench` is told of at the start."""

import pytest

from workbench.cli import main
from workbench.machinery.namesake import namesakes


@pytest.fixture
def installed(tmp_path):
    """A folder of packages, where distributions are put by name and the files they bring."""

    def put(name: str, *files: str):
        folder = tmp_path / f"{name}.dist-info"
        folder.mkdir()
        lines = [f"{file},sha256=abc,1" for file in files]
        (folder / "RECORD").write_bytes("\r\n".join([*lines, ""]).encode())
        return tmp_path

    return put


def test_one_with_our_package_is_named_and_others_are_not(installed):
    installed("geometry_workbench-0.1.0", "workbench/__init__.py")
    installed("benches-2", "benches/workbench/__init__.py", "workbench/other.py")
    folder = installed("workbench-0.8.506", "workbench/__init__.py", "workbench/bench.py")
    assert namesakes([str(folder)]) == ["workbench-0.8.506"]
    assert namesakes([str(folder / "none")]) == []


def test_where_it_is_alone_or_cannot_be_read_nothing_is_said(installed, tmp_path):
    installed("geometry_workbench-0.1.0", "workbench/__init__.py")
    (tmp_path / "broken-1.dist-info" / "RECORD").mkdir(parents=True)
    assert namesakes([str(tmp_path)]) == []


def test_the_start_says_it_in_one_line(capsys, monkeypatch, installed):
    monkeypatch.setattr("workbench.viewer.serving.serve", lambda *_, **__: None)
    monkeypatch.syspath_prepend(installed("workbench-0.8.506", "workbench/__init__.py"))
    for words in ([], ["show", "icp"]):
        assert main(words) == 0
        line = capsys.readouterr().err
        assert line.startswith("workbench: workbench-0.8.506 is installed here too")
        assert line.count("\n") == 1
