"""The command that hands out, which says in one line what it cannot do; and what grading needs,
which is numpy and scipy.
"""

import subprocess
import sys
import tomllib
from pathlib import Path

import pytest

from workbench.cli import main
from workbench.exercise.finding import exercises
from workbench.exercise.starter import sample
from workbench.handout.parcel import CARRIED, NEEDED

# the command --------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["out"], "which exercises?"),
        ([], "EXERCISE ... OUT is missing"),
        (["nothing", "out"], "no exercise is named 'nothing'"),
        (["match", "icp", "out"], "match is named twice"),
        (["match", "out", "--for", "moodle"], "--for moodle: there are gradescope"),
        (["match", "out", "--weight", "match"], "EXERCISE=POINTS"),
        (["match", "out", "--weight", "match=-1"], "points above 0"),
        (["match", "out", "--weight", "align_rigid=1"], "not handed out here"),
        (["match", "out", "--due", "tomorrow"], "--due tomorrow: a day or a moment"),
        (["match", "out", "--due", "2027-01-01T10:00+01:00"], "leave the time zone out"),
        (["match", "out", "--due", "2027-01-01", "--release", "2027-01-02"], "is not after"),
        (["match", "out", "--sandbox", "door"], "--sandbox door"),
        (["match", "full"], "is not empty"),
        (["match", "full/file"], "is no folder"),
    ],
)
def test_what_cannot_be_handed_out_is_one_line(tmp_path, monkeypatch, capsys, *, words, message):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "full").mkdir()
    (tmp_path / "full" / "file").write_text("mine")
    assert main(["handout", *words, *([] if "--for" in words else ["--for", "folder"])]) == 2
    error = capsys.readouterr().err
    assert message in error
    assert error.count("\n") == 1
    assert sorted(path.name for path in tmp_path.iterdir()) == ["full"]


# what grading needs -------------------------------------------------------------------------------

BLOCKED = """
import runpy, sys
ALLOWED = {"numpy", "scipy", "jaxtyping", "wadler_lindig", "workbench", "lessons"} | set(sys.stdlib_module_names)
class Here:
    def __init__(self, finder):
        self.finder = finder
    def find_spec(self, name, path=None, target=None):
        there = name.partition(".")[0] in ALLOWED or name.startswith("_sysconfigdata")
        return self.finder.find_spec(name, path, target) if there else None
    def __getattr__(self, name):
        return getattr(self.finder, name)
sys.meta_path[:] = map(Here, sys.meta_path)
sys.argv[:] = sys.argv[1:]
runpy.run_module(sys.argv[0], run_name="__main__", alter_sys=True)
"""  # noqa: E501


def test_what_grading_needs_is_written_down_once():
    pyproject = tomllib.loads((Path(__file__).parents[2] / "pyproject.toml").read_text())
    group = pyproject["dependency-groups"]["grade"]
    assert set(group) <= set(pyproject["project"]["dependencies"])
    assert [line.partition(">")[0] for line in group] == [*NEEDED, CARRIED[0]]


def blocked(*words: object) -> subprocess.CompletedProcess:
    command = [sys.executable, "-c", BLOCKED, *map(str, words)]
    return subprocess.run(command, capture_output=True, text=True, check=False)


def test_grading_needs_numpy_and_scipy_and_nothing_of_the_page_and_every_sample_is_right(tmp_path):
    for k, exercise in enumerate(exercises().values()):
        (tmp_path / "in" / f"student{k}").mkdir(parents=True)
        (tmp_path / "in" / f"student{k}" / f"my_{exercise.name}.py").write_text(sample(exercise))
    told = blocked("workbench", "grade", tmp_path / "in", "--jobs", 2)
    assert (told.returncode, told.stderr.count("Error")) == (0, 0), told.stderr
    (tmp_path / "my_match.py").write_text("def match(p_target, p_source):\n    return 1, 2\n")
    told = blocked("workbench", "check", tmp_path / "my_match.py", "--hidden")
    assert told.returncode == 1, told.stderr
