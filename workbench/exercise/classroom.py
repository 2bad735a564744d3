"""Grades a folder of submissions in parallel, so that one of them costs nobody else anything, and sums a class up.

Every finished submission is written at once; a batch that was interrupted goes on where it stopped, and a file that
changed since is graded again.
"""

import contextlib
import csv
import functools
import hashlib
import io
import json
import os
from collections import Counter
from collections.abc import Sequence
from concurrent.futures import Executor, Future, ProcessPoolExecutor, as_completed
from concurrent.futures.process import BrokenProcessPool
from dataclasses import dataclass
from pathlib import Path
from typing import Any, TextIO

import workbench
from workbench.atomic import write_atomic
from workbench.errors import InputError
from workbench.exercise.finding import exercises_in, find_exercise
from workbench.exercise.grading import grade_file
from workbench.exercise.model import Exercise
from workbench.exercise.reports import SCHEMA_VERSION, as_dict
from workbench.lesson import Lesson
from workbench.loading import load
from workbench.progress import Progress, bar


def submissions(folder: Path) -> dict[str, Path]:
    """Return the submissions of a folder by the student's name: `NAME.py`, or the .py files of a folder `NAME`.

    Raises:
        InputError: If it is no folder or holds none.
    """
    if not folder.is_dir():
        raise InputError(f"{folder}: no such folder")
    found = {path.stem: path for path in sorted(folder.glob("*.py"))}
    for inner in sorted(
        path for path in folder.iterdir() if path.is_dir() and not path.name.startswith((".", "graded"))
    ):
        files = sorted(inner.glob("*.py"))
        for path in files:
            found[inner.name if len(files) == 1 else f"{inner.name}/{path.stem}"] = path
    if not found:
        raise InputError(f"{folder}: holds no .py file")
    return found


@dataclass(frozen=True)
class Asked:
    """What a class was asked for: the one exercise (None: those whose functions a file defines), and of which lesson.

    `lesson` is the path of a lesson that the catalogue does not have; the processes that grade load it by that.
    """

    only: str | None = None
    lesson: Path | None = None

    def exercises(self, path: Path) -> tuple[Exercise, ...]:
        """Return the exercises that a submission is graded by.

        Raises:
            InputError: If there are none.
        """
        lesson = None if self.lesson is None else _loaded(self.lesson)
        return (find_exercise(self.only, lesson),) if self.only else exercises_in(path, lesson)

    def digest(self) -> str:
        """Return what kept results must agree with."""
        files = [] if self.lesson is None else sorted(self.lesson.rglob("*.py"))
        return f"{self.only}" + "".join(hashlib.sha256(file.read_bytes()).hexdigest() for file in files)


@functools.cache
def _loaded(path: Path) -> Lesson:
    return load(path)  # once in a process


def grade_one(name: str, path: str, asked: Asked) -> dict[str, Any]:
    """Grade one submission and return its result as plain data; whatever goes wrong is part of the result."""
    result: dict[str, Any] = {
        "schema": SCHEMA_VERSION,
        "student": name,
        "file": path,
        "digest": digest(Path(path), asked),
    }
    try:
        chosen = asked.exercises(Path(path))
        result["reports"] = [as_dict(grade_file(Path(path), exercise)) for exercise in chosen]
        result["error"] = None
    except InputError as error:
        result |= {"reports": [], "error": str(error)}
    except Exception as error:  # a fault of ours in one submission must not stop a class
        result |= {"reports": [], "error": f"could not be graded: {type(error).__name__}: {error}"}
    return result


