"""Descriptors: number-pictures of a neighbourhood that stay the same when the object moves.

What it teaches: equal descriptors vote for a motion, so registration needs no start and ICP only
polishes; most votes may be wrong as long as the right ones agree; and what a descriptor does not
change with (a turn, brightness, which side a normal faces) is a choice somebody made.
"""

from collections.abc import Iterator
from pathlib import Path

from lessons.features.draw import draw
from lessons.features.outlines import outline_steps
from lessons.features.pictures import Response, picture_steps
from lessons.features.presets import PRESETS, QUESTIONS, VIEW
from lessons.features.scans import Matcher, scan_steps
from lessons.features.state import Params, State
from workbench.geometry.features import fpfh, keypoints, matching
from workbench.geometry.features.fpfh import PairAngles
from workbench.lesson import Lesson, Sweep


def run(
    params: Params,
    *,
    pair_angles: PairAngles = fpfh.pair_angles,
    mutual_matches: Matcher = matching.mutual_matches,
    harris_response: Response = keypoints.harris_response,
) -> Iterator[State]:
    """Yield the steps of one part."""
    if params.part == "scans":
        steps = scan_steps(params, pair_angles, mutual_matches)
    elif params.part == "pictures":
        steps = picture_steps(params, harris_response, mutual_matches)
    else:
        steps = outline_steps(params)
    for step in steps:
        yield State(params=params, now=step)


lesson = Lesson(
    name="features",
    title="Features and descriptors",
    summary="Describe a place by its surroundings, and find it again in another scan or picture.",
    page=Path(__file__).with_name("page.md"),
    params=Params,
    run=run,
    draw=draw,
    order=1100,
    chapter="See",
    minutes=25,
    needs=("icp", "ransac"),
    view=VIEW,
    presets=PRESETS,
    questions=QUESTIONS,
    first_step=3,
    opening=0,
    sweeps=(Sweep("radius", (0.05, 0.07, 0.1, 0.15, 0.25)),),
    telling="Right matches",
)
