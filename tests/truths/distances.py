"""What is true of a distance, apart from the lesson's core: closed forms, visibility past a wall,
an unrolled spiral.
"""

from typing import Any

import numpy as np
import scipy

from lessons.distances.state import Found, Front, State

NEAR = 0.14


def true_distances(state: State) -> np.ndarray:
    """The true distance of every node from the source; of surfaces without formula what the run was
    held against.
    """
    s = state.subject
    assert s is not None
    p = s.p
    q = s.p[s.source]
    if state.params.stage == "grid":
        assert s.tip is not None
        tip = np.append(s.tip, 0.0)
        distances = []
        for point in p:
            t = np.linspace(0, 1, 2001)
            crossing = point[0] != q[0] and 0 < (tip[0] - q[0]) / (point[0] - q[0]) < 1
            y = (
                np.interp((tip[0] - q[0]) / (point[0] - q[0]), t, q[1] + t * (point[1] - q[1]))
                if crossing
                else np.inf
            )
            seen = y >= tip[1] - 1e-9
            distances.append(
                np.linalg.norm(point - q)
                if seen
                else np.linalg.norm(tip - q) + np.linalg.norm(point - tip)
            )
        return np.array(distances)
    if state.params.stage == "roll" and state.params.cloud is None:
        return unrolled(p, s.source)
    if state.params.shape in ("sphere", "wrung sphere") and state.params.mesh is None:
        return np.arccos(np.clip(p @ q / np.linalg.norm(q) ** 2, -1, 1)) * np.linalg.norm(q)
    assert isinstance(state.now, Found)
    return state.now.truth


def unrolled(p: np.ndarray, source: int) -> np.ndarray:
    """Distances on the sheet of a roll r = t / (4.5 pi), by adding up the spiral's length in small
    steps.
    """
    t = np.linspace(0, 4.6 * np.pi, 200_001)
    x, y = t * np.cos(t), t * np.sin(t)
    length = np.concatenate([[0.0], np.cumsum(np.hypot(np.diff(x), np.diff(y)))]) / (4.5 * np.pi)
    along = np.interp(np.linalg.norm(p[:, :2], axis=1) * 4.5 * np.pi, t, length)
    return np.hypot(along - along[source], p[:, 2] - p[source, 2])


def errors(state: State) -> np.ndarray:
    """The relative errors of a step's distances, far enough from the source."""
    result = state.now
    assert isinstance(result, Found | Front)
    true = true_distances(state)
    finite = np.isfinite(true)
    kept = np.isfinite(result.d) & finite & (true > NEAR * true[finite].max())
    return result.d[kept] / true[kept] - 1


def by_heat(p: np.ndarray, faces: np.ndarray, sources: np.ndarray, *, time: float) -> np.ndarray:
    """Distances (vertices, sources) by heat over a closed mesh, from the paper's formulas with sums
    over single corners.
    """
    n = len(p)
    normals = np.cross(p[faces[:, 1]] - p[faces[:, 0]], p[faces[:, 2]] - p[faces[:, 0]])
    areas = np.linalg.norm(normals, axis=1) / 2
    rows, columns, values = [], [], []
    for k in range(3):
        i = faces[:, (k + 1) % 3]
        j = faces[:, (k + 2) % 3]
        o = faces[:, k]
        u, v = p[i] - p[o], p[j] - p[o]
        half = (u * v).sum(axis=1) / np.linalg.norm(np.cross(u, v), axis=1) / 2
        rows += [i, j, i, j]
        columns += [j, i, i, j]
        values += [-half, -half, half, half]
    L: Any = scipy.sparse.coo_array(
        (np.concatenate(values), (np.concatenate(rows), np.concatenate(columns))), shape=(n, n)
    )
    L = L.tocsc()
    mass: Any = scipy.sparse.diags_array(
        np.bincount(faces.ravel(), np.repeat(areas / 3, 3), n)
    ).tocsc()
    heat = scipy.sparse.linalg.splu(mass + time * L).solve(np.eye(n)[:, sources])
    rise = scipy.sparse.linalg.splu((L + 1e-9 * mass).tocsc())
    unit = normals / (2 * areas)[:, None]
    distances = []
    for u in heat.T:
        slope: Any = sum(
            u[faces[:, k]][:, None]
            * np.cross(unit, p[faces[:, (k + 2) % 3]] - p[faces[:, (k + 1) % 3]])
            for k in range(3)
        )
        X = -slope / np.linalg.norm(slope, axis=1, keepdims=True)
        b = np.zeros(n)
        for k in range(
            3
        ):  # the slope of one corner's hat function, times the area: half its turned opposite edge
            hat = np.cross(unit, p[faces[:, (k + 2) % 3]] - p[faces[:, (k + 1) % 3]]) / 2
            np.add.at(b, faces[:, k], (hat * X).sum(axis=1))
        d = rise.solve(b)
        distances.append(d - d.min())
    return np.array(distances).T


def mahalanobis(p: np.ndarray, mean: np.ndarray, C: np.ndarray) -> np.ndarray:
    """By the inverse, point by point."""
    inverse = np.linalg.inv(C)
    return np.array([np.sqrt((x - mean) @ inverse @ (x - mean)) for x in p])
