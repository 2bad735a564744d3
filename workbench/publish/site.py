"""Writes a static site: a course page and one page per lesson, with replays that play from disk, offline."""

import json
import shutil
from collections.abc import Callable, Iterator, Sequence
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

from workbench.errors import InputError
from workbench.lesson import Lesson
from workbench.publish.pages import course_page, lesson_page
from workbench.publish.runs import digest_of, files_of, render_all, runs_of, write
from workbench.timeline import Timelines
from workbench.typeset import math_font_css

STATIC = Path(__file__).with_name("static")
PAGE_BUDGET, PICTURES_BUDGET, REPLAY_BUDGET = 300_000, 1_000_000, 4_000_000
KEPT = ".published.json"

Progress = Callable[[str, int, int], object]
"""progress(what is done, how much is done, of how much)."""


def publish(
    out: Path, lessons: Sequence[Lesson], *, base_url: str | None = None, progress: Progress | None = None
) -> list[tuple[str, int]]:
    """Write the site and return what was written: (file, bytes), the largest of each kind to be told.

    Args:
        out: The folder; what is in it of an earlier site and still fits is kept.
        lessons: What is published, in order.
        base_url: The address the site will have, for canonical links.
        progress: Told of each run.

    Raises:
        InputError: If a run fails, a file cannot be written, a link leads nowhere, or something is over its size budget.
    """
    try:
        out.mkdir(parents=True, exist_ok=True)
        return _publish(out, lessons, base_url, progress)
    except OSError as error:
        raise InputError(f"{error.filename or out}: {error.strerror or error}") from None


def _publish(
    out: Path, lessons: Sequence[Lesson], base_url: str | None, progress: Progress | None
) -> list[tuple[str, int]]:
    timelines = Timelines()
    before = _read_kept(out)
    work = [(lesson, run) for lesson in lessons for run in runs_of(lesson)]
    digests = {(lesson.name, run.name): digest_of(lesson, run) for lesson, run in work}
    whole = (out / "viser.js").exists()
    fresh = [
        (lesson, run)
        for lesson, run in work
        if whole
        and before.get(f"{lesson.name}/{run.name}") == digests[lesson.name, run.name]
        and all(file.exists() for file in files_of(out, lesson, run))
    ]
    kept = {f"{lesson.name}/{run.name}": digests[lesson.name, run.name] for lesson, run in fresh}
    for lesson, run in render_all(out, [one for one in work if one not in fresh]):
        kept[f"{lesson.name}/{run.name}"] = digests[lesson.name, run.name]
        write(out / KEPT, json.dumps(kept, indent=1))  # who stops here goes on here
        if progress is not None:
            progress(f"{lesson.name}/{run.name}", len(kept), len(work))
    for name in ("site.css", "player.js"):
        write(out / name, (STATIC / name).read_text(encoding="utf-8"))
    write(out / "math.css", math_font_css())
    write(out / ".nojekyll", "")
    for lesson in lessons:
        titles = {run.name: (run.title, run.line) for run in runs_of(lesson)}
        write(
            out / lesson.name / "index.html",
            lesson_page(lesson, titles, timelines, canonical(base_url, f"{lesson.name}/")),
        )
        wanted = {file.name for run in runs_of(lesson) for file in files_of(out, lesson, run)}
        for file in (out / lesson.name / "runs").iterdir():
            if file.name not in wanted:
                file.unlink()
    for name in {key.split("/")[0] for key in before} - {lesson.name for lesson in lessons}:
        shutil.rmtree(out / name, ignore_errors=True)  # a lesson of the site before, no longer published
    write(out / "index.html", course_page(lessons, canonical(base_url, "")))
    write(out / KEPT, json.dumps(kept, indent=1))
    return checked(out)


def canonical(base_url: str | None, path: str) -> str:
    """Return the canonical link of a page, nothing without an address."""
    if base_url is None:
        return ""
    parts = urlsplit(base_url)
    if parts.scheme not in ("http", "https") or not parts.netloc or any(c in base_url for c in "\"'<> "):
        raise InputError(f"--base-url {base_url!r}: an address such as https://example.org/course is needed")
    return f'<link rel="canonical" href="{base_url.rstrip("/")}/{path}">\n'


def checked(out: Path) -> list[tuple[str, int]]:
    """Return all files with their sizes.

    Raises:
        InputError: If a link leads nowhere, or a page or replay is over its budget.
    """
    sizes = [(str(file.relative_to(out)), file.stat().st_size) for file in sorted(out.rglob("*")) if file.is_file()]
    for name, size in sizes:
        if name.endswith(".js") and size > REPLAY_BUDGET:
            raise InputError(_over(name, size, REPLAY_BUDGET))
    for page in sorted(out.rglob("*.html")):
        name, weight, pictures = str(page.relative_to(out)), page.stat().st_size, 0
        for link in links_in(page.read_text(encoding="utf-8")):
            if link.startswith("data:image/"):
                pictures += len(link)
                continue
            parts = urlsplit(link)
            if parts.scheme or parts.netloc or not parts.path:
                continue
            linked = page.parent / unquote(parts.path)
            if not linked.exists():
                raise InputError(f"{name}: the link {link} leads nowhere")
            if linked.suffix in (".css", ".js"):
                weight += linked.stat().st_size
        if pictures > PICTURES_BUDGET:
            raise InputError(_over(f"the pictures of {name}", pictures, PICTURES_BUDGET))
        weight -= pictures
        if weight > PAGE_BUDGET:
            raise InputError(_over(f"{name} with its styles and scripts", weight, PAGE_BUDGET))
    return sizes


def _over(what: str, size: int, budget: int) -> str:
    return f"{what} has {size / 1e6:.2f} MB, over the budget of {budget / 1e6:.2f} MB"


def sizes_told(out: Path, files: Sequence[tuple[str, int]]) -> str:
    """Return a summary of what a site holds, by kind of file, and where to begin."""
    kinds = {"pages": ".html", "replays": ".js", "recordings": ".rrd"}
    lines = []
    for kind, end in kinds.items():
        sizes = [size for name, size in files if name.endswith(end)]
        lines.append(
            f"{len(sizes)} {kind}, {sum(sizes) / 1e6:.1f} MB, the largest {max(sizes, default=0) / 1e6:.2f} MB"
        )
    return "\n".join([*lines, f"begin at {out / 'index.html'}"])


def links_in(page: str) -> Iterator[str]:
    """Return the addresses that a page's links, scripts, styles and pictures name."""
    parser = _Links()
    parser.feed(page)
    yield from parser.found


class _Links(HTMLParser):
    def __init__(self) -> None:
        super().__init__()
        self.found: list[str] = []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.found += [value for name, value in attrs if name in ("href", "src") and value]


def _read_kept(out: Path) -> dict[str, str]:
    try:
        kept = json.loads((out / KEPT).read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return {}
    return {str(key): str(value) for key, value in kept.items()} if isinstance(kept, dict) else {}
