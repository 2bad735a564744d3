"""Marks what one student handed in: which files are for which exercises, each graded, whatever goes wrong said."""

import functools
import hashlib
import inspect
import sys
from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path, PurePosixPath
from typing import Any

import numpy as np
import scipy

import workbench
from workbench.errors import InputError, one_line
from workbench.exercise import finding
from workbench.exercise.grading import Report, grade_file
from workbench.exercise.handed import Handed
from workbench.exercise.model import Exercise
from workbench.exercise.reports import SCHEMA_VERSION, as_dict, ungraded
from workbench.exercise.sandbox import Wall, named
from workbench.exercise.submission import Submission, submission
from workbench.lesson import Lesson
from workbench.loading import load

Result = dict[str, Any]


@dataclass(frozen=True)
class Asked:
    """What a class was asked for, and how it is graded.

    Attributes:
        only: The one exercise; None for those that each file is handed in for.
        lesson: The path of a lesson that the catalogue does not have; the processes that grade load it by that.
        sandbox: The name of the wall that shuts submissions in.
    """

    only: str | None = None
    lesson: Path | None = None
    sandbox: str = "auto"

    def exercises(self, given: Submission) -> tuple[Exercise, ...]:
        """Return the exercises that a submission is graded by.

        Raises:
            InputError: If there are none.
        """
        return (self.one(),) if self.only else finding.exercises_in(given, self.loaded())

    def one(self) -> Exercise:
        """Return the only exercise.

        Raises:
            InputError: If there is none of that name.
        """
        return finding.find_exercise(self.only or "", self.loaded())

    def wanted(self, given: Submission) -> tuple[Exercise, ...]:
        """Return the exercises that a file says it is for, though it may be no Python."""
        return (self.one(),) if self.only else finding.said_for(given, self.loaded())

    def loaded(self) -> Lesson | None:
        """Return the lesson of the path, None where the catalogue is meant."""
        return None if self.lesson is None else _loaded(self.lesson)

    def digest(self) -> str:
        """Return what kept results must agree with."""
        if self.lesson is not None:
            folders = [self.lesson]
        else:
            asked = [finding.find_exercise(self.only)] if self.only else finding.exercises().values()
            folders = [Path(inspect.getfile(exercise.reference)).parent for exercise in asked]
        return f"{self.only} {self.sandbox} {_grader()} {''.join(map(_text, dict.fromkeys(folders)))}"


@functools.cache
def _loaded(path: Path) -> Lesson:
    return load(path)  # once in a process


@functools.cache
def _grader() -> str:
    """Return what tells one grader from another: the text of the workbench, and the versions beneath."""
    ours = "".join(_text(Path(place)) for place in workbench.__path__)
    return f"{ours} {sys.version} {np.__version__} {scipy.__version__}"


@functools.cache
def _text(folder: Path) -> str:
    files = sorted(folder.rglob("*.py")) if folder.is_dir() else [folder]
    return hashlib.sha256(b"\0".join(file.read_bytes() for file in files)).hexdigest()


def grade_student(handed: Handed, asked: Asked) -> Result:
    """Grade what one student handed in and return the result as plain data; whatever goes wrong is part of it."""
    result = empty(handed, asked)
    try:
        wall = named(asked.sandbox)
        result["sandbox"] = wall.name
        for found in marked(handed, asked, wall):
            if isinstance(found, Report):
                result["reports"].append(as_dict(found))
            else:
                result["ungraded"].append(found)
    except Exception as error:  # a fault of ours with one student must not stop a class
        said = str(error) if isinstance(error, InputError) else f"{type(error).__name__}: {one_line(str(error))}"
        result["ungraded"].append(ungraded("", None, f"could not be graded: {said}"))
    return summed(result)


