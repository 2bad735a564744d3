"""Small scenes of textured boards and balls, and the rays that see them, every depth exact.

Everything is in the frame of the left camera (OpenCV: +X right, +Y down, +Z forward), metres. A ray
direction v has Z = 1, so that the distance along it is the depth; rays start at p_eye.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np
import scipy
from jaxtyping import Float

Paint = Callable[[np.ndarray, np.ndarray], np.ndarray]
"""paint(s, t) -> brightness 0 .. 1 of the surface point (s, t), in metres along it."""

COLORS = np.array(
    [
        (214, 206, 190),
        (196, 160, 120),
        (110, 150, 190),
        (190, 110, 96),
        (130, 170, 120),
        (180, 140, 180),
    ]
)


@dataclass(frozen=True, eq=False)
class Board:
    """A flat rectangle: a corner and its two perpendicular sides."""

    p_corner: tuple[float, float, float]
    v_right: tuple[float, float, float]
    v_down: tuple[float, float, float]
    paint: Paint
    color: int = 0

    def depth(self, p_eye: np.ndarray, v: np.ndarray) -> np.ndarray:
        """Return per ray the depth of the hit, or infinity."""
        corner, right, down = self._edges()
        normal = np.cross(right, down)
        with np.errstate(divide="ignore", invalid="ignore"):
            depth = ((corner - p_eye) @ normal) / (v @ normal)
            s, t = self._shares(p_eye, v, depth)
            on = (depth > 0) & (s >= 0) & (s <= 1) & (t >= 0) & (t <= 1)
        return np.where(on, depth, np.inf)

    def place(
        self, p_eye: np.ndarray, v: np.ndarray, depth: np.ndarray
    ) -> tuple[np.ndarray, np.ndarray]:
        """Return the surface points (s, t) where rays hit it."""
        _, right, down = self._edges()
        s, t = self._shares(p_eye, v, depth)
        return s * np.linalg.norm(right), t * np.linalg.norm(down)

    def _edges(self) -> tuple[np.ndarray, ...]:
        return tuple(np.array(a, float) for a in (self.p_corner, self.v_right, self.v_down))

    def _shares(self, p_eye: np.ndarray, v: np.ndarray, depth: np.ndarray) -> list[np.ndarray]:
        """Return how far along both sides the rays are at a depth, in shares of them.

        Most sides lie along an axis: of the others nothing is needed.
        """
        corner, *sides = self._edges()
        return [
            sum((p_eye[k] + depth * v[..., k] - corner[k]) * a[k] for k in np.flatnonzero(a))
            / (a @ a)
            for a in sides
        ]


@dataclass(frozen=True, eq=False)
class Ball:
    """A sphere; its paint is laid on by longitude and height, as on a label around it."""

    p_center: tuple[float, float, float]
    radius: float
    paint: Paint
    color: int = 0

    def depth(self, p_eye: np.ndarray, v: np.ndarray) -> np.ndarray:
        """Return per ray the depth of the nearer hit, or infinity."""
        to_center = np.array(self.p_center, float) - p_eye
        a = np.einsum("...i,...i->...", v, v)
        b = v @ to_center
        root = b * b - a * (to_center @ to_center - self.radius**2)
        depth = np.where(root > 0, (b - np.sqrt(np.maximum(root, 0.0))) / a, np.inf)
        return np.where(depth > 0, depth, np.inf)

    def place(
        self, p_eye: np.ndarray, v: np.ndarray, depth: np.ndarray
    ) -> tuple[np.ndarray, np.ndarray]:
        """Return the surface points (s, t) where rays hit it."""
        to_center = np.array(self.p_center, float) - p_eye
        x, y, z = np.moveaxis(depth[..., None] * v - to_center, -1, 0)
        return self.radius * np.arctan2(x, -z), y + self.radius


@dataclass(frozen=True, eq=False)
class Sky:
    """What is infinitely far: seen in the same direction by both cameras."""

    paint: Paint
    color: int = 0

    def depth(self, p_eye: np.ndarray, v: np.ndarray) -> np.ndarray:
        """Return infinity for every ray."""
        return np.full(v.shape[:-1], np.inf)

    def place(
        self, p_eye: np.ndarray, v: np.ndarray, depth: np.ndarray
    ) -> tuple[np.ndarray, np.ndarray]:
        """Return the slopes of the rays as the surface point."""
        return v[..., 0] + 4.0, v[..., 1] + 4.0


Thing = Board | Ball | Sky


def look(
    things: tuple[Thing, ...], p_eye: np.ndarray, v: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Return per ray the depth of the nearest thing (infinity: sky) and its colour, 0 .. 255.

    The first thing is seen where no other is hit.
    """
    depths = [thing.depth(p_eye, v) for thing in things]
    seen = np.argmin(depths, axis=0)
    depth = np.minimum.reduce(depths)
    color = np.zeros(v.shape)
    for k, thing in enumerate(things):
        here = seen == k
        s, t = thing.place(p_eye, v[here], depth[here])
        color[here] = thing.paint(s, t)[:, None] * COLORS[thing.color]
    return depth, color


def nearest_depth(things: tuple[Thing, ...], p_eye: np.ndarray, v: np.ndarray) -> np.ndarray:
    """Return per ray the depth of the nearest thing, as `look` does without a look at colours."""
    return np.minimum.reduce([thing.depth(p_eye, v) for thing in things])


