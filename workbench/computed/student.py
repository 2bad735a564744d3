"""A student's function in the process that calls it: in a browser's worker, which is the student's
own and has no other process. It answers and fails in the words of the sandboxed one.
"""

import builtins
import contextlib
import io
from collections.abc import Callable
from typing import Any

from workbench.errors import InputError
from workbench.exercise.child.main import load, told
from workbench.exercise.child.reading import UnreadableError, read
from workbench.exercise.child.wire import lengths, pack, unpack
from workbench.exercise.student import StudentFunction
from workbench.exercise.submission import Submission, submission

OURS = ("workbench", "lessons")
MOST_PRINTED = 8000
"""Characters that are kept of what a student's code prints."""


def read_in_place(file: str, text: str) -> Submission:
    """Return what a student's text is, read without a process of its own.

    Raises:
        InputError: If it is no Python, with the line; or is no text.
    """
    submitted = submission(file, text.encode(), lambda name: None, reader=_InPlaceReader())
    if submitted.broken:
        raise InputError(submitted.broken)
    return submitted


class _InPlaceReader:
    def read(self, file: str, content: bytes) -> dict[str, Any]:
        try:
            return read(file, content)
        except UnreadableError as error:
            raise InputError(str(error)) from None


class _Kept(io.TextIOBase):
    """Keeps the beginning of what is written."""

    def __init__(self) -> None:
        self.text = ""

    def write(self, text: str) -> int:
        self.text += text[: MOST_PRINTED - len(self.text)]
        return len(text)


class InPlaceFunction(StudentFunction):
    """A student's function, called here. A call that does not return holds up whoever called it."""

    def __init__(self, given: Submission, name: str):
        super().__init__(given, name)
        self._function: Callable[..., Any] | None = None
        self._printed = _Kept()

    def start(self) -> None:
        """Load the student's text anew.

        Raises:
            StudentError: If it does not load or lacks the function.
        """
        self._function = None
        file = self.submission.file
        try:
            with self._heard():
                self._function = load(
                    self.source, file, self.name, modules={}, names=builtins_of_students()
                )
        except BaseException as error:
            raise self.raised(told(error, file), loading=True) from None

    def __call__(self, *args: Any, **options: Any) -> Any:
        """Return what the student's function returns for these arguments, as plain values.

        Raises:
            StudentError: If it raised, or returned no value.
        """
        if self._function is None:
            self.start()
        assert self._function is not None
        asked = {"args": list(args), "options": list(options.items())}
        before = pack(asked)
        own = _values(before)  # as in a process of its own: what it changes is not the caller's
        try:
            with self._heard():
                value = self._function(*own["args"], **dict(own["options"]))
            self.changed_inputs = pack(own) != before
            return _values(pack({"value": value}))["value"]
        except BaseException as error:
            raise self.raised(told(error, self.submission.file), loading=False) from None

    def printed(self) -> str:
        """Return the beginning of what the student's code printed."""
        return self._printed.text

    @contextlib.contextmanager
    def _heard(self) -> Any:
        with contextlib.redirect_stdout(self._printed), contextlib.redirect_stderr(self._printed):
            yield


def builtins_of_students() -> dict[str, Any]:
    """Return Python's own names, with an import that refuses the workbench, as in a class's grader.

    It is a rule, and no wall: the student's own browser is all that runs the text.
    """

    def import_(name: str, *more: Any, **options: Any) -> Any:
        top = name.partition(".")[0]
        if top in OURS:
            raise ModuleNotFoundError(f"{top} cannot be used here: write the function yourself")
        return builtins.__import__(name, *more, **options)

    return {**vars(builtins), "__import__": import_}


def _values(message: bytes) -> dict[str, Any]:
    header, _ = lengths(message[:16])
    return unpack(message[16 : 16 + header], message[16 + header :])
