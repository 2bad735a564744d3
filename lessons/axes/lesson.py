"""The frame that a cloud carries.

What it teaches: variance by direction is an ellipse, and plane turns bring a covariance to its
axes; these come without signs, and with equal variances without directions, so that two clouds
aligned by them may be half a turn apart; but four frames and the lowest RMSE start ICP.
"""

from collections.abc import Iterator
from pathlib import Path

from lessons.axes import drawing, flat, space, starts
from lessons.axes.inputs import Input
from lessons.axes.presets import FIRST, PRESETS, SWEEPS, VIEW, VIEWS
from lessons.axes.questions import QUESTIONS
from lessons.axes.scans import Scans, scans_of
from workbench.lesson import Lesson, Look, Slot
from workbench.scene import Scene


def setup(params: Input) -> flat.Outline | Scans:
    """Return an outline, or two scans.

    Raises:
        InputError: If an own file cannot be used, or own clouds do not fit together.
    """
    return flat.outline_of(params.aside) if params.stage == "flat" else scans_of(params)


def run(
    params: Input,
    subject: flat.Outline | Scans,
    *,
    principal_axes: Slot | None = None,
    canonical_signs: Slot | None = None,
) -> Iterator[flat.Held | space.State | starts.Race]:
    """Yield the directions of a line, or the steps in which the second scan is brought to the
    first.
    """
    if isinstance(subject, flat.Outline):
        yield from flat.hand(subject)
    elif params.stage == "starts":
        yield from starts.race(subject, principal_axes)
    elif params.stage == "frames":
        yield from space.candidates(subject, principal_axes)
    elif params.stage == "turn":
        yield from space.by_hand(subject)
    else:
        yield from space.steps(params, subject, principal_axes, sign=canonical_signs)


def draw(look: Look) -> Scene:
    """Return the picture of one step."""
    if isinstance(look.subject, flat.Outline):
        return flat.draw(look)
    is_race = isinstance(look.now, starts.Race)
    return drawing.draw_race(look) if is_race else drawing.draw(look)


lesson = Lesson(
    name="axes",
    title="Principal axes",
    summary="A cloud carries a frame of its own, but its axes have no signs. Four tries start ICP.",
    page=Path(__file__).with_name("page.md"),
    params=Input,
    setup=setup,
    run=run,
    draw=draw,
    order=500,
    chapter="Estimate",
    minutes=20,
    needs=("icp",),
    view=VIEW,
    views=VIEWS,
    presets=PRESETS,
    questions=QUESTIONS,
    first_step=FIRST,
    sweeps=SWEEPS,
    telling="Variance by direction",
)
