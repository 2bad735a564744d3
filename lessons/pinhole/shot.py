"""The true camera and its photograph: everything that holds whatever the functions under test
do.
"""

import functools

import numpy as np

from lessons.pinhole.state import Edit, Params, Shot
from workbench.data.views.street import BALL_CENTER, BALL_RADIUS, street, street_items
from workbench.errors import InputError
from workbench.geometry.cameras import (
    camera_center,
    crop_intrinsics,
    depths,
    dolly,
    intrinsics,
    look_at,
    normalize,
    project,
    project_orthographic,
    resize_intrinsics,
    sphere_outline,
    vanishing_points,
)
from workbench.geometry.cameras.distortion import Distortion
from workbench.geometry.cameras.raster import render
from workbench.geometry.polylines import segments
from workbench.knobs import only

WIDTH, HEIGHT = 320, 240
CROP_LEFT, CROP_TOP = 60, 40
FACTORS = np.geomspace(1.0, 50.0, 18)
CRATE_EDGE = np.array([[-1.4, 5.5, 0.0], [-1.4, 5.5, 1.0]])
TOWER_EDGE = np.array([[-3.7, 13.2, 0.0], [-3.7, 13.2, 5.0]])


def shot_of(params: Params) -> Shot:
    """Return the shot of these params; knobs that do not touch the camera find it taken already."""
    return _shot(only(params, "camera", "target", "f", "dolly", "k1", "k2", "p1", "p2", "edit"))


@functools.lru_cache(maxsize=64)
def _shot(params: Params) -> Shot:
    lens, edit = Distortion(params.k1, params.k2, params.p1, params.p2), params.edit
    p_world_eye, p_world_target = np.array(params.camera), np.array(params.target)
    distance = float(np.linalg.norm(p_world_target - p_world_eye))
    if distance < 1e-6:
        raise InputError("the camera is at its own target: move one of the two")
    T_near = look_at(p_world_eye, p_world_target)
    K_near = intrinsics(params.f, (WIDTH - 1) / 2, (HEIGHT - 1) / 2)
    T_camera_world, K_first = dolly(T_near, K_near, distance, params.dolly)
    photo = render(
        street_items(), T_camera_world, K_first, WIDTH, HEIGHT, lens, background=(238, 243, 248)
    )
    picture = _edited(photo.colors, edit)
    K, K_before = _edited_intrinsics(K_first, edit), _edited_intrinsics(K_near, edit)
    points = street().points
    return Shot(
        T_camera_world=T_camera_world,
        K=K,
        K_first=K_first,
        lens=lens,
        picture=picture,
        uv=project(points, T_camera_world, K, lens),
        xy=normalize(project(points, T_camera_world, K), K),
        crate=_height(CRATE_EDGE, T_camera_world, K, lens),
        tower=_height(TOWER_EDGE, T_camera_world, K, lens),
        crate_before=_height(CRATE_EDGE, T_near, K_before, lens),
        tower_before=_height(TOWER_EDGE, T_near, K_before, lens),
        ball_ratio=_ball_ratio(T_camera_world, K_first),
        vanishing=vanishing_points(np.array([[0.0, 1.0, 0.0]]), T_camera_world, K, distortion=lens)[
            0
        ],
        gaps=np.array(
            [_gap(*dolly(T_near, K_near, distance, by), distance * by) for by in FACTORS]
        ),
        gap=_gap(T_camera_world, K_first, distance * params.dolly),
    )


def wires(T_camera_world: np.ndarray) -> np.ndarray:
    """Return the outlines (n, 2, 3) of boxes, house, rails and ball, the last as this camera sees
    it.
    """
    scene = street()
    ball = np.zeros((0, 2, 3))
    if np.linalg.norm(camera_center(T_camera_world) - BALL_CENTER) > 1.01 * BALL_RADIUS:
        ball = segments(sphere_outline(BALL_CENTER, BALL_RADIUS, T_camera_world, n=48), closed=True)
    return np.concatenate([scene.edges, scene.rails, ball])


def _edited(picture: np.ndarray, edit: Edit) -> np.ndarray:
    """Cut off columns and rows, and average blocks of 2 x 2."""
    if "cropped" in edit:
        picture = picture[CROP_TOP:, CROP_LEFT:]
    if "half" in edit:
        h, w = picture.shape[0] // 2, picture.shape[1] // 2
        picture = picture.reshape(h, 2, w, 2, 3).mean(axis=(1, 3)).round().astype(np.uint8)
    return np.ascontiguousarray(picture)


def _edited_intrinsics(K: np.ndarray, edit: Edit) -> np.ndarray:
    """Give K what it is due when its picture is edited."""
    if "cropped" in edit:
        K = crop_intrinsics(K, CROP_LEFT, CROP_TOP)
    return resize_intrinsics(K, 0.5, 0.5) if "half" in edit else K


def _height(ends: np.ndarray, T_camera_world: np.ndarray, K: np.ndarray, lens: Distortion) -> float:
    low, high = project(ends, T_camera_world, K, lens)
    return float(np.linalg.norm(high - low))


def _ball_ratio(T_camera_world: np.ndarray, K: np.ndarray) -> float:
    """Measure the outline's longest and shortest radius; NaN where the ball's middle is not in the
    picture.
    """
    u, v = project(BALL_CENTER[None], T_camera_world, K)[0]
    inside = (
        depths(BALL_CENTER[None], T_camera_world)[0] > 1.01 * BALL_RADIUS
        and 0 < u < WIDTH
        and 0 < v < HEIGHT
    )
    if not inside:
        return float("nan")
    uv = project(sphere_outline(BALL_CENTER, BALL_RADIUS, T_camera_world, n=720), T_camera_world, K)
    middle = 0.5 * (uv.max(axis=0) + uv.min(axis=0))  # of an ellipse: its centre
    reach = np.linalg.norm(uv - middle, axis=1)
    return float(reach.max() / reach.min())


def _gap(T_camera_world: np.ndarray, K: np.ndarray, subject_depth: float) -> float:
    """Return the largest distance in pixels between the corners' pixels and their orthographic
    ones.
    """
    K_flat = K.copy()
    K_flat[:2, :2] /= subject_depth
    corners = street().edges.reshape(-1, 3)
    miss = project(corners, T_camera_world, K) - project_orthographic(
        corners, T_camera_world, K_flat
    )
    far = np.linalg.norm(miss, axis=1)
    return float(np.nanmax(far)) if np.isfinite(far).any() else float("nan")
