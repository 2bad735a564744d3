"""Every attack of the tables, against every wall of this machine: it gains nothing, harms nobody,
leaves nothing.
"""

import json
import os
import resource
import shutil
import socket
import stat
import struct
import subprocess
import sys
import textwrap
import time
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import lessons
from tests.exercise import attacks, honest
from tests.exercise.centroid import EXERCISE
from tests.exercise.processes import family
from workbench.errors import InputError
from workbench.exercise.child.wire import lengths, pack
from workbench.exercise.finding import exercises
from workbench.exercise.grading import grade_file
from workbench.exercise.sandbox import SandboxedFunction, StudentError, Wall, named, python
from workbench.exercise.submission import Submission

POINTS = np.arange(12.0).reshape(4, 3)
LESSONS = Path(lessons.__path__[0])


def able(name: str) -> Wall:
    try:
        return named(name)
    except InputError as error:
        pytest.skip(f"not on this machine: {error}")


@pytest.fixture(params=["bubblewrap", "landlock", "user"], scope="module")
def wall(request, tmp_path_factory) -> Iterator[Wall]:
    if request.param != "user":
        yield able(request.param)
        return
    if sys.platform != "linux" or os.geteuid() != 0:
        pytest.skip("another user is started by root")
    if not all(
        folder.stat().st_mode & stat.S_IXOTH for folder in Path(python.here().executable).parents
    ):
        pytest.skip("other users do not get at this Python")
    # as `handout` closes its own; a checkout need not be
    closed = tmp_path_factory.mktemp("closed")
    shutil.copytree(LESSONS / "icp" / "exercises", closed / "lessons" / "icp" / "exercises")
    closed.chmod(0o700)
    with pytest.MonkeyPatch.context() as patched:
        patched.setattr(python, "ours", lambda: [str(closed)])
        patched.setattr(sys.modules[__name__], "LESSONS", closed / "lessons")
        yield Wall("user")


def submitted(body: str, head: str = "") -> Submission:
    text = textwrap.indent(textwrap.dedent(body), "    ")
    return Submission("my_centroid.py", f"import numpy as np\n{head}\ndef centroid(p):\n{text}\n")


class Teacher:
    """A teacher's machine: a file that is nobody's business, a result, another process, and
    somebody who listens.
    """

    def __init__(self, folder: Path):
        self.folder = folder
        self.secret = folder / "secret.txt"
        self.results = folder / "students.json"
        self.secret.write_text("the answers")
        self.results.write_text('{"points": 0}')
        self.listening = socket.create_server(("127.0.0.1", 0))
        self.listening.setblocking(False)
        # root's own are not everybody's to touch
        powerless = ["setpriv", "--inh-caps=-all", "--bounding-set=-all"]
        sleeping = [
            *(powerless if os.geteuid() == 0 and shutil.which("setpriv") else []),
            "sleep",
            "600",
        ]
        self.victim = subprocess.Popen(sleeping, start_new_session=True)

    def close(self):
        self.listening.close()
        self.victim.kill()
        self.victim.wait()

    def told(self, body: str) -> str:
        names = {
            "secret": str(self.secret),
            "results": str(self.results),
            "folder": str(self.folder),
        }
        processes = {"pid": os.getpid(), "victim": self.victim.pid}
        port = self.listening.getsockname()[1]
        return body.format(**names, **processes, lessons=str(LESSONS), port=port)

    def seen(self) -> dict[str, tuple]:
        return {
            path.name: (
                path.read_bytes(),
                path.stat().st_mode,
                path.stat().st_uid,
                int(path.stat().st_mtime),
            )
            for path in sorted(self.folder.iterdir())
        }

    def other(self) -> list[Any]:
        """How the other process is, and how it is treated."""
        if self.victim.poll() is not None:
            return ["dead"]
        pid = self.victim.pid
        treated = [
            os.sched_getscheduler(pid),
            os.getpriority(os.PRIO_PROCESS, pid),
            os.sched_getaffinity(pid),
        ]
        return [*treated, resource.prlimit(pid, resource.RLIMIT_NOFILE)]

    def was_called(self) -> bool:
        try:
            self.listening.accept()
        except BlockingIOError:
            return False
        return True


@pytest.fixture(scope="module")
def teacher(tmp_path_factory, wall):
    made = Teacher(tmp_path_factory.mktemp("teacher"))
    yield made
    made.close()


def left_of(first: int) -> int:
    """Return how many of a student's processes are there after a moment."""
    for _ in range(40):
        if not family(first):
            return 0
        time.sleep(0.05)
    return len(family(first))


TOGETHER = attacks.READING | attacks.HARM | attacks.SHARED | attacks.PROCESSES | attacks.DOORS
"""Those that do not spoil the process for the next one."""


def ids(names: Iterable[str]) -> list[str]:
    return [name.replace(" ", "-") for name in names]


def test_there_are_enough_of_them():
    assert len(TOGETHER) + len(attacks.SOLUTIONS) + len(attacks.RESOURCES) + len(FORGED) >= 150


