"""Numbers for rotations: gradients by differences, scipy's rotations, what is continuous, and how
turns are spread.
"""

import numpy as np
import pytest
import scipy
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from workbench.geometry.motions.rotation_outputs import (
    IN_PLANE,
    IN_SPACE,
    Representation,
    degrees_apart,
    random_rotations,
    rotation_from_six,
)

ALL = [
    *((name, representation, 2) for name, representation in IN_PLANE.items()),
    *((name, representation, 3) for name, representation in IN_SPACE.items()),
]
every = pytest.mark.parametrize(
    ("representation", "d"),
    [(representation, d) for _, representation, d in ALL],
    ids=[n for n, _, _ in ALL],
)


def differences(
    representation: Representation, y: np.ndarray, slope: np.ndarray, *, h: float = 1e-6
) -> np.ndarray:
    """The gradient of sum(slope * decode(y)) by central differences."""
    gradient = np.empty_like(y)
    for k in range(y.shape[1]):
        step = h * np.eye(y.shape[1])[k]
        change = representation.decode(y + step) - representation.decode(y - step)
        gradient[:, k] = (slope * change).sum(axis=(1, 2)) / (2 * h)
    return gradient


@every
def test_every_pullback_is_that_of_differences(representation, d):
    rng = np.random.default_rng(3)
    y = rng.normal(size=(40, len(representation.start)))
    # no turn, where a rotation vector is zero and a matrix has equal singular values
    y[:4] = representation.start
    slope = rng.normal(size=(40, d, d))
    np.testing.assert_allclose(
        representation.pullback(y, slope), differences(representation, y, slope), atol=2e-7
    )


def test_rotation_vectors_have_their_gradient_up_to_half_a_turn():
    vector = IN_SPACE["axis-angle"]
    rng = np.random.default_rng(4)
    axes = rng.normal(size=(7, 3))
    y = (
        axes
        / np.linalg.norm(axes, axis=1, keepdims=True)
        * np.array([[1e-9, 1e-5, 0.999e-3, 1.001e-3, 1, 3, np.pi]]).T
    )
    slope = rng.normal(size=(7, 3, 3))
    np.testing.assert_allclose(
        vector.pullback(y, slope), differences(vector, y, slope), rtol=0, atol=2e-9
    )


@every
def test_the_numbers_of_a_rotation_mean_it_and_start_means_no_turn(representation, d):
    R, _ = random_rotations(50, d, np.pi, rng=np.random.default_rng(0))
    np.testing.assert_allclose(representation.decode(representation.numbers(R)), R, atol=1e-12)
    np.testing.assert_array_equal(representation.decode(representation.start[None])[0], np.eye(d))


@every
def test_whatever_is_put_out_means_a_rotation(representation, d):
    R = representation.decode(
        3 * np.random.default_rng(1).normal(size=(60, len(representation.start)))
    )
    np.testing.assert_allclose(R @ R.swapaxes(1, 2), np.tile(np.eye(d), (60, 1, 1)), atol=1e-12)
    np.testing.assert_allclose(np.linalg.det(R), 1, atol=1e-12)


def test_they_mean_what_scipy_says():
    y = np.random.default_rng(2).normal(size=(30, 4))
    vectors = y[:, :3]
    np.testing.assert_allclose(
        IN_SPACE["quaternion"].decode(y),
        Rotation.from_quat(y[:, [1, 2, 3, 0]]).as_matrix(),
        atol=1e-13,
    )
    np.testing.assert_allclose(
        IN_SPACE["axis-angle"].decode(vectors),
        Rotation.from_rotvec(vectors).as_matrix(),
        atol=1e-13,
    )
    np.testing.assert_allclose(
        IN_SPACE["Euler"].decode(vectors),
        Rotation.from_euler("xyz", vectors).as_matrix(),
        atol=1e-13,
    )


