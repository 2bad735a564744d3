"""What a page's worker is told of a lesson that it computes: steps and scenes as a live page gets
them, a student's function with its ghost, reports in the words of `check`; and that nothing on
that path imports what a browser does not have.
"""

import json
import subprocess
import sys
from pathlib import Path

import pytest

from tests.wire.reading import Reader
from workbench.computed.runner import Runner, open_lesson
from workbench.errors import InputError
from workbench.exercise.grading import grade_function
from workbench.exercise.sandbox import SandboxedFunction
from workbench.exercise.submission import Submission
from workbench.lesson import catalog, find
from workbench.page.exercise import report_data

ROOT = Path(__file__).resolve().parents[2]
MISSING = (
    *("viser", "trimesh", "PIL", "pygments", "skimage", "rerun", "markdown_it", "mdit_py_plugins"),
    *("latex2mathml", "ziamath", "fontTools", "zstandard", "starlette", "uvicorn", "websockets"),
    *("pyarrow", "resource"),
)
"""What Pyodide does not have, or the page does not load."""
RIGHT = """
import numpy as np
def align_rigid(p_target, p_source):
    if len(p_target) < 3:
        raise ValueError
    print("called")
    a, b = p_target.mean(0), p_source.mean(0)
    U, _, Vt = np.linalg.svd((p_target - a).T @ (p_source - b))
    R = U @ np.diag([1, 1, np.linalg.det(U @ Vt)]) @ Vt
    T = np.eye(4)
    T[:3, :3], T[:3, 3] = R, a - R @ b
    return T
"""
TRANSPOSED = RIGHT.replace("] = R, a - R @ b", "] = R.T, a - R.T @ b")
RAISES = "def align_rigid(p_target, p_source):\n    return p_target[10**6]\n"
SHAPELESS = "def align_rigid(p_target, p_source):\n    p_source[:] = 0\n    return p_target\n"
CHEATS = "def align_rigid(a, b):\n    import workbench.geometry.motions\n    return b\n"
OBJECT = "def align_rigid(a, b):\n    return object()\n"
STARTER = "def align_rigid(a, b):\n    raise NotImplementedError\n"
NO_PYTHON = "def align_rigid(a, b:\n    return b\n"
NO_FUNCTION = "x = 1\n"
FAILS_AT_ONCE = "import nothing_of_that_name\n"
TEXTS = {
    name: text
    for name, text in globals().items()
    if name.isupper() and isinstance(text, str) and ("\n" in text)
}


def finished(runner: Runner) -> Runner:
    while runner.more(1000.0):
        pass
    return runner


def test_every_lesson_runs_without_what_a_browser_does_not_have():
    code = f"""
import json, sys
for name in {MISSING!r}:
    sys.modules[name] = None
from workbench.computed.runner import open_lesson
for name in {list(catalog())!r}:
    runner = open_lesson(name)
    while runner.more(1000.0):
        pass
    told = runner.told()
    assert told["stopped"] is None, (name, told["stopped"])
    for k in {{0, len(runner.timeline) // 2, len(runner.timeline) - 1}}:
        head, scene = runner.step(k)
        json.dumps([told, head], allow_nan=False)
        assert len(scene) > 8, name
"""
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, cwd=ROOT)
    assert done.returncode == 0, done.stderr[-3000:]


def test_a_run_is_told_as_a_live_page_is_told_and_nothing_twice():
    runner = open_lesson("icp")
    reader = Reader()
    begun = runner.run({"start_angle": 120.0})
    assert begun["params"]["start_angle"] == 120.0
    assert runner.more(0.0), "one step at least, and there are more"
    first = runner.told()
    assert first is not None
    assert (first["known"], first["finished"], first["from"]) == (1, False, 0)
    assert runner.told() is None
    finished(runner)
    rest = runner.told()
    assert rest is not None
    assert (rest["finished"], rest["from"], rest["stopped"]) == (True, 1, None)
    assert len(rest["series"][0]["values"]) == rest["known"] - 1
    heads = [runner.step(k) for k in range(rest["known"])]
    things = [set(head["things"]) for head, _ in heads]
    assert sum(map(len, things)) == len(set.union(*things))
    for k, (head, scene) in enumerate(heads):
        told = reader.read(scene)
        assert (head["k"], told["k"], told["run"]) == (k, k, begun["run"])
        assert reader.nodes(told["nodes"])
        json.dumps(head, allow_nan=False)
    again = reader.read(runner.step(0)[1])
    assert (again["arrays"], again["kinds"]) == ([], {})


