"""What one stage looks like: the street, the camera with its picture, the points, and the followed
one's numbers.
"""

import functools
import math

import numpy as np

from lessons.pinhole import following as pinhole
from lessons.pinhole.captions import caption, depth
from lessons.pinhole.shot import FACTORS
from lessons.pinhole.state import State, name_of
from workbench.data.views.street import street
from workbench.geometry.cameras import camera_center, depths
from workbench.geometry.cameras.distortion import Distortion, distort, invertible_radius
from workbench.geometry.motions import apply, inverse
from workbench.geometry.polylines import between, segments
from workbench.lesson import View
from workbench.numerals import coordinates, fixed, pixels
from workbench.scene import (
    PALETTE,
    Axes,
    Camera,
    Chart,
    Classes,
    Field,
    Label,
    Mesh,
    Picture,
    Points,
    Primitive,
    Role,
    Scalar,
    Scene,
    Segments,
    Table,
    color_rows,
)

VIEW = View(
    eye=(-28.12, -7.88, 10.98),
    target=(0.995, 5.7, 7.6),
    fov_degrees=30.0,
    grid=None,
    grid_height=-0.02,
    axes=False,
)
SCREEN = (VIEW.facing(4.7, 2.9, -10.0), 20.4)
"""Where the photograph stands, enlarged, behind the street, and its width in metres."""
GAP = Chart("Gap to orthographic", "log10 of dolly", "log10 of px")
LAYER = 0.1  # metres from the photograph to what is drawn on it
FAR = 30.0  # metres that a ray is drawn
CANDIDATES = np.array([2.0, 4.0, 8.0, 16.0])  # depths marked on the ray back
BEYOND = 0.12  # of the photograph's size: so far outside of it points are shown


def draw(state: State) -> Scene:
    """Return the picture of one stage."""
    now, shot, k = state.now, state.shot, state.params.point
    T_world_camera = inverse(shot.T_camera_world)
    h, w = shot.picture.shape[:2]
    title = "Photograph, calculated outlines orange" if now.reached("divide") else "Photograph"
    photograph = Picture(state.picture, title, SCREEN[1], SCREEN[0])
    scene: dict[str, Primitive] = {
        **scenery(),
        "camera": Camera(shot.K, w, h, T_world_camera, 1.0, state.picture, "neutral"),
        "picture": photograph,
        "points": Points(now.p_world, _point_color(state), 0.07, name="points of the street"),
        "followed": Points(now.p_world[k : k + 1], "highlight", 0.16, name="followed"),
        "followed label": Label(
            name_of(k), now.p_world[k] + np.array([0.0, 0.0, 0.4]), "highlight"
        ),
        "error": Scalar(state.error, "median of all points", "Error of this stage", "px", "truth"),
        "caption": caption(state),
        **_tables(state),
        **_lens_curves(shot.lens, float(np.linalg.norm(shot.xy[k]))),
    }
    if state.params.dolly != 1:
        dolly, gaps = np.log10(FACTORS), np.log10(shot.gaps)
        scene["gap"] = GAP.curve(
            dolly, gaps, "largest gap", "truth", marks=(float(np.log10(state.params.dolly)),)
        )
    stage = {
        "camera": _camera,
        "divide": _divide,
        "distort": _distort,
        "pixels": _pixels,
        "back": _back,
    }
    if now.stage in stage:
        scene["camera frame"] = Axes(T_world_camera, 1.2)
        scene |= stage[now.stage](state, photograph, T_world_camera)
    return scene


@functools.cache
def scenery() -> dict[str, Primitive]:
    """Return what stands in the street, the same objects at each step."""
    scene = street()
    meshes = {}
    for path, names in {
        "ground": ["ground"],
        "street": [name for name in scene.solids if name != "ground"],
    }.items():
        p = np.concatenate(
            [scene.solids[name].p_world[scene.solids[name].faces].reshape(-1, 3) for name in names]
        )
        colors = np.concatenate([np.repeat(scene.solids[name].colors, 3, axis=0) for name in names])
        meshes[path] = Mesh(p, np.arange(len(p)).reshape(-1, 3), colors, flat=True, name=path)
    return {**meshes, "rails": Segments(scene.rails, color_rows("neutral", 2), 3, name="rails")}


def _point_color(state: State):
    if state.now.stage != "camera":
        return "target"
    z = state.now.p_camera[:, 2]
    span = np.nanpercentile(z[z > 0], 90) if (z > 0).any() else 1.0
    return Field(np.where(z > 0, z, np.nan), 0.0, float(span), "Depth Z (grey: behind)", "m")


