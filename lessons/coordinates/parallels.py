"""Homogeneous coordinates at work: one point by many vectors, lines until they are parallel, the
horizon brought near.

And its counterpart in space, an eye that goes away until its picture is a parallel projection.

Reference: Hartley and Zisserman, Multiple View Geometry, 2nd ed., 2.2, 2.4 and 6.3.1.
"""

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass

import numpy as np
from jaxtyping import Float

from workbench.geometry.cameras import look_at, project, project_orthographic
from workbench.geometry.shapes.projective import cross_ratio, map_lines
from workbench.tracing import traced

Meet = Callable[[np.ndarray, np.ndarray], np.ndarray]
"""meet(lines_a, lines_b) -> (n, 3), homogeneous."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Scaled:
    """A homogeneous vector (x, y, z, w) whose last entry changes, or in the end the mean of two
    such vectors.

    Attributes:
        p_h: The vector.
        other_h: A second one, where a mean is taken.
        mean_h: The mean of both.
    """

    p_h: Float[np.ndarray, "4"]
    other_h: Float[np.ndarray, "4"] | None = None
    mean_h: Float[np.ndarray, "4"] | None = None


@traced
def scale_last(
    p: Float[np.ndarray, "3"], ws: Iterable[float], other_h: Float[np.ndarray, "4"]
) -> Iterator[Scaled]:
    """Yield (x, y, z, w) for many w, and then the mean of (x, y, z, 1) and another vector, entry by
    entry.

    Args:
        p: x, y and z.
        ws: What w is at each step.
        other_h: The other vector.
    """
    for w in ws:
        yield Scaled(p_h=np.append(p, w))
    p_h = np.append(p, 1.0)
    yield Scaled(p_h=p_h, other_h=other_h, mean_h=(p_h + other_h) / 2)


@dataclass(frozen=True, eq=False, kw_only=True)
class Met:
    """Two lines and the vector of their meeting, perhaps after a homography.

    Attributes:
        angle: Between the lines before any homography, radians.
        H: The homography.
        lines: Both lines.
        x_h: Where they meet.
        horizon: The line at infinity after the homography.
        places: Four points on the first line, as homogeneous vectors.
        cross_ratio: Of these four.
        ratio: Of the two distances from the first to the third and to the second.
    """

    angle: float
    H: Float[np.ndarray, "3 3"]
    lines: Float[np.ndarray, "2 3"]
    x_h: Float[np.ndarray, "3"]
    horizon: Float[np.ndarray, "3"]
    places: Float[np.ndarray, "4 3"]
    cross_ratio: float
    ratio: float


@traced
def turn_parallel(
    angles: Iterable[float],
    tilts: Iterable[float],
    gap: float,
    *,
    stops: Float[np.ndarray, "4"],
    meet: Meet,
) -> Iterator[Met]:
    """Yield two lines that become parallel, and then their pictures by homographies that bring the
    horizon near.

    Args:
        angles: Between the lines, radians, at each step.
        tilts: The entry h31 of the homography at each further step: the horizon is x = 1 / h31.
        gap: How far apart the lines cross x = 0, m.
        stops: The x of four points on the first line, m.
        meet: Finds where lines meet.
    """
    places = np.column_stack([stops, np.zeros(4), np.ones(4)])
    infinity = np.array([[0.0, 0.0, 1.0]])
    angles = list(angles)
    for angle, tilt in [(angle, 0.0) for angle in angles] + [(angles[-1], tilt) for tilt in tilts]:
        lines = np.array([[0.0, 1.0, 0.0], [np.sin(angle), np.cos(angle), -gap * np.cos(angle)]])
        H = np.array([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [tilt, 0.0, 1.0]])
        moved = map_lines(H, lines)
        moved_places = places @ H.T
        t = moved_places[:, 0] / moved_places[:, 2]
        yield Met(
            angle=angle,
            H=H,
            lines=moved,
            x_h=np.asarray(meet(moved[:1], moved[1:]), float)[0],
            horizon=map_lines(H, infinity)[0],
            places=moved_places,
            cross_ratio=cross_ratio(t),
            ratio=float((t[2] - t[0]) / (t[1] - t[0])),
        )


@dataclass(frozen=True, eq=False, kw_only=True)
class Seen:
    """An object on a plane through its middle, by an eye and by parallel rays.

    Attributes:
        times: How many half-depths the eye is away from the middle.
        eye: Where it is, m.
        perspective: Points of the plane, x and z, m.
        parallel: Likewise, by rays along y.
        near: By which share the side towards the eye is too large.
        far: By which share the side away from it is too large: negative.
    """

    times: float
    eye: Float[np.ndarray, "3"]
    perspective: Float[np.ndarray, "n 2"]
    parallel: Float[np.ndarray, "n 2"]
    near: float
    far: float


@traced
def step_back(
    p: Float[np.ndarray, "n 3"], half_depth: float, times: Iterable[float]
) -> Iterator[Seen]:
    """Yield the pictures of an object about the origin on the plane y = 0, by an eye on -Y ever
    farther away.

    The focal length is the distance of the eye, so that what lies in the plane is seen in its size.

    Args:
        p: Points of the object, m.
        half_depth: Half of what it measures along y, m.
        times: How many half-depths the eye is away, at each step; more than 1.
    """
    for factor in times:
        distance = factor * half_depth
        eye = np.array([0.0, -distance, 0.0])
        T_camera_world = look_at(eye, np.zeros(3))
        K = np.diag([distance, distance, 1.0])  # pixels of one metre on the plane
        size = np.array([factor / (factor - 1.0), factor / (factor + 1.0)])
        yield Seen(
            times=float(factor),
            eye=eye,
            perspective=project(p, T_camera_world, K) * [1.0, -1.0],
            parallel=project_orthographic(p, T_camera_world, np.eye(3)) * [1.0, -1.0],
            near=float(size[0] - 1.0),
            far=float(size[1] - 1.0),
        )
