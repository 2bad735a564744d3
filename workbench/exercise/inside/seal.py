"""What a student's process takes from itself before the student's code runs; the kernel gives none of it back.

Limits bound memory, processor time, files and processes. Where the grader asks for them, a filter of system calls
(`syscalls`) and, in place of a sandbox around the process, Landlock: files outside a list cannot be opened; or another
user, to whom the grader's files are closed.
It imports nothing of ours but its neighbours.
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

PR_SET_PDEATHSIG, PR_SET_NO_NEW_PRIVS, PR_SET_SECCOMP, SECCOMP_MODE_FILTER, SIGKILL = 1, 38, 22, 2, 9
CREATE_RULESET, ADD_RULE, RESTRICT_SELF = 444, 445, 446  # the same on every machine
ASK_VERSION, PATH_BENEATH = 1, 1
CAPABILITIES = 0x20080522  # the version of what capset takes
LEAST_VERSION = 3  # of Landlock: from here on it stops truncating too
EXECUTE, READ_FILE, READ_DIR = 1 << 0, 1 << 2, 1 << 3
ALL_RIGHTS = {3: (1 << 15) - 1, 5: (1 << 16) - 1}  # by version: what is denied wherever no rule gives it


def shut(settings: dict[str, Any]) -> None:
    """Bound this process for good, as its settings say.

    They are `megabytes`, `cpu`, `filter`, and one of `landlock`, paths to read, and `user`, to whom the folders in `closed`
    are closed.

    Raises:
        OSError: If the kernel does not take it, or the folders are open.
    """
    for what, most in (
        (resource.RLIMIT_AS, settings["megabytes"] << 20),
        (resource.RLIMIT_CPU, settings["cpu"]),
        (resource.RLIMIT_FSIZE, 1 << 20),
        (resource.RLIMIT_NOFILE, 64),
        (resource.RLIMIT_NPROC, 4096),
        (resource.RLIMIT_CORE, 0),
    ):
        hard = resource.getrlimit(what)[1]
        most = most if hard == resource.RLIM_INFINITY else min(most, hard)
        resource.setrlimit(what, (most, most))
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
        _checked(_libc().capset(struct.pack("=Ii", CAPABILITIES, 0), bytes(24)))  # of an administrator's powers, none
    if platform.machine() in syscalls.MACHINES:
        code = ctypes.create_string_buffer(syscalls.program(platform.machine()))
        length = (len(code) - 1) // 8  # of the string; the buffer ends with a zero
        _prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, struct.pack("@HP", length, ctypes.addressof(code)))
    elif settings["landlock"] is not None or settings["user"] is not None:
        raise OSError(f"no filter of system calls is known for {platform.machine()}")


def _landlock(readable: Iterable[str]) -> None:
    version = _call(CREATE_RULESET, None, 0, ASK_VERSION)
    if version < LEAST_VERSION:
        raise OSError(f"Landlock is of version {version}, older than {LEAST_VERSION}")
    rights = ALL_RIGHTS[5 if version >= 5 else 3]
    rules = _call(CREATE_RULESET, struct.pack("=Q", rights), 8, 0)
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


def _prctl(what: int, *arguments: Any) -> None:
    given = [*arguments, 0, 0, 0, 0][:4]
    _checked(_libc().prctl(what, *(n if isinstance(n, bytes) else ctypes.c_ulong(n) for n in given)))


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
