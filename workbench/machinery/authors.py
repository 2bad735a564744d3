"""Says where an author's code went wrong: one line for people, a traceback for terminals."""

import inspect
import sysconfig
import traceback
from pathlib import Path
from types import TracebackType

from workbench.errors import AuthorError, InputError

_OURS = (
    str(Path(__file__).parents[1]),
    sysconfig.get_path("stdlib"),
    sysconfig.get_path("purelib"),
    "<",
)


class Blaming:
    """A block of somebody's code: what it raises becomes an AuthorError with file and line.

    What is an InputError already goes through, and so does the end of an iterator; `sys.exit()`
    ends its own run only.

    Args:
        who: Whose code it is, in words that begin the line: "lesson icp".
        function: The innermost line beside this function's file is named.
    """

    def __init__(self, who: str, function: object = None):
        self._who, self._function = who, function

    def __enter__(self) -> None:
        pass

    def __exit__(
        self, kind: object, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        if isinstance(error, Exception | SystemExit) and not isinstance(
            error, InputError | StopIteration
        ):
            told = "".join(traceback.format_exception(error))
            raise AuthorError(f"{self._who}: {described(error, self._function)}", told) from error


def described(error: BaseException, function: object = None) -> str:
    """Return an error as one line: where, of what kind, what it says, and its line of code."""
    message = " ".join((error.msg if isinstance(error, SyntaxError) else str(error)).split())
    kind = type(error).__name__ + (f": {message[:300]}" if message else "")
    if isinstance(error, SyntaxError) and error.filename:
        return f"{place(error.filename, error.lineno or 1)}: {kind}"
    frames = traceback.extract_tb(error.__traceback__)
    folder = str(Path(defined(function)[0]).parent) if defined(function)[0] else None
    beside = [f for f in frames if folder and _within(f.filename, folder)]
    others = [f for f in frames if not is_ours(f.filename)]
    if not (beside or others):
        return f"{at(function)}{kind}"
    frame = (beside or others)[-1]
    code = f" in `{frame.line[:80]}`" if frame.line else ""
    return f"{place(frame.filename, frame.lineno or 1)}: {kind}{code}"


def is_ours(file: str) -> bool:
    """Tell whether a file is of the workbench, of Python or of a library."""
    return file.startswith(_OURS)


def at(function: object) -> str:
    """Return where a function is defined, as the beginning of a line; nothing if not known."""
    file, line = defined(function)
    return f"{place(file, line)}: " if file else ""


def place(file: str, line: int) -> str:
    """Return a place in a file as people read it: the file with its folder, and the line."""
    return f"{'/'.join(Path(file).parts[-2:])}, line {line}"


def defined(function: object) -> tuple[str, int]:
    """Return the file and line of a function's or module's definition, or ("", 0)."""
    if inspect.ismodule(function):
        return function.__file__ or "", 1
    code = getattr(inspect.unwrap(function), "__code__", None) if callable(function) else None
    return (code.co_filename, code.co_firstlineno) if code is not None else ("", 0)


def _within(file: str, folder: str) -> bool:
    return file.startswith(folder) and "site-packages" not in file[len(folder) :]
