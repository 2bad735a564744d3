"""Addresses and commands that open exact moments: `?lesson=icp&start_angle=120`, `workbench show
icp --start-angle=120`.

Everything in an address is checked like any other input.
"""

import os
import shlex
from dataclasses import dataclass
from difflib import get_close_matches
from typing import Any
from urllib.parse import parse_qsl, urlencode

from workbench import knobs
from workbench.errors import InputError
from workbench.lesson import Lesson, catalog
from workbench.moved import moved
from workbench.run.loading import word_for


@dataclass(frozen=True)
class Place:
    """A moment of the course: a lesson, its params, and a step (None: where the lesson opens)."""

    lesson: Lesson
    params: Any
    step: int | None = None


def write(place: Place) -> str:
    """Return the query of a place, starting with `?`; params at their defaults and file paths are
    left out.
    """
    private = knobs.paths_of(type(place.params))
    query = {"lesson": place.lesson.name}
    query |= {
        name: text for name, text in knobs.changed(place.params).items() if name not in private
    }
    if place.step is not None:
        query["step"] = str(place.step)
    return "?" + urlencode(query, safe=",")


def read(query: str, *, here: Lesson | None = None) -> Place | None:
    """Return the place a query names, None when it names no lesson.

    Args:
        query: What stands behind the address, with or without `?`; untrusted.
        here: A lesson that is served although the catalogue does not have it.

    Keys that are not ours, such as those of a mail program or a proxy, are left alone; a misspelt
    parameter is told.

    Raises:
        InputError: On an unknown lesson, value or step, a misspelt parameter, and on a parameter
            that names a file.
    """
    values = dict(parse_qsl(query[:4000].removeprefix("?"), keep_blank_values=True))
    name = values.pop("lesson", None)
    if name is None:
        return None
    led = moved(name, values.pop("preset", None), values)
    name, preset, values = led.lesson, led.preset, led.values
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
    fields = [field.name for field in knobs.fields_of(lesson.params)]
    values = {
        key: value
        for key, value in values.items()
        if key in fields or get_close_matches(key, fields)
    }
    base = None if preset is None else lesson.preset(preset).params
    for field in knobs.fields_of(lesson.params):
        if field.sensitive and field.name in values:
            raise InputError(
                f"a link cannot name files: give {field.name} on the command line instead"
            )
    params = knobs.make(lesson.params, values, base=base)
    opens = lesson.preset(preset).step if preset is not None and not values else None
    return Place(lesson, params, opens if step is None else int(step))


def command_line(*words: object) -> str:
    """Return a command of the workbench as a person can type it, quoted for a shell."""
    return " ".join(["workbench", *(_quoted(str(word)) for word in words)])


def _quoted(word: str) -> str:
    if word.isprintable():
        return shlex.quote(word)
    signs = {"\\": "\\\\", "'": "\\'"}
    escaped = (
        signs.get(sign, sign)
        if sign.isprintable()
        else "".join(f"\\x{byte:02x}" for byte in os.fsencode(sign))
        for sign in word
    )
    return f"$'{''.join(escaped)}'"  # a terminal that shows it obeys none of its signs


def show_command(lesson: Lesson, params: Any) -> str:
    """Return the command that opens a lesson live at these params.

    A lesson that the catalogue does not have is named by its file. Where a run reads somebody's own
    file, FILE stands in its place: what a person's folders are called is nobody else's business.
    """
    given = knobs.changed(params)
    flags = [
        _flag_of(field, given[field.name])
        for field in knobs.fields_of(type(params))
        if field.name in given
    ]
    return command_line("show", word_for(lesson.name, lesson.params.__module__), *flags)


def _flag_of(field: knobs.ParamField, text: str) -> str:
    """Return the flag that gives a field the value that `knobs.changed` writes as this text."""
    name = field.name.replace("_", "-")
    if field.kind == "bool":
        return f"--{name}" if field.clean(text) else f"--no-{name}"
    return f"--{name}={'FILE' if field.kind == 'path' else text}"
