"""What one step looks like: the two cameras with their pictures, the cloud so far, and the ray of
the followed pixel.
"""

import functools
import math

import numpy as np

from lessons.disparity.captions import caption
from lessons.disparity.charts import beside
from lessons.disparity.stage import T_WORLD_LEFT, pictures
from lessons.disparity.state import Setup, State
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


def draw(state: State) -> Scene:
    """Return the picture of one step."""
    return {
        **pictures(state),
        **_cameras(state.setup),
        **_cloud(state),
        **_followed(state),
        **_swept(state),
        **_ruler(state.setup),
        **beside(state),
        "caption": caption(state),
    }


def _cameras(setup: Setup) -> dict[str, Primitive]:
    h, w = setup.left.shape
    camera, K_right = setup.pair.camera, setup.pair.camera.K
    K_right[0, 2] += camera.doffs
    T_world_right = motion(R_UPRIGHT, np.array([setup.scale * camera.baseline, 0.0, 0.0]))
    return {
        "left/camera": Camera(camera.K, w, h, T_WORLD_LEFT, 0.2, color="target"),
        "right/camera": Camera(K_right, w, h, T_world_right, 0.2, color="source"),
    }


def _cloud(state: State) -> dict[str, Primitive]:
    """Show the points that the disparities stand for, by the colours of the picture, in the last
    step by their error.
    """
    setup = state.setup
    h, w = state.depth.shape
    stride = math.ceil(math.sqrt(h * w / MOST_POINTS))
    near = np.full_like(state.depth, np.nan)
    near[::stride, ::stride] = state.depth[::stride, ::stride]
    near[~(near <= setup.far)] = np.nan
    p_camera, seen = depth_cloud(near, setup.pair.camera)
    if not len(p_camera):
        return {}
    radius = 0.8 * stride * setup.scale * float(np.median(p_camera[:, 2])) / setup.pair.camera.f
    color, name = _cloud_color(state, seen)
    name = name if setup.metric else f"{name}; its size is made up"
    scene: dict[str, Primitive] = {
        "cloud": Points(
            apply(T_WORLD_LEFT, setup.scale * p_camera).astype(np.float32), color, radius, name=name
        ),
    }
    if state.uncertainty is not None:
        scene["bars"] = _bars(state, seen)
    return scene


def _cloud_color(state: State, seen: np.ndarray) -> tuple[Color, str]:
    truth, camera = state.setup.pair.disparity, state.setup.pair.camera
    if state.uncertainty is None:
        return state.setup.pair.left[seen], "points so far"
    if not state.setup.metric:
        off = 100.0 * state.uncertainty[seen] / state.depth[seen]
        return Field.magnitude(off, "Depth error, of the depth", "%"), CLOUD_BY_ERROR
    if truth is None:
        off, title = state.uncertainty[seen], f"Depth error of {brief(state.disparity_error)} px"
    else:
        true_depth = camera.f * camera.baseline / np.maximum(truth + camera.doffs, 1e-9)
        off, title = np.abs(state.depth - true_depth)[seen], "Depth error"
    return Field.magnitude(off, title, "m"), CLOUD_BY_ERROR


def _bars(state: State, seen: np.ndarray) -> Segments:
    """Return error bars along the rays of some of the points."""
    setup = state.setup
    camera, error = setup.pair.camera, state.disparity_error
    v, u = np.nonzero(seen)
    some = np.linspace(0, len(u) - 1, min(BARS, len(u))).astype(int)
    d = camera.f * camera.baseline / state.depth[v[some], u[some]]
    uv = np.column_stack([u[some], v[some]]).astype(float)
    near_far = depth_interval(d, camera.f, camera.baseline, disparity_error=error)
    ends = [
        back_project(uv, np.minimum(depth, 2 * setup.far), np.eye(4), K=camera.K)
        for depth in near_far
    ]
    return Segments(
        setup.scale * np.stack(ends, axis=1),
        "correspondence",
        2.0,
        T_WORLD_LEFT,
        0.9,
        name=f"± {brief(error)} px along the ray",
    )


