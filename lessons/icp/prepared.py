"""Where the scans of a run come from: built-in shapes, a lidar on a street, or the person's own files."""

import functools
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
import scipy

from lessons.icp.params import Params, Planes, Thinning, Unit, Up
from lessons.icp.scans import WIDTH, Scans
from workbench.data.clouds import pair
from workbench.data.files import read_cloud, read_pose
from workbench.data.lidar import lidar_pair
from workbench.data.thinning import voxel_means
from workbench.errors import InputError
from workbench.geometry.motions import apply, exp_so3, inverse, motion
from workbench.geometry.normals import on_a_line, point_normals

METRES: dict[Unit, float] = {"m": 1.0, "km": 1000.0, "cm": 0.01, "mm": 0.001}
UPRIGHT: dict[Up, float] = {"z": 0.0, "y": np.pi / 2, "-y": -np.pi / 2}  # radians about the x axis
RINGS, COLUMNS = 32, 900


@dataclass(frozen=True)
class _Thin:
    """How large scans are thinned."""

    how: Thinning
    voxel: float
    most: int
    seed: int


def scans_of(params: Params) -> Scans:
    """Return the scans that the params describe.

    Raises:
        InputError: If an own file cannot be used, or only one of the two scans is given.
    """
    own = (params.target, params.source, params.truth) != (None, None, None)
    scans = _own(params) if own else _lidar(params) if params.shape == "lidar" else _built_in(params)
    v_world, w_world = np.array(params.guess[:3]), np.array(params.guess[3:])
    T_start = scans.about_centre(w_world)  # the handle turns about the middle of the picture
    T_start[:3, 3] += scans.R_world_target.T @ v_world / scans.scale
    return replace(scans, T_start=T_start)


def _true_motion(params: Params) -> np.ndarray:
    turn = exp_so3(np.array([0.0, 0.0, np.radians(params.start_angle)]))
    return motion(turn, np.array([params.start_shift, 0.0, 0.0]))


def _built_in(params: Params) -> Scans:
    T_truth = _true_motion(params)
    home = _sampled(params.shape, params.points, params.overlap, params.noise, params.outliers, params.seed)
    p_source = apply(inverse(T_truth), home.p_source)
    return replace(home, p_source=p_source, p_source_shown=p_source, T_truth=T_truth)


@functools.lru_cache(maxsize=16)
def _sampled(shape: str, points: int, overlap: float, noise: float, outliers: float, seed: int) -> Scans:
    """Return the scans before the source is turned away: the same arrays whatever the start."""
    rng = np.random.default_rng(seed)
    scans = pair(shape, points, np.eye(4), rng, overlap=overlap, noise=noise, outliers=outliers)
    p, q = scans.p_target, scans.p_source
    return Scans(
        p, q, scans.is_outlier, np.eye(4), np.eye(4), np.zeros(3), 1.0, np.eye(3), _spacing(p), _grid(0.5, -0.35), 0.5,
        p, q, _normals_when_asked(p, "all"),
    )  # fmt: skip


def _lidar(params: Params) -> Scans:
    thin = _Thin(params.thinning, params.voxel, params.own_points, params.seed)
    return _driven(params.start_angle, params.start_shift, params.noise, thin, params.planes)


@functools.lru_cache(maxsize=8)
def _driven(start_angle: float, start_shift: float, noise: float, thin: _Thin, planes: Planes) -> Scans:
    """Return the scans before and after the scanner has moved: other rings on the same street."""
    T_truth = _true_motion(Params(start_angle=start_angle, start_shift=start_shift))
    rng = np.random.default_rng(thin.seed)
    p_target, p_source = lidar_pair(T_truth, rng, rings=RINGS, columns=COLUMNS, noise=noise)
    return replace(_framed(*_thinned(p_target, p_source, thin), "z", planes), T_truth=T_truth)


def _own(params: Params) -> Scans:
    if params.target is None or params.source is None:
        raise InputError("own scans come in pairs: give both a target and a source")
    for scan in (params.target, params.source):
        read_cloud(scan)  # so that a bad file is refused before anything else
    T_truth = None if params.truth is None else read_pose(params.truth, params.target, params.source).copy()
    if T_truth is not None:
        T_truth[:3, 3] *= METRES[params.unit]
    changed = (params.target.stat().st_mtime_ns, params.source.stat().st_mtime_ns)
    thin = _Thin(params.thinning, params.voxel, params.own_points, params.seed)
    scans = _read(params.target, params.source, changed, thin, params.unit, params.up, params.planes)
    return replace(scans, T_truth=T_truth)


