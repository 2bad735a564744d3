"""What solves a task in one call may be forbidden: who uses it is told so in one line, and earns
nothing there.
"""

import ast
from dataclasses import replace
from pathlib import Path

import pytest

from tests.exercise.centroid import EXERCISE
from workbench.cli import main
from workbench.exercise import finding
from workbench.exercise.finding import exercises
from workbench.exercise.forbidden import forbidden_use
from workbench.exercise.grading import grade_file
from workbench.exercise.marking import Asked, grade_student
from workbench.exercise.reading import Reader
from workbench.exercise.reports import terminal
from workbench.exercise.sandbox import Wall
from workbench.exercise.starter import starter
from workbench.exercise.submission import Submission, submission
from workbench.exercise.submissions import HandIn

REFUSED = Path(__file__).with_name("refused.py")
STRICT = replace(
    EXERCISE, contract=replace(EXERCISE.contract, forbid=("scipy.spatial", "numpy.average"))
)
ANSWER = "def centroid(p):\n    return {}\n"
USES = {
    "import scipy.spatial": ANSWER.format("p.mean(0)"),  # imported is used
    "import scipy.spatial.distance as d": ANSWER.format("d.cdist(p, p)[0]"),
    "import scipy": ANSWER.format("scipy.spatial.distance.cdist(p, p)[0]"),
    "import scipy as sp": ANSWER.format("sp.spatial.KDTree(p)"),
    "from scipy import spatial": ANSWER.format("spatial.KDTree(p)"),
    "from scipy import spatial as s": ANSWER.format("s.KDTree(p)"),
    "from scipy.spatial import *": ANSWER.format("KDTree(p)"),
    "from scipy.spatial.transform import Rotation": ANSWER.format("Rotation.identity()"),
    "import scipy; near = scipy.spatial": ANSWER.format("near.KDTree(p)"),
    "import importlib": ANSWER.format("importlib.import_module('scipy.spatial').KDTree(p)"),
    "from importlib import import_module as get": ANSWER.format("get('scipy.spatial')"),
    "import importlib as i": ANSWER.format("i.import_module('sci' + 'py.' + 'spatial')"),
    "import scipy # ": ANSWER.format("getattr(scipy, 'spatial').KDTree(p)"),
    "# nothing": ANSWER.format("__import__('scipy.spatial')"),
    "import numpy as np": ANSWER.format("np.average(p, axis=0)"),
    "from numpy import average": ANSWER.format("average(p, axis=0)"),
    "import scipy.spatial as s\ndef helper(p): return s.KDTree(p)": ANSWER.format("helper(p)"),
    "try:\n    import scipy.spatial\nexcept ImportError: pass": ANSWER.format("p.mean(0)"),
}
ALLOWED = {
    "import numpy as np": "np.mean(p, axis=0)",
    "import scipy.sparse, scipy.linalg": "p.mean(0) + 0 * scipy.linalg.norm(p)",
    # which import scipy.spatial themselves
    "from scipy import stats, interpolate, optimize": "stats.trim_mean(p, 0.0)",
    "spatial = 1": "p.mean(0) * spatial",
    "import scipy.spatial as s\ndef another_exercise(p): return s.KDTree(p)": "p.mean(0)",
    "from scipy.spatial import KDTree\nclass Unused:\n    tree = KDTree": "p.mean(0)",
}


def read(text: str, modules: dict[str, str] | None = None) -> Submission:
    with Reader() as reader:
        beside = (modules or {}).get
        return submission(
            "my_centroid.py",
            text.encode(),
            lambda file: (beside(file) or "").encode() or None,
            reader=reader,
        )


@pytest.mark.parametrize("head", USES)
def test_what_is_forbidden_is_seen_however_it_is_named(head):
    message = forbidden_use(read(f"{head}\n{USES[head]}"), STRICT)
    assert message.startswith("my_centroid.py, line ")
    assert "is forbidden for centroid" in message
    assert "\n" not in message
    assert not forbidden_use(read(f"{head}\n{USES[head]}"), EXERCISE)


@pytest.mark.parametrize("head", ALLOWED)
def test_what_is_allowed_earns_full_marks_whatever_it_imports_itself(head):
    report = grade_file(read(f"{head}\n{ANSWER.format(ALLOWED[head])}"), STRICT)
    assert report.is_full, terminal(report)


