"""Transforms: a 4x4 says where the axes and the origin go.

What it teaches: its columns are arrows, and what is built on them follows; in a product the order
counts, and the last motion is undone first; kinds of maps differ in what they leave alone; places
move and directions do not; the last row divides.
"""

from collections.abc import Iterator
from pathlib import Path

from lessons.transforms import by_hand, drawing, hands
from lessons.transforms.composition import Invert
from lessons.transforms.factors import Built, build
from lessons.transforms.inputs import Body, Input, setup
from lessons.transforms.presets import PRESETS, QUESTIONS, SWEEPS, VIEW, VIEWS
from workbench.geometry.motions import inverse
from workbench.lesson import Lesson, Look
from workbench.scene import Scene


def run(
    params: Input, body: Body, *, invert_rigid: Invert = inverse
) -> Iterator[Built | hands.Held]:
    """Yield the body after every factor, or the values of the number under the hand."""
    if params.stage == "factors":
        yield from build(params, body, invert_rigid)
    else:
        yield from hands.hold(params, invert_rigid)


def draw(look: Look) -> Scene:
    """Return the picture of one step."""
    return drawing.draw(look) if isinstance(look.now, Built) else by_hand.draw(look)


lesson = Lesson(
    name="transforms",
    title="Transforms",
    summary="A 4×4 matrix says where the axes and the origin go. Everything else follows them.",
    page=Path(__file__).with_name("page.md"),
    params=Input,
    setup=setup,
    run=run,
    draw=draw,
    order=100,
    chapter="Move",
    minutes=20,
    view=VIEW,
    views=VIEWS,
    presets=PRESETS,
    questions=QUESTIONS,
    first_step=5,
    sweeps=SWEEPS,
    telling="What survives",
)
