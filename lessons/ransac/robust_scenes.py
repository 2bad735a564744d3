"""Seeded scenes for robust fitting: points or matches, most of them of one model, the others of
none or of another.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Float

from workbench.geometry.motions import exp_so3, motion
from workbench.geometry.shapes.lines_planes import plane_from_points
from workbench.geometry.two_views.epipolar import fundamental_from_cameras
from workbench.geometry.two_views.homography import transform_pixels

IMAGE_SIZE = (640, 480)
_K = np.array([[600.0, 0.0, 319.5], [0.0, 600.0, 239.5], [0.0, 0.0, 1.0]])


@dataclass(frozen=True, eq=False)
class RobustScene:
    """Rows to fit a model to, and what is true of them.

    Attributes:
        p: The rows: points in metres, or matches (u, v, u', v') in pixels. Shuffled.
        is_inlier: Which rows were made from the model.
        truth: The model: a line (a, b, c), plane (a, b, c, d), circle (x, y, r), sphere (x, y, z,
            r), H or F.
        p_true: The inliers without their noise, for the error to the truth.
        quality: How much each row is trusted before anything is fitted, as by the score of a match.
            Inliers mostly have more.
        is_other: Which rows were made from a second model, where there is one.
    """

    p: Float[np.ndarray, "n d"]
    is_inlier: Bool[np.ndarray, " n"]
    truth: Float[np.ndarray, "..."]
    p_true: Float[np.ndarray, "m d"]
    quality: Float[np.ndarray, " n"]
    is_other: Bool[np.ndarray, " n"] | None = None


def line_scene(
    rng: np.random.Generator, *, count: int, outlier_ratio: float, sigma: float
) -> RobustScene:
    """Return points along a line across a window of 2 m by 2 m, with clutter above it, which
    drags least squares up.
    """
    inliers, outliers = _split(count, outlier_ratio)
    slope = rng.uniform(-0.3, 0.3)
    height = rng.uniform(-0.6, -0.3)
    x = rng.uniform(-1.0, 1.0, inliers)
    p_true = np.column_stack([x, height + slope * x])
    clutter = np.column_stack(
        [rng.uniform(-1.0, 1.0, outliers), rng.uniform(0.0, 1.0, outliers) ** 0.7 - 0.1]
    )
    truth = np.array([-slope, 1.0, -height]) / np.hypot(slope, 1.0)
    return _mixed(rng, p_true, clutter, truth=truth, sigma=sigma)


def scattered_line_scene(
    rng: np.random.Generator, *, count: int, outlier_ratio: float, sigma: float
) -> RobustScene:
    """Return points of y = 0.25 x - 0.1, then clutter all over a window of 2 m, near the line
    too. Not shuffled.
    """
    inliers, outliers = _split(count, outlier_ratio)
    x = rng.uniform(-1.0, 1.0, inliers)
    p_true = np.column_stack([x, 0.25 * x - 0.1])
    clutter = rng.uniform(-1.0, 1.0, (outliers, 2))
    p = np.concatenate([p_true + sigma * rng.normal(size=p_true.shape), clutter])
    truth = np.array([-0.25, 1.0, 0.1]) / np.hypot(0.25, 1.0)
    return RobustScene(p, np.arange(count) < inliers, truth, p_true, np.ones(count))


def plane_scene(
    rng: np.random.Generator, *, count: int, outlier_ratio: float, sigma: float
) -> RobustScene:
    """Return points of a tilted table top of 2 m by 2 m, with clutter standing on it, which
    drags least squares up.
    """
    inliers, outliers = _split(count, outlier_ratio)
    truth, up = _table(rng)
    p_true = up(rng.uniform(-1.0, 1.0, (inliers, 2)), np.zeros(inliers))
    clutter = up(_clutter_places(rng, outliers), 1.2 * rng.random(outliers) ** 1.3)
    return _mixed(rng, p_true, clutter, truth=truth, sigma=sigma)


def two_planes_scene(
    rng: np.random.Generator, *, count: int, outlier_ratio: float, sigma: float, wall: float = 2.0
) -> RobustScene:
    """Return a small table top, the truth, beside a wall with `wall` times as many points, and
    clutter.
    """
    inliers, outliers = _split(count, outlier_ratio)
    table = max(1, round(inliers / (1.0 + wall)))
    truth, up = _table(rng)
    p_true = up(rng.uniform(-1.0, 1.0, (table, 2)), np.zeros(table))
    foot = np.column_stack([np.full(inliers - table, 1.0), rng.uniform(-1.0, 1.0, inliers - table)])
    on_wall = up(foot[:, ::-1], 1.6 * rng.random(inliers - table))
    on_wall += sigma * rng.normal(size=on_wall.shape)
    clutter = up(_clutter_places(rng, outliers), 1.2 * rng.random(outliers) ** 1.3)
    others = np.concatenate([on_wall, clutter])
    return _mixed(rng, p_true, others, truth=truth, sigma=sigma, other=len(on_wall))


def wire_scene(
    rng: np.random.Generator, *, count: int, outlier_ratio: float, sigma: float
) -> RobustScene:
    """Return a table top with two thirds of its points exactly along a taut wire: samples of the
    wire are degenerate.

    The first three rows are points of the wire.
    """
    inliers, outliers = _split(count, outlier_ratio)
    wired = 2 * inliers // 3
    truth, up = _table(rng)
    along = rng.uniform(-1.0, 1.0, wired)
    along[:3] = -0.7, 0.1, 0.8
    wire = up(np.column_stack([along, np.full(wired, 0.25)]), np.zeros(wired))
    rest = up(rng.uniform(-1.0, 1.0, (inliers - wired, 2)), np.zeros(inliers - wired))
    clutter = up(_clutter_places(rng, outliers), 1.2 * rng.random(outliers) ** 1.3)
    noisy = rest + sigma * rng.normal(size=rest.shape)
    scene = _mixed(rng, np.concatenate([wire, noisy]), clutter, truth=truth, sigma=0.0, first=3)
    return RobustScene(scene.p, scene.is_inlier, truth, np.concatenate([wire, rest]), scene.quality)


def circle_scene(
    rng: np.random.Generator, *, count: int, outlier_ratio: float, sigma: float
) -> RobustScene:
    """Return points of two thirds of a circle in a window of 2 m by 2 m, with clutter mostly to
    one side.
    """
    inliers, outliers = _split(count, outlier_ratio)
    center = rng.uniform(-0.35, 0.0, 2)
    radius = rng.uniform(0.45, 0.6)
    angle = rng.uniform(0.0, 2.0) * np.pi + rng.uniform(0.0, 4.0 / 3.0, inliers) * np.pi
    p_true = center + radius * np.column_stack([np.cos(angle), np.sin(angle)])
    clutter = 1.0 - 2.0 * rng.random((outliers, 2)) ** 1.5
    return _mixed(rng, p_true, clutter, truth=np.append(center, radius), sigma=sigma)


def sphere_scene(
    rng: np.random.Generator, *, count: int, outlier_ratio: float, sigma: float
) -> RobustScene:
    """Return points of the upper half of a ball, with clutter in a box of 2 m around it."""
    inliers, outliers = _split(count, outlier_ratio)
    center = np.append(rng.uniform(-0.3, 0.3, 2), 0.3)
    radius = rng.uniform(0.4, 0.55)
    direction = rng.normal(size=(inliers, 3))
    direction[:, 2] = np.abs(direction[:, 2])
    p_true = center + radius * direction / np.linalg.norm(direction, axis=1, keepdims=True)
    clutter = rng.uniform([-1.0, -1.0, 0.0], [1.0, 1.0, 1.5], (outliers, 3))
    return _mixed(rng, p_true, clutter, truth=np.append(center, radius), sigma=sigma)


def match_scene(
    rng: np.random.Generator, *, count: int, outlier_ratio: float, sigma: float, flat: bool = False
) -> RobustScene:
    """Return matches between two views, 640 by 480 pixels, of a deep scene (truth: F) or of one
    wall (truth: H).

    The noise is in both views; a wrong match joins any two pixels. H takes pixels of the first view
    to the second.
    """
    inliers, outliers = _split(count, outlier_ratio)
    turn = exp_so3(rng.normal(size=3) * [0.04, 0.06, 0.1] + [0.0, -0.15, 0.0])
    T_second_first = motion(turn, np.array([1.0, *rng.normal(size=2) * [0.2, 0.2]]))
    normal = np.append(rng.uniform(-0.35, 0.35, 2), -1.0)
    size = np.array(IMAGE_SIZE, float)
    uv_first, uv_second = np.zeros((0, 2)), np.zeros((0, 2))
    while len(uv_first) < inliers:
        uv = rng.uniform(0.0, size - 1.0, (2 * inliers, 2))
        rays = np.column_stack([(uv - _K[:2, 2]) / _K[0, 0], np.ones(len(uv))])
        # On the wall, normal . (depth ray) = -7; in the deep scene, anything from 4 to 12 m.
        depth = -7.0 / (rays @ normal) if flat else rng.uniform(4.0, 12.0, len(uv))
        p_second = rays * depth[:, None] @ T_second_first[:3, :3].T + T_second_first[:3, 3]
        seen = transform_pixels(_K, p_second[:, :2] / p_second[:, 2:])
        kept = (p_second[:, 2] > 0.0) & (seen >= 0.0).all(1) & (seen <= size - 1.0).all(1)
        uv_first = np.concatenate([uv_first, uv[kept]])
        uv_second = np.concatenate([uv_second, seen[kept]])
    p_true = np.concatenate([uv_first, uv_second], axis=1)[:inliers]
    wrong = rng.uniform(0.0, np.tile(size - 1.0, 2), (outliers, 4))
    truth = fundamental_from_cameras(_K, _K, T_second_first)
    if flat:
        truth = (
            _K
            @ (T_second_first[:3, :3] - np.outer(T_second_first[:3, 3], normal) / 7.0)
            @ np.linalg.inv(_K)
        )
        truth = truth / np.linalg.norm(truth)
    return _mixed(rng, p_true, wrong, truth=truth, sigma=sigma)


def wall_matches(
    rng: np.random.Generator, *, count: int, outlier_ratio: float, sigma: float
) -> RobustScene:
    """Return matches between two views of one wall: as `match_scene`, with H as the truth."""
    return match_scene(rng, count=count, outlier_ratio=outlier_ratio, sigma=sigma, flat=True)


def _split(count: int, outlier_ratio: float) -> tuple[int, int]:
    if not (count >= 1 and 0.0 <= outlier_ratio < 1.0):
        raise ValueError(
            f"count >= 1 and 0 <= outlier_ratio < 1 are needed, not {count} and {outlier_ratio}"
        )
    outliers = min(round(count * outlier_ratio), count - 1)
    return count - outliers, outliers


def _table(
    rng: np.random.Generator,
) -> tuple[np.ndarray, Callable[[np.ndarray, np.ndarray], np.ndarray]]:
    """Return a tilted plane, and the function that puts places on it, at heights above it, into
    the world.
    """
    R_world_table = exp_so3(np.append(rng.uniform(-0.15, 0.15, 2), 0.0))
    shift = np.array([0.0, 0.0, rng.uniform(-0.05, 0.05)])

    def up(places: np.ndarray, heights: np.ndarray) -> np.ndarray:
        return np.column_stack([places, heights]) @ R_world_table.T + shift

    return plane_from_points(up(np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]), np.zeros(3))), up


def _clutter_places(rng: np.random.Generator, count: int) -> np.ndarray:
    """Return places on the table, more of them towards one side."""
    return 1.0 - 2.0 * rng.random((count, 2)) ** [1.6, 1.0]


def _mixed(
    rng: np.random.Generator,
    p_true: np.ndarray,
    others: np.ndarray,
    *,
    truth: np.ndarray,
    sigma: float,
    first: int = 0,
    other: int = 0,
) -> RobustScene:
    """Add the noise and the qualities, and shuffle all rows but the first few.

    The first `other` of the others are of a second model.
    """
    noisy = p_true + sigma * rng.normal(size=p_true.shape)
    p = np.concatenate([noisy, others])
    rows = np.arange(len(p))
    end = len(p_true)
    is_inlier = rows < end
    is_other = (rows >= end) & (rows < end + other)
    quality = np.clip(rng.normal(np.where(is_inlier, 0.65, 0.4), 0.15), 0.0, 1.0)
    order = np.append(np.arange(first), first + rng.permutation(len(p) - first))
    known = is_other[order] if other else None
    return RobustScene(p[order], is_inlier[order], truth, p_true, quality[order], known)
