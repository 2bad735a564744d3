"""A function under test: calls the student's function, holds its results to the contract, and remembers every call."""

import builtins
from dataclasses import dataclass
from typing import Any

import numpy as np

from workbench.exercise.model import Function
from workbench.exercise.sandbox import StudentError


@dataclass(frozen=True, eq=False)
class Call:
    """One call of a candidate: what it was given, and what it gave or raised."""

    args: tuple[Any, ...]
    value: Any
    error: str


class Candidate:
    """A function whose results have the shape, kind and finiteness of the reference's, else a StudentError says why not.

    Args:
        function: The student's function in its process, or one of ours (a mistake, an alternative).
        reference: Ours, called with the same arguments for the shape of the answer.
        remember: Whether the calls are kept, to recognise mistakes by; a run that is only watched does not need them.
    """

    def __init__(self, function: Function, reference: Function, *, remember: bool = True):
        self.function, self._reference, self._remember = function, reference, remember
        self.calls: list[Call] = []
        self.expected: Any = None  # what the reference answers to the last call; None where it raises
        self._changed = False
        self.__name__ = getattr(reference, "__name__", "candidate")

    def __call__(self, *args: Any) -> Any:
        """Return the function's answer as plain float64, int64 or bool values.

        Raises:
            StudentError: If it gave no answer, or one of another shape or kind than the contract says.
        """
        given = tuple(np.array(arg, copy=True) if isinstance(arg, np.ndarray) else arg for arg in args)
        try:
            with np.errstate(all="ignore"):
                value = self.function(*given)
        except StudentError as error:
            known = next((name for name in error.errors if hasattr(builtins, name)), error.error)
            self._keep(args, None, known or error.kind)
            raise
        except Exception as error:  # one of our own functions, which may be wrong on purpose
            self._keep(args, None, type(error).__name__)
            raise StudentError(
                f"{self.__name__} raised {type(error).__name__}: {error}", "raised", type(error).__name__
            ) from None
        self._keep(args, value, "")
        pairs = zip(args, given, strict=True)
        self._changed = any(isinstance(arg, np.ndarray) and arg.tobytes() != now.tobytes() for arg, now in pairs)
        self.expected = self._expected(args)
        return held_to_contract(value, self.expected, self.__name__)

    @property
    def changed_inputs(self) -> bool:
        """Whether the last call changed what it was given, in a student's process or, for one of ours, in this one."""
        return self._changed or bool(getattr(self.function, "changed_inputs", False))

    def _keep(self, args: tuple[Any, ...], value: Any, error: str) -> None:
        if self._remember:
            self.calls.append(Call(args, value, error))

    def _expected(self, args: tuple[Any, ...]) -> Any:
        try:
            return self._reference(*(np.array(arg, copy=True) if isinstance(arg, np.ndarray) else arg for arg in args))
        except Exception:
            return None  # degenerate input on which the contract asks for an error: nothing to hold the answer to


def held_to_contract(value: Any, expected: Any, name: str) -> Any:
    """Return a value as plain float64, int64 or bool, if it has the shape and kind of what is expected.

    Raises:
        StudentError: Says what came and what the contract asks for.
    """
    if expected is None:
        return value
    if isinstance(expected, (tuple, list)):
        if not isinstance(value, (tuple, list)) or len(value) != len(expected):
            raise StudentError(
                f"{name} returned {_kind(value)}; the contract asks for {len(expected)} values", "result"
            )
        return tuple(
            held_to_contract(v, e, f"{name}[{i}]") for i, (v, e) in enumerate(zip(value, expected, strict=True))
        )
    wanted = np.asarray(expected)
    if value is None or isinstance(value, str):
        raise StudentError(
            f"{name} returned {_kind(value)}; the contract asks for {_kind(expected)}. Is a return missing?", "result"
        )
    try:
        got = np.asarray(value)
    except ValueError:
        raise StudentError(
            f"{name} returned rows of unequal length; the contract asks for {_kind(expected)}", "result"
        ) from None
    if got.shape != wanted.shape:
        raise StudentError(f"{name} returned {_kind(value)}; the contract asks for {_kind(expected)}", "result")
    if got.dtype.kind not in "biuf" or (wanted.dtype.kind in "iu" and got.dtype.kind not in "iu"):
        raise StudentError(f"{name} returned {got.dtype} values; the contract asks for {_kind(expected)}", "result")
    if wanted.dtype.kind == "b" and got.dtype.kind != "b":
        raise StudentError(f"{name} returned {got.dtype} values; the contract asks for true or false", "result")
    plain = got.astype({"b": np.bool_, "i": np.int64, "u": np.int64}.get(wanted.dtype.kind, np.float64))
    if wanted.dtype.kind == "f" and np.isfinite(wanted).all() and not np.isfinite(plain).all():
        strange = plain[~np.isfinite(plain)]
        what = f"{plain}" if plain.ndim == 0 else f"{len(strange)} of {plain.size} values not finite"
        raise StudentError(f"{name} returned {what}; the contract asks for finite numbers", "result")
    return plain if isinstance(expected, np.ndarray) else plain.item()


def _kind(value: Any) -> str:
    if value is None:
        return "nothing"
    if isinstance(value, np.ndarray) and value.ndim:
        what = {"b": "true or false", "i": "whole numbers", "u": "whole numbers"}.get(value.dtype.kind, "numbers")
        return f"an array {value.shape} of {what}"
    if isinstance(value, (list, tuple)):
        return f"{len(value)} values"
    return "a text" if isinstance(value, str) else "a whole number" if isinstance(value, int) else "a number"