def marked(handed: Handed, asked: Asked, wall: Wall, megabytes: int | None = None) -> Iterator[Report | dict[str, Any]]:
    """Yield the reports on what one student handed in, and what cannot be graded, as `ungraded` says it.

    Args:
        handed: What the student handed in.
        asked: What for.
        wall: What shuts the student's process in.
        megabytes: Address space of that process, where it is not what it has everywhere.
    """
    chosen, troubles = _chosen(handed, asked)
    yield from troubles
    for name, (given, exercise) in chosen.items():
        file = name.partition("\0")[0]
        try:
            yield replace(grade_file(given, exercise, wall=wall, megabytes=megabytes), file=file)
        except InputError as error:
            yield ungraded(file, exercise, str(error))


def empty(handed: Handed, asked: Asked) -> Result:
    """Return a student's result before anything is graded."""
    return {
        "schema": SCHEMA_VERSION,
        "student": handed.student,
        "digest": digest(handed, asked),
        "sandbox": asked.sandbox,
        "note": handed.note,
        "reports": [],
        "ungraded": [],
    }


def summed(result: Result) -> Result:
    """Say in one line why something could not be graded; None where all was."""
    said = [item["error"] for item in result["ungraded"]]
    return result | {"error": "; ".join(said) or None}


def _chosen(handed: Handed, asked: Asked) -> tuple[dict[str, tuple[Submission, Exercise]], list[dict[str, Any]]]:
    """Return what is graded, by its file and exercise, and what cannot be; what only helps other files is neither."""
    troubles = [ungraded(file, None, said) for file, said in handed.troubles]
    read: dict[str, Submission] = {}
    for file in handed.files:
        try:
            read[file] = read_one(handed, file)
        except InputError as error:
            troubles.append(ungraded(file, None, str(error)))
    helping = {str(PurePosixPath(file).with_name(f"{name}.py")) for file, one in read.items() for name in one.modules}
    found: dict[str, list[tuple[str, Submission, Exercise]]] = {}
    nothing: list[dict[str, Any]] = []
    for file, one in read.items():
        if file in helping and not asked.wanted(one):
            continue
        try:
            for exercise in asked.exercises(one):
                found.setdefault(exercise.name, []).append((file, one, exercise))
        except InputError as error:
            wanted = asked.wanted(one) or (None,)
            (troubles if wanted[0] else nothing).extend(ungraded(file, exercise, str(error)) for exercise in wanted)
    chosen: dict[str, tuple[Submission, Exercise]] = {}
    for name, several in found.items():
        meant = [one for one in several if name in one[1].marked()]
        if not meant and several[1:] and not any(_defines(one, name) for _, one, _ in several):
            troubles.append(ungraded("", several[0][2], f"none of the {len(several)} files defines {name}"))
            continue
        meant = meant or several
        if asked.only:
            meant = [one for one in meant if _defines(one[1], name)] or meant[:1]
        if len({one.source for _, one, _ in meant}) > 1:
            files = ", ".join(file for file, _, _ in meant)
            troubles.append(ungraded(files, meant[0][2], f"{name} is in several files ({files}): leave one of them"))
        else:
            file, one, exercise = meant[0]
            chosen[f"{file}\0{name}"] = (one, exercise)
    return chosen, troubles if chosen or troubles else nothing[:3]


def read_one(handed: Handed, file: str) -> Submission:
    """Return one file of what a student handed in, with the modules beside it that it imports.

    Raises:
        InputError: If it is no text; one line.
    """

    def beside(name: str) -> bytes | None:
        return handed.files.get(str(PurePosixPath(file).with_name(name)))

    return submission(PurePosixPath(file).name, handed.files[file], beside)


def _defines(given: Submission, name: str) -> bool:
    try:
        return name in given.defined()
    except InputError:  # who runs it says why not
        return False


def digest(handed: Handed, asked: Asked) -> str:
    """Return what a kept result must agree with: what was handed in, what was asked for, and who graded it."""
    parts = [handed.student, handed.note, asked.digest(), repr(handed.troubles)]
    parts += [f"{name} {hashlib.sha256(data).hexdigest()}" for name, data in handed.files.items()]
    return hashlib.sha256("\0".join(parts).encode("utf-8", "surrogateescape")).hexdigest()
