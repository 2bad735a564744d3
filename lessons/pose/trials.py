"""The same method in many pictures, and on many triples: what one run cannot show."""

from functools import lru_cache

import numpy as np

from lessons.pose.state import Params, Repeated, Subject
from workbench.algorithms.camera_search import downhill
from workbench.data.sightings import seen
from workbench.geometry.alignment import degrees_between
from workbench.geometry.camera_motions import dlt_motion, gauss_newton_step, refined, rms_reprojection, sqpnp
from workbench.geometry.cameras import normalize
from workbench.geometry.motions import exp_so3
from workbench.geometry.planar_motions import planar_motions
from workbench.geometry.three_points import p3p

PICTURES = 60
TRIPLES = 2000


def repeated(params: Params, subject: Subject) -> Repeated:
    """Return what the method finds in other pictures of the same scene."""
    assert subject.T_true is not None
    rng = np.random.default_rng([params.seed, 1])
    p, swapped = subject.given.p_world, None
    options = {"sigma": params.noise, "outlier_ratio": float(subject.given.is_outlier.mean())}
    uv = np.stack([seen(p, subject.T_true, subject.K, rng, **options).uv for _ in range(PICTURES)])
    xy = normalize(uv.reshape(-1, 2), subject.K).reshape(uv.shape)
    of_picture = np.arange(PICTURES)
    if params.method == "P3P":
        Ts, of_picture = _by_fourth(p, xy)
    elif params.method == "DLT":
        Ts = np.stack([dlt_motion(p, one, centred=params.centred) for one in xy])
    elif params.method == "SQPnP":
        Ts = sqpnp(np.broadcast_to(p, (PICTURES, *p.shape)), xy)
    else:
        Ts, swapped = _by_planes(subject, xy)
    if params.refine and params.method == "DLT":  # the way down matters where it begins far off
        ends = [list(downhill(T, p, one, gauss_newton_step))[-1].T for T, one in zip(Ts, xy, strict=True)]
        Ts = np.stack([T for T in ends if T is not None])
    elif params.refine and params.method != "IPPE":
        Ts = refined(Ts, p, xy[of_picture])
    off = np.array([subject.off(T) for T in Ts]).reshape(-1, 2)
    counts = solution_counts(params.seed) if params.target == "triangle" else None
    return Repeated(Ts, off[:, 0], off[:, 1], PICTURES, swapped, counts)


def _by_fourth(p: np.ndarray, xy: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return of each picture that has a solution of its first three points the one that fits four best."""
    Ts, of_picture = p3p(np.broadcast_to(p[:3], (len(xy), 3, 3)), xy[:, :3])
    errors = rms_reprojection(Ts, p[:4], xy[of_picture, :4])
    best = [int(rows[np.argmin(errors[rows])]) for k in range(len(xy)) if len(rows := np.flatnonzero(of_picture == k))]
    return Ts[best], of_picture[best]


def _by_planes(subject: Subject, xy: np.ndarray) -> tuple[np.ndarray, int]:
    """Return of each picture the better of a plane's two refined motions, and how often the other is the true one."""
    p = subject.given.p_world
    both = np.stack([planar_motions(p, one) for one in xy])
    both = refined(both.reshape(-1, 4, 4), p, np.repeat(xy, 2, axis=0)).reshape(-1, 2, 4, 4)
    best = np.argmin(rms_reprojection(both.reshape(-1, 4, 4), p, np.repeat(xy, 2, axis=0)).reshape(-1, 2), axis=1)
    off = np.array([[subject.off(T)[0] for T in two] for two in both])
    apart = np.array([degrees_between(*two) for two in both])
    rows = np.arange(len(xy))
    return both[rows, best], int(np.count_nonzero((apart > 5.0) & (off[rows, best] > off[rows, 1 - best])))


@lru_cache(maxsize=8)
def solution_counts(seed: int) -> np.ndarray:
    """Count the solutions of random triples of points, seen by random cameras: how many have none, one, ..., four."""
    rng = np.random.default_rng([seed, 2])
    z = rng.uniform(4.0, 8.0, (TRIPLES, 3, 1))
    p_camera = np.concatenate([rng.uniform(-2.0, 2.0, (TRIPLES, 3, 2)), z], axis=2)
    Rs_world_camera = np.stack([exp_so3(2.0 * w) for w in rng.standard_normal((TRIPLES, 3))])
    p_world = p_camera @ np.swapaxes(Rs_world_camera, 1, 2)
    _, of_triple = p3p(p_world, p_camera[..., :2] / z)
    return np.bincount(np.bincount(of_triple, minlength=TRIPLES), minlength=5)
