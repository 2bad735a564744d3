"""What one stage looks like: the street, the camera with its picture, the points, and the followed one's numbers."""

import functools
import math

import numpy as np

from lessons.pinhole.shot import FACTORS
from lessons.pinhole.state import State, name_of
from lessons.pinhole.words import caption, depth, pair, triple
from workbench.algorithms import pinhole
from workbench.data.street import street
from workbench.geometry.cameras import camera_center, depths
from workbench.geometry.distortion import Distortion, distort, invertible_radius
from workbench.geometry.motions import apply, inverse
from workbench.geometry.polylines import segments
from workbench.numerals import fixed, pixels
from workbench.scene import (
    Axes,
    Camera,
    Classes,
    Curve,
    Field,
    Label,
    Mesh,
    Picture,
    Points,
    Primitive,
    Scalar,
    Scene,
    Segments,
    Table,
)

FAR = 30.0  # metres that a ray is drawn
CANDIDATES = np.array([2.0, 4.0, 8.0, 16.0])  # depths marked on the ray back
WIDEST = 20.0  # metres from the middle of the plane Z = 1 m
STEEL = (110, 118, 129)


def draw(state: State) -> Scene:
    """Return the picture of one stage."""
    now, shot, k = state.now, state.shot, state.params.point
    T_world_camera = inverse(shot.T_camera_world)
    h, w = shot.picture.shape[:2]
    scene: dict[str, Primitive] = {
        **scenery(),
        "camera": Camera(shot.K, w, h, T_world_camera, 1.0, state.picture, "neutral", name="true camera"),
        "points": Points(now.p_world, _point_color(state), 0.06, name="points of the street"),
        "followed": Points(now.p_world[k : k + 1], "highlight", 0.12, name="the followed point"),
        "followed label": Label(name_of(k), now.p_world[k] + np.array([0.0, 0.0, 0.35]), "highlight"),
        "picture": Picture(state.picture, "Picture: photograph grey, calculated orange, followed point purple"),
        "error": Scalar(state.error, "median pixel error", "Error to the true picture", "px", "truth"),
        "caption": caption(state),
        **_tables(state),
        **_lens_curves(shot.lens, float(np.linalg.norm(shot.xy[k])), state.now.stage),
    }
    if state.params.dolly != 1:
        scene["gap"] = Curve(
            np.log10(FACTORS), np.log10(shot.gaps), "largest gap", "Gap to orthographic", "log10 of dolly",
            "log10 of px", "truth", marks=(float(np.log10(state.params.dolly)),),
        )  # fmt: skip
    stage = {"camera": _camera, "divide": _divide, "distort": _distort, "pixels": _pixels, "back": _back}
    if now.stage in stage:
        scene["camera frame"] = Axes(T_world_camera, 0.8, name="camera frame: x right, y down, z forward")
        scene |= stage[now.stage](state, T_world_camera)
    return scene


@functools.cache
def scenery() -> dict[str, Primitive]:
    """Return what stands in the street, the same objects at each step."""
    scene = street()
    meshes = {}
    for path, names in {"ground": ["ground"], "street": [name for name in scene.solids if name != "ground"]}.items():
        p = np.concatenate([scene.solids[name].p_world[scene.solids[name].faces].reshape(-1, 3) for name in names])
        colors = np.concatenate([np.repeat(scene.solids[name].colors, 3, axis=0) for name in names])
        meshes[path] = Mesh(p, np.arange(len(p)).reshape(-1, 3), colors, flat=True, name=path)
    steel = np.tile(np.array([STEEL], np.uint8), (2, 1))
    return {**meshes, "rails": Segments(scene.rails, steel, 3, name="rails")}


def _point_color(state: State):
    if state.now.stage != "camera":
        return "target"
    z = state.now.p_camera[:, 2]
    span = np.nanpercentile(z[z > 0], 90) if (z > 0).any() else 1.0
    return Field(np.where(z > 0, z, np.nan), 0.0, float(span), "Depth Z (grey: behind)", "m")


