import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.fake import Params
from workbench.run.picking import picked, picked_params
from workbench.scene import Mesh, Picture, Points, Scalar

rng = np.random.default_rng(3)
P = rng.uniform(-1, 1, (300, 3))
EYE = np.array([0.0, -6.0, 2.0])


@given(k=st.integers(0, 299))
def test_a_ray_through_a_point_picks_a_point_on_that_ray(k):
    hit = picked(Points(P), EYE, P[k] - EYE)
    assert isinstance(hit, int)
    a, b = (P[hit] - EYE), (P[k] - EYE)
    angle = np.degrees(np.arccos(np.clip(a @ b / np.linalg.norm(a) / np.linalg.norm(b), -1, 1)))
    assert angle < 0.6
    assert np.linalg.norm(a) <= 1.05 * np.linalg.norm(b)


def test_the_vertex_in_front_wins():
    p = np.array([[0, 0, 0.0], [0, 4.0, 0], [1, 0, 0]])
    assert (
        picked(Mesh(p, np.array([[0, 1, 2]])), np.array([0, -5.0, 0]), np.array([0, 1.0, 0])) == 0
    )


def test_a_moved_cloud_is_picked_where_it_is():
    T = np.eye(4)
    T[0, 3] = 10.0
    p = np.array([[0.0, 0, 0]])
    assert picked(Points(p, T_world_object=T), EYE, np.array([10.0, 0, 0]) - EYE) == 0
    assert picked(Points(p, T_world_object=T), EYE, -EYE) is None


def test_nothing_is_picked_behind_the_eye_far_from_all_or_beside_the_scene():
    assert picked(Points(P), EYE, np.array([0, -1.0, 0])) is None
    assert picked(Points(P[:0]), EYE, -EYE) is None
    assert picked(Scalar(1.0, "a", "b"), EYE, -EYE) is None


@pytest.mark.parametrize(("u", "v"), [(0, 0), (63, 47), (10, 20)])
def test_a_click_on_a_picture_is_a_pixel(u, v):
    width = 2.0
    T = np.array([[1.0, 0, 0, 0.5], [0, 0, 1, 0.2], [0, -1, 0, 0.1], [0, 0, 0, 1]])
    picture = Picture(np.zeros((48, 64), np.uint8), width=width, T_world_object=T)
    at = np.array([(u - 31.5) * width / 64, (v - 23.5) * width / 64, 0.0])
    p_world = T[:3, :3] @ at + T[:3, 3]
    assert picked(picture, EYE, p_world - EYE) == (u, v)
    assert picked(picture, EYE, EYE - p_world) is None


def test_a_click_sets_the_field_that_names_what_was_hit():
    width = 2.0
    scene = {"plane": Picture(np.zeros((48, 64), np.uint8), width=width)}
    above = np.array([0.0, 0.0, 3.0])
    at = np.array([(12 - 31.5) * width / 64, (30 - 23.5) * width / 64, 0.0])
    assert picked_params(Params(), scene, above, v_ray=at - above) == {"pixel": (12, 30)}
    assert picked_params(Params(), scene, above, v_ray=above) == {}
    assert picked_params(Params(), {}, above, v_ray=at - above) == {}
