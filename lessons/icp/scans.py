"""Where the scans of a run come from: built-in shapes, a lidar on a street, or the person's own
files.
"""

import functools
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np

from lessons.icp.state import Params, Planes, Scans
from workbench.data.files import read_cloud, read_pose, stamp
from workbench.data.framing import FAR, METRES, Frame, Up, extent, frame, ground_grid, round_below
from workbench.data.shapes.clouds import pair
from workbench.data.shapes.lidar import lidar_pair
from workbench.data.thinning import some_points, spacing, voxel_means
from workbench.errors import InputError
from workbench.geometry.motions import apply, exp_so3, inverse, motion
from workbench.geometry.points.normals import point_normals
from workbench.knobs import called, only

RINGS, COLUMNS = 32, 900
WIDTH = 1.2  # metres of the picture that large or small scans are shown wide
LARGE = (
    "thinning",
    "voxel",
    "own_points",
    "seed",
    "planes",
)  # what becomes of scans of any size depends on these


def scans_of(params: Params) -> Scans:
    """Return the scans that the params describe.

    Raises:
        InputError: If an own file cannot be used, or only one of the two scans is given.
    """
    own = (params.target, params.source, params.truth) != (None, None, None)
    scans = (
        _own(params) if own else _lidar(params) if params.shape == "lidar" else _built_in(params)
    )
    v_world, w_world = np.array(params.guess[:3]), np.array(params.guess[3:])
    T_start = scans.about_centre(w_world)  # the handle turns about the middle of the picture
    T_start[:3, 3] += scans.frame.R_world_file.T @ v_world / scans.frame.scale
    return replace(scans, T_start=T_start)


def _true_motion(params: Params) -> np.ndarray:
    turn = exp_so3(np.array([0.0, 0.0, np.radians(params.start_angle)]))
    return motion(turn, np.array([params.start_shift, 0.0, 0.0]))


def _built_in(params: Params) -> Scans:
    T_truth = _true_motion(params)
    home = _sampled(only(params, "shape", "points", "overlap", "noise", "outliers", "seed"))
    p_source = apply(inverse(T_truth), home.p_source)
    return replace(home, p_source=p_source, p_source_shown=p_source, T_truth=T_truth)


@functools.lru_cache(maxsize=16)
def _sampled(params: Params) -> Scans:
    """Return the scans before the source is turned away: the same arrays whatever the start."""
    rng = np.random.default_rng(params.seed)
    wrong = {"overlap": params.overlap, "noise": params.noise, "outliers": params.outliers}
    scans = pair(params.shape, params.points, np.eye(4), rng, **wrong)
    p, q = scans.p_target, scans.p_source
    return Scans(
        p_target=p,
        p_source=q,
        is_outlier=scans.is_outlier,
        T_truth=np.eye(4),
        T_start=np.eye(4),
        frame=Frame(),
        spacing=spacing(p),
        grid=ground_grid(0.5, -0.35),
        cell=0.5,
        p_target_shown=p,
        p_source_shown=q,
        n_target=_normals_when_asked(p, "all"),
    )


def _lidar(params: Params) -> Scans:
    return _driven(only(params, "start_angle", "start_shift", "noise", *LARGE))


@functools.lru_cache(maxsize=8)
def _driven(params: Params) -> Scans:
    """Return the scans before and after the scanner has moved: other rings on the same street."""
    T_truth = _true_motion(params)
    rng = np.random.default_rng(params.seed)
    p_target, p_source = lidar_pair(T_truth, rng, rings=RINGS, columns=COLUMNS, noise=params.noise)
    return replace(
        _framed(*_thinned(p_target, p_source, params), "z", params.planes), T_truth=T_truth
    )


def _own(params: Params) -> Scans:
    if params.target is None or params.source is None:
        raise InputError(
            f"own scans come in pairs: give both {called('target')} and {called('source')}"
        )
    for scan in (params.target, params.source):
        read_cloud(scan)  # so that a bad file is refused before anything else
    T_truth = (
        None
        if params.truth is None
        else read_pose(params.truth, params.target, params.source).copy()
    )
    if T_truth is not None:
        T_truth[:3, 3] *= METRES[params.unit]
    files = params.target, params.source
    made = _read(*files, only(params, "unit", "up", *LARGE), *(stamp(path) for path in files))
    return replace(made, T_truth=T_truth)


@functools.lru_cache(maxsize=8)
def _read(target: Path, source: Path, params: Params, *_stamps: tuple[int, int]) -> Scans:
    """Thin own scans and bring them into the picture; anew when a file has changed."""
    p_target, p_source = (METRES[params.unit] * read_cloud(scan) for scan in (target, source))
    if not extent(p_target, FAR) > 0:
        raise InputError(f"{target.name}: all its points lie at one place")
    return _framed(*_thinned(p_target, p_source, params), params.up, params.planes)


def _thinned(
    p_target: np.ndarray, p_source: np.ndarray, params: Params
) -> tuple[np.ndarray, np.ndarray]:
    """Thin both scans by the same voxels, and draw at most so many points of the source by
    chance.
    """
    if params.thinning == "voxel":
        size = params.voxel / 100.0 * extent(p_target, FAR)
        p_target, p_source = voxel_means(p_target, size), voxel_means(p_source, size)
    return p_target, some_points(p_source, params.own_points, np.random.default_rng(params.seed))


def _framed(p_target: np.ndarray, p_source: np.ndarray, up: Up, planes: Planes) -> Scans:
    """Bring scans of any size and place into the picture, WIDTH wide and upright about the target's
    middle.
    """
    how = frame(p_target, WIDTH, up=up, far=FAR)
    target_shown, cell = how.shown(p_target), round_below(0.5 / how.scale)
    return Scans(
        p_target=p_target,
        p_source=p_source,
        is_outlier=np.zeros(len(p_source), bool),
        T_truth=None,
        T_start=np.eye(4),
        frame=how,
        spacing=spacing(p_target),
        grid=ground_grid(how.scale * cell, float(np.percentile(target_shown[:, 2], 1))),
        cell=cell,
        p_target_shown=target_shown,
        p_source_shown=how.shown(p_source),
        n_target=_normals_when_asked(p_target, planes),
    )


def _normals_when_asked(p: np.ndarray, planes: Planes) -> Callable[[], np.ndarray]:
    def normals() -> np.ndarray:
        return point_normals(p, spread=planes == "spread")

    return functools.cache(normals)
