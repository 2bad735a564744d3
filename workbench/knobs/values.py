"""Params made, checked, compared, and as text."""

import dataclasses
import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any, TypeVar

from workbench.errors import InputError, not_among
from workbench.knobs.fields import fields_of

P = TypeVar("P")


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
