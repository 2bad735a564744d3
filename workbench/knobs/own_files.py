"""Params that name files of a person."""

import dataclasses
from collections.abc import Collection, Iterable
from typing import Any

from workbench.errors import InputError
from workbench.knobs.fields import fields_of
from workbench.knobs.naming import called
from workbench.knobs.values import P


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
