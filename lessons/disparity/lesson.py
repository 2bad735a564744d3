"""Disparity: the same row of two pictures, shifted until it fits, tells how far away everything is.

What it teaches: a match is a valley in a curve of costs. Where the curve is flat (no texture), has
many valleys (a repeated pattern) or no right answer (hidden from one camera), neighbours must help,
or the pixel must be left out. Depth is one over disparity, so its error grows with the square of
the distance.
"""

from collections.abc import Iterator
from pathlib import Path

from lessons.disparity import above, drawing, matching, path, row, study
from lessons.disparity.cameras import VIEW, VIEWS
from lessons.disparity.inputs import Input
from lessons.disparity.pairs import Pictures, pictures_of
from lessons.disparity.presets import PRESETS, SWEEPS
from lessons.disparity.questions import QUESTIONS
from workbench.algorithms.stereo import cost_volume as costs
from workbench.geometry.cameras import stereo
from workbench.lesson import Lesson, Look, Slot
from workbench.scene import Scene

Subject = Pictures | above.Rig
State = matching.State | above.State | row.Slid | path.Walked | study.Tried
STAGES = {"row": row, "path": path, "windows": study, "penalties": study, "baselines": study}


def setup(params: Input) -> Subject:
    """Return the pair of pictures, or two cameras alone.

    Raises:
        InputError: If own files are no pair, or the cost volume would be too large.
    """
    return above.rig_of(params) if params.stage in ("jump", "one pixel") else pictures_of(params)


def run(
    params: Input,
    subject: Subject,
    *,
    depth: Slot = stereo.depth_from_disparity,
    cost_volume: Slot = costs.sad_cost_volume,
    choose: Slot | None = None,
) -> Iterator[State]:
    """Yield the steps of a stage."""
    if isinstance(subject, above.Rig):
        yield from above.run(params, subject)
    elif params.stage == "whole map":
        yield from matching.run(
            params, subject, depth=depth, cost_volume=cost_volume, choose=choose
        )
    else:
        yield from STAGES[params.stage].run(params, subject, cost_volume)


def draw(look: Look) -> Scene:
    """Return the picture of one step."""
    if isinstance(look.subject, above.Rig):
        return above.draw(look)
    if isinstance(look.now, matching.State):
        return drawing.draw(look)
    return STAGES[look.params.stage].draw(look)


lesson = Lesson(
    name="disparity",
    title="Disparity and depth",
    summary="Shift one picture over the other until they agree. How far each pixel moved tells "
    "how far away it is.",
    page=Path(__file__).with_name("page.md"),
    params=Input,
    setup=setup,
    run=run,
    draw=draw,
    order=1300,
    chapter="See",
    minutes=22,
    needs=("epipolar",),
    view=VIEW,
    views=VIEWS,
    presets=PRESETS,
    questions=QUESTIONS,
    first_step=15,
    sweeps=SWEEPS,
    telling="Cost at the followed pixel",
)