def _camera(state: State, photograph: Picture, T_world_camera: np.ndarray) -> dict[str, Primitive]:
    """Lead from the camera to the followed point along its own axes, and where the calculation says
    it is, if elsewhere.
    """
    true = apply(state.shot.T_camera_world, state.now.p_world[state.params.point])
    got = state.now.p_camera[state.params.point]
    if np.allclose(got, true):
        return _ways("ways", true, ("z", "x", "y"), "", T_world_camera)
    return _ways("ways", true, ("truth", "truth", "truth"), "the true way", T_world_camera) | _ways(
        "calculated ways", got, ("wrong", "wrong", "wrong"), "the calculated way", T_world_camera
    )


def _ways(
    path: str,
    p_camera: np.ndarray,
    roles: tuple[Role, Role, Role],
    name: str,
    T_world_camera: np.ndarray,
) -> dict[str, Primitive]:
    """Lead from the camera to a point along the camera's axes: Z first, then X, then Y."""
    x, y, z = p_camera
    corners = np.array([[0.0, 0, 0], [0, 0, z], [x, 0, z], [x, y, z]])
    colors = np.array([PALETTE[role] for role in roles], np.uint8)
    parts: dict[str, Primitive] = {
        path: Segments(segments(corners), colors, 4, T_world_camera, name=name)
    }
    for i, (role, axis, way) in enumerate(zip(roles, "ZXY", (z, x, y), strict=True)):
        at = corners[i : i + 2].mean(axis=0)
        if axis == "Z" and z < 0:  # far behind the camera nobody sees it
            at = np.array([0.0, 0.0, max(z / 2, -1.0)])
        parts[f"{path}/{axis}"] = Label(f"{axis} = {depth(way)}", at, role, T_world_camera)
    return parts


def _divide(state: State, photograph: Picture, T_world_camera: np.ndarray) -> dict[str, Primitive]:
    """Show all rays, and where they cross the picture."""
    uv = pinhole.onto_pixels(state.now.xy, state.shot.K)
    return _rays(state, state.now.xy, T_world_camera) | _landed(
        state, photograph, uv, "source", "calculated"
    )


def _distort(state: State, photograph: Picture, T_world_camera: np.ndarray) -> dict[str, Primitive]:
    """Show how far the lens moves each point of the picture."""
    ideal, bent = (
        pinhole.onto_pixels(xy, state.shot.K) for xy in (state.now.xy, state.now.xy_bent)
    )
    both = _near(photograph, ideal) & _near(photograph, bent)
    parts = _rays(state, state.now.xy, T_world_camera) | _landed(
        state, photograph, bent, "source", "calculated"
    )
    if both.any():
        ends = photograph.places(between(ideal[both], bent[both]), LAYER)
        parts["moves"] = Segments(ends, "other", 3, name="moved by the lens")
    return parts


def _pixels(state: State, photograph: Picture, T_world_camera: np.ndarray) -> dict[str, Primitive]:
    """Show which points are in the picture, and the pixel of the followed one."""
    uv, (h, w) = state.now.uv, state.shot.picture.shape[:2]
    inside = np.all((uv > -0.5) & (uv < np.array([w, h]) - 0.5), axis=1)
    color = Classes.marking(
        ~inside, "correspondence", "outside it", others=("source", "in the picture")
    )
    parts = _rays(state, state.now.xy, T_world_camera) | _landed(state, photograph, uv, color, "")
    if "landed" in parts:
        k, place = state.params.point, photograph.places(uv[state.params.point], LAYER)
        parts["pixel"] = Label(
            f"(u, v) = {coordinates(uv[k], 0)}", place + np.array([0.0, 0.0, 0.35]), "highlight"
        )
    vanishing = state.shot.vanishing
    if state.params.point in (3, 4) and _near(photograph, vanishing[None])[0]:
        place = photograph.places(vanishing[None], LAYER)
        parts["vanishing"] = Points(place, "truth", 0.2)
        parts["vanishing/name"] = Label("K R d", place[0] + np.array([0.0, 0.0, 0.35]), "truth")
    return parts


def _back(state: State, photograph: Picture, T_world_camera: np.ndarray) -> dict[str, Primitive]:
    """Show the ray of the followed pixel, and where pixels with depths come from."""
    now, k = state.now, state.params.point
    parts: dict[str, Primitive] = {
        "center": Points(now.p_center[None], "source", 0.16),
        "center label": Label("C", now.p_center + np.array([0.0, 0.0, 0.3]), "source"),
    }
    found = np.linalg.norm(np.nan_to_num(now.p_back, nan=np.inf), axis=1) < 1e4
    if found.any():
        parts["back"] = Points(now.p_back[found], "source", 0.09, name="from pixel and depth")
        wrong = np.linalg.norm(now.p_back - now.p_world, axis=1) > 1e-6
        if (found & wrong).any():
            ends = between(now.p_world, now.p_back)[found & wrong]
            parts["back errors"] = Segments(ends, "wrong", 2, name="error")
    if found[k]:
        z = depths(now.p_world[k : k + 1], state.shot.T_camera_world)[0]
        v = (now.p_back[k] - now.p_center) / z  # one metre of depth
        reach = max(FAR, 1.2 * z)
        parts["followed ray"] = Segments(
            between(now.p_center, now.p_center + reach * v), "highlight", 4
        )
        marks = now.p_center + CANDIDATES[:, None] * v
        parts["candidates"] = Points(marks, "other", 0.13)
        for i, mark in enumerate(marks):
            if abs(CANDIDATES[i] / z - 1) < 0.1:  # the followed point's name stands there
                continue
            parts[f"candidates/{i}"] = Label(
                f"{CANDIDATES[i]:g} m", mark + np.array([0.0, 0.0, 0.25]), "other"
            )
    return parts | _landed(state, photograph, now.uv[[k]], "source", "")


