"""Attacks on the grader: each is tried, costs its own call only, and the next honest call still
works.
"""

import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from tests.exercise.centroid import EXERCISE
from tests.exercise.written import POINTS, written
from workbench.errors import InputError
from workbench.exercise.candidate import held_to_contract
from workbench.exercise.grading import grade_file
from workbench.exercise.sandbox import (
    SandboxedFunction,
    StudentError,
    Wall,
    best,
    bubblewrap,
    named,
)
from workbench.exercise.sandbox.function import removed_folder
from workbench.exercise.sandbox.isolation import anonymous
from workbench.exercise.submission import Submission


@pytest.fixture
def student(tmp_path):
    made: list[SandboxedFunction] = []

    def make(body: str, head: str = "") -> SandboxedFunction:
        made.append(written(tmp_path, body, head))
        return made[-1]

    yield make
    for function in made:
        function.close()


def test_an_honest_function_gives_plain_values(student):
    function = student("return p.mean(axis=0)")
    np.testing.assert_allclose(function(POINTS), [4.5, 5.5, 6.5])
    assert not function.changed_inputs


def test_numbers_are_rounded_as_by_the_grader(student, monkeypatch):
    monkeypatch.setenv("OPENBLAS_CORETYPE", "Nehalem")
    monkeypatch.setenv("OPENBLAS_SECRET", "not for students")
    function = student(
        "import os; return ' '.join(sorted(k for k in os.environ if k.startswith('OPENBLAS')))"
    )
    assert function(POINTS) == "OPENBLAS_CORETYPE OPENBLAS_NUM_THREADS"


ATTACKS = {
    "endless loop": ("while True: pass", "timeout", "took more than 1 s"),
    "sleeping": ("import time; time.sleep(60)", "timeout", "took more than"),
    "os._exit": ("import os; os._exit(0)", "died", "ended"),
    "sys.exit": ("import sys; sys.exit(0)", "raised", "SystemExit"),
    "our solution": (
        "from workbench.geometry.motions.alignment import align_rigid",
        "raised",
        "write the function yourself",
    ),
    "the lessons": ("import lessons.icp.lesson", "raised", "write the function yourself"),
    "nothing": ("pass", None, None),
    "an object": ("return object()", "result", "cannot cross"),
    "a dict": ("return {'a': 1}", "result", "cannot cross"),
    "objects in an array": ("return np.array([object()])", "result", "cannot be a result"),
    "a huge array": ("return np.zeros((10**7, 3))", "result", "more than"),
    "too deep": ("x = []\nfor _ in range(99): x = [x]\nreturn x", "result", "too many parts"),
    "recursion": ("return centroid(p)", "raised", "RecursionError"),
}


@pytest.mark.parametrize("name", ATTACKS)
def test_an_attack_costs_its_own_call_only(student, name):
    body, kind, message = ATTACKS[name]
    function = student(body)
    if kind is None:
        assert function(POINTS) is None
    else:
        with pytest.raises(StudentError, match=message) as caught:
            function(POINTS)
        assert caught.value.kind == kind
        assert "\n" not in str(caught.value)
    honest = student("return p.mean(axis=0)")
    assert honest(POINTS).shape == (3,)


def test_memory_is_bounded(student):
    function = student("x = []\nwhile True: x.append(np.empty(50_000_000))")
    with pytest.raises(StudentError, match=r"MemoryError|took more|was killed"):
        function(POINTS)


def test_printing_for_ever_fills_no_disk(student):
    function = student("while True: print('x' * 10_000)")
    with pytest.raises(StudentError):
        function(POINTS)


def test_what_is_printed_can_be_read(student):
    function = student("print('hello', p.shape)\nreturn p[0]")
    function(POINTS)
    assert function.printed() == "hello (4, 3)\n"


def test_the_first_64_kilobytes_of_what_is_printed_are_kept(student):
    function = student("print('é' * (1 << 20))\nreturn p[0]")
    np.testing.assert_allclose(function(POINTS), POINTS[0])
    assert len(function.printed(1 << 20).encode()) == 64 << 10


