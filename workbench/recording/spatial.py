"""How each primitive in space is said to Rerun, in aspects that change independently of each other.

A moving cloud changes only its `pose`, classes that change send only ids, and so on: a sink keeps the key of every
aspect it has sent, and sends an aspect again when its key is not the same any more.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import singledispatch
from typing import Any

import numpy as np
import rerun as rr

from workbench.recording.glyphs import safe
from workbench.recording.png import IMAGE, encoded, texture
from workbench.scene import (
    PALETTE,
    Axes,
    Camera,
    Classes,
    Color,
    Label,
    Mesh,
    Picture,
    Points,
    Role,
    Segments,
    color_rows,
)

FADED = (168, 172, 178)
"""What faint points and lines are mixed with, on a white and on a black ground: Rerun draws them without transparency."""


@dataclass(frozen=True)
class Aspect:
    """Something about an entity: what it depends on, and how it is said.

    Args:
        name: Its name among the aspects of the primitive.
        key: Values that decide whether it has to be said again, compared by `workbench.scene.same`.
        say: Makes the archetypes.
        suffix: Behind the path of the primitive's entity: nothing for itself, `/image` for an entity below it.
    """

    name: str
    key: tuple[Any, ...]
    say: Callable[[], list[Any]]
    suffix: str = ""


class ClassNumbers:
    """Numbers for classes: one per role, name and opacity, for a whole recording.

    Rerun looks up the names and colours of class ids in one table that holds for all times.
    """

    def __init__(self) -> None:
        self._known: dict[tuple[Role, str, float], int] = {}
        self._in_table = 0

    def ids(self, classes: Classes, opacity: float) -> np.ndarray:
        """Return each item's number."""
        numbers = [
            self._known.setdefault((role, name, opacity), len(self._known))
            for role, name in zip(classes.roles, classes.names, strict=True)
        ]
        return np.array(numbers, np.uint16)[classes.ids.astype(int)]

    @property
    def new(self) -> bool:
        """Whether there are classes that the last table had not."""
        return len(self._known) > self._in_table

    def table(self) -> Any:
        """Return all names and colours so far; it holds for all times."""
        self._in_table = len(self._known)
        return rr.AnnotationContext(
            [
                rr.AnnotationInfo(number, safe(name), _faded(np.array(PALETTE[role]), opacity))
                for (role, name, opacity), number in self._known.items()
            ]
        )


@singledispatch
def aspects(primitive: Any, numbers: ClassNumbers) -> Iterator[Aspect]:
    """Return the aspects of a primitive in space; its classes are numbered by `numbers`."""
    raise TypeError(f"no way to record a {type(primitive).__name__}")


@aspects.register
def _points(primitive: Points, numbers: ClassNumbers) -> Iterator[Aspect]:
    points = affine(primitive)
    yield Aspect("place", (points.p,), lambda: [rr.Points3D.from_fields(positions=points.p)])
    yield Aspect("size", (points.radius,), lambda: [rr.Points3D.from_fields(radii=[points.radius], show_labels=False)])
    yield from _colors(points.color, points.opacity, rr.Points3D, numbers)
    yield pose(points.T_world_object)


@aspects.register
def _segments(primitive: Segments, numbers: ClassNumbers) -> Iterator[Aspect]:
    segments = affine(primitive)
    yield Aspect("place", (segments.ends,), lambda: [rr.LineStrips3D.from_fields(strips=segments.ends)])
    yield _width(segments.width)
    yield from _colors(segments.color, segments.opacity, rr.LineStrips3D, numbers)
    yield pose(segments.T_world_object)


@aspects.register
def _mesh(primitive: Mesh, numbers: ClassNumbers) -> Iterator[Aspect]:
    mesh = affine(primitive)
    if mesh.wireframe:
        role: Any = mesh.color if isinstance(mesh.color, str) else "neutral"
        yield Aspect(
            "place", (mesh.p, mesh.faces), lambda: [rr.LineStrips3D.from_fields(strips=mesh.p[_edges(mesh.faces)])]
        )
        yield _width(1.0)
        yield Aspect(
            "color",
            (role, mesh.opacity),
            lambda: [rr.LineStrips3D.from_fields(colors=_faded(_rows(role), mesh.opacity))],
        )
    else:
        kind = "surface" if isinstance(mesh.color, str) else "coloured surface"  # Rerun would multiply both's colours
        yield Aspect(kind, (mesh.p, mesh.faces, mesh.flat, mesh.color, mesh.opacity), lambda: [_surface(mesh)])
    yield pose(mesh.T_world_object)


@aspects.register
def _axes(axes: Axes, numbers: ClassNumbers) -> Iterator[Aspect]:
    colors = _faded(np.array([PALETTE[role] for role in ("x", "y", "z")]), axes.opacity)
    yield Aspect(
        "arrows",
        (axes.length, axes.opacity),
        lambda: [rr.Arrows3D(vectors=np.eye(3) * axes.length, colors=colors)],
    )
    if axes.name:
        yield Aspect("name", (axes.name,), lambda: [_name_tag(axes.name, PALETTE["neutral"])])
    yield pose(axes.T_world_object)


