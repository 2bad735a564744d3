"""Names of params in messages: labels on a page, flags in a command."""

import contextlib
import re
from collections.abc import Iterator
from contextvars import ContextVar

from workbench.knobs.fields import fields_of

_CALLED = re.compile(r"“(\w+)”")
_flags: ContextVar[bool] = ContextVar("flags", default=False)


def called(name: str) -> str:
    """Return the name of a param for a message, in marks by which a page puts its label there, a
    command its flag.
    """
    return f"“{name}”"


@contextlib.contextmanager
def called_by_flags() -> Iterator[None]:
    """Let messages in this block name params as a command line does."""
    before = _flags.set(True)
    try:
        yield
    finally:
        _flags.reset(before)


def in_words(message: str, params: type) -> str:
    """Return a message with the names of params (`called`) as people see them: labels, or flags in
    `called_by_flags`.
    """
    labels = {field.name: field.label for field in fields_of(params)}

    def name(match: re.Match) -> str:
        if match[1] not in labels:
            return match[0]
        return "--" + match[1].replace("_", "-") if _flags.get() else called(labels[match[1]])

    return _CALLED.sub(name, message)
