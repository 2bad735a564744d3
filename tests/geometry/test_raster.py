"""The picture: points and segments, what is seen of two things, what leaves no mark, what is cut at
the near plane, and the street.
"""

import numpy as np
import pytest
from hypothesis import given, settings

from tests.geometry.small_camera import BARREL, BLUE, HEIGHT, RED, WIDTH, K, lenses, seeds
from workbench.data.views.street import street
from workbench.geometry.cameras import depths, intrinsics, look_at, project
from workbench.geometry.cameras.distortion import NONE
from workbench.geometry.cameras.raster import Image, MeshItem, PointItem, SegmentItem, render
from workbench.geometry.clipping import clip_segments, clip_to_rectangle, clip_triangles


@settings(max_examples=20, deadline=None)
@given(seed=seeds, lens=lenses)
def test_points_land_on_the_pixel_that_project_names(seed, lens):
    rng = np.random.default_rng(seed)
    p = np.array([[0.0, 0.0, 1.0]]) * rng.uniform(1, 9) + rng.uniform(-0.3, 0.3, (1, 3))
    image = render(
        [PointItem(p, RED, width=1)], np.eye(4), K, width=WIDTH, height=HEIGHT, distortion=lens
    )
    v, u = np.nonzero(np.isfinite(image.depth))
    np.testing.assert_array_equal(np.column_stack([u, v]), np.rint(project(p, np.eye(4), K, lens)))
    assert image.depth[v, u] == pytest.approx(p[0, 2])
    np.testing.assert_array_equal(image.colors[v, u], RED)


def test_points_behind_the_camera_and_near_it_are_not_drawn():
    p = np.array([[0.0, 0.0, -2.0], [0.0, 0.0, 0.04], [0.0, 0.0, 0.0]])
    image = render([PointItem(p, np.tile(RED, (3, 1)))], np.eye(4), K, width=WIDTH, height=HEIGHT)
    assert np.isinf(image.depth).all()


@pytest.mark.parametrize("lens", [NONE, BARREL])
def test_a_segment_is_an_unbroken_line_on_its_projected_points(lens):
    ends = np.array([[[-1.0, -0.5, 2.0], [1.5, 1.0, 4.0]]])
    image = render(
        [SegmentItem(ends, RED)], np.eye(4), K, width=WIDTH, height=HEIGHT, distortion=lens
    )
    share = np.linspace(0, 1, 400)[:, None]
    u, v = np.floor(
        project((1 - share) * ends[0, 0] + share * ends[0, 1], np.eye(4), K, lens) + 0.5
    ).T.astype(int)
    inside = (u >= 0) & (u < WIDTH) & (v >= 0) & (v < HEIGHT)
    drawn = np.isfinite(image.depth)
    assert drawn[:, np.unique(u[inside])].any(axis=0).all()
    grown = drawn | np.roll(drawn, 1, 0) | np.roll(drawn, -1, 0)
    assert grown[v[inside], u[inside]].all()


def test_a_rail_that_starts_behind_the_camera_is_cut_at_the_near_plane():
    T_camera_world = look_at(np.array([0.0, 0.0, 1.5]), np.array([0.0, 10.0, 1.5]))
    rail = np.array([[[0.75, -50.0, 0.0], [0.75, 50.0, 0.0]]])
    image = render([SegmentItem(rail, RED)], T_camera_world, K, width=WIDTH, height=HEIGHT)
    v, u = np.nonzero(np.isfinite(image.depth))
    assert v.min() > 23  # below the horizon, although its far half alone divides to rows above it
    assert v.max() == HEIGHT - 1
    assert (np.diff(u[np.argsort(v, kind="stable")]) >= 0).all()


