"""What one step looks like: the two cameras with their pictures, the cloud so far, and the ray of
the followed pixel.
"""

import functools
import math

import numpy as np

from lessons.disparity.captions import caption
from lessons.disparity.charts import beside
from lessons.disparity.matching import MapLook, chosen
from lessons.disparity.pairs import Pictures
from lessons.disparity.stage import T_WORLD_LEFT, standing
from workbench.algorithms.stereo.disparity import Stage
from workbench.data.framing import round_below
from workbench.geometry.cameras import back_project
from workbench.geometry.cameras.stereo import (
    depth_cloud,
    depth_from_disparity,
    depth_interval,
    points_on_ray,
)
from workbench.geometry.motions import R_UPRIGHT, apply, motion
from workbench.geometry.polylines import between, segments
from workbench.numerals import brief, length
from workbench.scene import Camera, Color, Field, Label, Points, Primitive, Scene, Segments

MOST_POINTS = 25_000
BARS = 150
SIZE = 0.008
CLOUD_BY_ERROR = "depth cloud by its error"


def draw(look: MapLook) -> Scene:
    """Return the picture of one step."""
    return {
        **standing(look),
        **_cameras(look.subject),
        **_cloud(look),
        **_followed(look),
        **_swept(look),
        **_ruler(look.subject),
        **beside(look),
        "caption": caption(look),
    }


def _cameras(pictures: Pictures) -> dict[str, Primitive]:
    h, w = pictures.left.shape
    camera = pictures.pair.camera
    K_right = pictures.pair.camera.K
    K_right[0, 2] += camera.doffs
    T_world_right = motion(R_UPRIGHT, np.array([pictures.scale * camera.baseline, 0.0, 0.0]))
    return {
        "left/camera": Camera(camera.K, w, h, T_WORLD_LEFT, 0.2, color="target"),
        "right/camera": Camera(K_right, w, h, T_world_right, 0.2, color="source"),
    }


def _cloud(look: MapLook) -> dict[str, Primitive]:
    """Show the points that the disparities stand for, by the colours of the picture, in the last
    step by their error.
    """
    pictures = look.subject
    h, w = look.now.depth.shape
    stride = math.ceil(math.sqrt(h * w / MOST_POINTS))
    near = np.full_like(look.now.depth, np.nan)
    near[::stride, ::stride] = look.now.depth[::stride, ::stride]
    near[~(near <= pictures.far)] = np.nan
    p_camera, seen = depth_cloud(near, pictures.pair.camera)
    if not len(p_camera):
        return {}
    radius = (
        0.8 * stride * pictures.scale * float(np.median(p_camera[:, 2])) / pictures.pair.camera.f
    )
    color, name = _cloud_color(look, seen)
    name = name if pictures.metric else f"{name}; its size is made up"
    scene: dict[str, Primitive] = {
        "cloud": Points(
            apply(T_WORLD_LEFT, pictures.scale * p_camera).astype(np.float32),
            color,
            radius,
            name=name,
        ),
    }
    if look.now.uncertainty is not None:
        scene["bars"] = _bars(look, seen)
    return scene


def _cloud_color(look: MapLook, seen: np.ndarray) -> tuple[Color, str]:
    truth = look.subject.pair.disparity
    camera = look.subject.pair.camera
    if look.now.uncertainty is None:
        return look.subject.pair.left[seen], "points so far"
    if not look.subject.metric:
        off = 100.0 * look.now.uncertainty[seen] / look.now.depth[seen]
        return Field.magnitude(off, "Depth error, of the depth", "%"), CLOUD_BY_ERROR
    if truth is None:
        off = look.now.uncertainty[seen]
        title = f"Depth error of {brief(look.now.disparity_error)} px"
    else:
        true_depth = camera.f * camera.baseline / np.maximum(truth + camera.doffs, 1e-9)
        off = np.abs(look.now.depth - true_depth)[seen]
        title = "Depth error"
    return Field.magnitude(off, title, "m"), CLOUD_BY_ERROR


def _bars(look: MapLook, seen: np.ndarray) -> Segments:
    """Return error bars along the rays of some of the points."""
    pictures = look.subject
    camera = pictures.pair.camera
    error = look.now.disparity_error
    v, u = np.nonzero(seen)
    some = np.linspace(0, len(u) - 1, min(BARS, len(u))).astype(int)
    d = camera.f * camera.baseline / look.now.depth[v[some], u[some]]
    uv = np.column_stack([u[some], v[some]]).astype(float)
    near_far = depth_interval(d, camera.f, camera.baseline, disparity_error=error)
    ends = [
        back_project(uv, np.minimum(depth, 2 * pictures.far), np.eye(4), K=camera.K)
        for depth in near_far
    ]
    return Segments(
        pictures.scale * np.stack(ends, axis=1),
        "correspondence",
        2.0,
        T_WORLD_LEFT,
        0.9,
        name=f"± {brief(error)} px along the ray",
    )


