"""Grades a folder of submissions in parallel, none at another's cost, and sums a class up.

Every finished student is written at once; a batch that was interrupted goes on where it stopped.
What changed since is graded again: a student's files, the exercises, the grader, Python, or what
shuts submissions in.
"""

import contextlib
import hashlib
import json
import os
import re
import signal
from collections.abc import Generator, Iterator, Mapping
from concurrent.futures import Executor, Future, as_completed
from dataclasses import replace
from pathlib import Path
from typing import Any, TextIO

from workbench.errors import InputError, one_line
from workbench.exercise.classfiles import class_csv, is_full, matrix_csv, summary
from workbench.exercise.marking import Asked, Result, digest, empty, grade_student, summed
from workbench.exercise.reports import SCHEMA_VERSION, ungraded
from workbench.exercise.sandbox import best, named
from workbench.exercise.submissions import HandIn, handed_in, with_roster
from workbench.machinery.atomic import write_atomic
from workbench.machinery.progress import Progress, bar
from workbench.machinery.workers import parallel_map

Task = tuple[HandIn, Asked]
LONGEST_SECONDS = 900.0
"""How long one student may take: far beyond what the limits of the exercises allow."""


def grade_class(
    folder: Path,
    out: Path,
    *,
    asked: Asked | None = None,
    roster: Path | None = None,
    worth: Mapping[str, float] | None = None,
    executor: Executor | None = None,
    jobs: int = 2,
    progress: Progress | None = None,
) -> list[Result]:
    """Grade all submissions of a folder; write results, tables and a summary into `out`.

    Submissions are read before the first of them runs; results in `out` that still fit stay.

    Args:
        roster: A table of those who should have handed in.
        worth: The points of an assignment's exercises; None counts the points of the checks.
        executor: Where the work runs; None uses `jobs` processes of this machine.
        progress: Told of each that is done.

    Raises:
        InputError: If the folder has no submissions or `out` cannot be written.
    """
    asked = asked or Asked()
    hand_ins = handed_in(folder, out)
    if roster is not None:
        hand_ins = with_roster(hand_ins, roster)
    students = out / "students"
    try:
        students.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise InputError(f"{out}: {error.strerror or 'cannot be written'}") from None
    places = {name: students / f"{stem}.json" for name, stem in stems(hand_ins).items()}
    results: dict[str, Result] = {}
    for name, handed in hand_ins.items():
        kept = _kept(places[name])
        if kept is not None and kept.get("digest") == digest(handed, asked):
            results[name] = kept
    waiting = [(handed, asked) for name, handed in hand_ins.items() if name not in results]
    done = len(results)
    with contextlib.closing(_graded(waiting, executor, jobs)) as graded:
        for name, result in graded:
            done += 1
            _write(places[name], json.dumps(result, indent=1, ensure_ascii=False))
            results[name] = result
            if progress is not None:
                progress(one_line(name), done, len(hand_ins))
    ordered = [results[name] for name in hand_ins]
    _write(out / "class.csv", class_csv(ordered, worth))
    _write(out / "matrix.csv", matrix_csv(ordered))
    _write(out / "summary.md", summary(ordered, worth))
    return ordered


def _graded(
    waiting: list[Task], executor: Executor | None, jobs: int
) -> Generator[tuple[str, Result], None, None]:
    if executor is None:
        graded = parallel_map(
            _grade, waiting, jobs, seconds=LONGEST_SECONDS, lost=_lost, start="fork"
        )
        with contextlib.closing(graded):  # type: ignore[type-var]
            yield from ((handed.student, result) for (handed, _), result in graded)
        return
    futures: dict[Future, str] = {
        executor.submit(_grade, task): task[0].student for task in waiting
    }
    for future in as_completed(futures):
        yield futures[future], future.result()


def _grade(task: Task) -> Result:
    return grade_student(*task)


def _lost(task: Task) -> Result:
    result = empty(*task)
    result["ungraded"] = [ungraded("", None, "could not be graded: the grading process ended")]
    return summed(result)


