"""The commands. Adding one is a matter of one function: `@command`, a signature of options, a docstring.

Heavy modules (the viewer, the recorder, tyro) are imported inside the functions that need them: `workbench list` answers
at once. Every InputError becomes one line on stderr and exit code 2.
"""

import sys
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Annotated, Any

from workbench import __version__
from workbench.errors import InputError
from workbench.flags import Chosen, Option, Serving, parse
from workbench.lesson import catalog

Command = Callable[..., None]
COMMANDS: dict[str, Command] = {}

Recording = Annotated[Path, Option("A recording made by `workbench record` or on the live page.", "FILE.rrd")]
Native = Annotated[bool, Option("Open Rerun's own window instead of the browser.")]


def command(function: Command) -> Command:
    """Add a function to the commands, under its name."""
    COMMANDS[function.__name__.rstrip("_")] = function
    return function


def serve(serving: Serving) -> None:
    """Serve all lessons and open the course page."""
    from workbench.viewer.app import serve as serve_page

    serve_page(host=serving.host, port=serving.port, browser=serving.browser)


@command
def list_() -> None:
    """List the lessons in course order."""
    lessons = catalog().values()
    width = max((len(lesson.name) for lesson in lessons), default=0)
    for lesson in lessons:
        sys.stdout.write(f"{lesson.name:<{width}}  {lesson.summary}\n")


@command
def show(
    run: Chosen,
    serving: Serving,
    step: Annotated[int | None, Option("Step to open at; negative counts from the end.", "K")] = None,
) -> None:
    """Open one lesson in the browser, at these params."""
    from workbench.viewer.app import serve as serve_page

    _try_first_step(run.lesson, run.params)
    if step is None and run.preset is not None:
        step = run.lesson.preset(run.preset).step
    serve_page(run.lesson, run.params, step, host=serving.host, port=serving.port, browser=serving.browser)


@command
def record(
    run: Chosen,
    out: Annotated[Path, Option("File to write; - writes to standard output.", "FILE.rrd", short="-o")],
    force: Annotated[bool, Option("Replace the file where it exists.")] = False,
) -> None:
    """Run a lesson without a window and write the run to a recording."""
    from workbench.recording.write import record_file, record_to_stdout

    if str(out) == "-":
        record_to_stdout(run.lesson, run.params, preset=run.preset)
    else:
        record_file(run.lesson, run.params, out, preset=run.preset, force=force, progress=sys.stderr)


@command
def replay(file: Recording, /, serving: Serving, native: Native = False) -> None:
    """Play a recording in Rerun's viewer, without any network."""
    from workbench.recording.replay import replay_file

    replay_file(file, native=native, host=serving.host, port=serving.port, browser=serving.browser)


@command
def reopen(file: Recording, /, serving: Serving) -> None:
    """Open the live lesson at the params of a recording."""
    from workbench.recording.read import reopening
    from workbench.viewer.app import serve as serve_page

    lesson, params, warnings = reopening(file)
    for warning in warnings:
        _complain(warning)
    _try_first_step(lesson, params)
    serve_page(lesson, params, None, host=serving.host, port=serving.port, browser=serving.browser)


@command
def compare(a: Recording, b: Recording, /, serving: Serving, native: Native = False) -> None:
    """Play two recordings of one lesson side by side, their curves in one plot."""
    from workbench.recording.compare import compare_files

    compare_files(a, b, native=native, host=serving.host, port=serving.port, browser=serving.browser)


def main(args: Sequence[str] | None = None) -> int:
    """Carry out a command line and return its exit code."""
    words = list(sys.argv[1:] if args is None else args)
    try:
        _carry_out(words)
        sys.stdout.flush()
    except InputError as error:
        _complain(str(error))
        return 2
    except KeyboardInterrupt:
        return 130
    except BrokenPipeError:  # the reader of our output, such as `head`, has had enough
        sys.stdout = None
        return 0
    except SystemExit:  # after --help
        return 0
    return 0


def _carry_out(words: list[str]) -> None:
    if words == ["--version"]:
        sys.stdout.write(f"{__version__}\n")
    elif not words or words[0].startswith("-"):
        parse(serve, words, "workbench", _overview())()
    elif words[0] not in COMMANDS:
        raise InputError(f"no command is named {words[0]!r}; there are: {', '.join(COMMANDS)}")
    elif words == ["list"]:
        list_()  # without tyro: the quickest answer
    else:
        function = COMMANDS[words[0]]
        parse(function, words[1:], f"workbench {words[0]}", function.__doc__ or "")()


def _overview() -> str:
    lines = [f"  {name:<9} {(function.__doc__ or '').splitlines()[0]}" for name, function in COMMANDS.items()]
    head = "Watch, touch and record the algorithms of 3D vision. Without a command: " + (serve.__doc__ or "").lower()
    return "\n".join([head, "", "commands:", *lines, "", "`workbench COMMAND --help` says more of each."])


def _try_first_step(lesson: Any, params: Any) -> None:
    """Raise InputError before a server starts where the run cannot give even its first step."""
    from workbench.timeline import Timeline

    timeline = Timeline(lesson, params)
    timeline.extend()
    if timeline.stopped is not None and not len(timeline):
        raise InputError(timeline.stopped)


def _complain(line: str) -> None:
    sys.stderr.write(f"workbench: {line}\n")
