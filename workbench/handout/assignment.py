"""What is handed out: exercises with their weights, dates, and how a service grades them."""

import datetime
import json
import uuid
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from workbench.errors import InputError
from workbench.exercise.finding import exercises_of, find_exercise
from workbench.exercise.model import Exercise
from workbench.exercise.sandbox.isolation import NAMES
from workbench.lesson import catalog

MOST_POINTS = 1e6
SERVICES = ("gradescope", "prairielearn", "folder")
MEGABYTES = {"gradescope": 512}
"""Address space of a student's process, where a service has less than we would give: its smallest
machine has 768 MB.
"""


@dataclass(frozen=True, kw_only=True)
class Assignment:
    """Exercises as one assignment of a course.

    Attributes:
        service: Where it is graded, one of SERVICES.
        exercises: What is asked for.
        weights: What each of them is worth there, in points.
        release: When it opens, the course's time; None leaves it to the service.
        due: When it closes.
        sandbox: What shuts submissions in there: a name of a wall, or `auto`.
    """

    service: str
    exercises: tuple[Exercise, ...]
    weights: tuple[float, ...]
    release: datetime.datetime | None = None
    due: datetime.datetime | None = None
    sandbox: str = "auto"

    @property
    def name(self) -> str:
        """A name for files."""
        return (
            "_".join(dict.fromkeys(e.lesson for e in self.exercises))
            if self.exercises[1:]
            else self.exercises[0].name
        )

    @property
    def title(self) -> str:
        """A name for people."""
        return ", ".join(exercise.name for exercise in self.exercises)

    @property
    def points(self) -> float:
        """What everything is worth together."""
        return sum(self.weights)

    @property
    def worth(self) -> dict[str, float]:
        """What each exercise is worth, by its name."""
        return {
            exercise.name: weight
            for exercise, weight in zip(self.exercises, self.weights, strict=True)
        }

    @property
    def megabytes(self) -> int | None:
        """Address space of a student's process there; None is what it has everywhere."""
        return MEGABYTES.get(self.service)

    def factor(self, exercise: Exercise) -> float:
        """Return what a point of an exercise's checks is worth in this assignment."""
        return self.worth[exercise.name] / exercise.points

    def identity(self, label: str) -> str:
        """Return a UUID that is the same whenever the same is handed out, so that uploading again
        replaces.
        """
        return str(uuid.uuid5(uuid.NAMESPACE_URL, f"geometry-workbench/{label}"))

    def text(self) -> str:
        """Return it as JSON, for `read`."""
        dates = {
            name: day and day.isoformat()
            for name, day in (("release", self.release), ("due", self.due))
        }
        fields = {"service": self.service, "weights": self.worth, **dates, "sandbox": self.sandbox}
        return json.dumps(fields, indent=1) + "\n"


def read(text: str) -> Assignment:
    """Return the assignment that `Assignment.text` wrote.

    Raises:
        InputError: If it names an exercise that there is not.
    """
    fields = json.loads(text)
    days = {
        name: fields[name] and datetime.datetime.fromisoformat(fields[name])
        for name in ("release", "due")
    }
    return Assignment(
        service=fields["service"],
        exercises=tuple(find_exercise(name) for name in fields["weights"]),
        weights=tuple(fields["weights"].values()),
        sandbox=fields["sandbox"],
        **days,
    )


def read_file(path: Path) -> Assignment:
    """Return the assignment that a file holds.

    Raises:
        InputError: If there is none, or it names an exercise that there is not; one line.
    """
    try:
        assignment = read(path.read_text(encoding="utf-8"))
        if not assignment.weights or not all(
            isinstance(weight, int | float) and 0 < weight <= MOST_POINTS
            for weight in assignment.weights
        ):
            raise ValueError
    except InputError as error:
        raise InputError(f"{path}: {error}") from None
    except OSError as error:
        raise InputError(f"{path}: {error.strerror or 'cannot be read'}") from None
    except (ValueError, KeyError, TypeError, AttributeError):
        raise InputError(f"{path}: is not the assignment.json of a handout") from None
    return assignment


def assigned(
    names: Sequence[str],
    *,
    service: str,
    weights: Sequence[str] = (),
    release: str | None = None,
    due: str | None = None,
    sandbox: str = "auto",
) -> Assignment:
    """Return the assignment that a person asks for in words.

    Args:
        names: Exercises, or lessons for all of theirs.
        service: One of SERVICES.
        weights: `EXERCISE=POINTS`; the others are worth the points of their checks.
        release: A day or a moment, ISO 8601; a day begins at midnight.
        due: The same; a day ends before midnight.
        sandbox: A name of a wall, or `auto`.

    Raises:
        InputError: If one of them cannot be used; one line.
    """
    if service not in SERVICES:
        raise InputError(f"--for {service}: there are {', '.join(SERVICES)}")
    if sandbox not in ("auto", *NAMES):
        raise InputError(f"--sandbox {sandbox}: there are auto, {', '.join(NAMES)}")
    exercises = [
        exercise
        for name in names
        for exercise in (
            exercises_of(catalog()[name]) if name in catalog() else (find_exercise(name),)
        )
    ]
    twice = next(
        (exercise.name for k, exercise in enumerate(exercises) if exercise in exercises[:k]), None
    )
    if twice or not exercises:
        raise InputError(
            f"{twice} is named twice" if twice else f"{', '.join(names)}: has no exercises"
        )
    worth = {exercise.name: exercise.points for exercise in exercises} | dict(map(_weight, weights))
    other = next(
        (name for name in worth if name not in {exercise.name for exercise in exercises}), None
    )
    if other:
        raise InputError(f"--weight {other}: is not handed out here")
    opens = _moment("--release", release, datetime.time())
    closes = _moment("--due", due, datetime.time(23, 59, 59))
    if opens and closes and closes <= opens:
        raise InputError(f"--due {due}: is not after --release {release}")
    return Assignment(
        service=service,
        exercises=tuple(exercises),
        weights=tuple(worth[exercise.name] for exercise in exercises),
        release=opens,
        due=closes,
        sandbox=sandbox,
    )


def _weight(word: str) -> tuple[str, float]:
    name, _, text = word.partition("=")
    try:
        points = float(text)
    except ValueError:
        points = float("nan")
    if not 0 < points <= MOST_POINTS:
        raise InputError(f"--weight {word}: EXERCISE=POINTS with points above 0 is needed")
    return name, points


def _moment(flag: str, text: str | None, whole_day: datetime.time) -> datetime.datetime | None:
    if text is None:
        return None
    try:
        moment = datetime.datetime.fromisoformat(text)
    except ValueError:
        raise InputError(
            f"{flag} {text}: a day or a moment such as 2027-03-31 or 2027-03-31T18:00 is needed"
        ) from None
    if moment.tzinfo is not None:
        raise InputError(f"{flag} {text}: leave the time zone out; services take the course's own")
    return (
        datetime.datetime.combine(moment, whole_day) if len(text) <= len("2027-03-31") else moment
    )