def grade_class(
    folder: Path,
    out: Path,
    *,
    asked: Asked | None = None,
    executor: Executor | None = None,
    jobs: int = 2,
    progress: Progress | None = None,
) -> list[dict[str, Any]]:
    """Grade all submissions of a folder and write results, class.csv, matrix.csv and summary.md into `out`.

    Args:
        folder: Where the submissions are.
        out: Where the results go; what is there and still fits is not graded again.
        asked: Which exercises; those of the catalogue whose functions a file defines by default.
        executor: Where the work runs; None uses `jobs` processes of this machine.
        jobs: How many submissions are graded at a time.
        progress: Told of each that is done.

    Raises:
        InputError: If the folder has no submissions or `out` cannot be written.
    """
    found, asked = submissions(folder), asked or Asked()
    students = out / "students"
    try:
        students.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise InputError(f"{out}: {error.strerror or 'cannot be written'}") from None
    results: dict[str, dict[str, Any]] = {}
    for name, path in found.items():
        kept = _kept(_file(students, name))
        if kept is not None and kept.get("digest") == digest(path, asked):
            results[name] = kept
    waiting = {name: path for name, path in found.items() if name not in results}
    done = len(results)
    for name, result in _graded(waiting, asked, executor, jobs):
        done += 1
        _write(_file(students, name), json.dumps(result, indent=1, ensure_ascii=False))
        results[name] = result
        if progress is not None:
            progress(name, done, len(found))
    ordered = [results[name] for name in found]
    _write(out / "class.csv", class_csv(ordered))
    _write(out / "matrix.csv", matrix_csv(ordered))
    _write(out / "summary.md", summary(ordered))
    return ordered


def grade_folder(
    folder: Path, out: Path, *, asked: Asked, jobs: int | None, dask: str | None, tell: TextIO, result: TextIO
) -> int:
    """Grade a folder as the command does, with a progress bar on `tell` and the summary on `result`.

    Returns:
        0 when every submission has full marks, 1 when not, 2 when none could be graded.
    """
    if jobs is not None and jobs < 1:
        raise InputError(f"--jobs {jobs}: at least 1")
    if asked.only is not None:
        asked.exercises(folder)
    with contextlib.ExitStack() as stack:
        executor = None
        if dask is not None:
            executor = _dask_executor(dask, stack)
        progress = stack.enter_context(bar(tell, "Grading"))
        results = grade_class(
            folder, out, asked=asked, executor=executor, jobs=jobs or os.cpu_count() or 1, progress=progress
        )
    result.write(summary(results) + f"\nResults: {out / 'class.csv'}, {out / 'matrix.csv'}\n")
    graded = [one for one in results if one["error"] is None]
    perfect = all(report["points"] == report["possible"] for one in graded for report in one["reports"])
    return 2 if not graded else 0 if perfect and len(graded) == len(results) else 1


def _dask_executor(address: str, stack: contextlib.ExitStack) -> Executor:
    try:
        from distributed import Client  # type: ignore[import-not-found]
    except ImportError:
        raise InputError("--dask needs the package `distributed`: pip install distributed") from None
    try:
        client = stack.enter_context(Client(address, timeout="10s"))
    except OSError:
        raise InputError(f"--dask {address}: no scheduler answers there") from None
    return client.get_executor()


def _graded(waiting: dict[str, Path], asked: Asked, executor: Executor | None, jobs: int) -> Any:
    """Yield (name, result) as they come; a worker process that dies costs its own submission only."""
    if executor is not None:
        yield from _collected(executor, waiting, asked)
        return
    left = dict(waiting)
    while left:
        with ProcessPoolExecutor(jobs) as pool:
            for name, result in _collected(pool, left, asked):
                if result is None:
                    continue
                left.pop(name)
                yield name, result
        if left:  # the pool broke: grade the rest one by one, so that the one that breaks it is found
            name, path = next(iter(left.items()))
            left.pop(name)
            with ProcessPoolExecutor(1) as pool:
                try:
                    yield name, pool.submit(grade_one, name, str(path), asked).result()
                except BrokenProcessPool:
                    yield name, _lost(name, path, asked)


def _collected(executor: Executor, waiting: dict[str, Path], asked: Asked) -> Any:
    futures: dict[Future, str] = {}
    try:
        for name, path in waiting.items():
            futures[executor.submit(grade_one, name, str(path.resolve()), asked)] = name
    except BrokenProcessPool:
        pass
    for future in as_completed(futures):
        try:
            yield futures[future], future.result()
        except BrokenProcessPool:
            yield futures[future], None