def _followed(look: MapLook) -> dict[str, Primitive]:
    """Show the ray of the followed pixel, its candidates, the one chosen, and the true one."""
    pictures = look.subject
    camera = pictures.pair.camera
    u, v = pictures.pixel
    depths = _depth(look, np.arange(pictures.max_disparity + 1.0))
    shown = np.isfinite(depths) & (depths <= pictures.far) & np.isfinite(look.now.costs)
    scene: dict[str, Primitive] = {
        "ray": Segments(
            between(np.zeros(3), _along(pictures, np.array([pictures.far]))),
            "highlight",
            2.0,
            T_WORLD_LEFT,
        )
    }
    if shown.any():
        scene["candidates"] = Points(
            _along(pictures, depths[shown]), "highlight", SIZE, T_WORLD_LEFT
        )
    depth = float(look.now.depth[v, u])
    if 0 < depth <= pictures.far:
        p = _along(pictures, np.array([depth]))
        scene["chosen"] = Points(p, "highlight", 2.2 * SIZE, T_WORLD_LEFT)
        if look.now.stage is not Stage.COMPARE:
            text = f"d = {brief(chosen(look))} px{_away(pictures, depth)}"
            scene["label/chosen"] = Label(text, p[0] + (0, -4 * SIZE, 0), "highlight", T_WORLD_LEFT)
        eye = np.array([pictures.scale * camera.baseline, 0.0, 0.0])
        scene["partner ray"] = Segments(between(eye, p), "source", 1.5, T_WORLD_LEFT)
    if pictures.true_depth[v, u] <= pictures.far:
        scene["truth"] = Points(
            _along(pictures, pictures.true_depth[v, u : u + 1]), "truth", 1.7 * SIZE, T_WORLD_LEFT
        )
    return scene


def _along(pictures: Pictures, depths: np.ndarray) -> np.ndarray:
    """Return the points of the followed pixel's ray at these depths, as large as they are drawn."""
    return pictures.scale * points_on_ray(pictures.pixel, depths, pictures.pair.camera)


def _swept(look: MapLook) -> dict[str, Primitive]:
    """Show where everything would be that has the disparity just compared: a plane before the
    cameras.
    """
    pictures = look.subject
    depth = float(_depth(look, np.array([look.now.done - 1.0]))[0])
    if look.now.stage is not Stage.COMPARE or not depth <= pictures.far:
        return {}
    corners = _corners(pictures, depth)
    return {
        "swept": Segments(segments(corners, closed=True), "other", 2.5, T_WORLD_LEFT),
        "label/swept": Label(
            f"d = {look.now.done - 1} px{_away(pictures, depth)}", corners[1], "other", T_WORLD_LEFT
        ),
    }


@functools.lru_cache(maxsize=16)
def _ruler(pictures: Pictures) -> dict[str, Primitive]:
    """Show what the cameras see as a faint pyramid, along one edge of which the metres are
    counted.
    """
    far = _corners(pictures, pictures.far / 1.25)
    edges = between(np.zeros(3), far)
    shown: dict[str, Primitive] = {
        "seen": Segments(
            np.concatenate([edges, segments(far, closed=True)]),
            "correspondence",
            1.0,
            T_WORLD_LEFT,
            0.45,
        )
    }
    if pictures.metric:
        apart = round_below(pictures.far / 3)
        for i, z in enumerate(np.arange(1, pictures.far / 1.25 / apart + 1e-9) * apart):
            shown[f"label/depth {i}"] = Label(
                length(z), _corners(pictures, z)[2] + (0.05, 0.05, 0.0), "neutral", T_WORLD_LEFT
            )
    return shown


def _corners(pictures: Pictures, depth: float) -> np.ndarray:
    """Return what the corners of the left picture see at a depth, as large as it is drawn."""
    h, w = pictures.left.shape
    z = np.array([depth])
    around = ((0, 0), (w - 1, 0), (w - 1, h - 1), (0, h - 1))
    return pictures.scale * np.concatenate(
        [points_on_ray(uv, z, pictures.pair.camera) for uv in around]
    )


def _away(pictures: Pictures, depth: float) -> str:
    return f": {length(depth)}" if pictures.metric else ""


def _depth(look: MapLook, d: np.ndarray) -> np.ndarray:
    """Return the depths of whole disparities with the focal length in use."""
    camera = look.subject.pair.camera
    return depth_from_disparity(d + camera.doffs, look.subject.f, camera.baseline)
