"""The stage `point`: a point placed by three numbers, the cell about it, and a walk past the
axis.
"""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from lessons.coordinates.parallels import scale_last
from lessons.coordinates.placing import Spherical, cell_at, place, read_by_all, walk
from lessons.coordinates.state import WALKED, Params, State
from workbench.errors import InputError
from workbench.geometry.shapes.curvilinear import SYSTEMS

STEPS = 3  # for each coordinate
# of the cell: metres and radians
SIDE = 0.2
TURN = np.radians(20.0)
CLIMB, REACH = 0.8, 0.6  # metres: how high the walk is, and how far to both sides
WS = (1.0, 2.0, 0.7, 0.5, 0.3, 0.1, 0.01, 0.0)
OTHER = 3.0 * np.array([-0.7, 0.5, 0.2, 1.0])  # a second point, with w = 3


def point_stage(params: Params, spherical_from_cartesian: Spherical) -> Iterator[State]:
    """Yield the steps of the stage; the given function tells spherical coordinates."""
    p = np.array(params.point)
    if np.linalg.norm(p) < 0.05:
        raise InputError("the point lies at the origin, which has no direction: drag it away")
    if params.system == "homogeneous":
        for scaled in scale_last(p, WS, OTHER):
            yield State(params=params, now=scaled)
        return
    system = SYSTEMS[params.system]
    if params.system == "spherical":
        system = replace(system, of_points=spherical_from_cartesian)
    c = np.asarray(system.of_points(p[None]), float)[0]
    for placed in place(c, system, STEPS):
        yield State(params=params, now=placed, subject=system)
    yield State(
        params=params, now=cell_at(c, np.where(system.angles, TURN, SIDE), system), subject=system
    )
    if params.system == "spherical":
        yield State(params=params, now=read_by_all(c, params.convention), subject=system)
    beside = CLIMB * np.tan(np.radians(params.miss))
    x = np.linspace(-REACH, REACH, WALKED)
    for walked in walk(
        np.column_stack([x, np.full(WALKED, beside), np.full(WALKED, CLIMB)]), system
    ):
        yield State(params=params, now=walked, subject=system)
