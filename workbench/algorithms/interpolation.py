"""Five ways from one pose to another; what lies between the ends tells them apart.

Every one yields `State`s at the given times, 0 at the start and 1 at the end. The place goes
straight at constant speed, except along the screw. Places are in metres, angles in radians.

References: Shoemake, Animating rotation with quaternion curves, SIGGRAPH 1985 (slerp); Murray, Li
and Sastry, A Mathematical Introduction to Robotic Manipulation, 1994, chapter 2 (Rodrigues' formula
and screws).
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np
from jaxtyping import Float

from workbench.geometry.motions import exp_se3, log_se3, motion
from workbench.geometry.motions.rotations import (
    EulerOrder,
    axis_angle_from_rotation,
    great_circle,
    matrix_from_quaternion,
    quaternion_from_matrix,
)
from workbench.tracing import traced

Times = Float[np.ndarray, "n"]
Pose = Float[np.ndarray, "4 4"]
Rodrigues = Callable[[np.ndarray, float], np.ndarray]
"""rotation_from_axis_angle(axis, radians) -> R."""
FromEuler = Callable[[np.ndarray, EulerOrder], np.ndarray]
"""euler_to_matrix(radians, order) -> R."""


@dataclass(frozen=True, eq=False)
class State:
    """The body at time t, which for matrix entries is no pose but an affine map."""

    t: float
    T_world_body: Pose


@traced
def slerp_and_lerp(
    T_world_start: Pose, T_world_end: Pose, times: Times, *, rotation_from_axis_angle: Rodrigues
) -> Iterator[State]:
    """Yield poses on the shortest turn about one axis at constant speed (slerp)."""
    R_start, R_end = T_world_start[:3, :3], T_world_end[:3, :3]
    p_start, p_end = T_world_start[:3, 3], T_world_end[:3, 3]
    axis, angle = axis_angle_from_rotation(R_end @ R_start.T)
    for t in times:
        R = rotation_from_axis_angle(axis, t * angle) @ R_start
        p = (1 - t) * p_start + t * p_end
        yield State(t, motion(R, p))


@traced
def slerp_to_minus_q(T_world_start: Pose, T_world_end: Pose, times: Times) -> Iterator[State]:
    """Yield poses on the great circle to the farther of the end's two quaternions.

    A slerp that does not choose the sign turns the body so, the long way round.
    """
    p_start, p_end = T_world_start[:3, 3], T_world_end[:3, 3]
    q_start = quaternion_from_matrix(T_world_start[:3, :3])
    q_end = quaternion_from_matrix(T_world_end[:3, :3])
    q_far = -q_end if q_start @ q_end > 0 else q_end  # the same rotation, the long way round
    for t in times:
        R = matrix_from_quaternion(great_circle(q_start, q_far, t))
        p = (1 - t) * p_start + t * p_end
        yield State(t, motion(R, p))


@traced
def lerp_of_euler_angles(
    angles_start: Float[np.ndarray, "3"],
    angles_end: Float[np.ndarray, "3"],
    order: EulerOrder,
    *,
    p_start: Float[np.ndarray, "3"],
    p_end: Float[np.ndarray, "3"],
    times: Times,
    euler_to_matrix: FromEuler,
) -> Iterator[State]:
    """Yield poses with Euler angles interpolated; axis and speed of the turn are not constant."""
    for t in times:
        angles = (1 - t) * angles_start + t * angles_end
        R = euler_to_matrix(angles, order)
        p = (1 - t) * p_start + t * p_end
        yield State(t, motion(R, p))


@traced
def lerp_of_entries(T_world_start: Pose, T_world_end: Pose, times: Times) -> Iterator[State]:
    """Yield matrices with all entries interpolated; between the ends they are no rigid motions."""
    for t in times:
        T = (1 - t) * T_world_start + t * T_world_end
        yield State(t, T)


@traced
def along_a_screw(
    T_world_start: Pose,
    T_world_end: Pose,
    times: Times,
    *,
    invert_rigid: Callable[[np.ndarray], np.ndarray],
) -> Iterator[State]:
    """Yield poses on the screw from start to end: the geodesic exp(t log) of SE(3)."""
    twist = log_se3(T_world_end @ invert_rigid(T_world_start))
    for t in times:
        T = exp_se3(t * twist) @ T_world_start
        yield State(t, T)
