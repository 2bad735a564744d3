"""The mesh to measure, and what one step holds."""

from dataclasses import dataclass

import numpy as np

from lessons.curvature.inputs import Input
from workbench.algorithms.surfaces.curvature import Measured
from workbench.data.shapes.surfaces import Surface
from workbench.geometry.meshes import vertices_within
from workbench.lesson import Look


@dataclass(frozen=True, eq=False, kw_only=True)
class Subject:
    """A mesh to measure.

    Attributes:
        name: What it is called in sentences.
        p: Vertices, metres.
        faces: Triangles, counterclockwise seen from outside.
        truth: The surface from which it was made, with its analytic curvature; None for an own
            mesh.
        edges: Every edge once.
        border: Which vertices lie on its border.
        front: The vertex inside the border that faces the viewer best.
        enlarged: How many times larger than in its file an own mesh is.
        up: Which axis of an own mesh's file points up here.
        mended: What had to be mended in an own mesh, in words.
    """

    name: str
    p: np.ndarray
    faces: np.ndarray
    truth: Surface | None
    edges: np.ndarray
    border: np.ndarray
    front: int
    enlarged: float = 1.0
    up: str = "z"
    mended: tuple[str, ...] = ()

    @property
    def inside(self) -> np.ndarray:
        """Which vertices do not lie on the border."""
        return ~self.border


@dataclass(frozen=True, eq=False, kw_only=True)
class Study:
    """Relative errors of four estimates on ever finer meshes of one surface.

    Attributes:
        counts: How many vertices the meshes have.
        K, H: Errors of the angle defects and the cotangents.
        K_fit, H_fit: Errors of the quadric fits.
        meshes: The surfaces themselves.
        off: At each vertex of each, the error of K from angles, 1/m^2; NaN on a border.
    """

    counts: np.ndarray
    K: np.ndarray
    H: np.ndarray
    K_fit: np.ndarray
    H_fit: np.ndarray
    meshes: tuple[Surface, ...]
    off: tuple[np.ndarray, ...]


@dataclass(frozen=True, eq=False, kw_only=True)
class Step:
    """One step of the run: what was measured, or at the end how errors depend on the mesh.

    Attributes:
        now: What is measured so far.
        errors: Relative errors so far, by name; none for an own mesh.
        study: Errors on ever finer meshes, in the last step.
        unfolded: How far the ring of the vertex is laid flat, up to 1.
    """

    now: Measured
    errors: dict[str, float]
    study: Study | None = None
    unfolded: float = 1.0

    @property
    def stage(self) -> str:
        """The stage by name."""
        if self.study is not None:
            return "finer"
        return "unfolding" if self.unfolded < 1 else self.now.stage


@dataclass(frozen=True, eq=False, kw_only=True)
class State(Step):
    """A step beside its mesh and its inputs: what captions, charts and pictures read."""

    params: Input
    subject: Subject

    @property
    def on_border(self) -> bool:
        """Whether the vertex that is looked at lies on the border."""
        return bool(self.subject.border[self.now.vertex])

    @property
    def two_rings(self) -> np.ndarray:
        """The vertices at most two edges away from the one that is looked at, itself included."""
        return vertices_within(self.subject.edges, self.now.vertex, 2)

    def true(self, name: str) -> float:
        """Return the analytic `gaussian`, `mean`, `k1` or `k2` at the vertex; NaN where nobody
        knows.
        """
        surface = self.subject.truth
        return float("nan") if surface is None else float(getattr(surface, name)[self.now.vertex])


def beside_its_mesh(params: Input, subject: Subject, step: Step) -> State:
    """Return a step together with what it was measured on."""
    return State(
        params=params,
        subject=subject,
        now=step.now,
        errors=step.errors,
        study=step.study,
        unfolded=step.unfolded,
    )


def state_of(look: Look[Input, Subject, Step]) -> State:
    """Return the step that is looked at, together with what it was measured on."""
    return beside_its_mesh(look.params, look.subject, look.now)


def at_stage(states, stage: str):
    """Return the state of a run at a stage."""
    return next(state for state in states if state.stage == stage)
