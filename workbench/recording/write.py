"""Writes runs to recordings: into a whole file or none, into a pipe, or into bytes."""

import json
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Any, TextIO

import numpy as np
import rerun as rr

from workbench import knobs
from workbench.errors import InputError
from workbench.lesson import Lesson, find, is_of_course
from workbench.machinery.atomic import check_place, write_places
from workbench.machinery.licence import NOTICE
from workbench.machinery.progress import Progress, bar
from workbench.machinery.version import __version__
from workbench.moved import moved
from workbench.recording.columns import facts, send_captions, send_series
from workbench.recording.contents import contents_of, to_json
from workbench.recording.gather import unions
from workbench.recording.glyphs import safe
from workbench.recording.layout import one_run
from workbench.recording.plain_page import plain_page
from workbench.recording.read import FORMAT, digest
from workbench.recording.sink import RerunSink, document
from workbench.recording.streams import application_id, stream_bytes
from workbench.run.loading import load
from workbench.run.timeline import Timeline
from workbench.story import plain_text
from workbench.words.typeset import wording


@dataclass(frozen=True)
class Written:
    """What was written: how many steps, how many bytes, and why the run ended early if it did."""

    steps: int
    bytes: int
    stopped: str | None


def record(
    lesson: Lesson | str | Path,
    path: str | Path,
    /,
    params: Any = None,
    *,
    preset: str | None = None,
    force: bool = False,
    **values: Any,
) -> Path:
    """Run a lesson and write the run to a recording, `.rrd`.

    `record("icp", "icp.rrd", start_angle=120)` runs the defaults with one field changed;
    `preset="far"` starts from a preset instead, whose name is kept where no value differs.

    Args:
        lesson: The lesson, its name, or the `Path` of its file or folder, which is run.
        params: The whole inputs, as the lesson's Params; instead of a preset and values.
        force: Replace a file that is there.
        values: Fields of the lesson's Params, by name.

    Raises:
        InputError: If the inputs cannot be used, the run fails, or the file is there or cannot be
            written; then nothing has changed.
    """
    if isinstance(lesson, str) and params is None:
        led = moved(lesson, preset, values)
        lesson, preset, values = led.lesson, led.preset, led.values
    if isinstance(lesson, str):
        loaded = find(lesson)
    elif isinstance(lesson, Path):
        loaded = load(lesson)
    else:
        loaded = lesson
    if params is not None and (preset is not None or values):
        other = f"preset {preset!r}" if preset is not None else f"{next(iter(values))}=…"
        raise InputError(f"params and {other}: give whole params, or a preset and single values")
    if params is None:
        params = knobs.make(
            loaded.params, values, base=None if preset is None else loaded.preset(preset).params
        )
    check_place(Path(path), force, how="force=True")
    record_file(loaded, params, Path(path), preset=preset, force=force)
    return Path(path)


def record_file(
    lesson: Lesson,
    params: Any,
    path: Path,
    *,
    preset: str | None = None,
    force: bool = False,
    progress: TextIO | None = None,
) -> Written:
    """Run a lesson and write the run to `path`, with a bar on `progress` if a terminal.

    Raises:
        InputError: If the run fails, or the file is there or cannot be written; then nothing has
            changed.
    """
    check_place(path, force)
    with bar(progress, "Recording") as tell:
        timeline = _run(lesson, params, tell)
        data = record_bytes(timeline, preset=preset, progress=tell)
    write_places({path: data})
    return Written(len(timeline), len(data), timeline.stopped)


def record_to_stdout(lesson: Lesson, params: Any, *, preset: str | None = None) -> None:
    """Run a lesson and write the recording to standard output, with a bar on a terminal.

    Raises:
        InputError: If the run fails, or standard output is a terminal, closed, or full.
    """
    if sys.stdout is None:
        raise InputError("standard output is closed: pipe it somewhere, or write -o FILE.rrd")
    if sys.stdout.isatty():
        raise InputError("standard output is a terminal: pipe it somewhere, or write -o FILE.rrd")
    with bar(sys.stderr, "Recording") as tell:
        data = record_bytes(_run(lesson, params, tell), preset=preset, progress=tell)
    left = memoryview(data)
    try:
        while left:  # without a buffer (python -u), less may be written than was asked for
            left = left[sys.stdout.buffer.write(left) :]
        sys.stdout.buffer.flush()
    except BrokenPipeError:
        raise
    except OSError as error:
        sys.stdout = None  # what is left in its buffer cannot be written at exit either
        raise InputError(
            f"standard output: cannot be written: {error.strerror or error}"
        ) from error


