"""Writes a file whole or not at all, where the person wants it, and removes what a writer that was
killed left behind.
"""

import os
import platform
import re
import sys
import zlib
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
    part = path.with_name(f".{path.name[:100]}.{_MACHINE}-{os.getpid()}-{uuid4().hex[:8]}.part")
    try:
        with part.open("xb") as file:
            file.write(data)
            file.flush()
            os.fsync(file.fileno())
        os.replace(part, path)
    finally:
        part.unlink(missing_ok=True)


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


def write_place(path: Path, data: bytes) -> None:
    """Put the whole file in place, or nothing; a link is followed, killed writers' leftovers go.

    Raises:
        InputError: If it cannot be written.
    """
    final = path.resolve()
    try:
        remove_leftovers(final.parent)
        write_atomic(final, data)
    except OSError as error:
        raise InputError(f"{path}: cannot be written: {error.strerror or error}") from error


def remove_leftovers(folder: Path) -> None:
    """Remove the unfinished files of this machine's dead processes from a folder."""
    for name in os.listdir(folder):
        found = _PART.fullmatch(name)
        if found is not None and not _is_alive(int(found[1])):
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
