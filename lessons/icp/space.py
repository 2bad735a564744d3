"""The stage `space`: ICP on two clouds, and then a try from each of a row of starts."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from lessons.icp.inputs import Input
from lessons.icp.scans import Scans, sampled, scans_of
from workbench.algorithms.registration import icp
from workbench.data.thinning import every
from workbench.geometry.motions import apply, motion, turns
from workbench.geometry.motions.alignment import (
    MotionError,
    align_affine,
    align_rigid,
    align_similarity,
    motion_error,
    point_to_plane_step,
)
from workbench.lesson import Slot, cached
from workbench.tracing import untraced

MAX_ITERATIONS = 150
TOLERANCE = 1e-5
ANGLES = tuple(range(0, 181, 15))  # degrees: how far away the tries start
SLIDING = ("corner", "vase")  # moved onto themselves they look the same: no start leads home
SHARES = (0.3, 0.4, 0.5, 0.6, 0.65, 0.7, 0.8, 0.9, 1.0)  # of the matches, that the chart tries
TRIED = 5000  # source points that a try uses at most; the built-in scans have no more
TURNED = 500  # source points that tell the cost of such a turn, evenly spread over all
TURNS = np.arange(-180.0, 181.0, 6.0)  # degrees at which the cost of a vase's turn is looked up


@dataclass(frozen=True, eq=False, kw_only=True)
class Try:
    """One start and where ICP ended from it.

    Attributes:
        start_angle: Degrees about the vertical, away from the truth.
        T_target_truth: The end as a motion of the truly placed source: the identity at home.
        error: How far that is from the truth.
        rmse: Of the kept matches at the end, metres.
    """

    start_angle: float
    T_target_truth: np.ndarray
    error: MotionError
    rmse: float


def run(
    params: Input,
    scans: Scans,
    align: Slot | None = None,
    *,
    match: Slot | None = None,
    step: Slot | None = None,
) -> Iterator[icp.State | Try]:
    """Yield the sub-steps of ICP, then, where the truth is known, a try from each of ANGLES.

    There are no tries where a shape can be moved onto itself, nor where a function is given in
    place of ours (None).
    """
    yield from _steps(
        params, scans, scans.p_source, T_start=scans.T_start, align=align, match=match, step=step
    )
    sliding = params.target is None and params.shape in SLIDING
    if scans.known and not sliding and (align, match, step) == (None, None, None):
        yield from (tried(params, angle) for angle in ANGLES)


def _steps(
    params: Input,
    scans: Scans,
    p_source: np.ndarray,
    *,
    T_start: np.ndarray,
    align: Slot | None = None,
    match: Slot | None = None,
    step: Slot | None = None,
) -> Iterator[icp.State]:
    fits = {"similarity": align_similarity, "affine": align_affine}
    yield from icp.icp(
        scans.p_target,
        p_source,
        T_start,
        n_target=scans.n_target().at if params.fit == "point-to-plane" else None,
        gate=gate_of(params, scans),
        match=match or icp.matcher(scans.p_target, p_source, scans.tree()),
        align=fits.get(params.fit, align or align_rigid),
        step=step or point_to_plane_step,
        max_iterations=MAX_ITERATIONS,
        tolerance=TOLERANCE,
    )


def gate_of(params: Input, scans: Scans) -> icp.Gate:
    """Return the gate of the params; its distance is one of the picture, whatever the scans'
    size.
    """
    match params.gate:
        case "trimmed":
            return icp.Gate(keep=params.keep)
        case "max-distance":
            return icp.Gate(max_distance=params.max_distance / scans.frame.scale)
        case "3-medians":
            return icp.Gate(medians=3.0)
        case _:
            return icp.Gate()


@cached(most=512)
def tried(params: Input, angle: float) -> Try:
    """Return where ICP ends from another start: the same gate, fit and shift, at most TRIED points.

    The source is placed truly, and then turned about the vertical to the side on which the run
    itself starts.
    """
    if params.target is None and params.shape != "lidar":
        scans = sampled(params)
        shift = np.array(params.guess[:3]) - [params.start_shift, 0.0, 0.0]
    else:
        scans = scans_of(params)
        shift = np.zeros(3)
    assert scans.T_truth is not None
    placed = apply(scans.T_truth, scans.p_source)
    turn = scans.about_centre(np.array([0.0, 0.0, -np.radians(angle)]))
    with untraced():
        few = placed[every(len(placed), TRIED)]
        *_, end = _steps(params, scans, few, T_start=motion(np.eye(3), shift) @ turn)
    T = end.T_target_source
    error = motion_error(T, np.eye(4), placed[~scans.is_outlier])
    return Try(start_angle=angle, T_target_truth=T, error=error, rmse=end.rmse)


@cached
def errors_by_share(params: Input) -> np.ndarray:
    """Return the rotation error, degrees, at the end of a run for each share kept in SHARES."""
    scans = scans_of(params)
    ends = []
    for share in SHARES:
        with untraced():
            *_, end = icp.icp(
                scans.p_target,
                scans.p_source,
                scans.T_start,
                match=icp.matcher(scans.p_target, scans.p_source, scans.tree()),
                gate=icp.Gate(keep=share),
                max_iterations=MAX_ITERATIONS,
                tolerance=TOLERANCE,
            )
        ends.append(scans.error(end.T_target_source).rotation)
    return np.array(ends)


def cost_of_turns(scans: Scans, degrees: np.ndarray) -> np.ndarray:
    """Return the RMSE of all matches with the truly placed source turned about the vertical,
    metres; of at most TURNED points.
    """
    assert scans.T_truth is not None
    placed = apply(scans.T_truth, scans.p_source[every(len(scans.p_source), TURNED)])
    about_vertical = turns(np.radians(degrees)[:, None] * [0.0, 0.0, 1.0])
    p_turned = placed @ about_vertical.swapaxes(1, 2)
    gaps = scans.tree().query(p_turned)[0]
    return np.sqrt(np.square(gaps).mean(axis=1))


@cached
def landscapes(params: Input) -> dict[str, np.ndarray]:
    """Return the cost of starting turned by TURNS, metres, of this shape and of the rabbit, scanned
    likewise.
    """
    rabbit = Input(
        points=params.points,
        seed=params.seed,
        noise=params.noise,
        overlap=params.overlap,
        outliers=params.outliers,
    )
    return {
        params.shape: cost_of_turns(sampled(params), -TURNS),
        "rabbit": cost_of_turns(sampled(rabbit), -TURNS),
    }


def edge(tries: tuple[Try, ...], scans: Scans) -> float | None:
    """Return the largest start up to which every try came home, degrees; None when not even the
    first.
    """
    last = None
    for attempt in tries:
        if not scans.at_home(attempt.error):
            break
        last = attempt.start_angle
    return last
