"""Streams of rerun that end as bytes and leave nothing behind: no thread, no memory, no statistics."""

import re
import threading
from collections.abc import Callable
from typing import Any
from uuid import uuid4

import rerun as rr
import rerun_bindings as bindings
from rerun.recording_stream import RecordingStream

LAYOUT = 1
"""Part of the application id: viewers keep a person's own layout by that, so a new layout needs a new one."""

_one_at_a_time = threading.Lock()


def application_id(lesson_name: str) -> str:
    """Return under which name viewers keep the layout of a lesson's recordings."""
    return f"workbench-{re.sub('[^a-z0-9]+', '-', lesson_name.lower()).strip('-')}-{LAYOUT}"


def stream_bytes(application: str, fill: Callable[[Any], None]) -> bytes:
    """Return the bytes of a recording that `fill` logs into a stream. Wrong shapes raise."""
    with _one_at_a_time:
        strict = rr.strict_mode()
        rr.set_strict_mode(True)
        stream = rr.RecordingStream(application, recording_id=uuid4().hex)
        try:
            stream.set_log_time_enabled(False)
            stream.set_log_tick_enabled(False)
            memory = stream.memory_recording()
            fill(stream)
            return memory.drain_as_bytes()
        finally:
            rr.set_strict_mode(strict)
            _end(stream)


def send_blueprint(stream: Any, application: str, blueprint: Any) -> None:
    """Send a layout. `stream.send_blueprint` does the same, but leaves two threads and a megabyte behind each time."""
    own = RecordingStream._from_native(
        bindings.new_blueprint(
            application_id=application, make_default=False, make_thread_default=False, default_enabled=True
        )
    )
    own.set_time("blueprint", sequence=0)
    blueprint._log_to_stream(own)
    memory = own.memory_recording()
    bindings.send_blueprint(memory.storage, True, True, recording=stream.to_native())
    memory.drain_as_bytes()
    _end(own)


def _end(stream: Any) -> None:
    stream.disconnect()
    bindings.flush_and_cleanup_orphaned_recordings()
