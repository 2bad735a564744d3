"""How long it takes to record a run beside the bare run, drawn, and how large the files are.

    python -m tests.benchmarks.bench_recording

Bare and recorded runs take turns, the best of three each, so that a ratio is of one run on one
machine. The goals are of a rigid run of 50 steps over two clouds of 20,000 points: a ratio below
1.5, a file below 1 MB.
"""

import tempfile
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from itertools import islice
from pathlib import Path
from typing import Any

from lessons.icp.lesson import draw as draw_icp
from workbench.lesson import Lesson, Look, catalog
from workbench.recording.write import record_file
from workbench.run.timeline import Timeline
from workbench.scene import Scene

ROUNDS, STEPS = 3, 50


@dataclass(frozen=True)
class Task:
    """A run to record."""

    name: str
    lesson: Lesson
    params: Any


def tasks() -> Iterator[Task]:
    """Yield the run that the goals speak of, the same with its lines from point to point, and every
    default run.
    """
    icp = catalog()["icp"]
    params = replace(icp.params(), points=20_000)

    def fifty(params: Any, subject: Any) -> Iterator[Any]:
        yield from islice(icp.run(params, subject), STEPS)

    def moving(look: Look) -> Scene:
        return {path: shown for path, shown in draw_icp(look).items() if path != "matches"}

    yield Task("ICP 20k, 50 steps, rigid", replace(icp, run=fifty, draw=moving), params)
    yield Task("ICP 20k, 50 steps, with matches", replace(icp, run=fifty), params)
    for lesson in catalog().values():
        yield Task(lesson.name, lesson, lesson.params())


def seconds(work: Callable[[], object]) -> float:
    began = time.perf_counter()
    work()
    return time.perf_counter() - began


def main() -> None:
    """Print a table."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "run.rrd"
        # imports what is imported once
        record_file(catalog()["transforms"], catalog()["transforms"].params(), path)
        print(f"{'run':<32} {'bare':>8} {'recorded':>9} {'ratio':>6} {'size':>9} {'steps':>6}")
        for task in tasks():
            bare = []
            recorded = []
            steps = 0
            for _ in range(ROUNDS):
                bare.append(
                    seconds(lambda task=task: Timeline(task.lesson, task.params).complete())
                )
                began = time.perf_counter()
                steps = record_file(task.lesson, task.params, path, force=True).steps
                recorded.append(time.perf_counter() - began)
            ratio = min(recorded) / min(bare)
            size = path.stat().st_size / 1e6
            print(
                f"{task.name:<32} {min(bare):6.2f} s {min(recorded):7.2f} s {ratio:6.2f}"
                f" {size:6.2f} MB {steps:6d}",
                flush=True,
            )


if __name__ == "__main__":
    main()
