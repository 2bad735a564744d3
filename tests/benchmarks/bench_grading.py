"""How long a call across the pipe takes beyond the student's own work, and how long a class of 200
takes to grade.

`python -m tests.benchmarks.bench_grading`
"""

import tempfile
import time
from collections import Counter
from pathlib import Path

import numpy as np

from tests.exercise.batch import write_class
from tests.exercise.centroid import EXERCISE
from workbench.exercise import classroom, finding
from workbench.exercise.sandbox import SandboxedFunction


def main() -> None:
    """Print both figures."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "my_centroid.py"
        path.write_text("def centroid(p):\n    return p\n")
        p = np.random.default_rng(0).normal(size=(2000, 3))
        with SandboxedFunction(path, "centroid") as student:
            student(p)
            times = []
            for _ in range(200):
                began = time.perf_counter()
                student(p)
                times.append(time.perf_counter() - began)
        print(
            f"a call with 2,000 points there and back: median {1000 * np.median(times):.2f} ms"
            " (goal: below 2 ms)"
        )

        finding.exercises = lambda: {"centroid": EXERCISE}
        kinds = write_class(Path(folder) / "in", 200)
        began = time.perf_counter()
        results = classroom.grade_class(Path(folder) / "in", Path(folder) / "out")
        points = Counter()
        for result in results:
            grade = (
                "not graded"
                if result["error"]
                else f"{sum(r['points'] for r in result['reports']):g} points"
            )
            points[kinds[result["student"]], grade] += 1
        print(f"a class of 200 in {time.perf_counter() - began:.0f} s:")
        for (kind, grade), count in sorted(points.items()):
            print(f"  {count:3d} {kind:<7} {grade}")


if __name__ == "__main__":
    main()
