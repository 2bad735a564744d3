"""Command-line flags made from the signature of a command and the Params of a lesson, read by
argparse.

A command is a function whose parameters are `Annotated[type, Option(...)]`, positional on the
command line where they are positional-only. A parameter of type `RunChoice` becomes LESSON,
--preset and one flag per Params field: `--NAME`, or `--LESSON-NAME` where the command itself has an
option of that name; one of type `Serving` becomes --host, --port and
--no-browser, and `ServingLive` --open, --behind and --workers too. Whatever cannot be used raises
InputError with one line.
"""

import argparse
import difflib
import functools
import inspect
import re
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, fields
from pathlib import Path
from typing import Annotated, Any, TypeAlias, get_args, get_origin

from workbench import knobs
from workbench.errors import InputError
from workbench.lesson import Lesson, catalog
from workbench.moved import moved
from workbench.run.loading import is_path, lesson_given

_WORDS = (
    "lesson preset step out force host port browser with native help params open behind workers key"
)
RESERVED = frozenset(_WORDS.split())
"""Flags of the commands, words of links, keywords of `record`: no Params field may have one of
these names.
"""

HELP = {"-h", "--help"}
_PARAM = "param "
"""What the value of a Params field is kept under begins so: an option of the command may have its
name.
"""


@dataclass(frozen=True)
class Option:
    """What `--help` says of an option, its value's placeholder, a short form such as `-o`, and its
    flag if not its name.
    """

    help: str
    placeholder: str = ""
    short: str | None = None
    flag: str | None = None


@dataclass(frozen=True)
class Serving:
    """Where a command serves."""

    host: Annotated[
        str, Option("Address to listen on; 0.0.0.0 lets other machines in.", "HOST")
    ] = "127.0.0.1"
    port: Annotated[int, Option("Port to listen on; 0 picks a free one.", "PORT")] = 8080
    browser: Annotated[bool, Option("Do not open a browser.")] = True

    def __post_init__(self) -> None:
        if not 0 <= self.port <= 65535:
            raise InputError(f"--port {self.port}: a port is a number from 0 to 65535")


@dataclass(frozen=True)
class ServingLive(Serving):
    """Where a command serves live pages, and who is let in."""

    open_to_all: Annotated[
        bool,
        Option("With --host: let everybody in who reaches it, without a token.", flag="--open"),
    ] = False
    behind: Annotated[
        str | None,
        Option("Name under which browsers find it, where it stands behind a proxy.", "NAME"),
    ] = None
    workers: Annotated[int, Option("One process serves a class; says where more is told.", "N")] = 1


@dataclass(frozen=True)
class RunChoice:
    """A lesson and its params, as asked for, and the preset they started from (flags may have
    changed them since).

    `path` is the lesson's file or folder, where the person named it by that.
    """

    lesson: Lesson
    params: Any
    preset: str | None = None
    path: Path | None = None


Reader: TypeAlias = Callable[[argparse.Namespace], Any]
"""Gives a command's argument its value out of what was read off the command line."""


class _Parser(argparse.ArgumentParser):
    def error(self, message: str) -> Any:
        raise InputError(message)


_layout = functools.partial(argparse.RawDescriptionHelpFormatter, max_help_position=28, width=100)


def parse(
    function: Callable[..., int | None], args: Sequence[str], prog: str, *, description: str
) -> Callable[[], int | None]:
    """Return the call of a command that the words behind its name ask for.

    Raises:
        InputError: On an unknown flag or lesson, or a value that cannot be used.
        SystemExit: After `--help`, with code 0.
    """
    signature = inspect.signature(function)
    words = _spelled(args)
    parser = _Parser(prog, description=description, allow_abbrev=False, formatter_class=_layout)
    asked = _asked(words, signature.parameters.values())
    if any(parameter.annotation is RunChoice for parameter in signature.parameters.values()):
        words, asked = _led_on(words, *asked)
    own = {
        name: parameter
        for name, parameter in signature.parameters.items()
        if parameter.annotation is not RunChoice
    }
    readers = {name: _reader(parser, parameter) for name, parameter in own.items()}
    for name in [name for name in signature.parameters if name not in own]:
        lesson_name, preset = asked
        readers[name] = _lesson_reader(parser, words, lesson_name, preset=preset)
    places = "".join(
        f"{action.metavar} " for action in parser._actions if not action.option_strings
    )
    parser.usage = f"{parser.prog} {places}[options]"
    values, unknown = parser.parse_known_intermixed_args(words)
    if unknown:
        flags = [flag for action in parser._actions for flag in action.option_strings]
        close = difflib.get_close_matches(unknown[0].partition("=")[0], flags, 1)
        parser.error(
            f"unrecognized: {unknown[0]}; "
            + (f"did you mean {close[0]}?" if close else "--help lists all flags")
        )
    call = signature.bind_partial()
    call.arguments.update({name: read(values) for name, read in readers.items()})
    return lambda: function(*call.args, **call.kwargs)


