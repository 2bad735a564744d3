"""One step of the RANSAC lesson."""

from dataclasses import dataclass

import numpy as np

from lessons.ransac.params import Params
from lessons.ransac.subject import Subject
from workbench.algorithms import ransac
from workbench.algorithms.models import rms_distance


@dataclass(frozen=True, eq=False)
class Rival:
    """What a method that uses all rows at once makes of them.

    Attributes:
        name: Least squares, or Huber's loss.
        estimate: Its answer.
        error: To the truth, in the unit of the model; NaN where that is not known.
    """

    name: str
    estimate: np.ndarray
    error: float


@dataclass(frozen=True, eq=False)
class State:
    """One step: what RANSAC just did, and how far its best is from the truth.

    Attributes:
        params: The inputs.
        subject: The rows, the same for the whole run.
        now: What RANSAC yielded.
        inlier_distance: In the unit of the model.
        trial_error: Of the model under test to the truth; NaN where there is none or the truth is not known.
        best_error: Of the best so far, likewise.
        chosen: Whether the sample was picked by the person.
        rivals: Least squares and Huber, over all rows.
        before: The best one step earlier, if any: what a new best or a refit replaced.
        degenerate: How many samples determined no model so far.
    """

    params: Params
    subject: Subject
    now: ransac.State
    inlier_distance: float
    trial_error: float
    best_error: float
    chosen: bool
    rivals: tuple[Rival, ...]
    before: ransac.Fit | None
    degenerate: int


def error_of(subject: Subject, estimate: np.ndarray | None) -> float:
    """Return the root mean square distance of the noiseless rows to an estimate; NaN where that is not known."""
    if estimate is None or not len(subject.p_true):
        return float("nan")
    return rms_distance(subject.model, estimate, subject.p_true)
