"""Makes a viser scene equal to a Scene, sending only what differs from what is shown.

A thing that moved is sent as a pose; a thing that is drawn with the same arrays is not sent again.

What the browser knows of a node outlives the node: viser drops a removal that an addition under the same name follows at
once, and the browser then keeps the pose it has. So a node is replaced under its name without being removed (viser sends
its pose then, whatever it is), and a name whose node was removed is never used again.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
import trimesh
import viser
from trimesh.visual import TextureVisuals
from trimesh.visual.material import PBRMaterial

from workbench.scene import (
    PALETTE,
    Axes,
    Camera,
    Label,
    Mesh,
    Picture,
    Points,
    Scene,
    Segments,
    Spatial,
    color_rows,
    in_space,
    is_rigid,
    same,
    same_but_for_pose,
)
from workbench.viewer.mended import mend_viser, wxyz_of

mend_viser()
ROOT = "/scene/"


@dataclass
class _Node:
    shown: Spatial
    handle: Any
    name: str
    is_away: bool = False
    """Whether it was placed elsewhere than `shown` says."""


class ViserSink:
    """Shows scenes on one client (or a server), by path.

    Args:
        scene: The scene interface of a client or server.
        backdrop: The colour that translucent points and lines are mixed with, since the browser draws them opaque.
    """

    def __init__(self, scene: viser.SceneApi, backdrop: tuple[int, int, int] = (255, 255, 255)):
        self.scene, self.backdrop = scene, backdrop
        self._nodes: dict[str, _Node] = {}
        self._removed: dict[str, int] = {}  # how many nodes of a path are gone, each with a name of its own

    def show(self, scene: Scene) -> None:
        """Make what is shown equal to the spatial part of `scene`."""
        wanted = {path: primitive for path, primitive in scene.items() if in_space(primitive)}
        for path in [path for path in self._nodes if path not in wanted]:
            self._remove(path)
        veiled = False  # by a surface that is new: the browser draws in the order in which things were made
        for path, primitive in wanted.items():
            node = self._nodes.get(path)
            if veiled and node is not None and isinstance(node.shown, Segments | Camera):
                self._remove(path)
            self._show(path, primitive)  # type: ignore[arg-type]
            veiled |= _translucent(primitive) and (node is None or self._nodes[path] is not node)

    def place(self, poses: Mapping[str, np.ndarray]) -> None:
        """Put what is shown elsewhere, by path, for a moment: rigid poses (4, 4) in the world."""
        for path, T_world_object in poses.items():
            node = self._nodes[path]
            node.is_away = True
            _set_pose(node.handle, node.shown, T_world_object)

    def handle(self, path: str) -> Any:
        """Return viser's handle of what is shown at a path, None when there is nothing."""
        node = self._nodes.get(path)
        return node.handle if node else None

    def shown(self) -> dict[str, Spatial]:
        """Return what is shown, by path."""
        return {path: node.shown for path, node in self._nodes.items()}

    def repaint(self, backdrop: tuple[int, int, int]) -> None:
        """Draw everything again before another backdrop."""
        self.backdrop = backdrop
        for node in self._nodes.values():
            node.handle = self._add(node.name, node.shown)

    def _show(self, path: str, wanted: Spatial) -> None:
        node = self._nodes.get(path)
        if node is not None:
            if not node.is_away and same(node.shown, wanted):
                return
            node.is_away = False
            if self._moved(node, wanted) or self._changed(node, wanted):
                node.shown = wanted
                return
            if _parts(node.shown) != _parts(wanted):
                self._remove(path)
        name = node.name if path in self._nodes and node is not None else self._new_name(path)
        self._nodes[path] = _Node(wanted, self._add(name, wanted), name)

    def _remove(self, path: str) -> None:
        self._nodes.pop(path).handle.remove()
        self._removed[path] = self._removed.get(path, 0) + 1

    def _new_name(self, path: str) -> str:
        """Return a name that no node had, and without a parent: poses compose."""
        again = self._removed.get(path, 0)
        return ROOT + path.replace("/", "·") + (f"~{again}" if again else "")

    def _moved(self, node: _Node, wanted: Spatial) -> bool:
        """Set the pose where nothing but a rigid pose differs."""
        if type(node.shown) is not type(wanted) or not (_poseable(node.shown) and _poseable(wanted)):
            return False
        if not same_but_for_pose(node.shown, wanted):
            return False
        _set_pose(node.handle, wanted, wanted.T_world_object)
        return True

    def _changed(self, node: _Node, wanted: Spatial) -> bool:
        """Send only the points or only the colours, where that is all that differs."""
        before = node.shown
        if isinstance(before, Label) and isinstance(wanted, Label):
            node.handle.text = wanted.text
            _set_pose(node.handle, wanted, wanted.T_world_object)
            return True
        if isinstance(before, Points) and isinstance(wanted, Points) and before.radius == wanted.radius:
            p, p_before = _placed(wanted, wanted.p), _placed(before, before.p)
            if len(p) == len(p_before):
                if not (p is p_before or np.array_equal(p, p_before)):
                    node.handle.points = p.astype(np.float32)
                node.handle.colors = self._colors(wanted, len(p))
                _set_pose(node.handle, wanted, wanted.T_world_object)
                return True
        if isinstance(before, Segments) and isinstance(wanted, Segments) and before.width == wanted.width:
            ends = _placed(wanted, wanted.ends)
            if len(ends) == len(before.ends) > 0:
                node.handle.points = ends.astype(np.float32)
                node.handle.colors = self._end_colors(wanted)
                _set_pose(node.handle, wanted, wanted.T_world_object)
                return True
        return False

    def _add(self, name: str, primitive: Spatial) -> Any:
        handle = self._makers()[type(primitive)](name, primitive)
        if (
            isinstance(primitive, Label) or primitive.T_world_object is not None
        ):  # else it has the pose that a node starts with
            _set_pose(handle, primitive, primitive.T_world_object)
        return handle

    def _makers(self) -> dict[type, Callable[[str, Any], Any]]:
        return {
            Points: self._points,
            Segments: self._segments,
            Mesh: self._mesh,
            Axes: self._axes,
            Camera: self._camera,
            Label: self._label,
            Picture: self._picture,
        }

    def _points(self, name: str, points: Points) -> Any:
        return self.scene.add_point_cloud(
            name,
            _placed(points, points.p).astype(np.float32),
            self._colors(points, len(points.p)),
            point_size=points.radius,  # viser's size is a radius
            point_shape="circle",
            point_shading="flat",
            precision="float32",
        )

    def _segments(self, name: str, segments: Segments) -> Any:
        if not len(segments.ends):
            return self.scene.add_frame(name, show_axes=False)
        return self.scene.add_line_segments(
            name,
            _placed(segments, segments.ends).astype(np.float32),
            self._end_colors(segments),
            thickness=segments.width,
            thickness_units="screen",
        )

    def _mesh(self, name: str, mesh: Mesh) -> Any:
        p = _placed(mesh, mesh.p).astype(np.float32)
        if isinstance(mesh.color, str):
            return self.scene.add_mesh_simple(
                name,
                p,
                mesh.faces.astype(np.uint32),
                color=PALETTE[mesh.color],
                wireframe=mesh.wireframe,
                opacity=mesh.opacity if mesh.opacity < 1 else None,
                flat_shading=mesh.flat,
                side="double",
                cast_shadow=False,
                receive_shadow=False,
            )
        colors = np.empty((len(p), 4), np.uint8)
        colors[:, :3], colors[:, 3] = _as_light(color_rows(mesh.color, len(p))), round(255 * mesh.opacity)
        matt = PBRMaterial(  # without a material a GLB is all metal, and shows its surroundings instead of its colours
            metallicFactor=0.0, roughnessFactor=1.0, doubleSided=True, alphaMode="BLEND" if mesh.opacity < 1 else None
        )
        visual = TextureVisuals(material=matt)
        visual.vertex_attributes["color"] = colors
        shape = trimesh.Trimesh(p, mesh.faces, visual=visual, process=False)
        return self.scene.add_mesh_trimesh(name, shape, cast_shadow=False, receive_shadow=False)

    def _axes(self, name: str, axes: Axes) -> Any:
        ends = np.zeros((3, 2, 3), np.float32)
        ends[:, 1] = axes.length * np.eye(3)
        if axes.T_world_object is not None and not is_rigid(axes.T_world_object):
            ends = _placed(axes, ends).astype(np.float32)
        colors = np.array([PALETTE["x"], PALETTE["y"], PALETTE["z"]])
        return self.scene.add_arrows(
            name,
            ends,
            self._faded(colors, axes.opacity),
            shaft_radius=0.018 * axes.length,
            head_radius=0.05 * axes.length,
            head_length=0.15 * axes.length,
        )

    def _camera(self, name: str, camera: Camera) -> Any:
        K, d = camera.K, camera.depth
        corners_uv = np.array(
            [
                [-0.5, -0.5],
                [camera.width - 0.5, -0.5],
                [camera.width - 0.5, camera.height - 0.5],
                [-0.5, camera.height - 0.5],
            ]
        )
        rays = np.column_stack([corners_uv, np.ones(4)]) @ np.linalg.inv(K).T
        corners, centre = d * rays, np.zeros(3)
        rim = np.stack([corners, np.roll(corners, -1, 0)], 1)
        spokes = np.stack([np.broadcast_to(centre, (4, 3)), corners], 1)
        up = corners[:2].mean(0) - 0.12 * (corners[3] - corners[0])
        roof = np.array([[corners[0], up], [up, corners[1]]])
        ends = np.concatenate([rim, spokes, roof])
        color = _as_light(self._faded(np.array(PALETTE[camera.color]), camera.opacity))
        frustum = self.scene.add_line_segments(
            name,
            _placed(camera, ends).astype(np.float32),
            color,
            thickness=2.0,
            thickness_units="screen",
        )
        if camera.image is not None:
            size = corners[2] - corners[0]
            image = camera.image if camera.image.ndim == 3 else np.repeat(camera.image[:, :, None], 3, 2)
            self.scene.add_image(
                name + "/image",
                self._faded(image, camera.opacity),
                float(size[0]),
                float(size[1]),
                position=(corners[0] + corners[2]) / 2,
                cast_shadow=False,
                receive_shadow=False,
            )
        return frustum

    def _label(self, name: str, label: Label) -> Any:
        return self.scene.add_label(name, label.text, font_screen_scale=1.0, anchor="bottom-center")

    def _picture(self, name: str, picture: Picture) -> Any:
        image = self._faded(picture.rgb(), picture.opacity)
        width = picture.width or 1.0
        height = width * image.shape[0] / image.shape[1]
        return self.scene.add_image(name, image, width, height, cast_shadow=False, receive_shadow=False)

    def _colors(self, primitive: Points, n: int) -> np.ndarray:
        if isinstance(primitive.color, str):
            return self._faded(np.array(PALETTE[primitive.color]), primitive.opacity)
        return self._faded(color_rows(primitive.color, n), primitive.opacity)

    def _end_colors(self, segments: Segments) -> np.ndarray:
        if isinstance(segments.color, str):
            rgb = _as_light(self._faded(np.array(PALETTE[segments.color]), segments.opacity))
            return np.broadcast_to(rgb, (len(segments.ends), 2, 3))
        rgb = _as_light(self._faded(color_rows(segments.color, len(segments.ends)), segments.opacity))
        return np.repeat(rgb[:, None], 2, 1)

    def _faded(self, rgb: np.ndarray, opacity: float) -> np.ndarray:
        if opacity >= 1:
            return np.asarray(rgb, np.uint8)
        return (opacity * rgb + (1 - opacity) * np.array(self.backdrop)).round().astype(np.uint8)


