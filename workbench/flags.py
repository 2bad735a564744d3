"""Command-line flags made from the signature of a command and the Params of a lesson, by tyro.

A command is a function whose parameters are `Annotated[type, Option(...)]`, positional on the command line where they are
positional-only. A parameter of type `Chosen` becomes LESSON, --preset and one flag per Params field; one of type
`Serving` becomes --host, --port and --no-browser. Whatever cannot be used raises InputError with one line.
"""

import contextlib
import difflib
import inspect
import io
import os
import re
import shlex
from collections.abc import Callable, Sequence
from dataclasses import dataclass, fields, make_dataclass
from pathlib import Path
from typing import Annotated, Any, TypeAlias, get_args

from workbench import knobs
from workbench.errors import InputError
from workbench.lesson import Lesson, catalog, find
from workbench.loading import load, taken_by, word_for

RESERVED = frozenset(
    {"lesson", "preset", "step", "out", "force", "host", "port", "browser", "with", "native", "help", "params"}
)
"""Flags of the commands, words of links, keywords of `record`: no Params field may have one of these names."""

SWITCHES = frozenset({"--no-browser", "--force"})
"""Flags without a value, of the commands that take a lesson."""

Flag: TypeAlias = tuple[str, Any, Any]
"""A field of what tyro fills in: name, annotated type, default; `...` where one must be given."""


@dataclass(frozen=True)
class Option:
    """What `--help` says of an option, the placeholder of its value, and a short form such as `-o`."""

    help: str
    placeholder: str | None = None
    short: str | None = None


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
class Chosen:
    """A lesson and its params, as asked for, and the preset they started from (flags may have changed them since)."""

    lesson: Lesson
    params: Any
    preset: str | None = None


@dataclass(frozen=True)
class _Part:
    """One parameter of a command: its flags, how its value is read off what was given, and whom the flags belong to."""

    flags: tuple[Flag, ...]
    read: Callable[[Any], Any]
    owner: Lesson | None = None


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
    parts = {name: _part(parameter, left, prog) for name, parameter in signature.parameters.items()}
    for lesson in (part.owner for part in parts.values() if part.owner is not None):
        prog, description = f"{prog} {lesson.name}", f"{description}\n\n{lesson.title}: {lesson.summary}"
    values = _values([flag for part in parts.values() for flag in part.flags], left, prog, description)
    call = signature.bind_partial()
    call.arguments.update({name: part.read(values) for name, part in parts.items()})
    return lambda: function(*call.args, **call.kwargs)


def command_line(*words: object) -> str:
    """Return a command of the workbench as a person can type it, quoted for a shell."""
    return shlex.join(["workbench", *map(str, words)])


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


def _part(parameter: inspect.Parameter, left: list[str], prog: str) -> _Part:
    if parameter.annotation is Chosen:
        return _lesson_part(left, prog)
    if parameter.annotation is Serving:
        parts = {f.name: _option(f.name, f.type, f.default) for f in fields(Serving)}
        group = _group("Serving", [flag for part in parts.values() for flag in part.flags])
        return _Part(
            (("serving", group, ...),),
            lambda values: Serving(**{name: part.read(values.serving) for name, part in parts.items()}),
        )
    default = ... if parameter.default is parameter.empty else parameter.default
    if isinstance(default, tuple):
        left[:] = _gathered("--" + parameter.name.replace("_", "-"), left)
    return _option(parameter.name, parameter.annotation, default, parameter.kind is parameter.POSITIONAL_ONLY)


def _option(name: str, annotation: Any, default: Any, positional: bool = False) -> _Part:
    """Return an option of the command itself; whole numbers are read here, to say it in one line."""
    kind, option = get_args(annotation)
    if int not in (kind, *get_args(kind)):
        return _Part((_flag(name, kind, option, default, positional),), lambda values: getattr(values, name))
    flag = _flag(name, str | None, option, None if default is None else str(default), positional)

    def read(values: Any) -> int | None:
        text = getattr(values, name)
        try:
            return None if text is None else int(text)
        except ValueError:
            raise InputError(f"--{name} {text}: a whole number is needed") from None

    return _Part((flag,), read)


def _lesson_part(left: list[str], prog: str) -> _Part:
    """Take the lesson's name out of the words that are left; its params become flags."""
    name = _lesson_named(left)
    if name is None:
        names = ", ".join(catalog())
        if "--help" not in left and "-h" not in left:
            raise InputError(f"which lesson? There are: {names}")
        about = Option(
            f"One of {names}, or a file my_lesson.py, or a folder. `{prog} LESSON --help` shows its parameters.",
            "LESSON",
        )
        return _Part((_flag("lesson", str, about, ..., positional=True),), lambda values: None)
    left.remove(name)
    lesson = lesson_given(name)
    preset = _given("--preset", left)
    base = lesson.params() if preset is None else lesson.preset(preset).params
    flags = [_param_flag(field, getattr(base, field.name)) for field in knobs.fields_of(lesson.params)]

    def read(values: Any) -> Chosen:
        given = vars(values.params)
        wanted = {field: given[field] for field, _, default in flags if given[field] != default}
        return Chosen(lesson, knobs.make(lesson.params, wanted, base=base), preset)

    from tyro.conf import arg

    presets = ", ".join(preset.name for preset in lesson.presets) or "none"
    group = Annotated[_group("Params", flags), arg(name=lesson.name)]
    start = _flag("preset", str | None, Option(f"Start from one of: {presets}.", "NAME"), None)
    return _Part((("params", group, ...), start), read, lesson)


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