def test_a_module_beside_the_file_is_read_too():
    modules = {"helper.py": "import numpy\nfrom scipy import spatial\n"}
    message = forbidden_use(read("import helper\n" + ANSWER.format("p.mean(0)"), modules), STRICT)
    assert message.startswith("helper.py, line 2: uses scipy.spatial")


def test_nothing_of_such_a_file_is_run_and_it_earns_nothing():
    text = "import scipy.spatial\nprint('ran')\n" + ANSWER.format("p.mean(0)")
    wall = Wall("none")
    report = grade_file(read(text), STRICT, wall=wall, seed=3)
    assert report.points == 0
    assert report.possible == EXERCISE.points
    assert (report.wall, report.seed) == (wall, 3)
    assert report.is_refused
    assert report.printed == ""
    assert report.said_once.startswith("my_centroid.py, line 1: uses scipy.spatial")


def test_only_the_exercise_that_forbids_it_is_refused():
    """A file with two exercises; its tree is for the one that may have it."""
    text = (
        "import numpy as np\nfrom scipy.spatial import cKDTree\n\ndef one_sided(p_a, p_b):\n    if"
        " not len(p_a) or not len(p_b):\n        raise ValueError\n    return"
        " float((cKDTree(p_b).query(p_a)[0] ** 2).mean())\n\ndef match(p_target, p_source):\n    if"
        " not len(p_target):\n        raise ValueError\n    return np.array([((p_target - p) **"
        " 2).sum(1).argmin() for p in p_source], dtype=int)\n"
    )
    for name in ("match", "one_sided"):
        report = grade_file(read(text), exercises()[name])
        assert report.is_full, terminal(report)
    report = grade_file(
        read(text.replace("def match", "def tree(p): return cKDTree(p)\n\ndef match")),
        exercises()["match"],
    )
    assert report.is_full  # a function that match does not call
    used = text.replace("return np.array([", "cKDTree(p_target); return np.array([")
    assert grade_file(read(used), exercises()["match"]).points == 0


HANDED = [
    node.name
    for node in ast.parse(REFUSED.read_text(encoding="utf-8")).body
    if isinstance(node, ast.FunctionDef) and "__" in node.name
]


@pytest.mark.parametrize("name", HANDED)
def test_right_answers_by_one_call_are_refused(name):
    exercise = exercises()[name.partition("__")[0]]
    report = grade_file(
        read(f"{REFUSED.read_text(encoding='utf-8')}\n\n{exercise.name} = {name}\n"), exercise
    )
    assert report.points == 0, terminal(report)
    assert f"is forbidden for {exercise.name}" in report.said_once


def test_every_exercise_that_forbids_something_says_so_in_its_starter():
    strict = [exercise for exercise in exercises().values() if exercise.contract.forbid]
    assert {"laplacian", "shortest_distances", "mahalanobis", "align_rigid"} <= {
        exercise.name for exercise in strict
    }
    for exercise in exercises().values():
        text = " ".join(starter(exercise).split())
        sentence = f"It may not use {' or '.join(exercise.contract.forbid)}, which solves the task"
        assert (sentence in text) == bool(exercise.contract.forbid)


def test_a_class_and_a_terminal_are_told_in_one_line(tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(finding, "exercises", lambda: {"centroid": STRICT})
    text = "import scipy.spatial\n" + ANSWER.format("p.mean(0)")
    result = grade_student(HandIn("ada", {"my_centroid.py": text.encode()}), Asked())
    (report,) = result["reports"]
    assert {check["kind"] for check in report["checks"]} == {"forbidden"}
    (tmp_path / "my_centroid.py").write_text(text)
    assert main(["check", str(tmp_path / "my_centroid.py"), "-o", str(tmp_path / "out")]) == 1
    printed = capsys.readouterr().out
    assert printed.count("is forbidden for centroid") == 1
    assert not list(tmp_path.glob("*.rrd"))
    assert main(["grade", str(tmp_path), "--jobs", "1"]) == 1
    assert "is forbidden for centroid" in (tmp_path / "graded" / "class.csv").read_text()
