"""The true camera and its photograph: all that holds whatever the functions under test do."""

from dataclasses import dataclass

import numpy as np

from lessons.pinhole.inputs import Input
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
from workbench.geometry.motions import exp_so3, inverse, motion
from workbench.geometry.polylines import segments
from workbench.lesson import cached

WIDTH, HEIGHT = 320, 240
CROP_TOP = 40
LAMP = street().names.index("the lamp")
EDGES = np.array([[[-1.4, 5.5, 0.0], [-1.4, 5.5, 1.0]], [[-3.7, 13.2, 0.0], [-3.7, 13.2, 5.0]]])
"""Of the crate and of the tower, foot and top."""
ALONG_RAILS = np.array([[0.0, 1.0, 0.0]])
SKY = (238, 243, 248)


@dataclass(frozen=True, eq=False, kw_only=True)
class Pinhole:
    """The true camera: its pose, its K before any edit and after it, and its lens."""

    T_camera_world: np.ndarray
    K_first: np.ndarray
    K: np.ndarray
    lens: Distortion


@dataclass(frozen=True, eq=False, kw_only=True)
class Shot(Pinhole):
    """What the true camera sees.

    Attributes:
        picture: The photograph after the edit, (h, w, 3).
        p_world: The points (n, 3) of the street, metres.
        k: Which of them is followed.
        name: What the followed point is called.
        uv: Pixels of the points, NaN where it does not see them.
        xy: Ideal normalised coordinates of the points, NaN likewise.
        crate, tower: Heights of an edge in this picture, pixels; NaN where an end has no pixel.
        ball_ratio: Length over width of the ball's outline, without the lens; NaN if out of sight.
        vanishing: Pixel in which the rails meet, NaN where they do not.
        gap: How far a corner in front is from its orthographic pixel, at most, before the edit
            and without the lens.
    """

    picture: np.ndarray
    p_world: np.ndarray
    k: int
    name: str
    uv: np.ndarray
    xy: np.ndarray
    crate: float
    tower: float
    ball_ratio: float
    vanishing: np.ndarray
    gap: float


def setup(params: Input) -> Shot:
    """Return the shot of these params.

    Raises:
        InputError: If the camera stands where it looks to.
    """
    eye = pinhole_of(params, params.dolly)
    T, K, lens = eye.T_camera_world, eye.K, eye.lens
    p_world, k = followed(params, eye)
    crate, tower = heights(params, params.dolly)
    return Shot(
        **vars(eye),
        picture=photograph(params),
        p_world=p_world,
        k=k,
        name=dict(enumerate(street().names)).get(k, f"point {k}"),
        uv=project(p_world, T, K, lens),
        xy=normalize(project(p_world, T, K), K),
        crate=crate,
        tower=tower,
        ball_ratio=_ball_ratio(T, eye.K_first),
        vanishing=vanishing_points(ALONG_RAILS, T, K, distortion=lens)[0],
        gap=gap(params, params.dolly),
    )


def pinhole_of(params: Input, by: float) -> Pinhole:
    """Return the true camera with the dolly at `by`."""
    p_eye, p_target = np.array(params.camera), np.array(params.target)
    distance = float(np.linalg.norm(p_target - p_eye))
    if distance < 1e-6:
        raise InputError("the camera is at its own target: move one of the two")
    T_camera_world = look_at(p_eye, p_target)
    if params.turn:  # about the vertical through the camera; clockwise from above is to the right
        R_world = exp_so3(np.radians(-params.turn) * np.array([0.0, 0.0, 1.0]))
        T_camera_world = T_camera_world @ inverse(motion(R_world, p_eye - R_world @ p_eye))
    if params.aside:
        T_camera_world = motion(np.eye(3), np.array([-params.aside, 0.0, 0.0])) @ T_camera_world
    K_near = intrinsics(params.f, (WIDTH - 1) / 2, (HEIGHT - 1) / 2)
    T_camera_world, K_first = dolly(T_camera_world, K_near, distance, factor=by)
    K = K_first
    if "cropped" in params.edit:
        K = crop_intrinsics(K, params.cut, CROP_TOP)
    if "half" in params.edit:
        K = resize_intrinsics(K, 0.5, 0.5)
    lens = Distortion(params.k1, params.k2, params.p1, params.p2)
    return Pinhole(T_camera_world=T_camera_world, K_first=K_first, K=K, lens=lens)