def _camera(state: State, T_world_camera: np.ndarray) -> dict[str, Primitive]:
    """Lead from the camera to the followed point along the camera's own axes."""
    k = state.params.point
    x, y, z = apply(state.shot.T_camera_world, state.now.p_world[k])
    corners = np.array([[0.0, 0, 0], [0, 0, z], [x, 0, z], [x, y, z]])
    names = (f"depth Z = {fixed(z, 2)} m", f"X = {fixed(x, 2)} m", f"Y = {fixed(y, 2)} m")
    return {
        "ways": Segments(
            segments(corners), Classes(np.arange(3), ("z", "x", "y"), names), 4, T_world_camera, name="X, Y, Z"
        ),
    }


def _divide(state: State, T_world_camera: np.ndarray) -> dict[str, Primitive]:
    """Show all rays and where they cross the plane one metre in front."""
    xy, k = state.now.xy, state.params.point
    seen = _drawable(xy)
    origin = np.broadcast_to(T_world_camera[:3, 3], state.now.p_world.shape)
    rays = np.stack([origin, state.now.p_world], axis=1)
    parts: dict[str, Primitive] = {"plane": _on_plane(xy[seen], "source", T_world_camera, "on the plane Z = 1 m")}
    if seen.any():
        parts["rays"] = Segments(rays[seen], "correspondence", 1.0, opacity=0.5, name="rays")
    parts["followed ray"] = Segments(rays[k : k + 1], "highlight", 4, name="the followed ray")
    return parts | _chosen_on_plane(xy, k, T_world_camera)


def _distort(state: State, T_world_camera: np.ndarray) -> dict[str, Primitive]:
    """Show how far the lens moves each point on the plane."""
    xy, xy_bent, k = state.now.xy, state.now.xy_bent, state.params.point
    seen = _drawable(xy_bent) & _drawable(xy)
    moved = np.linalg.norm(xy_bent - xy, axis=1) * state.shot.K[0, 0]
    top = float(moved[seen].max(initial=1.0))
    color = Field(moved[seen], 0.0, top, "Moved by the lens", "px")
    parts: dict[str, Primitive] = {"plane": _on_plane(xy_bent[seen], color, T_world_camera, "after the lens")}
    if seen.any():
        ends = np.stack([_lift(xy[seen]), _lift(xy_bent[seen])], axis=1)
        parts["moves"] = Segments(ends, "correspondence", 2, T_world_camera, name="from ideal to distorted")
    return parts | _chosen_on_plane(xy_bent, k, T_world_camera)


def _pixels(state: State, T_world_camera: np.ndarray) -> dict[str, Primitive]:
    """Show which points are in the picture, on the picture."""
    uv, k = state.now.uv, state.params.point
    h, w = state.shot.picture.shape[:2]
    xy = pinhole.off_pixels(uv, state.shot.K)  # where on the true camera's picture these pixels are
    seen = _drawable(xy)
    inside = np.all((uv[seen] > -0.5) & (uv[seen] < np.array([w, h]) - 0.5), axis=1)
    color = Classes(np.where(inside, 0, 1), ("source", "correspondence"), ("in the picture", "outside it"))
    return {"plane": _on_plane(xy[seen], color, T_world_camera, "pixels")} | _chosen_on_plane(xy, k, T_world_camera)


def _back(state: State, T_world_camera: np.ndarray) -> dict[str, Primitive]:
    """Show the ray of the followed pixel, and where pixels with depths come from."""
    now, k = state.now, state.params.point
    parts: dict[str, Primitive] = {
        "center": Points(now.p_center[None], "source", 0.1, name="calculated camera centre"),
        "center label": Label("C", now.p_center + np.array([0.0, 0.0, 0.3]), "source"),
    }
    found = np.linalg.norm(np.nan_to_num(now.p_back, nan=np.inf), axis=1) < 1e4
    if found.any():
        parts["back"] = Points(now.p_back[found], "source", 0.075, name="from pixel and depth")
        wrong = np.linalg.norm(now.p_back - now.p_world, axis=1) > 1e-6
        if (found & wrong).any():
            ends = np.stack([now.p_world, now.p_back], axis=1)[found & wrong]
            parts["back errors"] = Segments(ends, "wrong", 2, name="error")
    if found[k]:
        z = depths(now.p_world[k : k + 1], state.shot.T_camera_world)[0]
        v = (now.p_back[k] - now.p_center) / z  # one metre of depth
        reach = max(FAR, 1.2 * z)
        parts["followed ray"] = Segments(
            np.stack([now.p_center, now.p_center + reach * v])[None], "highlight", 4, name="the followed ray"
        )
        marks = now.p_center + CANDIDATES[:, None] * v
        parts["candidates"] = Points(marks, "other", 0.09, name="2, 4, 8, 16 m deep: the same pixel")
    return parts


