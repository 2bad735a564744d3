"""What one stage looks like: the street, the camera with its pane, the followed point and its
ray.
"""

import functools

import numpy as np

from lessons.pinhole import charts, pane
from lessons.pinhole.captions import PinholeLook, caption, depth, whole_pixels
from lessons.pinhole.shot import EDGES
from workbench.data.views.street import street
from workbench.geometry.cameras import camera_center
from workbench.geometry.motions import apply, inverse
from workbench.geometry.polylines import between, segments
from workbench.numerals import coordinates
from workbench.scene import (
    PALETTE,
    Axes,
    Camera,
    Field,
    Label,
    Mesh,
    Picture,
    Points,
    Primitive,
    Role,
    Scene,
    Segments,
    color_rows,
    dashed,
)

FAR = 30.0  # metres that a ray is drawn
CANDIDATES = np.array([2.0, 4.0, 8.0, 16.0])  # depths marked on the ray back
UP = np.array([0.0, 0.0, 1.0])
GROUND = 0.4  # opacity, so that the floor is dark where the page is


def draw(look: PinholeLook) -> Scene:
    """Return the picture of one stage."""
    shot = look.subject
    state = look.now.now
    k = look.subject.k
    T_world_camera = inverse(shot.T_camera_world)
    glass = pane.standing(look)
    w, h = glass.size
    away = look.params.pane * look.params.dolly
    p = state.p_world[k]
    scene: dict[str, Primitive] = {
        **scenery(),
        "camera": Camera(shot.K, w, h, T_world_camera, away, color="neutral", name="camera"),
        "picture": glass,
        "points": Points(state.p_world, _point_color(look), 0.07, name="points of the street"),
        "followed": Points(p[None], "highlight", 0.14, name="followed point"),
        "followed/name": Label(shot.name, p + 0.4 * UP, "highlight"),
        **_followed_ray(look),
        "caption": caption(look),
        **charts.charts(look),
        **charts.tables(look),
    }
    if look.params.heights:
        scene |= _triangles(look, glass)
    if state.stage == "camera":
        scene |= _legs(look, T_world_camera) | _origin(look, T_world_camera)
    if state.stage in ("divide", "distort", "pixels"):
        scene |= _rays(look) | pane.landed(look, glass)
    if state.stage == "distort":
        scene |= pane.bent_grid(look, glass)
    if state.stage == "pixels":
        scene |= pane.measured(look, glass) | pane.vanishing(look, glass)
    if state.stage == "back":
        scene |= _back(look)
    return scene


@functools.cache
def scenery() -> dict[str, Primitive]:
    """Return what stands in the street, the same objects at each step."""
    scene = street()
    meshes = {}
    others = [name for name in scene.solids if name != "ground"]
    for path, names in {"ground": ["ground"], "street": others}.items():
        solids = [scene.solids[name] for name in names]
        p = np.concatenate([solid.p_world[solid.faces].reshape(-1, 3) for solid in solids])
        colors = np.concatenate([np.repeat(solid.colors, 3, axis=0) for solid in solids])
        faces = np.arange(len(p), dtype=np.intp).reshape(-1, 3)
        opacity = GROUND if path == "ground" else 1.0
        meshes[path] = Mesh(p, faces, colors, opacity=opacity, flat=True, name=path)
    return {**meshes, "rails": Segments(scene.rails, color_rows("neutral", 2), 3, name="rails")}


def _point_color(look: PinholeLook):
    if look.now.now.stage != "camera":
        return "target"
    z = look.now.now.p_camera[:, 2]
    span = np.nanpercentile(z[z > 0], 90) if (z > 0).any() else 1.0
    return Field(np.where(z > 0, z, np.nan), 0.0, float(span), "Depth Z (grey: behind)", "m")


def _followed_ray(look: PinholeLook) -> dict[str, Primitive]:
    """Return the ray of the followed point, and where it pierces the pane while that is only
    seen.
    """
    shot = look.subject
    state = look.now.now
    k = look.subject.k
    p = state.p_world[k]
    C = camera_center(shot.T_camera_world)
    z = float(apply(shot.T_camera_world, p)[2])
    v = (p - C) / z if z else p - C  # one metre of depth
    through = state.stage in ("world", "camera") or np.isfinite(state.xy[k]).all()
    away = look.params.pane * look.params.dolly
    start = C + away * v if z < 0 and through and state.stage != "world" else C
    parts: dict[str, Primitive] = {
        "ray": Segments(between(start, p), "highlight", 4, name="its ray")
    }
    if look.params.z and z > 0:
        beyond = np.stack([p, C + max(FAR, 1.2 * z) * v])
        parts["ray/beyond"] = dashed(beyond, "highlight", dash=0.25, width=2.0, opacity=0.7)
    if state.stage in ("world", "camera") and z > 0 and np.isfinite(shot.uv[k]).all():
        glass = pane.standing(look)
        parts |= pane.dot(glass, shot.uv[k], ringed=bool(look.params.z))
    return parts


def _legs(look: PinholeLook, T_world_camera: np.ndarray) -> dict[str, Primitive]:
    """Lead from the camera to the point along its axes, and to where the calculation says it is."""
    k = look.subject.k
    true = apply(look.subject.T_camera_world, look.now.now.p_world[k])
    got = look.now.now.p_camera[k]
    if np.allclose(got, true):
        return _ways("ways", true, ("z", "x", "y"), name="X, Y and Z", T=T_world_camera)
    truth: tuple[Role, Role, Role] = ("truth", "truth", "truth")
    wrong: tuple[Role, Role, Role] = ("wrong", "wrong", "wrong")
    return _ways("ways", true, truth, name="the true way", T=T_world_camera) | _ways(
        "calculated", got, wrong, name="the calculated way", T=T_world_camera
    )


