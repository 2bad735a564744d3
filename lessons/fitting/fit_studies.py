"""Fits put to the test: the covariance beside repetition, many starts, rival circles over arcs,
rival lines.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from typing import Literal, get_args

import numpy as np
from jaxtyping import Float, Int

from lessons.fitting.round_shapes import CIRCLE, CYLINDER, RoundShape, fit_round
from workbench.algorithms.least_squares import Descent, Descents, covariance, descend_many
from workbench.geometry.shapes.algebraic_fits import ALGEBRAIC, fit_algebraic
from workbench.geometry.shapes.lines_planes import fit_hyperplane, line_angle, regression_line

NINETY = 1.645  # standard deviations to each side that hold 90 % of normal errors
# metres: so near the best fit a start came home, and with such a radius it will not
HOME = 1e-2
AWAY = 50.0
Fate = Literal["comes home", "away or lost", "under way"]
FATES: tuple[Fate, ...] = get_args(Fate)


@dataclass(frozen=True, eq=False, kw_only=True)
class Spread:
    """How far off an answer may be: by its covariance, and by repetition.

    Attributes:
        unknown: The answer.
        covariance: Of a small step from it.
        sigma: The standard deviation of one distance, estimated.
        condition: Of JᵀJ, scaled to a diagonal of ones.
        centers: Of the fits to points measured anew, (k, d).
        radii: Theirs.
    """

    unknown: np.ndarray
    covariance: np.ndarray
    sigma: float
    condition: float
    centers: Float[np.ndarray, "k d"]
    radii: Float[np.ndarray, " k"]

    @property
    def radius(self) -> float:
        """Of the answer."""
        return abs(float(self.unknown[-1]))

    @property
    def radius_deviation(self) -> float:
        """Its standard deviation by the covariance."""
        return float(np.sqrt(self.covariance[-1, -1]))

    @property
    def predicted(self) -> tuple[float, float]:
        """Between which radii the middle 90 % should lie by the covariance."""
        return (
            self.radius - NINETY * self.radius_deviation,
            self.radius + NINETY * self.radius_deviation,
        )

    @property
    def repeated(self) -> tuple[float, float]:
        """Between which they do lie in repetition."""
        low, high = np.percentile(self.radii, [5.0, 95.0])
        return float(low), float(high)

    @property
    def wider(self) -> float:
        """How many times as wide as predicted they lie."""
        (low, high), (predicted_low, predicted_high) = self.repeated, self.predicted
        return (high - low) / (predicted_high - predicted_low)


def repeat_fit(
    shape: RoundShape, end: Descent, p_anew: Float[np.ndarray, "k n d"], *, counts: Sequence[int]
) -> Iterator[Spread]:
    """Yield what the covariance at the end of a descent says, and then fits to points measured
    anew, ever more of them.

    Nothing is yielded where the covariance is not finite.

    Args:
        shape: What was fitted.
        end: Where.
        p_anew: The points, measured again and again.
        counts: How many fits to show.

    Reference: Efron and Tibshirani, An introduction to the bootstrap, 1993, chapter 6 (repetition
    as the measure).
    """
    C = covariance(end.residuals, end.jacobian)
    if not np.isfinite(C).all():
        return
    d = p_anew.shape[-1]
    n, k = end.jacobian.shape
    spread = Spread(
        unknown=end.unknown,
        covariance=C,
        sigma=float(np.sqrt(end.cost / (n - k))),
        condition=float(np.linalg.cond(end.jacobian / np.linalg.norm(end.jacobian, axis=0)) ** 2),
        centers=np.empty((0, d)),
        radii=np.empty(0),
    )
    yield spread
    starts = np.tile(end.unknown, (len(p_anew), 1)) if shape is CYLINDER else fit_algebraic(p_anew)
    fits = fit_round(shape, p_anew, starts)
    for count in counts:
        yield replace(spread, centers=fits[:count, :d], radii=np.abs(fits[:count, -1]))


@dataclass(frozen=True, eq=False)
class Basin:
    """Many starts and what became of them: their unknowns, the best fit, and the descents."""

    starts: Float[np.ndarray, "k m"]
    best: Float[np.ndarray, " m"]
    now: Descents

    @property
    def fates(self) -> Int[np.ndarray, " k"]:
        """What became of each start, as its place in FATES; the sign of a radius does not
        matter.
        """
        unknowns, best = (
            np.column_stack([u[..., :-1], np.abs(u[..., -1])])
            for u in (self.now.unknowns, self.best[None])
        )
        home = (np.abs(unknowns - best) < HOME).all(axis=1)
        return np.where(home, 0, np.where(self.now.done | (unknowns[:, -1] > AWAY), 1, 2))

    def share(self, fate: Fate) -> float:
        """Return the share of the starts that met this fate."""
        return float((self.fates == FATES.index(fate)).mean())


def try_starts(
    p: Float[np.ndarray, "n 2"],
    starts: Float[np.ndarray, "k 3"],
    best: Float[np.ndarray, "3"],
    *,
    damping: float,
    shown: Sequence[int],
) -> Iterator[Basin]:
    """Yield what becomes of descents to a circle from many starts, after some numbers of iterations
    and at the end.

    Args:
        p: The points.
        starts: Circles to start from.
        best: The circle with the least squares.
        damping: As of `descend`; 0 for Gauss-Newton.
        shown: After how many iterations; the last is how many there are at most.

    Reference: as `descend`.
    """
    descents = None
    for descents in descend_many(
        lambda c: CIRCLE.linearise(c, p), np.add, starts, damping=damping, iterations=shown[-1]
    ):
        if descents.iteration in shown:
            yield Basin(starts, best, descents)
    if descents is not None and descents.iteration not in shown:
        yield Basin(starts, best, descents)


@dataclass(frozen=True, eq=False)
class Rivals:
    """Circles fitted to the same points, by name, and their median radii in repetition.

    Attributes:
        circles: Of the points.
        draws: How many sets of points each median is of.
        arcs: Over which they reach, degrees.
        medians: For each arc the median radius of each fit, in their order.
    """

    circles: dict[str, np.ndarray]
    draws: int = 0
    arcs: tuple[float, ...] = ()
    medians: tuple[tuple[float, ...], ...] = ()


def compare_circles(
    p: Float[np.ndarray, "n 2"], drawn: Iterator[tuple[float, Float[np.ndarray, "k n 2"]]]
) -> Iterator[Rivals]:
    """Yield the algebraic fits of points and the geometric one, and then their medians over sets
    drawn for each arc.

    Reference: Al-Sharadqah and Chernov, Error analysis for circle fitting algorithms, 2009.
    """
    circles: dict[str, np.ndarray] = {}
    for kind in ALGEBRAIC:
        circles = circles | {kind: fit_algebraic(p, kind)}
        yield Rivals(circles)
    circles = circles | {"geometric": fit_round(CIRCLE, p[None], fit_algebraic(p)[None])[0]}
    rivals = Rivals(circles)
    yield rivals
    for arc, sets in drawn:
        fits = [fit_algebraic(sets, kind) for kind in ALGEBRAIC] + [
            fit_round(CIRCLE, sets, fit_algebraic(sets))
        ]
        medians = tuple(float(np.median(np.abs(fit[:, 2]))) for fit in fits)
        rivals = replace(
            rivals, draws=len(sets), arcs=(*rivals.arcs, arc), medians=(*rivals.medians, medians)
        )
        yield rivals


@dataclass(frozen=True, eq=False)
class Lines:
    """Lines by the distance that they make small, as (a, b, c), and the angles that repetition
    gives, degrees.
    """

    lines: dict[str, Float[np.ndarray, "3"]] = field(default_factory=dict)
    angles: dict[str, Float[np.ndarray, " k"]] = field(default_factory=dict)


LINE_FITS = {
    "upright": lambda p: regression_line(p, 0),
    "level": lambda p: regression_line(p, 1),
    "perpendicular": fit_hyperplane,
}


def compare_lines(
    p: Float[np.ndarray, "n 2"], p_anew: Float[np.ndarray, "k n 2"]
) -> Iterator[Lines]:
    """Yield lines by upright, level and perpendicular distances, and then their angles for points
    measured anew.

    Reference: Fuller, Measurement error models, 1987, section 1.1 (why regression is too flat).
    """
    fits = Lines()
    yield fits
    for name, fit in LINE_FITS.items():
        fits = replace(fits, lines=fits.lines | {name: fit(p)})
        yield fits
    angles = {
        name: np.array([np.degrees(line_angle(fit(q))) for q in p_anew])
        for name, fit in LINE_FITS.items()
    }
    yield replace(fits, angles=angles)
