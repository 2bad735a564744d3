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
_SCALES = np.array([min(radii) for _, radii, _ in _RABBIT])[:, None]  # metres, of the unit balls
_TO_BALLS = np.vstack(  # rows 3 i to 3 i + 2 take blob i, once about its centre, to the unit ball
    [(exp_so3(np.array(turn)) / radii).T for _, radii, turn in _RABBIT]
)
_MIDDLES = np.concatenate(  # where they take the centres
    [(exp_so3(np.array(turn)) / radii).T @ centre for centre, radii, turn in _RABBIT]
)
_BLEND = 60.0  # 1/m: how sharply the blobs meet
_LOW, _HIGH = np.array([-0.55, -0.40, -0.43]), np.array([0.55, 0.40, 0.82])  # a box around them
_ROUNDS = 5  # of moving vertices towards the middle of their neighbours


def rabbit(count: int, rng: np.random.Generator) -> Cloud:
    """Return points on the rabbit.

    The points of each ellipsoid that lie inside another are left out, and the rest is projected
    onto the surface where the smooth minimum of all ellipsoid distances is zero.
    """
    areas = np.array([_mean_product(radii) for _, radii, _ in _RABBIT])
    pieces = []
    for i, (centre, radii, turn) in enumerate(_RABBIT):
        p = _ellipsoid(int(3 * count * areas[i] / areas.sum()) + 8, np.array(radii), rng)
        p = p @ exp_so3(np.array(turn)).T + np.array(centre)
        others = np.delete(_lengths(_in_balls(p)), i, axis=0)
        pieces.append(p[(others > 1.0).all(axis=0)])
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
    p, faces = level_surface(rabbit_field(grid.centres())[0].reshape(grid.shape), grid)
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
    q = _in_balls(p)
    norms = _lengths(q)
    values = _SCALES * (norms - 1.0)  # roughly the signed distances to the ellipsoids
    least = values.min(axis=0)
    weights = np.exp(-_BLEND * (values - least))
    total = weights.sum(axis=0)
    pulls = (weights / total * _SCALES / norms)[:, None] * q
    return least - np.log(total) / _BLEND, pulls.reshape(len(_TO_BALLS), -1).T @ _TO_BALLS


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


def _in_balls(p: Cloud) -> Float[np.ndarray, "b 3 n"]:
    """Return where points are once each blob is the unit ball: one product for all blobs."""
    return (_TO_BALLS @ p.T - _MIDDLES[:, None]).reshape(len(_RABBIT), 3, -1)


def _lengths(q: Float[np.ndarray, "b 3 n"]) -> Float[np.ndarray, "b n"]:
    return np.maximum(np.sqrt(np.square(q).sum(axis=1)), 1e-9)


def _mean_product(radii: tuple[float, float, float]) -> float:
    """Return a number in proportion to an ellipsoid's area, roughly (Thomsen)."""
    a, b, c = radii
    return (((a * b) ** 1.6 + (a * c) ** 1.6 + (b * c) ** 1.6) / 3) ** (1 / 1.6)
