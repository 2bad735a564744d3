"""A camera on a pan-tilt mount that follows a target: what angles, and how fast they have to
change.

Pan is the azimuth, tilt the elevation above the horizon: coordinates with a pole at the zenith.

Reference: Stewart and others on the zenith keyhole, e.g. Crawford and Brush, Trajectory
Optimization to Compensate for Azimuth Rate Limits at High Elevations, 1995; the rates are the
derivatives of spherical coordinates.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from jaxtyping import Float

from lessons.coordinates.placing import Spherical
from workbench.geometry.shapes.curvilinear import cartesian_from_spherical
from workbench.tracing import traced

INSTANT = 1e-6  # seconds over which a rate is taken


@dataclass(frozen=True, eq=False, kw_only=True)
class Followed:
    """One moment of following a target.

    Attributes:
        time: Seconds.
        p: The target from the mount, m.
        pan: Radians.
        tilt: Above the horizon, radians.
        pan_rate: Radians per second.
        tilt_rate: Likewise.
        sight_rate: How fast the line of sight itself turns, radians per second.
        pan_peak: The largest pan rate so far, by its size.
        sight_peak: The largest rate of the line of sight so far.
        off: The angle from where the camera looks to the target, radians.
    """

    time: float
    p: Float[np.ndarray, "3"]
    pan: float
    tilt: float
    pan_rate: float
    tilt_rate: float
    sight_rate: float
    pan_peak: float
    sight_peak: float
    off: float


@traced
def follow(
    p_start: Float[np.ndarray, "3"],
    v: Float[np.ndarray, "3"],
    times: Float[np.ndarray, " n"],
    *,
    spherical_from_cartesian: Spherical,
) -> Iterator[Followed]:
    """Yield where a mount at the origin has to look, and how fast its axes have to turn, at each
    time.

    Args:
        p_start: Where the target is at time 0, m.
        v: Its velocity, m/s.
        times: Seconds.
        spherical_from_cartesian: Tells polar angle and azimuth of the target.
    """
    p = p_start + times[:, None] * v
    before, middle, after = (
        spherical_from_cartesian(p + dt * v) for dt in (-INSTANT / 2, 0.0, INSTANT / 2)
    )
    turned = (after - before + np.pi) % (2.0 * np.pi) - np.pi  # the short way round
    looks = cartesian_from_spherical(np.column_stack([np.ones(len(p)), middle[:, 1:]]))
    across = np.linalg.norm(np.cross(p, v), axis=1)
    off = np.arctan2(np.linalg.norm(np.cross(looks, p), axis=1), (looks * p).sum(axis=1))
    pan_rate = turned[:, 2] / INSTANT
    tilt_rate = -turned[:, 1] / INSTANT
    sight_rate = across / (p * p).sum(axis=1)
    for k in range(len(times)):
        yield Followed(
            time=float(times[k]),
            p=p[k],
            pan=float(middle[k, 2]),
            tilt=float(np.pi / 2 - middle[k, 1]),
            pan_rate=float(pan_rate[k]),
            tilt_rate=float(tilt_rate[k]),
            sight_rate=float(sight_rate[k]),
            pan_peak=float(np.abs(pan_rate[: k + 1]).max()),
            sight_peak=float(sight_rate[: k + 1].max()),
            off=float(off[k]),
        )
