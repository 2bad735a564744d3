"""The same method in many pictures, and on many triples: what one run cannot show."""

from functools import lru_cache

import numpy as np

from lessons.pose.state import Params, Repeated, Subject
from workbench.algorithms.camera_search import downhill
from workbench.geometry.camera_motions import dlt_motion, gauss_newton_step, refined, rms_reprojection, sqpnp
from workbench.geometry.cameras import camera_center, normalize, project
from workbench.geometry.motions import rotation_angle
from workbench.geometry.planar_motions import planar_motions
from workbench.geometry.three_points import p3p

PICTURES, MARKERS = 40, 60  # of a marker more, as they are of two kinds
TRIPLES = 2000


def repeated(params: Params, subject: Subject) -> Repeated:
    """Return what the method finds in other pictures of the same scene, with other noise."""
    assert subject.T_true is not None
    rng, p, swapped = np.random.default_rng([params.seed, 1]), subject.given.p_world, None
    uv = project(p, subject.T_true, subject.K)
    pictures = MARKERS if params.method == "IPPE" else PICTURES
    size = (pictures, *uv.shape)
    noisy, anywhere = uv + params.noise * rng.standard_normal(size), rng.uniform(uv.min(axis=0), uv.max(axis=0), size)
    uv = np.where(subject.given.is_outlier[:, None], anywhere, noisy)
    xy = normalize(uv.reshape(-1, 2), subject.K).reshape(uv.shape)
    of_picture = np.arange(pictures)
    if params.method == "P3P":
        Ts, of_picture = _by_fourth(p, xy)
    elif params.method == "DLT":
        Ts = np.stack([dlt_motion(p, one, centred=params.centred) for one in xy])
    elif params.method == "SQPnP":
        Ts = sqpnp(np.broadcast_to(p, (pictures, *p.shape)), xy)
    else:
        Ts, swapped = _by_planes(subject.T_true, p, xy)
    if params.refine and params.method == "DLT":  # the way down matters where it begins far off
        ends = [list(downhill(T, p, one, gauss_newton_step))[-1].T for T, one in zip(Ts, xy, strict=True)]
        Ts = np.stack([T for T in ends if T is not None])
    elif params.refine and params.method != "IPPE":
        Ts = refined(Ts, p, xy[of_picture])
    centres = -(np.swapaxes(Ts[:, :3, :3], 1, 2) @ Ts[:, :3, 3:])[..., 0]
    metres = np.linalg.norm(centres - camera_center(subject.T_true), axis=1)
    counts = solution_counts(params.seed) if params.target == "triangle" else None
    return Repeated(Ts, _degrees(Ts, subject.T_true), metres, pictures, swapped, counts)


def _degrees(Ts: np.ndarray, T: np.ndarray) -> np.ndarray:
    """Return the angles between many rotations and one."""
    return np.degrees([rotation_angle(R) for R in Ts[:, :3, :3] @ T[:3, :3].T])


def _by_fourth(p: np.ndarray, xy: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return of each picture that has a solution of its first three points the one that fits four best."""
    Ts, of_picture = p3p(np.broadcast_to(p[:3], (len(xy), 3, 3)), xy[:, :3])
    errors = rms_reprojection(Ts, p[:4], xy[of_picture, :4])
    best = [int(rows[np.argmin(errors[rows])]) for k in range(len(xy)) if len(rows := np.flatnonzero(of_picture == k))]
    return Ts[best], of_picture[best]


def _by_planes(T_true: np.ndarray, p: np.ndarray, xy: np.ndarray) -> tuple[np.ndarray, int]:
    """Return of each picture the better of a plane's two refined motions, and how often the other is the true one."""
    xy_twice = np.repeat(xy, 2, axis=0)
    both = refined(np.concatenate([planar_motions(p, one) for one in xy]), p, xy_twice)
    worse = np.argmax(rms_reprojection(both, p, xy_twice).reshape(-1, 2), axis=1)
    off, rows = _degrees(both, T_true).reshape(-1, 2), np.arange(len(xy))
    two = np.abs(np.diff(both.reshape(-1, 2, 16), axis=1)[:, 0]).max(axis=1) > 0.05
    return both[2 * rows + 1 - worse], int(np.count_nonzero(two & (off[rows, 1 - worse] > off[rows, worse])))


@lru_cache(maxsize=8)
def solution_counts(seed: int) -> np.ndarray:
    """Count the solutions of random triples of points, seen by random cameras: how many have none, one, ..., four."""
    rng = np.random.default_rng([seed, 2])
    z = rng.uniform(4.0, 8.0, (TRIPLES, 3, 1))
    p_camera = np.concatenate([rng.uniform(-2.0, 2.0, (TRIPLES, 3, 2)), z], axis=2)
    Rs_world_camera, _ = np.linalg.qr(rng.standard_normal((TRIPLES, 3, 3)))
    Rs_world_camera *= np.linalg.det(Rs_world_camera)[:, None, None]  # no reflections
    p_world = p_camera @ np.swapaxes(Rs_world_camera, 1, 2)
    _, of_triple = p3p(p_world, p_camera[..., :2] / z)
    return np.bincount(np.bincount(of_triple, minlength=TRIPLES), minlength=5)
