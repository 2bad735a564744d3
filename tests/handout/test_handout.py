"""What is handed out, run as the services run it: below a folder laid out as theirs, and held to
their documented files.
"""

import base64
import io
import json
import os
import signal
import stat
import subprocess
import sys
import time
import tomllib
import zipfile
from pathlib import Path

import numpy
import PIL
import pytest
import scipy
from PIL import Image

from tests.exercise.formats import ASSESSMENT, GRADESCOPE, PRAIRIELEARN, QUESTION
from workbench.cli import main
from workbench.exercise.finding import exercises
from workbench.exercise.starter import sample
from workbench.handout.assignment import assigned, read
from workbench.handout.parcel import CARRIED, NEEDED
from workbench.handout.writing import files, lay_out_gradescope, lay_out_prairielearn, run, write

WRONG = "def invert_rigid(T):\n    print('seen', T.shape)\n    return T.T\n"
HANGS = "def invert_rigid(T):\n    while True: pass\n"


def conforms(document: object, schema: dict) -> None:
    """Hold a document to its schema."""
    import jsonschema  # takes seconds, which every worker would spend

    jsonschema.validate(document, schema)


@pytest.fixture(scope="module")
def bare(tmp_path_factory) -> str:
    """Return a Python that has what a service installs, numpy and scipy, and Pillow, and nothing
    else.
    """
    folder = tmp_path_factory.mktemp("bare")
    for package in (numpy, scipy, PIL):
        place = Path(package.__path__[0])
        for name in (place.name, f"{place.name.lower().replace('pil', 'pillow')}.libs"):
            if (place.parent / name).exists():
                (folder / name).symlink_to(place.parent / name)
    script = folder / "python"
    script.write_text(
        f'#!/bin/sh\nPYTHONPATH="$PYTHONPATH:{folder}" exec {os.path.realpath(sys.executable)} -S'
        ' "$@"\n'
    )
    script.chmod(0o755)
    return str(script)


# gradescope ---------------------------------------------------------------------------------------


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
    results, end = root / "results" / "results.json", time.monotonic() + 120
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


# prairielearn -------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def prairielearn(tmp_path_factory):
    out = tmp_path_factory.mktemp("prairielearn")
    dates = {"release": "2027-03-01", "due": "2027-03-31T18:00"}
    write(
        assigned(["invert_rigid", "match"], service="prairielearn", weights=["match=5"], **dates),
        out,
    )
    return out


def submitted(
    prairielearn: Path, python: str, folder: Path, *, text: str, exercise: str = "invert_rigid"
) -> dict:
    """Return what a submission's results.json says; it is there, and is what PrairieLearn
    documents.
    """
    (folder / "mine.py").write_text(text)
    root = lay_out_prairielearn(folder / "grade", prairielearn, exercise, file=folder / "mine.py")
    report = run(root / "serverFilesCourse" / "geometry-workbench" / "run.sh", root, python)
    conforms(report, PRAIRIELEARN)
    assert (root / "results" / "results.json").stat().st_size < 1_000_000
    return report


def test_a_question_is_what_prairielearn_documents(prairielearn):
    for name in ("invert_rigid", "match"):
        folder = prairielearn / "questions" / "geometry-workbench" / name
        info = json.loads((folder / "info.json").read_text())
        conforms(info, QUESTION)
        grader = info["externalGradingOptions"]
        entry = prairielearn / grader["entrypoint"].removeprefix("/grade/")
        assert entry.stat().st_mode & stat.S_IXUSR
        assert (
            entry.relative_to(prairielearn / "serverFilesCourse").parts[0] + "/"
            in grader["serverFilesCourse"]
        )
        page = (folder / "question.html").read_text()
        assert f'source-file-name="my_{name}.py"' in page
        assert "raise NotImplementedError" in (folder / f"my_{name}.py").read_text()
    (file,) = prairielearn.glob("assessments/*/infoAssessment.json")
    assessment = json.loads(file.read_text())
    conforms(assessment, ASSESSMENT)
    assert assessment["allowAccess"] == [
        {"credit": 100, "startDate": "2027-03-01T00:00:00", "endDate": "2027-03-31T18:00:00"}
    ]
    assert [question["autoPoints"] for question in assessment["zones"][0]["questions"]] == [10, 5]


@pytest.mark.parametrize(("sample", "score"), [("full", 1), ("none", 0)])
def test_prairielearn_gives_the_samples_what_they_deserve(
    prairielearn, bare, tmp_path, *, sample, score
):
    report = submitted(
        prairielearn,
        bare,
        tmp_path,
        text=(prairielearn / "teacher" / sample / "my_invert_rigid.py").read_text(),
    )
    assert report["score"] == score
    assert report["gradable"] is True


def test_prairielearn_shows_the_failing_case_and_nothing_of_hidden_checks(
    prairielearn, bare, tmp_path
):
    report = submitted(prairielearn, bare, tmp_path, text=WRONG)
    assert 0 <= report["score"] < 1
    assert "seen (4, 4)" in report["output"]
    (image,) = report["images"]
    picture = Image.open(io.BytesIO(base64.b64decode(image["url"].partition(",")[2])))
    assert picture.size == (640, 400)
    assert len(picture.getcolors(1 << 20) or []) > 10  # something is drawn
    assert "Step " in image["label"]
    hidden = [check.promise for check in exercises()["invert_rigid"].checks if not check.public]
    assert not [promise for promise in hidden if promise in json.dumps(report)]
    assert report["tests"][-1]["name"] == "Hidden checks"


def test_prairielearn_takes_no_attempt_for_what_cannot_be_graded(prairielearn, bare, tmp_path):
    report = submitted(prairielearn, bare, tmp_path, text="def invert_rigid(T:\n")
    assert report["gradable"] is False
    assert "line 1" in report["format_errors"][0]


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
