"""What is drawn of a scene, as plain shapes in the world: discs, strokes, surfaces, sheets,
words.
"""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import singledispatch
from typing import Any, TypeAlias

import numpy as np

from workbench.scene import (
    PALETTE,
    Axes,
    Camera,
    Color,
    Label,
    Mesh,
    Picture,
    Points,
    Scene,
    Segments,
    color_rows,
    in_space,
)
from workbench.view import View

FAINT = 0.35
"""How opaque a thing is at least that a picture is framed by."""
CELL = (205, 208, 212)
SECTION = (170, 175, 182)
"""Colours of the lines of a ground grid, and of every fifth of them."""
CELLS = 20
"""Cells of the grid from the origin to each of its sides."""
SIDES = 10
"""Sides of an axis's shaft and of its head."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Discs:
    """Discs that face the eye: `p` (n, 3) and `radius`, metres; `rgba` (n, 4) uint8."""

    p: np.ndarray
    radius: float
    rgba: np.ndarray
    framed: bool = True


@dataclass(frozen=True, kw_only=True, eq=False)
class Strokes:
    """Lines: `ends` (n, 2, 3), metres; `width` in pixels of a page; `rgba` (n, 4) uint8."""

    ends: np.ndarray
    width: float
    rgba: np.ndarray
    framed: bool = True


@dataclass(frozen=True, kw_only=True, eq=False)
class Surface:
    """Triangles: `corners` (f, 3, 3), metres; `normals` (f, 3, 3) at the corners; `rgb` (f, 3, 3)
    from 0 to 255.
    """

    corners: np.ndarray
    normals: np.ndarray
    rgb: np.ndarray
    opacity: float = 1.0
    framed: bool = True


@dataclass(frozen=True, kw_only=True, eq=False)
class Sheet:
    """An image (h, w, 3) uint8 on a plane: `corner` (3,) of its upper left, `right` and `down` (3,)
    along its whole sides, metres.
    """

    image: np.ndarray
    corner: np.ndarray
    right: np.ndarray
    down: np.ndarray
    opacity: float = 1.0
    framed: bool = True

    @property
    def p(self) -> np.ndarray:
        """Its corners, (4, 3), clockwise."""
        steps = np.array([[0, 0], [1, 0], [1, 1], [0, 1]])
        return self.corner + steps @ np.stack([self.right, self.down])


@dataclass(frozen=True, kw_only=True, eq=False)
class Word:
    """A word at a place `p` (3,), metres; a small one, and one that stays there, in its middle."""

    text: str
    p: np.ndarray
    opacity: float = 1.0
    small: bool = False
    stays: bool = False
    framed: bool = True


Shape: TypeAlias = Discs | Strokes | Surface | Sheet | Word


def shapes_of(scene: Scene) -> list[Shape]:
    """Return what is drawn of all that stands in space, in the order of the scene."""
    return [shape for thing in scene.values() if in_space(thing) for shape in _shapes(thing)]


def stage_of(view: View) -> list[Shape]:
    """Return the ground grid and the world's axes of a view; they frame no picture."""
    shapes: list[Shape] = []
    if view.grid is not None:
        shapes += _grid(view, view.grid)
    if view.axes:
        length = view.grid or 0.5
        shapes += _arrows(Axes(length=length), shaft=0.012, framed=False)
        shapes += [
            Word(text=name, p=1.08 * length * p, small=True, framed=False)
            for name, p in zip("xyz", np.eye(3), strict=True)
        ]
    return shapes


def strong(shapes: Iterable[Shape]) -> list[Shape]:
    """Return the shapes that lead a picture: faint ones only where there are no others."""
    shapes = [shape for shape in shapes if shape.framed]
    return [shape for shape in shapes if _opacity(shape) >= FAINT] or shapes


