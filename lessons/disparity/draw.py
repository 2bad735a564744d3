"""What one step looks like: the two cameras with their pictures, the cloud so far, and the ray of the followed pixel."""

import math

import numpy as np

from lessons.disparity.charts import beside, framed
from lessons.disparity.state import Setup, State
from lessons.disparity.words import caption
from workbench.algorithms.disparity import Stage
from workbench.geometry.cameras import back_project
from workbench.geometry.motions import motion
from workbench.geometry.polylines import segments
from workbench.geometry.stereo import depth_cloud, depth_from_disparity, depth_interval, points_on_ray
from workbench.numerals import brief, length
from workbench.scene import Camera, Color, Field, Label, Picture, Points, Primitive, Scene, Segments

# The left camera is at the world's origin and looks along +Y.
R_WORLD_CAMERA = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0]])
T_WORLD_LEFT = motion(R_WORLD_CAMERA, np.zeros(3))
MOST_POINTS = 25_000
DESK = 0.84
BARS = 150
CLOUD_BY_ERROR = "depth cloud by its error"


def draw(state: State) -> Scene:
    """Return the picture of one step."""
    return {
        **_cameras(state),
        **_cloud(state),
        **_followed(state),
        **_swept(state),
        **beside(state),
        "caption": caption(state),
    }


def T_world_right(setup: Setup) -> np.ndarray:
    """Return the pose of the right camera."""
    return motion(R_WORLD_CAMERA, np.array([setup.pair.camera.baseline, 0.0, 0.0]))


def _cameras(state: State) -> dict[str, Primitive]:
    """Show both cameras, and before them on two desks the pictures that they took, with the windows compared."""
    setup = state.setup
    h, w = setup.left.shape
    u, v = setup.pixel
    camera, window = setup.pair.camera, setup.params.window
    K_right = camera.K
    K_right[0, 2] += camera.doffs
    partner = state.done - 1 if state.stage is Stage.COMPARE else state.chosen
    marked_right = setup.pair.right
    if math.isfinite(partner):
        marked_right = framed(marked_right, (u - round(partner), v), window)
    return {
        "left/camera": Camera(camera.K, w, h, T_WORLD_LEFT, 0.22, color="target", name="left camera"),
        "right/camera": Camera(K_right, w, h, T_world_right(setup), 0.22, color="source", name="right camera"),
        "left/picture": Picture(framed(setup.pair.left, (u, v), window), "left picture", DESK, _desk(-0.4)),
        "right/picture": Picture(marked_right, "right picture", DESK, _desk(0.52)),
        "left/name": Label("left picture: click a pixel", _desk(-0.4)[:3, 3] + (0, 0.3, 0.24), "target"),
        "right/name": Label("right picture", _desk(0.52)[:3, 3] + (0, 0.3, 0.24), "source"),
    }


def _desk(x: float) -> np.ndarray:
    """Return the pose of a picture that leans back below the cameras."""
    lean = math.radians(55.0)
    down = np.array([0.0, -math.sin(lean), -math.cos(lean)])
    across = np.array([1.0, 0.0, 0.0])
    return motion(np.column_stack([across, down, np.cross(across, down)]), np.array([x, -0.8, -0.4]))


