"""A small picture of a step, drawn without a browser or a graphics card: points, lines, faces and
images, seen by a View.
"""

import io
import itertools
from collections.abc import Iterable, Iterator
from typing import Any

import numpy as np
from PIL import Image, ImageDraw, ImageOps

from workbench.errors import AuthorError
from workbench.lesson import Lesson, View
from workbench.run.timeline import Timeline, Timelines
from workbench.scene import (
    PALETTE,
    Axes,
    Camera,
    Mesh,
    Picture,
    Points,
    Scene,
    Segments,
    color_rows,
    in_space,
)
from workbench.story import story_of
from workbench.story.names import views_of

SIZE = 480, 300
CARD = 1200, 630
"""Width and height, pixels, of the picture that other sites show of a page."""
GRIDS = ((1, 1), (2, 1), (2, 2), (3, 2), (4, 3))
"""How many pictures stand across and down on the card of a course."""
FINER = 2  # drawn so many times as large, then made smaller: its edges are smooth

THICK = 1.8  # pixels of the sheet to a width of 1


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
    across, down = next(one for one in GRIDS if one[0] * one[1] >= len(chosen))
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
    params = next((one.params for one in named if one.name == place.run), lesson.params())
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
    sheet = Image.new("RGBA", (FINER * size[0], FINER * size[1]), (255, 255, 255, 0))
    pen = _Pen(sheet, view)
    things = [thing for primitive in scene.values() for thing in _things(primitive, pen)]
    for _, draw in sorted(things, key=lambda thing: -thing[0]):
        draw()
    if not things:
        _paste_flat(sheet, scene)
    return sheet.resize(size, Image.Resampling.LANCZOS, box=_around(sheet))


def _around(sheet: Image.Image) -> tuple[float, float, float, float]:
    """Return the part of a sheet, of its own proportions, that has all that is drawn, with a
    margin.
    """
    found = sheet.getbbox()
    if found is None:
        return 0, 0, *sheet.size
    left, top, right, bottom = found
    share = min(
        1.0, max(0.42, 1.12 * (right - left) / sheet.width, 1.12 * (bottom - top) / sheet.height)
    )
    width, height = share * sheet.width, share * sheet.height
    x = min(max(0.5 * (left + right - width), 0), sheet.width - width)
    y = min(max(0.5 * (top + bottom - height), 0), sheet.height - height)
    return x, y, x + width, y + height


class _Pen:
    """Draws in the plane of a picture what stands in space."""

    def __init__(self, sheet: Image.Image, view: View):
        self.sheet, self.draw = sheet, ImageDraw.Draw(sheet, "RGBA")
        eye, up = np.array(view.seen_from(), float), np.array(view.up, float)
        ahead = np.array(view.target, float) - eye
        ahead /= np.linalg.norm(ahead)
        right = np.cross(ahead, up)
        right /= np.linalg.norm(right)
        self._R, self._eye = np.stack([right, np.cross(ahead, right), ahead]), eye
        self.focal = 0.5 * sheet.height / np.tan(np.radians(view.fov_degrees) / 2)

    def seen(self, p: np.ndarray, T: np.ndarray | None) -> tuple[np.ndarray, np.ndarray]:
        """Return pixels and depths of points, NaN behind the eye."""
        p_world = p if T is None else p @ T[:3, :3].T + T[:3, 3]
        p_eye = (p_world - self._eye) @ self._R.T
        depth = np.where(p_eye[..., 2] > 0.02, p_eye[..., 2], np.nan)
        middle = np.array(self.sheet.size) / 2
        return middle + self.focal * p_eye[..., :2] / depth[..., None], depth


def _things(primitive: object, pen: _Pen) -> Iterator[tuple]:
    if isinstance(primitive, Points):
        yield from _points(primitive, pen)
    elif isinstance(primitive, Segments):
        yield from _lines(
            primitive.ends,
            primitive.T_world_object,
            _rgba(primitive, len(primitive.ends)),
            primitive.width,
            pen,
        )
    elif isinstance(primitive, Mesh):
        yield from _faces(primitive, pen)
    elif isinstance(primitive, Axes):
        ends = np.zeros((3, 2, 3))
        ends[:, 1] = primitive.length * np.eye(3)
        rgba = np.array([[*PALETTE[role], 255 * primitive.opacity] for role in ("x", "y", "z")])
        yield from _lines(ends, primitive.T_world_object, rgba, 2.5, pen)
    elif isinstance(primitive, Camera):
        yield from _camera(primitive, pen)
    elif isinstance(primitive, Picture) and in_space(primitive):
        height, width = primitive.rgb().shape[:2]
        x, y = 0.5 * (primitive.width or 1.0) * np.array([1.0, height / width])
        corners = np.array([[-x, -y, 0], [x, -y, 0], [x, y, 0], [-x, y, 0]])
        yield from _sheet(
            primitive.rgb(), corners, primitive.T_world_object, opacity=primitive.opacity, pen=pen
        )


def _rgba(primitive: Points | Segments | Mesh, n: int) -> np.ndarray:
    return np.column_stack(
        [color_rows(primitive.color, n), np.full(n, 255 * primitive.opacity)]
    ).astype(int)


