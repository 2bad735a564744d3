"""One step of the curvature lesson."""

from dataclasses import dataclass

import numpy as np

from lessons.curvature.params import Params
from lessons.curvature.study import Study
from lessons.curvature.subject import Subject
from workbench.algorithms.curvature import Measured


@dataclass(frozen=True, eq=False)
class State:
    """One step of the lesson: what was measured, or at the end how errors depend on the mesh.

    Attributes:
        params: The inputs.
        subject: The mesh, the same for the whole run.
        now: What is measured so far.
        errors: Relative errors in per cent so far, by name; none for an own mesh.
        study: Errors on ever finer meshes, in the last step.
    """

    params: Params
    subject: Subject
    now: Measured
    errors: dict[str, float]
    study: Study | None = None

    @property
    def stage(self) -> str:
        """The stage by name."""
        return "finer" if self.study is not None else self.now.stage

    @property
    def on_border(self) -> bool:
        """Whether the vertex that is looked at lies on the border."""
        return bool(self.subject.border[self.now.vertex])

    def true(self, name: str) -> float:
        """Return the analytic `gaussian`, `mean`, `k1` or `k2` at the vertex; NaN where nobody knows."""
        surface = self.subject.truth
        return float("nan") if surface is None else float(getattr(surface, name)[self.now.vertex])


def at_stage(states, stage: str) -> State:
    """Return the state of a run at a stage."""
    return next(state for state in states if state.stage == stage)


def surface_variation(state: State) -> float:
    """Return lambda_0 / (lambda_0 + lambda_1 + lambda_2) of the vertex and its two rings: flat 0, at most 1/3.

    Reference: Pauly, Gross and Kobbelt, Efficient simplification of point-sampled surfaces, 2002, equation 4.
    """
    near = state.subject.p[two_rings(state)]
    values = np.linalg.eigvalsh(np.cov(near.T))
    return float(values[0] / values.sum())


def two_rings(state: State) -> np.ndarray:
    """Return the vertices at most two edges away, the vertex itself included."""
    a, b = state.subject.edges.T
    near = np.zeros(len(state.subject.p), dtype=bool)
    near[state.now.vertex] = True
    for _ in range(2):
        touched = near[a] | near[b]
        near[a[touched]] = near[b[touched]] = True
    return np.flatnonzero(near)
