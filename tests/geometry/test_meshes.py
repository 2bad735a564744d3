"""Triangle meshes: measures against trimesh and laws; borders, rings and chi; what is refused, and
with which words.
"""

import numpy as np
import pytest
import scipy
import trimesh
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.geometry.mesh_zoo import CUBE, TETRAHEDRON, random_closed, strip
from workbench.data.files import read_mesh
from workbench.data.shapes.surfaces import SURFACES, plane, torus
from workbench.errors import InputError
from workbench.geometry.meshes import triangles as meshes
from workbench.geometry.motions import exp_so3

seeds = st.integers(0, 10_000)


@settings(max_examples=25, deadline=None)
@given(seeds, st.floats(0.01, 100), st.floats(-1e3, 1e3))
def test_angles_and_areas_follow_motion_and_scale(seed, scale, shift):
    rng = np.random.default_rng(seed)
    p, faces = random_closed(rng, 40)
    moved = scale * (p @ exp_so3(rng.uniform(-3, 3, 3)).T) + shift
    tolerance = 1e-9 * (1 + abs(shift) / scale)
    np.testing.assert_allclose(meshes.face_angles(p, faces).sum(axis=1), np.pi, atol=1e-12)
    np.testing.assert_allclose(
        meshes.face_angles(moved, faces), meshes.face_angles(p, faces), atol=1e3 * tolerance, rtol=0
    )
    np.testing.assert_allclose(
        meshes.face_areas(moved, faces),
        scale**2 * meshes.face_areas(p, faces),
        rtol=1e3 * tolerance,
    )


@settings(max_examples=15, deadline=None)
@given(seeds)
def test_measures_agree_with_trimesh(seed):
    p, faces = random_closed(np.random.default_rng(seed), 60)
    theirs = trimesh.Trimesh(p, faces, process=False)
    np.testing.assert_allclose(meshes.face_angles(p, faces), theirs.face_angles, atol=1e-7)
    np.testing.assert_allclose(meshes.face_areas(p, faces), theirs.area_faces, rtol=1e-9)
    np.testing.assert_allclose(meshes.face_normals(p, faces), theirs.face_normals, atol=1e-9)
    np.testing.assert_array_equal(meshes.edges(faces), np.unique(theirs.edges_sorted, axis=0))
    assert meshes.euler_characteristic(faces) == theirs.euler_number == 2


def test_the_needle_keeps_its_accuracy():
    # Heron's formula and arccos lose half of the digits here; arctan2 of cross and dot does not.
    p = np.array([[0, 0, 0], [1, 0, 0], [0.5, 1e-7, 0]])
    angles = meshes.face_angles(p, np.array([[0, 1, 2]]))
    np.testing.assert_allclose(angles[0, :2], np.arctan(2e-7), rtol=1e-9)


def test_more_faces_than_one_block_give_the_same():
    surface = torus(3000)
    whole = meshes.face_areas(surface.p, np.tile(surface.faces, (3, 1)))
    assert len(whole) > 2 * meshes.BLOCK
    np.testing.assert_array_equal(whole, np.tile(meshes.face_areas(surface.p, surface.faces), 3))


def test_faces_without_area_have_no_normal_and_no_cotangent():
    p = np.array([[0, 0, 0], [1, 0, 0], [2, 0, 0], [0, 0, 0]], dtype=float)
    measured = meshes.corners(p, np.array([[0, 1, 2], [0, 3, 1], [0, 3, 3]]))
    np.testing.assert_array_equal(measured.cotangents, 0)
    np.testing.assert_allclose(np.sort(measured.angles[:, 0]), [0, 0, np.pi])
    np.testing.assert_array_equal(meshes.face_normals(p, np.array([[0, 1, 2], [0, 3, 3]])), 0)


@pytest.mark.parametrize("name", SURFACES)
def test_vertex_normals_follow_the_surface(name):
    surface = SURFACES[name](3000, jitter=0.15, rng=np.random.default_rng(0))
    normals = meshes.vertex_normals(surface.p, surface.faces)
    inside = ~meshes.on_boundary(surface.faces, len(surface.p))
    cosine = np.einsum("vx,vx->v", normals, surface.normals)[inside]
    assert np.degrees(np.arccos(np.clip(cosine, -1, 1))).max() < 3.0


