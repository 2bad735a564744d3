"""The runs of a published lesson: which there are, and their files, rendered on all cores."""

import hashlib
import os
import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Literal, TypeAlias

from workbench import knobs
from workbench.errors import InputError
from workbench.lesson import Lesson, Question, Sweep, catalog, is_of_course
from workbench.machinery.workers import WorkerLostError, parallel_map
from workbench.moved import runs_led_on
from workbench.page.about import short_notice
from workbench.page.article import LINK
from workbench.page.bundles import STATIC
from workbench.page.document import in_script, lesson_document
from workbench.page.steps import Steps
from workbench.picture.stills import Still, still_svg, stills_of
from workbench.recording import file_name, record_bytes
from workbench.run.links import show_command
from workbench.run.timeline import Timeline
from workbench.story import story_of
from workbench.story.names import run_name
from workbench.wire.client import client_html
from workbench.wire.packing import run_text

Recordings: TypeAlias = Literal["all", "linked", "none"]
"""Which runs of a site have a recording."""
CLIENT = "viser.js"
"""The file of a site with viser's client, which draws the scenes of all runs."""
PAGE = "page"
"""The folder of a site with the page's own styles and scripts."""
ALONE = 6
"""So many runs are rendered sooner by this process alone than by others that have to start."""


@dataclass(frozen=True)
class Run:
    """One run of a lesson's page.

    Attributes:
        name: Its name in addresses, such as `far` or `start_angle:30`.
        title, line: What a person reads of it.
        params: With these.
        first: The step where it opens.
        recorded: Whether its recording is part of the site: those of sweeps are not.
    """

    name: str
    title: str
    line: str
    params: Any
    first: int
    recorded: bool = True

    @property
    def file(self) -> str:
        """The name of its files; that of a sweep's value has a dot, which no preset's name has."""
        return ".".join(re.sub(r"[^A-Za-z0-9_-]", "_", part) for part in self.name.split(":"))


def runs_of(lesson: Lesson, recordings: Recordings = "linked") -> tuple[Run, ...]:
    """Return the runs of a lesson's page: the default, every preset, what its questions need, and
    its sweeps.

    What has equal params is one run. Those of `recordings` have one: all but the sweeps', the
    default and those that the page's text names, or none.
    """
    named = _named_in_text(lesson) if recordings == "linked" else set()
    return tuple(
        replace(run, recorded=run.recorded and (recordings == "all" or run.name in named))
        for run in _all_runs(lesson)
    )


def _named_in_text(lesson: Lesson) -> set[str]:
    """Return the names of the runs that a page's text leads to."""
    story = story_of(lesson, "site")
    told = (
        set()
        if story is None
        else {place.run for scene in story.scenes for place, _ in scene.told.places}
    )
    return {"default", *(match[1] for match in LINK.finditer(lesson.text())), *told}


def _all_runs(lesson: Lesson) -> tuple[Run, ...]:
    runs = [Run("default", "The default run", lesson.summary, lesson.params(), lesson.opens)]
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
    for name, title, params in (value for sweep in lesson.sweeps for value in swept(lesson, sweep)):
        if all(run.params != params for run in runs):
            runs.append(Run(name, title, "", params, lesson.first_step, recorded=False))
    return tuple(runs)


def question_run(lesson: Lesson, question: Question) -> str:
    """Return the name of the run that answers a question: of the default, a preset or an earlier
    question if the same.
    """
    if question.params == lesson.params():
        return "default"
    preset = lesson.preset_of(question.params)
    if preset is not None:
        return preset.name
    return next(other.name for other in lesson.questions if other.params == question.params)


def swept(lesson: Lesson, sweep: Sweep) -> list[tuple[str, str, Any]]:
    """Return name, title and params of the run at each value of a sweep."""
    field = _field(lesson, sweep)
    values = [
        (knobs.text_of(getattr(params, sweep.knob)), params) for params in lesson.swept(sweep)
    ]
    return [
        (_name_at(sweep, value), f"{field.label} {value} {field.knob.unit}".rstrip(), params)
        for value, params in values
    ]


def _field(lesson: Lesson, sweep: Sweep) -> knobs.ParamField:
    return next(field for field in knobs.fields_of(lesson.params) if field.name == sweep.knob)


def _name_at(sweep: Sweep, value: str) -> str:
    """Return the name of a sweep's run at a value: `start_angle:30`, or `flat/start_angle:30` of
    another run.
    """
    return (
        f"{sweep.knob}:{value}" if sweep.run == "default" else f"{sweep.run}/{sweep.knob}:{value}"
    )


