"""The commands. Adding one is a matter of one function: `@command`, a signature of options, a
docstring.

Heavy modules (the viewer, the recorder) are imported inside the functions that need them:
`workbench list` answers at once. Every InputError becomes one line on stderr and exit code 2.
"""

import sys
from collections.abc import Callable, Sequence
from dataclasses import asdict, replace
from pathlib import Path
from typing import Annotated, Any, Literal

from workbench.errors import InputError, not_among, one_line
from workbench.knobs import called_by_flags
from workbench.lesson import catalog
from workbench.machinery.docstrings import summary_of
from workbench.machinery.version import __version__
from workbench.run.flags import Option, RunChoice, Serving, ServingLive, parse
from workbench.run.links import command_line
from workbench.run.loading import is_path, lesson_given

Command = Callable[..., int | None]
"""Does its work; returns the exit code where it is neither 0 nor, for an InputError, 2."""
COMMANDS: dict[str, Command] = {}

Recording = Annotated[
    Path, Option("A recording made by `workbench record` or on the live page.", "FILE.rrd")
]
OwnLesson = Annotated[
    str | None,
    Option("The lesson's own file or folder, where the catalogue does not have it.", "PATH"),
]
Sandbox = Annotated[
    str,
    Option(
        "What shuts submissions in: auto, bubblewrap, landlock, or none (marks are not safe then).",
        "NAME",
    ),
]
Native = Annotated[bool, Option("Open Rerun's own window instead of the browser.")]


def command(function: Command) -> Command:
    """Add a function to the commands, under its name."""
    COMMANDS[function.__name__.rstrip("_")] = function
    return function


def serve(serving: ServingLive) -> None:
    """Serve all lessons and open the course page."""
    from workbench.viewer.serving import serve as serve_page

    _tell_namesakes()
    serve_page(**asdict(serving))


@command
def list_() -> None:
    """List the lessons in course order."""
    from workbench.run.listing import listed

    sys.stdout.write(listed())


@command
def show(
    run: RunChoice,
    serving: ServingLive,
    step: Annotated[
        int | None, Option("Step to open at; negative counts from the end.", "K")
    ] = None,
    with_: Annotated[
        Path | None,
        Option("Your own function, loaded again whenever the file is saved.", "FILE.py"),
    ] = None,
) -> None:
    """Open one lesson in the browser, at these params; one given by its path is loaded again when
    its files are saved.
    """
    from workbench.viewer.serving import serve as serve_page

    _tell_namesakes()
    watched = edited = None
    if with_ is not None:
        from workbench.exercise.sandbox import best
        from workbench.exercise.watching import WatchedFile

        watched = WatchedFile(run.lesson, with_)
        first = None if run.preset is not None else watched.first_preset(run.params)
        run = run if first is None else replace(run, params=first.params, preset=first.name)
        if not best().holds:
            _complain(f"{with_} runs without a sandbox ({best().why}): show only what you trust")
    _try_first_step(run.lesson, run.params)
    if step is None and run.preset is not None:
        step = run.lesson.preset(run.preset).step
    if run.path is not None:
        from workbench.authoring.reloading import Edited

        edited = Edited(run.path, run.lesson)
    lesson = run.lesson if watched is None else watched.lesson
    serve_page(lesson, run.params, step, **asdict(serving), watched=watched, edited=edited)


@command
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
        _complain(f"{written.stopped} What there is, is recorded.")
    sys.stdout.write(f"{out}: {written.steps:,} steps, {written.bytes / 1e6:.1f} MB\n")


@command
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


@command
def replay(file: Recording, /, serving: Serving, native: Native = False) -> None:
    """Play a recording in Rerun's viewer, without any network."""
    from workbench.recording.replay import replay_file

    replay_file(file, native=native, host=serving.host, port=serving.port, browser=serving.browser)


