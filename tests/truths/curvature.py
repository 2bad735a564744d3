"""What is true of a measured mesh: by brute force over the triangles, and against the analytic
surface.
"""

import functools
from collections.abc import Iterator

import numpy as np

from lessons.curvature.inputs import Input
from lessons.curvature.lesson import lesson
from lessons.curvature.mesh import subject_of
from lessons.curvature.state import State, Step, beside_its_mesh
from tests.geometry.by_faces import measured_face_by_face
from tests.verdicts import Run
from workbench.certain import as_a


def shown(run: Run) -> Run:
    """Return the run with each step beside its mesh and inputs; other runs as they are."""
    if run.params.stage != "mesh":
        return run
    states = tuple(beside_its_mesh(run.params, run.subject, step) for step in run.states)
    return Run(run.params, states, run.subject)


def run_of(params: Input) -> Iterator[State]:
    """Yield the steps of a mesh, each beside it."""
    for step in lesson.form.states(params):
        yield beside_its_mesh(params, subject_of(params), as_a(Step, step))


def facts(state):
    p, faces = state.subject.p, state.subject.faces
    return measured_face_by_face(
        np.ascontiguousarray(p).tobytes(), np.ascontiguousarray(faces, dtype=np.int64).tobytes()
    )


def defects(state) -> np.ndarray:
    angles, _, border, _ = facts(state)
    return np.where(border, np.pi, 2 * np.pi) - angles


def defect_here(state) -> float:
    return float(defects(state)[state.now.vertex])


def angle_K(state) -> np.ndarray:
    _, areas, border, _ = facts(state)
    return np.where(border, np.nan, defects(state) / areas)


def rms(estimate: np.ndarray, true: np.ndarray, inside: np.ndarray) -> float:
    return float(np.sqrt(np.mean((estimate - true)[inside] ** 2) / np.mean(true[inside] ** 2)))


def at(run: Run, stage: str):
    return next(s for s in run.states if s.stage == stage)


def study(run: Run):
    return run.states[-1].study


def slope(errors: np.ndarray, counts: np.ndarray) -> float:
    """Return the power of the number of vertices with which errors go."""
    return float(np.polyfit(np.log(counts), np.log(np.maximum(errors, 1e-12)), 1)[0])


def exact_sum(run: Run, *_) -> bool:
    return abs(float(defects(run.states[-1]).sum()) - 2 * np.pi * facts(run.states[-1])[3]) < 1e-6


def defect_sum_of_all(run: Run, *_) -> bool:
    return (
        abs(float(at(run, "total").now.defects.sum()) - 2 * np.pi * facts(run.states[-1])[3]) < 1e-6
    )


def inside(run: Run, stage: str, name: str) -> np.ndarray:
    state = at(run, stage)
    return getattr(state.now, name)[~facts(state)[2]]


def too_small(run: Run, *_) -> bool:
    state = at(run, "gaussian")
    v = state.now.vertex
    finer = angle_free_defect(Input(vertices=4 * 1600, mistake="none"))
    coarse = float(np.median(np.abs(defects(state))))
    times = np.median(np.abs(state.subject.truth.gaussian / state.now.K))
    return (
        state.subject.truth.gaussian[v] / state.now.K[v] > 70
        and 95 < times < 105
        and 3.4 < coarse / finer < 4.6
    )


@functools.cache
def angle_free_defect(params: Input) -> float:
    """Return the typical defect of a mesh."""
    return float(np.median(np.abs(defects(next(iter(run_of(params)))))))


def off_by_more_than_itself(run: Run, *_) -> bool:
    return error_of_K(run) > 1


def off_by_five_times_itself(run: Run, *_) -> bool:
    return error_of_K(run) > 5


def error_of_K(run: Run) -> float:
    state = at(run, "gaussian")
    return rms(angle_K(state), state.subject.truth.gaussian, ~facts(state)[2])


def on_the_torus(run: Run, *_) -> bool:
    p = run.states[0].subject.p
    return bool(np.allclose(np.hypot(np.hypot(p[:, 0], p[:, 1]) - 1, p[:, 2]), 0.4))


def regular(run: Run, *_) -> bool:
    s = study(run)
    # edges go with the root of the vertices
    return abs(error_of_K(run) - 0.0013) < 5e-5 and -1.15 < slope(s.K, s.counts) < -0.85


def params(run: Run, **changes) -> Input:
    return Input(
        **({name: getattr(run.params, name) for name in ("surface", "vertices", "seed")} | changes)
    )


@functools.cache
def mean_of(params: Input) -> np.ndarray:
    return next(s for s in run_of(params) if s.stage == "mean").now.H


def turned(run: Run):
    return next(iter(run_of(params(run, inside_out=False))))


def scaled_by_two(run: Run) -> bool:
    unscaled = next(iter(run_of(Input())))
    two = run.states[0]
    H = at(run, "mean").now.H
    return (
        bool(np.allclose(defects(unscaled), defects(two)))
        and bool(np.allclose(4 * facts(unscaled)[1], facts(two)[1]))
        and bool(np.allclose(H, mean_of(Input()) / 2))
    )
