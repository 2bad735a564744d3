"""The error and the warning whose messages are written for the person at the keyboard."""

import difflib
from collections.abc import Iterable


def written_out(text: str) -> str:
    """Return text with its lines and tabs, and what else a terminal would obey written out
    (`\\x1b`).

    A message often quotes a name out of a file, and that file may be anybody's.
    """
    return "".join(
        sign if sign.isprintable() or sign in "\n\t" else repr(sign)[1:-1] for sign in text
    )


def one_line(text: str) -> str:
    """Return text on one line of signs that can be seen: what a terminal would obey is written out
    (`\\x1b`).
    """
    return written_out(" ".join(text.split()))


def not_among(name: str, known: Iterable[str]) -> str:
    """Return the end of a message about a name that is none: which one was perhaps meant, else
    which there are.
    """
    names = list(known)
    meant = difflib.get_close_matches(name[:80], names, n=3)
    meant += [
        other
        for other in names
        if other not in meant and other.replace("_", "") == name.replace("_", "")[:80]
    ]
    return (
        f"did you mean {' or '.join(meant)}?"
        if meant
        else f"there are: {', '.join(names) or 'none'}"
    )


class InputError(ValueError):
    """Something a person gave cannot be used; the message is one line that says what and how to
    mend it.

    Commands print it and exit with code 2; a live page shows it as a red caption and goes on.
    """

    def __init__(self, message: str):
        super().__init__(one_line(message))


class LeftOutWarning(UserWarning):
    """Something installed cannot be used and is left out; one line that says what, where it is, and
    why.
    """

    def __init__(self, message: str):
        super().__init__(one_line(message))


class AuthorError(InputError):
    """The code of a lesson or an exercise went wrong; the message names its file and line.

    Attributes:
        trace: The traceback, for whoever mends it.
    """

    def __init__(self, message: str, trace: str = ""):
        super().__init__(message)
        self.trace = trace
