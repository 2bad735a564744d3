"""Command-line flags made from the signature of a command and the Params of a lesson.

A command is a function whose parameters are `Annotated[type, Option(...)]`, positional on the command line where they are
positional-only. A parameter of type `Chosen` becomes LESSON, --preset and one flag per Params field; one of type
`Serving` becomes --host, --port and --no-browser, and `ServingLive` --open, --behind and --workers too. Whatever cannot
be used raises InputError with one line.
"""

import argparse
import difflib
import inspect
import os
import re
import shlex
from collections.abc import Callable, Sequence
from dataclasses import dataclass, fields
from pathlib import Path
from typing import Annotated, Any, TypeAlias, get_args, get_origin

from workbench import knobs
from workbench.errors import InputError
from workbench.lesson import Lesson, catalog, find
from workbench.loading import load, taken_by, word_for

RESERVED = frozenset(
    {
        *("lesson", "preset", "step", "out", "force", "host", "port", "browser", "with", "native", "help", "params"),
        *("open", "behind", "workers", "key"),
    }
)
"""Flags of the commands, words of links, keywords of `record`: no Params field may have one of these names."""

MOST_WORKERS = 64

SWITCHES = frozenset({"--no-browser", "--open", "--force"})
"""Flags without a value, of the commands that take a lesson."""


@dataclass(frozen=True)
class Option:
    """What `--help` says of an option, its value's placeholder, a short form such as `-o`, and its flag if not its name."""

    help: str
    placeholder: str | None = None
    short: str | None = None
    flag: str | None = None


@dataclass(frozen=True)
class Serving:
    """Where a command serves."""

    host: Annotated[str, Option("Address to listen on; 0.0.0.0 lets other machines in.", "HOST")] = "127.0.0.1"
    port: Annotated[int, Option("Port to listen on; 0 picks a free one.", "PORT")] = 8080
    browser: Annotated[bool, Option("Do not open a browser.")] = True

    def __post_init__(self) -> None:
        if not 0 <= self.port <= 65535:
            raise InputError(f"--port {self.port}: a port is a number from 0 to 65535")


@dataclass(frozen=True)
class ServingLive(Serving):
    """Where a command serves live pages, and who is let in."""

    open_to_all: Annotated[
        bool, Option("With --host: let everybody in who reaches it, without a token.", flag="--open")
    ] = False
    behind: Annotated[
        str | None, Option("Name under which browsers find it, where it stands behind a proxy.", "NAME")
    ] = None
    workers: Annotated[int, Option("One process serves a class; says where more is told.", "N")] = 1

    def __post_init__(self) -> None:
        super().__post_init__()
        if not 1 <= self.workers <= MOST_WORKERS:
            raise InputError(f"--workers {self.workers}: a number of processes is from 1 to {MOST_WORKERS}")


@dataclass(frozen=True)
class Chosen:
    """A lesson and its params, as asked for, and the preset they started from (flags may have changed them since).

    `path` is the lesson's file or folder, where the person named it by that.
    """

    lesson: Lesson
    params: Any
    preset: str | None = None
    path: Path | None = None


Reader: TypeAlias = Callable[[argparse.Namespace], Any]
"""Gives a command's argument its value out of what was read off the command line."""


class _Parser(argparse.ArgumentParser):
    """Reads a command line; what it cannot use raises InputError."""

    def error(self, message: str) -> Any:
        found = re.match(r"argument (?:-\w/)?(\S+?): (.*)", message)
        if found is None:
            raise InputError(message)
        name, why = found[1].partition("/")[0], found[2]
        if why.startswith("expected"):
            raise InputError(f"{name} needs a value behind it")
        raise InputError(f"{name} takes no value" if why.startswith("ignored") else f"{name}: {why}")

    def values(self, words: Sequence[str]) -> argparse.Namespace:
        """Return what the words of a command line say; a name may have underscores for its hyphens."""
        joined: list[str] = []
        for word in words:
            name, equals, value = word.partition("=")
            word = name.replace("_", "-") + equals + value if name.startswith("--") else word
            takes = self._option_string_actions.get(joined[-1]) if joined else None
            if takes is not None and takes.nargs is None and re.match(r"-[\d.]", word):
                joined[-1] += f"={word}"  # a negative number, not a flag
            else:
                joined.append(word)
        values, unknown = self.parse_known_args(joined)
        several = next((one.dest for one in self._actions if not one.option_strings and one.nargs == "*"), None)
        while several and unknown and not unknown[0].startswith("-"):  # what stands behind a flag in between
            setattr(values, several, [*(getattr(values, several) or ()), unknown.pop(0)])
        if unknown:
            raise InputError(self._unknown(unknown[0]))
        return values

    def _unknown(self, word: str) -> str:
        if not word.startswith("-"):
            return f"{word!r} stands behind no flag; --help lists them all"
        names = [name for name in self._option_string_actions if name.startswith("--")]
        close = difflib.get_close_matches(word.partition("=")[0], names, 1)
        return f"unknown flag {word}; " + (f"did you mean {close[0]}?" if close else "--help lists them all")