def _gathered(flag: str, words: Sequence[str]) -> list[str]:
    """Return the words with a flag that takes many values once, at the end, however often it was given."""
    values, others, taking = [], [], False
    for word in words:
        name, _, value = word.partition("=")
        taking = name == flag or (taking and not word.startswith("-"))
        if not taking:
            others.append(word)
        elif word != flag:
            values.append(value if name == flag else word)
    if len(others) == len(words):
        return others
    if not any(values):
        raise InputError(f"{flag} needs a value behind it")
    return [*others, flag, *values]


def _given(flag: str, words: Sequence[str]) -> str | None:
    for word, following in zip(words, [*words[1:], ""], strict=False):
        if word == flag:
            return following or None
        if word.startswith(f"{flag}="):
            return word.partition("=")[2]
    return None


def _param_flag(field: knobs.Field, default: Any) -> Flag:
    """Return a flag for a Params field. It takes text: `knobs` knows kind and range, and says what is allowed."""
    knob, about = field.knob, field.knob.hint.rstrip(".")
    if field.kind == "bool":
        return _flag(field.name, bool, Option(f"{about}."), default, pair=True)
    if field.kind == "choice":
        return _flag(field.name, str, Option(f"{about}.", "{" + ",".join(field.choices) + "}"), default)
    if field.kind == "path":
        return _flag(field.name, str, Option(f"{about}.", "FILE"), "" if default is None else str(default))
    one = "INT" if field.kind in ("int", "ints") else "NUMBER"
    unit = f" {knob.unit}" if knob.unit else ""
    about = f"{about}: {knob.low:g} to {knob.high:g}{unit}{' each' if field.length else ''}."
    text = ",".join(f"{part:.17g}" if part != float(f"{part:g}") else f"{part:g}" for part in _tuple(default))
    return _flag(field.name, str, Option(about, ",".join([one] * (field.length or 1))), text)


def _tuple(value: Any) -> tuple:
    return value if isinstance(value, tuple) else (value,)


def _flag(name: str, kind: Any, option: Option, default: Any, positional: bool = False, pair: bool = False) -> Flag:
    from tyro.conf import FlagCreatePairsOff, Positional, arg

    hint = "(required)" if default is ... else "" if default in (None, "", (), True, False) and not pair else None
    aliases = (option.short,) if option.short else None
    shown = name.rstrip("_") if name.endswith("_") else None  # a Python keyword, such as --with
    config = arg(
        name=shown,
        help=option.help,
        metavar=option.placeholder,
        prefix_name=False,
        aliases=aliases,
        help_behavior_hint=hint,
    )
    annotated = Annotated[kind, config]
    if positional:
        return name, Positional[annotated], default
    return name, annotated if pair or kind is not bool else FlagCreatePairsOff[annotated], default


def _group(name: str, flags: Sequence[Flag]) -> type:
    required = [flag[:2] for flag in flags if flag[2] is ...]
    return make_dataclass(name, [*required, *(flag for flag in flags if flag[2] is not ...)])


def _values(flags: Sequence[Flag], words: Sequence[str], prog: str, description: str) -> Any:
    import tyro

    complaint = io.StringIO()
    try:
        with contextlib.redirect_stderr(complaint):
            values, unknown = tyro.cli(
                _group("Options", flags), args=words, prog=prog, description=description, return_unknown_args=True
            )
    except SystemExit as stop:
        if stop.code in (0, None):
            raise
        raise InputError(_sentence(complaint.getvalue())) from None
    if unknown:
        raise InputError(_unknown(unknown[0], values))
    return values


def _unknown(word: str, values: Any) -> str:
    if not word.startswith("-"):
        return f"{word!r} stands behind no flag; --help lists them all"
    nested = [name for group in vars(values).values() if hasattr(group, "__dict__") for name in vars(group)]
    names = [f"--{name.replace('_', '-')}" for name in (*vars(values), *nested)]
    close = difflib.get_close_matches(word.partition("=")[0].replace("_", "-"), names, 1)
    return f"unknown flag {word}; " + (f"did you mean {close[0]}?" if close else "--help lists them all")


def _sentence(box: str) -> str:
    """Return what a framed complaint says above its first rule, as one line."""
    rows = [line.strip("│ ") for line in box.splitlines() if not line.startswith(("╭", "╰"))]
    rows = rows[: next((i for i, row in enumerate(rows) if set(row) <= {"─"}), None)]
    if rows and rows[0].startswith("Missing from"):
        return f"{rows[1]} is missing: {' '.join(rows[2:]).removesuffix(' (required)')}"
    return re.sub(r"Missing value for argument '(.*?)'\..*", r"\1 needs a value behind it", " ".join(rows))