@given(st.integers(0, 10_000), st.floats(0.01, 100), st.floats(0.01, 100))
def test_lengths_do_not_matter_and_a_turn_of_both_vectors_turns_the_result(seed, first, second):
    rng = np.random.default_rng(seed)
    y = rng.normal(size=(5, 6))
    Q = Rotation.random(random_state=seed).as_matrix()
    R = rotation_from_six(y)
    np.testing.assert_allclose(rotation_from_six(y * np.repeat([first, second], 3)), R, atol=1e-9)
    turned = np.concatenate([y[:, :3] @ Q.T, y[:, 3:] @ Q.T], axis=1)
    np.testing.assert_allclose(rotation_from_six(turned), Q @ R, atol=1e-9)


def test_vectors_that_span_no_plane_give_what_is_not_finite():
    y = np.array([[0.0, 0, 0, 1, 0, 0], [1, 0, 0, 0, 0, 0], [1, 2, 3, 2, 4, 6]])
    with np.errstate(all="ignore"):
        R = rotation_from_six(y)
    assert not np.isfinite(R[:2]).all(axis=(1, 2)).any()
    assert degrees_apart(np.full((1, 3, 3), np.nan), np.eye(3)[None])[0] == 180


def test_only_vectors_of_unit_length_columns_and_entries_are_continuous():
    """Two rotations a hundredth of a degree apart, to either side of half a turn: their numbers are
    near, or far.
    """
    near = np.radians(179.995)
    flat = np.stack(
        [np.array([[np.cos(a), -np.sin(a)], [np.sin(a), np.cos(a)]]) for a in (near, -near)]
    )
    axes = np.eye(3)[2]
    solid = Rotation.from_rotvec([near * axes, -near * axes]).as_matrix()
    jumps = {
        name: np.abs(np.diff(representation.numbers(flat if d == 2 else solid), axis=0)).max()
        for name, representation, d in ALL
    }
    assert {name for name, jump in jumps.items() if jump < 1e-3} == {"cosine and sine", "6D", "9D"}
    assert min(jump for jump in jumps.values() if jump > 1e-3) > 1.9


def test_angles_between_rotations_are_those_of_scipy():
    R, other = (random_rotations(100, 3, np.pi, rng=np.random.default_rng(k))[0] for k in (5, 6))
    theirs = np.degrees((Rotation.from_matrix(R) * Rotation.from_matrix(other).inv()).magnitude())
    np.testing.assert_allclose(degrees_apart(R, other), theirs, atol=1e-5)
    np.testing.assert_allclose(degrees_apart(R, R), 0, atol=1e-6)
    a = np.array([-3.0, -1, 0, 0.5, 3])
    flat = IN_PLANE["one number"].decode(a[:, None])
    expected = np.degrees(np.abs((a - 0.5 + np.pi) % (2 * np.pi) - np.pi))
    np.testing.assert_allclose(degrees_apart(flat, flat[[3] * 5]), expected, atol=1e-6)


@pytest.mark.parametrize("largest", [0.5, 2.0, np.pi])
def test_turns_are_spread_as_all_rotations_are(largest):
    R, w = random_rotations(4000, 3, largest, rng=np.random.default_rng(7))
    np.testing.assert_allclose(R, Rotation.from_rotvec(w).as_matrix(), atol=1e-12)
    a = np.linalg.norm(w, axis=1)
    assert a.max() <= largest
    theirs = Rotation.random(40_000, random_state=8).magnitude()
    assert scipy.stats.ks_2samp(a, theirs[theirs <= largest]).pvalue > 0.01
    np.testing.assert_allclose((w / a[:, None]).mean(axis=0), 0, atol=0.04)
    flat, a = random_rotations(500, 2, largest, rng=np.random.default_rng(7))
    assert np.abs(a).max() <= largest
    np.testing.assert_allclose(flat[:, :, 0], np.column_stack([np.cos(a), np.sin(a)]))
