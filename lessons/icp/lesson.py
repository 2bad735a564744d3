"""Iterative closest point: match every source point to its nearest target point, fit a motion,
repeat.

What it teaches: ICP walks downhill from where it starts, home or into another valley, so a small
RMSE proves nothing; the start, the gate, the error measure and how evenly the scans are sampled
decide.
"""

from collections.abc import Iterator
from pathlib import Path

from lessons.icp import drawing, flat, scans, space
from lessons.icp.inputs import Input
from lessons.icp.presets import PRESETS, SWEEPS, VIEW, VIEWS
from lessons.icp.questions import QUESTIONS
from workbench.algorithms import turning
from workbench.algorithms.registration import icp
from workbench.lesson import Lesson, Look, Slot
from workbench.scene import Scene

Subject = flat.Outlines | scans.Scans
State = turning.State | icp.State | space.Try


def setup(params: Input) -> Subject:
    """Return two outlines that only turn, or two scans.

    Raises:
        InputError: If an own file cannot be used, or only one of the two scans is given.
    """
    return flat.outlines(params) if params.stage == "flat" else scans.scans_of(params)


def run(
    params: Input,
    subject: Subject,
    *,
    align: Slot | None = None,
    match: Slot | None = None,
    step: Slot | None = None,
) -> Iterator[State]:
    """Yield the steps of ICP, or of a hand that turns the outline; functions are for space
    alone.
    """
    if isinstance(subject, flat.Outlines):
        yield from flat.run(params, subject)
    else:
        yield from space.run(params, subject, align, match=match, step=step)


def draw(look: Look) -> Scene:
    """Return the picture of one step."""
    return flat.draw(look) if isinstance(look.subject, flat.Outlines) else drawing.draw(look)


lesson = Lesson(
    name="icp",
    title="Iterative closest point",
    summary="Two scans find each other: match, move, match again. Sometimes they settle in the "
    "wrong place.",
    page=Path(__file__).with_name("page.md"),
    params=Input,
    setup=setup,
    run=run,
    draw=draw,
    order=400,
    chapter="Estimate",
    minutes=20,
    needs=("pairs",),
    view=VIEW,
    views=VIEWS,
    presets=PRESETS,
    questions=QUESTIONS,
    sweeps=SWEEPS,
    telling="Rotation error",
    tries=lambda state: isinstance(state, space.Try),
)
