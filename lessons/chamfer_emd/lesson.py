"""Chamfer and earth mover's: one cloud flows down two distances, side by side.

What it teaches: nearest neighbours are not one to one, so a small Chamfer distance says little
about density; the earth mover's distance matches one to one, so it does. "Chamfer" names several
numbers, and every number of the table has a blind spot.
"""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

from lessons.chamfer_emd import blurred, bunch, far_dot, flows, twelve
from lessons.chamfer_emd.distances import Measures
from lessons.chamfer_emd.inputs import Input
from lessons.chamfer_emd.presets import PRESETS, SWEEPS, VIEW, VIEWS
from lessons.chamfer_emd.questions import QUESTIONS
from lessons.chamfer_emd.state import Clouds
from workbench.algorithms.transport import exact as transport
from workbench.algorithms.transport.flow import Distance
from workbench.geometry.points import shape_distances
from workbench.lesson import Lesson, Look
from workbench.scene import Scene

STAGES = {"flows": flows, "twelve": twelve, "bunch": bunch, "far dot": far_dot, "blur": blurred}
Subject = Clouds | twelve.Twelve | bunch.Rings | far_dot.Ring | blurred.Pairs


def setup(params: Input) -> Subject:
    """Return the clouds of the stage.

    Raises:
        InputError: If an own file cannot be used, or a source is given without its target.
    """
    return STAGES[params.stage].setup(params)


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
    yield from STAGES[params.stage].run(params, subject, measures)


def draw(look: Look) -> Scene:
    """Return the picture of one step."""
    return STAGES[look.params.stage].draw(look)


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
