"""A small picture of a step, drawn without a browser or a graphics card: points, lines, faces and
images, seen by a View.
"""

import io
import itertools
from collections.abc import Iterable
from typing import Any

import numpy as np
from PIL import Image, ImageOps

from workbench.errors import AuthorError
from workbench.lesson import Lesson, View
from workbench.rendering.framing import framed
from workbench.rendering.raster import painted
from workbench.rendering.shapes import Word, shapes_of
from workbench.run.timeline import Timeline, Timelines
from workbench.scene import Picture, Scene, in_space
from workbench.story import story_of
from workbench.story.names import views_of

SIZE = 480, 300
CARD = 1200, 630
"""Width and height, pixels, of the picture that other sites show of a page."""
GRIDS = ((1, 1), (2, 1), (2, 2), (3, 2), (4, 3))
"""How many pictures stand across and down on the card of a course."""
PAGE = 360
"""Pixels of a page's scene as wide as the picture: for the widths of lines."""


def thumbnail(lesson: Lesson, timelines: Timelines | None = None) -> bytes:
    """Return a picture of a lesson, WebP, transparent where nothing is: where its story begins,
    else of its default run.

    Args:
        lesson: Of what.
        timelines: Where runs are kept; computed anew without.
    """
    return picture_of(*shown(lesson, timelines))


def card(lesson: Lesson, timelines: Timelines | None = None) -> bytes:
    """Return the same picture as PNG on white, of CARD's size, for sites that show what they link;
    `timelines` as for `thumbnail`.
    """
    return still_of(*shown(lesson, timelines), CARD)


def course_card(pictures: Iterable[bytes]) -> bytes:
    """Return small pictures side by side as one PNG of CARD's size: the first twelve, in rows."""
    chosen = list(itertools.islice(pictures, 12))
    across, down = next(grid for grid in GRIDS if grid[0] * grid[1] >= len(chosen))
    wide = CARD[0] // across
    high = CARD[1] // down
    sheet = Image.new("RGB", CARD, "white")
    for i, data in enumerate(chosen):
        whole = Image.open(io.BytesIO(data)).convert("RGBA")
        picture = ImageOps.contain(whole, (wide - 24, high - 24))
        row, column = divmod(i, across)
        left = wide * column + (wide - picture.width) // 2
        sheet.paste(picture, (left, high * row + (high - picture.height) // 2), picture)
    file = io.BytesIO()
    sheet.quantize(128).save(file, "PNG", optimize=True)
    return file.getvalue()


def shown(lesson: Lesson, timelines: Timelines | None = None) -> tuple[Scene, View]:
    """Return the scene that stands for a lesson and the camera that sees it: where its story
    begins, else of its default run; `timelines` as for `thumbnail`.
    """
    timelines = timelines or Timelines()
    begun = _story_begins(lesson)
    params, step, view = (lesson.params(), None, lesson.view) if begun is None else begun
    timeline = timelines.get(lesson, params).complete()
    k = telling_step(lesson, timeline) if step is None else step
    return timeline[min(k, len(timeline) - 1)].scene, view


def _story_begins(lesson: Lesson) -> tuple[Any, int | None, View] | None:
    """Return params, step and camera of what a story's first words stand beside; None without
    one.
    """
    try:
        story = story_of(lesson, "live")
    except AuthorError:  # told on its page
        return None
    if story is None or not story.scenes:
        return None
    place = story.scenes[0].beats[0]
    named = [*lesson.presets, *lesson.questions]
    params = next((run.params for run in named if run.name == place.run), lesson.params())
    step = -1 if place.step == "stop" else int(place.step)
    return params, step, views_of(lesson).get(place.view) or lesson.view_of(params)


def telling_step(lesson: Lesson, timeline: Timeline) -> int:
    """Return the step of a run that stands for it: where it opens; of one that opens at its start,
    where most is drawn.
    """
    first = timeline.opening(f"lesson {lesson.name}", lesson.first_step)
    if first:
        return first
    return max(
        range(len(timeline)),
        key=lambda k: (len([p for p in timeline[k].scene.values() if in_space(p)]), -k),
    )


def picture_of(scene: Scene, view: View, size: tuple[int, int] = SIZE) -> bytes:
    """Return a scene as a WebP image with a transparent ground."""
    file = io.BytesIO()
    # what method 6 saves, 3 %, takes a hundred times as long
    drawn(scene, view, size).save(file, "WEBP", quality=80, alpha_quality=60)
    return file.getvalue()


def still_of(scene: Scene, view: View, size: tuple[int, int]) -> bytes:
    """Return a scene as a PNG image on white, for places that know nothing of WebP and transparent
    grounds.
    """
    image = drawn(scene, view, size)
    ground = Image.new("RGBA", image.size, "white")
    ground.alpha_composite(image)
    file = io.BytesIO()
    ground.convert("RGB").quantize(128).save(file, "PNG", optimize=True)
    return file.getvalue()


def drawn(scene: Scene, view: View, size: tuple[int, int]) -> Image.Image:
    """Return a scene as an image with a transparent ground, as large as asked for."""
    shapes = shapes_of(scene)
    lens = framed([[shape for shape in shapes if not isinstance(shape, Word)]], view, size)
    sheet = painted(shapes, lens, scale=size[0] / PAGE)
    if not shapes:
        _paste_flat(sheet, scene)
    return sheet


def _paste_flat(sheet: Image.Image, scene: Scene) -> None:
    """Lay a picture from beside the scene over the sheet, where nothing stands in space."""
    pictures = [primitive for primitive in scene.values() if isinstance(primitive, Picture)]
    if pictures:
        image = Image.fromarray(np.ascontiguousarray(pictures[0].rgb())).convert("RGBA")
        image.thumbnail(sheet.size)
        sheet.paste(image, ((sheet.width - image.width) // 2, (sheet.height - image.height) // 2))