@pytest.mark.skipif(not hasattr(os, "memfd_create"), reason="Linux has it")
def test_what_is_printed_stays_in_memory():
    with anonymous() as printed:
        assert os.readlink(f"/proc/self/fd/{printed.fileno()}").startswith("/memfd:")


def test_the_wall_that_is_given_is_the_one_that_stands():
    given = Submission("a.py", "")
    for wall in (Wall("none", "asked for"), Wall("landlock")):
        with SandboxedFunction(given, "f", wall=wall) as student:
            assert student.wall is wall
    with SandboxedFunction(given, "f") as student:
        assert student.wall is best()


def test_where_bubblewrap_is_not_installed_the_other_walls_stand(monkeypatch):
    monkeypatch.setattr(bubblewrap, "program", lambda: None)
    with pytest.raises(InputError, match=r"^--sandbox bubblewrap: bubblewrap is not installed"):
        named("bubblewrap")
    monkeypatch.setattr("workbench.exercise.sandbox.isolation._tried", lambda wall: "")
    if sys.platform == "linux":
        assert named("landlock") == Wall("landlock")


def test_a_wall_of_no_name_is_refused():
    with pytest.raises(InputError, match=r"^--sandbox glass: there are auto, bubblewrap, landlock"):
        named("glass")
    assert named("none") == Wall("none", "it was asked for")
    assert not named("none").holds


def test_patching_numpy_in_the_child_changes_nothing_here(student):
    function = student(
        "np.allclose = lambda *a, **k: True\nnp.linalg.norm = lambda *a, **k: 0.0\nreturn p[0] + 99"
    )
    np.testing.assert_allclose(function(POINTS), POINTS[0] + 99)
    assert np.linalg.norm(np.ones(4)) == 2.0


def test_writing_to_the_pipe_is_noticed_or_is_an_answer_like_any_other(student):
    forged = student(
        "import os, sys\nfor fd in range(3, 64):\n    try: os.write(fd, b'x' * 64)\n    except"
        " OSError: pass\nreturn p[0]"
    )
    with pytest.raises(StudentError):
        forged(POINTS)


def test_the_child_knows_no_expected_answer_and_not_our_environment(student, monkeypatch):
    monkeypatch.setenv("SECRET_OF_THE_GRADER", "42")
    function = student(
        "import os\nreturn [len(os.listdir('.')), 'SECRET_OF_THE_GRADER' in os.environ]"
    )
    assert function(POINTS) == [0, False]


def test_deleting_its_own_folder_hurts_nobody(student):
    function = student("import os, shutil\nshutil.rmtree('.', ignore_errors=True)\nreturn p[0]")
    np.testing.assert_allclose(function(POINTS), POINTS[0])
    np.testing.assert_allclose(function(POINTS), POINTS[0])


def test_changed_input_is_noticed_and_ours_is_untouched(student):
    function = student("p[0] = 99\nreturn p[1]")
    ours = POINTS.copy()
    function(ours)
    assert function.changed_inputs
    assert np.array_equal(ours, POINTS)


@pytest.mark.parametrize(
    ("head", "message"),
    [
        ("x = = 1", "line 2.*SyntaxError"),
        ("1 / 0", "line 2.*ZeroDivisionError"),
        ("import nothing_such", "ModuleNotFoundError"),
    ],
)
def test_a_file_that_does_not_load_names_the_line(student, head, message):
    with pytest.raises(StudentError, match=message):
        student("return p", head)(POINTS)


def test_a_missing_function_and_a_missing_file_are_told(tmp_path):
    (tmp_path / "my.py").write_text("x = 1\n")
    with (
        pytest.raises(StudentError, match="defines no function centroid"),
        SandboxedFunction(tmp_path / "my.py", "centroid") as function,
    ):
        function.start()
    with pytest.raises(InputError, match="cannot be read"):
        SandboxedFunction(tmp_path / "other.py", "centroid")


def test_an_error_names_the_students_own_line(student):
    with pytest.raises(StudentError, match=r"my_centroid.py, line 5: .* IndexError") as caught:
        student("x = 1\nreturn p[99]")(POINTS)
    assert caught.value.line == 5


