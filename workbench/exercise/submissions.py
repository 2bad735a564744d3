"""What a class handed in, read before anything of it runs; a roster tells who is missing."""

import csv
import io
import os
from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path

from workbench.errors import InputError
from workbench.exercise.submission import SUFFIXES, content

MOST_FILES = 200
MOST_TOGETHER = 8 << 20
NOT_READ = "not read: unpack it, or save it as a .py file or a notebook"
ARCHIVES = (".zip", ".tar", ".gz", ".tgz", ".bz2", ".xz", ".7z", ".rar")
MOST_NAMED = 5
"""How many files are named of those that were not read."""
NOT_IN_ROSTER = "not in the roster"
COLUMNS = ("student", "name", "login", "username", "id", "sid", "email")


@dataclass(frozen=True)
class HandIn:
    """What one student handed in.

    Attributes:
        student: By the file's or the folder's name.
        files: What is in each Python file or notebook, by its path in the student's folder.
        troubles: What could not be read: the file, and one line.
    """

    student: str
    files: dict[str, bytes]
    troubles: tuple[tuple[str, str], ...] = ()
    note: str = ""


def handed_in(folder: Path, out: Path | None = None) -> dict[str, HandIn]:
    """Return what each student handed in: `NAME.py`, `NAME.ipynb`, or a folder `NAME` of files.

    The results' folder `out` is no student's.

    Raises:
        InputError: If it is no folder or holds no file of any student.
    """
    if not folder.is_dir():
        raise InputError(f"{folder}: no such folder")
    hand_ins: dict[str, HandIn] = {}
    for path in sorted(folder.iterdir()):
        if path.name.startswith((".", "__")) or (
            out is not None and path.absolute() == out.absolute()
        ):
            continue
        if path.suffix.lower() in SUFFIXES and not path.is_dir():
            handed = _read(path.stem, folder, [path])
        elif _was_meant(path) and not path.is_dir():
            student = path.name.partition(".")[0]
            if any((folder / f"{student}{end}").exists() for end in ("", *SUFFIXES)):
                continue  # what was in it lies beside it
            handed = HandIn(student, {}, ((path.name, f"{path.name}: {NOT_READ}"),))
        elif path.is_symlink() and not path.resolve().is_relative_to(folder.resolve()):
            handed = HandIn(path.name, {}, ((path.name, "a link that leads out of the folder"),))
        elif path.is_dir():
            handed = handed_by(path.name, path)
        else:
            continue
        if handed.student in hand_ins:
            handed = _clashing(hand_ins[handed.student], handed)
        hand_ins[handed.student] = handed
    if not any(handed.files or handed.troubles for handed in hand_ins.values()):
        raise InputError(f"{folder}: holds no .py file")
    nothing = (("", "the folder holds no .py file and no notebook"),)
    return {
        name: handed if handed.files or handed.troubles else replace(handed, troubles=nothing)
        for name, handed in hand_ins.items()
    }


def handed_by(student: str, folder: Path) -> HandIn:
    """Return what one student handed in: the files of a folder, at any depth."""
    paths = list(_below(folder))
    others = [
        path.relative_to(folder).as_posix() for path in paths if path.suffix.lower() not in SUFFIXES
    ]
    handed = _read(student, folder, [path for path in paths if path.suffix.lower() in SUFFIXES])
    if not others:
        return handed
    more = f" and {len(others) - MOST_NAMED} more" if others[MOST_NAMED:] else ""
    return _noted(
        handed, f"not read, since neither .py nor .ipynb: {', '.join(others[:MOST_NAMED])}{more}"
    )


def _noted(handed: HandIn, note: str) -> HandIn:
    return replace(handed, note="; ".join(filter(None, [handed.note, note])))


def _was_meant(path: Path) -> bool:
    """Whether an unread file was handed in all the same: an archive, or misnamed Python."""
    name = path.name.lower()
    return name.endswith(ARCHIVES) or any(f"{suffix}." in name for suffix in SUFFIXES)


def with_roster(hand_ins: dict[str, HandIn], roster: Path) -> dict[str, HandIn]:
    """Return what was handed in by those of a roster, in its order, then by the others.

    Raises:
        InputError: If the roster cannot be read.
    """
    names = _names(roster)
    by_name = {name.casefold(): handed for name, handed in hand_ins.items()}
    listed = {
        name: by_name.pop(name.casefold(), HandIn(name, {}, (("", "handed in nothing"),)))
        for name in names
    }
    others = {handed.student: _noted(handed, NOT_IN_ROSTER) for handed in by_name.values()}
    return {handed.student: handed for handed in (*listed.values(), *others.values())}


def _names(roster: Path) -> list[str]:
    try:
        text = content(roster).decode("utf-8-sig")
    except UnicodeDecodeError:
        raise InputError(f"{roster}: not UTF-8") from None
    first = text.partition("\n")[0]
    rows = [
        row
        for row in csv.reader(io.StringIO(text), delimiter=max(",;\t", key=first.count))
        if any(row)
    ]
    header = [cell.strip().lower() for cell in rows[0]] if rows else []
    column = next((header.index(name) for name in COLUMNS if name in header), None)
    names = [
        row[column or 0].strip() for row in rows[column is not None :] if len(row) > (column or 0)
    ]
    if not any(names):
        raise InputError(
            f"{roster}: names no student; its first row may say which column does:"
            f" {', '.join(COLUMNS)}"
        )
    return list(dict.fromkeys(name for name in names if name))


def _read(student: str, root: Path, paths: list[Path]) -> HandIn:
    files: dict[str, bytes] = {}
    troubles: list[tuple[str, str]] = []
    left = MOST_TOGETHER
    for path in paths:
        name = path.relative_to(root).as_posix()
        try:
            if len(files) >= MOST_FILES or left <= 0:
                raise InputError(
                    f"{name}: not read; a student may hand in {MOST_FILES} files,"
                    f" {MOST_TOGETHER >> 20} MB"
                )
            files[name] = content(path, root)
            left -= len(files[name])
        except InputError as error:
            troubles.append((name, str(error)))
    return HandIn(student, files, tuple(troubles[:20]))


def _below(folder: Path) -> Iterator[Path]:
    for place, folders, names in os.walk(folder):  # follows no link
        folders[:] = sorted(name for name in folders if not name.startswith((".", "__")))
        yield from (Path(place, name) for name in sorted(names) if not name.startswith("."))


def _clashing(first: HandIn, other: HandIn) -> HandIn:
    files = {
        *first.files,
        *other.files,
        *(file for each in (first, other) for file, _ in each.troubles),
    }
    named = ", ".join(sorted(files))[:200]
    trouble = f"two things here are named {first.student} ({named}): leave one of them"
    return HandIn(first.student, {}, ((named, trouble),))