def test_angle_weights_do_not_see_how_a_side_is_cut():
    # Every corner of a cube, three or more triangles of three square sides meeting there.
    p, faces = CUBE
    np.testing.assert_allclose(
        meshes.vertex_normals(p, faces), (2 * p - 1) / np.sqrt(3), atol=1e-12
    )


def test_border_of_a_strip_and_of_closed_meshes():
    p, faces = strip(4)
    assert meshes.on_boundary(faces, len(p)).all()
    assert len(meshes.boundary_edges(faces)) == len(p)
    for name, open_ends in (
        ("sphere", 0),
        ("torus", 0),
        ("cylinder", 2),
        ("catenoid", 2),
        ("plane", 1),
    ):
        surface = SURFACES[name](400)
        border = meshes.on_boundary(surface.faces, len(surface.p))
        np.testing.assert_array_equal(
            np.flatnonzero(border), np.unique(meshes.boundary_edges(surface.faces))
        )
        assert border.any() == (open_ends > 0), name


def test_a_border_goes_round_with_the_surface_on_its_left():
    edges = meshes.boundary_edges(plane(25).faces)
    p = plane(25).p
    inward = -(p[edges].mean(axis=1))
    v = np.diff(p[edges], axis=1)[:, 0]
    assert (np.cross(v, inward)[:, 2] > 0).all()


@pytest.mark.parametrize(
    ("name", "chi"),
    [("sphere", 2), ("torus", 0), ("cylinder", 0), ("catenoid", 0), ("plane", 1), ("saddle", 1)],
)
def test_euler_characteristic_of_known_surfaces(name, chi):
    surface = SURFACES[name](500)
    assert meshes.euler_characteristic(surface.faces) == chi
    meshes.check_mesh(surface.p, surface.faces)


def test_euler_characteristic_adds_up_over_pieces_and_ignores_unused_vertices():
    two = np.concatenate([TETRAHEDRON[1], TETRAHEDRON[1] + 7])
    assert meshes.euler_characteristic(two) == 4


def test_one_ring_inside_and_on_the_border():
    surface = plane(25)
    ring_faces, ring = meshes.one_ring(surface.faces, 12)
    assert len(ring_faces) == len(ring) == 6
    v = surface.p[ring] - surface.p[12]
    turns = np.cross(v, np.roll(v, -1, axis=0))[:, 2]
    assert (turns > 0).all()
    np.testing.assert_array_equal(
        np.sort(ring), np.sort(meshes.adjacency(surface.faces, 25).tocsr()[[12]].indices)
    )
    ring_faces, ring = meshes.one_ring(surface.faces, 2)
    assert len(ring) == len(ring_faces) + 1
    border = set(map(tuple, np.sort(meshes.boundary_edges(surface.faces), axis=1).tolist()))
    assert {tuple(sorted((2, int(end)))) for end in ring[[0, -1]]} <= border


def test_one_ring_refuses_what_has_none():
    with pytest.raises(ValueError, match="no face"):
        meshes.one_ring(TETRAHEDRON[1], 9)
    for faces in (np.array([[0, 1, 2], [0, 3, 4]]), BAD["closed sheets touch"][1]):
        with pytest.raises(ValueError, match="not one fan"):
            meshes.one_ring(faces, 0)


def test_welding_closes_seams_and_keeps_the_shape():
    p, faces = TETRAHEDRON
    soup = p[faces].reshape(-1, 3)
    loose = np.vstack([soup, [[9.0, 9.0, 9.0]]])
    # vertices 0 and 3 are at one place
    apart = np.vstack([np.arange(12).reshape(-1, 3), [[0, 3, 1]]])
    assert meshes.on_boundary(apart[:4], 13).any()
    kept, renamed = meshes.welded(loose, apart)
    assert len(kept) == len(renamed) == 4
    np.testing.assert_array_equal(kept[renamed], p[faces])
    meshes.check_mesh(kept, renamed)


