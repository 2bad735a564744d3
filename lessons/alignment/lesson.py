"""The frame that a cloud carries.

What it teaches: plane turns bring a covariance to its axes, which come without signs, and with
equal variances without directions, so that two clouds aligned by them may be half a turn apart.
"""

from collections.abc import Iterator
from pathlib import Path

from lessons.alignment.axes import FindAxes, Sign, steps
from lessons.alignment.draw import draw
from lessons.alignment.presets import FIRST, PRESETS, QUESTIONS, VIEW
from lessons.alignment.state import Params, State
from workbench.lesson import Lesson, Sweep


def run(
    params: Params, *, principal_axes: FindAxes | None = None, canonical_signs: Sign | None = None
) -> Iterator[State]:
    """Yield the steps in which the second scan is brought to the first by the axes of both."""
    yield from steps(params, principal_axes, canonical_signs)


lesson = Lesson(
    name="alignment",
    title="Principal axes",
    summary="A cloud of points has axes of its own, but nothing says which end of an axis is its "
    "front.",
    page=Path(__file__).with_name("page.md"),
    params=Params,
    run=run,
    draw=draw,
    order=500,
    chapter="Estimate",
    minutes=15,
    needs=("icp",),
    view=VIEW,
    presets=PRESETS,
    questions=QUESTIONS,
    first_step=FIRST,
    sweeps=(Sweep("signs", ("none", "largest-entry", "third-moment")),),
    telling="Variance by direction",
)
