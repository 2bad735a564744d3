import numpy as np
import pytest
import scipy
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from workbench.geometry.motions import exp_so3, log_so3, rotation_angle
from workbench.geometry.motions.rotations import (
    EULER_ORDERS,
    axis_angle_from_rotation,
    euler_axes,
    euler_to_matrix,
    gimbal_margin,
    great_circle,
    locked_family,
    matrix_from_quaternion,
    matrix_to_euler,
    other_triple,
    quaternion_from_matrix,
    quaternion_product,
    rotation_about,
    rotation_from_axis_angle,
    slerp,
)

settings.register_profile("few", max_examples=50, deadline=None)
settings.load_profile("few")

angle = st.floats(-np.pi, np.pi)
triples = st.tuples(angle, angle, angle).map(np.array)
# Rotations near the identity and near half a turn are where formulas break: they are drawn on
# purpose.
sizes = st.one_of(
    st.floats(0, 1e-6), st.floats(1e-6, np.pi), st.floats(0, 1e-6).map(lambda e: np.pi - e)
)
directions = (
    st.tuples(*[st.floats(-1, 1)] * 3).map(np.array).filter(lambda v: np.linalg.norm(v) > 1e-3)
)
rotations = st.builds(rotation_from_axis_angle, directions, sizes)
orders = st.sampled_from(EULER_ORDERS)


def locked(order: str) -> list[float]:
    return [0.0, np.pi] if order[0].lower() == order[2].lower() else [-np.pi / 2, np.pi / 2]


def test_there_are_24_different_orders():
    assert len(set(EULER_ORDERS)) == 24
    angles = np.array([0.3, 0.5, 0.7])
    matrices = [euler_to_matrix(angles, order) for order in EULER_ORDERS]
    different = [np.abs(a - b).max() for i, a in enumerate(matrices) for b in matrices[:i]]
    assert min(different) > 0.02


@given(triples, orders)
def test_euler_agrees_with_scipy(angles, order):
    np.testing.assert_allclose(
        euler_to_matrix(angles, order), Rotation.from_euler(order, angles).as_matrix(), atol=1e-14
    )


@pytest.mark.parametrize("order", EULER_ORDERS)
@given(triples)
@settings(max_examples=10)
def test_euler_angles_agree_with_scipy_away_from_lock(order, angles):
    R = euler_to_matrix(angles, order)
    recovered = matrix_to_euler(R, order)
    np.testing.assert_allclose(euler_to_matrix(recovered, order), R, atol=2e-12)
    if gimbal_margin(angles, order) > 1e-3:
        difference = recovered - Rotation.from_matrix(R).as_euler(order)
        # -pi and pi are one angle
        np.testing.assert_allclose(np.sin(difference / 2), 0, atol=1e-10)


@pytest.mark.parametrize("order", EULER_ORDERS)
@pytest.mark.parametrize("off", [0.0, 1e-15, 1e-13, 2e-12, 3e-8, 1e-4])
def test_the_rotation_survives_in_and_near_gimbal_lock(order, off):
    for middle in locked(order):
        for outer in ([0.4, 1.9], [-2.5, 0.3], [0.0, 0.0], [3.0, -3.0]):
            R = euler_to_matrix(np.array([outer[0], middle + off, outer[1]]), order)
            recovered = matrix_to_euler(R, order)
            np.testing.assert_allclose(euler_to_matrix(recovered, order), R, atol=1e-12)
            if off == 0.0:
                assert recovered[2] == 0.0


@given(st.tuples(angle, angle), orders, st.floats(-3, 3))
def test_a_whole_family_of_triples_is_one_rotation_in_lock(outer, order, turn):
    for middle in locked(order):
        angles = np.array([outer[0], middle, outer[1]])
        R = euler_to_matrix(angles, order)
        for triple in locked_family(angles, order, np.array([turn, 0.0])):
            np.testing.assert_allclose(euler_to_matrix(triple, order), R, atol=1e-14)


