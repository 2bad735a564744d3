"""The stage `poses`: from one pose to another, by what runs at constant speed."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from lessons.rotations.inputs import Body, Input
from workbench.algorithms import interpolation
from workbench.algorithms.interpolation import FromEuler, Rodrigues
from workbench.geometry.motions import apply, exp_so3, inverse, motion, rotations
from workbench.geometry.motions.alignment import degrees_between, nearest_rotation


@dataclass(frozen=True, eq=False, kw_only=True)
class Way:
    """A way between two poses, as far as it has been gone.

    Attributes:
        times: 0 at the start, 1 at the end, (n,).
        path: Where the followed vertex was at these times, (n, 3).
        turned: All turning from each time to the next added up, degrees, (n,).
        volume: Of the body, over its volume at the start; negative where it is mirrored, (n,).
    """

    times: np.ndarray
    path: np.ndarray
    turned: np.ndarray
    volume: np.ndarray


@dataclass(frozen=True, eq=False, kw_only=True)
class Moved:
    """One time between two poses.

    Attributes:
        T_world_start, T_world_end: The two poses.
        T_world_body: The body now; for matrix entries an affine map.
        T_world_before: The body one step earlier; at the start where it is.
        T_world_shortest: Where slerp and lerp have it now.
        way, shortest: The way taken up to now, and all of the way of slerp and lerp.
        off: The angle to the shortest turn's body, degrees.
    """

    T_world_start: np.ndarray
    T_world_end: np.ndarray
    T_world_body: np.ndarray
    T_world_before: np.ndarray
    T_world_shortest: np.ndarray
    way: Way
    shortest: Way
    off: float

    @property
    def t(self) -> float:
        """The time now."""
        return float(self.way.times[-1])

    @property
    def volume(self) -> float:
        """The body's volume now, over its volume at the start."""
        return float(self.way.volume[-1])


def move(
    params: Input, body: Body, *, rotation_from_axis_angle: Rodrigues, euler_to_matrix: FromEuler
) -> Iterator[Moved]:
    """Yield the body at every time between the two poses."""
    times = np.linspace(0.0, 1.0, params.steps + 1)
    angles = np.radians(params.angles)
    angles_end = np.radians(params.angles_end)
    R_end = euler_to_matrix(angles_end, params.order)
    turn = np.array(params.pose[3:], float)
    if turn.any():  # the handle turns the end further, so that other angles make it
        R_end = exp_so3(turn) @ R_end
        angles_end = rotations.matrix_to_euler(nearest_rotation(R_end), params.order)
    T_start = motion(euler_to_matrix(angles, params.order), np.zeros(3))
    T_end = motion(R_end, np.array(params.pose[:3], float))
    ours = rotations.rotation_from_axis_angle
    shortest = list(
        interpolation.slerp_and_lerp(T_start, T_end, times, rotation_from_axis_angle=ours)
    )
    p = body.p_followed(params.point)
    best_way = way = Way(times=times[:0], path=np.empty((0, 3)), turned=times[:0], volume=times[:0])
    for k, state in enumerate(shortest):
        best_way = _gone(best_way, state, before=shortest[max(k - 1, 0)], p=p)
    if params.method == "slerp + lerp":
        states = interpolation.slerp_and_lerp(
            T_start, T_end, times, rotation_from_axis_angle=rotation_from_axis_angle
        )
    elif params.method == "Euler angles":
        states = interpolation.lerp_of_euler_angles(
            angles,
            angles_end,
            params.order,
            p_start=T_start[:3, 3],
            p_end=T_end[:3, 3],
            times=times,
            euler_to_matrix=euler_to_matrix,
        )
    elif params.method == "matrix entries":
        states = interpolation.lerp_of_entries(T_start, T_end, times)
    elif params.method == "slerp to -q":
        states = interpolation.slerp_to_minus_q(T_start, T_end, times)
    else:
        states = interpolation.along_a_screw(T_start, T_end, times, invert_rigid=inverse)
    before = None
    for state, best in zip(states, shortest, strict=True):
        earlier = before or state
        way = _gone(way, state, before=earlier, p=p)
        yield Moved(
            T_world_start=T_start,
            T_world_end=T_end,
            T_world_body=state.T_world_body,
            T_world_before=earlier.T_world_body,
            T_world_shortest=best.T_world_body,
            way=way,
            shortest=best_way,
            off=degrees_between(best.T_world_body, state.T_world_body),
        )
        before = state


def _gone(
    way: Way, state: interpolation.State, *, before: interpolation.State, p: np.ndarray
) -> Way:
    turned = float(way.turned[-1]) if len(way.turned) else 0.0
    turned += degrees_between(before.T_world_body, state.T_world_body)
    return Way(
        times=np.append(way.times, state.t),
        path=np.vstack([way.path, apply(state.T_world_body, p)]),
        turned=np.append(way.turned, turned),
        volume=np.append(way.volume, np.linalg.det(state.T_world_body[:3, :3])),
    )