def _rays(state: State, xy: np.ndarray, T_world_camera: np.ndarray) -> dict[str, Primitive]:
    seen, k = np.isfinite(xy).all(axis=1), state.params.point
    rays = between(T_world_camera[:3, 3], state.now.p_world)
    z = state.now.p_camera[k, 2]
    if (
        z < 0 and np.isfinite(xy[k]).all()
    ):  # divided all the same: on through the camera, to the plane in front of it
        rays[k, 0] += (rays[k, 1] - rays[k, 0]) / z
    parts: dict[str, Primitive] = {"followed ray": Segments(rays[k : k + 1], "highlight", 4)}
    if seen.any():
        parts["rays"] = Segments(rays[seen], "correspondence", 1.0, opacity=0.6)
    return parts


def _landed(
    state: State, photograph: Picture, uv: np.ndarray, color, name: str
) -> dict[str, Primitive]:
    """Show pixels on the photograph, the followed one larger."""
    near, k = _near(photograph, uv), state.params.point if len(uv) > 1 else 0
    if isinstance(color, Classes):
        color = Classes(color.ids[near], color.roles, color.names)
    parts: dict[str, Primitive] = {
        "plane": Points(photograph.places(uv[near], LAYER), color, 0.11, name=name)
    }
    if near[k]:
        parts["landed"] = Points(photograph.places(uv[[k]], 2 * LAYER), "highlight", 0.2)
    return parts


def _near(photograph: Picture, uv: np.ndarray) -> np.ndarray:
    """Say which pixels are in the photograph or close to it."""
    size = np.array(photograph.size)
    return np.all((uv > -BEYOND * size) & (uv < (1 + BEYOND) * size), axis=1)


def _lens_curves(lens: Distortion, r_chosen: float) -> dict[str, Primitive]:
    """Draw distorted over ideal radius along +x; where it turns down the lens folds."""
    r = np.linspace(0.0, 1.4, 57)
    bent = distort(np.column_stack([r, np.zeros_like(r)]), *lens)[:, 0]
    fold = invertible_radius(lens)
    marks = tuple(float(mark) for mark in (r_chosen, fold) if mark < r[-1])
    chart = Chart("Lens: radius on the plane Z = 1", "ideal radius", "distorted radius")
    return {
        "no lens": chart.curve(r, r, "no lens", "correspondence"),
        "lens": chart.curve(r, bent, "this lens", "truth", marks=marks),
    }


def _tables(state: State) -> dict[str, Primitive]:
    """Return the followed point's journey so far, and what can be measured of the camera and in its
    picture.
    """
    shot, now, k = state.shot, state.now, state.params.point
    rows = [("in the world", f"{coordinates(now.p_world[k], 2)} m")]
    if now.reached("camera"):
        p = now.p_camera[k]
        rows += [
            ("in the camera frame", f"{coordinates(p, 2)} m"),
            ("depth Z · ray length", f"{depth(p[2])} · {depth(float(np.linalg.norm(p)))}"),
        ]
    if now.reached("divide"):
        rows.append(("x, y = X/Z, Y/Z", coordinates(now.xy[k], 4)))
    if now.reached("distort"):
        rows.append(("after the lens", coordinates(now.xy_bent[k], 4)))
    if now.reached("pixels"):
        rows += [
            ("pixel (u, v)", coordinates(now.uv[k], 1)),
            ("true pixel", coordinates(shot.uv[k], 1)),
        ]
    if now.reached("back"):
        rows.append(
            (
                "back in the world",
                coordinates(now.p_back[k], 2) + " m" * bool(np.isfinite(now.p_back[k]).all()),
            )
        )
    h, w = shot.picture.shape[:2]
    ball = "the ball's outline" + ", without the lens" * any(shot.lens)
    measured = (
        ("camera centre C = −Rᵀt", f"{coordinates(camera_center(shot.T_camera_world), 2)} m"),
        ("t of T_camera_world", f"{coordinates(shot.T_camera_world[:3, 3], 2)} m"),
        ("focal length f", f"{fixed(shot.K[0, 0], 1)} px"),
        ("principal point", coordinates(shot.K[:2, 2], 1)),
        ("middle of the picture", coordinates(np.array([w - 1, h - 1]) / 2, 1)),
        ("the rails run towards", coordinates(shot.vanishing, 1)),
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
