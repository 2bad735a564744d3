"""The two scans of a run, built-in or the person's own, and how they stand in the picture."""

import functools
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
import scipy

from lessons.icp.params import Params, Up
from workbench.data.clouds import pair
from workbench.data.files import read_cloud, read_pose
from workbench.errors import InputError
from workbench.geometry.alignment import nearest_rotation
from workbench.geometry.motions import apply, exp_so3, inverse, motion, rotation_angle
from workbench.geometry.normals import point_normals


@dataclass(frozen=True, eq=False)
class Scans:
    """Target and source in their own frames (metres), and what does not change while ICP runs.

    Attributes:
        p_target: Target points, target frame.
        p_source: Source points, source frame.
        is_outlier: Which source points belong to nothing.
        T_truth: The true T_target_source, or None where nobody knows it.
        T_start: The initial guess of T_target_source.
        centre: The middle of the target, target frame; the picture is about it.
        scale: The picture's metres per metre of the scans: own scans are shown about 1.2 m wide.
        R_world_target: How the target is set upright in the picture.
        spacing: Typical distance between neighbouring target points, metres.
        p_target_shown: The target as the picture has it.
        p_source_shown: The source as the picture has it, in its own frame.
        n_target: Gives the unit normals of the target, computed when first asked for.
    """

    p_target: np.ndarray
    p_source: np.ndarray
    is_outlier: np.ndarray
    T_truth: np.ndarray | None
    T_start: np.ndarray
    centre: np.ndarray
    scale: float
    R_world_target: np.ndarray
    spacing: float
    p_target_shown: np.ndarray
    p_source_shown: np.ndarray
    n_target: Callable[[], np.ndarray]

    def shown(self, T_target_source: np.ndarray) -> np.ndarray:
        """Return the pose of `p_source_shown` in the picture: the same motion about the centre, scaled and upright."""
        A, Q = T_target_source[:3, :3], self.R_world_target
        return motion(Q @ A @ Q.T, self.scale * Q @ (apply(T_target_source, self.centre) - self.centre))

    def about_centre(self, w_world: np.ndarray) -> np.ndarray:
        """Return the turn by a rotation vector of the picture about its middle, as a motion of the target frame."""
        R = exp_so3(self.R_world_target.T @ w_world)
        return motion(R, self.centre - R @ self.centre)

    def errors(self, T_target_source: np.ndarray) -> tuple[float, float]:
        """Return how far a motion is from the truth: degrees, and metres at the middle of the source."""
        if self.T_truth is None:
            return float("nan"), float("nan")
        R = nearest_rotation(T_target_source[:3, :3]) @ self.T_truth[:3, :3].T
        middle = self.p_source[~self.is_outlier].mean(axis=0)
        return float(np.degrees(rotation_angle(R))), float(
            np.linalg.norm(apply(T_target_source, middle) - apply(self.T_truth, middle))
        )

    def right_share(self, indices: np.ndarray, kept: np.ndarray) -> float:
        """Return the share of kept matches whose partner lies within two spacings of where the source point belongs."""
        if self.T_truth is None or not kept.any():
            return float("nan")
        off = self.p_target[indices[kept]] - apply(self.T_truth, self.p_source[kept])
        return float(np.mean(np.einsum("ij,ij->i", off, off) <= (2.0 * self.spacing) ** 2))


def scans_of(params: Params) -> Scans:
    """Return the scans that the params describe.

    Raises:
        InputError: If an own file cannot be used, or only one of the two scans is given.
    """
    own = (params.target, params.source, params.truth) != (None, None, None)
    scans = _own(params) if own else _built_in(params)
    v_world, w_world = np.array(params.guess[:3]), np.array(params.guess[3:])
    T_start = scans.about_centre(w_world)  # the handle turns about the middle of the picture
    T_start[:3, 3] += scans.R_world_target.T @ v_world / scans.scale
    return replace(scans, T_start=T_start)


def _built_in(params: Params) -> Scans:
    start = np.radians(params.start_angle)
    T_truth = motion(exp_so3(np.array([0.0, 0.0, start])), np.array([params.start_shift, 0.0, 0.0]))
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
        p, q, scans.is_outlier, np.eye(4), np.eye(4), np.zeros(3), 1.0, np.eye(3), _spacing(p), p, q,
        _normals_when_asked(p),
    )  # fmt: skip


def _own(params: Params) -> Scans:
    if params.target is None or params.source is None:
        raise InputError("own scans come in pairs: give both a target and a source")
    for scan in (params.target, params.source):
        read_cloud(scan)  # so that a bad file is refused before anything else
    T_truth = None if params.truth is None else read_pose(params.truth, params.target, params.source)
    changed = (params.target.stat().st_mtime_ns, params.source.stat().st_mtime_ns)
    scans = _prepared(params.target, params.source, changed, params.own_points, params.seed, params.up)
    return replace(scans, T_truth=T_truth)


@functools.lru_cache(maxsize=8)
def _prepared(target: Path, source: Path, _changed: tuple[int, int], own_points: int, seed: int, up: Up) -> Scans:
    """Thin an own source, and bring both into the picture; anew when a file has changed."""
    p_target, p_source = read_cloud(target), read_cloud(source)
    rng = np.random.default_rng(seed)
    if len(p_source) > own_points:
        p_source = p_source[np.sort(rng.choice(len(p_source), own_points, replace=False))]
    low, high = np.percentile(p_target, [2, 98], axis=0)  # a few far points must not shrink the picture
    centre = (low + high) / 2
    scale = 1.2 / max(float((high - low).max()), 1e-9)
    R_world_target = exp_so3(np.array([{"z": 0.0, "y": np.pi / 2, "-y": -np.pi / 2}[up], 0.0, 0.0]))
    nobody = np.zeros(len(p_source), bool)
    return Scans(
        p_target, p_source, nobody, None, np.eye(4), centre, scale, R_world_target, _spacing(p_target),
        scale * (p_target - centre) @ R_world_target.T, scale * (p_source - centre) @ R_world_target.T,
        _normals_when_asked(p_target),
    )  # fmt: skip


def _normals_when_asked(p: np.ndarray) -> Callable[[], np.ndarray]:
    return functools.cache(lambda: point_normals(p))


def _spacing(p: np.ndarray) -> float:
    """Return the median distance to the nearest other point, from a few hundred points."""
    some = p[:: max(1, len(p) // 400)]
    distances = np.asarray(scipy.spatial.KDTree(p).query(some, k=2)[0])
    return float(np.median(distances[:, 1])) or 1e-9