def corners_of(shape: Shape) -> np.ndarray:
    """Return all points (n, 3) of a shape, metres."""
    if isinstance(shape, Strokes):
        return shape.ends.reshape(-1, 3)
    corners = shape.corners if isinstance(shape, Surface) else shape.p
    return corners.reshape(-1, 3)


def _opacity(shape: Shape) -> float:
    if isinstance(shape, Discs | Strokes):
        return float(shape.rgba[:, 3].max(initial=0)) / 255
    return shape.opacity


@singledispatch
def _shapes(primitive: Any) -> Iterator[Shape]:
    raise TypeError(f"no way to draw a {type(primitive).__name__}")


@_shapes.register
def _points(points: Points) -> Iterator[Shape]:
    rgba = _rgba(points.color, len(points.p), points.opacity)
    yield Discs(p=_placed(points.p, points.T_world_object), radius=points.radius, rgba=rgba)


@_shapes.register
def _segments(segments: Segments) -> Iterator[Shape]:
    rgba = _rgba(segments.color, len(segments.ends), segments.opacity)
    ends = _placed(segments.ends, segments.T_world_object)
    yield Strokes(ends=ends, width=segments.width, rgba=rgba)


@_shapes.register
def _mesh(mesh: Mesh) -> Iterator[Shape]:
    p = _placed(mesh.p, mesh.T_world_object)
    rgb = color_rows(mesh.color, len(p))
    if mesh.wireframe:
        sides = mesh.faces[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2)
        edges = np.unique(np.sort(sides, 1), axis=0)
        rgba = _rgba(rgb[edges[:, 0]], len(edges), mesh.opacity)
        yield Strokes(ends=p[edges], width=1.0, rgba=rgba)
        return
    normals = _normals(p, mesh.faces, flat=mesh.flat)
    yield Surface(corners=p[mesh.faces], normals=normals, rgb=rgb[mesh.faces], opacity=mesh.opacity)


@_shapes.register
def _axes(axes: Axes) -> Iterator[Shape]:
    yield from _arrows(axes, shaft=0.018)


@_shapes.register
def _camera(camera: Camera) -> Iterator[Shape]:
    right = camera.width - 0.5
    bottom = camera.height - 0.5
    uv1 = np.array(
        [[-0.5, -0.5, 1.0], [right, -0.5, 1.0], [right, bottom, 1.0], [-0.5, bottom, 1.0]]
    )
    rim = camera.depth * uv1 @ np.linalg.inv(camera.K).T
    top = rim[:2].mean(0) - 0.12 * (rim[3] - rim[0])
    corners = _placed(rim, camera.T_world_object)
    if camera.image is not None:
        image = camera.image
        yield Sheet(
            image=image if image.ndim == 3 else np.repeat(image[:, :, None], 3, 2),
            corner=corners[0],
            right=corners[1] - corners[0],
            down=corners[3] - corners[0],
            opacity=camera.opacity,
        )
    ends = np.concatenate(
        [
            np.stack([rim, np.roll(rim, -1, 0)], axis=1),
            np.stack([np.zeros((4, 3)), rim], axis=1),
            np.array([[rim[0], top], [top, rim[1]]]),
        ]
    )
    rgba = _rgba(camera.color, len(ends), camera.opacity)
    yield Strokes(ends=_placed(ends, camera.T_world_object), width=2.0, rgba=rgba)


@_shapes.register
def _label(label: Label) -> Iterator[Shape]:
    p = _placed(label.p, label.T_world_object)
    yield Word(text=label.text, p=p, opacity=label.opacity, stays=label.stays)


@_shapes.register
def _picture(picture: Picture) -> Iterator[Shape]:
    width, height = picture.size
    corners = picture.places(
        np.array([[-0.5, -0.5], [width - 0.5, -0.5], [-0.5, height - 0.5]], float)
    )
    yield Sheet(
        image=picture.rgb(),
        corner=corners[0],
        right=corners[1] - corners[0],
        down=corners[2] - corners[0],
        opacity=picture.opacity,
    )


