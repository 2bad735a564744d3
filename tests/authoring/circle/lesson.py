"""A circle through points that are not quite on it: the quick fit is too small on a short arc."""

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import NamedTuple

import numpy as np

from workbench.captions import metres, say
from workbench.geometry import polylines
from workbench.geometry.points.metrics import rms
from workbench.lesson import Choice, Lesson, Look, Params, Preset, Question, View, cached, knob
from workbench.scene import Chart, Points, Scene, circle
from workbench.tracing import traced

from .exercises.circle_distances import circle_distances

TRUE, UP = np.array([0.4, 0.3, 1.0]), np.array([0.0, 0.0, 1.0])  # the true circle x, y, r, metres
RADII = np.linspace(0.3, 2.0, 69)
COST = Chart("Distance", "radius", "m", x_range=(0.3, 2.0), x_unit="m")
RADIUS = Chart("Radius", unit="m")


class Input(Params):
    by_hand: bool = knob(False, "Each radius in turn, in place of the fit")
    points: int = knob(40, "How many points are measured", 5, 200)
    arc: float = knob(60.0, "How much of the circle they cover", 20, 360, unit="deg", step=5)
    noise: float = knob(0.03, "Standard deviation of x and of y", 0, 0.1, unit="m")
    seed: int = knob(0, "Which noise is drawn", 0, 99)


class Arc(NamedTuple):
    """Points (n, 2), the best circle (m, 3) of each radius, and its RMS distance (m,), metres."""

    p: np.ndarray
    circles: np.ndarray
    rms: np.ndarray


@cached
def setup(params: Input) -> Arc:
    """Return measured points, and how well each radius can fit them."""
    angles = np.radians(params.arc) * (np.arange(params.points) / params.points - 0.5)
    p = TRUE[:2] + TRUE[2] * np.column_stack([np.cos(angles), np.sin(angles)])
    p = p + params.noise * np.random.default_rng(params.seed).standard_normal(p.shape)
    starts = [np.array([TRUE[0] + TRUE[2] - radius, TRUE[1], radius]) for radius in RADII]
    circles = np.array([list(refine(p, start, circle_distances, free=2))[-1] for start in starts])
    return Arc(p, circles, np.array([rms(circle_distances(p, xyr)) for xyr in circles]))


@traced
def refine(p: np.ndarray, xyr: np.ndarray, apart: Callable, *, free: int) -> Iterator[np.ndarray]:
    """Yield a circle, and circles ever nearer to the points: Gauss-Newton in x, y and maybe r."""
    for _ in range(40):
        yield xyr
        away = (xyr[:2] - p) / np.linalg.norm(xyr[:2] - p, axis=1)[:, None]
        J = np.column_stack([away, -np.ones(len(p))])[:, :free]
        step = np.linalg.lstsq(J, -apart(p, xyr), rcond=None)[0]
        xyr = xyr + np.pad(step, (0, 3 - free))
        if np.abs(step).max() < 1e-4:
            return


def run(params: Input, arc: Arc, *, circle_distances=circle_distances) -> Iterator[np.ndarray]:
    """Yield the quick circle and its refinements, or the best circle of each radius."""
    A = np.column_stack([2 * arc.p, np.ones(len(arc.p))])
    a, b, c = np.linalg.lstsq(A, (arc.p**2).sum(axis=1), rcond=None)[0]
    quick = np.array([a, b, np.sqrt(c + a**2 + b**2)])
    yield from arc.circles if params.by_hand else refine(arc.p, quick, circle_distances, free=3)


def draw(look: Look[Input, Arc, np.ndarray]) -> Scene:
    arc, now = look.subject, look.now
    off = rms(circle_distances(arc.p, now))
    return {
        "points": Points(polylines.at_height(arc.p), "target", 0.015, name="measured points"),
        "truth": circle(polylines.at_height(TRUE[:2]), UP, TRUE[2], "truth", name="true circle"),
        "circle": circle(polylines.at_height(now[:2]), UP, now[2], "source", name="this circle"),
        "radius": RADIUS.scalar(float(now[2]), "radius"),
        "error": RADIUS.scalar(abs(float(now[2] - TRUE[2])), "error", "truth"),
        "cost": COST.whole(RADII, arc.rms, "best circle of each radius"),
        "cost/now": COST.mark(now[2], off, "this circle", steps="radius"),
        "caption": say("Radius {r}, points {off} off (RMS).", r=metres(now[2]), off=metres(off)),
    }


PRESETS = (
    Preset(name="hand", title="By hand", line="Each radius in turn.", params=Input(by_hand=True)),
    Preset(name="whole", title="All around", line="Here both fits agree.", params=Input(arc=360)),
    Preset(name="exact", title="No noise", line="The quick fit is right.", params=Input(noise=0)),
)
QUESTIONS = (
    Question(
        name="radius",
        text="Which radius does the quick formula give?",
        answer=lambda states: states[0][2],
        why=lambda states: f"It gives {states[0][2]:.2f} m.",
        params=Input(),
        unit="m",
        tolerance=0.08,
        low=0.3,
        high=2.0,
        wrong=((0.95, 1.1, "That is the true radius. The quick formula does not find it."),),
    ),
    Question(
        name="refined",
        text="Is the radius better in the end?",
        choices=("It is better", Choice("It is not", why="Look at the curve.")),
        answer=lambda states: int(abs(states[-1][2] - 1) > abs(states[0][2] - 1)),
        why=lambda states: f"From {states[0][2]:.2f} m it comes to {states[-1][2]:.2f} m.",
        params=Input(),
    ),
)
lesson = Lesson(
    name="circle",
    title="A circle through points",
    summary="One linear system gives a circle, but not the nearest one: watch it grow.",
    page=Path(__file__).with_name("page.md"),
    params=Input,
    setup=setup,
    run=run,
    draw=draw,
    order=900,
    chapter="Estimate",
    minutes=5,
    view=View(eye=(0.4, 0.3, 4.5), target=(0.4, 0.3, 0.0)),
    presets=PRESETS,
    questions=QUESTIONS,
)
