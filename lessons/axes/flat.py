"""The stage `flat`: points of the rabbit's outline, a line that a hand turns, and their shadow
on it.

It is seen from -y, so that a direction is counterclockwise from 0 at the right: what shall be
nearer to the eye has a negative depth.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from workbench.captions import degrees, metres
from workbench.data.rabbit_outline import along, rabbit_outline
from workbench.geometry.polylines import between, segments
from workbench.geometry.upright import outlined, upright
from workbench.lesson import Look, Params, say
from workbench.scene import Chart, Label, Points, Primitive, Scene, Segments, arc

# points, standard deviations in the bar, metres
POINTS = 60
SIGMAS = 2.0
REACH = 0.78
HAND = np.arange(0.0, 181.0, 3.0)  # degrees: where the hand has been after half a turn
HAND[[24, 54]] = 71.0, 161.0  # the longest shadow and the shortest are among them
FINE = np.arange(0.0, 180.5, 1.0)
CM2 = 1e4  # square centimetres in a square metre
X = (0.0, 180.0)
LABEL = "direction of the line"
VARIANCE = Chart("Variance of the shadow", LABEL, "cm²", x_range=X, x_unit="deg")
BOTH = Chart(
    "Variance and covariance", LABEL, "cm²", x_range=X, x_unit="deg", y_range=(-400.0, 1200.0)
)
DIRECTION, SPREAD = Chart("Direction", unit="deg"), Chart("Standard deviation", unit="m")


@dataclass(frozen=True, eq=False)
class Outline:
    """Points of an outline, metres in the plane of the drawing.

    Attributes:
        p: The points; the stray one is the last.
        line: The outline itself.
        centre: The mean of the points.
        C: Their covariance, m^2.
        has_stray: Whether one of them lies aside.
        longest: The direction of the largest variance, degrees within [0, 180).
        usual: The same without the stray point.
    """

    p: np.ndarray
    line: np.ndarray
    centre: np.ndarray
    C: np.ndarray
    has_stray: bool
    longest: float
    usual: float


@dataclass(frozen=True)
class Held:
    """One direction of the line: degrees, the variance along it and the covariance with across,
    m^2.
    """

    direction: float
    variance: float
    covariance: float


def outline_of(aside: float) -> Outline:
    """Return the points, and one more that lies so many metres behind them where that is not 0."""
    line = rabbit_outline()
    middle = along(line, POINTS).mean(axis=0)
    p = along(line, POINTS) - middle
    usual = longest(_covariance(p))
    if aside > 0:
        p = np.concatenate([p, [[-aside, 0.0]]])
    C = _covariance(p)
    return Outline(p, line - middle, p.mean(axis=0), C, aside > 0, longest(C), usual)


def _covariance(p: np.ndarray) -> np.ndarray:
    away = p - p.mean(axis=0)
    return away.T @ away / len(p)


def longest(C: np.ndarray) -> float:
    """Return the direction of the largest variance, degrees within [0, 180)."""
    return float(np.degrees(0.5 * np.arctan2(2 * C[0, 1], C[0, 0] - C[1, 1])) % 180.0)


def held(C: np.ndarray, direction: np.ndarray | float) -> tuple[np.ndarray, np.ndarray]:
    """Return the variance along directions, degrees, and the covariance of along and across,
    m^2.
    """
    a = np.radians(direction)
    u = np.stack([np.cos(a), np.sin(a)])
    v = np.stack([-np.sin(a), np.cos(a)])
    return np.einsum("i...,ij,j...->...", u, C, u), np.einsum("i...,ij,j...->...", u, C, v)


def hand(outline: Outline) -> Iterator[Held]:
    """Yield the directions of half a turn, one after the other."""
    for direction in HAND:
        yield Held(float(direction), *map(float, held(outline.C, float(direction))))


def draw(look: Look[Params, Outline, Held]) -> Scene:
    """Return the points, the line, their shadow on it, and the variance over the direction."""
    outline, state = look.subject, look.now
    a = np.radians(state.direction)
    u = np.array([np.cos(a), np.sin(a)])
    across = np.array([-np.sin(a), np.cos(a)])
    m = outline.centre
    sd = float(np.sqrt(state.variance))
    shadow = m + np.outer((outline.p - m) @ u, u)
    ends = np.stack([m - SIGMAS * sd * u, m + SIGMAS * sd * u])
    reach = max(REACH, 1.1 * float(np.abs((outline.p - m) @ u).max()))
    scene: dict[str, Primitive] = {
        "outline": Segments(outlined(outline.line, 0.01), "target", 2.0, opacity=0.6),
        "points": Points(upright(outline.p[:POINTS]), "target", 0.012, name="60 points"),
        "line": Segments(
            segments(upright(np.stack([m - reach * u, m + reach * u]), -0.002)), "neutral", 2.0
        ),
        "rays": Segments(
            between(upright(outline.p, -0.001), upright(shadow, -0.001)), "correspondence", 1.0
        ),
        "shadow": Points(upright(shadow, -0.012), "source", 0.01, name="their shadow"),
        "bar": Segments(
            segments(upright(ends, -0.006)), "source", 6.0, name="2 standard deviations each way"
        ),
        "caption": say(
            "At {direction} the standard deviation of the shadow is {sd}.",
            direction=degrees(state.direction),
            sd=metres(sd),
        ),
        "direction": DIRECTION.scalar(state.direction, "direction"),
        "sd": SPREAD.scalar(sd, "standard deviation"),
    }
    zero = np.stack([m, m + 0.5 * REACH * np.array([1.0, 0.0])])
    scene["zero/line"] = Segments(segments(upright(zero, -0.001)), "neutral", 1.0, opacity=0.6)
    scene["zero/name"] = Label("0°", upright(zero[1:] + np.array([0.05, 0.0]))[0], "neutral")
    if state.direction > 0:
        at = {"about": np.array([0.0, -1.0, 0.0]), "radius": 0.4 * REACH, "width": 2.0}
        along_x = np.array([1.0, 0.0, 0.0])
        scene |= arc("turned", upright(m[None], -0.005)[0], along_x, state.direction, **at)
    reached = 1.5 * SIGMAS * np.sqrt(float(held(outline.C, state.direction + 90.0)[0]))
    fences = np.stack([ends - reached * across, ends + reached * across], axis=1)
    scene["ellipse/line"] = Segments(
        segments(upright(_ellipse(outline), -0.004)), "highlight", 3.0, name="ellipse of 2 sd"
    )
    scene["ellipse/fences"] = Segments(
        np.stack([upright(fence, -0.003) for fence in fences]), "highlight", 1.5, opacity=0.6
    )
    if outline.has_stray:
        scene |= _stray(outline)
    return scene | _charts(outline, state)


def _ellipse(outline: Outline) -> np.ndarray:
    w, V = np.linalg.eigh(outline.C)
    t = np.radians(np.arange(0.0, 361.0, 4.0))
    return outline.centre + SIGMAS * np.column_stack([np.cos(t), np.sin(t)]) * np.sqrt(w) @ V.T


def _stray(outline: Outline) -> dict[str, Primitive]:
    m = outline.centre
    a = np.radians(outline.usual)
    usual = np.array([np.cos(a), np.sin(a)])
    turned = (outline.longest - outline.usual + 90.0) % 180.0 - 90.0
    ends = np.stack([m - REACH * usual, m + REACH * usual])
    at = {"about": np.array([0.0, -1.0, 0.0]), "radius": 0.6, "color": "wrong"}
    return {
        "stray": Points(upright(outline.p[POINTS:]), "wrong", 0.025, name="one stray point"),
        "usual": Segments(
            segments(upright(ends, -0.003)), "truth", 3.0, name="axis 1 without the stray point"
        ),
        **arc("moved", upright(m[None], -0.008)[0], upright(usual[None])[0], turned, **at),
    }


def _charts(outline: Outline, state: Held) -> dict[str, Primitive]:
    variance, covariance = (CM2 * values for values in held(outline.C, FINE))
    x = state.direction
    y = CM2 * state.variance
    c = CM2 * state.covariance
    return {
        "variance/curve": VARIANCE.whole(FINE, variance, "variance", "source"),
        "variance/mark": VARIANCE.mark(x, y, "your hand", "source", steps="direction"),
        "both/variance": BOTH.whole(FINE, variance, "variance", "source"),
        "both/covariance": BOTH.whole(FINE, covariance, "covariance", "target"),
        "both/zero": BOTH.second(FINE, 0.0 * FINE, "zero", "neutral"),
        "both/mark": BOTH.mark(x, y, "variance", "source", steps="direction"),
        "both/second mark": BOTH.mark(x, c, "covariance mark", "target"),
    }
