"""Commands for authors: a new lesson, what holds of it, a site of pages."""

import sys
from pathlib import Path
from typing import Annotated, Literal

from workbench.errors import InputError
from workbench.lesson import catalog
from workbench.run.flags import Option
from workbench.run.links import command_line
from workbench.run.loading import lesson_given


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
    *,
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
