"""What is handed out for Gradescope, run as Gradescope runs it: below a folder laid out as its own,
and held to its documented files.
"""

import json
import os
import signal
import stat
import subprocess
import sys
import time
import zipfile
from pathlib import Path

import pytest

from tests.exercise.formats import GRADESCOPE
from tests.handout.services import (
    WRONG,
    bare_python,  # noqa: F401 (a fixture)
    conforms,
)
from workbench.exercise.finding import exercises
from workbench.handout.assignment import assigned, read
from workbench.handout.writing import files, lay_out_gradescope, run, write

HANGS = "def invert_rigid(T):\n    while True: pass\n"


@pytest.fixture(scope="module")
def gradescope(tmp_path_factory):
    out = tmp_path_factory.mktemp("gradescope")
    wanted = ["invert_rigid", "iterations_needed"]
    write(
        assigned(wanted, service="gradescope", weights=["invert_rigid=30"], due="2027-03-31"), out
    )
    return out


def scored(gradescope: Path, python: str, root: Path, *, submitted: dict[str, str] | Path) -> dict:
    """Return what a submission's results.json says; it is there, and is what Gradescope
    documents.
    """
    if not isinstance(submitted, Path):
        folder = root / "handed in"
        folder.mkdir()
        for name, text in submitted.items():
            (folder / name).write_text(text)
        submitted = folder
    root = lay_out_gradescope(root / "autograder", gradescope, submitted)
    report = run(root / "run_autograder", root, python)
    conforms(report, GRADESCOPE)
    assert sum(test["max_score"] for test in report["tests"]) == pytest.approx(43)
    return report


def test_the_zip_has_what_gradescope_asks_for_at_its_root(gradescope):
    with zipfile.ZipFile(gradescope / "autograder.zip") as archive:
        names = archive.namelist()
        modes = {
            entry.filename: stat.filemode(entry.external_attr >> 16) for entry in archive.infolist()
        }
        requirements = archive.read("requirements.txt").decode()
        assert archive.read("run_autograder").startswith(b"#!")
    assert any(name.endswith("workbench/LICENSES.txt") for name in names)
    assert modes["setup.sh"] == modes["run_autograder"] == "-rwxr-xr-x"
    assert [line.partition("==")[0] for line in requirements.splitlines()] == ["numpy", "scipy"]
    assert not [
        name for name in names if "viewer" in name or "lessons/icp" in name or name.startswith("/")
    ]
    again = files(read(assigned(["invert_rigid"], service="gradescope").text()))
    assert again == files(assigned(["invert_rigid"], service="gradescope"))


@pytest.mark.parametrize(("sample", "score"), [("full", 43), ("none", 0)])
def test_gradescope_gives_the_samples_what_they_deserve(
    gradescope, bare, tmp_path, *, sample, score
):
    report = scored(gradescope, bare, tmp_path, submitted=gradescope / "teacher" / sample)
    assert report["score"] == pytest.approx(score)
    hidden = [test for test in report["tests"] if test["visibility"] == "after_due_date"]
    checks = [c for n in ("invert_rigid", "iterations_needed") for c in exercises()[n].checks]
    assert len(hidden) == (sum(not c.public for c in checks) if sample == "full" else 0)
    if (
        sample == "none"
    ):  # that a function is not written yet is said once, and not by each of its checks
        assert [test["name"] for test in report["tests"]] == ["invert_rigid", "iterations_needed"]
        assert all(
            test["output"].endswith(f"{test['name']} is not written yet")
            for test in report["tests"]
        )


def test_gradescope_says_once_what_was_not_handed_in(gradescope, bare, tmp_path):
    right = (gradescope / "teacher" / "full" / "my_invert_rigid.py").read_text()
    report = scored(
        gradescope,
        bare,
        tmp_path,
        submitted={"my_invert_rigid.py": right, "notes.py": "x = 1", "b.txt": "x"},
    )
    assert json.dumps(report).count("iterations_needed: not handed in") == 1
    assert report["output"].splitlines() == [
        "iterations_needed: not handed in",
        "notes.py: defines no function invert_rigid or iterations_needed",
        "not read, since neither .py nor .ipynb: b.txt",
    ]
    missing = [test for test in report["tests"] if test["name"] == "iterations_needed"]
    assert [test["score"] for test in missing] == [0]
    assert (
        report["score"]
        == sum(test["max_score"] for test in report["tests"]) - missing[0]["max_score"]
    )


def test_gradescope_takes_a_file_of_any_name_and_says_what_is_missing(gradescope, bare, tmp_path):
    report = scored(gradescope, bare, tmp_path, submitted={"Homework 3 (final).PY": WRONG})
    assert 0 <= report["score"] < 30
    assert "seen (4, 4)" in report["output"]
    assert any(
        "iterations_needed" in test["name"] and test["score"] == 0 for test in report["tests"]
    )


