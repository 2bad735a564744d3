import numpy as np
import scipy
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import RigidTransform, Rotation, Slerp

from workbench.algorithms.interpolation import (
    along_a_screw,
    lerp_of_entries,
    lerp_of_euler_angles,
    slerp_and_lerp,
    slerp_to_minus_q,
)
from workbench.geometry.motions import exp_se3, inverse
from workbench.geometry.motions.rotations import euler_to_matrix, rotation_from_axis_angle

few = settings(max_examples=25, deadline=None)
poses = st.tuples(*[st.floats(-1.7, 1.7)] * 6).map(np.array).map(exp_se3)
TIMES = np.linspace(0.0, 1.0, 5)


def slerped(T_start, T_end):
    return [
        s.T_world_body
        for s in slerp_and_lerp(
            T_start, T_end, TIMES, rotation_from_axis_angle=rotation_from_axis_angle
        )
    ]


def screwed(T_start, T_end):
    return [s.T_world_body for s in along_a_screw(T_start, T_end, TIMES, invert_rigid=inverse)]


def not_half_a_turn(T_start, T_end):
    return np.trace(T_start[:3, :3].T @ T_end[:3, :3]) > -0.99


@few
@given(poses, poses)
def test_slerp_and_lerp_agree_with_scipy(T_start, T_end):
    if not_half_a_turn(T_start, T_end):
        Rs = Slerp([0, 1], Rotation.from_matrix(np.stack([T_start[:3, :3], T_end[:3, :3]])))(
            TIMES
        ).as_matrix()
        ts = T_start[:3, 3] + TIMES[:, None] * (T_end[:3, 3] - T_start[:3, 3])
        Ts = np.array(slerped(T_start, T_end))
        np.testing.assert_allclose(Ts[:, :3, :3], Rs, atol=1e-9)
        np.testing.assert_allclose(Ts[:, :3, 3], ts, atol=1e-12)


@few
@given(poses, poses)
def test_the_screw_agrees_with_scipy(T_start, T_end):
    if not_half_a_turn(T_start, T_end):
        start, end = RigidTransform.from_matrix(T_start), RigidTransform.from_matrix(T_end)
        twist = (end * start.inv()).as_exp_coords()
        Ts = [(RigidTransform.from_exp_coords(t * twist) * start).as_matrix() for t in TIMES]
        np.testing.assert_allclose(screwed(T_start, T_end), Ts, atol=1e-9)


def test_the_screw_is_the_fractional_power():
    T_start = exp_se3(np.array([1.0, 2, 3, 0.1, 0.2, 0.3]))
    T_end = exp_se3(np.array([0.0, 1, 0, 1.0, -0.5, 0.4]))
    log = scipy.linalg.logm(T_end @ np.linalg.inv(T_start))
    np.testing.assert_allclose(
        screwed(T_start, T_end),
        [np.real(scipy.linalg.expm(t * log)) @ T_start for t in TIMES],
        atol=1e-12,
    )


@few
@given(poses, poses, poses)
def test_moving_the_world_moves_the_way(T_start, T_end, T_other_world):
    for way in (slerped, screwed):
        if not_half_a_turn(T_start, T_end):
            moved = way(T_other_world @ T_start, T_other_world @ T_end)
            np.testing.assert_allclose(
                moved, T_other_world @ np.array(way(T_start, T_end)), atol=1e-8
            )


@few
@given(poses, poses)
def test_a_way_and_back_is_one_way(T_start, T_end):
    for way in (slerped, screwed):
        if not_half_a_turn(T_start, T_end):
            np.testing.assert_allclose(way(T_end, T_start)[::-1], way(T_start, T_end), atol=1e-8)


@few
@given(poses, poses)
def test_every_way_ends_at_the_end(T_start, T_end):
    for way in (lerp_of_entries(T_start, T_end, TIMES), slerp_to_minus_q(T_start, T_end, TIMES)):
        first, *_, last = (state.T_world_body for state in way)
        np.testing.assert_allclose(first, T_start, atol=1e-12)
        np.testing.assert_allclose(last, T_end, atol=1e-12)


def test_one_euler_angle_alone_is_slerp():
    zero = np.zeros(3)
    angles = np.array([0.0, 0.0, 2.0])
    states = lerp_of_euler_angles(
        zero, angles, "xyz", p_start=zero, p_end=zero, times=TIMES, euler_to_matrix=euler_to_matrix
    )
    T_end = np.eye(4)
    T_end[:3, :3] = euler_to_matrix(angles, "xyz")
    np.testing.assert_allclose(
        [s.T_world_body for s in states], slerped(np.eye(4), T_end), atol=1e-14
    )


def test_poses_that_are_the_same_stay():
    T = exp_se3(np.array([1.0, 2, 3, 0.1, 0.2, 0.3]))
    for way in (slerped, screwed):
        np.testing.assert_allclose(way(T, T), np.broadcast_to(T, (5, 4, 4)), atol=1e-14)
