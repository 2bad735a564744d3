"""Disparity: the same row of two pictures, shifted until it fits, tells how far away everything is.

What it teaches: a match is a valley in a curve of costs. Where the curve is flat (no texture), has many valleys (a
repeated pattern) or no right answer (hidden from one camera), neighbours must help, or the pixel must be left out. Depth
is one over disparity, so its error grows with the square of the distance.

`params.py` has the inputs, `pairs.py` the pictures, `states.py` what a step holds, `draw.py` and `beside.py` what it looks
like, `words.py` the captions, `presets.py` the experiments and questions.
"""

import functools
from collections.abc import Iterator
from pathlib import Path

from lessons.disparity.draw import draw
from lessons.disparity.pairs import setup_of
from lessons.disparity.params import Params
from lessons.disparity.presets import PRESETS, QUESTIONS
from lessons.disparity.states import State, states_of
from workbench.algorithms.cost_volume import (
    CostVolume,
    census_cost_volume,
    ncc_cost_volume,
    sad_cost_volume,
    ssd_cost_volume,
)
from workbench.algorithms.disparity import Choose, DepthOf, match, usual_penalties
from workbench.algorithms.disparity_map import winner_takes_all
from workbench.geometry.stereo import depth_from_disparity
from workbench.lesson import Lesson, View

OTHER_COSTS: dict[str, CostVolume] = {
    "SSD": ssd_cost_volume,
    "census": census_cost_volume,
    "NCC": ncc_cost_volume,
}


def run(
    params: Params,
    *,
    depth: DepthOf = depth_from_disparity,
    cost_volume: CostVolume = sad_cost_volume,
    choose: Choose = winner_takes_all,
) -> Iterator[State]:
    """Yield the steps from two pictures to a depth cloud; `cost_volume` is used where the knob says SAD."""
    setup = setup_of(params)
    compare = OTHER_COSTS.get(params.cost, cost_volume)
    penalties = functools.partial(usual_penalties, smoothness=params.smoothness) if params.smoothness > 0 else None
    steps = match(setup.left, setup.right, setup.max_disparity, params.window, penalties, compare, choose)
    yield from states_of(setup, steps, depth)


lesson = Lesson(
    name="disparity",
    title="Disparity and depth",
    summary="Shift one picture over the other until it fits: two eyes measure depth, and know where they cannot.",
    page=Path(__file__).with_name("page.md"),
    params=Params,
    run=run,
    draw=draw,
    order=700,
    view=View(eye=(0.5, -4.4, 2.4), target=(0.15, 0.8, -0.75), grid=0.5, grid_height=-0.62),
    presets=PRESETS,
    questions=QUESTIONS,
    first_step=15,
)
