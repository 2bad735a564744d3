"""Files that a person gives to one page: kept in a folder of that page, under names of ours, as
long as it is open.
"""

import re
import shutil
import tempfile
from collections.abc import AsyncIterator
from pathlib import Path

from starlette.concurrency import run_in_threadpool

from workbench.apart import forgotten, handed_to_a_page
from workbench.errors import InputError

MOST_BYTES = 32 * 2**20
_ENDING = re.compile(r"(\.[A-Za-z0-9]{1,6}){1,2}$")


class OwnFiles:
    """The files of one page. One file of a name is kept at a time."""

    def __init__(self) -> None:
        self._folder: Path | None = None
        self._kept: dict[str, Path] = {}
        self._number = 0

    async def keep(self, field: str, name: str, parts: AsyncIterator[bytes]) -> Path:
        """Write what comes in parts to a file and return its path.

        Args:
            field: The name of the field of Params that it is for; the file is called after it.
            name: What the person's file is called; only its ending is taken over, since readers go
                by that.
            parts: The file; given up as soon as it is larger than MOST_BYTES.

        Raises:
            InputError: If it is too large, or empty; nothing is kept then.
        """
        if self._folder is None:
            self._folder = Path(tempfile.mkdtemp(prefix="workbench-"))
            handed_to_a_page(self._folder)
        self._number += 1
        ending = _ENDING.search(name)
        # a path of its own: equal params mean an equal run
        place = self._folder / str(self._number)
        place.mkdir()
        path = place / f"{field}{ending[0].lower() if ending else ''}"
        size = 0
        try:
            with path.open("wb") as file:
                async for part in parts:
                    size += len(part)
                    if size > MOST_BYTES:
                        raise InputError(
                            f"this file is larger than the {MOST_BYTES >> 20} MB that a page takes"
                        )
                    await run_in_threadpool(file.write, part)
            if not size:
                raise InputError("this file is empty")
        except BaseException:
            shutil.rmtree(place, ignore_errors=True)
            raise
        before = self._kept.pop(field, None)
        if before is not None:
            shutil.rmtree(before.parent, ignore_errors=True)
        self._kept[field] = path
        return path

    def close(self) -> None:
        """Remove them all."""
        if self._folder is not None:
            shutil.rmtree(self._folder, ignore_errors=True)
            forgotten(self._folder)
        self._folder = None