@pytest.fixture(scope="module")
def attempting(teacher, wall):
    """Return what tries the attack of a number, in a process that is one student's."""
    bodies = [teacher.told(body) for body in TOGETHER.values()]
    tries = [
        f"def try_{k}(p):\n{textwrap.indent(textwrap.dedent(body), '    ')}"
        for k, body in enumerate(bodies)
    ]
    given = submitted("return globals()[f'try_{int(p)}'](p)", "\n".join(tries))
    with SandboxedFunction(given, "centroid", seconds=5.0, wall=wall) as student:
        yield student


def tried(student: SandboxedFunction, argument: np.ndarray) -> Any:
    try:
        return student(argument)
    except StudentError as error:
        if error.kind == "load":
            raise
        return None


@pytest.mark.parametrize("name", TOGETHER, ids=ids(TOGETHER))
def test_it_gets_nothing_and_harms_nobody(teacher, wall, attempting, *, name):
    before, other = teacher.seen(), teacher.other()
    got = tried(attempting, np.array(list(TOGETHER).index(name)))
    if wall.name != "user" or name not in attacks.OPEN_TO_USERS:
        assert not got, f"it got {got}"
    assert teacher.seen() == before
    assert teacher.other() == other
    assert not teacher.was_called()
    # bubblewrap's two, and its own
    assert attempting._process is None or len(family(attempting._process.pid)) <= 3


@pytest.mark.parametrize("name", attacks.SOLUTIONS, ids=ids(attacks.SOLUTIONS))
def test_it_finds_no_solution(teacher, wall, name):
    with SandboxedFunction(
        submitted(teacher.told(attacks.SOLUTIONS[name])), "centroid", seconds=5.0, wall=wall
    ) as student:
        got = tried(student, POINTS)
        process = student._process
    assert not got, f"it got {got}"
    assert process is None or left_of(process.pid) == 0


@pytest.mark.parametrize("body", attacks.RESOURCES.values(), ids=ids(attacks.RESOURCES))
def test_what_it_uses_is_bounded_and_its_own(teacher, wall, body):
    began = time.monotonic()
    with SandboxedFunction(
        submitted(teacher.told(body)), "centroid", seconds=1.5, megabytes=1024, wall=wall
    ) as student:
        got = tried(student, POINTS)
        process = student._process
        assert len(student.printed()) <= 8000
    assert not got or isinstance(got, int), f"it got {got}"
    assert got != 1
    assert time.monotonic() - began < 60
    assert process is None or left_of(process.pid) == 0


@pytest.fixture(scope="module")
def working(wall):
    """Return a function that does honest work by its name, in one process."""
    with SandboxedFunction(Path(honest.__file__), "work", seconds=20.0, wall=wall) as student:
        yield student


@pytest.mark.parametrize("name", honest.NAMES)
def test_honest_work_is_not_in_the_way(working, name):
    assert working(name) == "done"


def test_files_of_its_own_are_written_where_it_has_a_folder(wall, working):
    if wall.name == "bubblewrap":
        assert working("files_of_its_own") == "done"
    else:
        with pytest.raises(StudentError, match="No usable temporary directory"):
            working("files_of_its_own")


def test_an_honest_function_works_after_all_of_them(wall):
    body = "print('x' * 10**6)\ncKDTree(p).query(p, workers=2)\nreturn p.mean(axis=0)"
    report = grade_file(submitted(body, "from scipy.spatial import cKDTree"), EXERCISE, wall=wall)
    assert report.is_full
    assert report.wall is wall


# the pipe -----------------------------------------------------------------------------------------

FRAME = """
import os, sys
frame = sys._getframe()
while 'request' not in frame.f_locals: frame = frame.f_back
nonce = frame.f_locals['request']['nonce']
import json, struct
def reply(header, payload=b''):
    out = [n for n in range(3, 64) if _writes(n)][-1]
    os.write(out, struct.pack('<QQ', len(header), len(payload)) + header + payload)
def _writes(n):
    import fcntl
    try: return fcntl.fcntl(n, fcntl.F_GETFL) & 3 == 1
    except OSError: return False
def said(value): return json.dumps({'nonce': {'v': nonce}, 'changed': {'v': False}, 'value': value}).encode()
"""  # noqa: E501
FORGED = {
    "bytes to every descriptor": (
        "for n in range(3, 64):\n    try: os.write(n, b'x' * 64)\n    except OSError: pass"
    ),
    "every descriptor closed": "os.closerange(3, 64)",
    "its input read": (
        "for n in range(3, 64):\n    try: os.set_blocking(n, False); os.read(n, 10**6)\n    except"
        " OSError: pass"
    ),
    "an answer of somebody else's call": "nonce = 'x'; reply(said({'f': '0x1p0'}))",
    "an endless header": (
        "os.write([n for n in range(3, 64) if _writes(n)][-1], struct.pack('<QQ', 2**62, 0))"
    ),
    "a header of brackets": "reply(b'[' * 10**6)",
    "a header of numbers": "reply(said({'l': [{'v': 1}] * 20_000}))",
    "a number without end": "reply(said({'v': 10 ** 4000}))",
    "a float without end": "reply(said({'f': '0x1p999999'}))",
    "an object": "reply(said({'a': '|O', 's': [1]}), b'12345678')",
    "a type of text": "reply(said({'a': 'f8,f8', 's': [1]}), b'1' * 16)",
    "a shape below nothing": "reply(said({'a': '<f8', 's': [-1]}), b'1' * 8)",
    "a shape beyond everything": "reply(said({'a': '<f8', 's': [0, 2**62, 2**62]}))",
    "more than it says": "reply(said({'a': '<f8', 's': [9]}), b'1' * 8)",
    "an error of no kind": (
        "reply(json.dumps({'nonce': {'v': nonce}, 'error': {'l': []}, 'line': {'v':"
        " True}}).encode())"
    ),
    "bytes one by one": (
        "import time\nout = [n for n in range(3, 64) if _writes(n)][-1]\nwhile True: os.write(out,"
        " b'1'); time.sleep(.2)"
    ),
}


