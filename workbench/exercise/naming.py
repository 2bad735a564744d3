"""Names the mistake that a function makes, from what it answered to the checks' calls.

A call speaks for or against a mistake where the right answer is known: where the contract asks for
an error, or leaves open which of several answers is given (the alternatives differ), right
functions differ too, and it tells little.
"""

import functools
import warnings
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from workbench.exercise.candidate import Call, Returned, raised
from workbench.exercise.model import Exercise, Function, Mistake

ENOUGH = 3
"""How much must tell a mistake from the right answer where a function makes it in some checks only:
of an array each wrong entry counts, of single numbers each one that is not like another, a fraction
twice.
"""
RANGE = 1e-50, 1e50
"""Sizes of numbers, 0 apart, that our functions are asked about: beyond, squares overflow and
LAPACK may never end.
"""
KEPT_ANSWERS = 2048
ROUNDING = 1e-6  # relative
NEAR, FAR = 0.05, 5.0
"""Where right answers differ, by this share of their size at most, a mistake's is told from them if
it is from each of them at least a fifth as far as they are from each other.
"""
SINGLE_ROUNDING = 1e-4  # the same for single precision, after some sums


@dataclass(frozen=True)
class Evidence:
    """How some calls speak for a mistake.

    Attributes:
        weight: How much in the answers is wrong as the mistake's are, and not by chance.
        made: On how many calls for which the contract asks for an error the mistake was made.
        spared: On how many of those on which the mistake is one the right error was raised.
        other: On how many such calls something else went wrong.
    """

    weight: int
    made: int
    spared: int
    other: int

    @property
    def is_all(self) -> bool:
        """Whether nothing but this mistake was made."""
        return not self.other and bool(self.weight or not self.spared)


def diagnose(
    calls: Mapping[str, Sequence[Call]], failing: set[str], exercise: Exercise
) -> Mistake | None:
    """Return the one mistake whose answers are those of the calls and not the right ones, or None.

    It is looked for in all calls first, then in those of each failing check alone: who makes two
    mistakes makes one of them in most of the checks that fail, or it is not what to mend first. A
    mistake that refused calls alone tell of, and one whose sentence says that all else is right, is
    named only where all else is right.
    """
    if not failing:
        return None
    every = [call for asked in calls.values() for call in asked]
    weights = {}
    for mistake in exercise.mistakes:
        evidence = _evidence(mistake, every, exercise)
        needs_all = evidence is not None and (mistake.spares_the_rest or not evidence.weight)
        if evidence is not None and (evidence.is_all or not needs_all):
            weights[mistake] = evidence.weight + evidence.made
    return _the_most(weights, 1) or _the_most(_in_some_checks(calls, failing, exercise), ENOUGH)


def concerned(
    mistake: Mistake, calls: Mapping[str, Sequence[Call]], failing: set[str], *, exercise: Exercise
) -> frozenset[str]:
    """Return the names of the failing checks in which a function makes a mistake."""
    told = {name: _evidence(mistake, calls[name], exercise) for name in failing}
    return frozenset(
        name for name, evidence in told.items() if evidence and (evidence.weight or evidence.made)
    )


def _in_some_checks(
    calls: Mapping[str, Sequence[Call]], failing: set[str], exercise: Exercise
) -> dict[Mistake, int]:
    weights = {}
    for mistake in exercise.mistakes:
        told = [_evidence(mistake, calls[name], exercise) for name in failing]
        told = [evidence.weight for evidence in told if evidence is not None and evidence.weight]
        if not mistake.spares_the_rest and 2 * len(told) > len(failing):
            weights[mistake] = sum(told)
    return weights


def _the_most(weights: dict[Mistake, int], least: int) -> Mistake | None:
    """Return the mistake with the most weight, at least this; none where two have as much."""
    most = max(weights.values(), default=0)
    first = [mistake for mistake, weight in weights.items() if weight == most]
    return first[0] if most >= least and len(first) == 1 else None


def _evidence(mistake: Mistake, calls: Iterable[Call], exercise: Exercise) -> Evidence | None:
    """Return how calls speak for a mistake; None where one speaks against it."""
    weight = 0
    numbers = set[float]()
    made = 0
    spared = 0
    other = 0
    for call in calls:
        if call.right.error:
            is_one = not _alike(_answer(mistake.function, call), call.right, exercise)
            if _alike(call.answer, call.right, exercise):
                spared += is_one
            elif is_one and _alike(call.answer, _answer(mistake.function, call), exercise):
                made += 1
            else:
                other += 1
        else:
            mistaken = _answer(mistake.function, call)
            others = [_answer(f, call) for f in exercise.alternatives]
            is_open = any(not _alike(other, call.right, exercise) for other in others)
            if _alike(call.answer, mistaken, exercise):
                wrong = not _alike(mistaken, call.right, exercise)
                tells = wrong and (not is_open or _is_apart(mistaken, [call.right, *others]))
                weight += _wrong_entries(mistaken.value, call.right.value, numbers) if tells else 0
            elif not is_open:
                return None
    weight += sum(1 if number.is_integer() else 2 for number in numbers)
    return Evidence(weight, made, spared, other)


