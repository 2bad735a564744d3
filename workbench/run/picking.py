"""What a click in the scene means: the point, vertex or pixel nearest to the ray behind the
cursor.
"""

from typing import Any

import numpy as np

from workbench.knobs import Pick, fields_of
from workbench.scene import Mesh, Picture, Points, Primitive, Scene

WIDEST = np.radians(2.0)  # a click further than this from every point means none of them


def picked_params(
    params: Any, scene: Scene, p_origin: np.ndarray, *, v_ray: np.ndarray
) -> dict[str, Any]:
    """Return the params that a click sets: the first field with a Pick whose primitive is hit;
    nothing where none is.

    A field that holds several indices keeps its latest ones: the new one comes last, the oldest
    goes.
    """
    for field in fields_of(type(params)):
        pick = field.knob.by
        target = scene.get(pick.path) if isinstance(pick, Pick) else None
        hit = None if target is None else picked(target, p_origin, v_ray)
        if hit is not None:
            several = field.kind == "ints" and isinstance(hit, int)
            return {field.name: (*getattr(params, field.name)[1:], hit) if several else hit}
    return {}


def picked(
    primitive: Primitive, p_origin: np.ndarray, v_ray: np.ndarray
) -> int | tuple[int, int] | None:
    """Return the index of the picked point or vertex, the pixel (u, v) of a picture in space, or
    None.

    Args:
        primitive: What may be picked: Points, Mesh, or a Picture with a width.
        p_origin: (3,) the eye, in the world.
        v_ray: (3,) the direction of the click, any length.

    Note:
        Among the points within two degrees of the ray, the nearest to the eye wins unless another
        is four times nearer to the ray; a mesh's hidden vertices lose to those in front.
    """
    v_ray = v_ray / np.linalg.norm(v_ray)
    if not pickable(primitive):
        return None
    if isinstance(primitive, (Points, Mesh)):
        return _nearest(_in_world(primitive.p, primitive.T_world_object), p_origin, v_ray)
    return _pixel(primitive, p_origin, v_ray) if isinstance(primitive, Picture) else None


def pickable(primitive: Primitive) -> bool:
    """Tell whether a click can pick something of a primitive: Points, a Mesh, or a Picture that
    stands in space.
    """
    return isinstance(primitive, (Points, Mesh)) or (
        isinstance(primitive, Picture) and primitive.width is not None
    )


def _nearest(p_world: np.ndarray, p_origin: np.ndarray, v_ray: np.ndarray) -> int | None:
    v = p_world - p_origin
    along = v @ v_ray
    off = np.linalg.norm(v - along[:, None] * v_ray, axis=1)
    angle = np.where(along > 0, np.arctan2(off, along), np.inf)
    if not len(angle) or angle.min() > WIDEST:
        return None
    near = np.flatnonzero(angle <= max(4.0 * angle.min(), 0.25 * WIDEST))
    front = near[along[near] <= along[near].min() * 1.05]
    return int(front[np.argmin(angle[front])])


def _pixel(picture: Picture, p_origin: np.ndarray, v_ray: np.ndarray) -> tuple[int, int] | None:
    T_world_object = np.eye(4) if picture.T_world_object is None else picture.T_world_object
    R = T_world_object[:3, :3]
    p_centre = T_world_object[:3, 3]
    slope = v_ray @ R[:, 2]
    if abs(slope) < 1e-9:
        return None
    distance = (p_centre - p_origin) @ R[:, 2] / slope
    x, y, _ = R.T @ (p_origin + distance * v_ray - p_centre)
    h, w = picture.rgb().shape[:2]
    scale = w / (picture.width or 1.0)
    u, v = round(x * scale + (w - 1) / 2), round(y * scale + (h - 1) / 2)
    return (u, v) if distance > 0 and 0 <= u < w and 0 <= v < h else None


def _in_world(p: np.ndarray, T_world_object: np.ndarray | None) -> np.ndarray:
    return p if T_world_object is None else p @ T_world_object[:3, :3].T + T_world_object[:3, 3]
