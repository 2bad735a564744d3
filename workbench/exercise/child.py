"""The student's side of the pipe: started as `python -I -B child.py IN OUT FOLDER MEGABYTES SECONDS`, never imported.

It loads the student's source, then answers calls. Before any of the student's code runs, limits are set, and an audit
hook that cannot be taken off again denies other processes, signals, sockets, foreign code and files outside the working
folder; the workbench's own packages cannot be imported. It holds no expected answer: those stay with the grader.
"""

import os
import resource
import sys
import traceback
from collections.abc import Callable
from typing import Any

HERE = os.path.dirname(os.path.realpath(__file__))
OURS = (os.path.dirname(HERE), os.path.join(os.path.dirname(os.path.dirname(HERE)), "lessons"))
DENIED = (
    "os.fork", "os.forkpty", "os.exec", "os.posix_spawn", "os.spawn", "os.system", "os.kill", "os.killpg", "os.setxattr",
    "subprocess.", "pty.", "signal.pthread_kill", "socket.", "ctypes.dlopen", "ctypes.dlsym", "resource.setrlimit",
    "resource.prlimit", "os.chdir", "os.fchdir", "os.chown", "os.chmod", "mmap.__new__", "os.startfile", "webbrowser.open",
)  # fmt: skip
ON_PATHS = (
    "os.remove",
    "os.rename",
    "os.rmdir",
    "os.mkdir",
    "os.link",
    "os.symlink",
    "os.truncate",
    "os.utime",
    "shutil.",
)


class NotAllowedError(PermissionError):
    """Something a graded function has no need of."""


def limit(megabytes: int, seconds: int) -> None:
    """Bound memory, processor time, file sizes, open files and processes of this process."""
    for what, most in (
        (resource.RLIMIT_AS, megabytes << 20),
        (resource.RLIMIT_CPU, seconds),
        (resource.RLIMIT_FSIZE, 1 << 20),
        (resource.RLIMIT_NOFILE, 64),
        (resource.RLIMIT_NPROC, 4096),
        (resource.RLIMIT_CORE, 0),
    ):
        hard = resource.getrlimit(what)[1]
        most = most if hard == resource.RLIM_INFINITY else min(most, hard)
        resource.setrlimit(what, (most, most))


def guard(folder: str) -> None:
    """Deny, from here on, what a graded function has no need of."""
    readable = tuple(
        {os.path.realpath(p) for p in (sys.prefix, sys.base_prefix, folder, "/usr/lib", "/usr/share/zoneinfo")}
    )
    devices = {"/dev/null", "/dev/urandom", "/proc/cpuinfo", "/proc/meminfo", "/proc/self/status"}

    def inside(path: str, roots: tuple[str, ...]) -> bool:
        return any(path == root or path.startswith(root + os.sep) for root in roots)

    def hook(event: str, args: tuple[Any, ...]) -> None:
        if event == "open":
            path, mode, flags = args
            if not isinstance(path, (str, bytes)):
                return
            real = os.path.realpath(os.fsdecode(path))
            writes = (isinstance(mode, str) and any(c in mode for c in "wax+")) or (
                isinstance(flags, int) and flags & (os.O_WRONLY | os.O_RDWR | os.O_CREAT | os.O_TRUNC | os.O_APPEND)
            )
            allowed = inside(real, (folder,)) if writes else inside(real, readable) and not inside(real, OURS)
            if not allowed and real not in devices:
                raise NotAllowedError(f"your function may not open {path!r}")
        elif event.startswith(ON_PATHS):
            if not all(
                inside(os.path.realpath(os.fsdecode(a)), (folder,)) for a in args if isinstance(a, (str, bytes))
            ):
                raise NotAllowedError(f"your function may not do {event} outside its folder")
        elif event.startswith(DENIED) and not (event == "ctypes.dlopen" and args[0] is None):
            raise NotAllowedError(f"your function may not do {event}")

    sys.addaudithook(hook)


class NoWorkbench:
    """Refuses to import the packages that hold the solutions."""

    def find_spec(self, name: str, path: object = None, target: object = None) -> None:
        """Raise for our packages, leave all others to the next finder."""
        if name.split(".")[0] in ("workbench", "lessons"):
            raise ImportError(f"{name} cannot be used here: write the function yourself")


def main() -> None:
    """Answer calls until the pipe closes."""
    pipe_in, pipe_out, folder = int(sys.argv[1]), int(sys.argv[2]), os.path.realpath(sys.argv[3])
    sys.path.insert(0, HERE)
    import ctypes  # noqa: F401 (numpy and scipy ask for it; afterwards it can open nothing)

    import wire  # type: ignore[import-not-found]

    sys.path.remove(HERE)
    sys.path[:] = [p for p in sys.path if p and os.path.realpath(p) != os.path.dirname(OURS[0])]
    sys.meta_path.insert(0, NoWorkbench())  # type: ignore[arg-type]
    pack, unpack, sizes = wire.pack, wire.unpack, wire.lengths
    limit(int(sys.argv[4]), int(sys.argv[5]))
    guard(folder)

    def read(count: int) -> bytes:
        parts = []
        while count:
            part = os.read(pipe_in, min(count, 1 << 20))
            if not part:
                os._exit(0)
            parts.append(part)
            count -= len(part)
        return b"".join(parts)

    def answer(message: bytes) -> None:
        data = memoryview(message)
        while data:
            data = data[os.write(pipe_out, data[: 1 << 20]) :]

    function: Callable[..., Any] | None = None
    while True:
        start = read(16)
        header_size, payload_size = sizes(start)
        header, payload = read(header_size), read(payload_size)
        request = unpack(header, payload)
        nonce = request["nonce"]
        try:
            if request["do"] == "load":
                function = load(request["source"], request["file"], request["name"])
                reply = pack({"nonce": nonce, "value": None, "changed": False})
            else:
                value = function(*request["args"], **dict(request["options"]))  # type: ignore[misc]
                reply = pack({"nonce": nonce, "value": value, "changed": pack(request) != start + header + payload})
        except BaseException as error:
            said = {"error": type(error).__name__, "message": _said(error), "line": _line(error, request["file"])}
            reply = pack({"nonce": nonce} | said)
        answer(reply)


def load(source: str, file: str, name: str) -> Callable[..., Any]:
    """Run the student's file and return the function asked for."""
    import types

    module = types.ModuleType("student")
    module.__file__ = file
    sys.modules["student"] = module
    exec(compile(source, file, "exec"), module.__dict__)
    function = module.__dict__.get(name)
    if not callable(function):
        raise NameError(f"the file defines no function {name}")
    return function


def _said(error: BaseException) -> str:
    try:
        return " ".join(str(error).split())[:500]
    except Exception:  # an exception whose own text fails
        return ""


def _line(error: BaseException, file: str) -> int:
    if isinstance(error, SyntaxError) and error.filename == file:
        return error.lineno or 0
    lines = [frame.lineno or 0 for frame in traceback.extract_tb(error.__traceback__) if frame.filename == file]
    return lines[-1] if lines else 0


if __name__ == "__main__":
    main()
