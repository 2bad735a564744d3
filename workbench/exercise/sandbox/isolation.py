"""What shuts a student's process in here: bubblewrap, else Landlock, else limits alone.

Whether a wall holds here is tried, not looked up: a program may be installed and not be allowed to
do its work.
"""

import functools
import json
import os
import subprocess
import sys
import threading
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from typing import IO

from workbench.errors import InputError
from workbench.exercise.sandbox import bubblewrap, python
from workbench.machinery.threads import as_here

START_SECONDS = 30.0
"""How long Python and numpy may take to start."""
OUTPUT_BYTES = 64 << 10
"""How much of what a student prints is kept: the first."""
NAMES = ("bubblewrap", "landlock", "user", "none")
NOBODY = 65534
"""The user that a submission runs as where another user is what shuts it in."""


@dataclass(frozen=True)
class Wall:
    """What stands between a student's process and this machine.

    Attributes:
        name: `bubblewrap`, `landlock`, `user` (to whom what matters is closed), or `none`: limits
            only, so that marks are not safe.
        why: Where it is `none`, why there is nothing better; one line.
    """

    name: str
    why: str = ""

    @property
    def holds(self) -> bool:
        """Whether the kernel shuts the process in."""
        return self.name != "none"

    def start(
        self,
        *,
        pipe_in: int,
        pipe_out: int,
        printed: IO[bytes],
        folder: str,
        megabytes: int,
        cpu_seconds: int,
    ) -> subprocess.Popen:
        """Start a student's process; it dies with this one wherever the wall holds.

        It reads and answers at two descriptors, and works in `folder` if it has none of its own.
        """
        files = python.here()
        boxed = self.name == "bubblewrap"
        settings = {
            "in": pipe_in,
            "out": pipe_out,
            "packages": files.places,
            "megabytes": megabytes,
            "cpu": cpu_seconds,
            "output": OUTPUT_BYTES,
            "filter": self.holds,
            "writes": boxed,
            "grader": None if boxed else os.getpid(),  # it has parents of its own
            "landlock": list(files.listed()) if self.name == "landlock" else None,
            "user": NOBODY if self.name == "user" else None,
            "closed": python.ours(),
        }
        child = f"{bubblewrap.CHILD}/main.py" if boxed else str(python.CHILD_FILES / "main.py")
        quiet = ["-W", "ignore::RuntimeWarning"]  # numpy's are not what the student printed
        environment = {
            "PATH": "/usr/bin:/bin",
            "LANG": "C.UTF-8",
            "HOME": bubblewrap.FOLDER if boxed else folder,
        }
        # so that a mistake which hangs on the last bit is known for what it is
        environment |= as_here()
        command = [files.executable, "-I", "-S", "-B", "-u", *quiet, child, json.dumps(settings)]
        if boxed:
            known = [word for pair in environment.items() for word in ("--setenv", *pair)]
            *before, end = bubblewrap.arguments(files)
            command = [*before, *known, end, *command]
        return _from_a_lasting_thread(
            lambda: subprocess.Popen(
                command,
                stdin=subprocess.DEVNULL,
                stdout=printed,
                stderr=printed,
                pass_fds=(pipe_in, pipe_out),
                cwd=folder,
                env=environment,
                start_new_session=True,
            )
        )


@functools.cache
def best(*, alone: bool = False) -> Wall:
    """Return the best wall of this machine.

    If it is a container for this one submission `alone`, closed to others but root, another user is
    a wall too. Elsewhere it could read what other students handed in.
    """
    troubles = []
    for name in NAMES[:3] if alone else NAMES[:2]:
        wrong = _without(name) or _tried(Wall(name))
        if not wrong:
            return Wall(name)
        troubles.append(wrong)
    return Wall("none", "; ".join(troubles))


def named(name: str) -> Wall:
    """Return a wall by its name, `auto` for the best.

    Raises:
        InputError: If there is no wall of that name, or it does not hold on this machine.
    """
    if name == "auto":
        return best()
    if name not in NAMES:
        raise InputError(f"--sandbox {name}: there are auto, {', '.join(NAMES)}")
    wrong = "" if name == "none" else _without(name) or _tried(Wall(name))
    if wrong:
        raise InputError(f"--sandbox {name}: {wrong}")
    return Wall(name, "it was asked for" if name == "none" else "")


def _without(name: str) -> str:
    """Return why a wall is not even tried here."""
    if sys.platform != "linux":
        return f"{name} needs Linux"
    if name == "bubblewrap" and not bubblewrap.program():
        return "bubblewrap is not installed (apt install bubblewrap)"
    return (
        "another user needs to be started by root" if name == "user" and os.geteuid() != 0 else ""
    )


@functools.cache
def _tried(wall: Wall) -> str:
    """Return why a process cannot be shut in by a wall here; nothing where it can."""
    pipe_in, other = os.pipe()
    os.close(other)
    pipe_out = os.open(os.devnull, os.O_WRONLY)
    with anonymous() as printed:
        try:
            process = wall.start(
                pipe_in=pipe_in,
                pipe_out=pipe_out,
                printed=printed,
                folder="/",
                megabytes=2048,
                cpu_seconds=60,
            )
            try:
                code = process.wait(START_SECONDS)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()
                return f"{wall.name} does not start within {START_SECONDS:g} s"
        except OSError as error:
            return f"{wall.name} does not start ({error.strerror})"
        finally:
            os.close(pipe_in)
            os.close(pipe_out)
        printed.seek(0)
        lines = printed.read(1 << 16).decode("utf-8", "replace").strip().splitlines() or [
            f"exit code {code}"
        ]
    return "" if code == 0 else f"{wall.name} cannot do its work here ({lines[-1][:200]})"


def anonymous() -> IO[bytes]:
    """Return a file without a name, in memory where that is possible: nothing stays behind."""
    if hasattr(os, "memfd_create"):
        return os.fdopen(os.memfd_create("printed", os.MFD_CLOEXEC), "w+b", buffering=0)
    import tempfile

    return tempfile.TemporaryFile(buffering=0)


def _from_a_lasting_thread(start: Callable[[], subprocess.Popen]) -> subprocess.Popen:
    """Start a process from a lasting thread: the kernel ends it with its thread."""
    if threading.current_thread() is threading.main_thread():
        return start()
    return _thread(os.getpid()).submit(start).result()


@functools.cache
def _thread(process: int) -> ThreadPoolExecutor:
    return ThreadPoolExecutor(1, thread_name_prefix=f"sandbox-{process}")
