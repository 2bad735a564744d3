"""Writes a static site: a course page and one page per lesson, with replays that play from disk, offline."""

import hashlib
import importlib
import json
import shutil
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from html.parser import HTMLParser
from pathlib import Path
from typing import Any
from urllib.parse import unquote, urlsplit

import workbench
from workbench import knobs
from workbench.errors import InputError
from workbench.lesson import Lesson
from workbench.publish.pages import course_page, embed_page, lesson_page, question_run
from workbench.publish.replay import Renderer, beside, reopening
from workbench.recording import record_bytes
from workbench.timeline import Timeline, Timelines
from workbench.typeset import math_font_css

STATIC = Path(__file__).with_name("static")
PAGE_BUDGET, REPLAY_BUDGET = 300_000, 4_000_000
KEPT = ".published.json"

Progress = Callable[[str, int, int], object]
"""progress(what is done, how much is done, of how much)."""


@dataclass(frozen=True)
class Run:
    """One run of a lesson's page: its name, title, line, params, and where it opens."""

    name: str
    title: str
    line: str
    params: Any
    first: int


def runs_of(lesson: Lesson) -> tuple[Run, ...]:
    """Return the runs of a lesson's page: the default, every preset, and what else its questions need."""
    runs = [Run("default", "The default run", lesson.summary, lesson.params(), lesson.first_step)]
    for preset in lesson.presets:
        runs.append(
            Run(
                preset.name,
                preset.title,
                preset.line,
                preset.params,
                lesson.first_step if preset.step is None else preset.step,
            )
        )
    for question in lesson.questions:
        if question_run(lesson, question) == question.name:
            runs.append(Run(question.name, "The question's run", "What the prediction is about.", question.params, 0))
    return tuple(runs)


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
    kept: dict[str, str] = {}
    work = [(lesson, run) for lesson in lessons for run in runs_of(lesson)]
    renderer: Renderer | None = None
    viser_page: tuple[str, str] | None = None
    try:
        for done, (lesson, run) in enumerate(work, 1):
            key, digest = f"{lesson.name}/{run.name}", digest_of(lesson, run)
            presets = {preset.name for preset in lesson.presets}
            files = [out / lesson.name / "runs" / f"{run.name}{end}" for end in (".js", ".rrd", ".html")]
            if before.get(key) != digest or not all(file.exists() for file in files) or not (out / "viser.js").exists():
                renderer = renderer or Renderer()
                timeline = timelines.get(lesson, run.params).complete()
                if timeline.stopped is not None:
                    raise InputError(f"{lesson.name}, {run.title}: {timeline.stopped}")
                page, data = renderer.scene(timeline)
                head, tail = page.split('window.__VISER_EMBED_DATA__=""')
                viser_page = (head + 'window.__VISER_EMBED_DATA__="', '"' + tail)
                write(files[0], run_script(lesson, run, timeline, data))
                write(files[1], record_bytes(timeline, preset=run.name if run.name in presets else None))
                write(files[2], embed_page(lesson, run.name, run.title))
            kept[key] = digest
            if progress is not None:
                progress(key, done, len(work))
    finally:
        if renderer is not None:
            renderer.close()
    if viser_page is not None:
        write(out / "viser.js", f"viserPage({_script(viser_page[0])}, {_script(viser_page[1])});\n")
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
        wanted = {f"{run.name}{end}" for run in runs_of(lesson) for end in (".js", ".rrd", ".html")}
        for file in (out / lesson.name / "runs").iterdir():
            if file.name not in wanted:
                file.unlink()
    for name in {key.split("/")[0] for key in before} - {lesson.name for lesson in lessons}:
        shutil.rmtree(out / name, ignore_errors=True)  # a lesson of the site before, no longer published
    write(out / "index.html", course_page(lessons, canonical(base_url, "")))
    write(out / KEPT, json.dumps(kept, indent=1))
    return checked(out)


def run_script(lesson: Lesson, run: Run, timeline: Timeline, scene: str) -> str:
    """Return the script file of a run."""
    first = run.first if run.first >= 0 else len(timeline) + run.first
    data = beside(timeline) | {"scene": scene, "first": first, "reopen": reopening(lesson, run.params)}
    return f"replay({_script(run.name)}, {_script(data)});\n"


def digest_of(lesson: Lesson, run: Run) -> str:
    """Return what a published run must agree with: its params, our version, and all source it may depend on."""
    said = f"{lesson.name}\0{run}\0{knobs.to_json(run.params)}\0{workbench.__version__}\0{_source()}"
    return hashlib.sha256(said.encode()).hexdigest()


def _source() -> str:
    """Return a digest of the code that runs, draws and renders: the workbench and the lessons."""
    found = hashlib.sha256()
    lessons = Path(importlib.import_module("lessons").__file__ or ".").parent
    for root in (Path(workbench.__file__).parent, lessons):
        for file in sorted(root.rglob("*.py")):
            found.update(file.read_bytes())
    return found.hexdigest()


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
        budget = PAGE_BUDGET if name.endswith(".html") else REPLAY_BUDGET if name.endswith(".js") else None
        if budget is not None and size > budget:
            raise InputError(f"{name} has {size / 1e6:.2f} MB, over the budget of {budget / 1e6:.2f} MB")
    for page in sorted(out.rglob("*.html")):
        for link in links_in(page.read_text(encoding="utf-8")):
            parts = urlsplit(link)
            if parts.scheme or parts.netloc or not parts.path:
                continue
            if not (page.parent / unquote(parts.path)).exists():
                raise InputError(f"{page.relative_to(out)}: the link {link} leads nowhere")
    return sizes


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


def write(path: Path, content: str | bytes) -> None:
    """Write a file whole or not at all; leave it alone where it has this content already."""
    data = content.encode("utf-8") if isinstance(content, str) else content
    if path.exists() and path.read_bytes() == data:
        return
    path.parent.mkdir(parents=True, exist_ok=True)
    partial = path.with_name(path.name + ".partial")
    partial.write_bytes(data)
    partial.replace(path)


def _read_kept(out: Path) -> dict[str, str]:
    try:
        kept = json.loads((out / KEPT).read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return {}
    return {str(key): str(value) for key, value in kept.items()} if isinstance(kept, dict) else {}


def _script(value: Any) -> str:
    """Return JSON that may stand in a script."""
    text = json.dumps(value, ensure_ascii=False, separators=(",", ":"))
    return text.replace("<", "\\u003c").replace("\u2028", "\\u2028").replace("\u2029", "\\u2029")