def stems(names: Mapping[str, Any]) -> dict[str, str]:
    """Return the name of each student's file: none is another's, capitals apart."""
    plain = {name: re.sub(r"[^\w.-]", "_", name)[:80] for name in names}
    counted: dict[str, int] = {}
    for stem in plain.values():
        counted[stem.casefold()] = counted.get(stem.casefold(), 0) + 1

    def told_apart(name: str) -> str:
        if plain[name] == name and counted[name.casefold()] == 1:
            return name
        return f"{plain[name]}-{hashlib.sha256(name.encode('utf-8', 'surrogateescape')).hexdigest()[:8]}"  # noqa: E501

    return {name: told_apart(name) for name in names}


def _kept(path: Path) -> Result | None:
    try:
        kept = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return None
    return kept if isinstance(kept, dict) and kept.get("schema") == SCHEMA_VERSION else None


def _write(path: Path, text: str) -> None:
    try:
        write_atomic(path, text.encode("utf-8", "backslashreplace"))
    except OSError as error:
        raise InputError(f"{path}: {error.strerror or 'cannot be written'}") from None


# the command --------------------------------------------------------------------------------------


def grade_folder(
    folder: Path,
    out: Path,
    *,
    asked: Asked,
    roster: Path | None = None,
    worth: Mapping[str, float] | None = None,
    jobs: int | None,
    dask: str | None,
    tell: TextIO,
    result: TextIO,
) -> int:
    """Grade a folder as the command does: a progress bar on `tell`, the summary on `result`.

    Returns:
        0 when all have full marks, 1 when not, 2 when none could be graded, 130 when interrupted.

    Raises:
        InputError: If it cannot be done; also where nothing shuts submissions in and nobody asked
            for that.
    """
    if jobs is not None and jobs < 1:
        raise InputError(f"--jobs {jobs}: at least 1")
    asked.exercises()  # one that is not there is told before the first student
    wall = best() if asked.sandbox == "auto" else named(asked.sandbox)
    if wall.name == "user":
        raise InputError(
            "--sandbox user: is for one submission in a container; here it could read the others"
        )
    if not wall.holds and asked.sandbox != "none":
        raise InputError(
            f"nothing here shuts submissions in, so marks would not be safe: {wall.why}. Mend that,"
            " or say --sandbox none where the machine is the wall (a container without network)"
        )
    asked = replace(asked, sandbox=wall.name)
    done = [0, 0]
    with contextlib.ExitStack() as stack:
        executor = None if dask is None else _dask_executor(dask, stack)
        shown = stack.enter_context(bar(tell, "Grading"))

        def progress(name: str, finished: int, of: int | None) -> None:
            done[:] = finished, of or 0
            shown(name, finished, of)

        stack.enter_context(_ending_on_terminate())
        try:
            graded = grade_class(
                folder,
                out,
                asked=asked,
                roster=roster,
                worth=worth,
                executor=executor,
                jobs=jobs or os.cpu_count() or 1,
                progress=progress,
            )
        except KeyboardInterrupt:
            tell.write(
                f"\nInterrupted: {done[0]} of {done[1] or '?'} graded; the same command goes on"
                " from there.\n"
            )
            return 130
    result.write(summary(graded, worth) + f"\nResults: {out / 'class.csv'}, {out / 'matrix.csv'}\n")
    some = [student for student in graded if student["reports"]]
    if not some:
        return 2
    return 0 if all(is_full(student, worth) for student in graded) else 1


@contextlib.contextmanager
def _ending_on_terminate() -> Iterator[None]:
    """Let SIGTERM end what Ctrl+C ends, for the length of the block."""

    def interrupt(*_: object) -> None:
        raise KeyboardInterrupt

    try:
        before = signal.signal(signal.SIGTERM, interrupt)
    except ValueError:  # not in the main thread
        yield
        return
    try:
        yield
    finally:
        signal.signal(signal.SIGTERM, before)


def _dask_executor(address: str, stack: contextlib.ExitStack) -> Executor:
    try:
        from distributed import Client  # type: ignore[import-not-found]
    except ImportError:
        raise InputError(
            "--dask needs the package `distributed`: pip install distributed"
        ) from None
    try:
        client = stack.enter_context(Client(address, timeout="10s"))
    except OSError:
        raise InputError(f"--dask {address}: no scheduler answers there") from None
    return client.get_executor()