def _is_apart(mistaken: Returned, right: Sequence[Returned]) -> bool:
    """Tell whether the mistake's answer is none of the right ones, which are near each other."""
    spread = max(_gap(answer, right[0]) for answer in right)
    return _size(right[0]) * NEAR > spread < FAR * min(_gap(answer, mistaken) for answer in right)


def _size(answer: Returned) -> float:
    return _gap(answer, Returned(np.zeros_like(answer.value), ""))


def _gap(a: Returned, b: Returned) -> float:
    """Return the largest difference of two answers; infinite where they are not alike in kind."""
    if a.error or b.error:
        return 0.0 if a.error == b.error else np.inf
    try:
        first, second = np.asarray(a.value, dtype=float), np.asarray(b.value, dtype=float)
        with np.errstate(invalid="ignore"):
            off = np.where(
                (first == second) | (np.isnan(first) & np.isnan(second)),
                0.0,
                np.abs(first - second),
            )
    except (TypeError, ValueError):
        return np.inf
    return float(np.nan_to_num(off, nan=np.inf, posinf=np.inf).max(initial=0.0))


def _wrong_entries(mistaken: Any, right: Any, numbers: set[float]) -> int:
    """Return how many entries are wrong; a single number is added to those given."""
    try:
        wrong, known = np.asarray(mistaken, dtype=float), np.asarray(right, dtype=float)
    except (TypeError, ValueError):
        return ENOUGH
    if wrong.shape != known.shape:
        return ENOUGH
    if wrong.ndim == 0:
        numbers.add(float(wrong))
        return 0
    return int((~np.isclose(wrong, known, equal_nan=True)).sum())


def _alike(a: Returned, b: Returned, exercise: Exercise) -> bool:
    if a.error or b.error:
        return a.error == b.error
    return any(
        values_alike(a.value, form) for form in (b.value, *exercise.contract.others(b.value))
    )


def values_alike(a: Any, b: Any) -> bool:
    """Tell whether two answers are the same within rounding: nested tuples, arrays, numbers."""
    if isinstance(a, (tuple, list)) or isinstance(b, (tuple, list)):
        listed = isinstance(a, (tuple, list)) and isinstance(b, (tuple, list)) and len(a) == len(b)
        if listed:
            return all(values_alike(x, y) for x, y in zip(a, b, strict=True))
    try:
        first, second = np.asarray(a, dtype=float), np.asarray(b, dtype=float)
    except (TypeError, ValueError):
        return False
    rounding = (
        SINGLE_ROUNDING
        if np.float32 in (getattr(a, "dtype", None), getattr(b, "dtype", None))
        else ROUNDING
    )
    if first.shape != second.shape:
        return False
    size = np.abs(second)
    same = first == second
    if same.all():
        return True
    known = np.isfinite(second)
    scale = max(1e-12, float(size[known].max(initial=0.0)))
    with np.errstate(invalid="ignore", over="ignore"):
        near = np.abs(first - second) <= 0.1 * rounding * scale + rounding * size
    return bool((same | near & known | np.isnan(first) & np.isnan(second)).all())


# what one of our functions says to a call, kept for the next student ------------------------------


def _answer(function: Function, call: Call) -> Returned:
    return _answered(function, call.key)


@functools.lru_cache(maxsize=KEPT_ANSWERS)
def _answered(function: Function, key: tuple[Any, ...]) -> Returned:
    args = [_thawed(part) for part in key]
    if any(_is_beyond(arg) for arg in args):
        return raised(OverflowError("an argument is beyond what can be computed with"))
    try:
        with np.errstate(all="ignore"), warnings.catch_warnings(action="ignore"):
            return Returned(function(*args), "")
    except Exception as error:
        return raised(error)


def _is_beyond(arg: Any) -> bool:
    """Tell whether an argument has numbers that are too large or too small."""
    if not (isinstance(arg, float) or (isinstance(arg, np.ndarray) and arg.dtype.kind == "f")):
        return False
    size = np.abs(arg)[()]
    low, high = RANGE
    return bool(np.any(np.isfinite(size) & (((size > 0) & (size < low)) | (size > high))))


def _thawed(part: Any) -> Any:
    if not isinstance(part, tuple):
        return part
    shape, dtype, content = part
    return np.frombuffer(content, dtype).reshape(shape).copy()
