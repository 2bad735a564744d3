"""Marks what one student handed in: which files for which exercises, each graded."""

import functools
import hashlib
import inspect
import sys
from dataclasses import dataclass, replace
from pathlib import Path, PurePosixPath
from typing import Any

import numpy as np
import scipy

from workbench.errors import InputError, one_line
from workbench.exercise import finding
from workbench.exercise.grading import Report, grade_file
from workbench.exercise.model import Exercise
from workbench.exercise.reading import Reader
from workbench.exercise.reports import SCHEMA_VERSION, as_dict, ungraded
from workbench.exercise.sandbox import Wall, named
from workbench.exercise.submission import Submission, submission
from workbench.exercise.submissions import HandIn
from workbench.lesson import Lesson
from workbench.run.loading import load

Result = dict[str, Any]
MOST_STRAYS = 5
"""Of how many files that fit no exercise a line is said."""


@dataclass(frozen=True)
class Asked:
    """What a class was asked for, and how it is graded.

    Attributes:
        only: The exercises that are graded; empty for those that each file is handed in for.
        lesson: The path of a lesson that the catalogue does not have.
        sandbox: The name of the wall that shuts submissions in.
        seed: A teacher's number that the hidden checks are drawn from; None takes their usual
            seeds.
    """

    only: tuple[str, ...] = ()
    lesson: Path | None = None
    sandbox: str = "auto"
    seed: int | None = None

    def exercises(self) -> tuple[Exercise, ...]:
        """Return the exercises that are asked for; none where that is for each file to say.

        Raises:
            InputError: If there is none of such a name.
        """
        return tuple(finding.find_exercise(name, self.loaded()) for name in self.only)

    def of(self, given: Submission) -> tuple[Exercise, ...]:
        """Return the exercises that a file is graded by.

        Raises:
            InputError: If there are none.
        """
        exercises = finding.exercises_in(given, self.loaded())
        return tuple(
            exercise for exercise in exercises if not self.only or exercise.name in self.only
        )

    def wanted(self, given: Submission) -> tuple[Exercise, ...]:
        """Return the exercises that a file says it is for, though it may be no Python."""
        return finding.said_for(given, self.loaded())

    def loaded(self) -> Lesson | None:
        """Return the lesson of the path, None where the catalogue is meant."""
        return None if self.lesson is None else _loaded(self.lesson)

    def digest(self) -> str:
        """Return what kept results must agree with."""
        if self.lesson is not None:
            folders = [self.lesson]
        else:
            asked = self.exercises() or finding.exercises().values()
            folders = [Path(inspect.getfile(exercise.reference)).parent for exercise in asked]
        return (
            f"{self.only} {self.sandbox} {self.seed} {_grader()}"
            f" {''.join(map(_text, dict.fromkeys(folders)))}"
        )


@dataclass(frozen=True, eq=False)
class GradedFile:
    """A file that an exercise grades: its path in the student's folder, and as it was read."""

    file: str
    given: Submission
    exercise: Exercise


@dataclass(frozen=True, kw_only=True, eq=False)
class Chosen:
    """What is to be graded of what one student handed in.

    Attributes:
        graded: Which file by which exercise.
        troubles: What cannot be graded, as `ungraded` says it.
        notes: One line on each file that fits no exercise.
        missing: The exercises that are asked for, and that no file is for.
    """

    graded: list[GradedFile]
    troubles: list[dict[str, Any]]
    notes: list[str]
    missing: list[Exercise]


@functools.cache
def _loaded(path: Path) -> Lesson:
    return load(path)  # once in a process


@functools.cache
def _grader() -> str:
    """Return what tells one grader from another: the workbench's text, and the versions beneath."""
    ours = _text(Path(__file__).parents[1])
    return f"{ours} {sys.version} {np.__version__} {scipy.__version__}"


@functools.cache
def _text(folder: Path) -> str:
    files = sorted(folder.rglob("*.py")) if folder.is_dir() else [folder]
    return hashlib.sha256(b"\0".join(file.read_bytes() for file in files)).hexdigest()


def grade_student(handed: HandIn, asked: Asked) -> Result:
    """Grade what one student handed in; whatever goes wrong is part of the result."""
    result = empty(handed, asked)
    try:
        wall = named(asked.sandbox)
        result["sandbox"] = wall.name
        choice = chosen(handed, asked)
        result["ungraded"] += choice.troubles
        for part in choice.graded:
            graded = marked(part, wall, seed=asked.seed)
            if isinstance(graded, Report):
                result["reports"].append(as_dict(graded))
            else:
                result["ungraded"].append(graded)
        if asked.only:
            result["ungraded"] += [
                not_handed_in(exercise) for exercise in choice.missing if handed.files
            ]
        else:
            result["handed"] = _parts_of_lessons(result, asked)
        result["note"] = "; ".join(filter(None, [handed.note, *choice.notes]))
    except Exception as error:  # a fault of ours with one student must not stop a class
        message = (
            str(error)
            if isinstance(error, InputError)
            else f"{type(error).__name__}: {one_line(str(error))}"
        )
        result["ungraded"].append(ungraded("", None, f"could not be graded: {message}"))
    return summed(result)


def marked(
    part: GradedFile, wall: Wall, megabytes: int | None = None, *, seed: int | None = None
) -> Report | dict[str, Any]:
    """Return the report on a file, or what `ungraded` makes of it that it cannot be graded."""
    try:
        report = grade_file(part.given, part.exercise, wall=wall, megabytes=megabytes, seed=seed)
        return replace(report, file=part.file)
    except InputError as error:
        return ungraded(part.file, part.exercise, str(error))


