"""The list of lessons, read off their source: importing every lesson would take five times as
long.
"""

import ast
from importlib.machinery import PathFinder
from importlib.metadata import entry_points
from pathlib import Path

from workbench.chapters import place

Head = tuple[tuple[int, float, str], str]
"""A lesson's place in the course, and its summary."""


def listed() -> str:
    """Return a line per lesson in course order: its name and its summary."""
    heads = _heads()
    if heads is None:
        from workbench.lesson import catalog, place_of

        heads = [(place_of(lesson), lesson.summary) for lesson in catalog().values()]
    width = max((len(name) for (*_, name), _ in heads), default=0)
    return "".join(f"{name:<{width}}  {summary}\n" for (*_, name), summary in sorted(heads))


def _heads() -> list[Head] | None:
    """Return place and summary of all lessons, None where that cannot be told without running
    their code.
    """
    package = PathFinder.find_spec("lessons")
    if package is None or entry_points(group="workbench.lessons"):
        return None
    heads = []
    for folder in package.submodule_search_locations or ():
        for file in Path(folder).glob("*/lesson.py"):
            head = _head(ast.parse(file.read_bytes()))
            if head is None:
                return None
            heads.append(head)
    return heads


def _head(module: ast.Module) -> Head | None:
    for statement in module.body:
        value = statement.value if isinstance(statement, ast.Assign | ast.AnnAssign) else None
        if isinstance(value, ast.Call) and getattr(value.func, "id", "") == "Lesson":
            given = {
                word.arg: word.value.value
                for word in value.keywords
                if isinstance(word.value, ast.Constant)
            }
            order, name, summary = (given.get(word) for word in ("order", "name", "summary"))
            chapter = given.get("chapter", "")
            if (
                isinstance(order, int)
                and isinstance(name, str)
                and isinstance(summary, str)
                and isinstance(chapter, str)
            ):
                return place(chapter, order, name), summary
    return None