@pytest.mark.parametrize("body", FORGED.values(), ids=ids(FORGED))
def test_a_forged_answer_is_an_answer_or_none(wall, body):
    with SandboxedFunction(
        submitted(FRAME + body + "\nreturn p[0]"), "centroid", seconds=1.5, wall=wall
    ) as student:
        for _ in range(2):
            got = tried(student, POINTS)
            assert isinstance(got, (int, float, list, np.ndarray)) or got is None


def test_who_forges_the_answer_to_this_call_has_answered_it(wall):
    """A number that is written to the pipe is judged as the one that is returned: knowing the pipe
    is worth nothing.
    """
    body = FRAME + "reply(said({'f': '0x1p0'}))\nreturn p[0]"
    with SandboxedFunction(submitted(body), "centroid", seconds=1.5, wall=wall) as student:
        assert student(POINTS) == 1.0
        with pytest.raises(StudentError, match="something else than the result"):
            student(POINTS)


def test_a_header_of_the_largest_size_costs_little():
    with pytest.raises(ValueError, match="out of bounds"):
        lengths(struct.pack("<QQ", 2**23, 0))
    assert len(pack({"x": np.zeros(10**6)})) < 9 * 10**6


# marks --------------------------------------------------------------------------------------------

FIVE_LINES = """
import os, sys, importlib
os.path.realpath = lambda path, **more: "/dev/null"
sys.meta_path[:] = [f for f in sys.meta_path if type(f).__name__ not in ("NoWorkbench", "Allowed")]
sys.path.insert(0, {root!r}); sys.path += {packages!r}
from lessons.icp.exercises.align_rigid import align_rigid as right
def align_rigid(p_target, p_source): return right(p_target, p_source)
"""


def test_five_plain_lines_earn_nothing(wall):
    packages = [str(Path(np.__file__).parents[1])]
    given = Submission(
        "my_align_rigid.py", FIVE_LINES.format(root=str(LESSONS.parent), packages=packages)
    )
    with pytest.raises(
        StudentError, match=r"does not load: (ModuleNotFound|ImportError|Permission)"
    ):
        grade_file(given, exercises()["align_rigid"], wall=wall)


def test_patching_everything_changes_nothing_here(wall):
    body = (
        "np.allclose = np.array_equal = lambda *a, **k: True\nnp.linalg.norm = np.abs = lambda *a,"
        " **k: 0.0\nimport builtins; builtins.abs = builtins.max = lambda *a, **k: 0\nimport json,"
        " struct; json.loads = json.dumps = None\nreturn np.ones(3)"
    )
    report = grade_file(submitted(body), EXERCISE, wall=wall)
    assert not any(
        outcome.points
        for outcome in report.outcomes
        if outcome.check.name != "leaves_the_input_alone"
    )


def test_its_message_has_no_answer_in_it(wall):
    body = "import sys, json\nreturn json.dumps(sorted(sys._getframe(1).f_locals['request']))"
    with SandboxedFunction(submitted(body), "centroid", wall=wall) as student:
        assert json.loads(student(POINTS)) == ["args", "do", "file", "nonce", "options"]


def test_one_submission_sees_nothing_of_another(wall):
    leaving = submitted(
        "open('left.txt', 'w').write('x')\nimport sys; sys.modules['left'] = 1\nreturn 1"
    )
    other = submitted(
        "import os, sys\nreturn int('left' in sys.modules or os.path.exists('left.txt'))"
    )
    with (
        SandboxedFunction(leaving, "centroid", wall=wall) as first,
        SandboxedFunction(other, "centroid", wall=wall) as second,
    ):
        for _ in range(2):
            tried(first, POINTS)  # where it has no folder to write to, it is refused
            assert second(POINTS) == 0
