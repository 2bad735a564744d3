"""What the camera looks at, and its photograph: everything that holds whatever method is tried."""

from collections.abc import Sequence
from functools import lru_cache

import numpy as np

from lessons.pose.state import Params, Subject
from workbench.data.framing import Frame, frame
from workbench.data.shapes.solids import Solid, box, outlined
from workbench.data.views.sightings import Sightings, points_on_box, read_sightings, seen, some_of
from workbench.data.views.street import MAPPED, SUN, standing, street, street_items, street_map
from workbench.errors import InputError
from workbench.geometry.cameras import (
    camera_center,
    crop_intrinsics,
    depths,
    intrinsics,
    look_at,
    project,
    resize_intrinsics,
)
from workbench.geometry.cameras.raster import Image, Item, MeshItem, SegmentItem, in_sight, render
from workbench.geometry.meshes import face_normals
from workbench.geometry.polylines import circle
from workbench.knobs import only
from workbench.scene import color_rows

SIZE = (0.9, 0.7, 0.6)  # of the box, metres
SIDE = 0.1  # of the marker
PRINCIPAL = (319.5, 239.5)
PHOTOGRAPH = (200, 150)
SHADES = {"box": (222, 214, 200), "marker": (60, 64, 72), "triangle": (214, 222, 230)}
FAR_OFF = np.array([0.78, 0.62, 0.04])  # the direction of a map's origin
FOURTH = np.array([0.3, -0.2, 0.5])  # chooses among the solutions of the triangle
AIM = np.array([0.5, 9.0, 1.5])  # where the camera in the street looks to
WHOLE = np.array([-0.5, -0.5, 639.5, 479.5])  # window of its picture


def subject_of(params: Params) -> Subject:
    """Return what the params look at; knobs of the method find it made already."""
    if params.sightings is not None:
        return _own(params)
    names = (
        "target",
        "points",
        "thickness",
        "camera",
        "distance",
        "tilt",
        "f",
        "noise",
        "outliers",
        "origin",
        "seed",
    )
    return _made(only(params, *names))


@lru_cache(maxsize=64)
def _made(params: Params) -> Subject:
    rng = np.random.default_rng(params.seed)
    outliers, far = (
        (params.outliers, params.origin) if params.target in ("box", "street") else (0.0, 0.0)
    )
    K = intrinsics(params.f, *PRINCIPAL)
    if params.target == "street":
        if params.camera[2] <= 0.0:
            raise InputError("the camera is under the street: move it up")
        T_near = look_at(np.array(params.camera), AIM)
        body = _street()
        window = WHOLE
        photograph = _photograph(street_items(), T_near, K, window=window)
        p = _mapped(T_near, K, photograph, most=params.points, rng=rng)
    else:
        p, body = _target(params, rng)
        T_near = _stood(params)
        if not depths(np.vstack([p, body.p]), T_near).min() > 0.05:
            raise InputError(
                "the camera is too near: part of what it looks at is beside it or behind it"
            )
        window = _window(project(np.vstack([p, body.p]), T_near, K))
        photograph = _photograph(_lit(body, SHADES[params.target]), T_near, K, window=window)
    origin = 1000.0 * far * FAR_OFF
    given = seen(
        p, T_near, K, rng=rng, sigma=params.noise, is_outlier=some_of(len(p), outliers, rng)
    )
    T_true = T_near.copy()
    T_true[:3, 3] -= T_near[:3, :3] @ origin
    return Subject(
        given=Sightings(p + origin, given.uv, given.is_outlier),
        K=K,
        T_true=T_true,
        frame=Frame(centre=origin),
        body=body,
        photograph=photograph.colors,
        kind=params.target,
        window=window,
    )


def _target(params: Params, rng: np.random.Generator) -> tuple[np.ndarray, Solid]:
    """Return the known points, and what they are on, about the origin."""
    if params.target == "marker":
        p = SIDE / 2 * np.array([[-1.0, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]])
        return p, outlined(p, np.array([[0, 1, 2], [0, 2, 3]]))
    if params.target == "triangle":
        p = np.column_stack([circle(3)[:3] @ [[0.0, 1.0], [-1.0, 0.0]], np.zeros(3)])
        return np.vstack([p, FOURTH]), outlined(p, np.array([[0, 1, 2]]))
    size = np.array(SIZE) * [1.0, 1.0, params.thickness]
    shape = box((size[0], size[1], max(float(size[2]), 1e-4)))
    down = np.array([0.0, 0.0, size[2] / 2])
    return points_on_box(size, params.points, rng), Solid(
        shape.p - down, shape.faces, shape.lines - down
    )