def parse(
    function: Callable[..., int | None], args: Sequence[str], prog: str, description: str
) -> Callable[[], int | None]:
    """Return the call of a command that a command line asks for.

    Args:
        function: The command.
        args: What stands behind the command's name.
        prog: The words that call the command.
        description: How `--help` begins.

    Raises:
        InputError: On an unknown flag or lesson, or a value that cannot be used.
        SystemExit: After `--help`, with code 0.
    """
    signature, left = inspect.signature(function), list(args)
    parser = _Parser(prog, description=description, allow_abbrev=False, formatter_class=_Help)
    readers = {name: _reader(parser, parameter, left) for name, parameter in signature.parameters.items()}
    places = " ".join(f"{action.metavar} " for action in parser._actions if not action.option_strings)
    parser.usage = f"{parser.prog} {places}[options]"
    values = parser.values(left)
    call = signature.bind_partial()
    call.arguments.update({name: read(values) for name, read in readers.items()})
    return lambda: function(*call.args, **call.kwargs)


class _Help(argparse.RawDescriptionHelpFormatter):
    def __init__(self, prog: str):
        super().__init__(prog, max_help_position=28, width=100)


def command_line(*words: object) -> str:
    """Return a command of the workbench as a person can type it, quoted for a shell."""
    return " ".join(["workbench", *(_quoted(str(word)) for word in words)])


def _quoted(word: str) -> str:
    if word.isprintable():
        return shlex.quote(word)
    signs = {"\\": "\\\\", "'": "\\'"}
    escaped = (
        signs.get(sign, sign) if sign.isprintable() else "".join(f"\\x{byte:02x}" for byte in os.fsencode(sign))
        for sign in word
    )
    return f"$'{''.join(escaped)}'"  # a terminal that shows it obeys none of its signs


def show_command(lesson: Lesson, params: Any) -> str:
    """Return the command that opens a lesson live at these params.

    A lesson that the catalogue does not have is named by its file. Where a run reads somebody's own file, FILE stands in
    its place: what a person's folders are called is nobody else's business.
    """
    given = knobs.changed(params)
    flags = [_flag_of(field, given[field.name]) for field in knobs.fields_of(type(params)) if field.name in given]
    return command_line("show", word_for(lesson.name, lesson.params.__module__), *flags)


def _flag_of(field: knobs.Field, text: str) -> str:
    """Return the flag that gives a field the value that `knobs.changed` writes as this text."""
    name = field.name.replace("_", "-")
    if field.kind == "bool":
        return f"--{name}" if field.clean(text) else f"--no-{name}"
    return f"--{name}={'FILE' if field.kind == 'path' else text}"


def _reader(parser: _Parser, parameter: inspect.Parameter, left: list[str]) -> Reader:
    """Add a parameter of a command to the parser, and return how its value is read."""
    if parameter.annotation is Chosen:
        return _lesson_reader(parser, left)
    if parameter.annotation in (Serving, ServingLive):
        group, made = parser.add_argument_group("serving options"), parameter.annotation
        parts = {field.name: _option(group, field.name, field.type, field.default) for field in fields(made)}
        return lambda values: made(**{name: read(values) for name, read in parts.items()})
    positional = parameter.kind is parameter.POSITIONAL_ONLY
    return _option(parser, parameter.name, parameter.annotation, parameter.default, positional=positional)


def _option(group: Any, name: str, annotation: Any, default: Any, *, positional: bool = False) -> Reader:
    """Add an option of the command itself; a default of `Parameter.empty` means that it must be given."""
    kind, option = get_args(annotation)
    required = default is inspect.Parameter.empty
    flag = option.flag or "--" + name.rstrip("_").replace("_", "-")
    many = get_origin(kind) is tuple
    about = option.help.replace("%", "%%") + (" (required)" if required else "")
    if kind is bool:
        names = [f"--no-{name}" if default else flag, *([option.short] if option.short else [])]
        group.add_argument(*names, dest=name, action="store_false" if default else "store_true", help=about)
        return lambda values: getattr(values, name)
    if default not in (None, inspect.Parameter.empty, ()):
        about += f" (default: {default})"
    if positional:
        group.add_argument(name, nargs="*" if many else "?", metavar=option.placeholder, help=about)
    else:
        names = [*([option.short] if option.short else []), flag]
        several = {"nargs": "+", "action": "extend"} if many else {}
        shown = (option.placeholder or "").partition(" ")[0]
        group.add_argument(*names, dest=name, metavar=shown, help=about, **several)
    called = option.placeholder if positional else " ".join([option.short or flag, option.placeholder])

    def read(values: argparse.Namespace) -> Any:
        given = getattr(values, name)
        if not given and required:
            raise InputError(f"{called} is missing: {option.help}")
        if given is None:
            return default
        if many:
            if not any(given):
                raise InputError(f"{flag} needs a value behind it")
            return tuple(given)
        return _converted(given, kind, called if positional else flag)

    return read


