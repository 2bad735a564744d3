"""Where ICP ends from a row of starts: its basin of convergence, on a thinned source."""

import functools
from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from lessons.icp.params import Params
from lessons.icp.prepared import scans_of
from lessons.icp.scans import Error, Scans
from workbench.algorithms.icp import Align, Gate, icp
from workbench.geometry.alignment import align_affine, align_rigid, align_similarity
from workbench.geometry.motions import inverse
from workbench.tracing import untraced

ANGLES = tuple(range(0, 181, 15))
POINTS, MAX_ITERATIONS, TOLERANCE = 300, 100, 1e-4


@dataclass(frozen=True, eq=False)
class Try:
    """One start and where ICP ended from it.

    Attributes:
        start_angle: Degrees about the vertical, away from the truth.
        T_target_truth: The end as a motion of the truly placed source: the identity when it came home.
        error: How far that is from the truth.
        rmse: Of the kept matches at the end, metres.
    """

    start_angle: float
    T_target_truth: np.ndarray
    error: Error
    rmse: float


def tries_of(params: Params) -> Iterator[Try]:
    """Yield a try for each of ANGLES. They do not depend on the start of the params, so they are kept."""
    same = replace(params, guess=(0.0,) * 6)
    if params.shape != "lidar":  # where the scanner drives to decides what it sees
        same = replace(same, start_angle=0.0, start_shift=0.0)
    for angle in ANGLES:
        yield _try(same, angle)


def gate_of(params: Params, scans: Scans) -> Gate:
    """Return the gate that the params name; its distance is one of the picture, whatever the size of the scans."""
    return {
        "all": Gate(),
        "trimmed": Gate(keep=params.keep),
        "max-distance": Gate(max_distance=params.max_distance / scans.scale),
        "3-medians": Gate(medians=3.0),
    }[params.gate]


def align_of(params: Params, align: Align = align_rigid) -> Align:
    """Return the alignment that the params name; the rigid one may be somebody's own."""
    return {"similarity": align_similarity, "affine": align_affine}.get(params.fit, align)


@functools.lru_cache(maxsize=512)
def _try(params: Params, angle: float) -> Try:
    scans = scans_of(params)
    assert scans.T_truth is not None
    states = icp(
        scans.p_target,
        thinned(scans),
        scans.about_centre(np.array([0.0, 0.0, np.radians(angle)])) @ scans.T_truth,
        n_target=scans.n_target() if params.fit == "point-to-plane" else None,
        gate=gate_of(params, scans),
        align=align_of(params),
        max_iterations=MAX_ITERATIONS,
        tolerance=TOLERANCE,
    )
    with untraced():
        *_, end = states
    T = end.T_target_source
    return Try(angle, T @ inverse(scans.T_truth), scans.error(T), end.rmse)


def thinned(scans: Scans) -> np.ndarray:
    """Return the source points that the tries use."""
    return scans.p_source[thin_rows(scans)]


def thin_rows(scans: Scans) -> slice:
    """Return every so many rows of the source, POINTS in all at most."""
    return slice(None, None, -(-len(scans.p_source) // POINTS))
