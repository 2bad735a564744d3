"""RANSAC: guess a model from the fewest points, count who agrees, keep the best guess, refit it.

What it teaches: whoever cannot tell good points from bad ones guesses from few and counts votes; a
formula, counted first, says how often one must guess; a clean sample need not be a good one; and a
count knows neither which model was meant nor how much noise there is.
"""

from collections.abc import Iterator
from pathlib import Path

from lessons.ransac import drawing, flat
from lessons.ransac.inputs import Input
from lessons.ransac.presets import PRESETS, SWEEPS, VIEW, VIEWS
from lessons.ransac.questions import QUESTIONS
from lessons.ransac.rows import Subject
from lessons.ransac.search import search, subject_of
from workbench.algorithms.robust import ransac, scores
from workbench.geometry.shapes import lines_planes
from workbench.lesson import Lesson, Look, Slot
from workbench.scene import Scene


def setup(params: Input) -> Subject:
    """Return the rows of a search, or a line among clutter in the flat.

    Raises:
        InputError: If a file cannot be used, or not with this model.
    """
    return subject_of(params) if params.stage == "search" else flat.scattered(params)


def run(
    params: Input,
    subject: Subject,
    *,
    plane_from_points: Slot = lines_planes.plane_from_points,
    count_inliers: Slot = scores.count_inliers,
    iterations_needed: Slot = ransac.iterations_needed,
) -> Iterator[ransac.State | flat.State]:
    """Yield the steps of RANSAC, or of a stage in the flat; functions are for the search alone."""
    if params.stage != "search":
        yield from flat.run(params, subject)
        return
    yield from search(
        params,
        subject,
        plane_from_points=plane_from_points,
        count_inliers=count_inliers,
        iterations_needed=iterations_needed,
    )


def draw(look: Look) -> Scene:
    """Return the picture of one step."""
    return drawing.draw(look) if isinstance(look.now, ransac.State) else flat.draw(look)


lesson = Lesson(
    name="ransac",
    title="RANSAC",
    summary="Guess a shape from a few points, count how many others agree, and keep the best "
    "guess.",
    page=Path(__file__).with_name("page.md"),
    params=Input,
    setup=setup,
    run=run,
    draw=draw,
    order=700,
    chapter="Estimate",
    minutes=20,
    needs=("fitting",),
    view=VIEW,
    views=VIEWS,
    presets=PRESETS,
    questions=QUESTIONS,
    first_step=2,
    sweeps=SWEEPS,
    telling="Error to the truth",
)
