import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from workbench.geometry.motions import apply
from workbench.geometry.motions.affine import (
    Kind,
    from_homogeneous,
    homogeneous,
    kind_of,
    perspective,
    reflection,
    rotation,
    scaling,
    shear,
    transform,
    transform_directions,
    translation,
)

few = settings(max_examples=40, deadline=None)
number = st.floats(-3, 3)
vectors = st.tuples(number, number, number).map(np.array)
matrices = st.lists(number, min_size=9, max_size=9).map(lambda row: np.array(row).reshape(3, 3))
far = vectors.filter(lambda v: np.linalg.norm(v) > 0.1)
P = np.random.default_rng(1).normal(size=(20, 3))


def test_each_factor_does_what_it_says():
    np.testing.assert_allclose(
        transform(translation(np.array([1.0, 2, 3])), P), P + np.array([1.0, 2, 3])
    )
    np.testing.assert_allclose(transform(scaling(np.array([2.0, 3, -1])), P), P * [2, 3, -1])
    np.testing.assert_allclose(transform(shear("x", "z", 0.5), P), P + 0.5 * P[:, 2:] * [1, 0, 0])
    np.testing.assert_allclose(
        transform(rotation("z", np.pi / 2), P), P[:, [1, 0, 2]] * [-1, 1, 1], atol=1e-15
    )
    np.testing.assert_allclose(transform(reflection(np.array([0.0, 7.0, 0.0])), P), P * [1, -1, 1])


@few
@given(far)
def test_a_reflection_undoes_itself_and_keeps_its_plane(normal):
    F = reflection(normal)
    np.testing.assert_allclose(F @ F, np.eye(4), atol=1e-14)
    assert np.linalg.det(F) == pytest.approx(-1.0)
    on_plane = np.cross(normal, P)
    np.testing.assert_allclose(transform(F, on_plane), on_plane, atol=1e-12)
    np.testing.assert_allclose(transform(F, normal[None]), -normal[None], atol=1e-12)


@few
@given(st.floats(-5, 5))
def test_shear_keeps_volume(amount):
    assert np.linalg.det(shear("y", "x", amount)) == pytest.approx(1.0)


def test_directions_do_not_feel_translation():
    T = translation(np.array([5.0, 0, 0])) @ rotation("z", 1.0)
    np.testing.assert_allclose(
        transform_directions(T, P), transform_directions(rotation("z", 1.0), P)
    )
    np.testing.assert_allclose(transform_directions(T, P), (homogeneous(P, 0.0) @ T.T)[:, :3])
    np.testing.assert_allclose(
        transform(T, P[1:]) - transform(T, P[:-1]), transform_directions(T, P[1:] - P[:-1])
    )


def test_homogeneous_there_and_back():
    np.testing.assert_allclose(from_homogeneous(homogeneous(P) * 4.0), P)
    with pytest.raises(ValueError, match="row 0 has w = 0"):
        from_homogeneous(homogeneous(P, 0.0))


def test_perspective_keeps_lines_straight_and_makes_parallels_meet():
    H = perspective(np.array([0.0, 0.3, 0.1]))
    a, d = np.array([0.2, 0.1, 0.4]), np.array([0.5, 1.0, 0.2])
    line = transform(H, a + np.outer([0.0, 1.0, 2.0], d))
    np.testing.assert_allclose(np.cross(line[1] - line[0], line[2] - line[0]), 0.0, atol=1e-15)
    far_points = transform(H, np.array([a, a + 1.0]) + 1e9 * d)
    np.testing.assert_allclose(far_points, np.tile(d / ([0.0, 0.3, 0.1] @ d), (2, 1)), rtol=1e-7)


@pytest.mark.parametrize(
    ("H", "kind"),
    [
        (np.eye(4), Kind.IDENTITY),
        (rotation("x", 1e-3) @ translation(np.ones(3)), Kind.RIGID),
        (reflection(np.array([1.0, 1, 0])), Kind.MIRRORED),
        (rotation("y", 1.0) @ scaling(np.full(3, 1.01)), Kind.SIMILARITY),
        (scaling(np.array([1.0, 1, 1.01])), Kind.AFFINE),
        (scaling(np.zeros(3)), Kind.AFFINE),
        (shear("x", "y", 0.01), Kind.AFFINE),
        (perspective(np.array([0.0, 0, 0.01])), Kind.PROJECTIVE),
    ],
)
def test_kinds(H, kind):
    assert kind_of(H) is kind


def test_misuse_is_refused():
    with pytest.raises(ValueError, match="two different axes"):
        shear("x", "x", 1.0)
    with pytest.raises(ValueError, match="no mirror plane"):
        reflection(np.zeros(3))


def test_transform_of_an_affine_map_is_apply():
    A = rotation("x", 0.4) @ scaling(np.array([1.0, 2, 3])) @ translation(np.ones(3))
    np.testing.assert_allclose(transform(A, P), apply(A, P), atol=1e-14)
