"""Right functions made wrong by one change each, and graded: which of them lose points, and which
earn all.

    python -m tests.exercise.mutants [EXERCISE ...] [--table] [--sample N] [--markdown]

What earns full marks is either as right as before (its answers agree with those of all right
functions wherever these agree with each other), or a check is missing. `operators` says what is
changed. The functions are every `@alternative`, with --table also every `right_...` of `solutions`.
They run in this process, under a limit of time. --sample takes so many of each exercise, always the
same ones; --markdown prints the table of docs/exercises.md.
"""

import ast
import contextlib
import functools
import importlib
import inspect
import multiprocessing
import os
import random
import resource
import signal
import sys
import time
import warnings
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np

from tests.exercise.operators import Mutant, mutants
from workbench.exercise.candidate import Candidate
from workbench.exercise.finding import exercises
from workbench.exercise.model import Exercise, Function
from workbench.exercise.naming import values_alike

ACCEPTED = Path(__file__).with_name("survivors.txt")
SECONDS = 1.0  # of processor time, for one call
SECONDS_OF_A_RIGHT_ONE = 0.1  # likewise: what a right function is long at, is left out
SEARCHED = 20.0  # of processor time, for arguments on which a survivor is wrong
GIGABYTES = 6
MOST_VARIANTS = 300


@dataclass(frozen=True, eq=False)
class Changed:
    """A mutant of a right function, ready to be called.

    Attributes:
        exercise: What it is an answer to.
        mutant: What was changed.
        right: The function as it was.
        function: The function as it is.
    """

    exercise: Exercise
    mutant: Mutant
    right: Function
    function: Function

    def __str__(self) -> str:
        return f"{self.exercise.name} {self.mutant}"


def changed(exercise: Exercise, *, table: bool) -> Iterator[Changed]:
    """Yield all mutants of an exercise's alternatives, with `table` of all right solutions; helpers
    are changed once.
    """
    functions = [
        (sys.modules[alternative.__module__], alternative.__name__)
        for alternative in exercise.alternatives
    ]
    if table:
        solutions = importlib.import_module(f"tests.exercise.solutions.{exercise.name}")
        functions += [(solutions, name) for name in vars(solutions) if name.startswith("right_")]
    done = set[tuple[str, str]]()
    for module, name in functions:
        parts = _functions(module)
        for part in _used(parts, name):
            if (module.__name__, part) not in done:
                done.add((module.__name__, part))
                for mutant in mutants(parts[part], arguments=part == name):
                    function = _made(module, parts, name, mutant=mutant)
                    if function is not None:
                        yield Changed(exercise, mutant, vars(module)[name], function)


@functools.cache
def _functions(module: ModuleType) -> dict[str, ast.FunctionDef]:
    """Return a module's functions, those that are checks, mistakes or contracts left out."""
    tree = ast.parse(inspect.getsource(module))
    functions = [node for node in tree.body if isinstance(node, ast.FunctionDef)]
    return {
        node.name: node
        for node in functions
        if [ast.unparse(decorator) for decorator in node.decorator_list] in ([], ["alternative"])
    }


def _used(parts: dict[str, ast.FunctionDef], name: str) -> list[str]:
    """Return the names of a function and of those that it calls, in its module."""
    used = []
    waiting = [name]
    while waiting:
        part = waiting.pop()
        if part in parts and part not in used:
            used.append(part)
            waiting += [node.id for node in ast.walk(parts[part]) if isinstance(node, ast.Name)]
    return used


def _made(
    module: ModuleType, parts: dict[str, ast.FunctionDef], name: str, *, mutant: Mutant
) -> Function | None:
    """Return the function with the change; None where the change is no Python."""
    space = dict(vars(module)) | HELPERS
    sources = {part: ast.unparse(parts[part]) for part in _used(parts, name)} | {
        mutant.function: mutant.source
    }
    try:
        with warnings.catch_warnings(action="ignore"):
            code = compile("\n".join(sources.values()), "mutant", "exec", dont_inherit=True)
    except (SyntaxError, ValueError):
        return None
    exec(code, space | {"alternative": lambda function: function, "np": np}, space)
    return space[name]


# what the changed lines call ----------------------------------------------------------------------


def _floats(value: Any) -> bool:
    return isinstance(value, np.ndarray) and value.dtype.kind == "f"


