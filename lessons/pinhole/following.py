"""Follows points through a pinhole camera with a lens: world, camera, division by depth, lens,
pixels, and back.

Reference: Hartley and Zisserman, Multiple View Geometry, 2nd ed., 6.1 (the camera) and 7.4 (the
lens).
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np
from jaxtyping import Float

from workbench.geometry.cameras import distortion
from workbench.geometry.cameras import pinhole as cameras
from workbench.geometry.cameras.distortion import Distortion, is_invertible, undistort
from workbench.geometry.motions import apply
from workbench.tracing import traced

Project = Callable[[np.ndarray, np.ndarray, np.ndarray], np.ndarray]
"""project(p_world, T_camera_world, K) -> pixels (n, 2) without a lens, NaN for points behind the
camera.
"""
Distort = Callable[[np.ndarray, float, float, float, float], np.ndarray]
"""distort(xy_camera, k1, k2, p1, p2) -> where the lens puts normalised points (n, 2)."""
Center = Callable[[np.ndarray], np.ndarray]
"""camera_center(T_camera_world) -> where the camera is, in the world (3,)."""

Stage = Literal["world", "camera", "divide", "distort", "pixels", "back"]
STAGES: tuple[Stage, ...] = ("world", "camera", "divide", "distort", "pixels", "back")


@dataclass(frozen=True, eq=False)
class State:
    """How far the points have come; numbers are NaN before their stage, and for points that drop
    out.

    Attributes:
        stage: The last stage done.
        p_world: The points (n, 3), metres.
        p_camera: The same in the camera frame.
        xy: On the plane one metre in front of the camera (n, 2), without the lens.
        xy_bent: There, where the lens puts them.
        uv: Pixels (n, 2).
        p_center: The camera centre (3,) from which the rays start, in the world.
        p_back: The points that pixels and depths give back, in the world.
    """

    stage: Stage
    p_world: np.ndarray
    p_camera: np.ndarray
    xy: np.ndarray
    xy_bent: np.ndarray
    uv: np.ndarray
    p_center: np.ndarray
    p_back: np.ndarray

    def reached(self, stage: Stage) -> bool:
        """Return whether a stage is done."""
        return STAGES.index(stage) <= STAGES.index(self.stage)

    def seen(self, K: Float[np.ndarray, "3 3"]) -> Float[np.ndarray, "n 2"]:
        """Return the pixels so far; before the stage that makes them, this K does."""
        if self.reached("pixels"):
            return self.uv
        return onto_pixels(self.xy_bent if self.reached("distort") else self.xy, K)


def start(p_world: np.ndarray) -> State:
    """Return the state in which only the points in the world are known."""
    space = np.full_like(p_world, np.nan)
    plane = np.full((len(p_world), 2), np.nan)
    return State("world", p_world, space, plane, plane, plane, np.full(3, np.nan), space)


@traced
def follow(
    p_world: Float[np.ndarray, "n 3"],
    T_camera_world: Float[np.ndarray, "4 4"],
    K: Float[np.ndarray, "3 3"],
    *,
    lens: Distortion,
    project: Project = cameras.project,
    distort: Distort = distortion.distort,
    camera_center: Center = cameras.camera_center,
    depth: Float[np.ndarray, " n"] | None = None,
) -> Iterator[State]:
    """Yield the points on their way from the world to pixels, one stage per state, and then back
    along their rays.

    Args:
        p_world: Points, metres.
        T_camera_world: World-to-camera motion, metres.
        K: Intrinsics, pixels.
        lens: The lens (k3 is not used).
        project: The pinhole without a lens; NaN where it sees nothing.
        distort: The lens on normalised coordinates.
        camera_center: Where the rays start.
        depth: What is taken for the depth of each pixel on the way back, metres; Z where it is not
            given.
    """
    state = start(p_world)
    yield state

    p_camera = apply(T_camera_world, p_world)  # X_cam = R X + t (6.6)
    state = replace(state, stage="camera", p_camera=p_camera)
    yield state

    # (X / Z, Y / Z) (6.2), K taken off again
    xy = off_pixels(project(p_world, T_camera_world, K), K)
    state = replace(state, stage="divide", xy=xy)
    yield state

    seen = is_invertible(xy, lens)  # a folded point would look valid
    xy_bent = np.full_like(xy, np.nan)
    # (7.6), with tangential terms
    xy_bent[seen] = distort(xy[seen], lens.k1, lens.k2, lens.p1, lens.p2)
    state = replace(state, stage="distort", xy_bent=xy_bent)
    yield state

    uv = onto_pixels(xy_bent, K)  # (u, v, 1) = K (x, y, 1) (6.4)
    state = replace(state, stage="pixels", uv=uv)
    yield state

    xy_back = undistort(off_pixels(uv, K), lens)
    # one metre of depth along each ray
    v_camera = np.column_stack([xy_back, np.ones(len(xy_back))])
    p_center = camera_center(T_camera_world)  # C = -R^T t (6.7)
    z = p_camera[:, 2] if depth is None else depth
    p_back = p_center + z[:, None] * (v_camera @ T_camera_world[:3, :3])  # rows: v R is R^T v
    yield replace(state, stage="back", p_center=p_center, p_back=p_back)


def onto_pixels(
    xy: Float[np.ndarray, "n 2"], K: Float[np.ndarray, "3 3"]
) -> Float[np.ndarray, "n 2"]:
    """Return the pixels of points on the plane one metre in front of the camera.

    Takes (x, y) = (X/Z, Y/Z) to (u, v); both without a lens.
    """
    return xy @ K[:2, :2].T + K[:2, 2]


def off_pixels(
    uv: Float[np.ndarray, "n 2"], K: Float[np.ndarray, "3 3"]
) -> Float[np.ndarray, "n 2"]:
    """Return the points, on the plane one metre in front of the camera, that these pixels show:
    `onto_pixels` undone.
    """
    return (uv - K[:2, 2]) @ np.linalg.inv(K[:2, :2]).T
