"""A student's function as all who call it see it, wherever it runs."""

from typing import Any

from workbench.errors import InputError
from workbench.exercise.submission import Submission


class StudentError(InputError):
    """The student's function gave no result; the message says what happened and where.

    Args:
        kind: `raised`, `timeout`, `died`, `result` (what came back is no value) or `load`.
        error: The name of the exception that was raised, if one was.
        line: The student's own line, 0 where it is not known.
        errors: The names of the exception's class and of the classes it is one of.
    """

    def __init__(
        self,
        message: str,
        kind: str,
        error: str = "",
        *,
        line: int = 0,
        errors: tuple[str, ...] = (),
    ):
        super().__init__(message)
        self.kind = kind
        self.error = error
        self.line = line
        self.errors = errors or (error,)


class StudentFunction:
    """A student's function; called, it returns plain values or raises StudentError.

    Args:
        submission: What was read of the student's file.
        name: The function's name.

    Attributes:
        wall: What shuts it in; None where nothing does.
        changed_inputs: Whether the last call changed what it was given.
    """

    wall: Any = None

    def __init__(self, submission: Submission, name: str):
        self.submission = submission
        self.name = self.__name__ = name
        self.changed_inputs = False

    @property
    def source(self) -> str:
        """The text that is run."""
        return self.submission.source

    def __call__(self, *args: Any, **options: Any) -> Any:
        """Return what the student's function returns for these arguments, as plain values.

        Raises:
            StudentError: If it gave no result.
        """
        raise NotImplementedError

    def start(self) -> None:
        """Load the student's file.

        Raises:
            StudentError: If it does not load or lacks the function.
        """
        raise NotImplementedError

    def printed(self) -> str:
        """Return the beginning of what the student's code printed."""
        raise NotImplementedError

    def raised(self, reply: dict[str, Any], *, loading: bool) -> StudentError:
        """Return in words for the student what was raised.

        Args:
            reply: As `child.main.told` tells of an exception.
            loading: Whether it was raised while the file was loaded.
        """
        error = str(reply["error"])[:80]
        message = str(reply.get("message", ""))[:500]
        names = reply.get("errors")
        line = reply.get("line")
        errors = tuple(str(name)[:80] for name in names[:12]) if isinstance(names, list) else ()
        line = line if isinstance(line, int) and not isinstance(line, bool) else 0
        where = f"{self.submission.file}, line {line}: " if line else f"{self.submission.file}: "
        if loading:
            return StudentError(
                f"{where}the file does not load: {error}: {message}", "load", error, line=line
            )
        if error == "WireError":
            return StudentError(
                f"{where}{self.name} returned what is no result: {message}", "result", "", line=line
            )
        if error == "NotImplementedError":
            return StudentError(
                f"{where}{self.name} is not written yet", "raised", error, line=line
            )
        message = f"{where}{self.name} raised {error}" + (f": {message}" if message else "")
        return StudentError(message, "raised", error, line=line, errors=errors)
