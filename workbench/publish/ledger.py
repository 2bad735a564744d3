"""What of a site is ours: the files that were written, each with the digest of its content, in a file of the site.

That file is input like any other. It gives the right to replace or remove a file only where the name is one that we could
have written, the file lies inside the site, and its content is still what was written.
"""

import hashlib
import json
import os
import re
from collections.abc import Iterable, Mapping
from contextlib import suppress
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from workbench.atomic import remove_leftovers, write_atomic
from workbench.errors import InputError

KEPT = ".published.json"
FORMAT = 2
LARGEST = 4_000_000
"""Bytes beyond which no file is read as a ledger."""
NAME = re.compile(r"[A-Za-z0-9][A-Za-z0-9_-]{0,99}")
"""A name of a lesson or of a run: the name of a folder or a file, and part of an address, on any system."""
_PART = re.compile(r"[A-Za-z0-9_][A-Za-z0-9._-]{0,199}")
_HIDDEN = ".nojekyll"


@dataclass(frozen=True)
class Listed:
    """How a published lesson stands on the course page."""

    title: str
    summary: str
    order: float
    needs: tuple[str, ...] = ()


class Ledger:
    """The files of a site that are ours, its lessons, and what its runs agree with.

    Attributes:
        lessons: By name.
        runs: `lesson/run` to the digest of all that the published run depends on, `lesson/` to that of its page.
        made_by: What wrote the site.
        files: Name within the site to the digest of its content, as it was written.

    Raises:
        InputError: If there is a ledger that cannot be read.
    """

    def __init__(self, out: Path):
        self._out = out
        self._found: dict[str, str | None] = {}
        said = _read(out / KEPT)
        self.lessons = {name: one for name, value in _dict(said, "lessons") if (one := _listed(name, value))}
        self.runs = {name: value for name, value in _dict(said, "runs") if isinstance(value, str)}
        self.made_by = said.get("made_by")
        self.files = _files(said, "files")
        self._writing = _files(said, "writing")

    def is_ours(self, name: str) -> bool:
        """Return whether a file is as we wrote it: then it may be replaced and removed."""
        found = self._digest(name)
        return found is not None and found in (self.files.get(name), self._writing.get(name))

    def content(self, name: str) -> bytes | None:
        """Return what a file of ours holds, None where there is none or it is not as we wrote it."""
        return (self._out / name).read_bytes() if self.is_ours(name) else None

    def check(self, names: Iterable[str], *, force: bool) -> None:
        """Raise InputError where a file cannot be written, or is somebody else's and may not be replaced."""
        for name in names:
            path = self._out / name
            for folder in list(Path(name).parents)[:-1]:
                place = self._out / folder
                if place.is_symlink():
                    raise InputError(f"{place}: leads out of the site; remove this link first")
                if place.exists() and not place.is_dir():
                    raise InputError(f"{place}: is a file, where a folder is needed")
            if path.is_dir() and not path.is_symlink():
                raise InputError(f"{path}: is a folder, where a file is needed")
            if not force and os.path.lexists(path) and not self.is_ours(name):
                raise InputError(f"{path}: was not written by publish, or has been changed since; --force replaces it")

    def write(self, contents: Mapping[str, bytes]) -> None:
        """Write files that `check` allowed. Who is stopped in between knows them as ours at the next start."""
        new = {name: hashlib.sha256(data).hexdigest() for name, data in contents.items()}
        self._writing |= {name: digest for name, digest in new.items() if self._digest(name) != digest}
        if self._writing:
            self.save()
        for name, digest in new.items():
            if self._digest(name) != digest:
                (self._out / name).parent.mkdir(parents=True, exist_ok=True)
                write_atomic(self._out / name, contents[name])
            self._found[name] = self.files[name] = digest
            self._writing.pop(name, None)

    def remove(self, names: Iterable[str]) -> None:
        """Remove files that are as we wrote them, and folders that this empties; others are somebody else's from now on."""
        for name in sorted(names):
            if self.is_ours(name):
                (self._out / name).unlink()
                for folder in list(Path(name).parents)[:-1]:
                    with suppress(OSError):  # it is not empty
                        (self._out / folder).rmdir()
            self._found.pop(name, None)
            self.files.pop(name, None)

    def save(self) -> None:
        """Write down what is ours."""
        said = {
            "format": FORMAT,
            "made_by": self.made_by,
            "lessons": {name: asdict(listed) for name, listed in self.lessons.items()},
            "runs": self.runs,
            "files": self.files,
        }
        said |= {"writing": self._writing} if self._writing else {}
        write_atomic(self._out / KEPT, json.dumps(said, indent=1, sort_keys=True).encode())

    def remove_leftovers(self) -> None:
        """Remove what a publish that was killed left half written."""
        for folder in {self._out / name for name in ("", *map(os.path.dirname, (*self.files, *self._writing)))}:
            if folder.is_dir() and self._is_inside(folder):
                remove_leftovers(folder)

    def _digest(self, name: str) -> str | None:
        """Return the digest of a file of the site, None where there is none, or where a link leads."""
        if name not in self._found:
            path = self._out / name
            plain = path.is_file() and not path.is_symlink() and self._is_inside(path.parent)
            self._found[name] = hashlib.sha256(path.read_bytes()).hexdigest() if plain else None
        return self._found[name]

    def _is_inside(self, folder: Path) -> bool:
        return folder.resolve() == self._out.resolve() / folder.relative_to(self._out)


def could_be_ours(name: str) -> bool:
    """Return whether this is a name within a site that publish might write."""
    parts = name.split("/")
    return name == _HIDDEN or (len(parts) <= 4 and all(_PART.fullmatch(part) for part in parts))


def _read(path: Path) -> dict[str, Any]:
    """Return what a ledger says; nothing where there is none, or something else."""
    try:
        if path.is_symlink() or path.stat().st_size > LARGEST:
            return {}
        said = json.loads(path.read_text(encoding="utf-8"))
    except (FileNotFoundError, ValueError, RecursionError):
        return {}
    return said if isinstance(said, dict) and said.get("format") == FORMAT else {}


def _dict(said: Mapping[str, Any], key: str) -> Iterable[tuple[str, Any]]:
    value = said.get(key)
    return value.items() if isinstance(value, dict) else ()


def _files(said: Mapping[str, Any], key: str) -> dict[str, str]:
    return {name: value for name, value in _dict(said, key) if could_be_ours(name) and isinstance(value, str)}


def _listed(name: str, value: Any) -> Listed | None:
    if not NAME.fullmatch(name) or not isinstance(value, dict):
        return None
    title, summary, order = value.get("title"), value.get("summary"), value.get("order")
    if not isinstance(title, str) or not isinstance(summary, str) or not isinstance(order, (int, float)):
        return None
    needs = value.get("needs", [])
    if not isinstance(needs, list) or not all(isinstance(one, str) and NAME.fullmatch(one) for one in needs):
        return None
    return Listed(title, summary, order, tuple(needs)) if abs(order) < 1e9 else None
