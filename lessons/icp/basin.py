"""Where ICP ends from a row of starts: its basin of convergence.

The tries are an experiment of their own, and quicker than the run: a thinned source, turned the
other way about the vertical, not shifted, and fewer iterations. What `lessons.icp.captions` says of
a try tells all of this but the last.
"""

import functools
from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from lessons.icp.scans import scans_of
from lessons.icp.state import Params, Scans, Try
from workbench.algorithms.registration.icp import Align, Gate, icp
from workbench.data.thinning import every
from workbench.geometry.motions import inverse
from workbench.geometry.motions.alignment import align_affine, align_rigid, align_similarity
from workbench.tracing import untraced

ANGLES = tuple(range(0, 181, 15))
POINTS, MAX_ITERATIONS, TOLERANCE = 300, 100, 1e-4
SLIDING = (
    "corner",
    "vase",
)  # moved onto themselves they look the same, so no start brings them home


def tries_of(params: Params) -> Iterator[Try]:
    """Yield a try for each of ANGLES, none for SLIDING. They do not depend on the params' start, so
    they are kept.
    """
    if params.target is None and params.shape in SLIDING:
        return
    same = replace(params, guess=(0.0,) * 6)
    if params.shape != "lidar":  # where the scanner drives to decides what it sees
        same = replace(same, start_angle=0.0, start_shift=0.0)
    for angle in ANGLES:
        yield _try(same, angle)


def gate_of(params: Params, scans: Scans) -> Gate:
    """Return the gate that the params name; its distance is one of the picture, whatever the size
    of the scans.
    """
    return {
        "all": Gate(),
        "trimmed": Gate(keep=params.keep),
        "max-distance": Gate(max_distance=params.max_distance / scans.frame.scale),
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
    return Try(
        start_angle=angle,
        T_target_truth=T @ inverse(scans.T_truth),
        error=scans.error(T),
        rmse=end.rmse,
    )


def thinned(scans: Scans) -> np.ndarray:
    """Return the source points that the tries use."""
    return scans.p_source[every(len(scans.p_source), POINTS)]