@pytest.mark.parametrize(
    ("submitted", "message"),
    [
        ({"a.py": "def invert_rigid(T:\n"}, "a.py, line 1"),
        ({"a.py": "import os\nos._exit(0)\ndef invert_rigid(T): return T\n"}, "its process ended"),
        ({"notes.txt": "x"}, "no .py file"),
        ({"a.py": "x = 1", "b.py": "y = 1"}, "b.py: defines no function invert_rigid"),
    ],
)
def test_gradescope_has_results_for_what_cannot_be_graded(
    gradescope, bare, tmp_path, *, submitted, message
):
    report = scored(gradescope, bare, tmp_path, submitted=submitted)
    assert report["score"] == 0
    assert message in report["output"]


def test_gradescope_has_results_where_the_grader_is_ended(gradescope, bare, tmp_path):
    (tmp_path / "in").mkdir()
    (tmp_path / "in" / "a.py").write_text(HANGS)
    root = lay_out_gradescope(tmp_path / "autograder", gradescope, tmp_path / "in")
    running = subprocess.Popen(
        [root / "run_autograder", root],
        env=os.environ | {"GRADER_PYTHON": bare},
        start_new_session=True,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    )
    results = root / "results" / "results.json"
    end = time.monotonic() + 120
    while not (results.exists() and "ran out of time" in results.read_text()):
        assert time.monotonic() < end
        time.sleep(0.02)
    os.killpg(running.pid, signal.SIGKILL)
    running.wait()
    report = json.loads(results.read_text())
    conforms(report, GRADESCOPE)
    assert report["score"] == 0
    assert "ran out of time" in report["output"]


@pytest.mark.parametrize("broken", ["no Python", "no packages", "no sandbox"])
def test_gradescope_has_results_where_the_grader_breaks(gradescope, bare, tmp_path, *, broken):
    root = lay_out_gradescope(tmp_path, gradescope, gradescope / "teacher" / "full")
    if broken == "no packages":
        (root / "source" / "packages" / "workbench" / "errors.py").unlink()
    if broken == "no sandbox":
        settings = json.loads((root / "source" / "assignment.json").read_text())
        (root / "source" / "assignment.json").write_text(
            json.dumps(settings | {"sandbox": "landlock"})
        )
        walls = root / "source" / "packages" / "workbench" / "exercise" / "sandbox" / "isolation.py"
        walls.write_text(walls.read_text() + "\ndef _tried(wall): return 'not in this container'\n")
    report = run(
        root / "run_autograder", root, "/nowhere/python" if broken == "no Python" else bare
    )
    conforms(report, GRADESCOPE)
    assert report["score"] == 0
    assert "not about your code" in report["output"]
    assert ("not in this container" in report["output"]) == (broken == "no sandbox")


THIEF = """
import os
def invert_rigid(T):
    got = []
    for path in (os.path.join({root!r}, p) for p in ("results/results.json", "source/assignment.json", "submission/a.py")):
        for mode in ("rb", "r+b"):
            try: got.append(open(path, mode).read())
            except OSError: pass
    for act in (lambda: os.kill({pid}, 0), lambda: os.fork(), lambda: os.listdir({root!r}), lambda: os.setuid(0),
                lambda: __import__("socket").socket(), lambda: os.system("true") == 0 or 1 / 0):
        try: got.append(str(act()))
        except Exception: pass
    print("GOT", got)
    return T
"""  # noqa: E501


@pytest.mark.skipif(
    os.name != "posix" or os.geteuid() != 0, reason="another user is started by root"
)
def test_in_a_container_another_user_is_a_wall(tmp_path):
    write(assigned(["invert_rigid"], service="gradescope", sandbox="user"), tmp_path / "out")
    (tmp_path / "in").mkdir()
    text = THIEF.format(root=str(tmp_path / "autograder"), pid=os.getpid())
    (tmp_path / "in" / "a.py").write_text(text)
    root = lay_out_gradescope(tmp_path / "autograder", tmp_path / "out", tmp_path / "in")
    report = run(root / "run_autograder", root)
    assert "GOT []" in report["output"]
    assert "not safe" not in report["output"]


def test_the_image_is_set_up_with_a_python_that_is_new_enough(gradescope, tmp_path):
    root = lay_out_gradescope(tmp_path / "autograder", gradescope, gradescope / "teacher" / "none")
    commands = tmp_path / "commands"
    commands.mkdir()
    made = f'[ "$3" = venv ] && mkdir -p "$7/bin" && ln -s {sys.executable} "$7/bin/python"; true'
    for name, body in {"apt-get": "true", "python3": made}.items():
        (commands / name).write_text(f'#!/bin/sh\necho {name} "$@" >> {tmp_path}/log\n{body}\n')
        (commands / name).chmod(0o755)
    told = subprocess.run(
        ["bash", root / "source" / "setup.sh", root / "source", tmp_path / "place"],
        env=os.environ | {"PATH": f"{commands}:{os.environ['PATH']}"},
        capture_output=True,
        text=True,
        check=False,
    )
    assert told.returncode == 0, told.stderr
    log = (tmp_path / "log").read_text()
    assert f"--python {sys.version_info.major}.{sys.version_info.minor} {tmp_path}/place" in log
    assert f"-r {root}/source/requirements.txt" in log
    assert "Submissions are shut in by: " in told.stdout