def _converted(text: str, kind: Any, flag: str) -> Any:
    kinds = (kind, *get_args(kind))
    if Path in kinds:
        return Path(text)
    if int not in kinds:
        return text
    try:
        return int(text)
    except ValueError:
        raise InputError(f"{flag} {text}: a whole number is needed") from None


def _lesson_reader(parser: _Parser, left: list[str]) -> Reader:
    """Take the lesson's name out of the words that are left; its params become flags."""
    name = _lesson_named(left)
    if name is None:
        names = ", ".join(catalog())
        if "--help" not in left and "-h" not in left:
            raise InputError(f"which lesson? There are: {names}")
        about = f"One of {names}, or a file or folder. `{parser.prog} LESSON --help` shows its parameters."
        parser.add_argument("lesson", metavar="LESSON", help=about)
        return lambda values: None
    left.remove(name)
    lesson = lesson_given(name)
    preset = _given("--preset", left)
    base = lesson.params() if preset is None else lesson.preset(preset).params
    parser.prog, parser.description = (
        f"{parser.prog} {lesson.name}",
        f"{parser.description}\n\n{lesson.title}: {lesson.summary}",
    )
    presets = ", ".join(preset.name for preset in lesson.presets) or "none"
    parser.add_argument("--preset", metavar="NAME", help=f"Start from one of: {presets}.")
    group, fields_ = parser.add_argument_group(f"{lesson.name} options"), knobs.fields_of(lesson.params)
    for field in fields_:
        _add_param(group, field, getattr(base, field.name))

    def read(values: argparse.Namespace) -> Chosen:
        given = {field.name: value for field in fields_ if (value := getattr(values, field.name)) is not None}
        path = Path(name) if is_path(name) else None
        made = knobs.make(lesson.params, given, base=base)
        files = [field.name for field in fields_ if field.kind == "path" and field.name in given]
        try:
            return Chosen(lesson, knobs.showing(made, files, kept=given), preset, path)
        except InputError as error:
            with knobs.called_by_flags():
                raise InputError(knobs.in_words(str(error), lesson.params)) from None

    return read


def _add_param(group: Any, field: knobs.Field, default: Any) -> None:
    """Add the flag of a Params field. It takes text: `knobs` knows kind and range, and says what is allowed."""
    knob, about, flag = field.knob, field.knob.hint.rstrip("."), "--" + field.name.replace("_", "-")
    shown = "" if default in (None, "") else f" (default: {_text(default)})"
    if field.kind == "bool":
        group.add_argument(
            flag,
            dest=field.name,
            action=argparse.BooleanOptionalAction,
            default=None,
            help=f"{about}. (default: {'on' if default else 'off'})".replace("%", "%%"),
        )
        return
    if field.kind in ("choice", "path"):
        placeholder = "FILE" if field.kind == "path" else "{" + ",".join(field.choices) + "}"
    else:
        one = "INT" if field.kind in ("int", "ints") else "NUMBER"
        placeholder = ",".join([one] * (field.length or 1))
        unit = f" {knob.unit}" if knob.unit else ""
        about = f"{about}: {knob.low:g} to {knob.high:g}{unit}{' each' if field.length else ''}"
    group.add_argument(flag, dest=field.name, metavar=placeholder, help=f"{about}.{shown}".replace("%", "%%"))


def _text(value: Any) -> str:
    """Return a default as `--help` shows it."""
    parts = value if isinstance(value, tuple) else (value,)
    return ",".join(f"{part:g}" if isinstance(part, float) else str(part) for part in parts)


def lesson_given(word: str) -> Lesson:
    """Return the lesson that a person names on the command line: by its name, or by the path of its file or folder.

    For words that a person typed only, since the file is run; names out of files and links go to `find`.

    Raises:
        InputError: If there is no such lesson, the file cannot be used, or its lesson has the name of another.
    """
    if not is_path(word):
        return find(word)
    lesson = load(Path(word))
    other = taken_by(lesson)
    if other is not None:
        raise InputError(f"{word}: its name {lesson.name!r} is taken by {other}; give it another")
    return lesson


def is_path(word: str) -> bool:
    """Tell whether a word names a lesson by its path: a Python file, a folder, or what has a slash in it."""
    return word not in catalog() and (word.endswith(".py") or os.sep in word or "/" in word or Path(word).is_dir())


def _lesson_named(words: Sequence[str]) -> str | None:
    """Return the lesson's name: the first word, or further on one that is a lesson, or a Python file behind no flag.

    What stands behind a flag is its value: `--with FILE.py` is a student's file, which is never run in this process.
    """
    if words and not words[0].startswith("-"):
        return words[0]
    for before, word in zip(["", *words], words, strict=False):
        if word in catalog() or (is_path(word) and (before in SWITCHES or not before.startswith("-"))):
            return word
    return None


def _given(flag: str, words: Sequence[str]) -> str | None:
    for word, following in zip(words, [*words[1:], ""], strict=False):
        if word == flag:
            return following or None
        if word.startswith(f"{flag}="):
            return word.partition("=")[2]
    return None