@command
def reopen(
    file: Recording,
    /,
    serving: ServingLive,
    lesson: OwnLesson = None,
    files: Annotated[bool, Option("Open the files that the recording names as its input.")] = False,
) -> None:
    """Open the live lesson at the params of a recording."""
    from workbench.recording.read import reopening
    from workbench.viewer.serving import serve as serve_page

    given = None if lesson is None else lesson_given(lesson)
    recorded, params, warnings = reopening(file, given, files=files)
    for warning in warnings:
        _complain(warning)
    _try_first_step(recorded, params)
    serve_page(recorded, params, None, **asdict(serving))


@command
def compare(a: Recording, b: Recording, /, serving: Serving, native: Native = False) -> None:
    """Play two recordings of one lesson side by side, their curves in one plot."""
    from workbench.recording.compare import compare_files

    compare_files(
        a, b, native=native, host=serving.host, port=serving.port, browser=serving.browser
    )


@command
def exercise(
    name: Annotated[
        str | None,
        Option(
            "An exercise, or a lesson for all of its exercises; without it they are listed.", "NAME"
        ),
    ] = None,
    /,
    out: Annotated[Path, Option("Folder to write into.", "DIR", short="-o")] = Path(),
    lesson: OwnLesson = None,
    force: Annotated[
        bool, Option("Replace a file that is there: your work in it is lost.")
    ] = False,
) -> None:
    """Write the starter file of an exercise, or list all exercises."""
    from workbench.exercise.finding import exercises, exercises_of, find_exercise
    from workbench.exercise.starter import write_starter

    own = None if lesson is None else lesson_given(lesson)
    if name is None:
        for item in exercises().values() if own is None else exercises_of(own):
            sys.stdout.write(
                f"{item.lesson:<12} {item.name:<25} {item.task.split('. ')[0].rstrip('.')}.\n"
            )
        return
    whole = catalog().get(name)
    for item in (whole and exercises_of(whole)) or (find_exercise(name, own),):
        sys.stdout.write(f"{write_starter(item, out, force=force)}\n")


@command
def check(
    file: Annotated[Path, Option("Your file, with the function of an exercise.", "FILE.py")],
    /,
    out: Annotated[
        Path | None,
        Option("Folder for result.json, results.json, junit.xml, summary.md.", "DIR", short="-o"),
    ] = None,
    lesson: OwnLesson = None,
    hidden: Annotated[bool, Option("Run the hidden checks too, where they are installed.")] = False,
    sandbox: Sandbox = "auto",
) -> int:
    """Judge one file by an exercise's checks; exit code 1 without full marks."""
    from workbench.exercise.checking import check_file
    from workbench.exercise.failing import record_failing
    from workbench.exercise.reports import terminal, write_files
    from workbench.exercise.sandbox import named

    own = None if lesson is None else lesson_given(lesson)
    wall = named(sandbox)
    if not wall.holds:
        _complain(f"{file} runs without a sandbox ({wall.why}): check only what you trust")
    reports, failed = check_file(file, own, hidden=hidden, wall=wall)
    if out is not None:
        write_files(reports, out, failed)
    for report in reports:
        sys.stdout.write(terminal(report) + "\n")
        sys.stdout.flush()  # what follows takes a while
        recorded = (
            None
            if report.is_full or report.is_refused
            else record_failing(report.exercise, file, lesson=own)
        )
        if recorded is not None:
            sys.stdout.write(f"  Watch where it goes wrong: {command_line('replay', recorded)}\n")
    for item in failed:
        _complain(item["error"])
    return 2 if failed else int(not all(report.is_full for report in reports))