def _followed(state: State) -> dict[str, Primitive]:
    """Show the ray of the followed pixel, its candidates, the one chosen, and the true one."""
    setup = state.setup
    camera, (u, v) = setup.pair.camera, setup.pixel
    depths = _depth(state, np.arange(setup.max_disparity + 1.0))
    shown = np.isfinite(depths) & (depths <= setup.far) & np.isfinite(state.costs)
    scene: dict[str, Primitive] = {
        "ray": Segments(
            between(np.zeros(3), _along(setup, np.array([setup.far]))),
            "highlight",
            2.0,
            T_WORLD_LEFT,
        )
    }
    if shown.any():
        scene["candidates"] = Points(_along(setup, depths[shown]), "highlight", SIZE, T_WORLD_LEFT)
    chosen = float(state.depth[v, u])
    if 0 < chosen <= setup.far:
        p = _along(setup, np.array([chosen]))
        scene["chosen"] = Points(p, "highlight", 2.2 * SIZE, T_WORLD_LEFT)
        if state.stage is not Stage.COMPARE:
            text = f"d = {brief(state.chosen)} px{_away(setup, chosen)}"
            scene["label/chosen"] = Label(text, p[0] + (0, -4 * SIZE, 0), "highlight", T_WORLD_LEFT)
        eye = np.array([setup.scale * camera.baseline, 0.0, 0.0])
        scene["partner ray"] = Segments(between(eye, p), "source", 1.5, T_WORLD_LEFT)
    if setup.true_depth[v, u] <= setup.far:
        scene["truth"] = Points(
            _along(setup, setup.true_depth[v, u : u + 1]), "truth", 1.7 * SIZE, T_WORLD_LEFT
        )
    return scene


def _along(setup: Setup, depths: np.ndarray) -> np.ndarray:
    """Return the points of the followed pixel's ray at these depths, as large as they are drawn."""
    return setup.scale * points_on_ray(setup.pixel, depths, setup.pair.camera)


def _swept(state: State) -> dict[str, Primitive]:
    """Show where everything would be that has the disparity just compared: a plane before the
    cameras.
    """
    setup = state.setup
    depth = float(_depth(state, np.array([state.done - 1.0]))[0])
    if state.stage is not Stage.COMPARE or not depth <= setup.far:
        return {}
    corners = _corners(setup, depth)
    return {
        "swept": Segments(segments(corners, closed=True), "other", 2.5, T_WORLD_LEFT),
        "label/swept": Label(
            f"d = {state.done - 1} px{_away(setup, depth)}", corners[1], "other", T_WORLD_LEFT
        ),
    }


@functools.lru_cache(maxsize=16)
def _ruler(setup: Setup) -> dict[str, Primitive]:
    """Show what the cameras see as a faint pyramid, along one edge of which the metres are
    counted.
    """
    far = _corners(setup, setup.far / 1.25)
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
    if setup.metric:
        apart = round_below(setup.far / 3)
        for i, z in enumerate(np.arange(1, setup.far / 1.25 / apart + 1e-9) * apart):
            shown[f"label/depth {i}"] = Label(
                length(z), _corners(setup, z)[2] + (0.05, 0.05, 0.0), "neutral", T_WORLD_LEFT
            )
    return shown


def _corners(setup: Setup, depth: float) -> np.ndarray:
    """Return what the corners of the left picture see at a depth, as large as it is drawn."""
    h, w = setup.left.shape
    z = np.array([depth])
    around = ((0, 0), (w - 1, 0), (w - 1, h - 1), (0, h - 1))
    return setup.scale * np.concatenate([points_on_ray(uv, z, setup.pair.camera) for uv in around])


def _away(setup: Setup, depth: float) -> str:
    return f": {length(depth)}" if setup.metric else ""


def _depth(state: State, d: np.ndarray) -> np.ndarray:
    """Return the depths of whole disparities with the focal length in use."""
    camera = state.setup.pair.camera
    return depth_from_disparity(d + camera.doffs, state.setup.f, camera.baseline)