@aspects.register
def _camera(camera: Camera, numbers: ClassNumbers) -> Iterator[Aspect]:
    color = _faded(np.array(PALETTE[camera.color]), camera.opacity)
    yield Aspect(
        "frustum",
        (camera.K, camera.width, camera.height, camera.depth, camera.color, camera.opacity),
        lambda: [
            rr.Pinhole(
                image_from_camera=camera.K,
                resolution=[camera.width, camera.height],
                camera_xyz=rr.ViewCoordinates.RDF,
                image_plane_distance=camera.depth,
                color=color,
                line_width=-1.5,  # negative: in pixels of the screen
            )
        ],
    )
    yield pose(camera.T_world_object)
    image = camera.image
    if image is not None:
        yield Aspect("image", (image,), lambda: [encoded(image)], IMAGE)


@aspects.register
def _label(label: Label, numbers: ClassNumbers) -> Iterator[Aspect]:
    yield Aspect(
        "word",
        (label.text, label.p, label.color, label.opacity),
        lambda: [_name_tag(label.text, PALETTE[label.color], label.p)],
    )
    yield pose(label.T_world_object)


@aspects.register
def _picture(picture: Picture, numbers: ClassNumbers) -> Iterator[Aspect]:
    def plane() -> list[Any]:
        image, width = picture.rgb(), picture.width or 1.0
        x, y = width / 2, width / 2 * image.shape[0] / image.shape[1]
        image = texture(image)
        return [
            rr.Mesh3D(
                vertex_positions=[[-x, -y, 0], [x, -y, 0], [x, y, 0], [-x, y, 0]],
                triangle_indices=[[0, 1, 2], [0, 2, 3]],
                vertex_texcoords=[[0, 0], [1, 0], [1, 1], [0, 1]],
                albedo_texture=np.ascontiguousarray(image),
                albedo_factor=[255, 255, 255, round(255 * picture.opacity)],
            )
        ]

    yield Aspect("plane", (picture.image, picture.width, picture.opacity), plane)
    yield pose(picture.T_world_object)


def pose(T_world_object: np.ndarray | None) -> Aspect:
    """Return where a primitive is."""
    T = np.eye(4) if T_world_object is None else T_world_object
    return Aspect("pose", (T,), lambda: [rr.Transform3D(translation=T[:3, 3], mat3x3=T[:3, :3])])


def _width(pixels: float) -> Aspect:
    radius = rr.Radius.ui_points(pixels / 2)
    return Aspect("size", (pixels,), lambda: [rr.LineStrips3D.from_fields(radii=radius, show_labels=False)])


def _colors(color: Color, opacity: float, archetype: Any, numbers: ClassNumbers) -> Iterator[Aspect]:
    """Return how points or segments are coloured: by class ids where they have classes, else by colours."""
    if isinstance(color, Classes):
        ids = numbers.ids(color, opacity)
        yield Aspect("classes", (ids,), lambda: [archetype.from_fields(class_ids=ids)])
    else:
        yield Aspect("color", (color, opacity), lambda: [archetype.from_fields(colors=_faded(_rows(color), opacity))])


def _rows(color: Color) -> np.ndarray:
    """Return one colour for all where all have the same, else one each."""
    return color_rows(color, 1) if isinstance(color, str) else color_rows(color, 0)


def _faded(colors: np.ndarray, opacity: float) -> np.ndarray:
    if opacity >= 1.0:
        return colors.astype(np.uint8)
    return (colors * opacity + np.array(FADED) * (1.0 - opacity)).round().astype(np.uint8)


def _name_tag(text: str, color: tuple[int, int, int], p: np.ndarray | None = None) -> Any:
    place = np.zeros((1, 3)) if p is None else p[None]
    return rr.Points3D(place, radii=rr.Radius.ui_points(1.0), colors=color, labels=[safe(text)], show_labels=True)


def _surface(mesh: Mesh) -> Any:
    """Return a shaded surface: corners apart for a flat one, vertices with normals for a smooth one."""
    corners = mesh.p[mesh.faces]
    v_face = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    if mesh.flat:
        p, faces = corners.reshape(-1, 3), np.arange(3 * len(mesh.faces)).reshape(-1, 3)
        normals = np.repeat(v_face, 3, axis=0)
    else:
        p, faces, normals = mesh.p, mesh.faces, np.zeros_like(mesh.p, dtype=float)
        for corner in range(3):
            np.add.at(normals, mesh.faces[:, corner], v_face)
    normals = normals / np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-300)
    alpha = round(255 * mesh.opacity)
    if isinstance(mesh.color, str):
        return rr.Mesh3D(
            vertex_positions=p,
            triangle_indices=faces,
            vertex_normals=normals,
            albedo_factor=[*PALETTE[mesh.color], alpha],
        )
    colors = color_rows(mesh.color, len(mesh.p))
    colors = colors[mesh.faces].reshape(-1, 3) if mesh.flat else colors
    return rr.Mesh3D(
        vertex_positions=p,
        triangle_indices=faces,
        vertex_normals=normals,
        vertex_colors=np.column_stack([colors, np.full(len(colors), alpha, np.uint8)]),
    )


def _edges(faces: np.ndarray) -> np.ndarray:
    """Return every edge of a triangle mesh once, (e, 2)."""
    return np.unique(np.sort(faces[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1), axis=0)


def affine(primitive: Any) -> Any:
    """Return the primitive with a motion that Rerun can take as a pose; a projective 4x4 is applied to the points."""
    T = primitive.T_world_object
    if T is None or np.array_equal(T[3], (0, 0, 0, 1)):
        return primitive
    name = "ends" if isinstance(primitive, Segments) else "p"
    p = getattr(primitive, name)
    p_h = np.concatenate([p, np.ones((*p.shape[:-1], 1))], -1) @ T.T
    return replace(primitive, T_world_object=None, **{name: p_h[..., :3] / p_h[..., 3:]})
