"""Commands that open runs in a browser, record them and play recordings."""

import sys
from dataclasses import asdict, replace
from pathlib import Path
from typing import Annotated, Any, Literal

from workbench.commands.complaints import complain
from workbench.errors import InputError
from workbench.knobs import called_by_flags
from workbench.run.flags import Option, RunChoice, Serving, ServingLive
from workbench.run.loading import lesson_given

Recording = Annotated[
    Path, Option("A recording made by `workbench record` or on the live page.", "FILE.rrd")
]
OwnLesson = Annotated[
    str | None,
    Option("The lesson's own file or folder, where the catalogue does not have it.", "PATH"),
]
Native = Annotated[bool, Option("Open Rerun's own window instead of the browser.")]


def serve(serving: ServingLive) -> None:
    """Serve all lessons and open the course page."""
    from workbench.viewer.serving import serve as serve_page

    tell_namesakes()
    serve_page(**asdict(serving))


def list_() -> None:
    """List the lessons in course order."""
    from workbench.run.listing import listed

    sys.stdout.write(listed())


def show(
    run: RunChoice,
    serving: ServingLive,
    step: Annotated[
        int | None, Option("Step to open at; negative counts from the end.", "K")
    ] = None,
    *,
    with_: Annotated[
        Path | None,
        Option("Your own function, loaded again whenever the file is saved.", "FILE.py"),
    ] = None,
) -> None:
    """Open one lesson in the browser, at these params; one given by its path is loaded again when
    its files are saved.
    """
    from workbench.viewer.serving import serve as serve_page

    tell_namesakes()
    watched = edited = None
    if with_ is not None:
        from workbench.exercise.sandbox import best
        from workbench.exercise.watching import WatchedFile

        watched = WatchedFile(run.lesson, with_)
        first = None if run.preset is not None else watched.first_preset(run.params)
        run = run if first is None else replace(run, params=first.params, preset=first.name)
        if not best().holds:
            complain(f"{with_} runs without a sandbox ({best().why}): show only what you trust")
    _try_first_step(run.lesson, run.params)
    if step is None and run.preset is not None:
        step = run.lesson.preset(run.preset).step
    if run.path is not None:
        from workbench.authoring.reloading import Edited

        edited = Edited(run.path, run.lesson)
    lesson = run.lesson if watched is None else watched.lesson
    serve_page(lesson, run.params, step, **asdict(serving), watched=watched, edited=edited)


def record(
    run: RunChoice,
    out: Annotated[
        Path, Option("File to write; - writes to standard output.", "FILE.rrd", short="-o")
    ],
    force: Annotated[bool, Option("Replace the file where it exists.")] = False,
) -> None:
    """Run a lesson without a window and write the run to a recording."""
    from workbench.recording.write import record_file, record_to_stdout

    if str(out) == "-":
        with called_by_flags():
            record_to_stdout(run.lesson, run.params, preset=run.preset)
        return
    with called_by_flags():
        written = record_file(
            run.lesson, run.params, out, preset=run.preset, force=force, progress=sys.stderr
        )
    if written.stopped is not None:
        complain(f"{written.stopped} What there is, is recorded.")
    sys.stdout.write(f"{out}: {written.steps:,} steps, {written.bytes / 1e6:.1f} MB\n")


def picture(
    run: RunChoice,
    out: Annotated[
        Path,
        Option(
            "File to write: .png, .svg, .webp, .gif or .mp4; a folder with --scenes.",
            "FILE",
            short="-o",
        ),
    ],
    *,
    step: Annotated[
        int | None, Option("Step of a picture; negative counts from the end.", "K")
    ] = None,
    from_: Annotated[int | None, Option("First step of a film; 0 without it.", "K")] = None,
    to: Annotated[int | None, Option("Last step of a film; the run's own end without it.", "K")] = (
        None
    ),
    seconds: Annotated[float | None, Option("How long a film is.", "S")] = None,
    width: Annotated[int, Option("Pixels, 160 to 3840.", "PX")] = 1200,
    dark: Annotated[bool, Option("On a dark ground.")] = False,
    chart: Annotated[bool, Option("Leave out the chart below the scene.")] = True,
    captions: Annotated[
        Literal["picture", "beside", "none"],
        Option("In the picture, as subtitles in a file beside it, or none.", "WHERE"),
    ] = "picture",
    scenes: Annotated[
        bool, Option("A picture for each scene of a story, into the folder -o names.")
    ] = False,
    as_: Annotated[
        Literal["png", "svg"] | None, Option("What the pictures of scenes are; png without it.")
    ] = None,
    force: Annotated[bool, Option("Replace files that are there.")] = False,
) -> None:
    """Draw a step of a run as a picture, a stretch of it as a film, or a story as slides."""
    from workbench.machinery.progress import bar
    from workbench.picture.asking import Asked
    from workbench.picture.making import pictured, scene_files
    from workbench.picture.sheet import Style

    asked = Asked(
        step=step,
        first=from_,
        last=to,
        seconds=seconds,
        style=Style(width=width, dark=dark, chart=chart),
        captions=captions,
        slides=as_,
    )
    with bar(sys.stderr, "Drawing") as progress, called_by_flags():
        if scenes:
            files = scene_files(run.lesson, out, asked, force=force, progress=progress)
        else:
            files = pictured(
                run.lesson,
                run.params,
                out,
                asked=asked,
                preset=run.preset,
                force=force,
                progress=progress,
            )
    for file in files:
        sys.stdout.write(f"{file}: {file.stat().st_size / 1e3:,.0f} kB\n")


def replay(file: Recording, /, serving: Serving, native: Native = False) -> None:
    """Play a recording in Rerun's viewer, without any network."""
    from workbench.recording.replay import replay_file

    replay_file(file, native=native, host=serving.host, port=serving.port, browser=serving.browser)


def reopen(
    file: Recording,
    /,
    serving: ServingLive,
    lesson: OwnLesson = None,
    *,
    files: Annotated[bool, Option("Open the files that the recording names as its input.")] = False,
) -> None:
    """Open the live lesson at the params of a recording."""
    from workbench.recording.read import reopening
    from workbench.viewer.serving import serve as serve_page

    given = None if lesson is None else lesson_given(lesson)
    recorded, params, warnings = reopening(file, given, files=files)
    for warning in warnings:
        complain(warning)
    _try_first_step(recorded, params)
    serve_page(recorded, params, None, **asdict(serving))


def compare(a: Recording, b: Recording, /, serving: Serving, *, native: Native = False) -> None:
    """Play two recordings of one lesson side by side, their curves in one plot."""
    from workbench.recording.compare import compare_files

    compare_files(
        a, b, native=native, host=serving.host, port=serving.port, browser=serving.browser
    )


def _try_first_step(lesson: Any, params: Any) -> None:
    """Raise InputError before a server starts where the run cannot give even its first step."""
    from workbench.run.timeline import Timeline

    timeline = Timeline(lesson, params)
    with called_by_flags():
        timeline.extend()
    if timeline.stopped is not None and not len(timeline):
        raise InputError(timeline.stopped)


def tell_namesakes() -> None:
    """Say which other distributions have a package of our name: one overwrites files of the
    other.
    """
    from workbench.machinery.namesake import namesakes

    for name in namesakes():
        complain(
            f"{name} is installed here too and has a package `workbench` as well; "
            "give each an environment of its own"
        )