def sweep_data(lesson: Lesson) -> list[dict[str, Any]]:
    """Return the sweeps of a lesson as knobs of a page that cannot compute: what is shown, and the
    run at each value.

    The sweep's own run is always on the dial, at its own value. `places` tells for every run of the
    page where the dial stands and what it says: at the nearest value, where the run's own is not on
    it.
    """
    runs = runs_of(lesson, "none")
    return [_dial(lesson, sweep, runs) for sweep in lesson.sweeps]


def _dial(lesson: Lesson, sweep: Sweep, runs: Sequence[Run]) -> dict[str, Any]:
    field = _field(lesson, sweep)
    own = lesson.run_params(sweep.run)
    stops = {getattr(params, sweep.knob): params for params in (*lesson.swept(sweep), own)}
    values = list(stops)
    if all(isinstance(value, int | float) for value in values) and values[:-1] == sorted(
        values[:-1]
    ):
        values.sort()
    texts = [knobs.text_of(value) for value in values]
    return {
        "knob": sweep.knob,
        "run": run_name(lesson, own),
        "label": field.label,
        "unit": field.knob.unit,
        "hint": field.knob.hint,
        "names": [_name_at(sweep, text) for text in texts],
        "values": texts,
        "runs": [next(run.name for run in runs if run.params == stops[value]) for value in values],
        "places": {run.name: _place(getattr(run.params, sweep.knob), values) for run in runs},
    }


def _place(value: Any, values: Sequence[Any]) -> tuple[int, str]:
    """Return where a value stands among others, or the nearest to it where they are numbers, and
    what it is in words.
    """
    if value in values or not isinstance(value, int | float):
        return values.index(value) if value in values else 0, knobs.text_of(value)
    return min(range(len(values)), key=lambda i: abs(values[i] - value)), knobs.text_of(value)


def files_of(lesson: Lesson, run: Run) -> tuple[str, ...]:
    """Return where in a site a run's replay, page of its own, recording and stills are."""
    beside = f"{lesson.name}/runs/{run.file}"
    recording = recording_of(lesson, run)
    return (
        f"{beside}.js",
        f"{beside}.html",
        *([f"{lesson.name}/runs/{recording}"] if recording else []),
        *(f"{lesson.name}/{still.file}" for still in stills_in(lesson, run)),
    )


def stills_in(lesson: Lesson, run: Run) -> list[Still]:
    """Return the pictures of a lesson's page that show a run."""
    return [still for still in stills_of(lesson) if still.place.run == run.name]


def swept_files(lessons: Iterable[Lesson]) -> set[str]:
    """Return the run files that a site has for sweeps alone."""
    return {
        files_of(lesson, run)[0]
        for lesson in lessons
        for run in runs_of(lesson, "all")
        if not run.recorded
    }


def recording_of(lesson: Lesson, run: Run) -> str | None:
    """Return the name of a run's recording, which tells what it is where it is downloaded to; None
    where there is none.
    """
    if not run.recorded:
        return None
    return file_name(lesson, None if run.name == "default" else run.name)


def render_all(
    runs: Sequence[tuple[Lesson, Run]],
) -> Iterator[tuple[Lesson, Run, dict[str, bytes]]]:
    """Return each run with its files when they are done, in any order.

    Lessons of the catalogue are rendered by one process per core, others, whose code only this
    process has, here.

    Raises:
        InputError: If a run fails.
    """
    cores = os.cpu_count() or 1
    if (
        len(runs) <= ALONE
        or cores == 1
        or any(catalog().get(lesson.name) is not lesson for lesson, _ in runs)
    ):
        for lesson, run in runs:
            yield lesson, run, render(lesson, run)
        return
    waiting = {(lesson.name, run.name, run.recorded): (lesson, run) for lesson, run in runs}
    try:
        for names, files in parallel_map(_render_named, list(waiting), cores):
            yield *waiting[names], files
    except WorkerLostError:
        raise InputError(
            "a process that renders runs was ended from outside; publishing again goes on"
        ) from None


def _render_named(named: tuple[str, str, bool]) -> dict[str, bytes]:
    lesson_name, name, is_recorded = named
    lesson = catalog()[lesson_name]
    run = next(run for run in _all_runs(lesson) if run.name == name)
    return render(lesson, replace(run, recorded=is_recorded))


