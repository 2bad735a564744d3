"""Knobs: what a Params field says of itself, from which panels, command flags and links are
generated.

A class of inputs is a subclass of `Params` whose fields are `name: type = knob(default, "hint",
...)`. Types: `float`, `int`, `bool`, `Literal[...]` of strings, `tuple` of a fixed number of floats
or ints, `Path | None`. Lessons of the first form have a frozen dataclass in its place, whose fields
are `Annotated[type, Knob(...)]`.
"""

import contextlib
import dataclasses
import functools
import json
import math
import re
import types
from collections.abc import Collection, Iterable, Iterator, Mapping
from contextvars import ContextVar
from dataclasses import dataclass
from pathlib import Path
from typing import (
    Annotated,
    Any,
    Literal,
    TypeVar,
    Union,
    dataclass_transform,
    get_args,
    get_origin,
    get_type_hints,
)

from workbench.errors import InputError, not_among

P = TypeVar("P")

_SYMBOL = re.compile(r"([A-Za-z])(\d*)")
_CALLED = re.compile(r"“(\w+)”")
_flags: ContextVar[bool] = ContextVar("flags", default=False)
_SUBSCRIPTS = str.maketrans("0123456789", "₀₁₂₃₄₅₆₇₈₉")


@dataclass(frozen=True)
class Gizmo:
    """The field is also set by a handle in the scene.

    The field is a tuple of floats: 2 are a position in the plane z = 0, metres, 3 one in space, 6 a
    position and a rotation vector (radians), in the world.
    """

    size: float = 0.5


@dataclass(frozen=True)
class Pick:
    """The field is also set by a click on the primitive at `path`.

    The field is an int (the index of the nearest point or vertex), or a tuple of ints (the last so
    many clicks); on a Picture a pair of ints is the pixel (u, v), column first.
    """

    path: str


@dataclass(frozen=True)
class Knob:
    """How one input of a lesson is shown and set.

    Args:
        hint: One line that says what it does to the run.
        low: The lower end of the range, included; of every entry for tuples. Required for numbers.
        high: Its upper end, likewise.
        unit: Written behind the value: `m`, `deg`, `px`. Degrees are converted in the first lines
            of `run`.
        step: The slider's step; None picks a fine one.
        label: The words on the control; None makes them from the field's name.
        parts: What the entries of a tuple are called, where x, y, z would mislead.
        by: A Gizmo or a Pick where the scene sets it too.
        needs: Other params and the values they need for this one to have an effect, as {"metric":
            ("plane",)}; a page greys it out while they have others, and says so. Changing it then
            changes nothing in the run. {"scan": (None,)} asks that no own file is open as `scan`.
        of_files: It says how to read a person's own files (their unit, which axis is up), and is
            kept as long as they are.
    """

    hint: str
    low: float | None = None
    high: float | None = None
    unit: str = ""
    step: float | None = None
    label: str | None = None
    parts: tuple[str, ...] = ()
    by: Gizmo | Pick | None = None
    needs: Mapping[str, tuple[Any, ...]] = dataclasses.field(default_factory=dict, hash=False)
    of_files: bool = False


def knob(
    default: Any,
    hint: str,
    low: float | None = None,
    high: float | None = None,
    *,
    unit: str = "",
    step: float | None = None,
    label: str | None = None,
    parts: tuple[str, ...] = (),
    by: Gizmo | Pick | None = None,
    of_files: bool = False,
    read_with: Mapping[str, tuple[Any, ...]] | None = None,
) -> Any:
    """Return a field of `Params`: its default, and how it is shown and set (see `Knob`).

    There is no `needs`: a run that does not read the field leaves the control without effect, and a
    page shows it so. A file says in `read_with` which choices read it; who hands it over gets the
    first of them.
    """
    shown = Knob(
        hint,
        low,
        high,
        unit,
        step=step,
        label=label,
        parts=parts,
        by=by,
        of_files=of_files,
        needs=read_with or {},
    )
    return dataclasses.field(default=default, metadata={"knob": shown})


