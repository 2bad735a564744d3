"""What is true of a registration, with scipy from the motions and the truth they carry."""

from functools import lru_cache

import numpy as np
from scipy.spatial import KDTree
from scipy.spatial.transform import Rotation

from lessons.icp.lesson import run as run_icp
from lessons.icp.presets import OVERLAP
from lessons.icp.state import Params, State
from tests.verdicts import Run


def degrees(T: np.ndarray, truth: np.ndarray) -> float:
    return float(
        np.degrees(
            (
                Rotation.from_matrix(T[:3, :3]) * Rotation.from_matrix(truth[:3, :3]).inv()
            ).magnitude()
        )
    )


def moved(T: np.ndarray, p: np.ndarray) -> np.ndarray:
    return p @ T[:3, :3].T + T[:3, 3]


@lru_cache(maxsize=4)
def _spacing(key: int, p: bytes) -> float:
    places = np.unique(np.frombuffer(p).reshape(-1, 3), axis=0)
    return float(np.median(np.asarray(KDTree(places).query(places, k=2)[0])[:, 1]))


def spacing(state: State) -> float:
    p = state.scans.p_target
    return _spacing(len(p), np.ascontiguousarray(p).tobytes())


def off_by(state: State, T: np.ndarray) -> tuple[float, float, float]:
    """Degrees, metres at the middle, and metres by root mean square over the source's points."""
    assert state.scans.T_truth is not None
    p = state.scans.p_source[~state.scans.is_outlier]
    off = moved(T, p) - moved(state.scans.T_truth, p)
    middle = moved(T, p.mean(axis=0)[None]) - moved(state.scans.T_truth, p.mean(axis=0)[None])
    return (
        degrees(T, state.scans.T_truth),
        float(np.linalg.norm(middle)),
        float(np.sqrt((off**2).sum(axis=1).mean())),
    )


def home(state: State, T: np.ndarray) -> bool:
    """Rotation and place and all: the rotation alone says nothing of a slide."""
    turn, _, distance = off_by(state, T)
    return turn < 5.0 and distance < 2.0 * spacing(state)


def end_of(run: Run) -> State:
    return next(state for state in run.states if state.icp.stop)


def arrived(run: Run, k: int) -> bool:
    return home(run.states[k], run.states[k].icp.T_target_source)


def try_home(state: State, i: int) -> bool:
    assert state.scans.T_truth is not None
    return home(state, state.tries[i].T_target_truth @ state.scans.T_truth)


def share(run: Run, k: int) -> float:
    state = run.states[k]
    assert state.scans.T_truth is not None
    kept = state.icp.kept
    belongs = moved(state.scans.T_truth, state.scans.p_source[kept])
    off = np.linalg.norm(state.scans.p_target[state.icp.indices[kept]] - belongs, axis=1)
    return float(np.mean(off <= 2.0 * state.scans.spacing))


def ended(run: Run) -> tuple[float, float, float]:
    return off_by(end_of(run), end_of(run).icp.T_target_source)


def started(run: Run) -> float:
    """Metres at the middle, from where the run starts."""
    return off_by(run.states[0], run.states[0].scans.T_start)[1]


def came_home(run: Run) -> bool:
    return home(end_of(run), end_of(run).icp.T_target_source)


@lru_cache(maxsize=32)
def fixed_gate(seed: int) -> float:
    """Degrees that the fixed gate leaves at this seed."""
    for state in run_icp(Params(**{**vars(OVERLAP), "seed": seed})):
        if state.icp.stop:
            return off_by(state, state.icp.T_target_source)[0]
    raise AssertionError