def test_the_nearer_of_two_wins_whatever_the_order_and_lines_win_from_their_surface():
    square = np.array([[-1.0, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]])
    faces = np.array([[0, 1, 2], [0, 2, 3]])
    near = MeshItem(square + np.array([0, 0, 3.0]), faces, np.tile(RED, (2, 1)))
    far = MeshItem(square * 2 + np.array([0, 0, 4.0]), faces, np.tile(BLUE, (2, 1)))
    for items in ([near, far], [far, near]):
        image = render(items, np.eye(4), K, width=WIDTH, height=HEIGHT)
        np.testing.assert_array_equal(image.colors[24, 32], RED[0])
        np.testing.assert_array_equal(image.colors[24, 12], BLUE[0])
    line = SegmentItem(np.array([[[-1.0, 0, 3], [1, 0, 3]]]), BLUE)
    image = render([line, near], np.eye(4), K, width=WIDTH, height=HEIGHT)
    np.testing.assert_array_equal(image.colors[24, 32], BLUE[0])
    assert image.depth[24, 32] == pytest.approx(3.0)
    hidden = SegmentItem(line.p_world + np.array([0, 0, 0.1]), BLUE)
    np.testing.assert_array_equal(
        render([hidden, near], np.eye(4), K, width=WIDTH, height=HEIGHT).colors[24, 32], RED[0]
    )


def test_widths_are_in_pixels():
    for width in (1, 2, 3, 5):
        image = render(
            [PointItem(np.array([[0.0, 0.0, 2.0]]), RED, width)],
            np.eye(4),
            K,
            width=WIDTH,
            height=HEIGHT,
        )
        assert np.isfinite(image.depth).any(axis=0).sum() == width
        assert np.isfinite(image.depth).any(axis=1).sum() == width


def test_a_given_camera_model_draws_instead():
    """The picture needs nothing of the camera but a function from world points to pixels."""
    item = MeshItem(np.array([[0.0, 0, 2], [1, 0, 2], [0, 1, 2]]), np.array([[0, 1, 2]]), RED)
    ours = render([item], np.eye(4), K, width=WIDTH, height=HEIGHT)
    shifted = render(
        [item],
        np.eye(4),
        K,
        width=WIDTH,
        height=HEIGHT,
        to_pixels=lambda p: project(p, np.eye(4), K) - np.array([10.0, 5.0]),
    )
    np.testing.assert_array_equal(shifted.colors[:-5, :-10], ours.colors[5:, 10:])
    nowhere = render(
        [item],
        np.eye(4),
        K,
        width=WIDTH,
        height=HEIGHT,
        to_pixels=lambda p: np.full((len(p), 2), np.nan),
    )
    assert np.isinf(nowhere.depth).all()


def same(a: Image, b: Image) -> bool:
    return np.array_equal(a.colors, b.colors) and np.array_equal(a.depth, b.depth)


def test_nothing_and_degenerate_things_leave_the_background():
    empty = render([], np.eye(4), K, width=WIDTH, height=HEIGHT, background=(1, 2, 3))
    assert (empty.colors == np.array([1, 2, 3])).all()
    assert np.isinf(empty.depth).all()
    flat = np.array([[0.0, 0, 2], [1, 0, 2], [2, 0, 2]])
    none = np.zeros((0, 3), np.uint8)
    nothing = [
        MeshItem(flat, np.array([[0, 1, 2]]), RED),
        MeshItem(flat, np.array([[1, 1, 1]]), RED),
        MeshItem(np.full((3, 3), np.nan), np.array([[0, 1, 2]]), RED),
        MeshItem(flat, np.zeros((0, 3), int), none),
        SegmentItem(np.zeros((0, 2, 3)), none),
        SegmentItem(np.full((1, 2, 3), np.nan), RED),
        PointItem(np.zeros((0, 3)), none),
        PointItem(np.full((1, 3), np.nan), RED),
    ]
    for lens in (NONE, BARREL):
        for item in nothing:
            assert same(
                render(
                    [item],
                    np.eye(4),
                    K,
                    width=WIDTH,
                    height=HEIGHT,
                    distortion=lens,
                    background=(1, 2, 3),
                ),
                empty,
            ), item
    dot = render(
        [SegmentItem(np.array([[[0.0, 0, 2], [0, 0, 2]]]), RED)],
        np.eye(4),
        K,
        width=WIDTH,
        height=HEIGHT,
    )
    assert np.isfinite(dot.depth).sum() == 1