@dataclass_transform(frozen_default=True, kw_only_default=True)  # a knob is a default, to a checker
class Params:
    """The inputs of a lesson. A subclass is a frozen dataclass by itself: `angle: float =
    knob(30, "How far", 0, 90)`.
    """

    def __init_subclass__(cls, **kwargs: Any) -> None:
        super().__init_subclass__(**kwargs)
        dataclass(frozen=True, kw_only=True)(cls)


Kind = Literal["float", "int", "bool", "choice", "floats", "ints", "path"]


@dataclass(frozen=True)
class ParamField:
    """One field of a Params class, read: its name, kind, default, choices or length, and its
    knob.
    """

    name: str
    kind: Kind
    default: Any
    knob: Knob
    choices: tuple[str, ...] = ()
    length: int = 0

    @property
    def label(self) -> str:
        """The words on the control; a name like `k1` is a symbol and is written as formulas write
        it.
        """
        if self.knob.label is not None:
            return self.knob.label
        if symbol := _SYMBOL.fullmatch(self.name):
            return symbol[1] + symbol[2].translate(_SUBSCRIPTS)
        return self.name.replace("_", " ").capitalize()

    @property
    def step(self) -> float:
        """The slider's step."""
        if self.knob.step is not None:
            return self.knob.step
        if self.kind in ("int", "ints"):
            return 1
        span = (self.knob.high or 0.0) - (self.knob.low or 0.0)
        return 10.0 ** math.floor(math.log10(span / 99.0)) if span > 0 else 0.01

    @property
    def sensitive(self) -> bool:
        """Whether a value from a browser must not be taken: it names a file of the machine that
        serves.
        """
        return self.kind == "path"

    def clean(self, value: Any, *, clamp: bool = False) -> Any:
        """Return `value` as the field's type and inside its range.

        Args:
            value: Anything: from a browser, a link, a recording or a command line; text is parsed.
            clamp: Move a number that is out of range to the nearer end instead of refusing it.

        Raises:
            InputError: One line that names the field, the value and what is allowed.
        """
        try:
            return self._clean(value, clamp)
        except InputError:
            raise
        except (TypeError, ValueError, OverflowError):
            raise InputError(f"{self.name} = {_shown(value)}: {self._allowed()}") from None

    def _clean(self, value: Any, clamp: bool) -> Any:
        if self.kind == "path":
            return None if value in (None, "", "None") else Path(value)
        if self.kind == "bool":
            if isinstance(value, str):
                value = (
                    {"true": True, "1": True, "false": False, "0": False}[value.lower()]
                    if value.lower() in ("true", "1", "false", "0")
                    else value
                )
            if not isinstance(value, (bool, int)) or value not in (0, 1):
                raise ValueError
            return bool(value)
        if self.kind == "choice":
            if value not in self.choices:
                raise ValueError
            return value
        if self.kind in ("floats", "ints"):
            parts = value.split(",") if isinstance(value, str) else list(value)
            if len(parts) != self.length:
                raise ValueError
            return tuple(self._number(part, self.kind == "ints", clamp) for part in parts)
        return self._number(value, self.kind == "int", clamp)

    def _number(self, value: Any, whole: bool, clamp: bool) -> float | int:
        if isinstance(value, bool):
            raise ValueError
        number = float(value)
        if not math.isfinite(number) or (whole and number != round(number) and not clamp):
            raise ValueError
        low, high = self.knob.low, self.knob.high
        if clamp:
            number = min(
                max(number, low if low is not None else number),
                high if high is not None else number,
            )
        elif (low is not None and number < low) or (high is not None and number > high):
            raise ValueError
        return round(number) if whole else number

    def _allowed(self) -> str:
        if self.kind == "bool":
            return "true or false"
        if self.kind == "choice":
            return "one of " + ", ".join(self.choices)
        unit = f" {self.knob.unit}" if self.knob.unit else ""
        number = "a whole number" if self.kind in ("int", "ints") else "a number"
        if self.kind in ("ints", "floats"):
            number = f"{self.length} comma-separated numbers, each {number}"
        return f"{number} from {_shown(self.knob.low)} to {_shown(self.knob.high)}{unit}"


