"""The same method in other pictures, and on many triples: what one run cannot show."""

from functools import lru_cache

import numpy as np

from lessons.pose.state import Params, Repeated, Subject
from workbench.algorithms.cameras.camera_search import by_fourth_points, downhill, planar_pairs
from workbench.data.views.sightings import random_views, seen
from workbench.geometry.cameras import normalize
from workbench.geometry.cameras.camera_motions import dlt_motion, gauss_newton_step, refined, sqpnp
from workbench.geometry.cameras.control_points import epnp
from workbench.geometry.cameras.three_points import solution_counts
from workbench.geometry.motions.alignment import degrees_between

PICTURES, MARKERS = 40, 60  # of a marker more, as they are of two kinds
TRIPLES = 2000
ANEW = 300


def repeated(params: Params, subject: Subject) -> Repeated:
    """Return what the method finds in other pictures of the same scene, with other noise."""
    assert subject.T_true is not None
    rng = np.random.default_rng([params.seed, 1])
    p = subject.given.p_world
    swapped = None
    n = MARKERS if params.method == "IPPE" else PICTURES
    options = {"sigma": params.noise, "is_outlier": subject.given.is_outlier}
    uv = np.stack([seen(p, subject.T_true, subject.K, rng=rng, **options).uv for _ in range(n)])
    xy = normalize(uv.reshape(-1, 2), subject.K).reshape(uv.shape)
    of_picture = np.arange(n)
    if params.method == "P3P":
        Ts, of_picture = by_fourth_points(p, xy)
    elif params.method == "DLT":
        Ts = np.stack([dlt_motion(p, view, centred=params.centred) for view in xy])
    elif params.method == "EPnP":
        Ts = epnp(np.broadcast_to(p, (n, *p.shape)), xy)
    elif params.method == "SQPnP":
        Ts = sqpnp(np.broadcast_to(p, (n, *p.shape)), xy)
    else:
        pairs = planar_pairs(p, xy)
        better, worse = (
            np.array([subject.off(T)[0] for T in Ts]) for Ts in (pairs[:, 0], pairs[:, 1])
        )
        swapped = int(np.count_nonzero(better > worse + 1.0))  # below a degree both are one
        Ts = pairs[:, 0]
    if params.refine and params.method == "DLT":  # the way down matters where it begins far off
        ends = [
            list(downhill(T, p, view, pose_step=gauss_newton_step))[-1].T
            for T, view in zip(Ts, xy, strict=True)
        ]
        Ts = np.stack([T for T in ends if T is not None])
    elif params.refine and params.method != "IPPE":
        Ts = refined(Ts, p, xy[of_picture])
    degrees, metres = np.array([subject.off(T) for T in Ts]).reshape(-1, 2).T
    counts = counted_solutions(params.seed) if params.target == "triangle" else None
    anew = (
        drawn_anew(len(p), params.noise / params.f, params.seed)
        if params.method == "EPnP"
        else None
    )
    return Repeated(Ts, degrees, metres, n, swapped, counts, anew)


@lru_cache(maxsize=8)
def drawn_anew(n: int, sigma: float, seed: int) -> np.ndarray:
    """Return the rotation errors of EPnP and of SQPnP, degrees (2, k), in pictures of n random
    points each.
    """
    rng = np.random.default_rng([seed, 4])
    R_true, p, xy = random_views(ANEW, n, rng)
    xy = xy + sigma * rng.standard_normal(xy.shape)
    motions = epnp(p, xy), sqpnp(p, xy)
    return np.array(
        [[degrees_between(T[:3, :3], R) for T, R in zip(Ts, R_true, strict=True)] for Ts in motions]
    )


@lru_cache(maxsize=8)
def counted_solutions(seed: int) -> np.ndarray:
    """Return how many of the random triples have none, one, ..., four solutions."""
    return solution_counts(*random_views(TRIPLES, 3, np.random.default_rng([seed, 2]))[1:])