def _parts(primitive: Spatial) -> bool:
    """Tell whether a primitive has a node below its own, which would stay when its own is replaced."""
    return isinstance(primitive, Camera) and primitive.image is not None


def _as_light(rgb: np.ndarray) -> np.ndarray:
    """Return sRGB colours as linear light, for which the browser's lines take theirs; else they come out too bright."""
    level = np.asarray(rgb) / 255.0
    light = np.where(level <= 0.04045, level / 12.92, ((level + 0.055) / 1.055) ** 2.4)
    return (255.0 * light).round().astype(np.uint8)


def _translucent(primitive: object) -> bool:
    return isinstance(primitive, Mesh) and primitive.opacity < 1


def _poseable(primitive: Spatial) -> bool:
    return primitive.T_world_object is None or is_rigid(primitive.T_world_object)


def _placed(primitive: Spatial, p: np.ndarray) -> np.ndarray:
    """Return points in the frame of the node: the object's, or the world's where a pose cannot express the motion."""
    T = primitive.T_world_object
    return p if T is None or is_rigid(T) else p @ T[:3, :3].T + T[:3, 3]


def _set_pose(handle: Any, primitive: Spatial, T: np.ndarray | None) -> None:
    if isinstance(primitive, Label):
        handle.position = primitive.p if T is None else T[:3, :3] @ primitive.p + T[:3, 3]
    elif T is None or not is_rigid(T):
        handle.wxyz, handle.position = (1.0, 0.0, 0.0, 0.0), (0.0, 0.0, 0.0)
    else:
        handle.wxyz, handle.position = wxyz_of(T[:3, :3]), T[:3, 3]