def speckle(rng: np.random.Generator, grain: float, contrast: float = 1.0) -> Paint:
    """Return a paint of random blots, `grain` and four times `grain` metres wide."""
    fine, coarse = rng.random((128, 128)), rng.random((128, 128))

    def paint(s: np.ndarray, t: np.ndarray) -> np.ndarray:
        blots = 0.55 * _between(fine, s / grain, t / grain) + 0.25 * _between(
            coarse, s / grain / 4, t / grain / 4
        )
        return 0.6 + contrast * (blots - 0.4)

    return paint


def stripes(period: float) -> Paint:
    """Return a paint of upright stripes that repeat every `period` metres."""
    return lambda s, t: 0.55 + 0.35 * np.sin(2 * np.pi * s / period)


def plain(brightness: float = 0.75) -> Paint:
    """Return a paint without any texture."""
    return lambda s, t: np.full(s.shape, brightness)


def _between(lattice: Float[np.ndarray, "n n"], s: np.ndarray, t: np.ndarray) -> np.ndarray:
    """Return lattice values interpolated linearly, the lattice repeated."""
    return scipy.ndimage.map_coordinates(lattice, [t, s], order=1, mode="grid-wrap")


def _wall(depth: float, paint: Paint, color: int = 0) -> Board:
    return Board(
        (-4 * depth, -4 * depth, depth), (8 * depth, 0, 0), (0, 8 * depth, 0), paint, color
    )


def planes(rng: np.random.Generator, pixel: float) -> tuple[Thing, ...]:
    """Return a wall that recedes to the right, a floor and a tilted board."""
    wall = Board((-3.0, -3.0, 1.3), (6.0, 0, 1.8), (0, 6.0, 0), speckle(rng, 5 * pixel))
    floor = Board((-3.0, 0.45, 0.5), (6.0, 0, 0), (0, 0, 4.0), speckle(rng, 4 * pixel), 1)
    board = Board(
        (-0.25, -0.35, 1.35), (0.55, 0.05, -0.25), (0.0, 0.6, 0.12), speckle(rng, 3 * pixel), 2
    )
    return wall, floor, board


def spheres(rng: np.random.Generator, pixel: float) -> tuple[Thing, ...]:
    """Return three balls above a floor, before a wall of half their contrast."""
    wall = _wall(2.6, speckle(rng, 7 * pixel, 0.5))
    floor = Board((-3.0, 0.5, 0.5), (6.0, 0, 0), (0, 0, 4.0), speckle(rng, 4 * pixel), 1)
    near = Ball((-0.28, 0.17, 1.25), 0.3, speckle(rng, 3 * pixel), 2)
    far = Ball((0.42, -0.08, 1.75), 0.32, speckle(rng, 4 * pixel), 3)
    small = Ball((0.2, 0.3, 1.15), 0.13, speckle(rng, 3 * pixel), 4)
    return wall, floor, near, far, small


def posts(rng: np.random.Generator, pixel: float) -> tuple[Thing, ...]:
    """Return three near posts before a far wall: each hides a strip of it from one camera."""
    wall = _wall(3.0, speckle(rng, 8 * pixel))
    upright = [
        Board((x, -1.0, 1.1), (0.14, 0, 0), (0, 2.0, 0), speckle(rng, 3 * pixel), color)
        for x, color in ((-0.32, 2), (-0.02, 3), (0.26, 4))
    ]
    return wall, *upright


def plain_wall(rng: np.random.Generator, pixel: float) -> tuple[Thing, ...]:
    """Return a textured wall with a large plain part, and a ball before it."""
    wall = _wall(2.0, speckle(rng, 6 * pixel))
    bare = Board((-0.6, -0.45, 1.99), (0.75, 0, 0), (0, 0.9, 0), plain(), 0)
    return wall, bare, Ball((0.42, 0.12, 1.3), 0.22, speckle(rng, 3 * pixel), 3)


def repeated(rng: np.random.Generator, pixel: float) -> tuple[Thing, ...]:
    """Return a wall whose middle is a pattern that repeats every six pixels."""
    wall = _wall(2.0, speckle(rng, 6 * pixel))
    pattern = Board((-0.5, -0.4, 1.99), (0.96, 0, 0), (0, 0.8, 0), stripes(6 * 1.99 * pixel), 0)
    return wall, pattern


def boards(rng: np.random.Generator, pixel: float) -> tuple[Thing, ...]:
    """Return boards at 1, 5 and 20 m before the sky, none hides another at f = 640 px."""
    flat = [
        Board(
            (x * z, y * z, z),
            (side * z, 0, 0),
            (0, 0.06 * z, 0),
            speckle(rng, 2.5 * pixel * z),
            color,
        )
        for z, x, y, side, color in (
            (1.0, 0.02, 0.012, 0.085, 2),
            (5.0, -0.08, -0.07, 0.08, 3),
            (20.0, 0.015, -0.07, 0.08, 4),
        )
    ]
    return Sky(speckle(rng, 2.5 * pixel)), *flat


SCENES: Mapping[str, Callable[[np.random.Generator, float], tuple[Thing, ...]]] = {
    "planes": planes,
    "spheres": spheres,
    "posts": posts,
    "plain wall": plain_wall,
    "repeated pattern": repeated,
    "boards at three depths": boards,
}
"""Scenes by name; each is made from `rng` and the width of a pixel at 1 m, so that its texture is
as fine as the picture.
"""


def rays(
    u: Float[np.ndarray, "*n"], v: Float[np.ndarray, "*n"], f: float, *, cx: float, cy: float
) -> np.ndarray:
    """Return the directions (..., 3), Z = 1, of the rays of pixels (u, v)."""
    return np.stack([(u - cx) / f, (v - cy) / f, np.ones_like(u)], axis=-1)
