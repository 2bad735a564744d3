"""What is true of a run of the pose lesson, by scipy's rotations and plain sums, from its states
alone.
"""

from typing import Any

import numpy as np
from scipy.spatial.transform import Rotation

from lessons.pose.state import Repeated
from tests.truths import decided
from workbench.algorithms.cameras.camera_search import Searched
from workbench.algorithms.robust import ransac


def centre(T: np.ndarray) -> np.ndarray:
    """The point that a motion takes to the origin."""
    return np.linalg.solve(T[:3, :3], -T[:3, 3])


def off(T: np.ndarray, T_true: np.ndarray) -> tuple[float, float]:
    """Degrees and metres from the truth."""
    turn = Rotation.from_matrix(T[:3, :3]) * Rotation.from_matrix(T_true[:3, :3]).inv()
    return float(np.degrees(turn.magnitude())), float(np.linalg.norm(centre(T) - centre(T_true)))


def is_near(T: np.ndarray | None, subject: Any) -> bool:
    """Within 10 degrees and a tenth of the distance."""
    if T is None or not np.isfinite(T).all():
        return False
    degrees, metres = off(T, subject.T_true)
    away = np.linalg.norm(centre(subject.T_true) - subject.given.p_world.mean(axis=0))
    return bool(degrees < 10 and metres < 0.1 * away)


def pixels_off(T: np.ndarray, subject: Any) -> np.ndarray:
    """How far each point is seen from its pixel; infinite from behind."""
    distances = []
    for p, uv in zip(subject.given.p_world, subject.given.uv, strict=True):
        x, y, w = subject.K @ (T[:3, :3] @ p + T[:3, 3])
        distances.append(np.hypot(x / w - uv[0], y / w - uv[1]) if w > 0 else np.inf)
    return np.array(distances)


def rms(values: np.ndarray) -> float:
    return float(np.sqrt(np.mean(np.square(values))))


def share_near(trials: Repeated, subject: Any) -> float:
    """The share of other pictures in which a pose is near."""
    return sum(is_near(T, subject) for T in trials.Ts) / trials.pictures


def is_right(state: Any) -> bool | None:
    """Whether the end of a run is right; None before it."""
    step, subject = state.now, state.subject
    if subject.T_true is None:
        return None
    if isinstance(step, Repeated):
        share = share_near(step, subject)
        return decided(share == 1, wrong=share < 0.9)
    if isinstance(step, ransac.State):
        if step.phase != "stop":
            return None
        return step.best is not None and is_near(step.best.estimate, subject)
    if isinstance(step, Searched) and (
        step.phase == "stop" or (step.phase in ("choose", "solved") and not state.params.refine)
    ):
        return is_near(step.T, subject)
    return None