@command
def grade(
    folder: Annotated[Path, Option("Submissions: NAME.py files, or a folder per student.", "DIR")],
    /,
    out: Annotated[
        Path | None, Option("Folder for the results; DIR/graded by default.", "DIR", short="-o")
    ] = None,
    only: Annotated[str | None, Option("Grade this exercise only.", "EXERCISE")] = None,
    lesson: OwnLesson = None,
    jobs: Annotated[
        int | None, Option("How many submissions at a time; the number of cores by default.", "N")
    ] = None,
    dask: Annotated[
        str | None, Option("Address of a Dask scheduler that does the work.", "ADDRESS")
    ] = None,
    roster: Annotated[
        Path | None,
        Option("A table of all students: who handed in nothing gets a row.", "FILE.csv"),
    ] = None,
    assignment: Annotated[
        Path | None,
        Option("What a handout's assignment.json says its exercises are worth.", "FILE.json"),
    ] = None,
    seed: Annotated[
        int | None,
        Option("A number of yours, 0 or more, that the hidden checks are drawn from.", "N"),
    ] = None,
    sandbox: Sandbox = "auto",
) -> int:
    """Grade a folder of submissions; goes on where it was interrupted."""
    from workbench.exercise.classroom import Asked, grade_folder
    from workbench.handout.assignment import read_file

    if lesson is not None:
        lesson_given(lesson)  # what is wrong with it is told once, before the first submission
    worth = None if assignment is None else read_file(assignment).worth
    if seed is not None and seed < 0:
        raise InputError(f"--seed {seed}: a seed is 0 or more")
    place = Path(lesson).resolve() if lesson is not None and is_path(lesson) else None
    asked = Asked((only,) if only else (), place, sandbox, seed)
    return grade_folder(
        folder,
        out or folder / "graded",
        asked=asked,
        roster=roster,
        worth=worth,
        jobs=jobs,
        dask=dask,
        tell=sys.stderr,
        result=sys.stdout,
    )


@command
def handout(
    words: Annotated[
        tuple[str, ...],
        Option(
            "Exercises, or a lesson for all of its exercises; then the folder to write into.",
            "EXERCISE ... OUT",
        ),
    ],
    /,
    for_: Annotated[
        str, Option("Where it is graded: gradescope, prairielearn, or folder.", "SERVICE")
    ],
    weight: Annotated[
        tuple[str, ...],
        Option("Points of an exercise; those of its checks by default.", "EXERCISE=POINTS ..."),
    ] = (),
    release: Annotated[
        str | None, Option("When it opens, such as 2027-03-01 or 2027-03-01T09:00.", "DATE")
    ] = None,
    due: Annotated[
        str | None, Option("When it is due; a day ends at its last second.", "DATE")
    ] = None,
    sandbox: Sandbox = "auto",
    force: Annotated[bool, Option("Replace files that are there.")] = False,
) -> None:
    """Write an assignment that a course system takes as it is, with starters, samples and a
    README.
    """
    from workbench.handout.assignment import assigned
    from workbench.handout.writing import tried, write

    *names, out = words
    if not names:
        raise InputError(
            f"which exercises? `workbench exercise` lists them; {out} is taken for the folder to"
            " write into"
        )
    assignment = assigned(
        names, service=for_, weights=weight, release=release, due=due, sandbox=sandbox
    )
    write(assignment, Path(out), force=force)
    sys.stdout.write(f"{Path(out) / 'README.md'}\n{tried(assignment, Path(out))}\n")


@command
def new(
    name: Annotated[str, Option("What the lesson is called: small letters, digits and _.", "NAME")],
    /,
    out: Annotated[
        Path, Option("Folder to make the lesson's folder in.", "DIR", short="-o")
    ] = Path(),
) -> None:
    """Write a folder with a lesson that runs, to be made your own."""
    from workbench.authoring.new import new_lesson

    for path in new_lesson(name, out):
        sys.stdout.write(f"{path}\n")
    sys.stdout.write(f"Open it: {command_line('show', out / name)}\n")


@command
def validate(
    lesson: Annotated[
        str, Option("The lesson: its name, or the path of its file or folder.", "LESSON")
    ],
    /,
) -> int:
    """Hold a lesson and its exercises to what is promised of all of them; exit code 1 where
    something is wrong.
    """
    from workbench.authoring.validate import validate as held_to_its_promises

    report = held_to_its_promises(
        lesson, lambda line: sys.stdout.write(f"{line}\n") and sys.stdout.flush()
    )
    if report.wrong:
        return 1
    sys.stdout.write(f"{report.name}: holds ({report.looked_at} checks)\n")
    return 0


