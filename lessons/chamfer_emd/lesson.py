"""Chamfer and earth mover's: one cloud flows down two distances, side by side.

What it teaches: nearest neighbours are not one to one, so a small Chamfer distance says little
about density; the earth mover's distance matches one to one, so it does. "Chamfer" names several
numbers, and every number of the table has a blind spot.
"""

from collections.abc import Iterator
from itertools import zip_longest
from pathlib import Path

from lessons.chamfer_emd import distances
from lessons.chamfer_emd.clouds import clouds_of
from lessons.chamfer_emd.distances import Measures, measured, numbers_of_yardsticks
from lessons.chamfer_emd.draw import VIEW, draw
from lessons.chamfer_emd.presets import PRESETS, QUESTIONS
from lessons.chamfer_emd.state import Params, State
from workbench.algorithms.transport import exact as transport
from workbench.algorithms.transport.flow import Distance, Flow, flow
from workbench.geometry.points import shape_distances
from workbench.lesson import Lesson, Sweep


def run(
    params: Params,
    *,
    chamfer: Distance = shape_distances.chamfer,
    earth_movers: Distance = transport.earth_movers,
    one_sided: Distance = shape_distances.one_sided,
) -> Iterator[State]:
    """Yield both flows step by step, each down the distance in its slot."""
    clouds, measures = clouds_of(params), Measures(chamfer, earth_movers, one_sided)
    p_source, p_target = clouds.p_source, clouds.p_target
    limits = {"longest_step": params.longest_step, "max_steps": params.steps}
    lefts = flow(p_source, p_target, *distances.left(params.lowers, measures), **limits)
    rights = flow(p_source, p_target, *distances.right(measures), **limits)
    known = numbers_of_yardsticks(clouds, params, measures)
    left = right = before = None
    for step, (now_left, now_right) in enumerate(side_by_side(lefts, rights)):
        left = measured(now_left, left, p_target, params, measures)
        right = measured(now_right, right, p_target, params, measures)
        yield State(
            step=step,
            params=params,
            clouds=clouds,
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


lesson = Lesson(
    name="chamfer_emd",
    title="Chamfer and earth mover's",
    summary="Two ways to say how far one cloud of points is from another: partners may be "
    "shared, or they may not.",
    page=Path(__file__).with_name("page.md"),
    params=Params,
    run=run,
    draw=draw,
    order=1800,
    chapter="Measure",
    minutes=25,
    needs=("distances",),
    view=VIEW,
    presets=PRESETS,
    questions=QUESTIONS,
    first_step=8,
    opening=0,
    sweeps=(Sweep("lowers", ("both sides", "source to target", "target to source")),),
    telling="Left flow",
)
