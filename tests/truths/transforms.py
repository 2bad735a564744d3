"""What is true of a map and of a move, from the factors and the poses alone, with scipy's
rotations.
"""

import functools
import itertools
from typing import Any

import numpy as np
from scipy.spatial.transform import Rotation

from tests.verdicts import Run

SHAPE = ("scale", "shear", "perspective", "mirror")
SMALL = 1e-9


def mapped(T: np.ndarray, p: np.ndarray) -> np.ndarray:
    p_h = np.column_stack([p, np.ones(len(p))]) @ T.T
    return p_h[:, :3] / p_h[:, 3:]


def product(run: Run, k: int, *, of: tuple[str, ...] | None = None) -> np.ndarray:
    """All factors up to a step, or those of some kinds."""
    T = np.eye(4)
    for state in run.states[1 : k + 1]:
        if of is None or state.factor.kind in of:
            T = state.factor.matrix @ T
    return T


def rotation_of(params: Any, angles: tuple[float, ...], order: str | None = None) -> np.ndarray:
    return Rotation.from_euler(order or params.order, angles, degrees=True).as_matrix()


def rigid(R: np.ndarray, t: np.ndarray) -> np.ndarray:
    return np.vstack([np.column_stack([R, t]), [0, 0, 0, 1]])


def motion_of(params: Any, first: str | None = None, **other: Any) -> np.ndarray:
    """The rigid part, from the numbers as scipy reads them."""
    R = rotation_of(params, other.get("angles", params.angles), other.get("order"))
    R = Rotation.from_rotvec(params.pose[3:]).as_matrix() @ R
    t = np.array(params.pose[:3], float)
    return rigid(R, t if (first or params.first) == "rotate, then translate" else R @ t)


def farthest(T: np.ndarray, other: np.ndarray, p: np.ndarray) -> float:
    return float(np.linalg.norm(mapped(T, p) - mapped(other, p), axis=1).max())


def complete_at(run: Run) -> int:
    return len(run.states) - 2  # the last step takes the motion back


def readings(run: Run) -> list[float]:
    """How far the farthest vertex is off under each second reading of the whole map."""
    params, p = run.params, run.states[0].body.solid.p
    A, T = product(run, complete_at(run), of=SHAPE), motion_of(run.params)
    swapped = {"rotate, then translate": "translate, then rotate"}.get(
        params.first, "rotate, then translate"
    )
    q = Rotation.from_matrix(T[:3, :3]).as_quat()  # x y z w
    w_first = np.array([q[3], *q[:3]]) * (1 if q[3] >= 0 else -1)
    others: dict[str, list[np.ndarray]] = {
        "the other order": [motion_of(params, first=swapped)],
        "four conventions": [
            motion_of(params, order=order) for order in ("xyz", "XYZ", "ZYX", "ZXZ")
        ],
        "fixed and own axes": [
            motion_of(params, order=params.order.swapcase()[::-1], angles=params.angles[::-1]),
            motion_of(params, order=params.order.swapcase()),
        ],
        "transpose": [rigid(T[:3, :3].T, T[:3, 3])],
        "xyzw for wxyz": [rigid(Rotation.from_quat(w_first).as_matrix(), T[:3, 3])],
    }
    if params.compare == "other triples":
        return [farthest(ghost.T, T @ A, p) for ghost in run.states[complete_at(run)].ghosts]
    if params.compare == "best rigid motion":
        p_ours = mapped(T @ A, p)
        middle, middle_ours = p.mean(axis=0), p_ours.mean(axis=0)
        R = Rotation.align_vectors(p_ours - middle_ours, p - middle)[0].as_matrix()
        return [farthest(rigid(R, middle_ours - R @ middle), T @ A, p)]
    return [farthest(other @ A, T @ A, p) for other in others[params.compare]]


def wrong_undo(run: Run) -> tuple[np.ndarray, np.ndarray]:
    """The body after the wrong inverse that is compared, and where it should be."""
    A, T, k = product(run, complete_at(run), of=SHAPE), motion_of(run.params), complete_at(run)
    if run.params.compare == "undo by (Rᵀ, −t)":
        return rigid(T[:3, :3].T, -T[:3, 3]) @ product(run, k), A
    M = product(run, k)
    return rigid(M[:3, :3].T, -M[:3, :3].T @ M[:3, 3]) @ M, np.eye(4)


def left_after_undo(run: Run) -> float:
    A, T = product(run, complete_at(run), of=SHAPE), motion_of(run.params)
    p = run.states[0].body.solid.p
    return max(farthest(np.linalg.inv(T) @ T @ A, A, p), farthest(run.states[-1].T, A, p))


def fronts(run: Run, k: int) -> tuple[np.ndarray, np.ndarray]:
    T = product(run, k)
    return (T @ [0, -1, 0, 0])[:3], (T @ [0, -1, 0, 1])[:3]


