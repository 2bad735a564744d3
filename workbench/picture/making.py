"""Makes files of pictures: of a step, of a stretch of a run, of the scenes of a story."""

import io
import re
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path
from typing import Any

from workbench.errors import InputError
from workbench.lesson import Lesson
from workbench.machinery.atomic import check_place, write_places
from workbench.machinery.progress import Progress
from workbench.page.chart_svg import telling_chart
from workbench.page.steps import Steps
from workbench.page.thumbnail import telling_step
from workbench.picture.asking import (
    Asked,
    check_memory,
    check_slides,
    index_of,
    is_film,
    seconds_of,
)
from workbench.picture.film import Frame, Shown, beside, between, film_bytes, frames_of, subtitles
from workbench.picture.sheet import (
    Moment,
    Style,
    caption_lines,
    height_of,
    image_of,
    png_of,
    svg_of,
)
from workbench.picture.stills import moment_of, stills_of
from workbench.rendering.framing import framed
from workbench.rendering.shapes import shapes_of
from workbench.run.timeline import Timeline, stop_of
from workbench.story import has_story
from workbench.story.names import Names


@dataclass(frozen=True, eq=False)
class WholeRun:
    """A run to its end, with its plain data."""

    timeline: Timeline

    @classmethod
    def of(cls, lesson: Lesson, params: Any, progress: Progress) -> "WholeRun":
        """Return a run, computed now.

        Raises:
            InputError: If it failed; one that was cut after a good step is taken as it is.
        """
        timeline = Timeline(lesson, params).complete(lambda n: progress("computed", n, None))
        if not len(timeline) or timeline.failure is not None:
            raise InputError(f"{timeline.stopped}; nothing was written")
        return cls(timeline)

    @cached_property
    def data(self) -> dict[str, Any]:
        """The run as plain data, without its pictures beside the scene."""
        return Steps(self.timeline, address=lambda _: "").whole()

    def moment(self, k: int, style: Style) -> Moment:
        """Return what a picture of a step shows."""
        timeline = self.timeline
        step = timeline[k]
        lesson = timeline.lesson
        view = lesson.view_of(timeline.params)
        chart = telling_chart(self.data, k, lesson.telling) if style.chart else ""
        return Moment(
            scene=step.scene,
            view=view,
            lens=framed([shapes_of(step.scene)], view, style.scene_size),
            caption=step.caption.text,
            tone=step.caption.tone,
            run=self.data if chart else {},
            step=k,
            charts=(chart,) if chart else (),
        )


def picture_file(
    run: WholeRun, out: Path, asked: Asked, *, preset: str | None = None
) -> list[Path]:
    """Write a picture of a step, and return its file; `preset` names what the run started from."""
    k = _step(run.timeline, asked, preset)
    style = _style(asked)
    moment = run.moment(k, style)
    kind = out.suffix.lower()
    if kind == ".webp":
        file = io.BytesIO()
        image_of(moment, style).save(file, "WEBP", quality=90, method=4)
        data = file.getvalue()
    else:
        data = svg_of(moment, style) if kind == ".svg" else png_of(moment, style)
    write_places({out: data})
    return [out]


def film_file(run: WholeRun, out: Path, asked: Asked, *, progress: Progress) -> list[Path]:
    """Write a film of a stretch of a run, and return its files: subtitles stand beside it where
    they are asked for.
    """
    timeline = run.timeline
    first = 0 if asked.first is None else index_of(timeline, asked.first, "--from")
    last = stop_of(timeline) if asked.last is None else index_of(timeline, asked.last, "--to")
    seconds = seconds_of(asked, abs(last - first) + 1)
    frames = frames_of(first, last, seconds)
    style = _style(asked)
    check_memory(out, len(frames), style)
    data = film_bytes(_shown(run, frames, style, progress=progress), out.suffix.lower())
    files = {out: data}
    if asked.captions == "beside":
        captions = [step.caption.text for step in timeline.known()]
        files[beside(out)] = subtitles(frames, captions).encode()
    write_places(files)
    return list(files)


