"""The runs of a published lesson: which there are, and their files, rendered on all cores."""

import functools
import hashlib
import os
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

from workbench import knobs
from workbench.errors import InputError
from workbench.flags import show_command
from workbench.lesson import Lesson, catalog
from workbench.page.document import in_script
from workbench.page.steps import Steps
from workbench.publish.pages import embed_page, question_run
from workbench.publish.replay import Renderer
from workbench.publish.sources import sources_digest
from workbench.publish.workers import WorkerLostError, shared_out
from workbench.recording import file_name, record_bytes
from workbench.timeline import Timeline

VISER_PAGE = "viser.js"
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


def files_of(lesson: Lesson, run: Run) -> tuple[str, str, str]:
    """Return where in a site a run's replay, page of its own and recording are."""
    beside = f"{lesson.name}/runs/{run.name}"
    return f"{beside}.js", f"{beside}.html", f"{lesson.name}/runs/{recording_of(lesson, run)}"


def recording_of(lesson: Lesson, run: Run) -> str:
    """Return the name of a run's recording: it tells what it is where it is downloaded to."""
    return file_name(lesson, None if run.name == "default" else run.name)


def render_all(runs: Sequence[tuple[Lesson, Run]]) -> Iterator[tuple[Lesson, Run, dict[str, bytes]]]:
    """Return each run with its files when they are done, in any order; with the first of them viser's page.

    Lessons of the catalogue are rendered by one process per core, others, whose code only this process has, here.

    Raises:
        InputError: If a run fails.
    """
    cores = os.cpu_count() or 1
    if len(runs) <= ALONE or cores == 1 or any(catalog().get(lesson.name) is not lesson for lesson, _ in runs):
        with Renderer() as renderer:
            for lesson, run in runs:
                yield lesson, run, render(lesson, run, renderer)
        return
    waiting = {(lesson.name, run.name): (lesson, run) for lesson, run in runs}
    try:
        for names, files in shared_out(_render_named, list(waiting), cores):
            yield *waiting[names], files
    except WorkerLostError:
        raise InputError("a process that renders runs was ended from outside; publishing again goes on") from None


def _render_named(names: tuple[str, str]) -> dict[str, bytes]:
    lesson_name, run_name = names
    lesson = catalog()[lesson_name]
    return render(lesson, next(run for run in runs_of(lesson) if run.name == run_name), _own_renderer())


@functools.cache
def _own_renderer() -> Renderer:
    return Renderer()  # as long as the process lives


def render(lesson: Lesson, run: Run, renderer: Renderer) -> dict[str, bytes]:
    """Return a run's replay, recording and page of its own, and viser's page beside them all, by name in the site."""
    timeline = Timeline(lesson, run.params).complete()
    if timeline.stopped is not None:
        raise InputError(f"{lesson.name}, {run.title}: {timeline.stopped}")
    page, data = renderer.scene(timeline)
    head, tail = page.split('window.__VISER_EMBED_DATA__=""')
    viser_page = (
        f"viserPage({in_script(head + 'window.__VISER_EMBED_DATA__=' + chr(34))}, {in_script(chr(34) + tail)});\n"
    )
    preset = run.name if any(preset.name == run.name for preset in lesson.presets) else None
    script_file, alone, recording = files_of(lesson, run)
    return {
        VISER_PAGE: viser_page.encode(),
        script_file: run_script(lesson, run, timeline, data).encode(),
        alone: embed_page(lesson, run.name, run.title, recording_of(lesson, run)).encode(),
        recording: record_bytes(timeline, preset=preset),
    }


def run_script(lesson: Lesson, run: Run, timeline: Timeline, scene: str) -> str:
    """Return the script file of a run."""
    first = timeline.opening(f"lesson {lesson.name}, run {run.name!r}", run.first)
    data = Steps(timeline).whole() | {
        "scene": scene,
        "first": first,
        "reopen": show_command(lesson, run.params),
        "recording": recording_of(lesson, run),
    }
    return f"replay({in_script(run.name)}, {in_script(data)});\n"


def digest_of(lesson: Lesson, run: Run) -> str:
    """Return what a published run must agree with: itself, its params, and all source and data that it depends on."""
    said = f"{lesson.name}\0{lesson.title}\0{lesson.view}\0{run}\0{knobs.to_json(run.params)}\0{sources_digest(lesson)}"
    return hashlib.sha256(said.encode()).hexdigest()


def page_digest(lesson: Lesson, address: str) -> str:
    """Return what a lesson's page must agree with."""
    questions = [
        (one.name, one.text, one.choices, one.unit, one.tolerance, one.step, knobs.to_json(one.params))
        for one in lesson.questions
    ]
    said = f"{lesson.title}\0{lesson.summary}\0{runs_of(lesson)}\0{questions}\0{address}\0{sources_digest(lesson)}"
    return hashlib.sha256(said.encode()).hexdigest()
