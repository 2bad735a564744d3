"""Addresses of exact moments: `?lesson=icp&start_angle=120&step=7`. Everything in one is checked like any other input."""

from dataclasses import dataclass
from difflib import get_close_matches
from typing import Any
from urllib.parse import parse_qsl, urlencode

from workbench import knobs
from workbench.errors import InputError
from workbench.lesson import Lesson, catalog


@dataclass(frozen=True)
class Place:
    """A moment of the course: a lesson, its params, and a step (None: where the lesson opens)."""

    lesson: Lesson
    params: Any
    step: int | None = None


def write(place: Place) -> str:
    """Return the query of a place, starting with `?`; params at their defaults and file paths are left out."""
    private = knobs.paths_of(type(place.params))
    query = {"lesson": place.lesson.name}
    query |= {name: text for name, text in knobs.changed(place.params).items() if name not in private}
    if place.step is not None:
        query["step"] = str(place.step)
    return "?" + urlencode(query, safe=",")


def read(query: str, *, here: Lesson | None = None) -> Place | None:
    """Return the place a query names, None when it names no lesson.

    Args:
        query: What stands behind the address, with or without `?`; untrusted.
        here: A lesson that is served although the catalogue does not have it.

    Keys that are not ours, such as those of a mail program or a proxy, are left alone; a misspelt parameter is told.

    Raises:
        InputError: On an unknown lesson, value or step, a misspelt parameter, and on a parameter that names a file.
    """
    values = dict(parse_qsl(query[:4000].removeprefix("?"), keep_blank_values=True))
    name = values.pop("lesson", None)
    if name is None:
        return None
    if here is not None and name == here.name:
        lesson = here
    elif name in catalog():
        lesson = catalog()[name]
    else:
        raise InputError(f"this link names the lesson {name[:40]!r}, which is not here")
    step = values.pop("step", None)
    if step is not None and not (
        step.removeprefix("-").isascii() and step.removeprefix("-").isdigit() and len(step) < 8
    ):
        raise InputError(f"this link names step {step[:20]!r}, which is no whole number")
    preset = values.pop("preset", None)
    fields = [field.name for field in knobs.fields_of(lesson.params)]
    values = {key: value for key, value in values.items() if key in fields or get_close_matches(key, fields)}
    base = None if preset is None else lesson.preset(preset).params
    for field in knobs.fields_of(lesson.params):
        if field.sensitive and field.name in values:
            raise InputError(f"a link cannot name files: give {field.name} on the command line instead")
    params = knobs.make(lesson.params, values, base=base)
    opens = lesson.preset(preset).step if preset is not None and not values else None
    return Place(lesson, params, opens if step is None else int(step))
