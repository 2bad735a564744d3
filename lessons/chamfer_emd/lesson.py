"""Chamfer and earth mover's: one cloud flows down two distances, side by side.

What it teaches: nearest neighbours are not one to one, so a small Chamfer distance says little
about density; the earth mover's distance matches one to one, so it does. "Chamfer" names several
numbers, and every number of the table has a blind spot.
"""

from collections.abc import Iterator
from itertools import zip_longest
from pathlib import Path
from typing import Any

from lessons.chamfer_emd import blurred, bunch, distances, drawing, far_dot, twelve
from lessons.chamfer_emd.clouds import clouds_of
from lessons.chamfer_emd.distances import Measures, measured, numbers_of_yardsticks
from lessons.chamfer_emd.inputs import Input
from lessons.chamfer_emd.presets import PRESETS, SWEEPS, VIEW, VIEWS
from lessons.chamfer_emd.questions import QUESTIONS
from lessons.chamfer_emd.state import Clouds, Step
from workbench.algorithms.transport import exact as transport
from workbench.algorithms.transport.flow import Distance, Flow, flow
from workbench.geometry.points import shape_distances
from workbench.lesson import Lesson, Look
from workbench.scene import Scene

STAGES = {"twelve": twelve, "bunch": bunch, "far dot": far_dot, "blur": blurred}
Subject = Clouds | twelve.Twelve | bunch.Rings | far_dot.Ring | blurred.Pairs


def setup(params: Input) -> Subject:
    """Return the clouds of the stage.

    Raises:
        InputError: If an own file cannot be used, or a source is given without its target.
    """
    return clouds_of(params) if params.stage == "flows" else STAGES[params.stage].setup(params)


def run(
    params: Input,
    subject: Subject,
    *,
    chamfer: Distance = shape_distances.chamfer,
    earth_movers: Distance = transport.earth_movers,
    one_sided: Distance = shape_distances.one_sided,
) -> Iterator[Any]:
    """Yield both flows step by step, each down the distance in its slot; or the values that a hand
    goes through.
    """
    measures = Measures(chamfer, earth_movers, one_sided)
    if isinstance(subject, Clouds):
        yield from flows(params, subject, measures)
    else:
        yield from STAGES[params.stage].run(params, subject, measures)


def flows(params: Input, clouds: Clouds, measures: Measures) -> Iterator[Step]:
    """Yield both flows from one cloud, the left one down Chamfer and the right one down the earth
    mover's distance.
    """
    p_source, p_target = clouds.p_source, clouds.p_target
    limits = {"longest_step": params.longest_step, "max_steps": params.steps}
    lefts = flow(p_source, p_target, *distances.left(params.lowers, measures), **limits)
    rights = flow(p_source, p_target, *distances.right(measures), **limits)
    known = numbers_of_yardsticks(clouds, params, measures)
    left = right = before = None
    for step, (now_left, now_right) in enumerate(side_by_side(lefts, rights)):
        left = measured(now_left, left, p_target, params, measures)
        right = measured(now_right, right, p_target, params, measures)
        yield Step(
            step=step,
            left=left,
            right=right,
            before=before,
            yardsticks=known,
            last=now_left.stop is not None and now_right.stop is not None,
        )
        before = left.numbers, right.numbers


def side_by_side(lefts: Iterator[Flow], rights: Iterator[Flow]) -> Iterator[tuple[Flow, Flow]]:
    """Yield both flows at the same step; the one that ended first waits where it is."""
    left = right = None
    for now_left, now_right in zip_longest(lefts, rights):
        left, right = now_left or left, now_right or right
        if left and right:
            yield left, right


def draw(look: Look) -> Scene:
    """Return the picture of one step."""
    stage = look.params.stage
    return drawing.draw(look) if stage == "flows" else STAGES[stage].draw(look)


lesson = Lesson(
    name="chamfer_emd",
    title="Chamfer and earth mover's",
    summary="Two ways to say how far one cloud of points is from another: partners may be "
    "shared, or they may not.",
    page=Path(__file__).with_name("page.md"),
    params=Input,
    setup=setup,
    run=run,
    draw=draw,
    order=1800,
    chapter="Measure",
    minutes=20,
    needs=("distances",),
    view=VIEW,
    views=VIEWS,
    presets=PRESETS,
    questions=QUESTIONS,
    first_step=8,
    sweeps=SWEEPS,
    telling="Mass out of place",
)
