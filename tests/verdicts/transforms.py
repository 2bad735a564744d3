"""When what the lesson on transforms says is true, decided with numpy and scipy from the numbers
that were asked for.
"""

from typing import Any

import numpy as np
from scipy.spatial.transform import Rotation

from lessons.transforms.by_hand import draw as draw_hand
from lessons.transforms.captions import caption_of as caption_of_factors
from lessons.transforms.factors import Built
from tests.readings import LENGTH, NUMBER, near, near_length
from tests.verdicts import Claim, Run
from workbench.lesson import Look
from workbench.scene import Caption, caption_of

__all__ = ["CAPTIONS", "LINES", "VALUES", "WHYS", "caption", "right"]

FRONT = np.array([0.0, -1.0, 0.0])
SAME = 1e-9


def caption(look: Look) -> Caption:
    if isinstance(look.now, Built):
        return caption_of_factors(look)
    return caption_of(draw_hand(look))


def built(run: Run) -> bool:
    return run.params.stage == "factors"


def mapped(T: np.ndarray, p: np.ndarray) -> np.ndarray:
    p_h = np.column_stack([p, np.ones(len(p))]) @ T.T
    return p_h[:, :3] / p_h[:, 3:]


def vertices(run: Run) -> np.ndarray:
    return run.subject.solid.p


def rigid(R: np.ndarray, t: np.ndarray) -> np.ndarray:
    return np.vstack([np.column_stack([R, t]), [0, 0, 0, 1]])


def product(run: Run, k: int) -> np.ndarray:
    """All factors up to a step of the stage `factors`."""
    T = np.eye(4)
    for state in run.states[1 : k + 1]:
        T = state.factor.matrix @ T
    return T


def shape_of(params: Any) -> np.ndarray:
    """What is done to the shape, from the numbers."""
    A = np.diag([*params.scale, 1.0])
    slide = np.eye(4)
    divide = np.eye(4)
    flip = np.eye(4)
    slide[0, 2] = params.shear
    divide[3, 2] = params.perspective
    if params.mirror != "none":
        flip["xyz".index(params.mirror)] *= -1
    return flip @ divide @ slide @ A


def motion_of(params: Any, *, swapped: bool = False) -> np.ndarray:
    """The rigid part, from the numbers as scipy reads them."""
    R = Rotation.from_euler(params.order, params.angles, degrees=True).as_matrix()
    R = Rotation.from_rotvec(params.pose[3:]).as_matrix() @ R
    t = np.array(params.pose[:3], float)
    rotate_first = (params.first == "rotate, then translate") != swapped
    return rigid(R, t if rotate_first else R @ t)


def hand(run: Run, k: int) -> np.ndarray:
    """The two maps under the hand (2, 4, 4), from the numbers."""
    params = run.params
    value = run.states[k].value
    t = np.array(params.pose[:3], float)
    R = Rotation.from_euler("z", value, degrees=True).as_matrix()
    T = rigid(R, t)
    if params.stage == "order":
        return np.stack([T, rigid(R, R @ t)])
    if params.stage == "undo":
        return np.stack([np.eye(4), rigid(R.T, -t) @ T])
    if params.stage == "shift":
        return np.stack([rigid(np.eye(3), 0.01 * value * t), np.eye(4)])
    other = np.eye(4)
    if params.stage == "shear":
        other[0, 2] = value
    elif params.stage == "divide":
        other[3, 2] = value
    else:
        other = run.states[k].T
    return np.stack([other, np.eye(4)])


def degrees(v: np.ndarray, w: np.ndarray) -> float:
    return float(np.degrees(np.arctan2(np.linalg.norm(np.cross(v, w)), v @ w)))