def _ways(
    path: str, p_camera: np.ndarray, roles: tuple[Role, Role, Role], *, name: str, T: np.ndarray
) -> dict[str, Primitive]:
    """Lead from the camera to a point along the camera's axes: Z first, then X, then Y."""
    x, y, z = p_camera
    corners = np.array([[0.0, 0, 0], [0, 0, z], [x, 0, z], [x, y, z]])
    colors = np.array([PALETTE[role] for role in roles], np.uint8)
    parts: dict[str, Primitive] = {path: Segments(segments(corners), colors, 4, T, name=name)}
    for i, (role, axis, way) in enumerate(zip(roles, "ZXY", (z, x, y), strict=True)):
        at = corners[i : i + 2].mean(axis=0)
        if axis == "Z":  # before the camera, and not so far behind it that nobody sees it
            at = np.array([0.0, 0.0, max(z / 3, -2.5)])
        parts[f"{path}/{axis}"] = Label(f"{axis} = {depth(way)}", at, role, T)
    return parts


def _origin(look: PinholeLook, T_world_camera: np.ndarray) -> dict[str, Primitive]:
    """Return both frames, and the one line between them that is named from either end."""
    T = look.subject.T_camera_world
    C = camera_center(T)
    return {
        "frames/camera": Axes(T_world_camera, 0.8),
        "frames/world": Axes(None, 0.8),
        "origin": Segments(between(C, np.zeros(3)), "highlight", 6, name="camera to origin"),
        "origin/mark": Points(np.zeros((1, 3)), "highlight", 0.1, name="origin of the world"),
        "origin/t": Label(
            f"origin: t = {coordinates(T[:3, 3], 2)} m, in camera axes", -0.3 * UP, "highlight"
        ),
        "origin/C": Label(
            f"camera: C = {coordinates(C, 2)} m, in world axes", C + 0.5 * UP, "highlight"
        ),
    }


def _rays(look: PinholeLook) -> dict[str, Primitive]:
    seen = np.isfinite(look.now.now.xy).all(axis=1)
    if not seen.any():
        return {}
    rays = between(camera_center(look.subject.T_camera_world), look.now.now.p_world[seen])
    return {"rays": Segments(rays, "correspondence", 1.0, opacity=0.5, name="all rays")}


def _triangles(look: PinholeLook, glass: Picture) -> dict[str, Primitive]:
    """Return the rays to the foot and top of the crate and of the tower, and their heights on
    the pane.
    """
    shot = look.subject
    C = camera_center(shot.T_camera_world)
    parts: dict[str, Primitive] = {}
    roles: tuple[Role, ...] = ("target", "source")
    for name, edge, role in zip(("crate", "tower"), EDGES, roles, strict=True):
        height = getattr(shot, name)
        if not np.isfinite(height):
            continue
        corners = np.stack([C, *edge])
        parts[f"{name}/rays"] = Mesh(corners, np.array([[0, 1, 2]], np.intp), role, opacity=0.25)
        parts[f"{name}/edges"] = Segments(segments(corners, closed=True), role, 3, name=name)
        feet, tops = pane.seen_at(glass, shot, edge)
        parts[f"{name}/height"] = Segments(between(feet, tops), role, 8)
        parts[f"{name}/px"] = Label(whole_pixels(height).text, tops + 0.15 * UP, role)
    return parts


def _back(look: PinholeLook) -> dict[str, Primitive]:
    """Return the ray of the followed pixel, and where pixels with depths come from."""
    state, k = look.now.now, look.subject.k
    parts: dict[str, Primitive] = {
        "center": Points(state.p_center[None], "source", 0.08),
        "center/name": Label("C", state.p_center + 0.3 * UP, "source"),
    }
    returned = np.linalg.norm(np.nan_to_num(state.p_back, nan=np.inf), axis=1) < 1e4
    if returned.any():
        parts["back"] = Points(state.p_back[returned], "source", 0.09, name="from pixel and depth")
        wrong = np.linalg.norm(state.p_back - state.p_world, axis=1) > 1e-6
        if (returned & wrong).any():
            ends = between(state.p_world, state.p_back)[returned & wrong]
            parts["back errors"] = Segments(ends, "wrong", 2, name="error")
    if not returned[k]:
        return parts
    z = float(state.p_camera[k, 2])
    v = (state.p_back[k] - state.p_center) / z  # one metre of depth
    reach = max(FAR, 1.2 * z)
    ahead = state.p_center, state.p_center + reach * v
    parts["ray"] = Segments(between(*ahead), "highlight", 4, name="the pixel's ray")
    behind = np.stack([state.p_center, state.p_center - 0.5 * FAR * v])
    parts["ray/behind"] = dashed(behind, "highlight", dash=0.25, width=2.0, opacity=0.7)
    marks = state.p_center + CANDIDATES[:, None] * v
    parts["candidates"] = Points(marks, "other", 0.13, name="other depths")
    for i, mark in enumerate(marks):
        if abs(CANDIDATES[i] / z - 1) < 0.1:  # the followed point's name stands there
            continue
        parts[f"candidates/{i}"] = Label(f"{CANDIDATES[i]:g} m", mark + 0.25 * UP, "other")
    if np.isfinite(state.uv[k]).all():
        parts |= pane.dot(pane.standing(look), state.uv[k], ringed=True)
    return parts