def _lost(name: str, path: Path, asked: Asked) -> dict[str, Any]:
    kept = {"schema": SCHEMA_VERSION, "student": name, "file": str(path), "digest": digest(path, asked), "reports": []}
    return kept | {"error": "could not be graded: the grading process ended"}


def digest(path: Path, asked: Asked) -> str:
    """Return what a kept result must agree with: the file's content, the exercise asked for, and our version."""
    try:
        content = path.read_bytes()
    except OSError:
        content = b""
    return hashlib.sha256(content + f"\0{asked.digest()}\0{workbench.__version__}".encode()).hexdigest()


def class_csv(results: Sequence[dict[str, Any]]) -> str:
    """Return one row per student: points in all, per exercise, and what kept a file from being graded."""
    names = list(dict.fromkeys(report["exercise"] for result in results for report in result["reports"]))
    rows = [["student", "points", "possible", *names, "error"]]
    for result in results:
        points = {report["exercise"]: report["points"] for report in result["reports"]}
        possible = sum(report["possible"] for report in result["reports"])
        total = f"{sum(points.values()):g}"
        cells = [f"{points[name]:g}" if name in points else "" for name in names]
        rows.append([result["student"], total, f"{possible:g}", *cells, result["error"] or ""])
    return _csv(rows)


def matrix_csv(results: Sequence[dict[str, Any]]) -> str:
    """Return students by checks, each cell the share of the check's points; the last row is the most frequent mistake."""
    checks = list(
        dict.fromkeys((r["exercise"], c["name"]) for result in results for r in result["reports"] for c in r["checks"])
    )
    rows = [["student", *(f"{exercise}.{name}" for exercise, name in checks)]]
    mistakes: dict[tuple[str, str], Counter] = {check: Counter() for check in checks}
    for result in results:
        shares = {}
        for report in result["reports"]:
            for found in report["checks"]:
                key = (report["exercise"], found["name"])
                shares[key] = found["points"] / found["possible"] if found["possible"] else 0.0
                if shares[key] < 1 and report["mistake"]:
                    mistakes[key][report["mistake"]["name"]] += 1
        rows.append([result["student"], *(f"{shares[key]:g}" if key in shares else "" for key in checks)])
    frequent = [next((f"{name} ({n})" for name, n in mistakes[key].most_common(1)), "") for key in checks]
    return _csv([*rows, ["most frequent mistake", *frequent]])


def summary(results: Sequence[dict[str, Any]]) -> str:
    """Return the class in a few lines of Markdown."""
    graded = [result for result in results if result["error"] is None]
    perfect = sum(all(r["points"] == r["possible"] for r in result["reports"]) for result in graded)
    lines = [f"# {len(results)} submissions", ""]
    lines.append(f"{len(graded)} graded, {perfect} with full marks, {len(results) - len(graded)} could not be graded.")
    mistakes = Counter(r["mistake"]["sentence"] for result in graded for r in result["reports"] if r["mistake"])
    if mistakes:
        lines += [
            "",
            "Most frequent mistakes:",
            "",
            *(f"- {count} × {said}" for said, count in mistakes.most_common(8)),
        ]
    errors = [result for result in results if result["error"] is not None]
    if errors:
        lines += ["", "Not graded:", "", *(f"- {result['student']}: {result['error']}" for result in errors)]
    return "\n".join(lines) + "\n"


def _csv(rows: Sequence[Sequence[str]]) -> str:
    out = io.StringIO()
    csv.writer(out, lineterminator="\n").writerows([[_inert(cell) for cell in row] for row in rows])
    return out.getvalue()


def _inert(cell: str) -> str:
    """Keep a spreadsheet from running what a student named a file."""
    return "'" + cell if cell[:1] in "=+-@\t" else cell


def _file(students: Path, name: str) -> Path:
    return students / (name.replace("/", "__") + ".json")


def _kept(path: Path) -> dict[str, Any] | None:
    try:
        kept = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return None
    return kept if isinstance(kept, dict) and kept.get("schema") == SCHEMA_VERSION else None


def _write(path: Path, text: str) -> None:
    write_atomic(path, text.encode())
