"""What students hand in, graded: prints per exercise how many right and wrong solutions get what
they deserve.

    python -m tests.exercise.table [EXERCISE ...] [--said]

`solutions/NAME.py` has functions `right_...` and `wrong_...` as students write them; those of a
file share one process. Its NAMED says which of the wrong ones make a mistake that the exercise
knows; no other may be named.
"""

import ast
import sys
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from workbench.authoring.exercise_promises import is_vague
from workbench.exercise.finding import exercises
from workbench.exercise.grading import Report, grade_function
from workbench.exercise.model import Exercise
from workbench.exercise.reports import terminal
from workbench.exercise.sandbox import SandboxedFunction
from workbench.exercise.submission import Submission

FOLDER = Path(__file__).with_name("solutions")
DISPATCH = "\n\ndef any_of_these(name, *args):\n    return globals()[name](*args)\n"
FATES = ("full", "less", "named", "misnamed", "useful", "vague")


class HandIn:
    """One of the functions of a file, in the process that all of them share."""

    def __init__(self, student: SandboxedFunction, name: str):
        self._student, self._name = student, name

    def __call__(self, *args: Any) -> Any:
        return self._student(self._name, *args)

    @property
    def changed_inputs(self) -> bool:
        return self._student.changed_inputs


@dataclass(frozen=True)
class Graded:
    """A solution and what became of it.

    Attributes:
        name: The function's name.
        report: What grading found.
        named: The mistake that it makes, if the exercise knows it.
    """

    name: str
    report: Report
    named: str | None

    @property
    def is_right(self) -> bool:
        return self.name.startswith("right_")

    @property
    def fate(self) -> str:
        """What became of it: one of FATES."""
        if self.is_right or self.report.is_full:
            return "full" if self.report.is_full else "less"
        mistake = None if self.report.mistake is None else self.report.mistake.name
        if mistake is not None:
            return "named" if mistake == self.named else "misnamed"
        return "vague" if any(map(is_vague, self.report.outcomes)) else "useful"


def graded(exercise: Exercise) -> Iterator[Graded]:
    """Yield what became of each solution of an exercise."""
    path = FOLDER / f"{exercise.name}.py"
    source = path.read_text(encoding="utf-8")
    tree = ast.parse(source)
    names = [node.name for node in tree.body if isinstance(node, (ast.FunctionDef, ast.ClassDef))]
    names += [
        t.id
        for node in tree.body
        if isinstance(node, ast.Assign)
        for t in node.targets
        if isinstance(t, ast.Name)
    ]
    named = {}
    for node in tree.body:
        if isinstance(node, ast.Assign) and ast.unparse(node.targets[0]) == "NAMED":
            named = ast.literal_eval(node.value)
    with SandboxedFunction(
        Submission(path.name, source + DISPATCH), "any_of_these", seconds=10.0
    ) as student:
        for name in names:
            if name.startswith(("right_", "wrong_")):
                handed = HandIn(student, name)
                yield Graded(
                    name, grade_function(handed, exercise, file=path.name), named.get(name)
                )


def graded_strangers() -> Iterator[Graded]:
    """Yield what became of each answer in `strangers/`: right ones by people who did not see the
    checks.
    """
    known = exercises()
    for path in sorted(FOLDER.with_name("strangers").glob("*.py")):
        source = path.read_text(encoding="utf-8")
        with SandboxedFunction(
            Submission(path.name, source + DISPATCH), "any_of_these", seconds=10.0
        ) as student:
            for node in ast.parse(source).body:
                if isinstance(node, ast.FunctionDef):
                    exercise, _, kind = node.name.partition("__")
                    handed = HandIn(student, node.name)
                    report = grade_function(handed, known[exercise], file=path.name)
                    yield Graded(f"right_{kind}", report, None)


def complaints(solutions: list[Graded]) -> list[str]:
    """Return what is not as it should be: a line for each solution."""
    lines = []
    for solution in solutions:
        wanted = ("named",) if solution.named else ("useful", "vague")
        if solution.is_right:
            wanted = ("full",)
        if solution.fate not in wanted:
            asked = f", not {solution.named}" if solution.named else ""
            lines.append(f"{solution.name}: {solution.fate}{asked}\n{terminal(solution.report)}")
    return lines


def counts(solutions: list[Graded]) -> Counter[str]:
    """Return how many had which fate, right ones and wrong ones apart."""
    return Counter(
        f"{'right' if solution.is_right else 'wrong'} {solution.fate}" for solution in solutions
    )


def main(arguments: list[str]) -> None:
    """Print the table; with --said also every report."""
    columns = ["right full", "right less", *(f"wrong {fate}" for fate in FATES if fate != "less")]
    write = sys.stdout.write
    write(f"{'exercise':26}" + "".join(f"{column:>16}" for column in columns) + "\n")
    total: Counter[str] = Counter()
    for exercise in exercises().values():
        wanted = [name for name in arguments if not name.startswith("-")]
        if (wanted and exercise.name not in wanted) or not (
            FOLDER / f"{exercise.name}.py"
        ).exists():
            continue
        solutions = list(graded(exercise))
        total += counts(solutions)
        write(
            f"{exercise.name:26}"
            + "".join(f"{counts(solutions)[column]:16}" for column in columns)
            + "\n"
        )
        for solution in solutions if "--said" in arguments else ():
            write(f"\n{solution.name}: {solution.fate}\n{terminal(solution.report)}\n")
        for line in complaints(solutions) if "--said" not in arguments else ():
            write(f"  ! {line}\n")
    write(f"{'all':26}" + "".join(f"{total[column]:16}" for column in columns) + "\n")


if __name__ == "__main__":
    main(sys.argv[1:])
