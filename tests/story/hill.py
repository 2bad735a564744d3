"""A ball on a curve with two valleys: a small lesson with a story, for tests of what tells
stories.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

import numpy as np

from workbench.knobs import Knob
from workbench.lesson import Choice, Lesson, Preset, Question, Sweep, View
from workbench.scene import Caption, Chart, Points, Scalar, Scene, Segments
from workbench.tracing import traced

X = np.linspace(-3.0, 3.0, 121)


def height(x):
    return 0.1 * (x**2 - 4.0) ** 2 + 0.3 * x + 1.0


def slope(x):
    return 0.4 * x * (x**2 - 4.0) + 0.3


@dataclass(frozen=True)
class Params:
    """Where the ball starts, and how far it steps."""

    start: Annotated[float, Knob("Where the ball starts", -3, 3, unit="m", step=0.1)] = -0.5
    share: Annotated[float, Knob("Share of the slope", 0.01, 1)] = 0.1
    by_hand: Annotated[bool, Knob("Every place, one after the other")] = False


@dataclass(frozen=True, eq=False)
class State:
    """The ball at `x`, metres, with this start and share."""

    k: int
    x: float
    share: float
    by_hand: bool


@traced
def run(params: Params) -> Iterator[State]:
    """Yield the places of a ball that rolls down, or all places from left to right."""
    if params.by_hand:
        yield from (State(k, float(x), params.share, True) for k, x in enumerate(X))
        return
    x = params.start
    for k in range(60):
        yield State(k, x, params.share, False)
        moved = params.share * slope(x)
        if abs(moved) < 1e-4:
            return
        x = float(np.clip(x - moved, -3, 3))


def draw(state: State) -> Scene:
    """Draw the curve in space, the ball on it, and the chart of its height."""
    chart = Chart(
        "Cost",
        "where the ball is",
        "m",
        x_range=(-3, 3),
        near=(state.x - 1, state.x + 1),
        x_unit="m",
    )
    p = np.column_stack([X, 0 * X, 0.5 * height(X)])
    tangent = height(state.x) + slope(state.x) * (X - state.x)
    hand = {"steps": "place"} if state.by_hand else {"knob": "start"}
    name = "by hand" if state.by_hand else f"Step {state.k}"
    low = -3.0
    high = 0.18
    return {
        "curve": Segments(np.stack([p[:-1], p[1:]], 1), "neutral", name="curve"),
        "ball": Points(
            np.array([[state.x, 0.0, 0.5 * height(state.x)]]), "source", 0.08, name="ball"
        ),
        "place": Scalar(state.x, "place", "Place", "m"),
        "height": Scalar(float(height(state.x)), "height", "Height", "m"),
        "cost/whole": chart.whole(X, height(X), "height", "source"),
        "cost/ball": chart.mark(state.x, float(height(state.x)), "ball", "source", **hand),
        "cost/tangent": chart.second(X, tangent, "slope here", "correspondence"),
        "cost/basin": chart.band(low, high, "leads to the deep valley", "truth"),
        "caption": Caption(
            f"{name}: the ball is at {state.x:.2f} m, {height(state.x):.2f} m high."
        ),
    }


lesson = Lesson(
    name="hill",
    title="Rolling down",
    summary="A ball rolls down a curve.",
    page=Path(__file__).with_name("page.md"),
    params=Params,
    run=run,
    draw=draw,
    order=1,
    chapter="Move",
    minutes=5,
    view=View(eye=(0.3, -6.0, 2.0), target=(0.0, 0.0, 0.8)),
    views={
        "front": View(eye=(0.0, -5.0, 0.8), target=(0.0, 0.0, 0.8)),
        "side": View(eye=(4.0, -4.0, 2.0), target=(0.0, 0.0, 0.8)),
    },
    presets=(
        Preset("hand", "By hand", "Every place of the ball.", Params(by_hand=True), step=20),
        Preset("far", "From the other side", "It finds the other valley.", Params(start=2.8)),
        Preset(
            "large",
            "A large share",
            "It jumps.",
            Params(share=0.9),
            view=View(eye=(0.0, -4.0, 1.0)),
        ),
    ),
    questions=(
        Question(
            name="where",
            text="Where does it come to rest?",
            answer=lambda states: states[-1].x,
            why=lambda states: f"It rests at {states[-1].x:.2f} m.",
            params=Params(),
            unit="m",
            tolerance=0.15,
            low=-3.0,
            high=3.0,
            mark="cost",
            wrong=((1.5, 3.0, "That valley is behind the hill."),),
        ),
        Question(
            name="second",
            text="Is it the deepest place?",
            choices=(Choice("yes", why="The left one is deeper."), "no"),
            answer=lambda states: 1,
            why=lambda states: "The valley on the left is deeper.",
            params=Params(start=2.8),
        ),
    ),
    sweeps=(Sweep("share", (0.05, 0.1, 0.2, 0.4)),),
)
