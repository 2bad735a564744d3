"""What one step of the lesson holds, and whether it has come home."""

from dataclasses import dataclass

from lessons.icp.basin import Try
from lessons.icp.params import Params
from lessons.icp.scans import Error, Scans
from workbench.algorithms import icp


@dataclass(frozen=True, eq=False)
class State:
    """One step of the lesson: a sub-step of ICP, or afterwards one more try from another start.

    Attributes:
        params: The inputs.
        scans: The clouds, the same for the whole run.
        icp: What ICP yielded (its last state, during the tries).
        rmse_before: RMSE of the kept matches one sub-step earlier, metres; NaN at first.
        turned: How far the last fit turned the source, degrees.
        error: How far the motion is from the truth.
        right: Share of the kept matches that are right (within two point spacings).
        tries: Ends from other starts, so far.
    """

    params: Params
    scans: Scans
    icp: icp.State
    rmse_before: float
    turned: float
    error: Error
    right: float
    tries: tuple[Try, ...] = ()

    @property
    def known(self) -> bool:
        """Whether the truth is known."""
        return self.scans.T_truth is not None

    @property
    def home(self) -> bool:
        """Whether the motion of ICP itself is the true one, but for sampling."""
        return self.scans.at_home(self.error)

    @property
    def edge(self) -> float | None:
        """The largest start angle up to which every try came home, degrees; None when not even the first did."""
        edge = None
        for attempt in self.tries:
            if not self.scans.at_home(attempt.error):
                break
            edge = attempt.start_angle
        return edge
