"""Notes which params a function reads, and keeps its values by just these.

A function that reads `params.seed` and nothing else gives the same value for all params with that
seed. `cached` finds out by itself: it hands the function the params in a guise that notes every
field that is read. Params with the same values in the fields read lead to the value kept. So a
function keeps its value while a knob is turned that it does not read. A file that a field names is
part of its value: when it has changed, the function is called again.
"""

import dataclasses
import functools
import inspect
import threading
from collections import OrderedDict
from collections.abc import Callable, Hashable, Mapping
from pathlib import Path
from typing import Any, Concatenate, ParamSpec, TypeVar, overload

from workbench.errors import AuthorError
from workbench.scene import arrays
from workbench.tracing import untraced

P = TypeVar("P")
V = TypeVar("V")
Rest = ParamSpec("Rest")

Note = Callable[[str], object]
"""What is told the name of each field that is read."""

Values = Mapping[str, Hashable]
"""The values of params by the names of their fields."""


def watched(params: P, note: Note) -> P:
    """Return the params in a guise that tells `note` the name of each field that is read from it.

    It is equal to the params, has their class and methods, and can be hashed, pickled and copied as
    they can. Each of these reads all fields.
    """
    kind = type(plain(params))
    guise = object.__new__(_guise(kind))
    outer = reader(params)
    notes = note if outer is None else _both(outer, note)
    object.__getattribute__(guise, "__dict__").update(_plain=plain(params), _note=notes)
    return guise


def plain(params: P) -> P:
    """Return the params themselves, out of their guise; reads nothing."""
    if isinstance(params, Guise):
        return object.__getattribute__(params, "_plain")
    return params


def reader(params: Any) -> Note | None:
    """Return what is told of every field read from these params, None where nobody watches."""
    return object.__getattribute__(params, "_note") if isinstance(params, Guise) else None


class Guise:
    """The mark of params that are watched."""


def _both(first: Note, second: Note) -> Note:
    def note(name: str) -> None:
        first(name)
        second(name)

    return note


@functools.lru_cache(maxsize=256)
def _guise(kind: type) -> type:
    """Return the class of watched params of a kind."""
    names = tuple(field.name for field in dataclasses.fields(kind))
    known = frozenset(names)

    def bare(guise: Any) -> Any:
        note = object.__getattribute__(guise, "_note")
        for name in names:
            note(name)
        return object.__getattribute__(guise, "_plain")

    class Watched(Guise, kind):  # type: ignore[misc,valid-type]
        def __new__(
            cls, *args: Any, **values: Any
        ) -> Any:  # `type(params)(...)` makes plain params
            return kind(*args, **values)

        def __getattribute__(self, name: str) -> Any:
            if name in known:
                object.__getattribute__(self, "_note")(name)
                return getattr(object.__getattribute__(self, "_plain"), name)
            if name == "__class__":
                return kind
            return object.__getattribute__(bare(self) if name == "__dict__" else self, name)

        def __eq__(self, other: object) -> Any:
            return bare(self) == plain(other)

        def __hash__(self) -> int:
            return hash(bare(self))

        def __repr__(self) -> str:
            return repr(object.__getattribute__(self, "_plain"))

        def __reduce_ex__(self, protocol: Any) -> Any:
            return bare(self).__reduce_ex__(protocol)

    Watched.__name__, Watched.__qualname__ = kind.__name__, kind.__qualname__
    Watched.__module__ = kind.__module__
    return Watched


@overload
def cached(function: Callable[Concatenate[P, Rest], V], /) -> Callable[Concatenate[P, Rest], V]: ...


@overload
def cached(
    *, most: int
) -> Callable[[Callable[Concatenate[P, Rest], V]], Callable[Concatenate[P, Rest], V]]: ...


def cached(function: Any = None, /, *, most: int = 32) -> Any:
    """Keep the values of a function of params by the fields that it reads.

    The `most` values that were used last are kept. What else the function takes is part of the key
    and can be hashed. Arrays in a value become read-only. A function that fails is called again.
    Two threads that ask at once may both compute.

    Raises:
        TypeError: If the function is a generator: its states could be walked through only once.
        AuthorError: When params are read after the function has returned, because its value holds
            on to them: such a read could not be noted. Keep what is needed of them.
    """
    if function is None:
        return functools.partial(cached, most=most)
    if inspect.isgeneratorfunction(function):
        raise TypeError(
            f"{function.__qualname__} yields; @cached is for a function that returns its value"
        )
    kept = _Kept(most)

    @functools.wraps(function)
    def wrapper(params: Any, *rest: Any, **named: Any) -> Any:
        bare, outer = plain(params), reader(params)
        values = _values_of(bare)
        others = (type(bare), rest, tuple(sorted(named.items())))
        entry = kept.find(values, others)
        if entry is None:
            reads = _Reads(function)
            try:
                with untraced():  # where the value was kept, nothing is reported either
                    value = function(watched(bare, reads.note), *rest, **named)
            finally:
                reads.closed = True
                _tell(outer, reads.names)
            for array in arrays(value):
                array.setflags(write=False)
            kept.keep(values, others, tuple(sorted(reads.names)), value=value)
            return value
        names, value = entry
        _tell(outer, names)
        return value

    wrapper.forget = kept.forget  # type: ignore[attr-defined]
    return wrapper


def _values_of(params: Any) -> dict[str, Hashable]:
    """Return the values of all fields; with a file's, when it was changed and its size."""
    values = {}
    for field in dataclasses.fields(params):
        value = getattr(params, field.name)
        values[field.name] = (value, _stamp(value)) if isinstance(value, Path) else value
    return values


def _stamp(path: Path) -> tuple[int, int] | None:
    try:
        stat = path.stat()
    except OSError:  # whoever reads it says so
        return None
    return stat.st_mtime_ns, stat.st_size


def _tell(note: Note | None, names: Any) -> None:
    if note is not None:
        for name in names:
            note(name)


class _Reads:
    """The fields that one call reads."""

    def __init__(self, function: Callable):
        self.names = set[str]()
        self.closed = False
        self._function = function

    def note(self, name: str) -> None:
        if self.closed and name not in self.names:
            which = self._function.__qualname__
            late = f"{name} is read from them later, which {which} did not read"
            raise AuthorError(
                f"{which} is cached, and its value holds on to params: {late}; "
                "keep what is needed of them in place of the params"
            )
        self.names.add(name)


class _Kept:
    """The values of one function, least recently used ones dropped."""

    def __init__(self, most: int):
        self._values: OrderedDict[Hashable, Any] = OrderedDict()
        self._read: dict[tuple[str, ...], None] = {}  # each set of fields that some call has read
        self._lock = threading.Lock()
        self._most = most

    def find(self, values: Values, others: Hashable) -> tuple[tuple[str, ...], Any] | None:
        with self._lock:
            for names in self._read:
                key = self._key(values, others, names)
                if key in self._values:
                    self._values.move_to_end(key)
                    return names, self._values[key]
        return None

    def keep(self, values: Values, others: Hashable, names: tuple[str, ...], *, value: Any) -> None:
        with self._lock:
            self._read[names] = None
            self._values[self._key(values, others, names)] = value
            while len(self._values) > self._most:
                self._values.popitem(last=False)

    def forget(self) -> None:
        with self._lock:
            self._values.clear()
            self._read.clear()

    @staticmethod
    def _key(values: Values, others: Hashable, names: tuple[str, ...]) -> Hashable:
        return others, names, tuple(values[name] for name in names)
