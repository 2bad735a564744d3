"""Rigid motions: the laws of exp and log, at the identity and at half a turn included."""

import numpy as np
import pytest
import scipy
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from workbench.geometry.motions import (
    angle_between,
    apply,
    exp_se3,
    exp_so3,
    inverse,
    log_se3,
    log_so3,
    motion,
    rotation_angle,
    skew,
    turn_about,
    turns,
)

DIRECTIONS = arrays(float, 3, elements=st.floats(-1, 1)).filter(lambda v: np.linalg.norm(v) > 0.1)
ANGLES = st.one_of(
    st.floats(0, np.pi),
    st.floats(1e-4, 1e-2),
    st.floats(0, 1e-6),
    st.floats(0, 1e-14),
    st.floats(0, 1e-6).map(lambda a: np.pi - a),
)
SHIFTS = arrays(float, 3, elements=st.floats(-1e3, 1e3))


@st.composite
def rotation_vectors(draw):
    axis = draw(DIRECTIONS)
    return draw(ANGLES) * axis / np.linalg.norm(axis)


@st.composite
def motions(draw):
    return motion(exp_so3(draw(rotation_vectors())), draw(SHIFTS))


@settings(max_examples=40, deadline=None)
@given(rotation_vectors())
def test_exp_gives_a_rotation_as_scipy_does(w):
    R = exp_so3(w)
    np.testing.assert_allclose(R @ R.T, np.eye(3), atol=1e-14)
    assert np.linalg.det(R) == pytest.approx(1)
    np.testing.assert_allclose(
        R, scipy.spatial.transform.Rotation.from_rotvec(w).as_matrix(), atol=1e-14
    )


@settings(max_examples=40, deadline=None)
@given(rotation_vectors())
def test_log_gives_the_rotation_vector_back(w):
    back = log_so3(exp_so3(w))
    np.testing.assert_allclose(exp_so3(back), exp_so3(w), atol=1e-14)
    assert np.linalg.norm(back) <= np.pi + 1e-14
    if np.linalg.norm(w) < np.pi - 1e-7:  # at half a turn both signs are right
        np.testing.assert_allclose(back, w, rtol=1e-9, atol=1e-15)


@settings(max_examples=40, deadline=None)
@given(rotation_vectors())
def test_the_angle_is_exact_at_both_ends(w):
    assert rotation_angle(exp_so3(w)) == pytest.approx(np.linalg.norm(w), rel=1e-9, abs=1e-15)


@pytest.mark.parametrize(
    "axis", np.vstack([np.eye(3), -np.eye(3), [[1, 1, 0], [1, -1, 1], [-1, 2, -3]]])
)
def test_exactly_half_a_turn(axis):
    axis = axis / np.linalg.norm(axis)
    R = 2 * np.outer(axis, axis) - np.eye(3)
    w = log_so3(R)
    assert np.linalg.norm(w) == pytest.approx(np.pi, abs=1e-14)
    np.testing.assert_allclose(abs(w @ axis), np.pi, atol=1e-14)
    assert rotation_angle(R) == pytest.approx(np.pi, abs=1e-14)


def test_identity_has_the_zero_vector():
    assert not log_so3(np.eye(3)).any()
    assert not log_se3(np.eye(4)).any()
    np.testing.assert_array_equal(exp_se3(np.zeros(6)), np.eye(4))
    assert rotation_angle(np.eye(3)) == 0.0


@settings(max_examples=40, deadline=None)
@given(rotation_vectors(), SHIFTS)
def test_exp_of_a_twist_is_the_matrix_exponential(w, v):
    v = v / 1e3
    generator = np.zeros((4, 4))
    generator[:3, :3] = skew(w)
    generator[:3, 3] = v
    np.testing.assert_allclose(
        exp_se3(np.concatenate([v, w])), scipy.linalg.expm(generator), atol=1e-12
    )


@settings(max_examples=40, deadline=None)
@given(motions())
def test_log_of_a_motion_gives_it_back(T):
    np.testing.assert_allclose(exp_se3(log_se3(T)), T, atol=1e-10)


@settings(max_examples=40, deadline=None)
@given(motions(), motions(), arrays(float, (4, 3), elements=st.floats(-10, 10)))
def test_inverse_and_composition(T_a_b, T_b_c, p_c):
    np.testing.assert_allclose(inverse(T_a_b) @ T_a_b, np.eye(4), atol=1e-12)
    np.testing.assert_allclose(inverse(T_a_b @ T_b_c), inverse(T_b_c) @ inverse(T_a_b), atol=1e-9)
    np.testing.assert_allclose(
        apply(T_a_b @ T_b_c, p_c), apply(T_a_b, apply(T_b_c, p_c)), atol=1e-9
    )


@settings(max_examples=20, deadline=None)
@given(motions())
def test_one_point_moves_as_many_do(T):
    p = np.arange(6.0).reshape(2, 3)
    np.testing.assert_allclose(apply(T, p)[1], apply(T, p[1]), atol=1e-12)
    assert apply(T, np.empty((0, 3))).shape == (0, 3)


@given(
    w=arrays(float, 3, elements=st.floats(-3, 3)), p=arrays(float, 3, elements=st.floats(-10, 10))
)
def test_a_turn_about_a_point_leaves_it_and_turns_as_much(w, p):
    T = turn_about(p, exp_so3(w))
    np.testing.assert_allclose(apply(T, p), p, atol=1e-12)
    np.testing.assert_array_equal(T[:3, :3], exp_so3(w))


@given(turn=st.floats(0, np.pi), length=st.floats(0.01, 100))
def test_the_angle_between_vectors_does_not_depend_on_their_lengths(turn, length):
    v = np.array([2.0, 0.0, 0.0])
    w = length * np.array([np.cos(turn), 0.0, np.sin(turn)])
    assert angle_between(v, w) == pytest.approx(turn, abs=1e-12)
    assert angle_between(v, np.zeros(3)) == 0


def test_turns_are_those_of_one():
    w = np.random.default_rng(0).normal(size=(6, 3)) * [[0], [1e-9], [1e-3], [1], [2], [3]]
    np.testing.assert_allclose(turns(w), [exp_so3(vector) for vector in w], atol=1e-14)
