"""Brings a person's own data into the picture, whatever their unit, size, place and upward axis.

A frame says how: p_world = scale R_world_file (p_file - centre) + offset. Its box may leave out far
points, so that a few of them do not shrink the rest.
"""

from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Literal

import numpy as np
from jaxtyping import Float

from workbench.errors import InputError
from workbench.geometry.motions import apply, exp_so3, inverse, motion

Unit = Literal["m", "cm", "mm", "km"]
METRES: dict[Unit, float] = {"m": 1.0, "cm": 0.01, "mm": 0.001, "km": 1000.0}
Up = Literal["z", "y", "-y", "x"]
Upward = Literal["auto", Up]
UPRIGHT: dict[
    Up, np.ndarray
] = {  # R_world_file: takes the axis of the file that points up to the world's +Z
    "z": np.eye(3),
    "y": np.array([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]]),
    "-y": np.array([[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0]]),
    "x": np.array([[0.0, 0.0, -1.0], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0]]),
}
FAR = 2.0  # per cent of the points at either end of an axis that may be called far


@dataclass(frozen=True, eq=False, kw_only=True)
class Frame:
    """How data of a file stand in the picture; by default as they are.

    Attributes:
        centre: The place that the picture is about, in the file's unit.
        scale: Metres of the picture per unit of the file.
        offset: Where the centre comes to in the picture, metres.
    """

    centre: np.ndarray = field(default_factory=lambda: np.zeros(3))
    scale: float = 1.0
    R_world_file: np.ndarray = field(default_factory=lambda: np.eye(3))
    offset: np.ndarray = field(default_factory=lambda: np.zeros(3))

    def shown(self, p_file: Float[np.ndarray, "*n 3"]) -> Float[np.ndarray, "*n 3"]:
        """Return points of the file as the picture has them."""
        return self.scale * (p_file - self.centre) @ self.R_world_file.T + self.offset

    def shown_motion(self, T: Float[np.ndarray, "4 4"]) -> Float[np.ndarray, "4 4"]:
        """Return the map S of shown points with S(shown(p)) = shown(T(p)); T may be affine."""
        A = T[:3, :3]
        R = self.R_world_file
        A_world = R @ A @ R.T
        moved = self.scale * R @ (apply(T, self.centre) - self.centre)
        return motion(A_world, moved + self.offset - A_world @ self.offset)

    def shown_camera(self, T_camera_file: Float[np.ndarray, "4 4"]) -> Float[np.ndarray, "4 4"]:
        """Return the pose in the picture of a camera that sees points of the file."""
        T_file_camera = inverse(T_camera_file)
        return motion(self.R_world_file @ T_file_camera[:3, :3], self.shown(T_file_camera[:3, 3]))

    def standing(self, p_file: Float[np.ndarray, "n 3"], floor: float = 0.0) -> "Frame":
        """Return the frame whose lowest point stands at the height `floor`."""
        rise = floor - self.shown(p_file)[:, 2].min()
        return replace(self, offset=self.offset + np.array([0.0, 0.0, rise]))


def frame(
    p_file: Float[np.ndarray, "n 3"], width: float, *, up: Up = "z", far: float = 0.0
) -> Frame:
    """Return the frame in which the points' box is `width` metres long, upright, about the origin.

    Where all points lie at one place, a unit of the file is `width` metres long.

    Args:
        up: The axis of the file that points up.
        far: Per cent of the points at either end of each axis that the box leaves out.
    """
    low, high = box(p_file, far)
    scale = width / (extent(p_file, far) or 1.0)
    return Frame(centre=(low + high) / 2, scale=scale, R_world_file=UPRIGHT[up])


def box(p: Float[np.ndarray, "n d"], far: float = 0.0) -> tuple[np.ndarray, np.ndarray]:
    """Return two corners of the box, `far` per cent left out at either end of each axis."""
    low, high = np.percentile(p, [far, 100.0 - far], axis=0)
    return low, high


def extent(p: Float[np.ndarray, "n d"], far: float = 0.0) -> float:
    """Return the longest edge of that box; of the box of all points where it has none."""
    low, high = box(p, far)
    return float((high - low).max()) or float(np.ptp(p, axis=0).max())


def upward(p: Float[np.ndarray, "n 3"], path: Path, up: Upward) -> Up:
    """Return the axis of a file that points up: the one that a person named, or the likely one."""
    return likely_up(p, path.suffix.lower()) if up == "auto" else up


def own_points(p: Float[np.ndarray, "n 3"], path: Path, up: Upward, *, width: float) -> np.ndarray:
    """Return the points of a person's file upright, about the origin, `width` metres long.

    Raises:
        InputError: If all of them lie at one place; names the file.
    """
    if not np.ptp(p, axis=0).max() > 0:
        raise InputError(f"{path.name}: all its points lie at one place")
    return frame(p, width, up=upward(p, path, up)).shown(p)


def likely_up(p: Float[np.ndarray, "n 3"], kind: str) -> Up:
    """Return the axis of a mesh file that is likely to point up.

    It is the one on which the mesh stands, its lowest point being near 0 or above while the other
    axis has the mesh on both sides; where neither or both are so, z in stl files (machines and
    printers), and y in all others (graphics). `kind` is the ending in lower case.
    """
    stands = p.min(axis=0) > -0.05 * extent(p)
    if stands[1] != stands[2]:
        return "y" if stands[1] else "z"
    return "z" if kind == ".stl" else "y"


def broad_side_to(
    p: Float[np.ndarray, "n 3"], eye: Float[np.ndarray, "3"], up: Up
) -> Float[np.ndarray, "3 3"]:
    """Return R_world_file: `up` becomes +Z, and a broad side of the points turns to an eye.

    It is the side that needs the smaller turn about the vertical; the eye's height does not count.
    """
    R_up = UPRIGHT[up]
    xy = (p @ R_up.T)[:, :2]
    _, _, directions = np.linalg.svd(xy - xy.mean(axis=0), full_matrices=False)
    thin = directions[1]
    ahead = eye[:2]
    thin = thin if thin @ ahead >= 0 else -thin
    turn = np.arctan2(ahead[1], ahead[0]) - np.arctan2(thin[1], thin[0])
    return exp_so3(np.array([0.0, 0.0, turn])) @ R_up


def round_below(length: float) -> float:
    """Return the largest of 1, 2, 5, 10, ... (and 0.5, 0.2, ...) up to a positive length."""
    power = 10.0 ** np.floor(np.log10(length))
    return float(power * max(digit for digit in (1, 2, 5) if digit * power <= length * (1 + 1e-9)))


def ground_grid(cell: float, height: float, reach: float = 1.5) -> Float[np.ndarray, "n 2 3"]:
    """Return segments of a level grid about the origin, squares of `cell` metres."""
    n = int(np.ceil(reach / cell))
    at = cell * np.arange(-n, n + 1)
    end = n * cell
    lines = np.array([[[x, -end, height], [x, end, height]] for x in at])
    return np.concatenate([lines, lines[:, :, [1, 0, 2]]])
