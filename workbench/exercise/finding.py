"""Looks exercises up: those of a lesson, by name, and those that a student's file defines."""

import functools
import importlib
import importlib.util
import pkgutil
import re
import warnings
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path, PurePath

from workbench.errors import InputError, LeftOutWarning, not_among
from workbench.exercise.model import Exercise, exercise_in
from workbench.exercise.submission import Submission, read_submission
from workbench.lesson import Lesson, catalog, course, folders, is_of_course

HIDDEN = "hidden"
"""The folder, in that of a lesson's exercises, of the files with checks that are not public."""


def exercises() -> dict[str, Exercise]:
    """Return the exercises of all lessons by name, in course order.

    A third party's exercise whose name is taken, or that cannot be loaded, is left out with a
    warning.
    """
    return {
        exercise.name: exercise
        for lesson in catalog().values()
        for exercise in usable()[lesson.name]
    }


def exercises_of(lesson: Lesson) -> tuple[Exercise, ...]:
    """Return the exercises of a lesson, its folder's files, in the order of its run's keywords.

    Of a third party's lesson, those that cannot be loaded or whose name is taken are left out with
    a warning.

    Raises:
        InputError: If one of the course, or of a lesson outside the catalogue, says too little.
    """
    listed = catalog().get(lesson.name)
    if listed is None or listed.params is not lesson.params:
        return exercises_in_folder(lesson)
    return _of_course(lesson.name) if is_of_course(listed) else usable()[lesson.name]


@functools.cache
def _of_course(name: str) -> tuple[Exercise, ...]:
    return exercises_in_folder(catalog()[name])


@functools.cache
def usable() -> dict[str, tuple[Exercise, ...]]:
    """Return the catalogue's exercises by lesson; the course's come first where names clash.

    Raises:
        InputError: If two lessons of the course have an exercise of one name; tells both places.
    """
    by_lesson = dict[str, tuple[Exercise, ...]]()
    places = dict[str, str]()
    for name, lesson in course().items():
        by_lesson[name] = _of_course(name)
        for exercise in by_lesson[name]:
            if exercise.name in places:
                raise InputError(
                    f"exercise {exercise.name} is in {places[exercise.name]} and in"
                    f" {_place(lesson)}: rename one"
                )
            places[exercise.name] = _place(lesson)
    for lesson in catalog().values():
        if lesson.name not in by_lesson:
            by_lesson[lesson.name] = _not_taken(lesson, places)
    return by_lesson


def _not_taken(lesson: Lesson, places: dict[str, str]) -> tuple[Exercise, ...]:
    kept: list[Exercise] = []
    try:
        for exercise in exercises_in_folder(lesson):
            if exercise.name in places:
                _leave_out(
                    f"exercise {exercise.name} of",
                    lesson,
                    f"its name is taken by {places[exercise.name]}",
                )
            else:
                kept.append(exercise)
                places[exercise.name] = _place(lesson)
    except (
        Exception,
        SystemExit,
    ) as error:  # somebody else's exercises must not take the course's down
        _leave_out("the exercises of", lesson, f"{type(error).__name__}: {error}")
    return tuple(kept)


def exercises_in_folder(lesson: Lesson) -> tuple[Exercise, ...]:
    """Return the exercises in a lesson's folder, whatever other lessons there are.

    Raises:
        InputError: If one says too little, or its slot or its preset is none of the lesson's.
    """
    package, _, _ = lesson.params.__module__.rpartition(".")
    if not package or importlib.util.find_spec(f"{package}.exercises") is None:
        return ()
    folder = importlib.import_module(f"{package}.exercises")
    names = [info.name for info in pkgutil.iter_modules(folder.__path__) if not info.ispkg]
    in_folder = [_exercise(folder.__name__, name, lesson) for name in names]
    slots = lesson.form.slots
    for exercise in in_folder:
        if exercise.contract.slot not in slots:
            raise InputError(
                f"exercise {exercise.name}: run of lesson {lesson.name} has no keyword"
                f" {exercise.contract.slot!r}; it has: {', '.join(slots) or 'none'}"
            )
        if exercise.contract.preset is not None:
            try:
                lesson.preset(exercise.contract.preset)
            except InputError as error:
                raise InputError(f"exercise {exercise.name}: {error}") from None
    return tuple(
        sorted(in_folder, key=lambda exercise: (slots.index(exercise.contract.slot), exercise.name))
    )


def _exercise(folder: str, name: str, lesson: Lesson) -> Exercise:
    module = importlib.import_module(f"{folder}.{name}")
    beside = importlib.util.find_spec(f"{folder}.{HIDDEN}")
    place = f"{folder}.{HIDDEN}.{name}"
    is_there = beside is not None and importlib.util.find_spec(place) is not None
    hidden = importlib.import_module(place) if is_there else None
    return exercise_in(module, lesson.name, hidden)


def _leave_out(label: str, lesson: Lesson, why: str) -> None:
    warnings.warn(LeftOutWarning(f"{label} {_place(lesson)} is left out: {why}"), stacklevel=1)


def _place(lesson: Lesson) -> str:
    return f"lesson {lesson.name} ({lesson.params.__module__})"