GOOD = TETRAHEDRON
BAD = {
    "empty": (np.empty((0, 3)), np.empty((0, 3), int), "empty"),
    "cloud": (GOOD[0], np.empty((0, 3), int), "0 faces"),
    "nan": (np.where(GOOD[0] == GOOD[0][2], np.nan, GOOD[0]), GOOD[1], "not finite"),
    "index": (GOOD[0], GOOD[1] + 1, "names vertex 4"),
    "negative": (GOOD[0], GOOD[1] - 1, "names vertex"),
    "repeated": (GOOD[0], np.vstack([GOOD[1], [0, 0, 1]]), "no area"),
    "collinear": (np.array([[0, 0, 0], [1, 0, 0], [3, 0, 0.0]]), np.array([[0, 1, 2]]), "no area"),
    "three faces at an edge": (
        np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1.0]]),
        np.array([[0, 1, 2], [1, 0, 3], [0, 1, 4]]),
        "1 edges have more than two faces .*vertices 0 and 1",
    ),
    "turned": (GOOD[0], np.vstack([GOOD[1][:3], GOOD[1][3, ::-1]]), "disagree which side"),
    "unused": (np.vstack([GOOD[0], [1, 1, 1.0]]), GOOD[1], "1 vertices belong to no face"),
    "open sheets touch": (
        np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [-1, 0, 0], [0, -1, 0.0]]),
        np.array([[0, 1, 2], [0, 3, 4]]),
        "only touch .*vertex 0",
    ),
    "closed sheets touch": (
        np.vstack([GOOD[0], 2 * GOOD[0][0] - GOOD[0][1:]]),
        np.vstack([GOOD[1], np.array([0, 4, 5, 6])[GOOD[1]][:, ::-1]]),
        "only touch .*vertex 0",
    ),
}


@pytest.mark.parametrize("name", BAD)
def test_what_cannot_be_measured_is_refused_with_what_to_mend(name):
    p, faces, words = BAD[name]
    with pytest.raises(InputError, match=words):
        meshes.check_mesh(p, faces)


@settings(max_examples=15, deadline=None)
@given(seeds)
def test_good_meshes_are_accepted(seed):
    meshes.check_mesh(*random_closed(np.random.default_rng(seed), 30))


@pytest.mark.parametrize(("name", "chi"), [("bunny", 2), ("fertility", -6)])
def test_scanned_meshes_are_accepted(shared_data, name, chi):
    p, faces = read_mesh(shared_data / "curvature" / f"{name}.off")
    meshes.check_mesh(p, faces)
    assert meshes.euler_characteristic(faces) == chi
    assert not meshes.on_boundary(faces, len(p)).any()


@settings(max_examples=20, deadline=None)
@given(seeds, st.integers(0, 4))
def test_vertices_within_some_edges_are_those_of_scipys_shortest_paths(seed, steps):
    _, faces = random_closed(np.random.default_rng(seed), 40)
    count = int(faces.max()) + 1
    far = scipy.sparse.csgraph.shortest_path(meshes.adjacency(faces, count), unweighted=True)
    vertex = seed % count
    near = meshes.vertices_within(meshes.edges(faces), vertex, steps)
    np.testing.assert_array_equal(near, np.flatnonzero(far[vertex] <= steps))


def test_distinct_rows_are_those_that_numpy_finds():
    rng = np.random.default_rng(4)
    for rows in (
        rng.integers(0, 3, (200, 3)),
        rng.normal(size=(50, 2)).round(),
        rng.normal(size=(50, 3)),  # no number twice: sorted by the first alone
        rng.permutation(np.c_[np.r_[0:40, 0:10], rng.normal(size=50)]),  # the first some twice
        np.zeros((0, 3)),
        np.ones((1, 2)),
    ):
        first, name = meshes.distinct_rows(rows)
        distinct, inverse = (
            np.unique(rows, axis=0, return_inverse=True) if len(rows) else (rows, np.empty(0, int))
        )
        np.testing.assert_array_equal(rows[first], distinct)
        np.testing.assert_array_equal(name, inverse.reshape(-1))
