"""Calls a function under test, holds its results to the contract, remembers every call."""

import builtins
import functools
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from workbench.exercise.model import Function, number
from workbench.exercise.student import StudentError

MOST_SHOWN = 12
"""How many numbers a call may have that is shown to the student."""
LARGEST = 1e60
"""How large a number of an answer may be, where the right ones are no larger than 1: squares and
products of three such numbers are finite still, so that no check takes an overflow for a small
distance.
"""


@dataclass(frozen=True, eq=False)
class Returned:
    """What a function said to a call: its value, or None and the name of the error."""

    value: Any
    error: str


@dataclass(frozen=True, eq=False)
class Call:
    """One call of a candidate: its arguments, its answer, and ours.

    Attributes:
        args: The arguments.
        answer: The candidate's answer.
        right: Ours.
    """

    args: tuple[Any, ...]
    answer: Returned
    right: Returned

    @functools.cached_property
    def key(self) -> tuple[Any, ...]:
        """The arguments as what can be looked up: arrays as (shape, type, bytes)."""
        return tuple(
            (arg.shape, arg.dtype.str, arg.tobytes()) if isinstance(arg, np.ndarray) else arg
            for arg in self.args
        )


class Candidate:
    """A function held to the reference's shape, kind and finiteness, else a StudentError.

    Args:
        function: The student's function in its process, or one of ours (a mistake, an alternative).
        remember: Whether calls are kept, to recognise mistakes by; a run that is watched needs
            none.
    """

    def __init__(self, function: Function, reference: Function, *, remember: bool = True):
        self.function, self._reference, self._remember = function, reference, remember
        self.calls: list[Call] = []
        self.changing: list[tuple[Any, ...]] = []
        """The arguments of the calls that changed them."""
        self.looks_at_inputs = False
        """Whether a check asked that inputs stay as they are."""
        self.expected: Any = None
        """What the reference answers to the last call; None where it raises."""
        self._changed = False
        self.__name__ = getattr(reference, "__name__", "candidate")

    def __call__(self, *args: Any) -> Any:
        """Return the function's answer as plain float64, int64 or bool values.

        Raises:
            StudentError: If it gave no answer, or one of another shape or kind than the contract
                says.
        """
        right = self._right(args)
        self.expected = right.value
        given = _copied(args)
        self._changed = False
        try:
            with np.errstate(all="ignore"):
                value = self.function(*given)
        except StudentError as error:
            self._keep(args, Returned(None, _known(error.errors) or error.kind), right)
            raise
        except Exception as error:  # one of our own functions, which may be wrong on purpose
            self._keep(args, raised(error), right)
            name = type(error).__name__
            names = tuple(kind.__name__ for kind in type(error).__mro__)
            raise StudentError(
                f"{self.__name__} raised {name}: {error}", "raised", name, errors=names
            ) from None
        self._keep(args, Returned(value, ""), right)
        pairs = zip(args, given, strict=True)
        self._changed = any(
            isinstance(arg, np.ndarray) and arg.tobytes() != after.tobytes() for arg, after in pairs
        )
        if self.changed_inputs:
            self.changing.append(args)
        try:
            return held_to_contract(value, right.value, self.__name__)
        except StudentError as error:
            raise StudentError(f"{error}{_asked(args)}", error.kind) from None

    @property
    def changed_inputs(self) -> bool:
        """Whether the last call changed what it was given."""
        return self._changed or bool(getattr(self.function, "changed_inputs", False))

    def _keep(self, args: tuple[Any, ...], answer: Returned, right: Returned) -> None:
        if self._remember:
            self.calls.append(Call(args, answer, right))

    def _right(self, args: tuple[Any, ...]) -> Returned:
        """Ours; None and an error on input for which the contract asks for one."""
        try:
            with np.errstate(all="ignore"):
                return Returned(self._reference(*_copied(args)), "")
        except Exception as error:
            return raised(error)


def raised(error: Exception) -> Returned:
    """Return what a function said that raised this: Python's own error that it is one of."""
    return Returned(None, _known(kind.__name__ for kind in type(error).__mro__))


def _known(names: Iterable[str]) -> str:
    names = list(names)
    return next((name for name in names if hasattr(builtins, name)), names[0])


def _copied(args: tuple[Any, ...]) -> tuple[Any, ...]:
    return tuple(np.array(arg, copy=True) if isinstance(arg, np.ndarray) else arg for arg in args)


