"""Writes a static site: a course page and one page per lesson, with replays that play from disk,
offline.
"""

from collections.abc import Collection, Mapping, Sequence
from pathlib import Path
from typing import Any
from urllib.parse import urlsplit

import viser

from workbench.chapters import place
from workbench.errors import InputError
from workbench.lesson import Lesson
from workbench.machinery.progress import Progress
from workbench.machinery.version import __version__
from workbench.moved import lessons_led_on, runs_led_on
from workbench.page.course import FRONT_FILES
from workbench.page.document import (
    DRESS,
    FONTS,
    MATH,
    MATH_FONT,
    RECORDED,
    SCRIPTS,
    STATIC,
    STORY_SCRIPTS,
    STORY_STYLES,
    STYLES,
    THIRD_PARTIES,
    bare,
    in_script,
)
from workbench.page.thumbnail import thumbnail
from workbench.publish.computing import computing
from workbench.publish.lock import only_writer
from workbench.publish.manifest import NAME, Listed, Manifest
from workbench.publish.pages import (
    LESSONS,
    answers,
    course_page,
    leading_on,
    lesson_page,
    lessons_script,
)
from workbench.publish.runs import (
    CLIENT,
    PAGE,
    Recordings,
    Run,
    client_script,
    digest_of,
    files_of,
    page_digest,
    recorded,
    render_all,
    runs_of,
)
from workbench.publish.sizes import COURSE_PAGE, checked
from workbench.recording import equal_content
from workbench.run.timeline import Timelines
from workbench.words.typeset import math_font, math_font_css

PICTURE = "picture.webp"


def publish(
    out: Path,
    lessons: Sequence[Lesson],
    *,
    base_url: str | None = None,
    force: bool = False,
    remove_others: bool = False,
    recordings: Recordings = "linked",
    python: str | None = None,
    progress: Progress | None = None,
) -> list[tuple[str, int]]:
    """Write lessons into a site and return all that the site holds of ours: (file, bytes).

    What is there of an earlier site and still fits is kept. A file that we did not write, or that
    was changed since, is neither replaced nor removed.

    Args:
        out: The folder.
        lessons: What is published.
        base_url: The address the site will have, for canonical links.
        force: Replace files of others that are in the way.
        remove_others: These are all lessons of the site: others that we published before go.
        recordings: Which runs can be downloaded as recordings: all but those of sweeps, the default
            and those that the page's text names, or none.
        python: A folder with the files of a Pyodide release, or its address: then the pages can
            compute.
        progress: Told of each run.

    Raises:
        InputError: If Python's place cannot be used or somebody else's file is in the way (then
            nothing has changed), another publish is writing here, a run fails, a file cannot be
            written, a link leads nowhere, or something is over its size budget.
    """
    for lesson in lessons:
        runs = runs_of(lesson, "all")
        if not all(
            NAME.fullmatch(name)
            for name in (lesson.name, *(run.name for run in runs if run.recorded))
        ):
            raise InputError(
                f"lesson {lesson.name!r}: a name on a site has the signs A-Z a-z 0-9 _ - only"
            )
        if len({run.file.casefold() for run in runs}) < len(runs):
            raise InputError(
                f"lesson {lesson.name!r}: two of its runs would have one file; give them other"
                " names or values"
            )
    canonical(base_url, "")  # raises here where it is none
    try:
        out.mkdir(parents=True, exist_ok=True)
        with only_writer(out):
            return _publish(
                out,
                lessons,
                base_url,
                force=force,
                remove_others=remove_others,
                recordings=recordings,
                python=python,
                progress=progress,
            )
    except OSError as error:
        raise InputError(f"{error.filename or out}: {error.strerror or error}") from None


def _publish(
    out: Path,
    lessons: Sequence[Lesson],
    base_url: str | None,
    *,
    force: bool,
    remove_others: bool,
    recordings: Recordings,
    python: str | None,
    progress: Progress | None,
) -> list[tuple[str, int]]:
    manifest = Manifest(out)
    manifest.remove_leftovers()
    names = {lesson.name for lesson in lessons}
    others = (
        {}
        if remove_others
        else {name: one for name, one in manifest.lessons.items() if name not in names}
    )
    made_by = f"workbench {__version__}, viser {viser.__version__}"
    if others and manifest.made_by != made_by:
        raise InputError(
            f"{out}: its other lessons were published by another version; publish all of them again"
        )
    work = [(lesson, run) for lesson in lessons for run in runs_of(lesson, recordings)]
    computes = None if python is None else computing(python, lessons, others)
    shared = {
        f"{PAGE}/{name}": bare(STATIC / name).encode()
        for name in (*STYLES, *FRONT_FILES, *RECORDED, *SCRIPTS)
    }
    shared |= {
        f"{PAGE}/{name}": bare(STATIC / name).encode()
        for name in (*STORY_STYLES, *STORY_SCRIPTS, *DRESS)
    }
    shared |= {f"{PAGE}/{name}": (STATIC / name).read_bytes() for name in FONTS}
    shared |= {
        f"{PAGE}/{MATH}": math_font_css(MATH_FONT).encode(),
        f"{PAGE}/{MATH_FONT}": math_font(),
        ".nojekyll": b"",
    }
    shared |= {CLIENT: client_script().encode()}
    shared |= {f"{PAGE}/{THIRD_PARTIES}": (STATIC / THIRD_PARTIES).read_bytes()}
    shared |= {} if computes is None else computes.files
    wanted = {COURSE_PAGE, LESSONS, *shared}
    wanted |= {f"{name}/{file}" for name in names for file in (COURSE_PAGE, PICTURE)}
    wanted |= {name for lesson, run in work for name in files_of(lesson, run)}
    leading = _leading_on(lessons, {*names, *others})
    wanted |= set(leading)
    manifest.check(wanted, force=force)

    manifest.made_by = made_by
    _render(manifest, work, progress)
    manifest.write({**shared, **leading})
    timelines = Timelines()
    for lesson in lessons:
        data = None if computes is None else computes.page_data(lesson)
        address = canonical(base_url, f"{lesson.name}/")
        _write_page(manifest, lesson, timelines, address=address, computes=data)
    listed = others | {
        lesson.name: Listed(
            lesson.title, lesson.summary, lesson.order, lesson.needs, lesson.chapter, lesson.minutes
        )
        for lesson in lessons
    }
    manifest.lessons = dict(
        sorted(listed.items(), key=lambda item: place(item[1].chapter, item[1].order, item[0]))
    )
    course = {
        COURSE_PAGE: course_page(manifest.lessons, canonical(base_url, "")),
        LESSONS: lessons_script(manifest.lessons),
    }
    manifest.write({name: text.encode() for name, text in course.items()})
    manifest.remove(
        name
        for name in manifest.files
        if name not in wanted and name.partition("/")[0] not in others
    )
    manifest.runs = {
        key: value
        for key, value in manifest.runs.items()
        if key.partition("/")[0] in manifest.lessons
    }
    manifest.save()
    return checked(out, manifest.files)


