"""Other distributions whose package is called `workbench` too."""

import sys
from collections.abc import Iterable
from pathlib import Path

OURS = "geometry_workbench"


def namesakes(folders: Iterable[str] | None = None) -> list[str]:
    """List the other installed distributions that bring a package `workbench`: files of theirs and
    of ours may lie in one folder, and which are imported is chance.

    Args:
        folders: Where to look for packages, each with the records of what was installed there;
            where Python looks by default.

    Returns:
        Their names with versions, as `name-1.0`, sorted.
    """
    records = {
        record.parent.stem
        for folder in (sys.path if folders is None else folders)
        for record in Path(folder or ".").glob("*.dist-info/RECORD")
        if not record.parent.name.startswith(f"{OURS}-") and _brings(record)
    }
    return sorted(records)


def _brings(record: Path) -> bool:
    try:
        lines = record.read_bytes()
    except OSError:
        return False
    return b"\nworkbench/__init__.py," in b"\n" + lines.replace(b"\r\n", b"\n")