def _spelled(args: Sequence[str]) -> list[str]:
    """Return the words with hyphens for the underscores of flags, and a negative number joined to
    the flag before it.
    """
    words: list[str] = []
    for word in args:
        if words and re.fullmatch("--[^=]+", words[-1]) and re.match(r"-[\d.]", word):
            words[-1] += f"={word}"
        else:
            name, equals, value = word.partition("=")
            words.append(name.replace("_", "-") + equals + value if name.startswith("--") else word)
    return words


def _reader(parser: argparse.ArgumentParser, parameter: inspect.Parameter) -> Reader:
    """Add a parameter of a command to the parser, and return how its value is read."""
    if parameter.annotation not in (Serving, ServingLive):
        return _option(
            parser,
            parameter.name,
            parameter.annotation,
            default=parameter.default,
            positional=parameter.kind is parameter.POSITIONAL_ONLY,
        )
    group = parser.add_argument_group("serving options")
    parts = {
        field.name: _option(group, field.name, field.type, default=field.default)
        for field in fields(parameter.annotation)
    }
    return lambda values: parameter.annotation(
        **{name: read(values) for name, read in parts.items()}
    )


def _option(
    group: Any, name: str, annotation: Any, *, default: Any, positional: bool = False
) -> Reader:
    """Add an option of the command itself; a default of `Parameter.empty` means that it must be
    given.
    """
    kind, option = get_args(annotation)
    required = default is inspect.Parameter.empty
    many = get_origin(kind) is tuple
    about = option.help.replace("%", "%%") + (" (required)" if required else "")
    flag = option.flag or f"--{name.rstrip('_').replace('_', '-')}"
    names = [option.short, flag] if option.short else [flag]
    if kind is bool:
        names = [f"--no-{name}"] if default else names
        group.add_argument(
            *names, dest=name, action="store_false" if default else "store_true", help=about
        )
        return lambda values: getattr(values, name)
    if not required and default not in (None, ()):
        about += f" (default: {default})"
    kinds = (kind, *get_args(kind))
    more: dict[str, Any] = {
        "type": next((number for number in (int, float) if number in kinds), str),
        "help": about,
    }
    if positional:
        group.add_argument(name, nargs="*" if many else "?", metavar=option.placeholder, **more)
    else:
        more |= {"nargs": "+", "action": "extend"} if many else {}
        group.add_argument(*names, dest=name, metavar=option.placeholder.partition(" ")[0], **more)
    called = option.placeholder if positional else f"{names[0]} {option.placeholder}"

    def read(values: argparse.Namespace) -> Any:
        given = getattr(values, name)
        if (required and not given) or (given and many and not any(given)):
            raise InputError(f"{called} is missing: {option.help}")
        if given is None or given == []:
            return default
        if many:
            return tuple(given)
        return Path(given) if Path in kinds else given

    return read


def _asked(
    words: Sequence[str], parameters: Iterable[inspect.Parameter]
) -> tuple[str | None, str | None]:
    """Return the lesson that is named, and the preset: what stands behind another flag is its
    value, and never run.
    """
    finder = _Parser(add_help=False, allow_abbrev=False)
    for parameter in parameters:
        if parameter.annotation is not RunChoice:
            _reader(finder, parameter)
    finder.add_argument("--preset")
    finder.add_argument("lesson", nargs="?")
    values, flags = finder.parse_known_intermixed_args([word for word in words if word not in HELP])
    name = values.lesson
    if name is not None and name != words[0] and name not in catalog():
        # a flag of a lesson's params, whose value this may be
        behind = words[words.index(name) - 1]
        if behind in flags or not is_path(name):
            name = next((word for word in flags if word in catalog()), None)
    return name, values.preset