@functools.lru_cache(maxsize=8)
def _read(
    target: Path, source: Path, _changed: tuple[int, int], thin: _Thin, unit: Unit, up: Up, planes: Planes
) -> Scans:
    """Thin own scans and bring them into the picture; anew when a file has changed."""
    p_target, p_source = (METRES[unit] * read_cloud(scan) for scan in (target, source))
    if not _extent(p_target) > 0:
        raise InputError(f"{target.name}: all its points lie at one place")
    return _framed(*_thinned(p_target, p_source, thin), up, planes)


def _thinned(p_target: np.ndarray, p_source: np.ndarray, thin: _Thin) -> tuple[np.ndarray, np.ndarray]:
    """Thin both scans by the same voxels, and draw at most so many points of the source by chance."""
    if thin.how == "voxel":
        size = thin.voxel / 100.0 * _extent(p_target)
        p_target, p_source = voxel_means(p_target, size), voxel_means(p_source, size)
    if len(p_source) > thin.most:
        rng = np.random.default_rng(thin.seed)
        p_source = p_source[np.sort(rng.choice(len(p_source), thin.most, replace=False))]
    return p_target, p_source


def _framed(p_target: np.ndarray, p_source: np.ndarray, up: Up, planes: Planes) -> Scans:
    """Bring scans of any size and place into the picture, WIDTH wide and upright about the target's middle."""
    low, high = _bulk(p_target)
    centre, scale = (low + high) / 2, WIDTH / (_extent(p_target) or 1.0)
    R_world_target = exp_so3(np.array([UPRIGHT[up], 0.0, 0.0]))
    target_shown, source_shown = (scale * (p - centre) @ R_world_target.T for p in (p_target, p_source))
    cell = _round_below(0.5 / scale)
    return Scans(
        p_target, p_source, np.zeros(len(p_source), bool), None, np.eye(4), centre, scale, R_world_target,
        _spacing(p_target), _grid(scale * cell, float(np.percentile(target_shown[:, 2], 1))), cell, target_shown,
        source_shown, _normals_when_asked(p_target, planes),
    )  # fmt: skip


def _bulk(p: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the ends of the box that holds nearly all points: a few far ones must not shrink the picture."""
    low, high = np.percentile(p, [2, 98], axis=0)
    return low, high


def _extent(p: np.ndarray) -> float:
    """Return the longest edge of that box; of the whole cloud where nearly all points coincide."""
    low, high = _bulk(p)
    return float((high - low).max()) or float(np.ptp(p, axis=0).max())


def _round_below(length: float) -> float:
    """Return the largest of 1, 2, 5, 10, ... (and 0.5, 0.2, ...) that is no longer."""
    power = 10.0 ** np.floor(np.log10(length))
    return float(power * max(digit for digit in (1, 2, 5) if digit * power <= length * (1 + 1e-9)))


def _grid(cell: float, height: float) -> np.ndarray:
    """Return the segments of a square ground grid about the origin."""
    n = int(np.ceil(1.5 / cell))
    at, end = cell * np.arange(-n, n + 1), n * cell
    lines = np.array([[[x, -end, height], [x, end, height]] for x in at])
    return np.concatenate([lines, lines[:, :, [1, 0, 2]]])


def _normals_when_asked(p: np.ndarray, planes: Planes) -> Callable[[], np.ndarray]:
    def normals() -> np.ndarray:
        pull = ~on_a_line(p) if planes == "spread" else np.ones(len(p), bool)
        return point_normals(p) * (pull if pull.any() else ~pull)[:, None]

    return functools.cache(normals)


def _spacing(p: np.ndarray) -> float:
    """Return the median distance to the nearest other place with a point, from a few hundred points."""
    places = np.unique(p, axis=0)
    some = places[:: max(1, len(places) // 400)]
    distances = np.asarray(scipy.spatial.KDTree(places).query(some, k=min(2, len(places)))[0])
    return float(np.median(distances.reshape(len(some), -1)[:, -1])) or 1e-9