def test_a_picture_needs_pixels_and_a_near_plane_ahead():
    with pytest.raises(ValueError, match="pixel"):
        render([], np.eye(4), K, width=0, height=10)
    with pytest.raises(ValueError, match="near"):
        render([], np.eye(4), K, width=10, height=10, near=0.0)


@settings(max_examples=50, deadline=None)
@given(seed=seeds)
def test_cut_triangles_are_ahead_and_keep_area_and_orientation(seed):
    rng = np.random.default_rng(seed)
    p = rng.normal(size=(6, 3, 3))
    cut, owner = clip_triangles(p, p[:, :, 2])
    assert (cut[:, :, 2] >= -1e-12).all()
    rest, rest_owner = clip_triangles(p, -p[:, :, 2])

    def areas(triangles: np.ndarray) -> np.ndarray:
        return 0.5 * np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])

    total = np.zeros((6, 3))
    np.add.at(total, owner, areas(cut))
    np.add.at(total, rest_owner, areas(rest))
    np.testing.assert_allclose(total, areas(p), atol=1e-12)


@settings(max_examples=50, deadline=None)
@given(seed=seeds)
def test_cut_segments_are_the_part_ahead(seed):
    rng = np.random.default_rng(seed)
    p = rng.normal(size=(20, 2, 3))
    cut, owner = clip_segments(p, p[:, :, 2])
    assert (cut[:, :, 2] >= -1e-12).all()
    np.testing.assert_array_equal(np.flatnonzero((p[:, :, 2] > 0).any(axis=1)), owner)
    way = p[owner, 1] - p[owner, 0]
    np.testing.assert_allclose(np.cross(cut[:, 1] - cut[:, 0], way), 0.0, atol=1e-10)


@settings(max_examples=50, deadline=None)
@given(seed=seeds)
def test_the_part_in_a_rectangle_is_the_part_in_the_rectangle(seed):
    rng = np.random.default_rng(seed)
    uv = rng.uniform(-2, 3, (20, 2, 2))
    uv[0] = uv[0, :1]
    start, stop = clip_to_rectangle(uv, np.zeros(2), np.ones(2))
    share = np.linspace(0, 1, 1001)
    along = uv[:, None, 0] + share[:, None] * (uv[:, None, 1] - uv[:, None, 0])
    inside = ((along > 0) & (along < 1)).all(axis=2)
    kept = (share > start[:, None] - 1e-9) & (share < stop[:, None] + 1e-9)
    assert (inside <= kept).all()
    assert (~inside & (share > start[:, None] + 1e-9) & (share < stop[:, None] - 1e-9)).sum() == 0


def test_the_street_is_drawn_whole_and_its_camera_sees_its_parts():
    scene = street()
    T_camera_world = look_at(np.array([0.5, -3.0, 1.7]), np.array([0.3, 8.0, 1.0]))
    K_street = intrinsics(260.0, 159.5, 119.5)
    items = [MeshItem(solid.p_world, solid.faces, solid.colors) for solid in scene.solids.values()]
    image = render(items, T_camera_world, K_street, width=320, height=240)
    for p in scene.points[:3, None]:
        u, v = np.rint(project(p, T_camera_world, K_street))[0].astype(int)
        assert np.nanmin(image.depth[v - 2 : v + 3, u - 2 : u + 3]) == pytest.approx(
            depths(p, T_camera_world)[0], rel=0.1
        )
    assert np.isnan(project(scene.points[5:6], T_camera_world, K_street)).all()
    assert scene.names[5] == "the lamp"


def test_the_solids_of_the_street_are_closed_and_face_outwards():
    for name, solid in street().solids.items():
        if name == "ground":
            continue
        edges = np.sort(solid.faces[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
        _, counts = np.unique(edges, axis=0, return_counts=True)
        assert (counts == 2).all(), name
        a, b, c = (solid.p_world[solid.faces[:, k]] for k in range(3))
        assert np.einsum("ni,ni->", a, np.cross(b, c)) > 0, name
