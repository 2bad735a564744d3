"""The student's side of the pipe: started as `python -I -S -B child.py SETTINGS`.

It bounds itself (`lockdown`), then loads the student's source and answers calls. It holds no
expected answer, check or seed: those stay with the grader. What the student's code does to this
process it does to itself: what comes out of the pipe is read as bytes of somebody else.
"""

import io
import json
import os
import sys
import traceback
import types
from collections.abc import Callable
from importlib.machinery import ModuleSpec, PathFinder
from typing import Any

Message = dict[str, Any]


class Allowed:
    """Imports the packages that may be used, by the folder of each; refuses ours with a reason.

    Args:
        places: By package, the folder that holds its folder.
    """

    def __init__(self, places: dict[str, str]):
        self._places = places

    def find_spec(self, name: str, path: object = None, target: object = None) -> ModuleSpec | None:
        """Return the spec of a package that may be used."""
        if name in ("workbench", "lessons"):
            raise ModuleNotFoundError(f"{name} cannot be used here: write the function yourself")
        return PathFinder.find_spec(name, [self._places[name]]) if name in self._places else None


class Beside:
    """Imports the modules, text by name, that were handed in beside the student's file.

    Args:
        sources: Their text by name.
    """

    def __init__(self, sources: dict[str, str]):
        self._sources = sources

    def find_spec(self, name: str, path: object = None, target: object = None) -> ModuleSpec | None:
        """Return the spec of a module that was handed in."""
        return ModuleSpec(name, self, origin=f"{name}.py") if name in self._sources else None  # type: ignore[arg-type]

    def create_module(self, spec: ModuleSpec) -> None:
        """Leave it to Python."""

    def exec_module(self, module: types.ModuleType) -> None:
        """Run its text."""
        name = module.__name__
        module.__file__ = f"{name}.py"
        exec(compile(self._sources[name], f"{name}.py", "exec"), module.__dict__)


class Kept(io.RawIOBase):
    """Writes the first `most` bytes and drops the rest: who prints too much loses the output only.

    Args:
        most: How many bytes are kept.
    """

    def __init__(self, most: int):
        self._left = most

    def writable(self) -> bool:
        """Return that it is."""
        return True

    def write(self, data: Any) -> int:
        """Take all of it."""
        data = bytes(data)
        kept = data[: self._left]
        self._left -= len(kept)
        try:
            os.write(1, kept) if kept else None
        except OSError:  # full, or closed by the student
            self._left = 0
        return len(data)


def main() -> None:
    """Answer calls until the pipe closes."""
    settings = json.loads(sys.argv[1])
    pipe_in, pipe_out = settings["in"], settings["out"]
    here = os.path.dirname(os.path.abspath(__file__))
    sys.path.insert(0, here)
    import lockdown  # type: ignore[import-not-found]

    sys.meta_path.append(Allowed(settings["packages"]))  # type: ignore[arg-type]
    import wire  # type: ignore[import-not-found]

    sys.path.remove(here)
    pack, unpack, sizes = wire.pack, wire.unpack, wire.lengths
    sys.argv[1:] = []
    sys.stdout = sys.stderr = io.TextIOWrapper(
        io.BufferedWriter(Kept(settings["output"])),
        "utf-8",
        "backslashreplace",
        line_buffering=True,
    )
    lockdown.shut(settings)

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
        reply: Message = {"nonce": request["nonce"]}
        try:
            if request["do"] == "load":
                function = load(
                    request["source"],
                    request["file"],
                    request["name"],
                    modules=dict(request["modules"]),
                )
            elif request["do"] == "call":
                value = function(*request["args"], **dict(request["options"]))  # type: ignore[misc]
                reply |= {"value": value, "changed": pack(request) != start + header + payload}
            message = pack(reply)
        except BaseException as error:
            message = pack({"nonce": request["nonce"]} | told(error, request["file"]))
        flush()
        answer(message)


def load(
    source: str,
    file: str,
    name: str,
    *,
    modules: dict[str, str],
    names: dict[str, Any] | None = None,
) -> Callable[..., Any]:
    """Run the student's file and return the function asked for; `names` are its builtins."""
    module = types.ModuleType("student")
    module.__file__ = file
    if names is not None:
        module.__dict__["__builtins__"] = names
    sys.modules["student"] = module
    sys.meta_path.insert(0, Beside(modules))  # type: ignore[arg-type]
    exec(compile(source, file, "exec"), module.__dict__)
    function = module.__dict__.get(name)
    if not callable(function):
        raise NameError(f"the file defines no function {name}")
    return function


def flush() -> None:
    """Let what was printed be seen before the answer is."""
    for stream in (sys.stdout, sys.stderr):
        try:
            stream.flush()
        except Exception:  # the student put something else there
            continue


def told(error: BaseException, file: str) -> Message:
    """Return what the grader is told of an exception: names, text, the student's line."""
    names = [kind.__name__ for kind in type(error).__mro__[:12]]
    return {"error": names[0], "errors": names, "message": _said(error), "line": _line(error, file)}


def _said(error: BaseException) -> str:
    try:
        return " ".join(str(error).split())[:500]
    except Exception:  # an exception whose own text fails
        return ""


def _line(error: BaseException, file: str) -> int:
    if isinstance(error, SyntaxError) and error.filename == file:
        return error.lineno or 0
    lines = [
        frame.lineno or 0
        for frame in traceback.extract_tb(error.__traceback__)
        if frame.filename == file
    ]
    return lines[-1] if lines else 0


if __name__ == "__main__":
    main()