def held_to_contract(value: Any, expected: Any, name: str) -> Any:
    """Return a value as plain float64, int64 or bool, of the expected shape and kind.

    Raises:
        StudentError: Says what came and what the contract asks for.
    """
    if expected is None:
        return value
    if isinstance(expected, (tuple, list)):
        value = _as_values(value, expected)
        if not isinstance(value, (tuple, list)) or len(value) != len(expected):
            raise StudentError(
                f"{name} returned {_kind(value)}; the contract asks for {len(expected)} values",
                "result",
            )
        return tuple(
            held_to_contract(v, e, f"{name}[{i}]")
            for i, (v, e) in enumerate(zip(value, expected, strict=True))
        )
    wanted = np.asarray(expected)
    if value is None or isinstance(value, str):
        raise StudentError(
            f"{name} returned {_kind(value)}; the contract asks for {_kind(expected)}. Is a return"
            " missing?",
            "result",
        )
    try:
        got = np.asarray(value)
    except ValueError:
        raise StudentError(
            f"{name} returned rows of unequal length; the contract asks for {_kind(expected)}",
            "result",
        ) from None
    if got.shape != wanted.shape:
        raise StudentError(
            f"{name} returned {_kind(value)}; the contract asks for {_kind(expected)}", "result"
        )
    if got.dtype.kind not in "biuf" or (wanted.dtype.kind in "iu" and got.dtype.kind not in "iu"):
        raise StudentError(
            f"{name} returned {got.dtype} values; the contract asks for {_kind(expected)}", "result"
        )
    if wanted.dtype.kind == "b" and got.dtype.kind != "b":
        raise StudentError(
            f"{name} returned {got.dtype} values; the contract asks for true or false", "result"
        )
    plain = got.astype(
        {"b": np.bool_, "i": np.int64, "u": np.int64}.get(wanted.dtype.kind, np.float64)
    )
    if wanted.dtype.kind == "f":
        _must_be_judgeable(plain, wanted, name)
    return plain if isinstance(expected, np.ndarray) else plain.item()


def _as_values(value: Any, expected: Sequence[Any]) -> Any:
    """Return an array with a part for each value asked for as these parts."""
    if not isinstance(value, np.ndarray) or value.shape[:1] != (len(expected),):
        return value
    whole = [np.asarray(wanted).dtype.kind in "iu" for wanted in expected]
    counted = [value.dtype.kind == "f" and bool((np.mod(part, 1) == 0).all()) for part in value]
    pairs = zip(value, whole, counted, strict=True)
    return [
        part.astype(np.int64) if asked and is_whole else part for part, asked, is_whole in pairs
    ]


def _must_be_judgeable(got: np.ndarray, wanted: np.ndarray, name: str) -> None:
    """Raise StudentError where a number is not finite, or too large, and should not be."""
    known = np.isfinite(wanted)
    finite = np.isfinite(got)
    most = LARGEST * np.abs(wanted[known]).max(initial=1.0)
    if known.all() and not finite.all():
        strange = ~finite
        asked = "finite numbers"
        returned = f"{got}" if got.ndim == 0 else f"{strange.sum()} of {got.size} values not finite"
    elif np.abs(got[finite]).max(initial=0.0) > most:
        strange = finite & (np.abs(got) > most)
        asked = "numbers that can be computed with"
        returned = (
            f"{got}"
            if got.ndim == 0
            else f"{strange.sum()} of {got.size} values too large to be judged"
        )
    else:
        return
    at = tuple(int(i) for i in np.argwhere(strange)[0])
    where = f"[{', '.join(map(str, at))}]" if at else "yours"
    sentence = f"the contract asks for {asked}. {where} is {got[at]}, right is {number(wanted[at])}"
    raise StudentError(f"{name} returned {returned}; {sentence}", "result")


def _asked(args: tuple[Any, ...]) -> str:
    """Return what was asked, where that is short."""
    sizes = [np.size(arg) for arg in args]
    if not 0 < sum(sizes) <= MOST_SHOWN:
        return ""
    rows = [number(arg) if isinstance(arg, (np.ndarray, float, int)) else repr(arg) for arg in args]
    return f" (asked for {', '.join(rows)})"


def _kind(value: Any) -> str:
    if value is None:
        return "nothing"
    if isinstance(value, np.ndarray) and value.ndim:
        entries = {"b": "true or false", "i": "whole numbers", "u": "whole numbers"}.get(
            value.dtype.kind, "numbers"
        )
        return f"an array {value.shape} of {entries}"
    if isinstance(value, (list, tuple)):
        return f"{len(value)} values"
    known = (
        (str, "a text"),
        ((bool, np.bool_), "true or false"),
        ((int, np.integer), "a whole number"),
    )
    return next((kind for kinds, kind in known if isinstance(value, kinds)), "a number")