def render(lesson: Lesson, run: Run) -> dict[str, bytes]:
    """Return a run's replay, recording and page of its own, by name in the site."""
    timeline = Timeline(lesson, run.params).complete()
    if timeline.stopped is not None:
        raise InputError(f"{lesson.name}, {run.title}: {timeline.stopped}")
    preset = run.name if any(preset.name == run.name for preset in lesson.presets) else None
    script_file, alone, *others = files_of(lesson, run)
    data = run_data(lesson, run, timeline)
    stills = {
        f"{lesson.name}/{still.file}": still_svg(lesson, still, timeline, run=data)
        for still in stills_in(lesson, run)
    }
    return {
        script_file: script_of(run, data).encode(),
        alone: run_page(lesson, run).encode(),
        **stills,
        **{name: record_bytes(timeline, preset=preset) for name in others if name not in stills},
    }


def client_script() -> str:
    """Return the script with viser's client."""
    return f"viserClient({in_script(client_html())});\n"


def run_script(lesson: Lesson, run: Run, timeline: Timeline) -> str:
    """Return the script file of a run."""
    return script_of(run, run_data(lesson, run, timeline))


def script_of(run: Run, data: Mapping[str, Any]) -> str:
    """Return the script file of a run whose data are there."""
    return f"replay({in_script(run.name)}, {in_script(data)});\n"


def run_data(lesson: Lesson, run: Run, timeline: Timeline) -> dict[str, Any]:
    """Return all that a page shows of a run, as plain data."""
    steps = Steps(timeline)
    data = steps.whole()
    for k, step in enumerate(data["steps"]):
        code = steps.code(k)
        data["steps"][k] = step | ({"code": code} if code else {})
    return data | {
        "scene": run_text(timeline),
        "first": timeline.opening(f"lesson {lesson.name}, run {run.name!r}", run.first),
        "command": show_command(lesson, run.params),
        "recording": recording_of(lesson, run),
    }


def recorded(
    lesson: Lesson, opened: Run, *, root: str, runs: str, answers: Mapping[str, str]
) -> dict[str, Any]:
    """Return what a page must know of the runs that it can open.

    Args:
        lesson: Whose runs.
        opened: The one it opens at first.
        root: The address of the site's folder.
        runs: That of the folder with the runs.
        answers: What is told when a question is answered, by its name.
    """
    sweeps = sweep_data(lesson)
    return {
        "root": root,
        "runs": runs,
        "open": opened.name,
        "files": {run.name: run.file for run in runs_of(lesson)},
        "titles": {run.name: run.title for run in runs_of(lesson)},
        "aliases": {
            name: run
            for sweep in sweeps
            for name, run in zip(sweep["names"], sweep["runs"], strict=True)
        },
        "sweeps": sweeps,
        "moved": {
            old: f"{root}{to}/index.html#run={run}"
            for old, (to, run) in runs_led_on(lesson.name).items()
        },
        "note": (
            f"These runs are recorded. All knobs, live: {show_command(lesson, lesson.params())}"
        ),
        "answers": dict(answers),
    }


def run_page(lesson: Lesson, run: Run) -> str:
    """Return the page of one run alone, for an iframe on a slide or a learning platform."""
    known = recorded(lesson, run, root="../../", runs="", answers={})
    return lesson_document(
        lesson,
        "",
        home="site",
        root=f"../../{PAGE}/",
        more={"RECORDED": known},
        alone=(run.title, f"../index.html#run={run.name}"),
        still="../picture.webp",
        footer=short_notice("../../") if is_of_course(lesson) else "",
    )


def digest_of(lesson: Lesson, run: Run, sources: str) -> str:
    """Return what a published run must agree with: itself, its params, and all source and data that
    it depends on, by their digest.
    """
    view = lesson.view_of(run.params)
    params = knobs.to_json(run.params)
    text = "\0".join([lesson.name, lesson.title, str(view), str(run), params, sources])
    return hashlib.sha256(text.encode()).hexdigest()


def page_digest(lesson: Lesson, address: str, sources: str) -> str:
    """Return what a lesson's page and picture must agree with: itself, and all source and data that
    it depends on, by their digest.
    """
    questions = [
        (
            question.name,
            question.text,
            question.choices,
            question.unit,
            question.tolerance,
            question.step,
            question.wrong,
            knobs.to_json(question.params),
        )
        for question in lesson.questions
    ]
    text = f"{lesson.title}\0{lesson.summary}\0{runs_of(lesson)}\0{lesson.sweeps}\0{questions}\0{address}\0"  # noqa: E501
    digest = hashlib.sha256(f"{text}{sources}".encode())
    for file in sorted(
        (*STATIC.iterdir(), *STATIC.parent.glob("*.py"), *Path(__file__).parent.glob("*.py"))
    ):
        digest.update(f"\0{file.name}\0".encode() + file.read_bytes())
    return digest.hexdigest()
