"""Mending keeps the surface: the same triangles at the same places, now a mesh that can be
measured.
"""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.geometry.mesh_zoo import CUBE, TETRAHEDRON, random_closed, strip
from workbench.errors import InputError
from workbench.geometry.meshes import check_mesh, edges, euler_characteristic, face_areas
from workbench.geometry.meshes.curvature import gauss_bonnet
from workbench.geometry.meshes.repair import oriented, split_where_sheets_touch, without_repeats

few = settings(max_examples=15, deadline=None)


def touching(mesh, at, times):
    """Copies of a closed mesh that share one vertex only."""
    p, faces = mesh
    others = np.delete(np.arange(len(p)), at)
    name = np.zeros(len(p), dtype=int)
    placed = [p[[at]]]
    named = []
    for k in range(times):
        name[others] = 1 + k * len(others) + np.arange(len(others))
        placed.append(p[at] + (k + 1.0) * (p[others] - p[at]))
        named.append(name[faces])
    return np.concatenate(placed), np.concatenate(named)


@pytest.mark.parametrize("times", [2, 3])
def test_sheets_that_touch_get_a_vertex_each(times):
    p, faces = touching(TETRAHEDRON, 2, times)
    with pytest.raises(InputError, match="only touch"):
        check_mesh(p, faces)
    split, renamed = split_where_sheets_touch(p, faces)
    check_mesh(split, renamed)
    assert len(split) == len(p) + times - 1
    np.testing.assert_array_equal(split[renamed], p[faces])
    assert euler_characteristic(renamed) == 2 * times
    assert gauss_bonnet(split, renamed)[0] == pytest.approx(4 * np.pi * times)


def test_open_sheets_that_touch_are_split_too():
    p = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [-1, 0, 0], [0, -1, 0.0]])
    split, renamed = split_where_sheets_touch(p, np.array([[0, 1, 2], [0, 3, 4]]))
    check_mesh(split, renamed)
    assert len(split) == 6


@few
@given(st.integers(0, 10_000))
def test_a_good_mesh_stays_as_it_is(seed):
    p, faces = random_closed(np.random.default_rng(seed), 20)
    split, renamed = split_where_sheets_touch(p, faces)
    np.testing.assert_array_equal(split, p)
    np.testing.assert_array_equal(renamed, faces)
    np.testing.assert_array_equal(oriented(faces), faces)
    np.testing.assert_array_equal(without_repeats(faces), faces)


@few
@given(st.integers(0, 10_000), st.integers(1, 15))
def test_turned_faces_are_turned_back(seed, turned):
    rng = np.random.default_rng(seed)
    p, faces = random_closed(rng, 30)  # 56 faces
    mixed = faces.copy()
    some = rng.permutation(len(faces))[:turned]
    mixed[some] = mixed[some][:, ::-1]
    again = oriented(mixed)
    check_mesh(p, again)
    signed = np.einsum("fx,fx->", p[again[:, 0]], np.cross(p[again[:, 1]], p[again[:, 2]]))
    assert signed > 0  # the side of most faces


def test_each_piece_keeps_the_side_of_most_of_its_faces():
    cube = np.vstack([CUBE[1][:10], CUBE[1][10:, ::-1]])
    strange = np.vstack([cube, 8 + CUBE[1][:, ::-1]])
    p = np.vstack([CUBE[0], CUBE[0] + 3])
    again = oriented(strange)
    check_mesh(p, again)
    assert set(map(tuple, np.sort(again, axis=1))) == set(map(tuple, np.sort(strange, axis=1)))
    np.testing.assert_array_equal(again[:10], CUBE[1][:10])
    np.testing.assert_array_equal(again[12:], strange[12:])


def test_half_and_half_is_mended_as_well():
    p, faces = strip(2)
    mixed = np.vstack([faces[:2], faces[2:, ::-1]])
    check_mesh(p, oriented(mixed))


def test_a_moebius_strip_is_left_and_refused():
    turn = 2 * np.pi * np.arange(8) / 8
    across = np.stack(
        [np.cos(turn / 2) * np.cos(turn), np.cos(turn / 2) * np.sin(turn), np.sin(turn / 2)], 1
    )
    middle = np.stack([np.cos(turn), np.sin(turn), 0 * turn], 1)
    p = np.vstack([middle - 0.3 * across, middle + 0.3 * across])
    i = np.arange(7)
    j = np.arange(1, 8)
    faces = np.concatenate(
        [np.stack([i, j, j + 8], 1), np.stack([i, j + 8, i + 8], 1), [[7, 8, 0], [7, 0, 15]]]
    )
    assert len(edges(faces)) == 32
    np.testing.assert_array_equal(oriented(faces), faces)
    np.testing.assert_array_equal(split_where_sheets_touch(p, faces)[1], faces)
    with pytest.raises(InputError, match="which side is outside"):
        check_mesh(p, oriented(faces))


def test_three_faces_at_an_edge_are_left():
    faces = np.array([[0, 1, 2], [1, 0, 3], [0, 1, 4]])
    np.testing.assert_array_equal(oriented(faces), faces)


def test_a_face_listed_twice_counts_once_whatever_corner_it_starts_with():
    p, faces = TETRAHEDRON
    twice = np.vstack([faces, np.roll(faces[:2], 1, axis=1), faces[2:3]])
    np.testing.assert_array_equal(without_repeats(twice), faces)
    assert face_areas(p, without_repeats(twice)).sum() == pytest.approx(face_areas(p, faces).sum())
    turned = np.vstack([faces, faces[:1, ::-1]])  # the other side of a sheet is another face
    np.testing.assert_array_equal(without_repeats(turned), turned)
