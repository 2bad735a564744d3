"""What is near depends on the distance, and most of them are computed along something.

What it teaches: a distance is a claim, whose axioms can be tested; Mahalanobis' is Euclid's in a
space that was made round; ways along edges are too long however fine the grid, fast marching and
heat are wrong by less the finer it is; and one edge that leaves a surface ruins all ways over it.
"""

from collections.abc import Iterator
from pathlib import Path

from lessons.distances.draw import draw
from lessons.distances.presets import PRESETS, VIEW
from lessons.distances.questions import QUESTIONS
from lessons.distances.slots import Functions, Mahalanobis, Shortest
from lessons.distances.stages import STAGES
from lessons.distances.state import Params, State
from workbench.algorithms.surfaces import fast_marching
from workbench.algorithms.surfaces.fast_marching import Update
from workbench.geometry.meshes import geodesics
from workbench.geometry.points import metrics
from workbench.lesson import Lesson, Sweep


def run(
    params: Params,
    *,
    mahalanobis: Mahalanobis = metrics.mahalanobis,
    shortest_distances: Shortest = geodesics.shortest_distances,
    eikonal_update: Update = fast_marching.eikonal_update,
) -> Iterator[State]:
    """Yield the steps of one stage."""
    functions = Functions(
        mahalanobis=mahalanobis,
        shortest_distances=shortest_distances,
        eikonal_update=eikonal_update,
    )
    for subject, result in STAGES[params.stage](params, functions):
        yield State(params=params, subject=subject, now=result)


lesson = Lesson(
    name="distances",
    title="Distances",
    summary="Which point is the nearest depends on how you measure, and on the ground you have "
    "to cross.",
    page=Path(__file__).with_name("page.md"),
    params=Params,
    run=run,
    draw=draw,
    order=1700,
    chapter="Measure",
    minutes=20,
    view=VIEW,
    presets=PRESETS,
    questions=QUESTIONS,
    first_step=6,
    opening=0,
    sweeps=(Sweep("neighbours", ("4", "8", "16", "march")),),
    telling="Worst error so far",
)