def _led_on(
    words: list[str], name: str | None, preset: str | None
) -> tuple[list[str], tuple[str | None, str | None]]:
    """Return the words with the lesson, preset and flags that they name where these are now."""
    places = {i: word for i, word in enumerate(words) if word.startswith("--") and word not in HELP}
    given = {word[2:].partition("=")[0].replace("-", "_"): i for i, word in places.items()}

    def value_of(i: int) -> str:
        return words[i].partition("=")[2] or (words[i + 1] if i + 1 < len(words) else "")

    values = {flag: value_of(i) for flag, i in given.items()}
    led = moved(name or "", preset, values)
    if name is None or (led.lesson == name and led.values == values):
        return words, (name, preset)
    dropped = set[int]()
    for flag, i in given.items():
        if flag not in led.values:
            dropped |= {i} if "=" in words[i] else {i, i + 1}
    kept = [word for i, word in enumerate(words) if i not in dropped]
    kept[kept.index(name)] = led.lesson
    more = [
        f"--{flag.replace('_', '-')}={value}"
        for flag, value in led.values.items()
        if flag not in values
    ]
    return [*kept, *more], (led.lesson, led.preset)


def _lesson_reader(
    parser: _Parser, words: list[str], name: str | None, *, preset: str | None
) -> Reader:
    """Take the lesson's name out of the words; its params become flags."""
    if name is None:
        names = ", ".join(catalog())
        if not HELP & set(words):
            raise InputError(f"which lesson? There are: {names}")
        about = (
            f"One of {names}, or a file or folder. `{parser.prog} LESSON --help` shows its"
            " parameters."
        )
        parser.add_argument("lesson", metavar="LESSON", help=about)
        return lambda values: None
    words.remove(name)
    lesson = lesson_given(name)
    base = lesson.params() if preset is None else lesson.preset(preset).params
    parser.prog += f" {lesson.name}"
    parser.description = f"{parser.description}\n\n{lesson.title}: {lesson.summary}"
    presets = ", ".join(preset.name for preset in lesson.presets) or "none"
    parser.add_argument("--preset", metavar="NAME", help=f"Start from one of: {presets}.")
    group = parser.add_argument_group(f"{lesson.name} options")
    fields_ = knobs.fields_of(lesson.params)
    for field in fields_:
        taken = _flag(field.name) in parser._option_string_actions
        flag = _flag(f"{lesson.name}_{field.name}" if taken else field.name)
        _add_param(group, field, getattr(base, field.name), flag=flag)

    def read(values: argparse.Namespace) -> RunChoice:
        given = {
            field.name: value
            for field in fields_
            if (value := getattr(values, _PARAM + field.name)) is not None
        }
        path = Path(name) if is_path(name) else None
        made = knobs.make(lesson.params, given, base=base)
        files = [field.name for field in fields_ if field.kind == "path" and field.name in given]
        try:
            return RunChoice(lesson, knobs.showing(made, files, kept=given), preset, path)
        except InputError as error:
            with knobs.called_by_flags():
                raise InputError(knobs.in_words(str(error), lesson.params)) from None

    return read


def _flag(name: str) -> str:
    return "--" + name.replace("_", "-")


def _add_param(group: Any, field: knobs.ParamField, default: Any, *, flag: str) -> None:
    """Add the flag of a Params field. It takes text: `knobs` knows kind and range, and says what is
    allowed.
    """
    knob = field.knob
    about = field.knob.hint.rstrip(".")
    shown = "" if default in (None, "") else f" (default: {knobs.text_of(default)})"
    more: dict[str, Any] = {"dest": _PARAM + field.name}
    if field.kind == "bool":
        shown = f" (default: {'on' if default else 'off'})"
        more |= {"action": argparse.BooleanOptionalAction, "default": None}
    elif field.kind == "path":
        more["metavar"] = "FILE"
    elif field.kind == "choice":
        more["metavar"] = "{" + ",".join(field.choices) + "}"
    else:
        placeholder = "INT" if field.kind in ("int", "ints") else "NUMBER"
        more["metavar"] = ",".join([placeholder] * (field.length or 1))
        unit = f" {knob.unit}" if knob.unit else ""
        about = f"{about}: {knob.low:g} to {knob.high:g}{unit}{' each' if field.length else ''}"
    group.add_argument(flag, help=f"{about}.{shown}".replace("%", "%%"), **more)