@given(triples, orders)
def test_every_rotation_has_two_triples(angles, order):
    other = other_triple(angles, order)
    np.testing.assert_allclose(
        euler_to_matrix(other, order), euler_to_matrix(angles, order), atol=1e-14
    )
    assert np.abs(other - angles).max() > 3


def test_there_is_no_family_outside_of_lock():
    with pytest.raises(ValueError, match="not in gimbal lock"):
        locked_family(np.array([0.1, 0.2, 0.3]), "xyz", np.array([1.0]))


@given(triples, orders)
def test_euler_axes_are_the_derivatives_of_the_rotation(angles, order):
    R = euler_to_matrix(angles, order)
    h = 1e-6
    for k, axis in enumerate(euler_axes(angles, order)):
        nudged = euler_to_matrix(angles + h * np.eye(3)[k], order)
        np.testing.assert_allclose(log_so3(nudged @ R.T) / h, axis, atol=1e-8)


@pytest.mark.parametrize(
    ("order", "middle", "margin"),
    [("xyz", 90, 0.0), ("XYZ", 0, 1.0), ("zxz", 0, 0.0), ("ZXZ", 30, 0.5)],
)
def test_gimbal_margin(order, middle, margin):
    angles = np.radians([20.0, middle, -50.0])
    assert gimbal_margin(angles, order) == pytest.approx(margin, abs=1e-12)
    assert np.linalg.matrix_rank(euler_axes(angles, order), tol=1e-9) == (2 if margin == 0 else 3)


@given(triples)
def test_extrinsic_is_intrinsic_read_backwards(angles):
    np.testing.assert_allclose(
        euler_to_matrix(angles, "xyz"), euler_to_matrix(angles[::-1], "ZYX"), atol=1e-15
    )


def test_turning_about_the_bodys_own_axis_multiplies_on_the_right():
    a, b = 0.4, 1.1
    own = euler_to_matrix(np.array([a, b, 0.0]), "XYZ")
    np.testing.assert_allclose(own, rotation_about("x", a) @ rotation_about("y", b), atol=1e-15)
    fixed = euler_to_matrix(np.array([a, b, 0.0]), "xyz")
    np.testing.assert_allclose(fixed, rotation_about("y", b) @ rotation_about("x", a), atol=1e-15)


@pytest.mark.parametrize("order", ["", "xx", "xxy", "xyZ", "abc", "wxyz"])
def test_unknown_orders_are_refused(order):
    from workbench.geometry.motions.rotations import _letters

    with pytest.raises(ValueError, match="not an Euler order"):
        _letters(order)


@given(directions, st.floats(-20, 20))
def test_rodrigues_is_the_matrix_exponential(axis, turn):
    n = axis / np.linalg.norm(axis)
    N = np.array([[0, -n[2], n[1]], [n[2], 0, -n[0]], [-n[1], n[0], 0]])
    np.testing.assert_allclose(
        rotation_from_axis_angle(axis, turn), scipy.linalg.expm(turn * N), atol=1e-12
    )


@given(directions, sizes, st.floats(0.1, 1e6))
def test_the_length_of_the_axis_does_not_matter(axis, turn, length):
    np.testing.assert_allclose(
        rotation_from_axis_angle(axis * length, turn),
        rotation_from_axis_angle(axis, turn),
        atol=1e-14,
    )


@given(rotations)
def test_axis_and_angle_there_and_back(R):
    axis, turn = axis_angle_from_rotation(R)
    assert np.linalg.norm(axis) == pytest.approx(1.0)
    assert turn == pytest.approx(rotation_angle(R), abs=1e-14)
    np.testing.assert_allclose(rotation_from_axis_angle(axis, turn), R, atol=1e-14)
    np.testing.assert_allclose(R @ axis, axis, atol=1e-13)


def test_the_identity_has_an_axis_too():
    axis, turn = axis_angle_from_rotation(np.eye(3))
    assert turn == 0.0
    assert np.linalg.norm(axis) == 1.0


