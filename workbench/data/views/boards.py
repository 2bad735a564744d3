"""A checkerboard before a camera: seeded poses, what goes wrong with a print, its corners."""

from typing import Literal

import numpy as np
from jaxtyping import Float, Int, UInt8

from workbench.geometry.cameras import intrinsics, project
from workbench.geometry.cameras.distortion import Distortion
from workbench.geometry.motions import exp_so3, motion

# inner corners, and the edge of a square in metres
COLUMNS = 9
ROWS = 6
SQUARE = 0.025
SIZE = (640, 480)
K_TRUE = intrinsics(536.0, 342.0, 236.0)
LENS_TRUE = Distortion(k1=-0.27, k2=0.05, p1=0.0015, p2=-0.0005)
Fault = Literal["none", "stretched 2 %", "stretched 0.5 %", "2 % larger", "bent 1 mm"]
STRETCH: dict[Fault, tuple[float, float]] = {
    "stretched 2 %": (1.02, 1.0),
    "stretched 0.5 %": (1.005, 1.0),
    "2 % larger": (1.02, 1.02),
}
_TRIES = 40
_MARGIN = 3.0  # pixels that corners stay away from the border


def board_points(
    columns: int = COLUMNS, rows: int = ROWS, square: float = SQUARE
) -> Float[np.ndarray, "n 3"]:
    """Return a board's inner corners, metres: row by row, Z = 0, first at the origin."""
    y, x = np.mgrid[:rows, :columns]
    return square * np.stack([x.ravel(), y.ravel(), np.zeros(columns * rows)], axis=1)


def printed(p_board: Float[np.ndarray, "n 3"], fault: Fault) -> Float[np.ndarray, "n 3"]:
    """Return where points of the board really are, metres, with a fault of the print.

    Stretched prints are too long along x only; a bent one is bowed along x, towards -Z.
    """
    if fault == "bent 1 mm":
        middle, half = SQUARE * (COLUMNS - 1) / 2, SQUARE * (COLUMNS - 1) / 2
        bow = 1.0 - ((p_board[:, 0] - middle) / half) ** 2
        return p_board - 0.001 * np.maximum(bow, 0.0)[:, None] * [0.0, 0.0, 1.0]
    return p_board * [*STRETCH.get(fault, (1.0, 1.0)), 1.0]


def board_mesh() -> tuple[
    Float[np.ndarray, "v 3"], Int[np.ndarray, "f 3"], UInt8[np.ndarray, "f 3"]
]:
    """Return the squares as triangles: corners in metres, faces, and a colour per face."""
    j, i = (axis.ravel() for axis in np.mgrid[-1:ROWS, -1:COLUMNS])
    corner = np.stack([i, j, np.zeros_like(i)], axis=1)
    p = SQUARE * (corner[:, None] + np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]])).reshape(
        -1, 3
    )
    faces = (4 * np.arange(len(i))[:, None, None] + np.array([[0, 1, 2], [0, 2, 3]])).reshape(-1, 3)
    shade = np.where((i + j) % 2 == 0, 60, 245).astype(np.uint8)
    return p, faces, np.repeat(shade, 2)[:, None].repeat(3, axis=1)


def board_poses(
    rng: np.random.Generator, views: int, *, tilt: float, distance: float, spread: float
) -> Float[np.ndarray, "k 4 4"]:
    """Return T_camera_board of so many views that show the whole board.

    The same generator gives the same places and directions at every tilt, distance and spread, as
    far as they fit.

    Args:
        tilt: Boards are turned away from the picture's plane by 0.6 to 1.2 times this, radians.
        distance: Boards' middles are 0.9 to 1.3 times this away, metres.
        spread: How far boards go to the sides: 0 stays in the middle, 1 covers the picture.
    """
    p_board = board_points()
    middle = p_board.mean(axis=0)
    chance = rng.uniform(-1.0, 1.0, (views, _TRIES, 6))
    poses = []
    for tries in chance:
        T = np.eye(4)
        for k, (axis, turn, roll, right, down, away) in enumerate(tries):
            size = tilt * (0.9 + 0.3 * turn)
            n = np.array([np.cos(np.pi * axis), np.sin(np.pi * axis), 0.0])
            R = exp_so3(size * n) @ exp_so3(np.array([0.0, 0.0, 0.6 * roll]))
            depth = distance * (1.1 + 0.2 * away)
            # from the sides to the middle, until all is in the picture
            inwards = 1.0 - k / (_TRIES - 1)
            aside = inwards * spread * depth * np.array([0.38 * right, 0.3 * down])
            T = motion(R, np.array([*aside, depth]) - R @ middle)
            uv = project(p_board, T, K_TRUE, LENS_TRUE)
            if (uv > _MARGIN).all() and (uv < np.array(SIZE) - _MARGIN).all():
                break
        poses.append(T)
    return np.stack(poses)


def board_pixels(
    rng: np.random.Generator,
    Ts_camera_board: Float[np.ndarray, "k 4 4"],
    *,
    sigma: float,
    fault: Fault = "none",
    bad_corners: int = 0,
) -> Float[np.ndarray, "k n 2"]:
    """Return the measured pixels of all corners in every view.

    Args:
        sigma: Standard deviation of each coordinate, pixels.
        bad_corners: So many corners of the second view were taken for something 5 px away.
    """
    p = printed(board_points(), fault)
    uv = np.stack([project(p, T, K_TRUE, LENS_TRUE) for T in Ts_camera_board])
    uv += sigma * rng.standard_normal(uv.shape)
    if bad_corners:
        uv[1, (np.arange(bad_corners) * COLUMNS) % len(p) + np.arange(bad_corners) // ROWS] += [
            4.0,
            3.0,
        ]
    return uv