def _leading_on(lessons: Sequence[Lesson], there: Collection[str]) -> dict[str, bytes]:
    """Return the pages of runs that are in another lesson of the site now, at their addresses of
    before.

    A lesson that is in others altogether has a page of its own, which leads on as well.
    """
    titles = {lesson.name: lesson.title for lesson in lessons}
    gone = {name: to for name, to in lessons_led_on().items() if to in titles and name not in there}
    known = {lesson.name: {run.name for run in runs_of(lesson)} for lesson in lessons}

    def page_of(to: str, run: str) -> str:
        there = run in known.get(to, {run})  # a lesson may be published without some of its runs
        return f"runs/{run}.html" if there else COURSE_PAGE

    pages = {
        f"{name}/{COURSE_PAGE}": leading_on(titles[to], f"../{to}/{COURSE_PAGE}").encode()
        for name, to in gone.items()
    }
    return pages | {
        f"{name}/runs/{old}.html": (
            leading_on(titles.get(to, to), f"../../{to}/{page_of(to, run)}").encode()
        )
        for name in (*titles, *gone)
        for old, (to, run) in runs_led_on(name).items()
        if to in there
    }


def _render(
    manifest: Manifest, work: Sequence[tuple[Lesson, Run]], progress: Progress | None
) -> None:
    """Write the files of those runs that are not there as they should be."""
    digests = {(lesson.name, run.name): digest_of(lesson, run) for lesson, run in work}
    stale = [
        (lesson, run)
        for lesson, run in work
        if manifest.runs.get(f"{lesson.name}/{run.name}") != digests[lesson.name, run.name]
        or not all(map(manifest.is_ours, files_of(lesson, run)))
    ]
    done = len(work) - len(stale)
    for lesson, run, files in render_all(stale):
        manifest.runs.pop(f"{lesson.name}/{run.name}", None)
        manifest.write(
            {name: data for name, data in files.items() if not _is_equal(manifest, name, data)}
        )
        manifest.runs[f"{lesson.name}/{run.name}"] = digests[lesson.name, run.name]
        manifest.save()  # who stops here goes on here
        done += 1
        if progress is not None:
            progress(f"{lesson.name}/{run.name}", done, len(work))


def _write_page(
    manifest: Manifest,
    lesson: Lesson,
    timelines: Timelines,
    *,
    address: str,
    computes: Mapping[str, Any] | None,
) -> None:
    """Write a lesson's page if it is not there as it should be: its questions need runs."""
    key, names = f"{lesson.name}/", [f"{lesson.name}/{file}" for file in (COURSE_PAGE, PICTURE)]
    digest = page_digest(lesson, address + ("" if computes is None else in_script(computes)))
    if manifest.runs.get(key) == digest and all(map(manifest.is_ours, names)):
        return
    known = recorded(
        lesson, runs_of(lesson)[0], root="../", runs="runs/", answers=answers(lesson, timelines)
    )
    picture = thumbnail(lesson, timelines)
    manifest.runs.pop(key, None)
    manifest.write(
        dict(
            zip(
                names,
                (lesson_page(lesson, known, address, computes).encode(), picture),
                strict=True,
            )
        )
    )
    manifest.runs[key] = digest


def _is_equal(manifest: Manifest, name: str, data: bytes) -> bool:
    """Return whether our file there is a recording of equal content: its bytes may differ all the
    same.
    """
    return (
        name.endswith(".rrd")
        and manifest.is_ours(name)
        and equal_content(manifest.read(name), data)
    )


def canonical(base_url: str | None, path: str) -> str:
    """Return the canonical link of a page, nothing without an address."""
    if base_url is None:
        return ""
    try:
        parts = urlsplit(base_url)
    except ValueError:  # such as brackets that hold no address
        parts = urlsplit("")
    if (
        parts.scheme not in ("http", "https")
        or not parts.netloc
        or any(c in base_url for c in "\"'<> ")
    ):
        raise InputError(
            f"--base-url {base_url!r}: an address such as https://example.org/course is needed"
        )
    if "?" in base_url or "#" in base_url:
        raise InputError(
            f"--base-url {base_url!r}: the address of a folder has no query (?) and no fragment (#)"
        )
    return f'<link rel="canonical" href="{base_url.rstrip("/")}/{path}">\n'
