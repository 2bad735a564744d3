"""Solutions of exercises as texts: ours, and those that stand for students' in `tests/exercise`."""

import ast
from collections.abc import Iterator

from tests.exercise.table import FOLDER
from workbench.exercise.finding import exercises_of
from workbench.lesson import Lesson

Task = tuple[str, str, str, str]
"""Lesson, exercise, what the text is, and the text."""


def tasks_of(lesson: Lesson) -> Iterator[Task]:
    """Yield the solutions of a lesson's exercises."""
    for exercise in exercises_of(lesson):
        source = (FOLDER / f"{exercise.name}.py").read_text(encoding="utf-8")
        for name in defined(source):
            if name.startswith(("right_", "wrong_")):
                yield lesson.name, exercise.name, name, f"{source}\n\n{exercise.name} = {name}\n"


def defined(source: str) -> list[str]:
    """Return the names of the functions, classes and values of a text."""
    names = []
    for node in ast.parse(source).body:
        if isinstance(node, ast.FunctionDef | ast.ClassDef):
            names.append(node.name)
        elif isinstance(node, ast.Assign):
            names += [target.id for target in node.targets if isinstance(target, ast.Name)]
    return names