@command
def publish(
    out: Annotated[Path, Option("Folder to write the site into.", "OUT")],
    /,
    lesson: Annotated[
        tuple[str, ...],
        Option(
            "Only these lessons; what the site has of others stays. All by default.", "NAME ..."
        ),
    ] = (),
    base_url: Annotated[
        str | None,
        Option("The address the site will have: for links, pictures of links, its map.", "URL"),
    ] = None,
    force: Annotated[
        bool, Option("Replace files that publish did not write, or that were changed since.")
    ] = False,
    recordings: Annotated[
        Literal["all", "linked", "none"],
        Option("Of which runs: all, those that a text names, or none.", "all|linked|none"),
    ] = "linked",
    python: Annotated[
        str | None,
        Option(
            "Let the pages compute: the folder of a Pyodide release, or its address.",
            "FOLDER|URL",
        ),
    ] = None,
) -> None:
    """Write static tutorial pages that play in any browser, without Python."""
    from workbench.machinery.progress import bar
    from workbench.publish.runs import swept_files
    from workbench.publish.site import publish as publish_site
    from workbench.publish.sizes import sizes_told

    names = dict.fromkeys(name for word in lesson for name in word.split(",") if name)
    chosen = [lesson_given(name) for name in names or catalog()]
    given = dict[str, str]()
    for word, entry in zip(names or catalog(), chosen, strict=True):
        if entry.name in given:
            raise InputError(
                f"{given[entry.name]} and {word} are both named {entry.name!r}: a site has one of a"
                " name"
            )
        given[entry.name] = word
    with bar(sys.stderr, "Publishing") as progress:
        files = publish_site(
            out,
            chosen,
            base_url=base_url,
            force=force,
            remove_others=not names,
            recordings=recordings,
            python=python,
            progress=progress,
        )
    sys.stdout.write(sizes_told(out, files, swept_files(chosen)) + "\n")


def main(args: Sequence[str] | None = None) -> int:
    """Carry out a command line and return its exit code."""
    words = list(sys.argv[1:] if args is None else args)
    code = 0
    try:
        code = _carry_out(words) or 0
        sys.stdout.flush()
    except InputError as error:
        _complain(str(error))
        return 2
    except KeyboardInterrupt:
        return 130
    except BrokenPipeError:  # the reader of our output, such as `head`, has had enough
        sys.stdout = None
        return 0
    except OSError as error:
        _complain(f"{error.filename or 'standard output'}: {error.strerror or error}")
        sys.stdout = None
        return 2
    except SystemExit:  # after --help
        return 0
    return code


def _carry_out(words: list[str]) -> int | None:
    if words == ["--version"]:
        sys.stdout.write(f"{__version__}\n")
    elif not words or words[0].startswith("-"):
        return parse(serve, words, "workbench", description=_overview())()
    elif words[0] not in COMMANDS:
        raise InputError(f"no command is named {words[0]!r}; {not_among(words[0], COMMANDS)}")
    else:
        function = COMMANDS[words[0]]
        return parse(
            function, words[1:], f"workbench {words[0]}", description=function.__doc__ or ""
        )()
    return None


def _overview() -> str:
    lines = [f"  {name:<9} {summary_of(function)}" for name, function in COMMANDS.items()]
    head = (
        "Watch, touch, record and grade the algorithms of 3D vision. Without a command: "
        + (serve.__doc__ or "").lower()
    )
    return "\n".join(
        [head, "", "commands:", *lines, "", "`workbench COMMAND --help` says more of each."]
    )


def _try_first_step(lesson: Any, params: Any) -> None:
    """Raise InputError before a server starts where the run cannot give even its first step."""
    from workbench.run.timeline import Timeline

    timeline = Timeline(lesson, params)
    with called_by_flags():
        timeline.extend()
    if timeline.stopped is not None and not len(timeline):
        raise InputError(timeline.stopped)


def _tell_namesakes() -> None:
    """Say which other distributions have a package of our name: one overwrites files of the
    other.
    """
    from workbench.machinery.namesake import namesakes

    for name in namesakes():
        _complain(
            f"{name} is installed here too and has a package `workbench` as well; "
            "give each an environment of its own"
        )


def _complain(line: str) -> None:
    sys.stderr.write(f"workbench: {one_line(line)}\n")