def record_bytes(
    timeline: Timeline, *, preset: str | None = None, progress: Progress | None = None
) -> bytes:
    """Return a recording of the steps of a run that are known so far.

    The preset's name is kept where the params still are the preset's.

    Raises:
        InputError: If no step is known.
    """
    steps = tuple(timeline.known())
    if not steps:
        raise InputError(timeline.stopped or "there is no step to record yet")
    lesson = timeline.lesson
    if preset is not None and lesson.preset(preset).params != timeline.params:
        preset = None  # changed since: the name would promise another run
    application = application_id(lesson.name)
    view = lesson.view_of(timeline.params)

    scenes = [step.scene for step in steps]
    contents, clouds = contents_of(scenes), unions(scenes)
    series = timeline.series()
    values = {path: line.values for path, line in series.items()}

    def fill(stream: Any) -> None:
        stream.send_recording_name(safe(_title(timeline, preset)))
        stream.send_property(
            "run", facts(layout=to_json(contents, view), **_facts(timeline, preset))
        )
        stream.log("/", rr.ViewCoordinates.RIGHT_HAND_Z_UP, static=True)
        stream.log("page", document(plain_page(_told(lesson))), static=True)
        send_captions(stream, [step.caption for step in steps])
        for order, (path, line) in enumerate(series.items()):
            send_series(stream, path, line, order=order)
        sink = RerunSink(stream, contents.canvases, clouds)
        for k, step in enumerate(steps):
            sink.show(k, step.scene)
            if progress is not None:
                progress("recorded", k + 1, len(steps))
        captions = [step.caption.text for step in steps]
        status = (
            "complete"
            if timeline.finished and timeline.stopped is None
            else timeline.stopped or "unfinished"
        )
        check = digest(knobs.to_json(timeline.params), captions, values)
        stream.send_property("result", facts(status=status, steps=len(steps), digest=check))

    return stream_bytes(application, fill, one_run(view, contents, values))


def _told(lesson: Lesson) -> str:
    """Return a lesson's page as a recording has it; one of the course says whose it is."""
    text = wording(plain_text(lesson), "site")
    ours = is_of_course(lesson)
    return f"{text.rstrip()}\n\n{NOTICE}\n" if ours else text


def _run(lesson: Lesson, params: Any, tell: Progress) -> Timeline:
    """Return a run to its end, or to the bound where it was cut; raise InputError if it failed."""
    timeline = Timeline(lesson, params)
    while timeline.extend():
        tell("computed", len(timeline), None)
        if timeline.stopped is not None:  # cut after a good step
            return timeline
    if timeline.stopped is not None:
        at = f" (at step {len(timeline)})" if len(timeline) else ""
        raise InputError(f"{timeline.stopped}{at}; nothing was written")
    return timeline


def _title(timeline: Timeline, preset: str | None) -> str:
    words = [timeline.lesson.title]
    if preset is not None:
        words.append(timeline.lesson.preset(preset).title)
    else:
        words += [
            f"{name} {value}" for name, value in list(knobs.changed(timeline.params).items())[:3]
        ]
    return ", ".join(words)


def _facts(timeline: Timeline, preset: str | None) -> dict[str, Any]:
    params = timeline.params
    return {
        "lesson": timeline.lesson.name,
        "title": timeline.lesson.title,
        "params": knobs.to_json(params),
        "preset": preset or "",
        "seed": int(getattr(params, "seed", -1)),
        "format": FORMAT,
        "version": __version__,
        "versions": json.dumps(
            {"workbench": __version__, "rerun": rr.__version__, "numpy": np.__version__}
        ),
    }
