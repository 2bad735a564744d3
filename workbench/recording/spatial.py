"""How each primitive in space is said to Rerun, in aspects that change independently of each other.

A moving cloud changes only its pose, classes that change send only ids, and so on: a sink keeps
every aspect that it has sent, and sends one again when a value of it is not the same any more.
"""

from collections.abc import Callable, Iterator, Mapping
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
    same,
)

FADED = (168, 172, 178)
"""What faint points and lines are mixed with, on a white and on a black ground: Rerun draws them
without transparency.
"""


@dataclass(frozen=True, eq=False)
class Aspect:
    """Something about an entity: how it is said, and the values it depends on.

    Args:
        make: Makes Rerun's archetype, or a list of them, of the values.
        values: By the names that `make` has for them; compared by `workbench.scene.same`.
        suffix: Behind the path of the entity, `/image` for one below it.
    """

    make: Callable[..., Any]
    values: Mapping[str, Any]
    suffix: str = ""

    @property
    def name(self) -> str:
        """Its name among the aspects of its entity: what says it, and of what."""
        return f"{self.make.__qualname__} {' '.join(self.values)} {self.suffix}"

    def same(self, other: "Aspect") -> bool:
        """Tell whether an aspect of this name would say the same."""
        return same(self.values, other.values)

    def say(self) -> list[Any]:
        """Return the archetypes."""
        made = self.make(**self.values)
        return made if isinstance(made, list) else [made]


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
    yield Aspect(rr.Points3D.from_fields, {"positions": points.p})
    yield Aspect(rr.Points3D.from_fields, {"radii": points.radius, "show_labels": False})
    yield _colors(points, rr.Points3D, numbers)
    yield pose(points.T_world_object)


@aspects.register
def _segments(primitive: Segments, numbers: ClassNumbers) -> Iterator[Aspect]:
    segments = affine(primitive)
    yield Aspect(rr.LineStrips3D.from_fields, {"strips": segments.ends})
    yield _width(segments.width)
    yield _colors(segments, rr.LineStrips3D, numbers)
    yield pose(segments.T_world_object)


@aspects.register
def _mesh(primitive: Mesh, numbers: ClassNumbers) -> Iterator[Aspect]:
    mesh = affine(primitive)
    if mesh.wireframe:
        yield Aspect(_wires, {"p": mesh.p, "faces": mesh.faces})
        yield _width(1.0)
        role = mesh.color if isinstance(mesh.color, str) else "neutral"
        yield Aspect(
            _painted, {"archetype": rr.LineStrips3D, "color": role, "opacity": mesh.opacity}
        )
    else:
        # Rerun would multiply both's colours
        make = _surface if isinstance(mesh.color, str) else _coloured_surface
        yield Aspect(make, {"mesh": replace(mesh, T_world_object=None)})
    yield pose(mesh.T_world_object)


@aspects.register
def _axes(axes: Axes, numbers: ClassNumbers) -> Iterator[Aspect]:
    yield Aspect(_arrows, {"length": axes.length, "opacity": axes.opacity})
    if axes.name:
        yield Aspect(_name_tag, {"text": axes.name, "color": "neutral", "p": np.zeros(3)})
    yield pose(axes.T_world_object)


@aspects.register
def _camera(camera: Camera, numbers: ClassNumbers) -> Iterator[Aspect]:
    yield Aspect(_frustum, {"camera": replace(camera, T_world_object=None, image=None)})
    yield pose(camera.T_world_object)
    if camera.image is not None:
        yield Aspect(encoded, {"image": camera.image}, IMAGE)


@aspects.register
def _label(label: Label, numbers: ClassNumbers) -> Iterator[Aspect]:
    yield Aspect(_name_tag, {"text": label.text, "color": label.color, "p": label.p})
    yield pose(label.T_world_object)


@aspects.register
def _picture(picture: Picture, numbers: ClassNumbers) -> Iterator[Aspect]:
    yield Aspect(_plane, {"picture": replace(picture, T_world_object=None)})
    yield pose(picture.T_world_object)


def pose(T_world_object: np.ndarray | None) -> Aspect:
    """Return where a primitive is."""
    T = np.eye(4) if T_world_object is None else T_world_object
    return Aspect(rr.Transform3D, {"translation": T[:3, 3], "mat3x3": T[:3, :3]})


def _width(pixels: float) -> Aspect:
    # negative: of the screen
    return Aspect(rr.LineStrips3D.from_fields, {"radii": -pixels / 2, "show_labels": False})


