"""Area and volume: how large a shape is, as a sum over faces, over cells, or over throws of dice.

What it teaches: each sum has an error with a law of its own: h², h, 1/√n, or one that never
shrinks; and what a sum takes for granted (closed, consistently turned, not overlapping, evenly
drawn) is where it goes wrong without a word.
"""

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np

from lessons.measures.draw import draw
from lessons.measures.exercises.points_on_faces import points_on_faces
from lessons.measures.exercises.signed_volume import signed_volume
from lessons.measures.exercises.volume_by_chance import volume_by_chance
from lessons.measures.presets import PRESETS, QUESTIONS, VIEW
from lessons.measures.samples import samples
from lessons.measures.state import Params, State, Subject
from lessons.measures.study import peeked, study_of
from lessons.measures.subjects import subject_of
from workbench.algorithms.surfaces.measures import SignedVolume, count_cells, sum_faces
from workbench.algorithms.surfaces.monte_carlo import (
    ByChance,
    OnFaces,
    Throws,
    raise_dimension,
    shoot_lines,
    throw_points,
)
from workbench.data.thinning import growing
from workbench.geometry.points.sampling import Draw
from workbench.lesson import Lesson, Sweep

BANDS = 20  # steps in which faces are added
MOST_LINES = 10_000


def run(
    params: Params,
    *,
    signed_volume: SignedVolume = signed_volume,
    points_on_faces: OnFaces = points_on_faces,
    volume_by_chance: ByChance = volume_by_chance,
) -> Iterator[State]:
    """Yield the steps of measuring one shape in one way."""
    subject = subject_of(params)
    rng = np.random.default_rng(params.seed)
    counts = counts_to(params.throws, params.draw)
    if params.method == "samples":
        yield from samples(params, subject, rng, points_on_faces=points_on_faces)
        return
    if params.method == "faces":
        origin = np.array(params.origin) / subject.scale
        away = np.linalg.norm(subject.p[subject.faces].mean(axis=1) - origin, axis=1)
        results = sum_faces(
            subject.p,
            subject.faces,
            origin,
            signed_volume=signed_volume,
            order=np.argsort(away, kind="stable"),
            counts=_bands(len(away)),
        )
    elif params.method == "voxels":
        assert subject.full is not None
        results = count_cells(subject.grids, subject.full)
    elif params.method == "chance":
        assert subject.inside is not None
        results = throw_points(
            subject.inside,
            subject.low,
            subject.high,
            counts=counts,
            draw=params.draw,
            rng=rng,
            volume_by_chance=volume_by_chance,
        )
    elif params.method == "lines":
        results = shoot_lines(
            subject.p,
            subject.faces,
            _ball(subject),
            counts=counts_to(min(params.throws, MOST_LINES)),
            rng=rng,
        )
    else:
        results = raise_dimension(params.dimension, params.throws, rng)
    state = None
    for result in results:
        state = State(params=params, subject=subject, now=result)
        if (
            isinstance(result, Throws)
            and params.draw == "random"
            and result.estimates.counts[-1] == counts[-1]
        ):
            state = replace(
                state,
                peeked=peeked(subject.volume / float(np.prod(subject.high - subject.low)), counts),
            )
        yield state
    study = study_of(params)
    if state is not None and study is not None:
        yield replace(state, study=study)


def counts_to(most: int, draw: Draw = "random") -> tuple[int, ...]:
    """Return how many are drawn until each step: from 10 on, eight steps for each power of ten.

    Of Sobol's sequence it is powers of two, and of stratified throws cubes, each once.
    """
    if draw == "Sobol":
        return tuple(2**k for k in range(4, int(np.log2(most)) + 1))
    if draw == "stratified":
        return tuple(np.unique([round(count ** (1 / 3)) ** 3 for count in growing(most)]).tolist())
    return growing(most)


def _bands(faces: int) -> tuple[int, ...]:
    """Return no face, one, and ever more until all are there."""
    return tuple(
        np.unique([0, 1, *np.rint(np.linspace(0, faces, BANDS + 1)[1:]).astype(int)]).tolist()
    )


def _ball(subject: Subject) -> tuple[np.ndarray, float]:
    middle = (subject.low + subject.high) / 2
    return middle, 1.001 * float(np.linalg.norm(subject.p - middle, axis=1).max())


lesson = Lesson(
    name="measures",
    title="Area and volume",
    summary="Add up faces, cells or random throws to get an area or a volume, and see how large "
    "the error of each sum is.",
    page=Path(__file__).with_name("page.md"),
    params=Params,
    run=run,
    draw=draw,
    order=1500,
    chapter="Measure",
    minutes=20,
    view=VIEW,
    presets=PRESETS,
    questions=QUESTIONS,
    first_step=15,
    opening=0,
    sweeps=(Sweep("flipped", (0.0, 0.01, 0.02, 0.05, 0.1, 0.2)),),
    telling="Volume",
)
