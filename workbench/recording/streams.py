"""Streams of rerun that end as bytes and leave no thread, memory or statistics behind."""

import re
import threading
from collections.abc import Callable, Sequence
from typing import Any

import rerun as rr
import rerun_bindings as bindings
from rerun.recording_stream import RecordingStream

from workbench.recording.canonical import chunks_of, id_of, tidied

_one_at_a_time = threading.Lock()


def application_id(lesson_name: str) -> str:
    """Return the name by which viewers tell a lesson's recordings from others."""
    return f"workbench-{re.sub('[^a-z0-9]+', '-', lesson_name.lower()).strip('-')}"


def stream_bytes(application: str, fill: Callable[[Any], None], layout: Any = None) -> bytes:
    """Return the bytes of a recording that `fill` logs into a stream, with its layout. Wrong shapes
    raise.

    The recording's id is made from the content. The application's ends in a digest of the layout:
    viewers keep one layout for each application, and would show runs of other presets in that of
    the first.
    """
    with _one_at_a_time:
        strict = rr.strict_mode()
        rr.set_strict_mode(True)
        try:
            content = tidied(_logged(_recording(application, "content"), fill))
            beside = (
                []
                if layout is None
                else tidied(_logged(_layout(application), layout._log_to_stream))
            )
            if beside:
                application = f"{application}-{id_of(beside)[:8]}"
            stream = _recording(application, id_of([*content, *beside]))
            return _logged(
                stream,
                lambda stream: _send(
                    stream, application, chunks_of(content), layout=chunks_of(beside)
                ),
            )
        finally:
            rr.set_strict_mode(strict)
            bindings.flush_and_cleanup_orphaned_recordings()


def _send(stream: Any, application: str, chunks: Sequence[Any], *, layout: Sequence[Any]) -> None:
    """Send all chunks; `stream.send_blueprint` would leave two threads and a megabyte behind."""
    if layout:
        own = _layout(application)
        memory = own.memory_recording()
        own.send_chunks(layout)
        bindings.send_blueprint(memory.storage, True, True, recording=stream.to_native())
        memory.drain_as_bytes()
        own.disconnect()
    stream.send_chunks(chunks)


def _logged(stream: Any, log: Callable[[Any], None]) -> bytes:
    try:
        memory = stream.memory_recording()
        log(stream)
        return memory.drain_as_bytes()
    finally:
        stream.disconnect()


def _recording(application: str, name: str) -> Any:
    stream = rr.RecordingStream(application, recording_id=name, send_properties=False)
    stream.set_log_time_enabled(False)
    stream.set_log_tick_enabled(False)
    return stream


def _layout(application: str) -> Any:
    stream = RecordingStream._from_native(
        bindings.new_blueprint(
            application_id=application,
            make_default=False,
            make_thread_default=False,
            default_enabled=True,
        )
    )
    stream.set_log_time_enabled(False)
    stream.set_log_tick_enabled(False)
    stream.set_time("blueprint", sequence=0)
    return stream