def _lift(xy: np.ndarray) -> np.ndarray:
    return np.column_stack([xy, np.ones(len(xy))])


def _drawable(xy: np.ndarray) -> np.ndarray:
    """Say which points of the plane are worth a place in the scene: known, and not miles away."""
    return np.abs(np.nan_to_num(xy, nan=np.inf)).max(axis=1) < WIDEST


def _on_plane(xy: np.ndarray, color, T_world_camera: np.ndarray, name: str) -> Points:
    return Points(_lift(xy), color, 0.013, T_world_camera, name=name)


def _chosen_on_plane(xy: np.ndarray, k: int, T_world_camera: np.ndarray) -> dict[str, Primitive]:
    if not _drawable(xy)[k]:
        return {}
    return {
        "followed on plane": Points(_lift(xy[k : k + 1]), "highlight", 0.025, T_world_camera, name="its place there")
    }


def _lens_curves(lens: Distortion, r_chosen: float, stage: pinhole.Stage) -> dict[str, Primitive]:
    """Draw distorted over ideal radius along +x; where it turns down the lens folds."""
    r = np.linspace(0.0, 1.4, 57)
    bent = distort(np.column_stack([r, np.zeros_like(r)]), *lens)[:, 0]
    fold = invertible_radius(lens)
    marks = tuple(float(mark) for mark in (r_chosen, fold) if mark < r[-1])
    chart, x_label, y_label = "Lens: radius on the plane Z = 1", "ideal radius", "distorted radius"
    return {
        "no lens": Curve(r, r, "no lens", chart, x_label, y_label, "correspondence"),
        "lens": Curve(r, bent, "this lens", chart, x_label, y_label, "truth", marks=marks),
    }


def _tables(state: State) -> dict[str, Primitive]:
    """Return the followed point's journey so far, and what can be measured of the camera and in its picture."""
    shot, now, k = state.shot, state.now, state.params.point
    rows = [("in the world", f"{triple(now.p_world[k])} m")]
    if now.reached("camera"):
        p = now.p_camera[k]
        rows += [
            ("in the camera frame", f"{triple(p)} m"),
            ("depth Z · ray length", f"{depth(p[2])} · {depth(float(np.linalg.norm(p)))}"),
        ]
    if now.reached("divide"):
        rows.append(("x, y = X/Z, Y/Z", pair(now.xy[k], 4)))
    if now.reached("distort"):
        rows.append(("after the lens", pair(now.xy_bent[k], 4)))
    if now.reached("pixels"):
        rows += [("pixel (u, v)", pair(now.uv[k], 1)), ("true pixel", pair(shot.uv[k], 1))]
    if now.reached("back"):
        rows.append(("back in the world", triple(now.p_back[k]) + " m" * bool(np.isfinite(now.p_back[k]).all())))
    h, w = shot.picture.shape[:2]
    ball = "the ball's outline" + ", without the lens" * any(shot.lens)
    measured = (
        ("camera centre C = −Rᵀt", f"{triple(camera_center(shot.T_camera_world))} m"),
        ("t of T_camera_world", f"{triple(shot.T_camera_world[:3, 3])} m"),
        ("focal length f", f"{fixed(shot.K[0, 0], 1)} px"),
        ("principal point", pair(shot.K[:2, 2], 1)),
        ("middle of the picture", pair(np.array([w - 1, h - 1]) / 2, 1)),
        ("the rails run towards", pair(shot.vanishing, 1)),
        ("crate, 1 m high", _height(shot.crate)),
        ("tower, 5 m high", _height(shot.tower)),
        (ball, _ratio(shot.ball_ratio)),
    )
    return {
        "point numbers": Table("The followed point", ("stage", name_of(k)), tuple(rows)),
        "camera numbers": Table("The true camera", ("what", "value"), measured),
    }


def _height(height: float) -> str:
    return pixels(height) if math.isfinite(height) else "has no pixel"


def _ratio(ratio: float) -> str:
    return f"{fixed(ratio, 3)} × as long as wide" if math.isfinite(ratio) else "not in the picture"
