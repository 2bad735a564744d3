"""Energies of meshes: gradients by differences, and trimesh's neighbours and angles."""

import numpy as np
import pytest
import trimesh

from tests.geometry.mesh_zoo import CUBE, random_closed, strip
from workbench.data.shapes.surfaces import sphere
from workbench.geometry.meshes import edges
from workbench.geometry.meshes.mesh_energies import (
    edge_energy,
    face_pairs,
    fold_angles,
    laplacian_energy,
    normal_energy,
    scattered,
    umbrella,
)


def energies(p: np.ndarray, faces: np.ndarray) -> dict[str, tuple[float, np.ndarray]]:
    return {
        "laplacian": laplacian_energy(p, umbrella(faces, len(p))),
        "edge": edge_energy(p, edges(faces)),
        "normal": normal_energy(p, faces, face_pairs(faces)),
    }


@pytest.mark.parametrize("name", ["laplacian", "edge", "normal"])
@pytest.mark.parametrize("mesh", ["closed", "open"])
def test_gradients_are_those_of_differences(name, mesh):
    rng = np.random.default_rng(1)
    p, faces = random_closed(rng, 40) if mesh == "closed" else strip(6)
    p = p + 0.1 * rng.normal(size=p.shape)
    slope = energies(p, faces)[name][1]
    for i, axis in [
        (int(i), int(axis)) for i in rng.choice(len(p), 8, replace=False) for axis in range(3)
    ]:
        step = np.zeros_like(p)
        step[i, axis] = 1e-6
        ahead, behind = (energies(p + sign * step, faces)[name][0] for sign in (1, -1))
        assert slope[i, axis] == pytest.approx((ahead - behind) / 2e-6, abs=1e-8)


def test_energies_do_not_change_when_all_moves_and_their_gradients_add_up_to_nothing():
    p, faces = random_closed(np.random.default_rng(2), 60)
    moved = p[:, [1, 2, 0]] + [3.0, -1, 2]  # a third of a turn about (1, 1, 1)
    for name, (value, slope) in energies(p, faces).items():
        value_there, slope_there = energies(moved, faces)[name]
        assert value_there == pytest.approx(value)
        np.testing.assert_allclose(slope_there, slope[:, [1, 2, 0]], atol=1e-12)
        np.testing.assert_allclose(slope.sum(axis=0), 0, atol=1e-12)


def test_the_laplacian_is_the_mean_of_neighbours_minus_itself():
    p, faces = random_closed(np.random.default_rng(3), 50)
    mesh = trimesh.Trimesh(p, faces, process=False)
    expected = np.array([p[mesh.vertex_neighbors[i]].mean(axis=0) - p[i] for i in range(len(p))])
    np.testing.assert_allclose(umbrella(faces, len(p)) @ p, expected, atol=1e-12)
    assert np.all((umbrella(faces, len(p) + 1) @ np.ones(len(p) + 1))[:-1] == pytest.approx(0))


def test_folds_and_pairs_are_those_of_trimesh():
    p, faces = random_closed(np.random.default_rng(4), 50)
    mesh = trimesh.Trimesh(p, faces, process=False)
    pairs = face_pairs(faces)
    theirs = dict(
        zip(map(frozenset, mesh.face_adjacency.tolist()), mesh.face_adjacency_angles, strict=True)
    )
    angles = fold_angles(p, faces, pairs)
    assert len(pairs) == len(theirs)
    np.testing.assert_allclose(
        angles, [theirs[frozenset(pair)] for pair in pairs.tolist()], atol=1e-7
    )
    assert normal_energy(p, faces, pairs)[0] == pytest.approx((1 - np.cos(angles)).mean())


def test_a_cube_and_a_flat_strip():
    p, faces = CUBE
    angles = fold_angles(p, faces, face_pairs(faces))
    assert sorted(np.rint(np.degrees(angles)).tolist()) == [0] * 6 + [90] * 12
    p, faces = strip(5)
    assert normal_energy(p, faces, face_pairs(faces))[0] == pytest.approx(0)
    assert len(face_pairs(faces)) == 9  # those of the border have one face
    pairs = face_pairs(np.array([[0, 1, 2], [1, 0, 3]]))
    back = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 1, 1e-9]])
    assert fold_angles(back, np.array([[0, 1, 2], [1, 0, 3]]), pairs)[0] == pytest.approx(
        np.pi, abs=1e-6
    )


def test_a_face_without_area_moves_nothing():
    p, faces = strip(3)
    p[1] = p[0]
    value, slope = normal_energy(p, faces, face_pairs(faces))
    assert np.isfinite(value)
    assert np.abs(slope).max() < 10


def test_a_refined_ball_loses_energy():
    values = [energies(sphere(count).p, sphere(count).faces) for count in (42, 162, 642)]
    for name in ("laplacian", "edge", "normal"):
        assert values[0][name][0] > values[1][name][0] > values[2][name][0] > 0


def test_what_is_scattered_is_added_where_rows_repeat():
    rows = np.array([2, 0, 2, 2])
    values = np.arange(12.0).reshape(4, 3)
    expected = np.zeros((5, 3))
    np.add.at(expected, rows, values)
    np.testing.assert_array_equal(scattered(values, rows, 5), expected)
