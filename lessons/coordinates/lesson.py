"""Coordinate systems: what they name, where their names fail, and what one number more buys.

What it teaches: spherical coordinates have poles where they change without bound although nothing
turns fast; even angles are not even on a sphere, straight numbers are no straight way, means of
angles are no means; and homogeneous coordinates name what the others cannot: points at infinity.
"""

from collections.abc import Iterator
from pathlib import Path

import numpy as np

from lessons.coordinates.draw import draw
from lessons.coordinates.exercises.great_circle_distance import great_circle_distance
from lessons.coordinates.exercises.meet import meet
from lessons.coordinates.exercises.spherical_from_cartesian import spherical_from_cartesian
from lessons.coordinates.pan_tilt import follow
from lessons.coordinates.parallels import Meet, step_back, turn_parallel
from lessons.coordinates.placing import Spherical, measure, scatter
from lessons.coordinates.point import point_stage
from lessons.coordinates.presets import PRESETS, QUESTIONS, VIEW
from lessons.coordinates.state import SECONDS, TILTS, Now, Params, State
from lessons.coordinates.subjects import places_of, thing_of
from lessons.coordinates.voyages import Distance, to_the_pole, travel
from workbench.data.thinning import growing
from workbench.geometry.shapes.globe import PLANETS
from workbench.lesson import Lesson, Sweep

HEIGHT, SPEED = 10.0, 10.0  # of the passer-by: metres, metres per second
RANGE, RANGE_SIGMA = 10.0, 0.02  # metres
# degrees between two lines
TURNS = (40.0, 30.0, 20.0, 10.0, 5.0, 2.0, 1.0, 0.5, 0.1, 0.01, 1e-6, 0.0)
STOPS = np.array([0.0, 1.0, 3.0, 7.0])


def run(
    params: Params,
    *,
    spherical_from_cartesian: Spherical = spherical_from_cartesian,
    meet: Meet = meet,
    great_circle_distance: Distance = great_circle_distance,
) -> Iterator[State]:
    """Yield the steps of one stage."""
    rng = np.random.default_rng(params.seed)
    subject = None
    steps: Iterator[Now]
    if params.stage == "point":
        yield from point_stage(params, spherical_from_cartesian)
        return
    if params.stage == "sphere":
        steps = scatter(growing(params.samples, 6), params.even, rng)
    elif params.stage == "radar":
        steps = measure(
            RANGE,
            np.radians(params.bearing_noise),
            RANGE_SIGMA,
            counts=growing(params.samples, 6),
            rng=rng,
        )
    elif params.stage == "globe":
        subject = places_of(params)
        steps = travel(subject.degrees, 16, great_circle_distance)
    elif params.stage == "latitude":
        steps = to_the_pole(PLANETS[params.planet], 18)
    elif params.stage == "mount":
        beside = HEIGHT * np.tan(np.radians(params.miss))
        start = np.array([0.0, beside, HEIGHT])
        v = np.array([SPEED, 0.0, 0.0])
        steps = follow(
            start, v, moments(beside / SPEED), spherical_from_cartesian=spherical_from_cartesian
        )
    elif params.stage == "projective":
        angles = [angle for angle in TURNS if angle > params.angle_between] + [params.angle_between]
        steps = turn_parallel(np.radians(angles), TILTS, 1.0, stops=STOPS, meet=meet)
    else:
        subject = thing_of(params)
        steps = step_back(
            subject.p, subject.half_depth, np.geomspace(1.5, max(params.distance, 1.51), 17)
        )
    for step in steps:
        yield State(params=params, now=step, subject=subject)


def moments(scale: float) -> np.ndarray:
    """Return the times of a passage, seconds: evenly, and where the pan axis has turned evenly, so
    that none is missed.
    """
    turned = scale * np.tan(np.radians(np.arange(-80.0, 81.0, 20.0)))
    times = np.concatenate([np.linspace(-SECONDS, SECONDS, 17), turned[np.abs(turned) < SECONDS]])
    return np.unique(times.round(9))


lesson = Lesson(
    name="coordinates",
    title="Coordinates and their poles",
    summary="Every system of coordinates breaks down somewhere. Walk to these places, and see "
    "what one more number adds.",
    page=Path(__file__).with_name("page.md"),
    params=Params,
    run=run,
    draw=draw,
    order=200,
    chapter="Move",
    minutes=20,
    needs=("rotations",),
    view=VIEW,
    presets=PRESETS,
    questions=QUESTIONS,
    first_step=9,
    opening=0,
    sweeps=(Sweep("system", ("cartesian", "cylindrical", "spherical", "homogeneous")),),
    telling="Along the walk",
)
