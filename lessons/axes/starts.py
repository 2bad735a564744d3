"""The stage `starts`: ICP from each of the four frames; the lowest RMSE wins."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from lessons.axes.scans import Scans
from lessons.axes.space import by_jacobi, outcomes
from workbench.algorithms.registration import icp
from workbench.geometry.motions.alignment import degrees_between
from workbench.geometry.motions.principal_axes import centroid_and_covariance
from workbench.lesson import Slot
from workbench.tracing import untraced

# as in the lesson on ICP
KEEP = 0.9
MOST = 150
TOLERANCE = 1e-5
# that are shown
ROUNDS = (0, 1, 2, 3, 4, 5, 6, 8, 10, 12, 15, 20, 25, 30, 40, 50, 75, 100, 125, MOST)


@dataclass(frozen=True, eq=False, kw_only=True)
class Race:
    """Four starts after so many rounds.

    Attributes:
        round: How many times each was matched and fitted, those that have stopped fewer times.
        T: Where each has come to, T_target_source (4, 4, 4).
        rmse: Of the closest matches of each, metres (4,).
        off: How far each is from the truth, degrees (4,); NaN where nobody knows it.
        is_end: Whether all have stopped.
        is_told: Whether the truth is shown.
        alone: The end of ICP from where the second scan lies, without a frame: its motion and RMSE;
            None before the end.
    """

    round: int
    T: np.ndarray
    rmse: np.ndarray
    off: np.ndarray
    is_end: bool = False
    is_told: bool = False
    alone: tuple[np.ndarray, float] | None = None

    @property
    def winner(self) -> int:
        """The frame with the lowest RMSE, from 0."""
        return int(np.argmin(self.rmse))


def _icp(scans: Scans, T: np.ndarray) -> Iterator[icp.State]:
    gate = icp.Gate(keep=KEEP)
    given = {"gate": gate, "max_iterations": MOST, "tolerance": TOLERANCE}
    return icp.icp(scans.p_target, scans.p_source, T, **given)


def race(scans: Scans, find: Slot | None) -> Iterator[Race]:
    """Yield the rounds of ROUNDS from all four frames, then the end, then the same beside the
    truth.
    """
    p_centre, _ = centroid_and_covariance(scans.p_source)
    with untraced():
        axes, axes_target = ((find or by_jacobi)(p) for p in (scans.p_source, scans.p_target))
    T = np.stack(
        [
            outcome.T_target_source
            for outcome in outcomes(scans, p_centre, axes, axes_target=axes_target)
        ]
    )
    runs = [_icp(scans, start) for start in T]
    rmse = np.zeros(4)
    running = [True] * 4
    count = 0
    for count in range(MOST + 1):
        for k in np.flatnonzero(running):
            match = next(runs[k])  # where it lies now
            T[k] = match.T_target_source
            rmse[k] = match.rmse
            running[k] = match.stop is None
        if count in ROUNDS or not any(running):
            yield _now(scans, count, T, rmse=rmse)
        for k in np.flatnonzero(running):
            fit = next(runs[k])
            if fit.stop is not None:
                T[k] = fit.T_target_source
                rmse[k] = fit.rmse
                running[k] = False
        if not any(running):
            break
    *_, alone = _icp(scans, np.eye(4))
    end = (alone.T_target_source, alone.rmse)
    told = [False] if scans.T_target_source is None else [False, True]
    for is_told in told:
        yield _now(scans, count + 1, T, rmse=rmse, is_end=True, is_told=is_told, alone=end)


def _now(scans: Scans, count: int, T: np.ndarray, *, rmse: np.ndarray, **more: Any) -> Race:
    off = np.full(4, np.nan)
    if scans.T_target_source is not None:
        off = np.array([degrees_between(pose, scans.T_target_source) for pose in T])
    return Race(round=count, T=T.copy(), rmse=rmse.copy(), off=off, **more)