def _ones(value: Any) -> Any:
    """Return ones in place of an argument."""
    return np.ones_like(value) if isinstance(value, np.ndarray) else type(value)(1)


def _ones_of(value: Any, *_: Any, **options: Any) -> Any:
    """Return ones in place of lengths."""
    return np.ones_like(np.linalg.norm(value, **options))


def _reversed(value: Any) -> Any:
    """Return an argument with its rows in the other order."""
    return value[::-1] if isinstance(value, np.ndarray) and value.ndim else value


def _single(value: Any) -> Any:
    """Return an argument in single precision."""
    return value.astype(np.float32) if _floats(value) else value


def _spoilt(value: Any) -> Any:
    """Return a copy of an array and change the array."""
    if not _floats(value) or not value.size:
        return value
    kept = value.copy()
    value += 1.0
    return kept


HELPERS = {helper.__name__: helper for helper in (_ones, _ones_of, _reversed, _single, _spoilt)}


# grading ------------------------------------------------------------------------------------------


def loses(function: Function, exercise: Exercise) -> bool:
    """Tell whether a function earns less than all points."""
    asked = []
    for check in exercise.checks:
        candidate = Candidate(limited(function), exercise.reference, remember=False)
        asked.append(candidate)
        try:
            if check.judge(candidate).share < 1.0:
                return True
        except Exception:  # as in grading: what cannot be judged earns nothing
            return True
    return any(judged.looks_at_inputs for judged in asked) and any(
        judged.changing for judged in asked
    )


def limited(function: Function, seconds: float = SECONDS) -> Function:
    """Return a function that raises TimeoutError where it takes longer than so many seconds of
    processor time.
    """

    def late(*_: Any) -> None:
        raise TimeoutError(f"more than {seconds} s")

    def called(*args: Any) -> Any:
        before = signal.signal(signal.SIGPROF, late)
        signal.setitimer(signal.ITIMER_PROF, seconds, seconds)
        try:
            with warnings.catch_warnings(action="ignore"):
                return function(*args)
        finally:
            signal.setitimer(signal.ITIMER_PROF, 0.0)
            signal.signal(signal.SIGPROF, before)

    return called


def differs(case: Changed) -> tuple[Any, ...] | None:
    """Return arguments on which a mutant's answer is not the right one; None where none are known.

    They are those of the checks, and variants of them: smaller, larger, with noise, fewer rows,
    another order, negative. One counts where all right functions agree on it, so that what the
    contract does not allow does not count.
    """
    kind = np.float32 if case.mutant.operator == "float32" else None
    until = time.process_time() + SEARCHED
    for args, right in agreed(case.exercise):
        if time.process_time() > until:
            break
        if not _is_right(case.right, args, right, exercise=case.exercise):
            continue
        if not _is_right(limited(case.function), args, right, exercise=case.exercise, kind=kind):
            return args
    return None


def _is_right(
    function: Function,
    args: tuple[Any, ...],
    right: Any,
    *,
    exercise: Exercise,
    kind: type[np.float32] | None = None,
) -> bool:
    """Tell whether an answer is right as far as the digits of its kind go: no contract asks for
    double precision.
    """
    got = _answer(function, args)
    if kind is not None and isinstance(got, (np.ndarray, float)):
        got = np.asarray(got, dtype=kind)
    return not isinstance(got, Exception) and _alike(got, right, exercise)


def _alike(got: Any, right: Any, exercise: Exercise) -> bool:
    return any(values_alike(got, form) for form in (right, *exercise.contract.others(right)))


def _answer(function: Function, args: tuple[Any, ...]) -> Any:
    try:
        with np.errstate(all="ignore"), warnings.catch_warnings(action="ignore"):
            return function(
                *[np.array(arg) if isinstance(arg, np.ndarray) else arg for arg in args]
            )
    except Exception as error:
        return error


@functools.cache
def agreed(exercise: Exercise) -> list[tuple[tuple[Any, ...], Any]]:
    """Return the arguments of an exercise's checks, and variants of them, with the answer that our
    right functions share.
    """
    asked = []
    for check in exercise.checks:
        candidate = Candidate(exercise.reference, exercise.reference)
        check.judge(candidate)
        asked += [call.args for call in candidate.calls]
    rng = np.random.default_rng(len(asked))
    more = [made for args in asked for made in _variants(args, rng)]
    pairs = []
    for args in asked + random.Random(exercise.name).sample(more, min(MOST_VARIANTS, len(more))):
        first = _answer(limited(exercise.reference, SECONDS_OF_A_RIGHT_ONE), args)
        answers = (
            _answer(limited(right, SECONDS_OF_A_RIGHT_ONE), args)
            for right in exercise.alternatives  # some never end on negative lengths
        )
        if not isinstance(first, Exception) and all(
            not isinstance(answer, Exception) and _alike(answer, first, exercise)
            for answer in answers
        ):
            pairs.append((args, first))
    return pairs


