"""Watches where an algorithm stands each time it yields: its line, and its local variables.

A suspended generator knows its line and its locals. `traced` keeps them at every yield, but only
while somebody listens (`listening`), so an algorithm that nobody watches pays one attribute test
per step; they are put into words when the listener asks.
"""

import functools
import inspect
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any, NamedTuple, ParamSpec, TypeVar

import numpy as np

Options = ParamSpec("Options")
State = TypeVar("State")


@dataclass(frozen=True)
class Variable:
    """One local variable as a reader sees it: its name, its shape or type, and its value or
    range.
    """

    name: str
    shape: str
    value: str


@dataclass(frozen=True)
class Moment:
    """Where a generator stood when it yielded: the function, the line, the locals in order of
    definition.
    """

    function: Callable[..., Any]
    line: int
    variables: tuple[Variable, ...]

    @property
    def source(self) -> tuple[tuple[str, ...], int]:
        """The function's source lines without its decorators, and the number of the first of them
        in its file.
        """
        return source_of(self.function)


@functools.lru_cache(maxsize=256)
def source_of(function: Callable[..., Any]) -> tuple[tuple[str, ...], int]:
    """Return the source lines of a function without decorators, dedented, and the file line of the
    first.
    """
    lines, first = inspect.getsourcelines(function)
    skip = next(
        (i for i, line in enumerate(lines) if line.lstrip().startswith(("def ", "async def "))), 0
    )
    kept = lines[skip:]
    indent = len(kept[0]) - len(kept[0].lstrip())
    return tuple(line[indent:].rstrip("\n") if line.strip() else "" for line in kept), first + skip


class _Listener(threading.local):
    """Who yielded last in this thread, and whether anybody wants to know."""

    on = False
    yielded: object = None
    standing: "_Standing | None" = None


class _Standing(NamedTuple):
    """Where a generator stands: the function, the line, the values of its locals."""

    function: Callable[..., Any]
    line: int
    values: dict[str, Any]

    def in_words(self) -> Moment:
        variables = tuple(describe(name, value) for name, value in self.values.items())
        return Moment(self.function, self.line, variables)


_listener = _Listener()


@contextmanager
def listening() -> Iterator[Callable[[], Moment | None]]:
    """Record moments in this thread for the length of the block; the value returns the last one."""
    before = (_listener.on, _listener.yielded, _listener.standing)
    _listener.on = True
    _listener.yielded = None
    _listener.standing = None
    try:
        yield lambda: _listener.standing and _listener.standing.in_words()
    finally:
        _listener.on, _listener.yielded, _listener.standing = before


@contextmanager
def untraced() -> Iterator[None]:
    """Record nothing in this thread for the length of the block: for runs inside a run whose lines
    nobody looks at.
    """
    before = _listener.on
    _listener.on = False
    try:
        yield
    finally:
        _listener.on = before


def traced(algorithm: Callable[Options, Iterator[State]]) -> Callable[Options, Iterator[State]]:
    """Let whoever listens know the line and the locals of this generator function at each of its
    yields.

    Where one traced generator passes on what another yielded, the inner one, which did the work, is
    reported.
    """

    @functools.wraps(algorithm)
    def wrapper(*args: Options.args, **kwargs: Options.kwargs) -> Iterator[State]:
        generator = algorithm(*args, **kwargs)
        for state in generator:
            if _listener.on and _listener.yielded is not state:
                _listener.yielded = state
                _listener.standing = _standing(generator, algorithm)
            yield state

    return wrapper


def moment_of(generator: Any, function: Callable[..., Any]) -> Moment | None:
    """Return where a suspended generator stands, or None when it has finished."""
    standing = _standing(generator, function)
    return standing and standing.in_words()


def _standing(generator: Any, function: Callable[..., Any]) -> _Standing | None:
    frame = getattr(generator, "gi_frame", None)
    return None if frame is None else _Standing(function, frame.f_lineno, dict(frame.f_locals))


def describe(name: str, value: object) -> Variable:
    """Say what a variable holds in a few words: an array by shape and range, a number by value."""
    if isinstance(value, np.ndarray):
        shape = " × ".join(map(str, value.shape)) or "scalar"
        if value.size == 0:
            return Variable(name, shape, "empty")
        if value.ndim == 0 or value.size <= 4:
            return Variable(
                name, shape, _short(np.array2string(value, precision=4, separator=", "))
            )
        if value.dtype == bool:
            return Variable(name, shape, f"{int(value.sum()):,} of {value.size:,} true")
        if value.dtype.kind in "iuf":
            return Variable(name, shape, f"{_number(value.min())} … {_number(value.max())}")
        return Variable(name, shape, str(value.dtype))
    if isinstance(value, bool) or value is None:
        return Variable(name, type(value).__name__, str(value))
    if isinstance(value, (int, float, np.number)):
        return Variable(name, "number", _number(value))
    if isinstance(value, (list, tuple, dict, set)):
        return Variable(name, type(value).__name__, f"{len(value):,} items")
    if isinstance(value, str):
        return Variable(name, "text", _short(repr(value)))
    if callable(value):
        return Variable(name, "function", getattr(value, "__name__", type(value).__name__))
    return Variable(name, type(value).__name__, "")


def _number(value: Any) -> str:
    return f"{value:,}" if isinstance(value, (int, np.integer)) else f"{float(value):.5g}"


def _short(text: str, most: int = 60) -> str:
    text = " ".join(text.split())
    return text if len(text) <= most else text[: most - 1] + "…"
