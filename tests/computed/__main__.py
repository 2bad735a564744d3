"""Compares Pyodide with this machine in all presets of all lessons, or in all solutions:

    python -m tests.computed presets | solutions [LESSON ...]

WORKBENCH_PYODIDE names the folder of a release; exit code 1 where a difference is not in `known`.
"""

import os
import sys
import tempfile
from pathlib import Path

from tests.computed.compared import ROOT, differences, lines_of, make_archive, verdict
from tests.computed.judged import judged
from tests.computed.known import DIFFERENT, OTHERWISE_JUDGED
from tests.computed.solutions import tasks_of
from tests.computed.summarised import summary
from workbench.computed.runner import Runner
from workbench.lesson import Lesson, catalog, find


def presets(pyodide: Path, folder: Path, lessons: list[Lesson]) -> int:
    """Compare runs; return how many differ that are not known to."""
    core = make_archive(folder / "core.zip")
    new = 0
    runners = {lesson.name: Runner(lesson) for lesson in lessons}
    for by_pyodide in lines_of(
        pyodide, core, "summarised.py", words=[f"{name} *" for name in runners]
    ):
        run = by_pyodide["run"]
        lesson, _, name = run.partition(" ")
        lines = differences(summary(runners[lesson], name), by_pyodide)
        new += bool(lines) and run not in DIFFERENT
        if lines:
            print(f"{run}: {DIFFERENT.get(run, 'NEW')}: {lines[0]}", flush=True)
    return new


def solutions(pyodide: Path, folder: Path, lessons: list[Lesson]) -> int:
    """Compare verdicts; return how many differ that are not known to."""
    tasks = [task for lesson in lessons for task in tasks_of(lesson)]
    texts = {task[:3]: task[3] for task in tasks}
    core = make_archive(folder / "core.zip", tasks)
    new = count = 0
    for lesson, exercise, solution, by_pyodide in lines_of(pyodide, core, "judged.py"):
        here = judged(lesson, exercise, texts[lesson, exercise, solution])
        name = f"{exercise} {solution}"
        count += 1
        if verdict(here) != verdict(by_pyodide):
            new += name not in OTHERWISE_JUDGED
            print(f"{name}: {OTHERWISE_JUDGED.get(name, 'NEW')}: {by_pyodide}", flush=True)
    print(f"{count} solutions were judged")
    return new


def main() -> int:
    """Compare what the command line names."""
    subject, *names = sys.argv[1:]
    pyodide = Path(os.environ.get("WORKBENCH_PYODIDE", ROOT.parent / "shared" / "pyodide"))
    lessons = [find(name) for name in names] or list(catalog().values())
    compare = {"presets": presets, "solutions": solutions}[subject]
    with tempfile.TemporaryDirectory() as folder:
        new = compare(pyodide.resolve(), Path(folder), lessons)
    print(f"{new} differences are new")
    return int(new > 0)


if __name__ == "__main__":
    sys.exit(main())