@functools.lru_cache(maxsize=128)
def fields_of(params: type) -> tuple[ParamField, ...]:
    """Read a Params class into its fields.

    Raises:
        TypeError: If the class is not a frozen dataclass of annotated fields with defaults; says
            which field and why.
    """
    if not dataclasses.is_dataclass(params) or not params.__dataclass_params__.frozen:  # type: ignore[attr-defined]
        raise TypeError(f"{params.__name__} must be a frozen dataclass")
    hints = get_type_hints(params, include_extras=True)
    return tuple(_read(params, field, hints[field.name]) for field in dataclasses.fields(params))


def _read(owner: type, field: dataclasses.Field, hint: Any) -> ParamField:
    where = f"{owner.__name__}.{field.name}"
    declared, *extras = get_args(hint) if get_origin(hint) is Annotated else (hint,)
    knob = next(
        (extra for extra in (*extras, field.metadata.get("knob")) if isinstance(extra, Knob)), None
    )
    if knob is None:
        raise TypeError(
            f'{where}: has no knob; write {field.name}: type = knob(default, "hint", ...)'
        )
    if field.default is dataclasses.MISSING:
        raise TypeError(f"{where}: needs a default")
    kind, choices, length = _kind(where, declared)
    if kind in ("float", "int", "floats", "ints") and (
        knob.low is None or knob.high is None or knob.low >= knob.high
    ):
        raise TypeError(f"{where}: a number needs a knob with low < high")
    if isinstance(knob.by, Gizmo) and not (kind == "floats" and length in (2, 3, 6)):
        wanted = "2 floats (a place at z = 0), 3 (a position) or 6 (with a rotation vector)"
        raise TypeError(f"{where}: a Gizmo sets {wanted}, not {declared}")
    if isinstance(knob.by, Pick) and kind not in ("int", "ints"):
        raise TypeError(f"{where}: a Pick sets an int or a tuple of ints, not {declared}")
    return ParamField(field.name, kind, field.default, knob, choices, length)


def _kind(where: str, declared: Any) -> tuple[Kind, tuple[str, ...], int]:
    simple: dict[Any, Kind] = {float: "float", int: "int", bool: "bool"}
    if declared in simple:
        return simple[declared], (), 0
    origin, args = get_origin(declared), get_args(declared)
    if origin is Literal and all(isinstance(arg, str) for arg in args):
        return "choice", args, 0
    if origin is tuple and args and set(args) <= {int}:
        return "ints", (), len(args)
    if origin is tuple and args and set(args) <= {float}:
        return "floats", (), len(args)
    if origin in (Union, types.UnionType) and set(args) == {Path, type(None)}:
        return "path", (), 0
    raise TypeError(
        f"{where}: {declared} is none of float, int, bool, Literal of strings, tuple of numbers,"
        " Path | None"
    )


def make(
    params: type[P], values: Mapping[str, Any], *, base: P | None = None, clamp: bool = False
) -> P:
    """Return Params from loose values (a link, JSON, a browser), every one checked.

    Args:
        params: The Params class.
        values: Field name to value; names that are missing keep the base's value.
        base: What is changed; None means the defaults.
        clamp: Move numbers that are out of range to the nearer end.

    Raises:
        InputError: On an unknown name or a value of the wrong kind or out of range.
    """
    fields = {field.name: field for field in fields_of(params)}
    unknown = [name for name in values if name not in fields]
    if unknown:
        raise InputError(f"unknown parameter {unknown[0]!r}; {not_among(unknown[0], fields)}")
    cleaned = {name: fields[name].clean(value, clamp=clamp) for name, value in values.items()}
    try:
        return dataclasses.replace(base if base is not None else params(), **cleaned)  # type: ignore[type-var]
    except InputError:
        raise
    except ValueError as error:
        raise InputError(str(error)) from None


def only(params: P, *names: str) -> P:
    """Return the defaults with these fields of the params: what one part of a run depends on, as
    the key of its cache.
    """
    return dataclasses.replace(type(params)(), **{name: getattr(params, name) for name in names})  # type: ignore[type-var]


def paths_of(params: type) -> list[str]:
    """Return the names of the fields that take a person's own files."""
    return [field.name for field in fields_of(params) if field.sensitive]


