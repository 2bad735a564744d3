"""Pictures of a lesson's page for paper, and for where no script runs: of each scene of its story,
else of each experiment, what the stage shows, with its legend and its chart.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from html import escape
from typing import Any

from workbench.lesson import Lesson, View
from workbench.page.chart_svg import WIDTH, telling_chart
from workbench.picture.sheet import Moment, Style, paper_svg
from workbench.rendering.framing import framed
from workbench.rendering.shapes import shapes_of
from workbench.run.timeline import Timeline
from workbench.story import StagePlace, Story, TextScene, has_story, story_of
from workbench.story.names import views_of

PAPER = Style(width=WIDTH, caption=False)
"""How a picture for paper looks."""
FOLDER = "stills"


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


def moment_of(
    lesson: Lesson, place: StagePlace, timeline: Timeline, *, run: Mapping[str, Any], style: Style
) -> Moment:
    """Return what a picture shows at a place of a complete run.

    Args:
        lesson: Whose run.
        place: Step, camera, charts, what is hidden.
        timeline: The run.
        run: It as plain data.
        style: How the picture will look.
    """
    k = _index(place.step, len(timeline), run["end"])
    view: View = views_of(lesson).get(place.view) or lesson.view_of(timeline.params)
    step = timeline[k]
    hidden = {path for path in step.scene for hid in place.hide if _is_under(path, hid)}
    scene = {path: primitive for path, primitive in step.scene.items() if path not in hidden}
    told = bool(place.chart) or has_story(lesson)
    names = place.chart.split(",") if told else [telling_chart(run, k, lesson.telling)]
    return Moment(
        scene=scene,
        view=view,
        lens=framed([shapes_of(scene)], view, style.scene_size),
        caption=step.caption.text,
        tone=step.caption.tone,
        run=run,
        step=k,
        charts=tuple(name for name in names if name),
        hide=place.hide,
    )


def still_svg(lesson: Lesson, still: Still, timeline: Timeline, *, run: Mapping[str, Any]) -> bytes:
    """Return a picture of a complete run as SVG for paper, its scene as one picture.

    Args:
        lesson: Whose run.
        still: Which picture.
        timeline: The run.
        run: It as plain data.
    """
    return paper_svg(moment_of(lesson, still.place, timeline, run=run, style=PAPER), PAPER)


def _is_under(path: str, other: str) -> bool:
    return path == other or path.startswith(f"{other}/")


def _index(step: int | str, known: int, end: int | None) -> int:
    """Return the index of a step, as the page's scripts find it."""
    if isinstance(step, str):
        own = known - 1 if end is None else end
        step = own + int(step.removeprefix("stop") or 0)
    elif step < 0:
        step = known + step
    return max(0, min(known - 1, step))