def _stood(params: Params) -> np.ndarray:
    """Return the motion of the camera before its target."""
    eye = np.array(params.camera)
    if params.target == "marker":
        tilt = np.radians(params.tilt)
        turn = 0.3
        eye = params.distance * np.array(
            [np.sin(tilt) * np.cos(turn), np.sin(tilt) * np.sin(turn), np.cos(tilt)]
        )
    if not np.linalg.norm(eye) > 0.0:
        raise InputError("the camera is at the middle of what it looks at: move it")
    return look_at(eye, np.zeros(3))


@lru_cache
def _street() -> Solid:
    return Solid(*standing(), np.concatenate([street().edges, street().rails]))


def _mapped(
    T: np.ndarray, K: np.ndarray, photograph: Image, *, most: int, rng: np.random.Generator
) -> np.ndarray:
    """Return points of the street's map that its photograph shows: the same ones as far as the
    camera sees them.
    """
    order = rng.permutation(MAPPED)
    p, n = (rows[order] for rows in street_map())
    ahead = ((camera_center(T) - p) * n).sum(axis=1) > 0.0
    p = p[ahead & in_sight(p, T, _windowed(K, WHOLE), depth=photograph.depth)][:most]
    if len(p) < 4:
        raise InputError(
            f"the camera sees {len(p)} points of the map: move it, or make its focal length shorter"
        )
    return p


def _window(uv: np.ndarray) -> np.ndarray:
    """Return the part of the picture around some pixels, with a margin, as wide to high as the
    photograph.
    """
    low, high = uv.min(axis=0), uv.max(axis=0)
    middle = (low + high) / 2
    size = 1.5 * np.maximum(high - low, 8.0)
    w, h = PHOTOGRAPH
    half = 0.5 * max(size[0], size[1] * w / h) * np.array([1.0, h / w])
    return np.concatenate([middle - half, middle + half])


def _windowed(K: np.ndarray, window: np.ndarray) -> np.ndarray:
    """Return the intrinsics of the photograph, which is a window of the picture, resized."""
    enlarged = PHOTOGRAPH[0] / (window[2] - window[0])
    return resize_intrinsics(
        crop_intrinsics(K, window[0] + 0.5, window[1] + 0.5), enlarged, enlarged
    )


def _photograph(
    items: Sequence[Item], T_camera_world: np.ndarray, K: np.ndarray, *, window: np.ndarray
) -> Image:
    """Return the window of what the camera sees."""
    width, height = PHOTOGRAPH
    K_window = _windowed(K, window)
    return render(
        items, T_camera_world, K_window, width=width, height=height, background=(246, 248, 250)
    )


def _lit(body: Solid, shade: tuple[int, int, int]) -> Sequence[Item]:
    """Return the body's faces in the sun, and its lines."""
    light = 0.8 + 0.2 * np.abs(face_normals(body.p, body.faces) @ SUN)
    faces = MeshItem(body.p, body.faces, np.rint(light[:, None] * shade).astype(np.uint8))
    return faces, SegmentItem(body.lines, color_rows("neutral", len(body.lines)))


def _own(params: Params) -> Subject:
    assert params.sightings is not None
    given = read_sightings(params.sightings)
    for noun, at in (("points", given.p_world), ("pixels", given.uv)):
        if not np.ptp(at, axis=0).max() > 0:
            raise InputError(f"{params.sightings.name}: all its {noun} lie at one place")
    blank = np.full((PHOTOGRAPH[1], PHOTOGRAPH[0], 3), 248, np.uint8)
    return Subject(
        given=given,
        K=intrinsics(params.focal, *params.principal),
        T_true=None,
        frame=frame(given.p_world, 1.0, up=params.up),
        body=None,
        photograph=blank,
        kind="box",
        window=_window(given.uv),
    )
