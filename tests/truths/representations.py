"""What is true of a run of the representations lesson: distances by nearest points, sizes by
trimesh.
"""

from functools import lru_cache

import numpy as np
import scipy
import trimesh
from scipy.spatial.transform import Rotation

from lessons.representations.state import Params, State, Surface
from workbench.data.shapes.rabbit import rabbit_mesh
from workbench.geometry.points.sampling import points_on_faces, unit_points

HALVES = {"box": (0.5, 0.35, 0.25), "two boxes": (0.6, 0.3, 0.3)}


def shape_of(params: Params) -> str:
    return "torus" if params.form == "patches" else params.shape


def half_size(params: Params) -> np.ndarray:
    thick = params.thickness / params.resolution
    return np.array(HALVES.get(params.shape, (0.6, 0.6, thick)))


def distance(params: Params, q: np.ndarray) -> np.ndarray:
    """How far points are from the true surface, negative inside; of the rabbit without a sign."""
    if shape_of(params) == "torus":
        # from the axis any way is as far
        along = np.where(q[:, :2].any(axis=1, keepdims=True), q[:, :2], [1.0, 0.0])
        on_ring = 0.6 * along / np.linalg.norm(along, axis=1, keepdims=True)
        return np.linalg.norm(q - np.column_stack([on_ring, np.zeros(len(q))]), axis=1) - 0.25
    if params.shape == "rabbit":
        triangles, tree, of = dense_rabbit()
        near = of[np.asarray(tree.query(q, 6)[1])]
        closest = trimesh.triangles.closest_point(
            triangles[near.ravel()], np.repeat(q, 6, axis=0)
        ).reshape(-1, 6, 3)
        return np.linalg.norm(closest - q[:, None], axis=2).min(axis=1)
    half = half_size(params)
    if params.shape == "plate":
        turn = 1.5 * np.random.default_rng(params.seed).normal(size=3)
        q = Rotation.from_rotvec(turn).inv().apply(q)
    near = np.clip(q, -half, half)
    depth = np.minimum(half - q, half + q).min(axis=1)
    return np.where(depth > 0, -depth, np.linalg.norm(q - near, axis=1))


@lru_cache(maxsize=1)
def dense_rabbit() -> tuple[np.ndarray, scipy.spatial.cKDTree, np.ndarray]:
    """Its triangles, points spread over them, and on which triangle each lies."""
    p, faces = rabbit_mesh(0.04)
    p = 1.6 * (p - (p.min(axis=0) + p.max(axis=0)) / 2)
    samples = trimesh.sample.sample_surface(
        trimesh.Trimesh(p, faces, process=False), 300_000, seed=9
    )
    return p[faces], scipy.spatial.cKDTree(samples[0]), np.asarray(samples[1])


def sizes(params: Params) -> tuple[float, float]:
    """The area and the volume of the true shape."""
    if shape_of(params) == "torus":
        return 4 * np.pi**2 * 0.15, 2 * np.pi**2 * 0.6 * 0.25**2
    if params.shape == "rabbit":
        p, faces = rabbit_mesh(0.04)
        mesh = trimesh.Trimesh(1.6 * p, faces, process=False)
        return float(mesh.area), float(mesh.volume)
    a, b, c = 2 * half_size(params)
    return 2 * (a * b + b * c + c * a), a * b * c


def errors(state: State) -> tuple[float, float]:
    """How far the surface that came back is from the true one, on average and at worst."""
    surface = surface_of(state)
    if state.params.form == "patches":
        q = surface.p
    else:
        q = points_on_faces(
            surface.p, surface.faces, unit_points(2048, 3, "Sobol", rng=np.random.default_rng(0))
        )
    away = np.abs(distance(state.params, q))
    return float(away.mean()), float(away.max())


def surface_of(state: State) -> Surface:
    assert state.surface is not None
    return state.surface


@lru_cache(maxsize=64)
def mesh_of(surface: Surface) -> trimesh.Trimesh:
    return trimesh.Trimesh(surface.p, surface.faces, process=False)