def names_files(params: Any) -> bool:
    """Tell whether params name a person's own files."""
    return any(getattr(params, name) for name in paths_of(type(params)))


def with_own_files(params: P, mine: P) -> P:
    """Return the params with a person's own files in them, and with what says how to read these
    (`Knob.of_files`).

    A preset or a reset keeps them so. Params that name files themselves stay as they are.
    """
    if names_files(params) or not names_files(mine):
        return params
    kept = paths_of(type(params)) + [
        field.name for field in fields_of(type(params)) if field.knob.of_files
    ]
    return dataclasses.replace(params, **{name: getattr(mine, name) for name in kept})  # type: ignore[type-var]


def showing(params: P, files: Iterable[str], *, kept: Collection[str] = ()) -> P:
    """Return the params with the choices under which files are read (`Knob.needs`); those that are
    so stay.

    Args:
        params: What was asked for.
        files: The fields whose files have just been given.
        kept: Fields that a person has chosen together with the files.

    Raises:
        InputError: If one of these has a value under which a file would not be read.
    """
    fields = {field.name: field for field in fields_of(type(params))}
    for name in files:
        for other, wanted in (
            fields[name].knob.needs.items() if getattr(params, name) is not None else ()
        ):
            if getattr(params, other) in wanted:
                continue
            if other in kept:
                allowed = " or ".join(map(str, wanted))
                raise InputError(f"{called(name)} is read where {called(other)} is {allowed}")
            params = dataclasses.replace(params, **{other: wanted[0]})  # type: ignore[type-var]
    return params


def called(name: str) -> str:
    """Return the name of a param for a message, in marks by which a page puts its label there, a
    command its flag.
    """
    return f"“{name}”"


@contextlib.contextmanager
def called_by_flags() -> Iterator[None]:
    """Let messages in this block name params as a command line does."""
    before = _flags.set(True)
    try:
        yield
    finally:
        _flags.reset(before)


def in_words(message: str, params: type) -> str:
    """Return a message with the names of params (`called`) as people see them: labels, or flags in
    `called_by_flags`.
    """
    labels = {field.name: field.label for field in fields_of(params)}

    def name(match: re.Match) -> str:
        if match[1] not in labels:
            return match[0]
        return "--" + match[1].replace("_", "-") if _flags.get() else called(labels[match[1]])

    return _CALLED.sub(name, message)


def validated(params: Any) -> Any:
    """Return the params when every field is inside its range; raise InputError with one line when
    one is not.
    """
    return make(
        type(params), {field.name: getattr(params, field.name) for field in fields_of(type(params))}
    )


def to_json(params: Any) -> str:
    """Return Params as JSON text, fields in order; paths become text."""
    plain = {f.name: _plain(getattr(params, f.name)) for f in fields_of(type(params))}
    return json.dumps(plain)


def from_json(params: type[P], text: str) -> P:
    """Return Params from `to_json`'s text.

    Raises:
        InputError: If the text is not a JSON object of this lesson's parameters.
    """
    try:
        values = json.loads(text)
    except ValueError:
        values = None
    if not isinstance(values, dict):
        raise InputError("the parameters are not a JSON object")
    return make(params, values)


def changed(params: Any, base: Any = None) -> dict[str, str]:
    """Return the fields that differ from the base (or the defaults), as the text a link or command
    line takes.
    """
    base = type(params)() if base is None else base
    return {
        f.name: text_of(getattr(params, f.name))
        for f in fields_of(type(params))
        if getattr(params, f.name) != getattr(base, f.name)
    }


def text_of(value: Any) -> str:
    """Return the value of a field as the text that a link or a command line takes."""
    if isinstance(value, tuple):
        return ",".join(text_of(part) for part in value)
    return f"{value:g}" if isinstance(value, float) and float(f"{value:g}") == value else str(value)


def _plain(value: Any) -> Any:
    if isinstance(value, Path):
        return str(value)
    return list(value) if isinstance(value, tuple) else value


def _shown(value: Any) -> str:
    text = f"{value:g}" if isinstance(value, float) else repr(value)
    return text if len(text) <= 40 else text[:39] + "…"
