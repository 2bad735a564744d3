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
    for there in lines_of(pyodide, core, "summarised.py", words=[f"{name} *" for name in runners]):
        run = there["run"]
        lesson, _, name = run.partition(" ")
        found = differences(summary(runners[lesson], name), there)
        new += bool(found) and run not in DIFFERENT
        if found:
            print(f"{run}: {DIFFERENT.get(run, 'NEW')}: {found[0]}", flush=True)
    return new


def solutions(pyodide: Path, folder: Path, lessons: list[Lesson]) -> int:
    """Compare verdicts; return how many differ that are not known to."""
    tasks = [task for lesson in lessons for task in tasks_of(lesson)]
    texts = {task[:3]: task[3] for task in tasks}
    core = make_archive(folder / "core.zip", tasks)
    new = count = 0
    for lesson, exercise, what, there in lines_of(pyodide, core, "judged.py"):
        here = judged(lesson, exercise, texts[lesson, exercise, what])
        name = f"{exercise} {what}"
        count += 1
        if verdict(here) != verdict(there):
            new += name not in OTHERWISE_JUDGED
            print(f"{name}: {OTHERWISE_JUDGED.get(name, 'NEW')}: {there}", flush=True)
    print(f"{count} solutions were judged")
    return new


def main() -> int:
    """Compare what the command line names."""
    what, *names = sys.argv[1:]
    pyodide = Path(os.environ.get("WORKBENCH_PYODIDE", ROOT.parent / "shared" / "pyodide"))
    lessons = [find(name) for name in names] or list(catalog().values())
    compare = {"presets": presets, "solutions": solutions}[what]
    with tempfile.TemporaryDirectory() as folder:
        new = compare(pyodide.resolve(), Path(folder), lessons)
    print(f"{new} differences are new")
    return int(new > 0)


if __name__ == "__main__":
    sys.exit(main())
