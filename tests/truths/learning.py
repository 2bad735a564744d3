"""What is true of a run of the learning lesson: by scipy's rotations, whole distance matrices,
trimesh and plain sums.
"""

import functools
from typing import Any

import numpy as np
import scipy
import trimesh
from scipy.spatial.transform import Rotation

from lessons.learning import flatland

CENTRES = flatland.DISCS[:, :2]
RADII = flatland.DISCS[:, 2]


def wrong_by(state: Any) -> np.ndarray:
    """Degrees between each test rotation and what is put out for it."""
    if state.params.task == "angle":
        put = np.degrees(np.arctan2(state.now.R[:, 1, 0], state.now.R[:, 0, 0]))
        return np.abs((put - state.about.degrees + 180) % 360 - 180)
    true = Rotation.from_rotvec(np.pi * state.about.places)
    return np.degrees((Rotation.from_matrix(state.now.R) * true.inv()).magnitude())


def radii(state: Any) -> np.ndarray:
    """How far the points of a set are from the middle."""
    return np.hypot(state.now.p[:, 0], state.now.p[:, 1])


@functools.lru_cache(maxsize=64)
def _folds(p: bytes, faces: bytes) -> float:
    mesh = trimesh.Trimesh(
        np.frombuffer(p).reshape(-1, 3),
        np.frombuffer(faces, np.int64).reshape(-1, 3),
        process=False,
    )
    return float((mesh.face_adjacency_angles > np.pi / 2).mean())


def folded(state: Any) -> float:
    """The share of edges that are folded by over 90°, by trimesh."""
    return _folds(state.now.p.tobytes(), state.about.faces.tobytes())


def to_given(state: Any) -> float:
    """Chamfer distance of points on the mesh to the given ones, m²: of other points on it than the
    lesson takes.
    """
    mesh = trimesh.Trimesh(state.now.p, state.about.faces, process=False)
    q = trimesh.sample.sample_surface(mesh, 3000, seed=5)[0]
    D = scipy.spatial.distance.cdist(q, state.about.given)
    return float((D.min(axis=1) ** 2).mean() + (D.min(axis=0) ** 2).mean())


def farthest(state: Any) -> float:
    """How far the true surface is from the mesh where it is farthest, m: from the vertices of a
    rabbit, by trimesh; scipy leaves a vertex as soon as a point is nearer than the farthest gap.
    """
    mesh = trimesh.Trimesh(state.now.p, state.about.faces, process=False)
    q = trimesh.sample.sample_surface(mesh, 100_000, seed=5)[0]
    return float(scipy.spatial.distance.directed_hausdorff(state.about.p_true, q)[0])


def named(state: Any, which: str) -> float:
    """The share of test clouds that are named rightly, one by one."""
    clouds = getattr(state.about, which)
    told = [int(np.argmax(state.now.network(cloud[None])[0])) for cloud in clouds]
    return float(np.mean(np.array(told) == state.about.of))


def overlap(state: Any) -> float:
    """Of the nodes that are dense, or in a disc, the share that is both."""
    raw = state.now.field.raw[:, 0]
    dense = 10 * np.log1p(np.exp(raw)) > 5
    x = np.linspace(-1, 1, int(np.sqrt(len(raw))))
    p = np.array([(a, b) for a in x for b in x])
    full = (np.linalg.norm(p[:, None] - CENTRES, axis=2) < RADII).any(axis=1)
    return float((dense & full).sum() / (dense | full).sum())
