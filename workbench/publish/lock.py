"""One publish at a time writes into a folder."""

import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from workbench.errors import InputError

LOCK = ".publishing.lock"


@contextmanager
def only_writer(out: Path) -> Iterator[None]:
    """Hold a folder for the length of the block. The system lets go of it when the process ends,
    however it ends.

    Raises:
        InputError: If another process holds it, or let go of it at this moment.
    """
    path = out / LOCK
    file = os.open(path, os.O_RDWR | os.O_CREAT | getattr(os, "O_NOFOLLOW", 0), 0o666)
    try:
        if (
            not _held(file)
            or not path.exists()
            or not os.path.samestat(os.fstat(file), path.stat())
        ):
            raise InputError(f"{out}: another publish is writing here; wait until it is done")
        try:
            yield
        finally:
            if os.fstat(file).st_size == 0:  # else it is somebody else's file
                path.unlink(missing_ok=True)
    finally:
        os.close(file)


def _held(file: int) -> bool:
    try:
        if sys.platform == "win32":
            import msvcrt

            msvcrt.locking(file, msvcrt.LK_NBLCK, 1)
        else:
            import fcntl

            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except (BlockingIOError, PermissionError):
        return False
    return True