@pytest.mark.parametrize("axis", [[0.0, 0, 0], [np.nan, 0, 1], [np.inf, 0, 0]])
def test_an_axis_without_direction_is_refused(axis):
    with pytest.raises(ValueError, match="names no direction"):
        rotation_from_axis_angle(np.array(axis), 1.0)


@given(rotations)
def test_quaternion_there_and_back(R):
    q = quaternion_from_matrix(R)
    assert q[0] >= 0
    assert np.linalg.norm(q) == pytest.approx(1.0, abs=1e-14)
    np.testing.assert_allclose(matrix_from_quaternion(q), R, atol=1e-14)
    np.testing.assert_allclose(matrix_from_quaternion(-3.0 * q), R, atol=1e-14)
    np.testing.assert_allclose(
        matrix_from_quaternion(q), Rotation.from_quat(q, scalar_first=True).as_matrix(), atol=1e-14
    )


def test_the_quaternion_of_half_a_turn_has_no_negative_w():
    rng = np.random.default_rng(5)
    for axis in rng.normal(size=(200, 3)):
        assert quaternion_from_matrix(rotation_from_axis_angle(axis, np.pi))[0] >= 0


@given(rotations, rotations)
def test_quaternions_multiply_as_rotations_do(A, B):
    q = quaternion_product(quaternion_from_matrix(A), quaternion_from_matrix(B))
    np.testing.assert_allclose(matrix_from_quaternion(q), A @ B, atol=1e-13)


@pytest.mark.parametrize("q", [[0.0, 0, 0, 0], [np.nan, 0, 0, 1]])
def test_a_quaternion_without_direction_is_refused(q):
    with pytest.raises(ValueError, match="names no rotation"):
        matrix_from_quaternion(np.array(q))


@given(rotations, rotations, st.floats(0, 1))
def test_slerp_turns_about_one_axis_at_constant_speed(A, B, t):
    R = matrix_from_quaternion(slerp(quaternion_from_matrix(A), quaternion_from_matrix(B), t))
    w = log_so3(A.T @ B)
    if np.linalg.norm(w) < np.pi - 1e-6:  # half a turn may go either way
        np.testing.assert_allclose(R, A @ exp_so3(t * w), atol=1e-9)
    assert rotation_angle(A.T @ R) == pytest.approx(t * rotation_angle(A.T @ B), abs=1e-9)


def test_slerp_agrees_with_scipy():
    rng = np.random.default_rng(3)
    times = np.linspace(0, 1, 7)
    for _ in range(20):
        ends = Rotation.random(2, rng=rng)
        a, b = ends.as_quat(scalar_first=True)
        expected = scipy.spatial.transform.Slerp([0, 1], ends)(times).as_matrix()
        np.testing.assert_allclose(
            [matrix_from_quaternion(slerp(a, b, t)) for t in times], expected, atol=1e-13
        )


@given(rotations, rotations)
def test_slerp_does_not_care_for_the_sign_but_the_great_circle_does(A, B):
    p, q = quaternion_from_matrix(A), quaternion_from_matrix(B)
    if abs(p @ q) > 1e-3:
        np.testing.assert_allclose(
            matrix_from_quaternion(slerp(p, -q, 0.3)),
            matrix_from_quaternion(slerp(p, q, 0.3)),
            atol=1e-12,
        )
    turn = 2 * np.arccos(np.clip(p @ q, -1, 1))
    turned = [
        rotation_angle(A.T @ matrix_from_quaternion(great_circle(p, -q, t))) for t in (0.25, 0.5)
    ]
    if 0.1 < turn < np.pi:
        assert turned[0] == pytest.approx(0.25 * (2 * np.pi - turn), abs=1e-9)


def test_opposite_quaternions_have_no_arc():
    q = np.array([0.0, 0.6, 0.0, 0.8])
    np.testing.assert_array_equal(great_circle(q, -q, 0.5), q)
    np.testing.assert_allclose(great_circle(q, q, 0.5), q, atol=1e-15)