def heights(params: Input, by: float) -> np.ndarray:
    """Return how tall crate and tower (2,) are in the picture with the dolly at `by`, pixels."""
    eye = pinhole_of(params, by)
    uv = project(EDGES.reshape(-1, 3), eye.T_camera_world, eye.K, eye.lens).reshape(2, 2, 2)
    return np.linalg.norm(uv[:, 1] - uv[:, 0], axis=1)


def gap(params: Input, by: float) -> float:
    """Return how far a corner in front is from its orthographic pixel, at most, with the dolly at
    `by`.

    The orthographic picture is the one to which the dolly tends, with f / Z pixels per metre.
    """
    eye = pinhole_of(params, by)
    corners = street().edges.reshape(-1, 3)
    distance = by * np.linalg.norm(np.subtract(params.target, params.camera))
    K_flat = eye.K_first.copy()
    K_flat[:2, :2] /= distance
    T = eye.T_camera_world
    miss = project(corners, T, eye.K_first) - project_orthographic(corners, T, K_flat)
    far = np.linalg.norm(miss, axis=1)
    return float(np.nanmax(far)) if np.isfinite(far).any() else float("nan")


def followed(params: Input, eye: Pinhole) -> tuple[np.ndarray, int]:
    """Return the points of the street and which one is followed: the lamp where it hangs on a
    ray.
    """
    points = street().points
    T = eye.T_camera_world
    uv = project(points[params.point : params.point + 1], T, eye.K)
    if params.z == 0.0 or not np.isfinite(uv).all():
        return points, params.point
    x, y = normalize(uv, eye.K)[0]
    points = points.copy()
    points[LAMP] = (inverse(T) @ [params.z * x, params.z * y, params.z, 1.0])[:3]
    return points, LAMP


@cached
def photograph(params: Input) -> np.ndarray:
    """Return what the true camera sees, after the edit."""
    eye = pinhole_of(params, params.dolly)
    T, K = eye.T_camera_world, eye.K_first
    picture = render(
        street_items(), T, K, width=WIDTH, height=HEIGHT, distortion=eye.lens, background=SKY
    ).colors
    if "cropped" in params.edit:
        picture = picture[CROP_TOP:, params.cut :]
    if "half" in params.edit:  # means of blocks of 2 x 2
        h, w = picture.shape[0] // 2, picture.shape[1] // 2
        blocks = picture[: 2 * h, : 2 * w].reshape(h, 2, w, 2, 3)
        picture = blocks.mean(axis=(1, 3)).round().astype(np.uint8)
    return np.ascontiguousarray(picture)


def wires(T_camera_world: np.ndarray) -> np.ndarray:
    """Return the outlines (n, 2, 3) of boxes, house, rails and ball, the last as this camera
    sees it.
    """
    scene = street()
    ball = np.zeros((0, 2, 3))
    if np.linalg.norm(camera_center(T_camera_world) - BALL_CENTER) > 1.01 * BALL_RADIUS:
        outline = sphere_outline(BALL_CENTER, BALL_RADIUS, T_camera_world, n=48)
        ball = segments(outline, closed=True)
    return np.concatenate([scene.edges, scene.rails, ball])


def _ball_ratio(T_camera_world: np.ndarray, K: np.ndarray) -> float:
    """Measure the outline's longest and shortest radius; NaN where its middle is not in the
    picture.
    """
    u, v = project(BALL_CENTER[None], T_camera_world, K)[0]
    ahead = depths(BALL_CENTER[None], T_camera_world)[0] > 1.01 * BALL_RADIUS
    if not (ahead and 0 < u < WIDTH and 0 < v < HEIGHT):
        return float("nan")
    outline = sphere_outline(BALL_CENTER, BALL_RADIUS, T_camera_world, n=7200)
    uv = project(outline, T_camera_world, K)
    middle = 0.5 * (uv.max(axis=0) + uv.min(axis=0))  # of an ellipse: its centre
    reach = np.linalg.norm(uv - middle, axis=1)
    return float(reach.max() / reach.min())
