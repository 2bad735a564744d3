"""What the stages are about: places on a globe, and a thing that an eye steps back from."""

import functools
from pathlib import Path

import numpy as np

from lessons.coordinates.state import Params, Thing
from workbench.data.files import read_cloud, stamp
from workbench.data.framing import Up, frame
from workbench.data.places import Places, between_cities, read_places
from workbench.data.shapes.solids import house
from workbench.data.thinning import evenly
from workbench.errors import InputError
from workbench.geometry.shapes.globe import great_circle_distance, mean_place

MOST_POINTS = 3000
SHORTEST = 1e-9  # radians, and as much short of half round
WIDTH = 1.1  # metres that an own object is long


def places_of(params: Params) -> Places:
    """Return the places between which the way goes.

    Raises:
        InputError: If they have no one shortest way or no middle.
    """
    places = between_cities(params.route) if params.places is None else read_places(params.places)
    ends = places.degrees[[0, -1]]
    way = float(great_circle_distance(ends[:1], ends[1:], 1.0)[0])
    if not SHORTEST < way < np.pi - SHORTEST:
        fault = "one place" if way <= SHORTEST else "antipodes"
        raise InputError(f"the first place and the last are {fault}: they have no one shortest way")
    try:
        mean_place(places.degrees)
    except ValueError as error:
        raise InputError(str(error)) from None
    return places


def thing_of(params: Params) -> Thing:
    """Return the house, or an own object in its place and size."""
    if params.cloud is None:
        return _house()
    return _own(params.cloud, params.up, stamp(params.cloud))


@functools.cache
def _house() -> Thing:
    solid = house()
    middle = np.array([0.0, 0.0, solid.p[:, 2].max() / 2])
    return Thing(
        solid.p - middle, solid.lines - middle, float(np.abs(solid.lines[..., 1]).max()), "house"
    )


@functools.lru_cache(maxsize=2)
def _own(path: Path, up: Up, _stamp: tuple[int, int]) -> Thing:
    p = read_cloud(path)
    p = frame(p, WIDTH, up=up, far=1.0).shown(p)
    inside = np.abs(p).max(axis=1) <= 0.6 * WIDTH  # what a few strays are not
    p = p[inside][evenly(int(inside.sum()), MOST_POINTS)]
    half_depth = float(np.abs(p[:, 1]).max()) if len(p) else 0.0
    if half_depth < 1e-3 * WIDTH:
        raise InputError(
            f"{path.name}: the points have no depth along y: there is nothing nearer and farther"
        )
    return Thing(p, np.empty((0, 2, 3)), half_depth, path.name)