def not_handed_in(exercise: Exercise) -> dict[str, Any]:
    """Return that an exercise was asked for and is not there."""
    return ungraded("", exercise, f"{exercise.name}: not handed in")


def _parts_of_lessons(result: Result, asked: Asked) -> list[str]:
    """Say of each lesson of which only some exercises are there how many: "pose 2 of 3"."""
    all_of_them = finding.known(asked.loaded()).values()
    present = {item["exercise"] for item in (*result["reports"], *result["ungraded"])}
    lessons = dict.fromkeys(exercise.lesson for exercise in all_of_them if exercise.name in present)
    named = {
        lesson: {exercise.name for exercise in all_of_them if exercise.lesson == lesson}
        for lesson in lessons
    }
    return [
        f"{lesson} {len(names & present)} of {len(names)}"
        for lesson, names in named.items()
        if names - present
    ]


def empty(handed: HandIn, asked: Asked) -> Result:
    """Return a student's result before anything is graded."""
    return {
        "schema": SCHEMA_VERSION,
        "student": handed.student,
        "digest": digest(handed, asked),
        "sandbox": asked.sandbox,
        "seed": asked.seed,
        "note": handed.note,
        "handed": [],
        "reports": [],
        "ungraded": [],
    }


def summed(result: Result) -> Result:
    """Say in one line why something could not be graded; None where all was."""
    errors = [item["error"] for item in result["ungraded"]]
    return result | {"error": "; ".join(errors) or None}


def chosen(handed: HandIn, asked: Asked) -> Chosen:
    """Return what is graded of a hand-in, and what cannot be; files that only help are neither."""
    troubles = [ungraded(file, None, message) for file, message in handed.troubles]
    read: dict[str, Submission] = {}
    with Reader() as reader:
        for file in handed.files:
            try:
                read[file] = _read_one(handed, file, reader)
            except InputError as error:
                troubles.append(ungraded(file, None, str(error)))
    helping = {
        str(PurePosixPath(file).with_name(f"{name}.py"))
        for file, given in read.items()
        for name in given.modules
    }
    by_exercise: dict[str, list[GradedFile]] = {}
    strays: list[dict[str, Any]] = []
    for file, given in read.items():
        said = asked.wanted(given)
        if said and asked.only and not any(exercise.name in asked.only for exercise in said):
            strays.append(
                ungraded(file, None, f"{file}: is for {said[0].name}, which is not asked for")
            )
        elif said or file not in helping:
            try:
                parts = [GradedFile(file, given, exercise) for exercise in asked.of(given)]
                for part in parts:
                    by_exercise.setdefault(part.exercise.name, []).append(part)
                if not parts:
                    strays.append(ungraded(file, None, _defines_none(file, asked)))
            except InputError as error:
                wanted = [
                    exercise for exercise in said if not asked.only or exercise.name in asked.only
                ]
                troubles += [ungraded(file, exercise, str(error)) for exercise in wanted]
                told = str(error) if given.broken or not asked.only else _defines_none(file, asked)
                strays += [] if wanted else [ungraded(file, None, told)]
    graded: list[GradedFile] = []
    for name, several in by_exercise.items():
        meant = [part for part in several if part.exercise in asked.wanted(part.given)] or several
        if len({part.given.source for part in meant}) > 1:
            files = ", ".join(part.file for part in meant)
            said = f"{name} is in several files ({files}): leave one of them"
            troubles.append(ungraded(files, meant[0].exercise, said))
        else:
            graded.append(meant[0])
    strays = strays[:MOST_STRAYS]
    notes = [item["error"] for item in strays] if graded or troubles else []
    troubles = troubles if graded or troubles else strays
    covered = {part.exercise.name for part in graded} | {item["exercise"] for item in troubles}
    missing = [exercise for exercise in asked.exercises() if exercise.name not in covered]
    if len(asked.only) == len(missing) == 1 and troubles:  # whatever was handed in was meant for it
        troubles = [
            ungraded(item["file"], missing[0], item["error"]) for item in troubles[:1]
        ] + troubles[1:]
        missing = []
    return Chosen(graded=graded, troubles=troubles, notes=notes, missing=missing)


def _defines_none(file: str, asked: Asked) -> str:
    return f"{file}: defines no function {' or '.join(asked.only)}"


def read_one(handed: HandIn, file: str) -> Submission:
    """Return one file of what a student handed in, with the modules beside it that it imports.

    Raises:
        InputError: If it is no text, or takes too long to read; one line.
    """
    with Reader() as reader:
        return _read_one(handed, file, reader)


def _read_one(handed: HandIn, file: str, reader: Reader) -> Submission:
    def extra_file(name: str) -> bytes | None:
        return handed.files.get(str(PurePosixPath(file).with_name(name)))

    return submission(PurePosixPath(file).name, handed.files[file], extra_file, reader=reader)


def digest(handed: HandIn, asked: Asked) -> str:
    """Return what a kept result must agree with: hand-in, what was asked for, and the grader."""
    parts = [handed.student, handed.note, asked.digest(), repr(handed.troubles)]
    parts += [f"{name} {hashlib.sha256(data).hexdigest()}" for name, data in handed.files.items()]
    return hashlib.sha256("\0".join(parts).encode("utf-8", "surrogateescape")).hexdigest()