def find_exercise(name: str, lesson: Lesson | None = None) -> Exercise:
    """Return an exercise by its name: of a lesson, or where none is given, of the catalogue's.

    Raises:
        InputError: If there is none; lists those there are.
    """
    available = known(lesson)
    if name not in available:
        raise InputError(f"no exercise is named {name[:80]!r}; {not_among(name, available)}")
    return available[name]


def known(lesson: Lesson | None) -> Mapping[str, Exercise]:
    """Return the exercises of a lesson by name; of the catalogue where none is given."""
    return (
        _All() if lesson is None else {exercise.name: exercise for exercise in exercises_of(lesson)}
    )


class _All(Mapping[str, Exercise]):
    """The catalogue's exercises; of one of the course by name, its lesson alone is imported."""

    def __getitem__(self, name: str) -> Exercise:
        """Return an exercise; KeyError where there is none."""
        home = _homes().get(name)
        of_home = () if home is None else exercises_of(catalog()[home])
        exercise = next((exercise for exercise in of_home if exercise.name == name), None)
        return exercises()[name] if exercise is None else exercise

    def __iter__(self) -> Iterator[str]:
        return iter(exercises())

    def __len__(self) -> int:
        return len(exercises())


@functools.cache
def _homes() -> dict[str, str]:
    """Return the folder of the lesson of the course that has a file of this name among its
    exercises; no lesson is imported.
    """
    homes = {}
    for folder in folders():
        spec = importlib.util.find_spec(f"lessons.{folder}.exercises")
        places = [] if spec is None else spec.submodule_search_locations
        homes |= {info.name: folder for info in pkgutil.iter_modules(places) if not info.ispkg}
    return homes


def exercises_in(given: Path | Submission, lesson: Lesson | None = None) -> tuple[Exercise, ...]:
    """Return the exercises that a student's file is handed in for, without running it.

    They are those that `said_for` finds; where it finds none, those whose functions the file
    defines.

    Raises:
        InputError: If the file cannot be read, does not parse (with the line), or defines none.
    """
    submission = given if isinstance(given, Submission) else read_submission(given)
    if submission.broken:
        raise InputError(submission.broken)
    asked = known(lesson)
    stated = said_for(submission, lesson)
    chosen = stated or tuple(
        exercise for name, exercise in asked.items() if name in submission.defines
    )
    if not chosen:
        listed = ", ".join(asked) or "there are none"
        raise InputError(f"{submission.file}: defines none of the exercises' functions ({listed})")
    missing = [exercise.name for exercise in chosen if exercise.name not in submission.defines]
    if missing:
        raise InputError(
            f"{submission.file}: is for {', '.join(missing)} and defines"
            f" {_nearly(submission, missing)}"
        )
    return chosen


def said_for(submission: Submission, lesson: Lesson | None = None) -> tuple[Exercise, ...]:
    """Return the exercises that a file says it is handed in for, whether or not it is Python.

    A starter's first line says so, or else words of the file's name. What it says counts where the
    file defines such a function. Where it does not, the first line still counts, and so does a name
    like `my_match.py`; other words count only where the file defines no exercise's function at all.
    """
    asked = known(lesson)
    lines = [name for name in submission.said if name in asked]
    if not submission.defines.isdisjoint(lines):
        return tuple(asked[name] for name in lines)
    words = _in_words(submission.file, asked)
    names = [] if submission.defines.isdisjoint(words) else words
    if not names and (
        lines or submission.defines.isdisjoint(asked) or _begins_with_my(submission.file, words)
    ):
        names = lines or words
    return tuple(asked[name] for name in names)


def _in_words(file: str, names: Iterable[str]) -> list[str]:
    """Return the names whose words stand in a row in a file's name; of two the longer."""
    words = _words(file)
    places: list[tuple[int, int, str]] = []
    for name in names:
        parts = name.lower().split("_")
        ends = range(len(parts), len(words) + 1)
        places += [
            (end - len(parts), end, name) for end in ends if words[end - len(parts) : end] == parts
        ]
    longest = [
        (first, end, name)
        for first, end, name in places
        if not any(a <= first and end <= b and b - a > end - first for a, b, _ in places)
    ]
    return list(dict.fromkeys(name for _, _, name in sorted(longest)))


def _begins_with_my(file: str, names: list[str]) -> bool:
    words = _words(file)
    starts = [words[k + 1 :] for k, word in enumerate(words) if word == "my"]
    parts = [name.lower().split("_") for name in names]
    return any(rest[: len(part)] == part for rest in starts for part in parts)


def _words(file: str) -> list[str]:
    return [word for word in re.split(r"[\W_]+", PurePath(file).stem.lower()) if word]


def _nearly(submission: Submission, missing: list[str]) -> str:
    """Say that a file has no such function, and which other spelling it has."""
    wanted = {name.replace("_", "").lower() for name in missing}
    near = [name for name in sorted(submission.defines) if name.replace("_", "").lower() in wanted]
    return (
        f"no such function; it defines {near[0]}, which is another name"
        if near
        else "no such function"
    )
