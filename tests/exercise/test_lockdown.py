"""What a student's process takes from itself, layer by layer: limits, Landlock alone."""

import ctypes
import errno
import importlib
import json
import os
import signal
import subprocess
import sys
import textwrap
import time
from collections.abc import Iterator
from types import ModuleType

import pytest

from tests.exercise import kernel
from tests.exercise.processes import family
from workbench.errors import InputError
from workbench.exercise.sandbox import named, python


@pytest.fixture(scope="module")
def lockdown() -> Iterator[ModuleType]:
    with pytest.MonkeyPatch.context() as patched:
        patched.syspath_prepend(str(python.CHILD_FILES))
        yield importlib.import_module("lockdown")
        for name in ("lockdown", "syscalls"):
            sys.modules.pop(name)


@pytest.mark.parametrize("machine", ["x86_64", "aarch64"])
def test_the_numbers_are_the_kernel_s(lockdown, machine):
    known = kernel.numbers(machine)
    for name, number in {
        "seccomp": lockdown.SECCOMP[machine],
        "landlock_create_ruleset": lockdown.CREATE_RULESET,
        "landlock_add_rule": lockdown.ADD_RULE,
        "landlock_restrict_self": lockdown.RESTRICT_SELF,
    }.items():
        assert known[name] == str(number), name


def test_a_call_that_the_kernel_refuses_is_told(lockdown):
    with pytest.raises(OSError, match=os.strerror(errno.ENOSYS)):
        lockdown._call(-1)


def test_all_that_a_version_of_landlock_knows_is_denied(lockdown):
    """Source: Linux, include/uapi/linux/landlock.h: rights of files, of ports, and scopes."""
    files = {1: 0x1FFF, 2: 0x3FFF, 3: 0x7FFF, 4: 0x7FFF, 5: 0xFFFF, 6: 0xFFFF}
    others = {4: (3,), 5: (3,), 6: (3, 3)}
    known = {version: (rights, *others.get(version, ())) for version, rights in files.items()}
    assert known == lockdown.HANDLED


@pytest.mark.skipif(sys.platform != "linux", reason="Linux has it")
def test_where_the_kernel_has_landlock_it_is_a_wall():
    asked = [ctypes.c_long(444), None, ctypes.c_long(0), ctypes.c_long(1)]  # for its version
    if ctypes.CDLL(None).syscall(*asked) < 1:
        pytest.skip("this kernel has no Landlock")
    assert named("landlock").holds


# in a process of its own --------------------------------------------------------------------------


@pytest.fixture
def shut(tmp_path):
    """Return what runs lines in a process that may shut itself in, and gives back what they
    print.
    """
    try:
        named("landlock")
    except InputError as error:
        pytest.skip(f"not on this machine: {error}")
    settings = {
        "megabytes": 2048,
        "cpu": 60,
        "user": None,
        "closed": [],
        "grader": None,
        "filter": True,
        "writes": False,
        "landlock": list(python.here().listed()),
    }
    head = "import ctypes, json, os, sys; sys.path.insert(0, sys.argv[1]); import lockdown\n"
    head += "settings = json.loads(sys.argv[2])\n"

    def run(lines: str, *words: str) -> list[str]:
        command = [python.here().executable, "-I", "-S", "-B", "-c", head + textwrap.dedent(lines)]
        command += [str(python.CHILD_FILES), json.dumps(settings), *words]
        done = subprocess.run(
            command, capture_output=True, text=True, timeout=60, check=False, cwd="/"
        )
        assert done.returncode == 0, done.stderr
        return done.stdout.split()

    return run


TRIED = """
def tried(act):
    try: act()
    except OSError as error: print(error.errno)
    else: print('done')
"""


def test_a_thread_that_was_there_before_is_filtered_too(shut):
    lines = """
    import socket, threading
    go = threading.Event()
    def later():
        go.wait()
        tried(socket.socket)
    thread = threading.Thread(target=later)
    thread.start()
    lockdown.shut(settings)
    go.set()
    thread.join()
    """
    assert shut(TRIED + textwrap.dedent(lines)) == ["1"]


