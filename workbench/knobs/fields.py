"""Fields of Params, read from an author's class: kinds, ranges, and what a value may be."""

import dataclasses
import functools
import math
import re
import types
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any, Literal, Union, get_args, get_origin, get_type_hints

from workbench.errors import InputError
from workbench.knobs.declaring import Gizmo, Knob, Pick

_SYMBOL = re.compile(r"([A-Za-z])(\d*)")
_SUBSCRIPTS = str.maketrans("0123456789", "₀₁₂₃₄₅₆₇₈₉")

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


def _shown(value: Any) -> str:
    text = f"{value:g}" if isinstance(value, float) else repr(value)
    return text if len(text) <= 40 else text[:39] + "…"