def edges(run: Run) -> np.ndarray:
    faces = run.subject.solid.faces
    return np.unique(np.sort(faces[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1), axis=0)


def corner_angles(p: np.ndarray, faces: np.ndarray) -> np.ndarray:
    a, b, c = p[faces].transpose(1, 0, 2)
    angles = [
        [degrees(v, w) for v, w in zip(*pair, strict=True)]
        for pair in ((b - a, c - a), (c - b, a - b), (a - c, b - c))
    ]
    return np.array(angles)


def bent(run: Run, k: int) -> float:
    faces = run.subject.solid.faces
    before, after = (mapped(product(run, i), vertices(run)) for i in (k - 1, k))
    return float(np.abs(corner_angles(after, faces) - corner_angles(before, faces)).max())


def unparallel(run: Run, T_before: np.ndarray, T: np.ndarray) -> float:
    """The largest angle, degrees, between edges that were parallel before."""
    units = []
    for A in (T_before, T):
        v = np.diff(mapped(A, vertices(run))[edges(run)], axis=1)[:, 0]
        units.append(v / np.linalg.norm(v, axis=1, keepdims=True))
    was = np.linalg.norm(np.cross(units[0][:, None], units[0][None]), axis=2) < 1e-9
    sines = np.linalg.norm(np.cross(units[1][:, None], units[1][None]), axis=2)[was]
    return float(np.degrees(np.arcsin(min(sines.max(), 1.0))))


def upright_apart(run: Run, k: int) -> float:
    T = hand(run, k)[0]
    v = np.diff(mapped(T, vertices(run))[edges(run)], axis=1)[:, 0]
    was = np.diff(vertices(run)[edges(run)], axis=1)[:, 0]
    rising = v[np.abs(was[:, :2]).max(axis=1) < 1e-9]
    return max(degrees(a, b) for a in rising for b in rising)


def apart(run: Run, k: int) -> float:
    if built(run):
        return unparallel(run, product(run, k - 1), product(run, k))
    if run.params.stage == "divide":
        return upright_apart(run, k)
    first, other = hand(run, k)
    return float(np.linalg.norm(first[:3, 3] - other[:3, 3]))


def moved(run: Run, k: int) -> float:
    point = min(run.params.point, len(vertices(run)) - 1)
    p = vertices(run)[[point]]
    return float(np.linalg.norm(mapped(product(run, k), p) - mapped(product(run, k - 1), p)))


def farthest(T: np.ndarray, other: np.ndarray, p: np.ndarray) -> float:
    return float(np.linalg.norm(mapped(T, p) - mapped(other, p), axis=1).max())


def off(run: Run, k: int) -> float:
    """How far a second reading is off: metres, or degrees of a direction."""
    params = run.params
    p = vertices(run)
    if not built(run):
        taken = FRONT + hand(run, k)[0][:3, 3]
        return degrees(FRONT, taken)
    A = shape_of(params)
    T = motion_of(params)
    if params.compare == "direction with w = 1":
        M = T @ A
        return degrees(M[:3, :3] @ FRONT, M[:3, :3] @ FRONT + M[:3, 3])
    if params.compare == "the other order":
        return farthest(motion_of(params, swapped=True) @ A, T @ A, p)
    if params.compare == "best rigid motion":
        q = mapped(T @ A, p)
        R = Rotation.align_vectors(q - q.mean(axis=0), p - p.mean(axis=0))[0].as_matrix()
        best = rigid(R, q.mean(axis=0) - R @ p.mean(axis=0))
        return farthest(best, T @ A, p)
    if params.compare == "undo by (Rᵀ, −t)":
        return farthest(rigid(T[:3, :3].T, -T[:3, 3]) @ T @ A, A, p)
    M = T @ A
    return farthest(rigid(M[:3, :3].T, -M[:3, :3].T @ M[:3, 3]) @ M, np.eye(4), p)


def lean(run: Run, k: int) -> float:
    share = run.states[k].value / 100
    tip = np.array(run.params.z_tip)
    z = np.array([0.0, 0.0, 1.0])
    whole = degrees(z, tip)
    return share * whole if 0 < whole < 180 else degrees(z, (1 - share) * z + share * tip)


def det(run: Run, k: int) -> float:
    T = run.states[k].factor.matrix if built(run) else run.states[k].T
    a, b, c = T[:3, :3].T
    return float(np.cross(a, b) @ c)


VALUES = {
    "det": det,
    "bent": bent,
    "apart": apart,
    "moved": moved,
    "point": lambda run, k: min(run.params.point, len(vertices(run)) - 1),
    "off": off,
    "left": lambda run, k: farthest(run.states[k].T, shape_of(run.params), vertices(run)),
    "lean": lean,
    "angle": lambda run, k: float(run.states[k].value),
    "missed": lambda run, k: float(np.linalg.norm(hand(run, k)[1][:3, 3])),
    "shear": lambda run, k: float(hand(run, k)[0][0, 2]),
    "upright": lambda run, k: float(np.linalg.norm(hand(run, k)[0][:3, 2])),
    "corner": lambda run, k: degrees(np.array([1.0, 0, 0]), hand(run, k)[0][:3, 2]),
    "shift": lambda run, k: float(np.linalg.norm(hand(run, k)[0][:3, 3])),
    "s": lambda run, k: float(hand(run, k)[0][3, 2]),
}


def right(run: Run, k: int) -> bool | None:
    """Judged are a wrong undoing, a direction that was shifted, and a plain return."""
    params = run.params
    state = run.states[k]
    if not built(run):
        if params.stage == "undo" and np.abs(state.T - np.eye(4)).max() > SAME:
            return False
        return None
    if state.factor.kind == "undo":
        if farthest(state.T, shape_of(params), vertices(run)) > SAME:
            return False
        if params.compare in ("undo by (Rᵀ, −t)", "undo all as if rigid"):
            return False if off(run, k) > SAME else None
        is_start = farthest(state.T, np.eye(4), vertices(run)) < SAME
        return True if is_start and params.compare == "nothing" else None
    if state.complete and params.compare == "direction with w = 1":
        shift = (motion_of(params) @ shape_of(params))[:3, 3]
        return False if np.linalg.norm(shift) > SAME else None
    return None


CAPTIONS = (
    Claim(r"best rigid motion", None),
    Claim(
        r"does not come home",
        lambda run, k, m: np.abs(run.states[k].T - np.eye(4)).max() > SAME,
    ),
    Claim(
        r"the body is ([\d.]+) times as high",
        lambda run, k, m: near(m[1], run.params.scale[2]),
    ),
)


def left_by_the_wrong(run: Run) -> float:
    """How far the origin ends from its start when (Rᵀ, −t) takes the whole motion back, metres."""
    T = motion_of(run.params)
    return float(np.linalg.norm((rigid(T[:3, :3].T, -T[:3, 3]) @ T)[:3, 3]))


def quarter(run: Run) -> int:
    return int(np.argmin([abs(state.value - 90.0) for state in run.states]))


LINES = {
    "mirror": (
        Claim(r"The vermillion house is the best of all rigid motions[^.]*does not fit", None),
    ),
    "hidden-scale": (Claim(r"1\.69 times", lambda run, k, m: abs(1.3**2 - 1.69) < SAME),),
}
WHYS = {
    "read-columns": (
        Claim(
            r"quarter turn to the left",
            lambda run, k, m: bool(
                np.allclose(run.states[-1].T[:3, :3] @ [1, 0, 0], [0, 1, 0])
                and np.allclose(run.states[-1].T[:3, :3] @ [0, 1, 0], [-1, 0, 0])
            ),
        ),
    ),
    "which-order": (
        Claim(rf"^({LENGTH})\.", lambda run, k, m: near_length(m[1], apart(run, quarter(run)), 3)),
    ),
    "undo": (
        Claim(
            rf"upright and ({LENGTH}) off",
            lambda run, k, m: near_length(m[1], left_by_the_wrong(run), 3),
        ),
    ),
    "sheared-volume": (
        Claim(
            rf"multiplied by ({NUMBER})",
            lambda run, k, m: near(m[1], float(np.linalg.det(hand(run, 46)[0][:3, :3]))),
        ),
    ),
    "apex": (
        Claim(
            rf"At ({LENGTH})\.",
            lambda run, k, m: near_length(m[1], 1.0 / run.states[25].value),
        ),
    ),
}