def edges_of(run: Run) -> np.ndarray:
    faces = run.states[0].body.solid.faces
    return np.unique(np.sort(faces[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1), axis=0)


def vectors(run: Run, k: int) -> np.ndarray:
    p = mapped(product(run, k), run.states[0].body.solid.p)
    return np.diff(p[edges_of(run)], axis=1)[:, 0]


def lengths(run: Run, k: int) -> np.ndarray:
    return np.linalg.norm(vectors(run, k), axis=1)


def corner_angles(run: Run, k: int) -> np.ndarray:
    p = mapped(product(run, k), run.states[0].body.solid.p)
    a, b, c = p[run.states[0].body.solid.faces].transpose(1, 0, 2)
    found = []
    for v, w in ((b - a, c - a), (c - b, a - b), (a - c, b - c)):
        cosine = np.einsum("ij,ij->i", v, w) / np.linalg.norm(v, axis=1) / np.linalg.norm(w, axis=1)
        found.append(np.degrees(np.arccos(np.clip(cosine, -1, 1))))
    return np.stack(found)


def volume(run: Run, k: int) -> float:
    """Of a convex body or not: by the tetrahedra from its first vertex."""
    p = mapped(product(run, k), run.states[0].body.solid.p)
    return float(np.linalg.det((p - p[0])[run.states[0].body.solid.faces]).sum() / 6)


def apart(run: Run, k: int) -> float:
    """The largest angle, degrees, between edges that were parallel in the step before."""
    before, after = vectors(run, k - 1), vectors(run, k)
    unit = [v / np.linalg.norm(v, axis=1, keepdims=True) for v in (before, after)]
    parallel = np.abs(unit[0] @ unit[0].T) > 1 - 1e-12
    return float(np.degrees(np.arccos(np.clip(np.abs(unit[1] @ unit[1].T)[parallel], 0, 1))).max())


def moved_by(run: Run, k: int) -> np.ndarray:
    p = run.states[0].body.solid.p
    return np.linalg.norm(mapped(product(run, k), p) - mapped(product(run, k - 1), p), axis=1)


def outer_axes_apart(params: Any) -> float:
    """The angle, degrees, between the axes of the first and third angle, by a small change of
    each.
    """
    R, tiny = rotation_of(params, params.angles), 1e-4
    axes = []
    for k in (0, 2):
        angles = np.array(params.angles)
        angles[k] += np.degrees(tiny)
        w = Rotation.from_matrix(rotation_of(params, tuple(angles)) @ R.T).as_rotvec()
        axes.append(w / np.linalg.norm(w))
    return float(np.degrees(np.arcsin(min(np.linalg.norm(np.cross(*axes)), 1.0))))


@functools.lru_cache(maxsize=4)
def poses(params: Any) -> tuple[np.ndarray, np.ndarray]:
    """The start and the end of a move."""
    R_end = Rotation.from_rotvec(params.pose[3:]).as_matrix() @ rotation_of(
        params, params.angles_end
    )
    return rigid(rotation_of(params, params.angles), np.zeros(3)), rigid(
        R_end, np.array(params.pose[:3], float)
    )


def turn_between(T: np.ndarray, other: np.ndarray) -> float:
    """Degrees between two rotations, or between those nearest to what are none."""
    U, _, V = np.linalg.svd(other[:3, :3] @ T[:3, :3].T)
    return float(
        np.degrees(Rotation.from_matrix(U @ np.diag([1, 1, np.linalg.det(U @ V)]) @ V).magnitude())
    )


def nearest(T: np.ndarray) -> np.ndarray:
    U, _, V = np.linalg.svd(T[:3, :3])
    return rigid(U @ np.diag([1, 1, np.linalg.det(U @ V)]) @ V, np.zeros(3))


@functools.lru_cache(maxsize=2)
def every_turn(run: Run) -> np.ndarray:
    Ts = [nearest(state.T_world_body) for state in run.states]
    return np.array([turn_between(a, b) for a, b in itertools.pairwise(Ts)])


def turned(run: Run, k: int) -> np.ndarray:
    """Degrees from each pose to the next, up to a step."""
    return every_turn(run)[:k]


def at_best(run: Run, k: int) -> np.ndarray:
    start, end = poses(run.params)
    w = Rotation.from_matrix(end[:3, :3] @ start[:3, :3].T).as_rotvec()
    t = k / (len(run.states) - 1)
    return rigid(Rotation.from_rotvec(t * w).as_matrix() @ start[:3, :3], t * end[:3, 3])


def volumes(run: Run, k: int) -> np.ndarray:
    return np.array([np.linalg.det(state.T_world_body[:3, :3]) for state in run.states[: k + 1]])


def met(run: Run) -> bool:
    return np.abs(run.states[-1].T_world_body - poses(run.params)[1]).max() < SMALL


def squares(run: Run) -> float:
    """The sum of squared distances between the first second reading and the body, vertex by
    vertex.
    """
    p, k = run.states[0].body.solid.p, complete_at(run)
    return float(((mapped(run.states[k].ghosts[0].T, p) - mapped(product(run, k), p)) ** 2).sum())


def cross_ratio(p: np.ndarray) -> float:
    a, b, c, d = p
    size = np.linalg.norm
    return float(size(c - a) * size(d - b) / (size(c - b) * size(d - a)))
