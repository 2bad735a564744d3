"""Commands for exercises: files to hand out, checks, marks."""

import sys
from pathlib import Path
from typing import Annotated

from workbench.commands.complaints import complain
from workbench.errors import InputError
from workbench.lesson import catalog
from workbench.run.flags import Option
from workbench.run.links import command_line
from workbench.run.loading import is_path, lesson_given

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
    *,
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


def check(
    file: Annotated[Path, Option("Your file, with the function of an exercise.", "FILE.py")],
    /,
    out: Annotated[
        Path | None,
        Option("Folder for result.json, results.json, junit.xml, summary.md.", "DIR", short="-o"),
    ] = None,
    lesson: OwnLesson = None,
    *,
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
        complain(f"{file} runs without a sandbox ({wall.why}): check only what you trust")
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
        complain(item["error"])
    return 2 if failed else int(not all(report.is_full for report in reports))


def grade(
    folder: Annotated[Path, Option("Submissions: NAME.py files, or a folder per student.", "DIR")],
    /,
    out: Annotated[
        Path | None, Option("Folder for the results; DIR/graded by default.", "DIR", short="-o")
    ] = None,
    only: Annotated[str | None, Option("Grade this exercise only.", "EXERCISE")] = None,
    *,
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
    *,
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