def _points(points: Points, pen: _Pen) -> Iterator[tuple]:
    uv, depth = pen.seen(points.p, points.T_world_object)
    radius = np.maximum(pen.focal * points.radius / depth, 1.4)
    for (u, v), z, r, color in zip(uv, depth, radius, _rgba(points, len(points.p)), strict=True):
        if np.isfinite(z):
            yield (
                z,
                lambda box=(u - r, v - r, u + r, v + r), c=tuple(color): pen.draw.ellipse(
                    box, fill=c
                ),
            )


def _lines(
    ends: np.ndarray, T: np.ndarray | None, rgba: np.ndarray, width: float, pen: _Pen
) -> Iterator[tuple]:
    uv, depth = pen.seen(ends, T)
    for pair, z, color in zip(uv, depth.mean(-1), rgba, strict=True):
        if np.isfinite(z) and np.abs(pair).max() < 20_000:
            place, c = tuple(map(tuple, pair)), tuple(int(value) for value in color)
            yield (
                z,
                lambda place=place, c=c: pen.draw.line(place, fill=c, width=round(THICK * width)),
            )


def _faces(mesh: Mesh, pen: _Pen) -> Iterator[tuple]:
    uv, depth = pen.seen(mesh.p, mesh.T_world_object)
    rgba = _rgba(mesh, len(mesh.p))
    if mesh.wireframe:
        edges = np.unique(
            np.sort(mesh.faces[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), 1), axis=0
        )
        yield from _lines(mesh.p[edges], mesh.T_world_object, rgba[edges[:, 0]], 1.0, pen)
        return
    corners = mesh.p[mesh.faces]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    if mesh.T_world_object is not None:
        normals = normals @ mesh.T_world_object[:3, :3].T
    length = np.linalg.norm(normals, axis=1)
    light = 0.62 + 0.38 * np.abs(normals @ pen._R.T @ np.array([0.35, -0.6, -0.72])) / np.where(
        length > 0, length, 1.0
    )
    for face, shade in zip(mesh.faces, light, strict=True):
        z = depth[face].mean()
        if np.isfinite(z):
            color = rgba[face].mean(0)
            c = (*(int(value) for value in shade * color[:3]), int(color[3]))
            place = [tuple(corner) for corner in uv[face]]
            yield z, lambda place=place, c=c: pen.draw.polygon(place, fill=c)


def _camera(camera: Camera, pen: _Pen) -> Iterator[tuple]:
    w, h = camera.width - 0.5, camera.height - 0.5
    corners_uv = np.array([[-0.5, -0.5, 1], [w, -0.5, 1], [w, h, 1], [-0.5, h, 1]])
    corners = camera.depth * corners_uv @ np.linalg.inv(camera.K).T
    if camera.image is not None:
        image = (
            camera.image if camera.image.ndim == 3 else np.repeat(camera.image[:, :, None], 3, 2)
        )
        yield from _sheet(image, corners, camera.T_world_object, opacity=camera.opacity, pen=pen)
    spokes = np.stack([np.zeros((4, 3)), corners], 1)
    ends = np.concatenate([np.stack([corners, np.roll(corners, -1, 0)], 1), spokes])
    color = np.tile([*PALETTE[camera.color], 255 * camera.opacity], (len(ends), 1))
    yield from _lines(ends, camera.T_world_object, color, 2.0, pen)


def _sheet(
    image: np.ndarray, corners: np.ndarray, T: np.ndarray | None, *, opacity: float, pen: _Pen
) -> Iterator[tuple]:
    """Yield an image on a plane in space."""
    uv, depth = pen.seen(corners, T)
    if not np.isfinite(depth).all():
        return
    height, width = image.shape[:2]
    source = np.array([[0, 0], [width, 0], [width, height], [0, height]])
    rows = [
        row
        for (u, v), (x, y) in zip(uv, source, strict=True)
        for row in ([u, v, 1, 0, 0, 0, -x * u, -x * v], [0, 0, 0, u, v, 1, -y * u, -y * v])
    ]
    matrix = np.array(rows)
    if np.linalg.matrix_rank(matrix) < 8:  # seen from its edge
        return
    homography = np.linalg.solve(matrix, source.reshape(-1).astype(float))
    alpha = np.full((height, width, 1), round(255 * opacity), np.uint8)
    sheet = Image.fromarray(np.concatenate([image, alpha], 2), "RGBA")

    def draw() -> None:
        seen = sheet.transform(
            pen.sheet.size,
            Image.Transform.PERSPECTIVE,
            tuple(homography),
            Image.Resampling.BILINEAR,
        )
        pen.sheet.alpha_composite(seen)

    yield depth.mean(), draw


def _paste_flat(sheet: Image.Image, scene: Scene) -> None:
    """Lay a picture from beside the scene over the sheet, where nothing stands in space."""
    pictures = [one for one in scene.values() if isinstance(one, Picture)]
    if pictures:
        image = Image.fromarray(np.ascontiguousarray(pictures[0].rgb())).convert("RGBA")
        image.thumbnail(sheet.size)
        sheet.paste(image, ((sheet.width - image.width) // 2, (sheet.height - image.height) // 2))
