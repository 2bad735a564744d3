"""What of a site is ours: the files that were written, each with the digest of its content, in a
file of the site.

That file is input like any other, and one that says anything we could not have written says
nothing. It gives the right to replace or remove a file only where that lies inside the site and its
content is still what was written.
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

from workbench.chapters import MINUTES, NAMES
from workbench.errors import InputError
from workbench.machinery.atomic import remove_leftovers, write_atomic

KEPT = ".published.json"
FORMATS = (2, 3)  # that are read; the last is written
LARGEST = 4_000_000
"""Bytes beyond which no file is read as a manifest."""
NAME = re.compile(r"[A-Za-z0-9][A-Za-z0-9_-]{0,99}")
"""A name of a lesson or of a run: the name of a folder or a file, and part of an address, on any
system.
"""
_FILE = re.compile(
    r"\.nojekyll|[A-Za-z0-9_][A-Za-z0-9._-]{0,199}(/[A-Za-z0-9_][A-Za-z0-9._-]{0,199}){0,3}"
)


@dataclass(frozen=True)
class Listed:
    """How a published lesson stands on the course page."""

    title: str
    summary: str
    order: float
    needs: tuple[str, ...] = ()
    chapter: str = ""
    minutes: int = MINUTES


class Manifest:
    """The files of a site that are ours, its lessons, and what its runs agree with.

    Attributes:
        lessons: By name.
        runs: `lesson/run` to the digest of all that the published run depends on, `lesson/` to that
            of its page.
        made_by: What wrote the site.
        files: Name within the site to the digests of its content, as it was written: two while it
            is replaced.
    """

    def __init__(self, out: Path):
        self._out = out
        try:
            self.made_by, self.lessons, self.runs, self.files = _read(out / KEPT)
        except (FileNotFoundError, ValueError, TypeError, KeyError, AttributeError, RecursionError):
            self.made_by = None
            self.lessons = {}
            self.runs = {}
            self.files = {}

    def is_ours(self, name: str) -> bool:
        """Return whether a file is as we wrote it: then it may be replaced and removed."""
        return name in self.files and self._digest(name) in self.files[name]

    def read(self, name: str) -> bytes:
        """Return what a file of the site holds."""
        return (self._out / name).read_bytes()

    def check(self, names: Iterable[str], *, force: bool) -> None:
        """Raise InputError where a file cannot be written, or is somebody else's and may not be
        replaced.
        """
        for name in names:
            path = self._out / name
            for folder in map(self._out.joinpath, list(Path(name).parents)[:-1]):
                if folder.is_symlink():
                    raise InputError(f"{folder}: leads out of the site; remove this link first")
                if folder.exists() and not folder.is_dir():
                    raise InputError(f"{folder}: is a file, where a folder is needed")
            if path.is_dir() and not path.is_symlink():
                raise InputError(f"{path}: is a folder, where a file is needed")
            if not force and os.path.lexists(path) and not self.is_ours(name):
                raise InputError(
                    f"{path}: was not written by publish, or has been changed since; --force"
                    " replaces it"
                )

    def write(self, contents: Mapping[str, bytes]) -> None:
        """Write files that `check` allowed. Who is stopped in between knows them as ours at the
        next start.
        """
        new = {name: hashlib.sha256(data).hexdigest() for name, data in contents.items()}
        stale = [name for name, digest in new.items() if self._digest(name) != digest]
        self.files |= {name: [*self.files.get(name, ()), new[name]] for name in stale}
        if stale:
            self.save()
        for name in stale:
            (self._out / name).parent.mkdir(parents=True, exist_ok=True)
            write_atomic(self._out / name, contents[name])
        self.files |= {name: [digest] for name, digest in new.items()}

    def remove(self, names: Iterable[str]) -> None:
        """Remove files that are as we wrote them, and folders that this empties; others are
        somebody else's from now on.
        """
        for name in sorted(names):
            if self.is_ours(name):
                (self._out / name).unlink()
                for folder in list(Path(name).parents)[:-1]:
                    with suppress(OSError):  # it is not empty
                        (self._out / folder).rmdir()
            self.files.pop(name, None)

    def save(self) -> None:
        """Write down what is ours."""
        lessons = {name: asdict(listed) for name, listed in self.lessons.items()}
        plain = {
            "format": FORMATS[-1],
            "made_by": self.made_by,
            "lessons": lessons,
            "runs": self.runs,
            "files": self.files,
        }
        write_atomic(self._out / KEPT, json.dumps(plain, indent=1, sort_keys=True).encode())

    def remove_leftovers(self) -> None:
        """Remove what a publish that was killed left half written."""
        for folder in {self._out / name for name in ("", *map(os.path.dirname, self.files))}:
            if folder.is_dir() and self._is_inside(folder):
                remove_leftovers(folder)

    def _digest(self, name: str) -> str | None:
        """Return the digest of a file of the site, None where there is none, or where a link
        leads.
        """
        path = self._out / name
        plain = path.is_file() and not path.is_symlink() and self._is_inside(path.parent)
        return hashlib.sha256(path.read_bytes()).hexdigest() if plain else None

    def _is_inside(self, folder: Path) -> bool:
        return folder.resolve() == self._out.resolve() / folder.relative_to(self._out)


def _read(path: Path) -> tuple[str | None, dict[str, Listed], dict[str, str], dict[str, list[str]]]:
    """Return what a manifest says: who made the site, its lessons, runs and files; any error where
    it is none.
    """
    if path.is_symlink() or path.stat().st_size > LARGEST:
        raise ValueError("no manifest")
    plain = json.loads(path.read_text(encoding="utf-8"))
    files = {name: _texts(value) for name, value in plain["files"].items()}
    for name, digest in plain.get(
        "writing", {}
    ).items():  # format 2 told apart what was being written
        files[name] = _texts([*files.get(name, ()), digest])
    lessons = {name: _listed(**value) for name, value in plain["lessons"].items()}
    runs = dict(plain["runs"].items())
    _texts(runs.values())
    if plain["format"] not in FORMATS or not all(
        (*map(NAME.fullmatch, lessons), *map(_FILE.fullmatch, files))
    ):
        raise ValueError("no manifest")
    return plain.get("made_by"), lessons, runs, files


def _texts(value: Any) -> list[str]:
    """Return texts, or a single one, as a list."""
    texts = [value] if isinstance(value, str) else list(value)
    if not all(isinstance(text, str) for text in texts):
        raise ValueError("no text")
    return texts


def _listed(
    *,
    title: str,
    summary: str,
    order: float,
    needs: Iterable[str] = (),
    chapter: str = "",
    minutes: int = MINUTES,
) -> Listed:
    _texts([title, summary])
    if not all(map(NAME.fullmatch, needs)) or not abs(order) < 1e9:
        raise ValueError("no lesson")
    if chapter not in ("", *NAMES) or not isinstance(minutes, int) or not 0 < minutes < 1e4:
        raise ValueError("no lesson")
    return Listed(title, summary, order, tuple(needs), chapter, minutes)