def _cloud(state: State) -> dict[str, Primitive]:
    """Show the points that the disparities stand for, by the colours of the picture, in the last step by their error."""
    setup = state.setup
    h, w = state.depth.shape
    stride = math.ceil(math.sqrt(h * w / MOST_POINTS))
    near = np.full_like(state.depth, np.nan)
    near[::stride, ::stride] = state.depth[::stride, ::stride]
    near[~(near <= setup.far)] = np.nan
    p_camera, seen = depth_cloud(near, setup.pair.camera)
    if not len(p_camera):
        return {}
    radius = 0.6 * stride * float(np.median(p_camera[:, 2])) / setup.pair.camera.f
    color, name = _cloud_color(state, seen)
    name = name if setup.metric else f"{name}; its size is made up"
    scene: dict[str, Primitive] = {
        "cloud": Points(p_camera.astype(np.float32), color, radius, T_WORLD_LEFT, name=name),
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
        return Field(
            off, 0.0, max(float(np.nanpercentile(off, 95)), 1e-6), "Depth error, of the depth", "%"
        ), CLOUD_BY_ERROR
    if truth is None:
        off, title = state.uncertainty[seen], f"Depth error of {brief(state.disparity_error)} px"
    else:
        true_depth = camera.f * camera.baseline / np.maximum(truth + camera.doffs, 1e-9)
        off, title = np.abs(state.depth - true_depth)[seen], "Depth error"
    top = float(np.nanpercentile(off, 95)) if np.isfinite(off).any() else 1.0
    return Field(off, 0.0, max(top, 1e-6), title, "m"), CLOUD_BY_ERROR


def _bars(state: State, seen: np.ndarray) -> Segments:
    """Return error bars along the rays of some of the points."""
    setup = state.setup
    camera, error = setup.pair.camera, state.disparity_error
    v, u = np.nonzero(seen)
    some = np.linspace(0, len(u) - 1, min(BARS, len(u))).astype(int)
    d = camera.f * camera.baseline / state.depth[v[some], u[some]]
    uv = np.column_stack([u[some], v[some]]).astype(float)
    near_far = depth_interval(d, camera.f, camera.baseline, error)
    ends = [back_project(uv, np.minimum(depth, 2 * setup.far), np.eye(4), camera.K) for depth in near_far]
    return Segments(
        np.stack(ends, axis=1), "correspondence", 2.0, T_WORLD_LEFT, 0.9, name=f"± {brief(error)} px along the ray"
    )


def _followed(state: State) -> dict[str, Primitive]:
    """Show the ray of the followed pixel, its candidates, the one chosen, and the true one."""
    setup = state.setup
    camera, (u, v) = setup.pair.camera, setup.pixel
    depths = _depth(state, np.arange(setup.max_disparity + 1.0))
    shown = np.isfinite(depths) & (depths <= setup.far) & np.isfinite(state.costs)
    end = points_on_ray((u, v), np.array([setup.far]), camera)[0]
    size = 0.012 * min(max(setup.far / 3.0, 1.0), 1.7)
    scene: dict[str, Primitive] = {
        "ray": Segments(
            np.array([[np.zeros(3), end]]), "highlight", 2.0, T_WORLD_LEFT, name=f"ray of left pixel ({u}, {v})"
        )
    }
    if shown.any():
        costs = state.costs[shown]
        low, high = float(costs.min()), float(costs.max())
        field = Field(costs, low, max(high, low + 1e-6), "Cost of a candidate")
        scene["candidates"] = Points(
            points_on_ray((u, v), depths[shown], camera),
            field,
            size,
            T_WORLD_LEFT,
            name="candidates: one per disparity",
        )
    chosen = float(state.depth[v, u])
    if 0 < chosen <= setup.far:
        p = points_on_ray((u, v), np.array([chosen]), camera)
        scene["chosen"] = Points(p, "highlight", 2.2 * size, T_WORLD_LEFT, name="chosen")
        scene["label/chosen"] = Label(
            f"d = {brief(state.chosen)} px{_away(setup, chosen)}",
            p[0] + (0, -4 * size, 0),
            "highlight",
            T_WORLD_LEFT,
        )
        eye = np.array([camera.baseline, 0.0, 0.0])
        scene["partner ray"] = Segments(np.array([[eye, p[0]]]), "source", 1.5, T_WORLD_LEFT, name="ray of its partner")
    true = setup.true_depth[v, u]
    if true <= setup.far:
        p = points_on_ray((u, v), np.array([true]), camera)
        scene["truth"] = Points(p, "truth", 1.7 * size, T_WORLD_LEFT, name="true point")
    return scene


def _swept(state: State) -> dict[str, Primitive]:
    """Show where everything would be that has the disparity just compared: a plane before the cameras."""
    if state.stage is not Stage.COMPARE:
        return {}
    setup = state.setup
    h, w = setup.left.shape
    depth = float(_depth(state, np.array([state.done - 1.0]))[0])
    if not depth <= setup.far:
        return {}
    z = np.array([depth])
    corners = np.concatenate(
        [points_on_ray(uv, z, setup.pair.camera) for uv in ((0, 0), (w - 1, 0), (w - 1, h - 1), (0, h - 1))]
    )
    return {
        "swept": Segments(
            segments(corners, closed=True), "other", 2.0, T_WORLD_LEFT, name="everything of this disparity"
        ),
        "label/swept": Label(f"d = {state.done - 1} px{_away(setup, depth)}", corners[1], "other", T_WORLD_LEFT),
    }


def _away(setup: Setup, depth: float) -> str:
    return f": {length(depth)}" if setup.metric else ""


def _depth(state: State, d: np.ndarray) -> np.ndarray:
    """Return the depths of whole disparities with the focal length in use."""
    camera = state.setup.pair.camera
    return depth_from_disparity(d + camera.doffs, state.setup.f, camera.baseline)