def _variants(args: tuple[Any, ...], rng: np.random.Generator) -> Iterator[tuple[Any, ...]]:
    def each(change: Callable[[np.ndarray], Any]) -> tuple[Any, ...]:
        return tuple(change(arg) if _floats(arg) else arg for arg in args)

    for scale in (0.01, 100.0, -1.0):
        yield each(lambda arg, scale=scale: scale * arg)
    yield each(lambda arg: arg * (1 + 0.01 * rng.normal(size=arg.shape)))
    yield each(lambda arg: arg + 0.1 * rng.normal(size=arg.shape))
    rows = {len(arg) for arg in args if isinstance(arg, np.ndarray) and arg.ndim}
    for n in rows:
        order = rng.permutation(n)
        for some in (order, order[: n // 2], order[:1]):
            yield tuple(
                arg[some] if isinstance(arg, np.ndarray) and arg.ndim and len(arg) == n else arg
                for arg in args
            )
    for k, arg in enumerate(args):
        if isinstance(arg, (int, float)) and not isinstance(arg, bool):
            yield from (
                (*args[:k], new, *args[k + 1 :])
                for new in ((arg + 1, arg - 1) if isinstance(arg, int) else (0.7 * arg,))
            )


# the table ----------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Row:
    """What became of an exercise's mutants.

    Attributes:
        exercise: Its name.
        losing: How many lose points.
        equal: How many earn all, and are as right as before as far as is known.
        alive: Those that earn all and are not as right as before; of the accepted ones too.
    """

    exercise: str
    losing: int
    equal: int
    alive: tuple[str, ...]


def row(name: str, *, table: bool = False, most: int | None = None) -> Row:
    """Grade an exercise's mutants, or a sample of at most so many."""
    exercise = exercises()[name]
    every = list(changed(exercise, table=table))
    if most is not None:
        every = random.Random(name).sample(every, min(most, len(every)))
    surviving = [case for case in every if not loses(case.function, exercise)]
    alive = tuple(str(case) for case in surviving if differs(case) is not None)
    return Row(name, len(every) - len(surviving), len(surviving) - len(alive), alive)


def accepted() -> set[str]:
    """Return the survivors that are known to be right, or within what the checks allow."""
    lines = ACCEPTED.read_text(encoding="utf-8").splitlines()
    return {line for line in lines if line and not line.startswith("#")}


def main(arguments: list[str]) -> None:
    """Print the table."""
    resource.setrlimit(resource.RLIMIT_AS, (GIGABYTES << 30, GIGABYTES << 30))
    known = accepted()
    write = sys.stdout.write
    most = int(arguments.pop(arguments.index("--sample") + 1)) if "--sample" in arguments else None
    wanted = [name for name in arguments if not name.startswith("-")] or list(exercises())
    line = (
        "| {:26} | {:>9} | {:>7} | {:>7} | {:>7} |\n"
        if "--markdown" in arguments
        else "{:26}{:>9}{:>7}{:>7}{:>7}\n"
    )
    write(line.format("exercise", "mutants", "lose", "equal", "alive"))
    write(line.format("---", "--:", "--:", "--:", "--:") if "--markdown" in arguments else "")
    total = np.zeros(4, dtype=int)
    with (
        multiprocessing.Pool(min(2, os.cpu_count() or 1)) as pool,
        contextlib.suppress(KeyboardInterrupt),
    ):
        for tally in pool.imap(
            functools.partial(row, table="--table" in arguments, most=most), wanted
        ):
            counted = [
                tally.losing + tally.equal + len(tally.alive),
                tally.losing,
                tally.equal,
                len(tally.alive),
            ]
            total += counted
            write(line.format(tally.exercise, *counted))
            for survivor in tally.alive:
                write("" if survivor in known else f"  ! {survivor}\n")
            sys.stdout.flush()
    write(line.format("all", *total))


if __name__ == "__main__":
    main(sys.argv[1:])
