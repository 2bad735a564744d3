"""Pictures of a lesson's page for paper, and for where no script runs: of each scene of its story,
else of each experiment, what the stage shows, with its legend and its chart.
"""

import base64
import re
from collections.abc import Mapping
from dataclasses import dataclass, replace
from html import escape, unescape
from typing import Any

from workbench.lesson import Lesson, View
from workbench.page.chart_svg import SOFT, WIDTH, charts_svg, telling_chart
from workbench.page.thumbnail import picture_of
from workbench.run.timeline import Timeline
from workbench.story import StagePlace, Story, TextScene, story_of
from workbench.story.names import views_of

PICTURE = 800, 500
"""Pixels of the picture, which stands in the still with WIDTH of them."""
FOLDER = "stills"
SIGN = 6.4
LINE = 17
"""Pixels that a sign of a legend takes, and a line of it."""
_BAR = re.compile(
    r"<span[^>]*>([^<]*)"
    r'<b style="background:linear-gradient\(90deg,((?:#[0-9a-f]{6},?)+)\)"></b>([^<]*)</span>'
)
_ROW = re.compile(r'<i style="background:(#[0-9a-f]{6})"></i>([^<]*)</span>')


@dataclass(frozen=True, kw_only=True)
class Still:
    """A picture of a page.

    Args:
        name: Of its file.
        title, line: What is said under it; empty where it stands in its scene.
        place: What the stage shows: run, step, camera, charts, what is hidden.
    """

    name: str
    title: str
    line: str = ""
    place: StagePlace

    @property
    def file(self) -> str:
        """Its address, on the lesson's page."""
        return f"{FOLDER}/{self.name}.svg"

    def html(self) -> str:
        """Return it as a figure, not loaded before it is seen."""
        words = f"<b>{escape(self.title)}</b> {escape(self.line)}" if self.line else ""
        caption = f"<figcaption>{words}</figcaption>" if words else ""
        return (
            f'<figure class="still"><img src="{self.file}" loading="lazy" width="{WIDTH}"'
            f' alt="The picture and the chart of: {escape(self.title)}">{caption}</figure>'
        )


def stills_of(lesson: Lesson) -> tuple[Still, ...]:
    """Return the pictures of a lesson's page: of the scenes of its story in order, else of the
    default run and of the presets that are other runs.
    """
    story = story_of(lesson, "site")
    if story is not None:
        return tuple(
            Still(name=f"scene-{i}", title=scene.title, place=_telling(scene))
            for i, scene in enumerate(story.scenes, 1)
            if not scene.is_turn
        )
    usual = Still(
        name="default",
        title="The default run.",
        line=lesson.summary,
        place=StagePlace(step=lesson.opens),
    )
    return (
        usual,
        *(
            Still(
                name=preset.name,
                title=f"{preset.title}.",
                line=preset.line,
                place=StagePlace(
                    preset.name, lesson.first_step if preset.step is None else preset.step
                ),
            )
            for preset in lesson.presets
            if preset.params != lesson.params()
        ),
    )


def _telling(scene: TextScene) -> StagePlace:
    """Return the first place of a scene with a chart whose curve is not hidden; else the first one
    with a chart, or the first.
    """
    charted = [place for place in scene.beats if place.chart]
    open_ = [place for place in charted if "curve" not in place.hide]
    return [*open_, *charted, *scene.beats][0]


def with_stills(story: Story, stills: tuple[Still, ...]) -> Story:
    """Return a story with its pictures at the ends of their scenes."""
    by_name = {still.name: still for still in stills}
    scenes = []
    for i, scene in enumerate(story.scenes, 1):
        still = by_name.get(f"scene-{i}")
        figure = "" if still is None else still.html()
        html = f"{scene.html.removesuffix('</section>')}{figure}</section>"
        scenes.append(replace(scene, html=html))
    return replace(story, scenes=tuple(scenes))


def still_svg(lesson: Lesson, still: Still, timeline: Timeline, *, run: Mapping[str, Any]) -> bytes:
    """Return a picture of a complete run as SVG.

    Args:
        lesson: Whose run.
        still: Which picture.
        timeline: The run.
        run: It as plain data.
    """
    place = still.place
    k = _index(place.step, len(timeline), run["end"])
    view: View = views_of(lesson).get(place.view) or lesson.view_of(timeline.params)
    hidden = {path for path in timeline[k].scene for hid in place.hide if _is_under(path, hid)}
    scene = {path: one for path, one in timeline[k].scene.items() if path not in hidden}
    picture = base64.b64encode(picture_of(scene, view, PICTURE)).decode()
    wide = WIDTH
    high = WIDTH * PICTURE[1] // PICTURE[0]
    story = story_of(lesson, "site") is not None
    names = place.chart.split(",") if story else [telling_chart(run, k, lesson.telling)]
    charts, below = charts_svg(run, k, [name for name in names if name], hide=place.hide)
    legend, ended = _legend(str(run["things"][run["steps"][k]["legend"]]), high)
    top = ended + 8
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {wide} {top + below}"'
        f' width="{wide}" height="{top + below}" font-family="system-ui,sans-serif" font-size="12"'
        f' fill="{SOFT}"><image width="{wide}" height="{high}"'
        f' href="data:image/webp;base64,{picture}"/>{legend}<g transform="translate(0'
        f' {top})">{charts}</g></svg>\n'
    ).encode()


def _is_under(path: str, other: str) -> bool:
    return path == other or path.startswith(f"{other}/")


def _legend(html: str, top: int) -> tuple[str, int]:
    """Return the colours of a legend with their names, and the bars of its colour maps, as lines of
    SVG below `top`; and where they end.
    """
    lines: list[list[str]] = [[]]
    room = 0.0
    for color, name in _ROW.findall(html):
        wide = SIGN * (len(unescape(name)) + 4)
        if lines[-1] and room + wide > WIDTH:
            lines.append([])
            room = 0.0
        room += wide
        lines[-1].append(f'<tspan fill="{color}" dx="8">● </tspan><tspan>{name}</tspan>')
    parts = [
        f'<text x="0" y="{top + LINE * (i + 1)}">{"".join(line)}</text>'
        for i, line in enumerate(lines)
        if line
    ]
    below = top + LINE * len(parts)
    for before, colors, after in _BAR.findall(html):
        stops = colors.split(",")
        marks = "".join(
            f'<stop offset="{i / (len(stops) - 1):g}" stop-color="{color}"/>'
            for i, color in enumerate(stops)
        )
        parts.append(
            f'<linearGradient id="bar{below}">{marks}</linearGradient><rect x="8" y="{below + 4}"'
            f' width="90" height="9" fill="url(#bar{below})"/><text x="106" y="{below + 13}">'
            f"{before} to {after}</text>"
        )
        below += LINE
    return "".join(parts), below


def _index(step: int | str, known: int, end: int | None) -> int:
    """Return the index of a step, as the page's scripts find it."""
    if isinstance(step, str):
        own = known - 1 if end is None else end
        step = own + int(step.removeprefix("stop") or 0)
    elif step < 0:
        step = known + step
    return max(0, min(known - 1, step))