def _shown(
    run: WholeRun, frames: list[Frame], style: Style, *, progress: Progress
) -> Iterator[Shown]:
    """Yield the frames of a film with their pictures: the eye stands still, and the picture has
    room for the largest legend, caption and chart of all.
    """
    timeline = run.timeline
    steps = sorted({frame.step for frame in frames})
    moments = {k: run.moment(k, style) for k in steps}
    view = timeline.lesson.view_of(timeline.params)
    lens = framed([shapes_of(timeline[k].scene) for k in steps], view, style.scene_size)
    lines = max(caption_lines(moments[k].caption, style) for k in steps)
    high = max(height_of(replace(moment, lines=lines), style) for moment in moments.values())
    for i, frame in enumerate(frames):
        scene = between(timeline[frame.before].scene, timeline[frame.step].scene, frame.share)
        moment = replace(moments[frame.step], scene=scene, lens=lens, lines=lines, height=high)
        yield frame, image_of(moment, style)
        progress("drawn", i + 1, len(frames))


def scene_files(
    lesson: Lesson, out: Path, asked: Asked, *, force: bool, progress: Progress
) -> list[Path]:
    """Write a picture of each scene of a story into a folder, and return the files, in order.

    Raises:
        InputError: If the lesson has no story, what is asked for does not go with slides, or the
            folder cannot be written to.
    """
    check_slides(asked)
    if not has_story(lesson):
        raise InputError(f"{lesson.name} has no story; without --scenes a picture is of a step")
    stills = stills_of(lesson)
    kind = asked.slides or "png"
    files = [out / f"{i:02d}-{_slug(still.title)}.{kind}" for i, still in enumerate(stills, 1)]
    if out.exists() and not out.is_dir():
        raise InputError(f"{out}: is not a folder")
    for file in files if out.is_dir() else ():
        check_place(file, force)
    names = Names(lesson, "live")
    style = _style(asked)
    runs: dict[str, WholeRun] = {}
    pictures = []
    for i, still in enumerate(stills):
        place = still.place
        if place.run not in runs:
            runs[place.run] = WholeRun.of(lesson, names.params_of(place.run), progress)
        run = runs[place.run]
        moment = moment_of(lesson, place, run.timeline, run=run.data, style=style)
        caption = " ".join(filter(None, (_sentence(still.title), moment.caption)))
        slide = replace(moment, caption=caption, tone="info")
        pictures.append(svg_of(slide, style) if kind == "svg" else png_of(slide, style))
        progress("drawn", i + 1, len(stills))
    try:
        out.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise InputError(f"{out}: cannot be made: {error.strerror or error}") from error
    write_places(dict(zip(files, pictures, strict=True)))
    return files


def pictured(
    lesson: Lesson,
    params: Any,
    out: Path,
    *,
    asked: Asked,
    preset: str | None = None,
    force: bool = False,
    progress: Progress,
) -> list[Path]:
    """Write a picture or a film of a run, by what the file is called, and return the files.

    Args:
        lesson: Whose run.
        params: Its inputs.
        out: The file.
        asked: What is wanted.
        preset: The name of what the params started from.
        force: Replace files that are there.
        progress: Is told how far it is.

    Raises:
        InputError: If it cannot be made or written; then nothing has changed.
    """
    film = is_film(out, asked)
    check_place(out, force)
    if asked.captions == "beside":
        check_place(beside(out), force)
    run = WholeRun.of(lesson, params, progress)
    if film:
        return film_file(run, out, asked, progress=progress)
    return picture_file(run, out, asked, preset=preset)


def _step(timeline: Timeline, asked: Asked, preset: str | None) -> int:
    if asked.step is not None:
        return index_of(timeline, asked.step, "--step")
    lesson = timeline.lesson
    own = None if preset is None else lesson.preset(preset).step
    if own is not None:
        return timeline.opening(f"lesson {lesson.name}, preset {preset}", own)
    return telling_step(lesson, timeline)


def _sentence(title: str) -> str:
    return title if title[-1:] in ".?!" else f"{title}."


def _style(asked: Asked) -> Style:
    return replace(asked.style, caption=asked.captions == "picture")


def _slug(title: str) -> str:
    return re.sub(r"[^a-z0-9]+", "-", title.lower()).strip("-")[:40].rstrip("-") or "scene"