def _rgba(color: Color, n: int, opacity: float) -> np.ndarray:
    alpha = np.full(n, round(255 * opacity), np.uint8)
    return np.column_stack([color_rows(color, n), alpha])


def _placed(p: np.ndarray, T: np.ndarray | None) -> np.ndarray:
    return np.asarray(p, float) if T is None else p @ T[:3, :3].T + T[:3, 3]


def _normals(p: np.ndarray, faces: np.ndarray, *, flat: bool) -> np.ndarray:
    """Return unit normals (f, 3, 3) at the corners of faces: of the face, or of all around the
    vertex, by area.
    """
    corners = p[faces]
    of_faces = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals = np.repeat(of_faces[:, None], 3, axis=1)
    if not flat:
        summed = np.zeros((len(p), 3))
        for i in range(3):
            np.add.at(summed, faces[:, i], of_faces)
        normals = summed[faces]
    length = np.linalg.norm(normals, axis=-1, keepdims=True)
    return normals / np.where(length > 0, length, 1.0)


def _arrows(axes: Axes, *, shaft: float, framed: bool = True) -> Iterator[Shape]:
    """Yield three arrows, each a shaft and a head."""
    length = axes.length
    for i, role in enumerate(("x", "y", "z")):
        along = np.roll(np.eye(3), -i, axis=0)
        profile = [(0, shaft), (0.85, shaft), (0.85, 2.8 * shaft), (1, 0)]
        p = _placed(_turned(length * np.array(profile, float), along), axes.T_world_object)
        faces = _round_faces(len(profile))
        yield Surface(
            corners=p[faces],
            normals=_normals(p, faces, flat=True),
            rgb=np.broadcast_to(np.array(PALETTE[role], float), (len(faces), 3, 3)),
            opacity=axes.opacity,
            framed=framed,
        )


def _turned(profile: np.ndarray, along: np.ndarray) -> np.ndarray:
    """Return rings of points around an axis (first row of `along`) at (place, radius) each."""
    angle = np.linspace(0, 2 * np.pi, SIDES, endpoint=False)
    ring = np.cos(angle)[:, None] * along[1] + np.sin(angle)[:, None] * along[2]
    return np.concatenate([place * along[0] + radius * ring for place, radius in profile])


def _round_faces(rings: int) -> np.ndarray:
    i = np.arange(SIDES)
    j = (i + 1) % SIDES
    bands = [
        np.stack(
            [base + i, base + j, base + SIDES + i, base + SIDES + i, base + j, base + SIDES + j]
        )
        for base in SIDES * np.arange(rings - 1)
    ]
    return np.concatenate([band.T.reshape(-1, 3) for band in bands])


def _grid(view: View, spacing: float) -> Iterator[Shape]:
    """Yield the lines of a ground grid in pieces of a cell, paler the farther away they are."""
    up = int(np.argmax(np.abs(view.up)))
    flat = [i for i in range(3) if i != up]
    line, piece = np.meshgrid(np.arange(-CELLS, CELLS + 1), np.arange(-CELLS, CELLS), indexing="ij")
    height = view.grid_height * np.sign(view.up[up])
    for every, color, width in ((False, CELL, 0.8), (True, SECTION, 1.0)):
        chosen = (line % 5 == 0) == every
        across = line[chosen]
        along = piece[chosen]
        for first, second in (flat, flat[::-1]):
            ends = np.full((len(across), 2, 3), height, float)
            ends[:, :, first] = spacing * across[:, None]
            ends[:, :, second] = spacing * (along[:, None] + np.array([0, 1]))
            away = np.hypot(across, along + 0.5) / CELLS
            alpha = 255 * np.clip(1.2 - 1.2 * away, 0, 1)
            kept = alpha > 4
            rgba = np.column_stack([np.tile(color, (len(away), 1)), alpha]).astype(np.uint8)
            yield Strokes(ends=ends[kept], width=width, rgba=rgba[kept], framed=False)
