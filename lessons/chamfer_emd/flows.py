"""The stage `flows`: one cloud flows down two distances, side by side."""

from collections.abc import Iterator
from itertools import zip_longest

from lessons.chamfer_emd import distances, drawing
from lessons.chamfer_emd.clouds import clouds_of
from lessons.chamfer_emd.distances import Measures, measured, numbers_of_yardsticks
from lessons.chamfer_emd.inputs import Input
from lessons.chamfer_emd.state import Clouds, Step
from workbench.algorithms.transport.flow import Flow, flow
from workbench.lesson import Look
from workbench.scene import Scene


def setup(params: Input) -> Clouds:
    """Return both clouds, built-in or own.

    Raises:
        InputError: If an own file cannot be used, or a source is given without its target.
    """
    return clouds_of(params)


def run(params: Input, clouds: Clouds, measures: Measures) -> Iterator[Step]:
    """Yield both flows from one cloud, the left one down Chamfer and the right one down the earth
    mover's distance.
    """
    p_source, p_target = clouds.p_source, clouds.p_target
    limits = {"longest_step": params.longest_step, "max_steps": params.steps}
    left_distance, left_gradient = distances.left(params.lowers, measures)
    right_distance, right_gradient = distances.right(measures)
    lefts = flow(p_source, p_target, left_distance, gradient=left_gradient, **limits)
    rights = flow(p_source, p_target, right_distance, gradient=right_gradient, **limits)
    known = numbers_of_yardsticks(clouds, params, measures)
    left = right = before = None
    for step, (now_left, now_right) in enumerate(side_by_side(lefts, rights)):
        left = measured(now_left, left, p_target, params=params, measures=measures)
        right = measured(now_right, right, p_target, params=params, measures=measures)
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


def draw(look: Look[Input, Clouds, Step]) -> Scene:
    """Return the picture of one step."""
    return drawing.draw(look)