def test_of_what_a_process_says_of_an_error_so_much_is_taken(student):
    reply = {"error": "E" * 99, "message": "m" * 999, "errors": ["N" * 99] * 20, "line": 3}
    function = student("return p")
    error = function.raised(reply, loading=False)
    assert error.error == "E" * 80
    assert error.errors == ("N" * 80,) * 12
    assert str(error).endswith(f"line 3: centroid raised {'E' * 80}: {'m' * 500}")
    unwritten = function.raised(reply | {"error": "NotImplementedError"}, loading=False)
    assert str(unwritten).endswith("line 3: centroid is not written yet")
    assert unwritten.line == 3
    loading = function.raised(reply | {"line": True}, loading=True)
    assert str(loading).endswith(f".py: the file does not load: {'E' * 80}: {'m' * 500}")


def test_nothing_is_left_behind(student, tmp_path):
    function = student("return p[0]")
    function(POINTS)
    process = function._process
    function.close()
    assert process is not None
    assert process.poll() is not None


@pytest.mark.parametrize("by_descriptor", [True, False])
def test_a_process_stays_in_a_folder_that_takes_no_files(tmp_path, monkeypatch, by_descriptor):
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    if not by_descriptor:
        monkeypatch.setattr("os.path.isdir", lambda path: False)  # where there is no /proc
    elif not Path("/proc/self/fd").is_dir():
        pytest.skip("no /proc here")
    writing = "import sys; sys.stdin.read(); open('x', 'w')"
    with removed_folder() as folder:
        assert bool(list(tmp_path.iterdir())) is not by_descriptor
        process = subprocess.Popen(
            [sys.executable, "-c", writing],
            cwd=folder,
            stdin=subprocess.PIPE,
            stderr=subprocess.PIPE,
        )
    assert list(tmp_path.iterdir()) == []
    stderr = process.communicate()[1]
    assert b"FileNotFoundError" in stderr


def test_a_run_that_goes_on_does_not_start_what_was_closed(student):
    function = student("return p[0]")
    function(POINTS)
    function.close()
    with pytest.raises(StudentError, match="no longer in use"):
        function(POINTS)
    assert function._process is None


CHEATS = {
    "sly arrays": (
        "class Sly(np.ndarray):\n    def __abs__(s): return np.zeros(3)\n"
        "    def __sub__(s, o): return np.zeros(3)\n    def __eq__(s, o): return np.ones(3, bool)\n"
        "    def __array_function__(s, *a): return 0.0\nreturn np.ones(3).view(Sly)"
    ),
    "NaN": "return np.full(3, np.nan)",
    "infinity": "return np.full(3, np.inf)",
    "wrong shape": "return p",
    "wrong kind": "return 'right'",
    "a scalar": "return 0.0",
    "a tuple": "return (p, p)",
}


@pytest.mark.parametrize("name", CHEATS)
def test_a_cheat_earns_nothing(tmp_path, name):
    report = grade_file(written(tmp_path, CHEATS[name]).submission, EXERCISE)
    by_name = {outcome.check.name: outcome for outcome in report.outcomes}
    assert by_name["is_the_mean"].points == 0
    assert by_name["moves_along"].points == 0


@pytest.mark.parametrize(
    ("answer", "expected"),
    [
        ("np.array([3, 4])", (3.0, 4.0)),
        ("np.array([3.0, 0.5])", (3, 0.5)),
        ("np.stack([p[0], p[1]])", (POINTS[0], POINTS[1])),
        ("np.longdouble(2.5)", 2.5),
        ("p.astype(np.longdouble)", POINTS),
        ("(np.float32(3), 4)", (3.0, 4.0)),
    ],
)
def test_an_answer_in_other_clothes_is_an_answer(tmp_path, answer, expected):
    with written(tmp_path, f"return {answer}") as student:
        got = held_to_contract(student(POINTS), expected, "centroid")
    assert type(got) is type(expected)
    np.testing.assert_array_equal(np.asarray(got), np.asarray(expected))


@pytest.mark.parametrize("answer", [np.array([3.5, 4.0]), np.array([1.0, 2.0, 3.0]), np.array(3.0)])
def test_an_array_of_other_things_is_no_pair(answer):
    with pytest.raises(StudentError):
        held_to_contract(answer, (3, 4.0), "f")
