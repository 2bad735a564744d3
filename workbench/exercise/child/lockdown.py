"""What a student's process takes from itself for good before the student's code runs.

Limits bound memory, processor time, files and processes. Where the grader asks for them, a filter
of system calls (`syscalls`) and, in place of a sandbox around the process, Landlock: files outside
a list cannot be opened; or another user, to whom the grader's files are closed. It imports nothing
of ours but its neighbours.
"""

import ctypes
import os
import platform
import resource
import struct
import sys
from collections.abc import Iterable
from typing import Any

import syscalls  # type: ignore[import-not-found]

PR_SET_PDEATHSIG, PR_SET_NO_NEW_PRIVS, SIGKILL = 1, 38, 9
SECCOMP = {"x86_64": 317, "aarch64": 277}
SET_FILTER, ALL_THREADS = 1, 1
CREATE_RULESET, ADD_RULE, RESTRICT_SELF = 444, 445, 446  # the same on every machine
ASK_VERSION, PATH_BENEATH = 1, 1
CAPABILITIES = 0x20080522  # the version of what capset takes
EXECUTE, READ_FILE, READ_DIR = 1 << 0, 1 << 2, 1 << 3
HANDLED = {
    # from this version of Landlock on: what is denied wherever no rule gives it, of files, of
    # ports, of other processes
    1: ((1 << 13) - 1,),
    2: ((1 << 14) - 1,),  # links and names across folders
    3: ((1 << 15) - 1,),  # truncating
    4: ((1 << 15) - 1, 3),  # binding and connecting
    5: ((1 << 16) - 1, 3),  # asking devices
    6: ((1 << 16) - 1, 3, 3),  # abstract sockets, and signals to who is not shut in with it
}


def shut(settings: dict[str, Any]) -> None:
    """Bound this process for good, as its settings say.

    They are `megabytes`, `cpu`, `filter`, and one of `landlock`, paths to read, and `user`, to whom
    the folders in `closed` are closed.

    Raises:
        OSError: If the kernel does not take it, or the folders are open.
    """
    for limit, most in (
        (resource.RLIMIT_AS, settings["megabytes"] << 20),
        (resource.RLIMIT_CPU, settings["cpu"]),
        (resource.RLIMIT_FSIZE, 1 << 20),
        (resource.RLIMIT_NOFILE, 64),
        (resource.RLIMIT_NPROC, 4096),
        (resource.RLIMIT_CORE, 0),
    ):
        hard = resource.getrlimit(limit)[1]
        most = most if hard == resource.RLIM_INFINITY else min(most, hard)
        resource.setrlimit(limit, (most, most))
    if settings["user"] is not None:
        _become(settings["user"], settings["closed"])
    if settings["grader"] is not None and sys.platform == "linux":
        _prctl(PR_SET_PDEATHSIG, SIGKILL)
        if os.getppid() != settings["grader"]:
            os._exit(0)  # it is gone already
    if not settings["filter"]:
        return
    _prctl(PR_SET_NO_NEW_PRIVS, 1)
    if settings["landlock"] is not None:
        _landlock(settings["landlock"])
    # of an administrator's powers, none
    _checked(_libc().capset(struct.pack("=Ii", CAPABILITIES, 0), bytes(24)))
    machine = platform.machine()
    if machine in syscalls.MACHINES:
        lines = syscalls.program(machine, writes=settings["writes"])
        code = ctypes.create_string_buffer(lines, len(lines))
        filtered = struct.pack("@HP", len(lines) // 8, ctypes.addressof(code))
        if _call(SECCOMP[machine], SET_FILTER, ALL_THREADS, filtered):
            raise OSError("a thread has a filter of system calls of its own")
    elif settings["landlock"] is not None or settings["user"] is not None:
        raise OSError(f"no filter of system calls is known for {machine}")


def _landlock(readable: Iterable[str]) -> None:
    version = _call(CREATE_RULESET, None, 0, ASK_VERSION)
    handled = HANDLED[min(version, max(HANDLED))]
    rules = _call(CREATE_RULESET, struct.pack(f"={len(handled)}Q", *handled), 8 * len(handled), 0)
    for path in readable:
        held = os.open(path, os.O_PATH | os.O_CLOEXEC)
        allowed = EXECUTE | READ_FILE | (READ_DIR if os.path.isdir(path) else 0)
        _call(ADD_RULE, rules, PATH_BENEATH, struct.pack("=Qi", allowed, held), 0)
        os.close(held)
    _call(RESTRICT_SELF, rules, 0)
    os.close(rules)


def _become(user: int, closed: Iterable[str]) -> None:
    os.setgroups([])
    os.setresgid(user, user, user)
    os.setresuid(user, user, user)  # of an administrator's powers, none
    for folder in closed:
        if os.access(folder, os.X_OK) or os.access(folder, os.R_OK):
            raise OSError(f"{folder} is open to every user")


def _prctl(option: int, *arguments: Any) -> None:
    given = [*arguments, 0, 0, 0, 0][:4]
    _checked(
        _libc().prctl(option, *(n if isinstance(n, bytes) else ctypes.c_ulong(n) for n in given))
    )


def _call(number: int, *arguments: Any) -> int:
    given = (n if isinstance(n, bytes) or n is None else ctypes.c_long(n) for n in arguments)
    return _checked(_libc().syscall(ctypes.c_long(number), *given))


def _libc() -> ctypes.CDLL:
    return ctypes.CDLL(None, use_errno=True)


def _checked(answer: int) -> int:
    if answer < 0:
        number = ctypes.get_errno()
        raise OSError(number, os.strerror(number))
    return answer