def _colors(primitive: Points | Segments, archetype: Any, numbers: ClassNumbers) -> Aspect:
    """Return how points or segments are coloured: by class ids if they have classes."""
    color, opacity = primitive.color, primitive.opacity
    if isinstance(color, Classes):
        return Aspect(archetype.from_fields, {"class_ids": numbers.ids(color, opacity)})
    return Aspect(_painted, {"archetype": archetype, "color": color, "opacity": opacity})


def _painted(archetype: Any, color: Color, opacity: float) -> Any:
    """Return one colour for all where all have the same, else one each."""
    return archetype.from_fields(
        colors=_faded(color_rows(color, 1 if isinstance(color, str) else 0), opacity)
    )


def _faded(colors: np.ndarray, opacity: float) -> np.ndarray:
    if opacity >= 1.0:
        return colors.astype(np.uint8)
    return (colors * opacity + np.array(FADED) * (1.0 - opacity)).round().astype(np.uint8)


def _name_tag(text: str, color: Role, p: np.ndarray) -> Any:
    looks = {"radii": rr.Radius.ui_points(1.0), "colors": PALETTE[color], "show_labels": True}
    return rr.Points3D(p[None], labels=[safe(text)], **looks)


def _arrows(length: float, opacity: float) -> Any:
    colors = np.array([PALETTE[role] for role in ("x", "y", "z")])
    return rr.Arrows3D(vectors=np.eye(3) * length, colors=_faded(colors, opacity))


def _frustum(camera: Camera) -> Any:
    return rr.Pinhole(
        image_from_camera=camera.K,
        resolution=[camera.width, camera.height],
        camera_xyz=rr.ViewCoordinates.RDF,
        image_plane_distance=camera.depth,
        color=_faded(np.array(PALETTE[camera.color]), camera.opacity),
        line_width=-1.5,  # negative: in pixels of the screen
    )


def _plane(picture: Picture) -> Any:
    image = picture.rgb()
    width = picture.width or 1.0
    x = width / 2
    y = width / 2 * image.shape[0] / image.shape[1]
    return rr.Mesh3D(
        vertex_positions=[[-x, -y, 0], [x, -y, 0], [x, y, 0], [-x, y, 0]],
        triangle_indices=[[0, 1, 2], [0, 2, 3]],
        vertex_texcoords=[[0, 0], [1, 0], [1, 1], [0, 1]],
        albedo_texture=np.ascontiguousarray(texture(image)),
        albedo_factor=[255, 255, 255, round(255 * picture.opacity)],
    )


def _surface(mesh: Mesh, **colors: Any) -> Any:
    """Return a shaded surface: corners apart for a flat one, vertices with normals for smooth."""
    corners = mesh.p[mesh.faces]
    v_face = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    if mesh.flat:
        p = corners.reshape(-1, 3)
        faces = np.arange(3 * len(mesh.faces)).reshape(-1, 3)
        normals = np.repeat(v_face, 3, axis=0)
    else:
        p = mesh.p
        faces = mesh.faces
        normals = np.zeros_like(mesh.p, dtype=float)
        for corner in range(3):
            np.add.at(normals, mesh.faces[:, corner], v_face)
    normals = normals / np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-300)
    if isinstance(mesh.color, str):
        colors = {"albedo_factor": [*PALETTE[mesh.color], round(255 * mesh.opacity)]}
    return rr.Mesh3D(vertex_positions=p, triangle_indices=faces, vertex_normals=normals, **colors)


def _coloured_surface(mesh: Mesh) -> Any:
    colors = color_rows(mesh.color, len(mesh.p))
    colors = colors[mesh.faces].reshape(-1, 3) if mesh.flat else colors
    alpha = np.full(len(colors), round(255 * mesh.opacity), np.uint8)
    return _surface(mesh, vertex_colors=np.column_stack([colors, alpha]))


def _wires(p: np.ndarray, faces: np.ndarray) -> Any:
    """Return every edge of a triangle mesh once."""
    edges = np.unique(np.sort(faces[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1), axis=0)
    return rr.LineStrips3D.from_fields(strips=p[edges])


def affine(primitive: Any) -> Any:
    """Return the primitive with a pose for Rerun; a projective 4x4 is applied to the points."""
    T = primitive.T_world_object
    if T is None or np.array_equal(T[3], (0, 0, 0, 1)):
        return primitive
    name = "ends" if isinstance(primitive, Segments) else "p"
    p = getattr(primitive, name)
    p_h = np.concatenate([p, np.ones((*p.shape[:-1], 1))], -1) @ T.T
    return replace(primitive, T_world_object=None, **{name: p_h[..., :3] / p_h[..., 3:]})
