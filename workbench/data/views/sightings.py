"""Known points and where a camera saw them: made ones, and those that people bring."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from jaxtyping import Bool, Float

from workbench.apart import apart
from workbench.data.files import finite, number_rows
from workbench.data.files.formats import is_number
from workbench.errors import InputError
from workbench.geometry.cameras import project

MOST = 2000


@dataclass(frozen=True, eq=False)
class Sightings:
    """World points, metres, their pixels, and which are outliers, where that is known."""

    p_world: Float[np.ndarray, "n 3"]
    uv: Float[np.ndarray, "n 2"]
    is_outlier: Bool[np.ndarray, " n"]


def seen(
    p_world: Float[np.ndarray, "n 3"],
    T_camera_world: Float[np.ndarray, "4 4"],
    K: Float[np.ndarray, "3 3"],
    *,
    rng: np.random.Generator,
    sigma: float,
    is_outlier: Bool[np.ndarray, " n"],
) -> Sightings:
    """Return how a camera sees points, all in front of it, with noise of `sigma` pixels.

    Outliers are seen somewhere in the box around all pixels.
    """
    uv = project(p_world, T_camera_world, K)
    low, high = uv.min(axis=0), uv.max(axis=0)
    noise = sigma * rng.standard_normal(uv.shape)
    anywhere = rng.uniform(low, high, uv.shape)
    return Sightings(p_world, np.where(is_outlier[:, None], anywhere, uv + noise), is_outlier)


def some_of(n: int, share: float, rng: np.random.Generator) -> Bool[np.ndarray, " n"]:
    """Return which of n rows chance picks, so many as the share says."""
    return rng.permutation(n) < round(share * n)


def points_on_box(
    size: Float[np.ndarray, "3"], n: int, rng: np.random.Generator
) -> Float[np.ndarray, "n 3"]:
    """Return points on the faces of a box about the origin, each pair of faces alike, metres."""
    p = rng.uniform(-0.5, 0.5, (n, 3))
    axis = rng.integers(0, 3, n)
    p[np.arange(n), axis] = np.where(rng.random(n) < 0.5, -0.5, 0.5)
    return p * size


def random_views(
    count: int, n: int, rng: np.random.Generator
) -> tuple[
    Float[np.ndarray, "count 3 3"], Float[np.ndarray, "count n 3"], Float[np.ndarray, "count n 2"]
]:
    """Return cameras' R_camera_world, n points 4 to 8 m before each, and their images."""
    z = rng.uniform(4.0, 8.0, (count, n, 1))
    p_camera = np.concatenate([rng.uniform(-2.0, 2.0, (count, n, 2)), z], axis=2)
    R_camera_world, _ = np.linalg.qr(rng.standard_normal((count, 3, 3)))
    R_camera_world *= np.linalg.det(R_camera_world)[:, None, None]  # no reflections
    return R_camera_world, p_camera @ R_camera_world, p_camera[..., :2] / z


@apart
def read_sightings(path: Path) -> Sightings:
    """Return the rows X Y Z u v of a text file (txt, csv): world points in metres and their pixels.

    Raises:
        InputError: If the file cannot be read, or has other, too few, too many or not finite rows.
    """
    rows = []
    for i, words in number_rows(path, "points with their pixels", (".txt", ".csv")):
        if len(words) != 5 or not all(is_number(word) for word in words):
            raise InputError(f"{path.name}, line {i}: five numbers are wanted, X Y Z u v")
        rows.append([float(word) for word in words])
    table = finite(np.array(rows).reshape(-1, 5), path.name)
    if not 4 <= len(table) <= MOST:
        raise InputError(f"{path.name}: {len(table)} points; 4 to {MOST} are read")
    return Sightings(table[:, :3], table[:, 3:], np.zeros(len(table), bool))
