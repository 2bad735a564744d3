"""Volume, area and samples by chance: points in a box, lines through space, points on a surface.

Lengths are in metres; `counts` say how many are drawn until each step.

Reference: Pharr, Jakob and Humphreys, Physically Based Rendering, 4th ed., chapter 2 and A.5.1.
Santalo, Integral Geometry and Geometric Probability, 1976, chapter 12.
"""

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Float, Int

from workbench.geometry.points.sampling import (
    Draw,
    ball_share,
    line_crossings,
    lines_through_ball,
    unit_points,
)
from workbench.tracing import traced

MOST_KEPT = 3000  # points and lines of a step that are kept to be shown

ByChance = Callable[[np.ndarray, float], tuple[float, float]]
"""volume_by_chance(inside, box_volume) -> (estimate, standard error), m^3."""
OnFaces = Callable[[np.ndarray, np.ndarray, np.ndarray], np.ndarray]
"""points_on_faces(p, faces, u) -> (n, 3), m."""
Inside = Callable[[np.ndarray], np.ndarray]
"""inside(q) -> (n,) bool: which points lie inside."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Estimates:
    """An estimate after ever more draws: counts, values and standard errors, now and before."""

    counts: tuple[int, ...] = ()
    values: tuple[float, ...] = ()
    errors: tuple[float, ...] = ()

    def more(self, count: int, value: float, error: float) -> "Estimates":
        """Return these and one more."""
        return Estimates(
            counts=(*self.counts, count), values=(*self.values, value), errors=(*self.errors, error)
        )


@dataclass(frozen=True, eq=False, kw_only=True)
class Throws:
    """Points thrown into a box: some of them, which lie inside, how many of all, the estimates."""

    q: Float[np.ndarray, "n 3"]
    inside: Bool[np.ndarray, " n"]
    hits: int
    estimates: Estimates


@traced
def throw_points(
    inside: Inside,
    low: Float[np.ndarray, "3"],
    high: Float[np.ndarray, "3"],
    *,
    counts: Iterable[int],
    draw: Draw,
    rng: np.random.Generator,
    volume_by_chance: ByChance,
) -> Iterator[Throws]:
    """Yield the estimate of a volume after ever more points were thrown into a box.

    Stratified points are thrown anew at each step.
    """
    counts = tuple(counts)
    box_volume = float(np.prod(high - low))
    estimates = Estimates()
    u = unit_points(max(counts), 3, draw, rng=rng)
    hit = np.empty(0, bool)
    for count in counts:
        if draw == "stratified":
            u = unit_points(count, 3, draw, rng=rng)
            hit = np.empty(0, bool)
        q = low + (high - low) * (u if draw == "stratified" else u[:count])
        hit = np.concatenate([hit, inside(q[len(hit) :])])
        volume, error = volume_by_chance(hit, box_volume)
        estimates = estimates.more(len(hit), float(volume), float(error))
        yield Throws(
            q=q[:MOST_KEPT], inside=hit[:MOST_KEPT], hits=int(hit.sum()), estimates=estimates
        )


@dataclass(frozen=True, eq=False, kw_only=True)
class Lines:
    """Lines through a ball.

    Attributes:
        ends: The last of them, as segments.
        crossings: Where those cross the surface.
        total: How many crossings all lines so far have.
        estimates: Of the area.
    """

    ends: Float[np.ndarray, "n 2 3"]
    crossings: Float[np.ndarray, "c 3"]
    total: int
    estimates: Estimates


@traced
def shoot_lines(
    p: Float[np.ndarray, "v 3"],
    faces: Int[np.ndarray, "f 3"],
    ball: tuple[np.ndarray, float],
    *,
    counts: Iterable[int],
    rng: np.random.Generator,
) -> Iterator[Lines]:
    """Yield the estimate of an area from ever more random lines through a ball around the mesh.

    A = 2 pi R^2 times the mean number of crossings (Crofton).
    """
    centre, radius = ball
    met = np.empty(0, int)
    estimates = Estimates()
    for count in counts:
        ends = lines_through_ball(count - len(met), centre, radius, rng=rng)
        line, places = line_crossings(p, faces, ends)
        met = np.concatenate([met, np.bincount(line, minlength=len(ends))])
        area = 2 * np.pi * radius**2 * met
        estimates = estimates.more(count, float(area.mean()), float(area.std() / np.sqrt(count)))
        few = line < MOST_KEPT // 10
        yield Lines(
            ends=ends[: MOST_KEPT // 10],
            crossings=places[few],
            total=int(met.sum()),
            estimates=estimates,
        )


@dataclass(frozen=True, eq=False, kw_only=True)
class Sampled:
    """Points on a surface, and their mean, m."""

    q: Float[np.ndarray, "n 3"]
    mean: Float[np.ndarray, "3"]


@traced
def sample_faces(
    p: Float[np.ndarray, "v 3"],
    faces: Int[np.ndarray, "f 3"],
    counts: Iterable[int],
    *,
    numbers: Callable[[int], np.ndarray],
    points_on_faces: OnFaces,
) -> Iterator[Sampled]:
    """Yield ever more points on a mesh.

    `numbers` gives so many rows of three numbers from 0 to 1, `points_on_faces` a point of each.
    """
    q = np.empty((0, 3))
    for count in counts:
        u = numbers(count - len(q))
        q = np.concatenate([q, points_on_faces(p, faces, u)])
        yield Sampled(q=q, mean=q.mean(axis=0))


@dataclass(frozen=True, eq=False, kw_only=True)
class Balls:
    """A ball in its cube, in ever more dimensions.

    Attributes:
        q: The first three coordinates of some points, 0 where there are only two.
        inside: Which of those lie in the ball.
        throws: How many points are thrown in each dimension.
        dimensions: 2, 3, and so on.
        hits: How many points lay in the ball.
        shares: The share of the cube that the ball fills.
    """

    q: Float[np.ndarray, "n 3"]
    inside: Bool[np.ndarray, " n"]
    throws: int
    dimensions: tuple[int, ...]
    hits: tuple[int, ...]
    shares: tuple[float, ...]


@traced
def raise_dimension(highest: int, throws: int, rng: np.random.Generator) -> Iterator[Balls]:
    """Yield how many points of the cube [-1, 1]^d lie in the ball inside it, from d = 2 on."""
    hits, shares = (), ()
    for d in range(2, highest + 1):
        x = rng.uniform(-1, 1, (throws, d))
        inside = np.einsum("nd,nd->n", x, x) < 1
        hits = (*hits, int(inside.sum()))
        shares = (*shares, ball_share(d))
        q = np.zeros((min(throws, MOST_KEPT), 3))
        q[:, : min(d, 3)] = x[: len(q), :3]
        yield Balls(
            q=q,
            inside=inside[: len(q)],
            throws=throws,
            dimensions=tuple(range(2, d + 1)),
            hits=hits,
            shares=shares,
        )
