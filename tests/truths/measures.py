"""What is true of a run of the measures lesson: by determinants, Heron and trimesh, never by the
lesson's own sums.
"""

from functools import lru_cache

import numpy as np
import trimesh

from lessons.measures.state import State, Subject

CLOSED_FORMS = {  # area, volume
    "the sphere": (4 * np.pi, 4 * np.pi / 3),
    "the torus": (4 * np.pi**2 * 0.4, 2 * np.pi**2 * 0.16),
    "the lantern": (2 * np.pi, np.nan),
    "the pair of spheres": (6 * np.pi, 8 * np.pi / 3 - 5 * np.pi / 12),
    "the box": (2 * (1.8 * 1.3 + 1.3 * 0.9 + 0.9 * 1.8), 1.8 * 1.3 * 0.9),
}


@lru_cache(maxsize=64)
def mesh_of(subject: Subject, whole: bool) -> trimesh.Trimesh:
    return trimesh.Trimesh(subject.p, subject.whole if whole else subject.faces, process=False)


def truth(state: State) -> tuple[float, float]:
    """The area and the volume that count as true."""
    known = CLOSED_FORMS.get(state.subject.name)
    if known is None:
        mesh = mesh_of(state.subject, whole=True)
        known = float(mesh.area), float(mesh.volume)
    return known


def sums(state: State, rows: np.ndarray | slice = slice(None)) -> tuple[float, float]:
    """The area of some faces, and the determinants of their corners seen from the origin, over
    6.
    """
    p = state.subject.p
    faces = state.subject.faces[rows]
    a, b, c = (np.linalg.norm(p[faces[:, k]] - p[faces[:, k - 1]], axis=1) for k in range(3))
    half = (a + b + c) / 2
    heron = np.sqrt(np.maximum(half * (half - a) * (half - b) * (half - c), 0))
    return float(heron.sum()), float(determinants(state)[rows].sum())


def determinants(state: State) -> np.ndarray:
    return np.linalg.det((state.subject.p - np.array(state.params.origin))[state.subject.faces]) / 6


def near_first(state: State, count: int) -> np.ndarray:
    """The faces whose middles are nearest to the origin."""
    middles = state.subject.p[state.subject.faces].sum(axis=1) / 3 - np.array(state.params.origin)
    return np.argsort((middles**2).sum(axis=1), kind="stable")[:count]


def closed(state: State) -> bool:
    mesh = mesh_of(state.subject, whole=False)
    return bool(mesh.is_watertight and mesh.is_winding_consistent)


def walls(bits: np.ndarray, edge: float) -> float:
    """The area between full and empty cells, by comparing each cell with the one beside it."""
    padded = np.pad(bits, 1)
    return edge**2 * sum(int((padded != np.roll(padded, 1, axis)).sum()) for axis in range(3))


def random_hits(state: State, count: int) -> int:
    """How many of the first random throws of a seed hit the sphere."""
    x = 2 * np.random.default_rng(state.params.seed).random((count, 3)) - 1
    return int((np.linalg.norm(x, axis=1) < 1).sum())


def lantern_area(sectors: int, rings: int) -> float:
    """The area of Schwarz's lantern over that of its cylinder, of radius and height 1, in closed
    form.
    """
    lean = 1 - np.cos(np.pi / sectors)
    return 2 * sectors * rings * np.sin(np.pi / sectors) * np.hypot(1 / rings, lean) / (2 * np.pi)