def test_landlock_alone_holds_signals_and_ports_where_it_knows_them(shut):
    lines = """
    import socket
    lockdown._prctl(lockdown.PR_SET_NO_NEW_PRIVS, 1)
    print(lockdown._call(lockdown.CREATE_RULESET, None, 0, lockdown.ASK_VERSION))
    lockdown._landlock(settings["landlock"])
    tried(lambda: os.kill(int(sys.argv[3]), 0))
    tried(lambda: socket.create_server(("127.0.0.1", 0)))
    """
    version, signal, port = shut(TRIED + textwrap.dedent(lines), str(os.getpid()))
    assert signal == ("1" if int(version) >= 6 else "done")
    assert port == ("13" if int(version) >= 4 else "done")


def test_what_a_process_may_use_is_bounded(shut):
    lines = """
    import resource
    kinds = ["AS", "CPU", "FSIZE", "NOFILE", "NPROC", "CORE"]
    before = [resource.getrlimit(getattr(resource, f"RLIMIT_{kind}"))[1] for kind in kinds]
    lockdown.shut(settings)
    after = [resource.getrlimit(getattr(resource, f"RLIMIT_{kind}")) for kind in kinds]
    print(json.dumps([before, after]).replace(" ", ""))
    """
    before, after = json.loads(shut(lines)[0])
    wanted = [2048 << 20, 60, 1 << 20, 64, 4096, 0]
    allowed = [2**64 if hard < 0 else hard for hard in before]
    assert after == [[min(pair)] * 2 for pair in zip(wanted, allowed, strict=True)]


@pytest.mark.parametrize("version", [1, 2, 3])
def test_landlock_s_first_versions_hold_files_with_the_filter(shut, tmp_path, version):
    """The first two do not see a file emptied: the filter refuses to open it so."""
    mine = tmp_path / "results.json"
    mine.write_text("full")
    lines = f"""
    import ctypes
    lockdown.HANDLED = {{{version}: lockdown.HANDLED[{version}]}}
    name = sys.argv[3]
    lockdown.shut(settings)
    tried(lambda: os.open(name, os.O_RDONLY | os.O_TRUNC))
    tried(lambda: os.truncate(name, 0))
    tried(lambda: os.open(name, os.O_WRONLY))
    tried(lambda: os.open(name, os.O_RDONLY))
    tried(lambda: os.unlink(name))
    tried(lambda: os.rename(name, name + "2"))
    tried(lambda: os.mkdir(name + "2"))
    """
    assert set(shut(TRIED + textwrap.dedent(lines), str(mine))) <= {"1", "13"}
    assert mine.read_text() == "full"


GRADER = """
import os, signal, sys, threading, time
from pathlib import Path
import numpy as np
from workbench.exercise.sandbox import SandboxedFunction, Wall

student = SandboxedFunction(Path(sys.argv[1]), "centroid", seconds=60.0, wall=Wall("none"))
student.start()
threading.Thread(target=student, args=(np.ones((2, 3)),), daemon=True).start()
time.sleep(0.5)
print(student._process.pid, flush=True)
os.kill(os.getpid(), signal.SIGKILL)
"""


@pytest.mark.skipif(sys.platform != "linux", reason="the kernel of Linux ends it")
def test_who_is_graded_does_not_outlive_the_grader(tmp_path):
    file = tmp_path / "my_centroid.py"
    file.write_text("def centroid(p):\n    while True:\n        pass\n")
    ended = subprocess.run(
        [sys.executable, "-c", GRADER, str(file)], capture_output=True, text=True
    )
    assert ended.stdout.strip().isdecimal(), ended.stderr
    pid = int(ended.stdout)
    for _ in range(100):
        if not family(pid):
            break
        time.sleep(0.05)
    else:
        os.kill(pid, signal.SIGKILL)
        pytest.fail("it goes on")
