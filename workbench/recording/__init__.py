"""Recordings (`.rrd`) of runs, written, read and compared; rerun's only, lazy importer."""

import os
from typing import Any

from workbench.lesson import Lesson

# else rerun writes into the terminal what it thinks of a damaged file
os.environ.setdefault("RUST_LOG", "off")

_WHERE = {
    "record": "workbench.recording.write",
    "record_bytes": "workbench.recording.write",
    "equal_content": "workbench.recording.canonical",
    "open_recording": "workbench.recording.read",
    "Recording": "workbench.recording.read",
}


def __getattr__(name: str) -> Any:
    """Import what is asked for when it is asked for: rerun takes half a second."""
    if name not in _WHERE:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    from importlib import import_module

    return getattr(import_module(_WHERE[name]), name)


def file_name(lesson: Lesson, run: str | None) -> str:
    """Return under which name a recording is downloaded: of a lesson's run, or another one."""
    return f"{lesson.name}.rrd" if run is None else f"{lesson.name}-{run}.rrd"
