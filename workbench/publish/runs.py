"""The runs of a published lesson: which there are, and their files, rendered on all cores."""

import functools
import hashlib
import importlib
import json
import multiprocessing
import os
import sys
from collections.abc import Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor, as_completed
from concurrent.futures.process import BrokenProcessPool
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import workbench
from workbench import knobs
from workbench.errors import InputError
from workbench.flags import show_command
from workbench.lesson import Lesson, catalog
from workbench.publish.pages import embed_page, question_run
from workbench.publish.replay import Renderer, beside
from workbench.recording import record_bytes
from workbench.timeline import Timeline

ENDS = (".js", ".rrd", ".html")
ALONE = 6
"""So many runs are rendered sooner by this process alone than by others that have to start."""


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
            runs.append(Run(question.name, "The question's run", question.text, question.params, 0))
    return tuple(runs)


def render_all(out: Path, runs: Sequence[tuple[Lesson, Run]]) -> Iterator[tuple[Lesson, Run]]:
    """Write the files of runs and return each when it is done, in any order.

    Lessons of the catalogue are rendered by one process per core, others, whose code only this process has, here.

    Raises:
        InputError: If a run fails.
    """
    cores = os.cpu_count() or 1
    if len(runs) <= ALONE or cores == 1 or any(catalog().get(lesson.name) is not lesson for lesson, _ in runs):
        with Renderer() as renderer:
            for lesson, run in runs:
                render(out, lesson, run, renderer)
                yield lesson, run
        return
    context = multiprocessing.get_context("spawn")
    with ProcessPoolExecutor(min(cores, len(runs)), context, _be_quiet) as pool:
        waiting = {pool.submit(_render_named, out, lesson.name, run.name): (lesson, run) for lesson, run in runs}
        try:
            for future in as_completed(waiting):
                future.result()
                yield waiting[future]
        except BrokenProcessPool:
            raise InputError("a process that renders runs was ended from outside; publishing again goes on") from None
        finally:
            pool.shutdown(wait=False, cancel_futures=True)


def _be_quiet() -> None:
    sys.stdout = open(os.devnull, "w")  # noqa: SIM115 - viser prints when a process ends


def _render_named(out: Path, lesson_name: str, run_name: str) -> None:
    lesson = catalog()[lesson_name]
    render(out, lesson, next(run for run in runs_of(lesson) if run.name == run_name), _own_renderer())


@functools.cache
def _own_renderer() -> Renderer:
    return Renderer()  # as long as the process lives


def render(out: Path, lesson: Lesson, run: Run, renderer: Renderer) -> None:
    """Write a run's replay, recording and page of its own, and viser's page beside them all."""
    timeline = Timeline(lesson, run.params).complete()
    if timeline.stopped is not None:
        raise InputError(f"{lesson.name}, {run.title}: {timeline.stopped}")
    page, data = renderer.scene(timeline)
    head, tail = page.split('window.__VISER_EMBED_DATA__=""')
    viser_page = f"viserPage({_script(head + 'window.__VISER_EMBED_DATA__=' + chr(34))}, {_script(chr(34) + tail)});\n"
    write(out / "viser.js", viser_page)
    preset = run.name if any(preset.name == run.name for preset in lesson.presets) else None
    script, recording, alone = files_of(out, lesson, run)
    write(script, run_script(lesson, run, timeline, data))
    write(recording, record_bytes(timeline, preset=preset))
    write(alone, embed_page(lesson, run.name, run.title))


def files_of(out: Path, lesson: Lesson, run: Run) -> list[Path]:
    """Return where a run's replay, recording and page are."""
    return [out / lesson.name / "runs" / f"{run.name}{end}" for end in ENDS]


def run_script(lesson: Lesson, run: Run, timeline: Timeline, scene: str) -> str:
    """Return the script file of a run."""
    first = timeline.opening(f"lesson {lesson.name}, run {run.name!r}", run.first)
    data = beside(timeline) | {"scene": scene, "first": first, "reopen": show_command(lesson, run.params)}
    return f"replay({_script(run.name)}, {_script(data)});\n"


def digest_of(lesson: Lesson, run: Run) -> str:
    """Return what a published run must agree with: its params, our version, and all source it may depend on."""
    said = f"{lesson.name}\0{run}\0{knobs.to_json(run.params)}\0{workbench.__version__}\0{_source()}"
    return hashlib.sha256(said.encode()).hexdigest()


@functools.cache
def _source() -> str:
    """Return a digest of the code that runs, draws and renders: the workbench and the lessons."""
    found = hashlib.sha256()
    lessons = Path(importlib.import_module("lessons").__file__ or ".").parent
    for root in (Path(workbench.__file__).parent, lessons):
        for file in sorted(root.rglob("*.py")):
            found.update(file.read_bytes())
    return found.hexdigest()


def write(path: Path, content: str | bytes) -> None:
    """Write a file whole or not at all; leave it alone where it has this content already."""
    data = content.encode("utf-8") if isinstance(content, str) else content
    if path.exists() and path.read_bytes() == data:
        return
    path.parent.mkdir(parents=True, exist_ok=True)
    partial = path.with_name(f"{path.name}.{os.getpid()}.partial")
    partial.write_bytes(data)
    partial.replace(path)


def _script(value: Any) -> str:
    """Return JSON that may stand in a script."""
    text = json.dumps(value, ensure_ascii=False, separators=(",", ":"))
    return text.replace("<", "\\u003c").replace("\u2028", "\\u2028").replace("\u2029", "\\u2029")
