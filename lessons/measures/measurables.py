"""Shapes whose area and volume are known in closed form, and Schwarz's lantern. Metres, about 2 m
large, in the middle.
"""

import functools
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Float, Int

from workbench.data.shapes import solids, surfaces

RADIUS, RING, TUBE, APART = 1.0, 1.0, 0.4, 1.0
BOX = (1.8, 1.3, 0.9)


@dataclass(frozen=True, eq=False, kw_only=True)
class Measurable:
    """A mesh, and the smooth shape that it stands for.

    Attributes:
        p: Vertices, m.
        faces: Counterclockwise seen from outside.
        low, high: The corners of the smooth shape's box, m.
        area: Of the smooth shape, m^2.
        volume: Of the smooth shape, m^3; NaN where it encloses nothing.
        inside: Which points the smooth shape encloses; None where it encloses nothing.
    """

    p: Float[np.ndarray, "v 3"]
    faces: Int[np.ndarray, "f 3"]
    low: Float[np.ndarray, "3"]
    high: Float[np.ndarray, "3"]
    area: float
    volume: float
    inside: Callable[[Float[np.ndarray, "n 3"]], Bool[np.ndarray, " n"]] | None


@functools.lru_cache(maxsize=16)
def sphere(subdivisions: int) -> Measurable:
    """Return a ball of radius 1 in an icosahedron whose edges were halved so many times."""
    made = surfaces.sphere(10 * 4**subdivisions + 2, RADIUS)
    corner = np.full(3, RADIUS)
    return Measurable(
        p=made.p,
        faces=made.faces,
        low=-corner,
        high=corner,
        area=4 * np.pi * RADIUS**2,
        volume=4 / 3 * np.pi * RADIUS**3,
        inside=lambda q: np.einsum("nx,nx->n", q, q) < RADIUS**2,
    )


@functools.lru_cache(maxsize=16)
def torus(subdivisions: int) -> Measurable:
    """Return a torus around z, its grid halved so many times."""
    made = surfaces.torus(16 * 4**subdivisions, RING, TUBE)
    corner = np.array([RING + TUBE, RING + TUBE, TUBE])
    return Measurable(
        p=made.p,
        faces=made.faces,
        low=-corner,
        high=corner,
        area=4 * np.pi**2 * RING * TUBE,
        volume=2 * np.pi**2 * RING * TUBE**2,
        inside=lambda q: (np.hypot(q[:, 0], q[:, 1]) - RING) ** 2 + q[:, 2] ** 2 < TUBE**2,
    )


@functools.cache
def box() -> Measurable:
    """Return a box with edges along the axes."""
    made = solids.box(BOX)
    half = np.array(BOX) / 2
    a, b, c = BOX
    return Measurable(
        p=made.p - [0, 0, half[2]],
        faces=made.faces,
        low=-half,
        high=half,
        area=2 * (a * b + b * c + c * a),
        volume=a * b * c,
        inside=lambda q: np.abs(q / half).max(axis=1) < 1,
    )


@functools.lru_cache(maxsize=16)
def two_spheres(subdivisions: int) -> Measurable:
    """Return two meshes of balls of radius 1 that overlap, their middles 1 m apart; area and volume
    are of the union.
    """
    ball = sphere(subdivisions)
    shift = np.array([APART / 2, 0.0, 0.0])
    cap = RADIUS - APART / 2
    lens = np.pi * (4 * RADIUS + APART) * (2 * RADIUS - APART) ** 2 / 12
    within = ball.inside
    assert within is not None
    return Measurable(
        p=np.concatenate([ball.p - shift, ball.p + shift]),
        faces=np.concatenate([ball.faces, ball.faces + len(ball.p)]),
        low=ball.low - shift,
        high=ball.high + shift,
        area=2 * (ball.area - 2 * np.pi * RADIUS * cap),
        volume=2 * ball.volume - lens,
        inside=lambda q: within(q - shift) | within(q + shift),
    )


@functools.lru_cache(maxsize=32)
def lantern(sectors: int, rings: int) -> Measurable:
    """Return Schwarz's lantern: a cylinder without lids, radius and height 1 m, all vertices on it.

    Each ring of vertices is turned by half a sector against the one below, so that the triangles
    between them lean inwards.

    Args:
        sectors: Vertices in a ring.
        rings: Bands of triangles from bottom to top.

    Reference: Schwarz, Gesammelte Mathematische Abhandlungen II, 1890: an area that does not
    follow.
    """
    k, j = np.meshgrid(np.arange(rings + 1), np.arange(sectors), indexing="ij")
    turn = 2 * np.pi * (j + 0.5 * (k % 2)) / sectors
    p = np.stack([RADIUS * np.cos(turn), RADIUS * np.sin(turn), k / rings - 0.5], axis=-1).reshape(
        -1, 3
    )
    k, j = (index[:rings].ravel() for index in (k, j))
    odd = k % 2
    row = k * sectors
    above = (k + 1) * sectors
    after = (j + 1) % sectors
    slip = (j + k % 2) % sectors
    up = np.stack([row + j, row + after, above + slip], axis=1)
    down = np.stack([row + np.where(odd, j, after), above + after, above + j], axis=1)
    corner = np.array([RADIUS, RADIUS, 0.5])
    return Measurable(
        p=p,
        faces=np.concatenate([up, down]),
        low=-corner,
        high=corner,
        area=2 * np.pi * RADIUS,
        volume=float("nan"),
        inside=None,
    )
