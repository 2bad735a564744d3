"""What is true of a registration, with scipy from the motions and the truth they carry."""

from functools import lru_cache
from typing import Any

import numpy as np
from scipy.optimize import minimize_scalar
from scipy.spatial import KDTree
from scipy.spatial.transform import Rotation

from lessons.icp.lesson import run as run_icp
from lessons.icp.presets import OVERLAP
from lessons.icp.scans import Scans, scans_of
from lessons.icp.space import Try
from tests.verdicts import Run
from workbench.algorithms.registration import icp


def degrees(T: np.ndarray, truth: np.ndarray) -> float:
    rotation, other = (Rotation.from_matrix(_turn(A)) for A in (T, truth))
    return float(np.degrees((rotation * other.inv()).magnitude()))


def _turn(T: np.ndarray) -> np.ndarray:
    U, _, Vt = np.linalg.svd(T[:3, :3])
    return U @ Vt


def moved(T: np.ndarray, p: np.ndarray) -> np.ndarray:
    return p @ T[:3, :3].T + T[:3, 3]


@lru_cache(maxsize=4)
def _spacing(key: int, p: bytes) -> float:
    places = np.unique(np.frombuffer(p).reshape(-1, 3), axis=0)
    return float(np.median(np.asarray(KDTree(places).query(places, k=2)[0])[:, 1]))


def spacing(scans: Scans) -> float:
    p = scans.p_target
    return _spacing(len(p), np.ascontiguousarray(p).tobytes())


def off_by(scans: Scans, T: np.ndarray) -> tuple[float, float, float]:
    """Degrees, metres at the middle, and metres by root mean square over the source's points."""
    assert scans.T_truth is not None
    p = scans.p_source[~scans.is_outlier]
    off = moved(T, p) - moved(scans.T_truth, p)
    middle = moved(T, p.mean(axis=0)[None]) - moved(scans.T_truth, p.mean(axis=0)[None])
    distance = float(np.sqrt((off**2).sum(axis=1).mean()))
    return degrees(T, scans.T_truth), float(np.linalg.norm(middle)), distance


def home(scans: Scans, T: np.ndarray) -> bool:
    """Rotation and place and all: the rotation alone says nothing of a slide."""
    turn, _, distance = off_by(scans, T)
    return turn < 5.0 and distance < 2.0 * spacing(scans)


def steps(run: Run) -> list[Any]:
    return [state for state in run.states if not isinstance(state, Try)]


def end_of(run: Run) -> icp.State:
    return next(state for state in steps(run) if state.stop)


def ended(run: Run) -> tuple[float, float, float]:
    return off_by(run.subject, end_of(run).T_target_source)


def started(run: Run) -> float:
    """Metres at the middle, from where the run starts."""
    return off_by(run.subject, run.subject.T_start)[1]


def came_home(run: Run) -> bool:
    return home(run.subject, end_of(run).T_target_source)


def of_try(run: Run, k: int) -> tuple[float, float, float]:
    scans = run.subject
    return off_by(scans, run.states[k].T_target_truth @ scans.T_truth)


def try_home(run: Run, k: int) -> bool:
    scans = run.subject
    return home(scans, run.states[k].T_target_truth @ scans.T_truth)


@lru_cache(maxsize=32)
def fixed_gate(seed: int) -> float:
    """Degrees that the fixed gate leaves at this seed."""
    params = type(OVERLAP)(**{**vars(OVERLAP), "seed": seed})
    scans = scans_of(params)
    for state in run_icp(params, scans):
        if isinstance(state, icp.State) and state.stop:
            return off_by(scans, state.T_target_source)[0]
    raise AssertionError


def turned(p: np.ndarray, angle: float) -> np.ndarray:
    """Points of the plane turned by degrees, by complex numbers."""
    z = (p[:, 0] + 1j * p[:, 1]) * np.exp(1j * np.radians(angle))
    return np.column_stack([z.real, z.imag])


def flat_rmse(run: Run, k: int) -> float:
    """Of the step's own partners, metres."""
    state = run.states[k]
    lines = run.subject
    gaps = turned(lines.p_source, state.angle) - lines.p_target[state.partners]
    return float(np.sqrt((gaps**2).sum(axis=1).mean()))


def flat_right(run: Run, k: int) -> int:
    lines = run.subject
    gaps = np.linalg.norm(lines.p_target - np.roll(lines.p_target, 1, axis=0), axis=1)
    nearest = KDTree(lines.p_target).query(turned(lines.p_source, run.states[k].angle))[1]
    off = np.linalg.norm(lines.p_target[nearest] - lines.p_source, axis=1)
    return int((off <= np.median(gaps[1:])).sum())


def flat_turn(run: Run, k: int) -> float:
    """Degrees by which the fit of a step must turn the source, by a search."""
    before = run.states[k - 1]
    lines = run.subject
    q, n = lines.p_target[before.partners], lines.n_target[before.partners]
    p = turned(lines.p_source, before.angle)
    if run.params.fit == "point-to-plane":  # a small turn, to first order
        lever = np.column_stack([-p[:, 1], p[:, 0]])
        a = (lever * n).sum(axis=1)
        b = ((q - p) * n).sum(axis=1)
        return abs(float(np.degrees(np.linalg.lstsq(a[:, None], b, rcond=None)[0][0])))

    def cost(turn: float) -> float:
        return float(((turned(p, turn) - q) ** 2).sum())

    minimum = minimize_scalar(cost, bounds=(-60.0, 60.0), method="bounded", options={"xatol": 1e-9})
    return abs(float(minimum.x))
