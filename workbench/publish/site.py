"""Writes a static site: a course page and one page per lesson, with replays that play from disk,
offline.
"""

from collections.abc import Collection, Mapping, Sequence
from pathlib import Path
from typing import Any

from workbench.chapters import place
from workbench.errors import InputError
from workbench.lesson import Lesson
from workbench.machinery.progress import Progress
from workbench.machinery.version import __version__
from workbench.moved import lessons_led_on, runs_led_on
from workbench.page.about import MISSING_PAGE, NOTICES_PAGE, missing_document, notices_document
from workbench.page.bundles import (
    FONTS,
    ICON,
    MATH_FONT,
    SITE_FILES,
    STATIC,
    THIRD_PARTIES,
    UNSCRIPTED,
    bare,
    bundle,
)
from workbench.page.course import FRONT_PICTURES, WELCOME
from workbench.page.document import COURSE, in_script
from workbench.page.thumbnail import card, course_card, thumbnail
from workbench.publish.address import SITEMAP, base_of, folder_of, sitemap, social_head
from workbench.publish.computing import computing
from workbench.publish.lock import only_writer
from workbench.publish.manifest import NAME, Listed, Manifest
from workbench.publish.pages import (
    LESSONS,
    accessibility_html,
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
from workbench.publish.sources import sources_digest
from workbench.recording import equal_content
from workbench.run.timeline import Timelines
from workbench.wire.client import viser_version
from workbench.words.typeset import math_font

PICTURE = "picture.webp"
CARD_PICTURE = "card.png"
"""What other sites show of a page, where the address of ours is known."""


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
        base_url: The address the site will have, for its absolute links, the pictures that other
            sites show of it, and its map; without it there are none.
        force: Replace files of others that are in the way.
        remove_others: These are all lessons of the site: others that we published before go.
        recordings: Which runs can be downloaded as recordings: all but those of sweeps, the default
            and those that the page's text names, or none.
        python: A folder with the files of a Pyodide release, or its address: then the pages can
            compute.
        progress: Told of each run.

    Raises:
        InputError: If the address is none, Python's place cannot be used or somebody else's file is
            in the way (then nothing has changed), another publish is writing here, a run fails, a
            file cannot be written, a link leads nowhere, or something is over its size budget.
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
    base = base_of(base_url)
    try:
        out.mkdir(parents=True, exist_ok=True)
        with only_writer(out):
            return _publish(
                out,
                lessons,
                base,
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
    base: str | None,
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
        else {name: other for name, other in manifest.lessons.items() if name not in names}
    )
    made_by = f"workbench {__version__}, viser {viser_version()}"
    if others and manifest.made_by != made_by:
        raise InputError(
            f"{out}: its other lessons were published by another version; publish all of them again"
        )
    work = [(lesson, run) for lesson in lessons for run in runs_of(lesson, recordings)]
    computes = None if python is None else computing(python, lessons, others)
    shared = {f"{PAGE}/{name}": bundle(name).encode() for name in SITE_FILES}
    shared |= {
        f"{PAGE}/{name}": (STATIC / name).read_bytes()
        for name in (*FONTS, ICON, *FRONT_PICTURES, THIRD_PARTIES)
    }
    shared |= {
        f"{PAGE}/{UNSCRIPTED}": bare(STATIC / UNSCRIPTED).encode(),
        f"{PAGE}/{MATH_FONT}": math_font(),
        ".nojekyll": b"",
        CLIENT: client_script().encode(),
        NOTICES_PAGE: notices_document(f"{PAGE}/", accessibility_html()).encode(),
    }
    shared |= {} if computes is None else computes.files
    own = (COURSE_PAGE, PICTURE, *([] if base is None else [CARD_PICTURE]))
    wanted = {COURSE_PAGE, LESSONS, MISSING_PAGE, *shared}
    wanted |= set() if base is None else {SITEMAP, CARD_PICTURE}
    wanted |= {f"{name}/{file}" for name in names for file in own}
    wanted |= {name for lesson, run in work for name in files_of(lesson, run)}
    leading = _leading_on(lessons, {*names, *others})
    wanted |= set(leading)
    if others and any(name.startswith(f"{PAGE}/") for name in manifest.files.keys() - wanted):
        raise InputError(
            f"{out}: its other lessons' pages need files that would go; publish all of them again"
        )
    manifest.check(wanted, force=force)

    manifest.made_by = made_by
    sources = {lesson.name: sources_digest(lesson) for lesson in lessons}
    _render(manifest, work, progress, sources=sources)
    manifest.write({**shared, **leading})
    timelines = Timelines()
    for lesson in lessons:
        data = None if computes is None else computes.page_data(lesson)
        _write_page(
            manifest, lesson, timelines, base=base, computes=data, sources=sources[lesson.name]
        )
    listed = others | {
        lesson.name: Listed(
            lesson.title, lesson.summary, lesson.order, lesson.needs, lesson.chapter, lesson.minutes
        )
        for lesson in lessons
    }
    manifest.lessons = dict(
        sorted(listed.items(), key=lambda item: place(item[1].chapter, item[1].order, item[0]))
    )
    manifest.write(_about_all(manifest, base))
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


def _leading_on(lessons: Sequence[Lesson], names: Collection[str]) -> dict[str, bytes]:
    """Return the pages of runs that are in another lesson of the site now, at their addresses of
    before.

    A lesson that is in others altogether has a page of its own, which leads on as well.
    """
    titles = {lesson.name: lesson.title for lesson in lessons}
    gone = {name: to for name, to in lessons_led_on().items() if to in titles and name not in names}
    known = {lesson.name: {run.name for run in runs_of(lesson)} for lesson in lessons}

    def page_of(to: str, run: str) -> str:
        kept = run in known.get(to, {run})  # a lesson may be published without some of its runs
        return f"runs/{run}.html" if kept else COURSE_PAGE

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
        if to in names
    }