def test_what_cannot_be_used_changes_nothing():
    runner = open_lesson("icp")
    timeline = runner.timeline
    for params in ({"no_such": 1}, {"start_angle": "far"}, {"target": "/etc/passwd"}):
        with pytest.raises(InputError):
            runner.run(params)
    assert runner.timeline is timeline
    assert runner.run({"start_angle": 1e9})["params"]["start_angle"] == 180.0


def test_a_click_sets_what_it_picks():
    runner = finished(open_lesson("pose"))
    assert runner.click(0, [0.0, 0.0, 99.0], [0.0, 0.0, 1.0]) == {}


@pytest.mark.parametrize("name", TEXTS)
def test_a_students_text_is_judged_in_the_words_of_check(name):
    lesson = find("icp")
    runner = Runner(lesson)
    text = TEXTS[name]
    mine = runner.judge("align_rigid", text)
    task = runner._exercise("align_rigid")
    given = Submission("my_align_rigid.py", text)
    try:
        with SandboxedFunction(given, "align_rigid") as student:
            report = grade_function(student, task, hidden=False, file=given.file)
            theirs = report_data(report)
    except InputError as error:
        theirs = report_data(str(error))
    if name == "NO_PYTHON":  # the sandbox was handed the text unread
        assert mine["said"].startswith("my_align_rigid.py, line 1: ")
        return
    assert mine == theirs


def test_what_is_forbidden_is_refused():
    text = "import numpy as np\nfrom scipy.spatial import cKDTree\n"
    text += "def match(a, b):\n    return cKDTree(a).query(b)[1]\n"
    report = open_lesson("icp").judge("match", text)
    assert {check["points"][0] for check in report["checks"]} == {"0"}
    assert "uses scipy.spatial, which is forbidden" in report["checks"][0]["message"]


def test_a_students_function_drives_the_lesson_with_ours_as_its_ghost():
    runner = open_lesson("icp")
    used = runner.use("align_rigid", TRANSPOSED)
    assert used["trouble"] == ""
    assert used["source"]["name"] == "my_align_rigid.py"
    assert "det" in used["source"]["html"]
    runner.run({})
    told = finished(runner).told()
    assert told is not None
    assert told["called"] is True
    assert told["mark"] is not None
    reader = Reader()
    nodes = reader.nodes(reader.read(runner.step(told["mark"])[1])["nodes"])
    assert any("ghost" in name for name in nodes), list(nodes)
    for wrong in (NO_PYTHON, NO_FUNCTION, FAILS_AT_ONCE):
        assert runner.use("align_rigid", wrong)["trouble"]
    runner.run({})
    told = finished(runner).told()
    assert told is not None
    assert told["mark"] is not None, "what cannot be used leaves the one before"
    runner.use("align_rigid", "")
    runner.run({})
    told = finished(runner).told()
    assert told is not None
    assert (told["mark"], told["called"]) == (None, None)


def test_a_right_function_never_parts_from_ours():
    runner = open_lesson("icp")
    runner.use("align_rigid", RIGHT)
    runner.run({})
    told = finished(runner).told()
    assert told is not None
    assert (told["mark"], told["called"]) == (None, True)


def test_an_exercise_that_is_not_there_is_refused():
    with pytest.raises(InputError, match="has no exercise"):
        open_lesson("icp").judge("no_such", RIGHT)
