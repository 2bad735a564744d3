"""A rabbit of blended ellipsoids, the course's shape without any symmetry.

Lengths in metres, +Z up, nose towards +X; about 0.9 by 0.6 by 1.0 m.
"""

from functools import lru_cache

import numpy as np
from jaxtyping import Float, Int

from workbench.geometry.fields.voxels import Grid
from workbench.geometry.level_sets import level_surface
from workbench.geometry.meshes import adjacency
from workbench.geometry.motions import exp_so3

Cloud = Float[np.ndarray, "n 3"]

# centre, radii, rotation vector (radians)
_RABBIT = (
    ((0.0, 0.0, -0.05), (0.36, 0.25, 0.27), (0.0, -0.25, 0.0)),  # body
    ((0.27, 0.02, 0.24), (0.18, 0.14, 0.15), (0.0, 0.3, 0.0)),  # head
    ((0.20, 0.09, 0.50), (0.05, 0.075, 0.23), (-0.2, -0.25, 0.1)),  # left ear, upright
    ((0.10, -0.10, 0.42), (0.05, 0.075, 0.21), (0.45, -0.9, 0.0)),  # right ear, lying back
    ((-0.36, 0.03, -0.02), (0.09, 0.09, 0.09), (0.0, 0.0, 0.0)),  # tail
    ((0.25, 0.12, -0.24), (0.15, 0.065, 0.06), (0.0, 0.1, 0.15)),  # left front paw
    ((0.21, -0.14, -0.25), (0.12, 0.065, 0.06), (0.0, 0.1, -0.3)),  # right front paw
    ((-0.10, -0.21, -0.22), (0.19, 0.08, 0.09), (0.0, 0.0, -0.2)),  # right hind foot
    ((-0.14, 0.20, -0.19), (0.17, 0.08, 0.12), (0.0, 0.0, 0.3)),  # left hind foot
)
_CENTRES, _RADII = (np.array([blob[k] for blob in _RABBIT]) for k in (0, 1))
_TURNS = np.stack([exp_so3(np.array(turn)) for _, _, turn in _RABBIT])
_AXES = (_TURNS.swapaxes(1, 2) / _RADII[:, :, None]).reshape(-1, 3)  # of each, over its radii
_MIDDLES = np.sum(_AXES * np.repeat(_CENTRES, 3, axis=0), axis=1)[:, None]  # along those axes
_LEAST = _RADII.min(axis=1)[:, None]
_BLEND = 60.0  # 1/m: how sharply the blobs meet
# a box around them
_LOW = np.array([-0.55, -0.40, -0.43])
_HIGH = np.array([0.55, 0.40, 0.82])
_ROUNDS = 5  # of moving vertices towards the middle of their neighbours


def rabbit(count: int, rng: np.random.Generator) -> Cloud:
    """Return points on the rabbit.

    The points of each ellipsoid that lie inside another are left out, and the rest is projected
    onto the surface where the smooth minimum of all ellipsoid distances is zero.
    """
    areas = np.array([_mean_product(radii) for _, radii, _ in _RABBIT])
    pieces = []
    for i, area in enumerate(areas):
        p = _ellipsoid(int(3 * count * area / areas.sum()) + 8, _RADII[i], rng)
        p = p @ _TURNS[i].T + _CENTRES[i]
        to_others = np.delete(_in_balls(p)[1], i, axis=0)
        pieces.append(p[to_others.min(axis=0) > 1])
    p = np.concatenate(pieces)
    return _onto_surface(p[rng.choice(len(p), count, replace=len(p) < count)])


@lru_cache(maxsize=4)
def rabbit_mesh(spacing: float = 0.03) -> tuple[Float[np.ndarray, "v 3"], Int[np.ndarray, "f 3"]]:
    """Return the rabbit as a closed mesh without holes or handles; read-only, always the same.

    Its field is marched on a grid; then vertices move along the surface towards the middle of their
    neighbours, which rounds off the slivers of marching cubes, and back onto it. A spacing of 0.03
    m gives 2,844 vertices, 0.05 gives 994, 0.015 gives 11,460.

    Raises:
        ValueError: If the grid is too coarse for the ears (over 0.05 m), or finer than 0.01 m.
    """
    if not 0.01 <= spacing <= 0.05:
        raise ValueError(f"a grid of {spacing:g} m; the rabbit's mesh takes 0.01 to 0.05 m")
    x, y, z = (int(n) for n in np.ceil((_HIGH - _LOW) / spacing) + 1)
    grid = Grid(_LOW - spacing / 2, np.full(3, spacing), (x, y, z))
    layers = grid.centres().reshape(x, y * z, 3)  # what one needs stays near the processor
    field = np.stack([_smooth_minimum(_in_balls(layer)[1])[0] for layer in layers])
    p, faces = level_surface(field.reshape(grid.shape), grid)
    p = _onto_surface(p)
    beside = adjacency(faces, len(p))
    degrees = beside.sum(axis=1)[:, None]
    for _ in range(_ROUNDS):
        p = _onto_surface(p + 0.5 * (beside @ p / degrees - p), 2)
    p = _onto_surface(p)
    p.flags.writeable = faces.flags.writeable = False
    return p, faces


def rabbit_field(p: Cloud) -> tuple[Float[np.ndarray, " n"], Float[np.ndarray, "n 3"]]:
    """Return the smooth minimum of the blobs' distances, negative inside, and its gradient.

    It is no distance: its gradient is 0.57 to 0.97 long in the box around the rabbit.
    """
    q, norm = _in_balls(p)
    values, shares = _smooth_minimum(norm)
    by_q = (_LEAST * shares / norm)[:, None] * q
    return values, by_q.reshape(-1, len(p)).T @ _AXES


def _smooth_minimum(norm: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the field, and how much each blob counts in it, from `norm` of `_in_balls`."""
    distances = _LEAST * (norm - 1.0)
    least = distances.min(axis=0)
    weights = np.exp(-_BLEND * (distances - least))
    total = weights.sum(axis=0)
    return least - np.log(total) / _BLEND, weights / total


def _in_balls(p: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the points where each ellipsoid is made the unit ball, (b, 3, n), and how far they are
    from its middle there, over 1 outside.
    """
    q = (_AXES @ p.T - _MIDDLES).reshape(len(_RABBIT), 3, -1)
    return q, np.maximum(np.sqrt(np.einsum("bxn,bxn->bn", q, q)), 1e-9)


def _onto_surface(p: np.ndarray, steps: int = 4) -> np.ndarray:
    """Return the points moved onto the rabbit by Newton steps along the gradient."""
    for _ in range(steps):
        value, gradient = rabbit_field(p)
        p = p - (value / np.einsum("ij,ij->i", gradient, gradient))[:, None] * gradient
    return p


def _ellipsoid(count: int, radii: np.ndarray, rng: np.random.Generator) -> np.ndarray:
    """Return about half of `count` points, uniform on an ellipsoid by their area."""
    u = rng.standard_normal((count, 3))
    u /= np.linalg.norm(u, axis=1, keepdims=True)
    stretch = np.linalg.norm(u / radii, axis=1) * radii.min()
    return (u * radii)[rng.random(count) < stretch]


def _mean_product(radii: tuple[float, float, float]) -> float:
    """Return a number in proportion to an ellipsoid's area, roughly (Thomsen)."""
    a, b, c = radii
    return (((a * b) ** 1.6 + (a * c) ** 1.6 + (b * c) ** 1.6) / 3) ** (1 / 1.6)
