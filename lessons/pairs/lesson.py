"""Pairs of points, and the motion that fits them best.

What it teaches: with known pairs the best turn is computed, not searched for: the pull of the bands
has one valley; an SVD turns in and out; a mirror image costs its weakest direction; noise shrinks a
scale; mistakes that agree do more harm than mistakes that do not.
"""

from collections.abc import Iterator
from pathlib import Path

from lessons.pairs import drawing, flat, space
from lessons.pairs.inputs import Input
from lessons.pairs.presets import PRESETS, QUESTIONS, SWEEPS, VIEW, VIEWS
from workbench.errors import InputError
from workbench.geometry.motions import alignment
from workbench.knobs import called
from workbench.lesson import Lesson, Look, Slot, cached
from workbench.scene import Scene


def setup(params: Input) -> flat.Bands | space.Scans:
    """Return two outlines, or two scans, whose points are paired.

    Raises:
        InputError: If an own file cannot be used, or own clouds do not fit together.
    """
    if params.stage == "flat":
        return flat.bands_of(params.pull)
    given = (params.source, params.target, params.truth)
    files = [path for path in given if path is not None]
    if params.source is None and files:
        raise InputError(
            "an own first scan and a known pose come with an own cloud: give"
            f" {called('source')} too"
        )
    if params.truth is not None and params.target is None:
        raise InputError(
            f"a known pose is in the frame of an own first scan: give {called('target')} too"
        )
    return _scans(params)


@cached
def _scans(params: Input) -> space.Scans:
    return space.built_in(params) if params.target is None else space.own(params)


def run(
    params: Input,
    subject: flat.Bands | space.Scans,
    *,
    similarity_scale: Slot = alignment.similarity_scale,
) -> Iterator[flat.Held | space.State]:
    """Yield the angles of a hand that turns the outline, or the steps of the best fit in space."""
    if isinstance(subject, flat.Bands):
        yield from flat.hand(subject)
    else:
        yield from space.fit(subject, params, similarity_scale)


def draw(look: Look) -> Scene:
    """Return the picture of one step."""
    return flat.draw(look) if isinstance(look.subject, flat.Bands) else drawing.draw(look)


lesson = Lesson(
    name="pairs",
    title="Pairs and rubber bands",
    summary=(
        "When every point knows its partner, the best motion can be computed. Nothing has to "
        "be searched for."
    ),
    page=Path(__file__).with_name("page.md"),
    params=Input,
    setup=setup,
    run=run,
    draw=draw,
    order=300,
    chapter="Estimate",
    minutes=15,
    needs=("transforms",),
    view=VIEW,
    views=VIEWS,
    presets=PRESETS,
    questions=QUESTIONS,
    sweeps=SWEEPS,
    telling="RMSE",
)
