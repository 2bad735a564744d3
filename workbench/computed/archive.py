"""The archive that a page's worker unpacks: the core and lessons.

Pyodide's own numpy (2.0 or later) and scipy (1.14 or later) are all that it needs besides:
`unchecked` stands for jaxtyping in it.

It holds no hidden checks: they are files of their own, which are left out. An exercise that keeps
some in its own file is left out as a whole. References and alternatives can be read in it, as in
the repository.
"""

import ast
import importlib
import io
import json
import zipfile
from collections.abc import Iterable
from pathlib import Path
from typing import Any

from workbench.computed import unchecked
from workbench.computed.runner import EXERCISES
from workbench.data.files import samples
from workbench.errors import InputError
from workbench.exercise.finding import HIDDEN, exercises_of
from workbench.exercise.model import Exercise
from workbench.exercise.starter import starter
from workbench.lesson import Lesson, is_of_course

ROOT = Path(__file__).resolve().parents[2]
"""Where the packages of ours are."""
LEFT_OUT = {"authoring", "handout", "notebook.py", "publish", "recording", "viewer", "cli.py"}
"""Parts of the workbench that no run, page data or judge imports."""


def packed(lessons: Iterable[Lesson]) -> bytes:
    """Return the archive with these lessons of the course; the same lessons give the same bytes."""
    file = io.BytesIO()
    with zipfile.ZipFile(file, "w") as archive:
        for name, content in sorted(files_of(list(lessons)).items()):
            archive.writestr(zipfile.ZipInfo(name), content, zipfile.ZIP_DEFLATED, 9)
    return file.getvalue()


def files_of(lessons: Iterable[Lesson]) -> dict[str, bytes]:
    """Return what the archive holds, by name.

    Raises:
        InputError: If a lesson is not one of the course: a worker imports it by its name.
    """
    contents = {"jaxtyping.py": Path(unchecked.__file__).read_bytes()}
    folders = [ROOT / "workbench"]
    files = {ROOT / "lessons" / "__init__.py"}
    for lesson in lessons:
        folder = ROOT / "lessons" / lesson.name
        if not is_of_course(lesson):
            raise InputError(f"lesson {lesson.name} is none of the course: it is not computed here")
        folders.append(folder)
        if (folder / "stored.py").is_file():  # what it cannot compute in a browser
            stored = importlib.import_module(f"lessons.{lesson.name}.stored").files()
            contents |= {f"lessons/{lesson.name}/{name}": made for name, made in stored.items()}
        contents[f"lessons/{lesson.name}/page.md"] = b""  # a lesson wants one, a run reads none
    for folder in folders:
        files |= {file for file in folder.rglob("*.py") if not _left_out(file)}
    contents |= {str(file.relative_to(ROOT)): file.read_bytes() for file in files}
    place = samples.STORED.relative_to(ROOT)
    contents |= {f"{place}/{name}": content for name, content in samples.stored_files().items()}
    told = {
        lesson.name: [_told(exercise, lesson) for exercise in _shown(lesson)] for lesson in lessons
    }
    contents[str(EXERCISES.relative_to(ROOT))] = json.dumps(told).encode()
    return contents


def _left_out(file: Path) -> bool:
    parts = file.relative_to(ROOT).parts
    if parts[0] == "workbench":
        return parts[1] in LEFT_OUT
    return HIDDEN in parts or (parts[2] == "exercises" and _keeps_hidden_checks(file))


def _keeps_hidden_checks(file: Path) -> bool:
    """Tell whether an exercise's own file has checks that are hidden, read off its text."""
    return any(
        isinstance(node, ast.Call)
        and getattr(node.func, "id", "") == "check"
        and any(word.arg == "public" for word in node.keywords)
        for node in ast.walk(ast.parse(file.read_bytes()))
    )


def _shown(lesson: Lesson) -> list[Exercise]:
    home = ROOT / "lessons" / lesson.name / "exercises"
    return [
        exercise
        for exercise in exercises_of(lesson)
        if not _keeps_hidden_checks(home / f"{exercise.name}.py")
    ]


def _told(exercise: Exercise, lesson: Lesson) -> dict[str, Any]:
    """Return what the page says of an exercise before one is begun."""
    preset = exercise.contract.preset or ""
    return {
        "name": exercise.name,
        "file": exercise.file,
        "starter": starter(exercise),
        "preset": preset,
        "title": lesson.preset(preset).title if preset else "",
    }
