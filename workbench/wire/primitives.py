"""How each primitive is drawn by viser: what it is made of, and where it stands.

A scene is typed as viser's SceneApi, by whose methods and keywords all is said; it is
`writer.PlainScene`, and in tests viser's own.

Everything is drawn in its full colours, in the frame of the primitive: how opaque it is, and before
which backdrop, is the page's affair.
"""

import math
from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from workbench.scene import (
    PALETTE,
    Axes,
    Camera,
    Color,
    Mesh,
    Picture,
    Points,
    Segments,
    Spatial,
    color_rows,
    is_rigid,
)
from workbench.wire.glb import glb_of

if TYPE_CHECKING:
    import viser

Pose = tuple[float, float, float, float, float, float, float]
"""A unit quaternion w, x, y, z and a position, metres."""
AT_ORIGIN: Pose = (1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
NAME = "/n"
"""What a primitive's node is called while it is made; a part of it has a name below."""


def add(scene: "viser.SceneApi", primitive: Spatial) -> None:
    """Add a primitive to a scene of viser, at the origin; a Label and lines without a segment add
    nothing.
    """
    make = _MAKERS.get(type(primitive))
    if make is not None:
        make(scene, primitive)


def pose_of(primitive: Spatial) -> Pose:
    """Return where a primitive stands in the world; one that is not moved rigidly has its motion in
    its points.
    """
    T = primitive.T_world_object
    return AT_ORIGIN if T is None or not is_rigid(T) else (*wxyz_of(T[:3, :3]), *T[:3, 3].tolist())


def place_of(p: np.ndarray, T_world_object: np.ndarray | None) -> Pose:
    """Return where a point (3,) of a frame is in the world, as the pose of what is turned
    nowhere.
    """
    x, y, z = p if T_world_object is None else T_world_object[:3, :3] @ p + T_world_object[:3, 3]
    return (1.0, 0.0, 0.0, 0.0, float(x), float(y), float(z))


def wxyz_of(R: np.ndarray) -> tuple[float, float, float, float]:
    """Return the unit quaternion of a 3x3 rotation, its largest part positive; in plain numbers,
    for speed.

    Reference: S. W. Shepperd, Quaternion from rotation matrix, J. Guidance and Control 1(3), 1978.
    """
    (a, b, c), (d, e, f), (g, h, i) = R.tolist()
    parts = (
        (1 + a + e + i, h - f, c - g, d - b),
        (h - f, 1 + a - e - i, b + d, c + g),
        (c - g, b + d, 1 - a + e - i, f + h),
        (d - b, c + g, f + h, 1 - a - e + i),
    )
    q = max(enumerate(parts), key=lambda part: part[1][part[0]])[1]
    length = math.hypot(*q)
    return q[0] / length, q[1] / length, q[2] / length, q[3] / length


def _points(scene: "viser.SceneApi", points: Points) -> None:
    if not len(points.p):
        return
    scene.add_point_cloud(
        NAME,
        _placed(points, points.p).astype(np.float32),
        _colors(points.color, len(points.p)),
        point_size=points.radius,  # viser's size is a radius
        point_shape="circle",
        point_shading="flat",
        precision="float32",
    )


def _segments(scene: "viser.SceneApi", segments: Segments) -> None:
    if not len(segments.ends):
        return
    colors = _colors(segments.color, len(segments.ends))
    scene.add_line_segments(
        NAME,
        _placed(segments, segments.ends).astype(np.float32),
        colors if colors.ndim == 1 else np.repeat(colors[:, None], 2, axis=1),
        thickness=segments.width,
        thickness_units="screen",
    )


def _mesh(scene: "viser.SceneApi", mesh: Mesh) -> None:
    p = _placed(mesh, mesh.p).astype(np.float32)
    if isinstance(mesh.color, str):
        scene.add_mesh_simple(
            NAME,
            p,
            mesh.faces.astype(np.uint32),
            color=PALETTE[mesh.color],
            wireframe=mesh.wireframe,
            flat_shading=mesh.flat,
            side="double",
            cast_shadow=False,
            receive_shadow=False,
        )
        return
    colors = np.full((len(p), 4), 255, np.uint8)
    colors[:, :3] = as_light(color_rows(mesh.color, len(p)))
    shape = glb_of(p, mesh.faces, colors)
    scene.add_glb(NAME, shape, cast_shadow=False, receive_shadow=False)


def _axes(scene: "viser.SceneApi", axes: Axes) -> None:
    ends = np.zeros((3, 2, 3), np.float32)
    ends[:, 1] = axes.length * np.eye(3)
    scene.add_arrows(
        NAME,
        _placed(axes, ends).astype(np.float32),
        np.array([PALETTE["x"], PALETTE["y"], PALETTE["z"]], np.uint8),
        shaft_radius=0.018 * axes.length,
        head_radius=0.05 * axes.length,
        head_length=0.15 * axes.length,
    )


def _camera(scene: "viser.SceneApi", camera: Camera) -> None:
    corners = _corners(camera)
    rim = np.stack([corners, np.roll(corners, -1, 0)], axis=1)
    spokes = np.stack([np.zeros((4, 3)), corners], axis=1)
    up = corners[:2].mean(0) - 0.12 * (corners[3] - corners[0])
    roof = np.array([[corners[0], up], [up, corners[1]]])
    ends = np.concatenate([rim, spokes, roof])
    scene.add_line_segments(
        NAME,
        _placed(camera, ends).astype(np.float32),
        np.array(PALETTE[camera.color], np.uint8),
        thickness=2.0,
        thickness_units="screen",
    )
    if camera.image is None:
        return
    size = corners[2] - corners[0]
    scene.add_image(
        f"{NAME}/image",
        camera.image if camera.image.ndim == 3 else np.repeat(camera.image[:, :, None], 3, 2),
        float(size[0]),
        float(size[1]),
        position=(corners[0] + corners[2]) / 2,
        cast_shadow=False,
        receive_shadow=False,
    )


def _corners(camera: Camera) -> np.ndarray:
    """Return the corners of a camera's picture at its depth, (4, 3), from the upper left clockwise,
    in its frame.
    """
    right, bottom = camera.width - 0.5, camera.height - 0.5
    uv1 = np.array(
        [[-0.5, -0.5, 1.0], [right, -0.5, 1.0], [right, bottom, 1.0], [-0.5, bottom, 1.0]]
    )
    return camera.depth * uv1 @ np.linalg.inv(camera.K).T


def _picture(scene: "viser.SceneApi", picture: Picture) -> None:
    image = picture.rgb()
    width = picture.width or 1.0
    height = width * image.shape[0] / image.shape[1]
    scene.add_image(NAME, image, width, height, cast_shadow=False, receive_shadow=False)


_MAKERS: "Mapping[type, Callable[[viser.SceneApi, Any], None]]" = {
    Points: _points,
    Segments: _segments,
    Mesh: _mesh,
    Axes: _axes,
    Camera: _camera,
    Picture: _picture,
}


def _colors(color: Color, n: int) -> np.ndarray:
    """Return one colour for all, (3,), or one for each, (n, 3)."""
    return np.array(PALETTE[color], np.uint8) if isinstance(color, str) else color_rows(color, n)


def _placed(primitive: Spatial, p: np.ndarray) -> np.ndarray:
    """Return points in the frame of the node: the object's, or the world's where a pose cannot
    express the motion.
    """
    T = primitive.T_world_object
    return p if T is None or is_rigid(T) else p @ T[:3, :3].T + T[:3, 3]


def as_light(rgb: np.ndarray) -> np.ndarray:
    """Return sRGB colours, uint8, as linear light, for which a surface's file takes its own."""
    level = np.asarray(rgb) / 255.0
    light = np.where(level <= 0.04045, level / 12.92, ((level + 0.055) / 1.055) ** 2.4)
    return (255.0 * light).round().astype(np.uint8)
