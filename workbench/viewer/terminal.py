"""Tells whoever runs the server what went wrong in a lesson, once."""

import sys
import threading
import traceback

from workbench.errors import AuthorError, InputError, written_out

_told: set[str] = set()
_lock = threading.Lock()


def tell_terminal(error: Exception) -> None:
    """Write an error of a lesson's or our own code to stderr with its traceback, each once; a
    person's input is not told.
    """
    if isinstance(error, InputError) and not isinstance(error, AuthorError):
        return
    with _lock:
        if str(error) in _told:
            return
        _told.add(str(error))
    trace = (
        error.trace
        if isinstance(error, AuthorError)
        else "".join(traceback.format_exception(error))
    )
    sys.stderr.write(written_out(f"{trace}workbench: {error}\n"))
    sys.stderr.flush()
