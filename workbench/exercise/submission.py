"""What a student handed in, read before anything of it runs: text, and its own modules."""

import os
import stat
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Protocol

from workbench.errors import InputError

MOST_BYTES = 1 << 20
MOST_MODULES = 20
SUFFIXES = (".py", ".ipynb")


@dataclass(frozen=True)
class Statement:
    """A statement of a file.

    Attributes:
        binds: The names that it gives a value.
        defines: Whether it is the definition of a function or a class.
        runs: Whether it does something as the file is loaded, beyond that or an import.
        uses: The modules, and what is in them, that it uses: whole paths, each with its line.
    """

    binds: frozenset[str]
    reads: frozenset[str]
    defines: bool
    runs: bool
    uses: tuple[tuple[str, int], ...]


@dataclass(frozen=True)
class Submission:
    """One file of a student, as it was when it was read.

    Attributes:
        source: Its text; of a notebook, its definitions.
        modules: The modules beside it that it imports, text by name.
        said: The exercises that it says it is for, as a starter's first line does.
        defines: The names that it gives a value.
        broken: Why it is not Python, with the line; nothing where it is.
        parts: Its statements.
        extra_files: Those of the modules, by name.
    """

    file: str
    source: str
    modules: dict[str, str] = field(default_factory=dict)
    said: tuple[str, ...] = ()
    defines: frozenset[str] = frozenset()
    broken: str = ""
    parts: tuple[Statement, ...] = ()
    extra_files: dict[str, tuple[Statement, ...]] = field(default_factory=dict)


class Reads(Protocol):
    """Reads a file's bytes."""

    def read(self, file: str, content: bytes) -> dict[str, Any]:
        """Return what `child.reading.read` finds in a file."""
        ...


def read_submission(path: Path) -> Submission:
    """Read a file of one's own, and what it imports from beside it.

    Raises:
        InputError: If it is no file, is too large, is no text, or takes too long to read; one line.
    """

    def extra_file(name: str) -> bytes | None:
        beside = path.with_name(name)
        return content(beside) if os.path.lexists(beside) else None

    from workbench.exercise.reading import Reader  # a browser has no processes

    with Reader() as reader:
        return submission(path.name, content(path), extra_file, reader=reader)


def submission(
    file: str, data: bytes, extra_file: Callable[[str], bytes | None], *, reader: Reads
) -> Submission:
    """Return what the bytes of a file are; `extra_file` gives those beside it by name, or None.

    Raises:
        InputError: If they are no text, or take too long to read; one line.
    """
    facts = reader.read(file, data)
    modules: dict[str, str] = {}
    parts: dict[str, tuple[Statement, ...]] = {}
    waiting = list(facts.get("imports", []))
    while waiting and len(modules) < MOST_MODULES:
        name = waiting.pop(0)
        content_beside = None if name in modules else extra_file(f"{name}.py")
        if content_beside is not None:
            module = reader.read(f"{name}.py", content_beside)
            modules[name] = module["source"]
            parts[name] = _parts(module)
            waiting += module.get("imports", [])
    return Submission(
        file=file,
        source=facts["source"],
        modules=modules,
        said=tuple(facts["said"]),
        defines=frozenset(facts.get("defines", [])),
        broken=facts.get("broken", ""),
        parts=_parts(facts),
        extra_files=parts,
    )


def _parts(facts: dict[str, Any]) -> tuple[Statement, ...]:
    return tuple(
        Statement(
            frozenset(part["binds"]),
            frozenset(part["reads"]),
            part["defines"],
            part["runs"],
            tuple((str(path), int(line)) for path, line in part["uses"]),
        )
        for part in facts.get("parts", [])
    )


def content(path: Path, root: Path | None = None) -> bytes:
    """Return what is in a file of bounded size, and never wait for a pipe or a device.

    Raises:
        InputError: As `read_submission`.
    """
    try:
        real = path.resolve(strict=True)
        if root is not None and not real.is_relative_to(root.resolve()):
            raise InputError(f"{path.name}: a link that leads out of the folder")
        held = os.open(
            real,
            os.O_RDONLY | os.O_CLOEXEC | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_NOCTTY", 0),
        )
        with os.fdopen(held, "rb") as file:
            if not stat.S_ISREG(os.fstat(held).st_mode):
                raise InputError(f"{path.name}: no file, but a pipe, a device or a folder")
            data = file.read(MOST_BYTES + 1)
    except (OSError, RuntimeError) as error:  # a link that leads to itself is a RuntimeError
        raise InputError(
            f"{path}: cannot be read as text ({getattr(error, 'strerror', None) or error})"
        ) from None
    if len(data) > MOST_BYTES:
        raise InputError(f"{path.name}: more than {MOST_BYTES >> 20} MB")
    return data