def _render(
    manifest: Manifest,
    work: Sequence[tuple[Lesson, Run]],
    progress: Progress | None,
    *,
    sources: Mapping[str, str],
) -> None:
    """Write the files of those runs that are not there as they should be; `sources` are digests,
    by lesson.
    """
    digests = {
        (lesson.name, run.name): digest_of(lesson, run, sources[lesson.name])
        for lesson, run in work
    }
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


def _about_all(manifest: Manifest, base: str | None) -> dict[str, bytes]:
    """Return the files that tell of all lessons of a site, once these have their pictures."""
    lessons = manifest.lessons
    titles = {name: lesson.title for name, lesson in lessons.items()}
    head = social_head(base, "", title=COURSE, summary=WELCOME, picture=CARD_PICTURE)
    texts = {
        COURSE_PAGE: course_page(lessons, head),
        LESSONS: lessons_script(lessons),
        MISSING_PAGE: missing_document(f"{PAGE}/", titles, folder_of(base)),
    }
    files = {name: text.encode() for name, text in texts.items()}
    if base is None:
        return files
    pictures = [f"{name}/{PICTURE}" for name in lessons]
    card = course_card(manifest.read(name) for name in pictures if manifest.is_ours(name))
    return files | {SITEMAP: sitemap(base, lessons).encode(), CARD_PICTURE: card}


def _write_page(
    manifest: Manifest,
    lesson: Lesson,
    timelines: Timelines,
    *,
    base: str | None,
    computes: Mapping[str, Any] | None,
    sources: str,
) -> None:
    """Write a lesson's page if it is not there as it should be: its questions need runs."""
    key = f"{lesson.name}/"
    pictures = {PICTURE: thumbnail} | ({} if base is None else {CARD_PICTURE: card})
    head = social_head(
        base, key, title=lesson.title, summary=lesson.summary, picture=f"{key}{CARD_PICTURE}"
    )
    digest = page_digest(lesson, head + ("" if computes is None else in_script(computes)), sources)
    written = all(manifest.is_ours(f"{key}{name}") for name in (COURSE_PAGE, *pictures))
    if manifest.runs.get(key) == digest and written:
        return
    known = recorded(
        lesson, runs_of(lesson)[0], root="../", runs="runs/", answers=answers(lesson, timelines)
    )
    files = {f"{key}{name}": draw(lesson, timelines) for name, draw in pictures.items()}
    files[f"{key}{COURSE_PAGE}"] = lesson_page(lesson, known, head, computes=computes).encode()
    manifest.runs.pop(key, None)
    manifest.write(files)
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
