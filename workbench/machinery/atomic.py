"""Writes a file whole or not at all, where the person wants it, and removes what a writer that was
killed left behind.
"""

import os
import platform
import re
import shutil
import sys
import zlib
from collections.abc import Mapping
from pathlib import Path
from uuid import uuid4

from workbench.errors import InputError

# machines that share a folder see their own processes only
_MACHINE = f"{zlib.crc32(platform.node().encode()):08x}"
_PART = re.compile(rf"\..+\.{_MACHINE}-(\d+)-[0-9a-f]{{8}}\.part")


def write_atomic(path: Path, data: bytes) -> None:
    """Put the whole file in place, or nothing: what stood there stays until it is complete.

    Until then it stands beside `path` under another name, which no exception leaves behind. A link
    is replaced, not followed.

    Raises:
        OSError: If it cannot be written.
    """
    part = _part(path)
    try:
        _fill(part, data)
        os.replace(part, path)
    finally:
        part.unlink(missing_ok=True)


def _part(path: Path) -> Path:
    return path.with_name(f".{path.name[:100]}.{_MACHINE}-{os.getpid()}-{uuid4().hex[:8]}.part")


def _fill(part: Path, data: bytes) -> None:
    with part.open("xb") as file:
        file.write(data)
        file.flush()
        os.fsync(file.fileno())


def check_place(path: Path, force: bool, how: str = "--force") -> None:
    """Raise InputError before a long run where its end would be for nothing.

    Args:
        path: The file that will be written.
        force: Whether it may be there already.
        how: What would allow that, for the message.
    """
    if path.exists() and not path.is_file():
        raise InputError(f"{path}: is not a file")
    if path.exists() and not force:
        raise InputError(f"{path}: exists already; {how} replaces it")
    folder = path.absolute().parent
    if not folder.is_dir():
        raise InputError(f"{folder}: no such folder")
    if not os.access(folder, os.W_OK):
        raise InputError(f"{folder}: cannot be written to")


def write_places(files: Mapping[Path, bytes]) -> None:
    """Put all of some files in place, or none of them: what stood there stays where one fails.

    Each is written whole under another name before the first is put in place. Links are followed.

    Raises:
        InputError: If one cannot be written.
    """
    finals = {path: path.resolve() for path in files}
    parts = {path: _part(final) for path, final in finals.items()}
    kept = {path: _part(final) for path, final in finals.items()}
    path = Path()
    placed: list[Path] = []
    try:
        for path, data in files.items():
            remove_leftovers(finals[path].parent)
            _fill(parts[path], data)
        for path, final in finals.items():
            if final.exists():
                _keep(final, kept[path])
            os.replace(parts[path], final)
            placed.append(path)
    except BaseException as error:
        for done in placed:
            if kept[done].exists():
                os.replace(kept[done], finals[done])
            else:
                finals[done].unlink(missing_ok=True)
        if isinstance(error, OSError):
            why = error.strerror or error
            raise InputError(f"{path}: cannot be written: {why}") from error
        raise
    finally:
        for part in (*parts.values(), *kept.values()):
            part.unlink(missing_ok=True)


def _keep(path: Path, other: Path) -> None:
    """Give what stands at a path another name too."""
    try:
        os.link(path, other)
    except OSError:  # a file system without links
        shutil.copy2(path, other)


def remove_leftovers(folder: Path) -> None:
    """Remove the unfinished files of this machine's dead processes from a folder."""
    for name in os.listdir(folder):
        match = _PART.fullmatch(name)
        if match is not None and not _is_alive(int(match[1])):
            (folder / name).unlink(missing_ok=True)


def _is_alive(process: int) -> bool:
    if sys.platform == "win32":
        return True  # asking would end it there
    try:
        os.kill(process, 0)
    except (ProcessLookupError, OverflowError):
        return False
    except PermissionError:  # somebody else's
        return True
    return True
