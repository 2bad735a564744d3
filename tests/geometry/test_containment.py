"""Inside tests: rays and solid angles agree, edges and corners decide for one face, overlaps count
twice.
"""

import numpy as np
import pytest

from lessons.measures.measurables import sphere, two_spheres
from workbench.data.shapes.rabbit import rabbit_mesh
from workbench.data.shapes.solids import box
from workbench.geometry.meshes.containment import (
    columns,
    crossings,
    inside,
    winding_numbers,
    windings,
)

RABBIT = rabbit_mesh(0.05)


def around(p: np.ndarray, n: int, seed: int) -> np.ndarray:
    return np.random.default_rng(seed).uniform(p.min(axis=0) - 0.1, p.max(axis=0) + 0.1, (n, 3))


def test_rays_and_solid_angles_agree():
    p, faces = RABBIT
    q = around(p, 500, 0)
    by_rays = windings(columns(p, faces), q)
    by_angles = winding_numbers(p, faces, q)
    np.testing.assert_allclose(by_angles, by_rays, atol=1e-9)
    assert 0.1 < by_rays.mean() < 0.5
    assert set(by_rays.tolist()) == {0, 1}


def test_turned_inside_out_the_winding_is_negative_and_inside_stays():
    p, faces = RABBIT
    q = around(p, 300, 1)
    np.testing.assert_array_equal(
        windings(columns(p, faces[:, ::-1]), q), -windings(columns(p, faces), q)
    )
    np.testing.assert_array_equal(inside(p, faces[:, ::-1], q), inside(p, faces, q))


def test_overlapping_spheres_wind_twice_and_are_one_solid():
    two = two_spheres(3)
    q = around(two_spheres(3).p, 4000, 2)
    numbers = windings(columns(two.p, two.faces), q)
    assert set(numbers.tolist()) == {0, 1, 2}
    far = np.abs(np.linalg.norm(np.abs(q) * [1, 1, 1] - [0.5, 0, 0], axis=1) - 1) > 0.02
    assert two.inside is not None
    np.testing.assert_array_equal((numbers != 0)[far], two.inside(q)[far])


def test_rays_through_corners_edges_and_upright_faces_are_counted_once():
    cube = box((2.0, 2.0, 2.0))
    ticks = np.linspace(-1.5, 1.5, 13)  # the cube's own edges, its diagonals and walls among them
    q = np.stack(np.meshgrid(ticks, ticks, [-0.5, 0.5, 1.5, 2.5], indexing="ij"), axis=-1).reshape(
        -1, 3
    )
    numbers = windings(columns(cube.p, cube.faces), q)
    assert set(numbers.tolist()) == {0, 1}
    strictly = (np.abs(q[:, :2]) < 1).all(axis=1) & (q[:, 2] > 0) & (q[:, 2] < 2)
    outside = (np.abs(q[:, :2]) > 1).any(axis=1) | (q[:, 2] < 0) | (q[:, 2] > 2)
    assert (numbers[strictly] == 1).all()
    assert (numbers[outside] == 0).all()


def test_every_vertical_line_through_vertices_leaves_as_often_as_it_enters():
    ball = sphere(2)
    below = ball.p * [1, 1, 0] - [0, 0, 5]
    assert (windings(columns(ball.p, ball.faces), below) == 0).all()


def test_the_height_of_a_crossing_lies_on_the_face():
    corners = np.array([[[0.0, 0, 1], [2, 0, 3], [0, 2, 1]]])
    sign, height = crossings(corners, np.array([[0.5, 0.5]]))
    assert (sign[0], height[0]) == (1, pytest.approx(1.5))
    assert crossings(corners[:, ::-1], np.array([[0.5, 0.5]]))[0][0] == -1
    assert crossings(corners, np.array([[1.5, 1.5]]))[0][0] == 0


def test_points_beyond_the_mesh_and_no_points_at_all():
    p, faces = RABBIT
    assert not inside(p, faces, np.full((3, 3), 99.0)).any()
    assert len(inside(p, faces, np.empty((0, 3)))) == 0


def test_a_hole_leaves_the_generalised_winding_number_smooth():
    ball = sphere(3)
    with_hole = ball.faces[20:]
    assert winding_numbers(ball.p, with_hole, np.zeros((1, 3)))[0] == pytest.approx(
        1 - 20 / 1280, abs=2e-3
    )


@pytest.mark.parametrize("name", ["curvature/bunny.off", "shapes/bunny_npm.ply"])
def test_a_scan_agrees_with_solid_angles(shared_data, name):
    from workbench.data.files import read_mesh

    p, faces = read_mesh(shared_data / name)
    q = (
        around(p, 60, 3)
        if np.ptp(p) > 1
        else np.random.default_rng(3).uniform(p.min(axis=0), p.max(axis=0), (60, 3))
    )
    np.testing.assert_allclose(
        winding_numbers(p, faces, q), windings(columns(p, faces), q), atol=0.02
    )
