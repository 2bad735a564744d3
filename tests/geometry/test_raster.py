"""The picture: against rays cast at every pixel, with and without a lens, and cut at the near
plane.
"""

import numpy as np
import pytest
import scipy
from hypothesis import given, settings
from hypothesis import strategies as st

from workbench.data.views.street import BALL_CENTER, BALL_RADIUS, street, street_items, street_map
from workbench.geometry.cameras import (
    camera_center,
    depths,
    intrinsics,
    look_at,
    pixel_rays,
    project,
)
from workbench.geometry.cameras.distortion import NONE, Distortion
from workbench.geometry.cameras.raster import (
    Image,
    MeshItem,
    PointItem,
    SegmentItem,
    in_sight,
    render,
)
from workbench.geometry.clipping import clip_segments, clip_to_rectangle, clip_triangles

WIDTH, HEIGHT = 64, 48
K = intrinsics(50.0, 31.5, 23.5)
BARREL = Distortion(-0.25, 0.05, 0.01, -0.01)
RED, BLUE = np.array([[255, 0, 0]], np.uint8), np.array([[0, 0, 255]], np.uint8)
seeds = st.integers(0, 2**32 - 1)
lenses = st.sampled_from([NONE, BARREL])


def all_pixels(width: int = WIDTH, height: int = HEIGHT) -> np.ndarray:
    v, u = np.mgrid[:height, :width]
    return np.column_stack([u.ravel(), v.ravel()]).astype(float)


def cast(
    p: np.ndarray, faces: np.ndarray, T_camera_world: np.ndarray, *, lens: Distortion, near: float
):
    """On every pixel's ray the depth of the nearest triangle, how safely it is hit or missed, and
    which (-1: none).

    Source: Möller and Trumbore 1997.
    """
    origin, n_world = pixel_rays(all_pixels(), T_camera_world, K, distortion=lens)
    n_world = n_world / (n_world @ T_camera_world[2, :3])[:, None]  # one metre of depth per unit
    nearest, margin = np.full(len(n_world), np.inf), np.full(len(n_world), np.inf)
    which = np.full(len(n_world), -1)
    for number, (a, b, c) in enumerate(p[faces]):
        e1, e2 = b - a, c - a
        h = np.cross(n_world, e2)
        scale = h @ e1
        x = h @ (origin - a) / scale
        q = np.cross(origin - a, e1)
        y = n_world @ q / scale
        z = e2 @ q / scale
        depth_there = np.where(np.minimum(np.minimum(x, y), 1 - x - y) > 0, z, np.inf)
        depth_there[depth_there <= near] = np.inf
        which[depth_there < nearest] = number
        nearest = np.minimum(nearest, depth_there)
        clear = np.abs(np.minimum(np.minimum(x, y), 1 - x - y))
        margin = np.minimum(margin, np.where(z > 0, np.minimum(clear, np.abs(z - near)), np.inf))
    return (
        nearest.reshape(HEIGHT, WIDTH),
        margin.reshape(HEIGHT, WIDTH),
        which.reshape(HEIGHT, WIDTH),
    )


@settings(max_examples=30, deadline=None)
@given(seed=seeds, lens=lenses)
def test_depth_is_what_a_ray_through_each_pixel_meets(seed, lens):
    rng = np.random.default_rng(seed)
    T_camera_world = look_at(rng.normal(size=3), rng.normal(size=3) + np.array([0.0, 8.0, 0.0]))
    p = rng.uniform([-3, -2, -2], [3, 8, 2], (12, 3))
    faces = np.arange(12).reshape(4, 3)
    colors = rng.integers(0, 255, (4, 3)).astype(np.uint8)
    near = 0.3
    image = render(
        [MeshItem(p, faces, colors)],
        T_camera_world,
        K,
        width=WIDTH,
        height=HEIGHT,
        distortion=lens,
        near=near,
    )
    depth, margin, which = cast(p, faces, T_camera_world, lens=lens, near=near)
    if lens is NONE:
        sure = margin > 1e-4  # a pixel whose centre is not on an edge
        assert sure.mean() > 0.9
        np.testing.assert_allclose(image.depth[sure], depth[sure], rtol=1e-9)
    else:  # edges are polygons within a fraction of a pixel of the curve: away from them the same triangle is met  # noqa: E501
        inside = scipy.ndimage.minimum_filter(which, 3) == scipy.ndimage.maximum_filter(which, 3)
        nearest, furthest = (
            f(depth, 3, mode="nearest")
            for f in (scipy.ndimage.minimum_filter, scipy.ndimage.maximum_filter)
        )
        between = (image.depth >= nearest * (1 - 1e-2)) & (image.depth <= furthest * (1 + 1e-2))
        assert (
            between[inside].mean() > 0.99
        )  # what is thinner than a pixel may be hit by one and missed by the other


@pytest.mark.parametrize("lens", [NONE, BARREL, Distortion(0.2, 0.05)])
def test_a_floor_under_the_camera_fills_every_pixel_below_the_horizon(lens):
    """Two triangles, 200 m wide, cross the near plane; every ray that meets the floor must find it
    at its depth.
    """
    T_camera_world = look_at(np.array([0.0, 0.0, 1.5]), np.array([0.0, 10.0, 0.5]))
    p = np.array([[-100.0, -100, 0], [100, -100, 0], [100, 100, 0], [-100, 100, 0]])
    item = MeshItem(p, np.array([[0, 1, 2], [0, 2, 3]]), np.concatenate([RED, BLUE]))
    image = render([item], T_camera_world, K, width=WIDTH, height=HEIGHT, distortion=lens)
    origin, n_world = pixel_rays(all_pixels(), T_camera_world, K, distortion=lens)
    with np.errstate(divide="ignore"):
        hit = origin - origin[2] / n_world[:, 2:] * n_world
    depth = depths(hit, T_camera_world)
    sure = (n_world[:, 2] < -0.1) & (np.abs(hit[:, :2]).max(axis=1) < 99)
    assert sure.mean() > 0.4
    np.testing.assert_allclose(
        image.depth.ravel()[sure], depth[sure], rtol=1e-9 if lens is NONE else 5e-3
    )
    above = n_world[:, 2] > 0.02
    assert np.isinf(image.depth.ravel()[above]).all()


@pytest.mark.parametrize("lens", [NONE, BARREL])
def test_the_ball_of_the_street_is_seen_at_the_depth_of_a_sphere(lens):
    T_camera_world = look_at(np.array([0.5, -0.5, 1.6]), BALL_CENTER)
    ball = street().solids["ball"]
    image = render(
        [MeshItem(ball.p_world, ball.faces, ball.colors)],
        T_camera_world,
        K,
        width=WIDTH,
        height=HEIGHT,
        distortion=lens,
    )
    origin, n_world = pixel_rays(all_pixels(), T_camera_world, K, distortion=lens)
    along = n_world @ (BALL_CENTER - origin)
    miss = np.linalg.norm(origin + along[:, None] * n_world - BALL_CENTER, axis=1)
    hit = miss < 0.9 * BALL_RADIUS
    length = along[hit] - np.sqrt(BALL_RADIUS**2 - miss[hit] ** 2)
    depth = depths(origin + length[:, None] * n_world[hit], T_camera_world)
    assert hit.sum() > 60
    np.testing.assert_allclose(image.depth.ravel()[hit], depth, atol=0.02)
    assert np.isinf(image.depth.ravel()[miss > 1.1 * BALL_RADIUS]).all()


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


def test_a_lens_that_folds_leaves_its_dark_rim_empty():
    lens = Distortion(-0.9)
    T_camera_world = look_at(np.array([0.0, 0.0, 5.0]), np.zeros(3))
    p = np.array([[-100.0, -100, 0], [100, -100, 0], [100, 100, 0], [-100, 100, 0]])
    item = MeshItem(p, np.array([[0, 1, 2], [0, 2, 3]]), np.concatenate([RED, RED]))
    image = render([item], T_camera_world, K, width=WIDTH, height=HEIGHT, distortion=lens)
    _, n_world = pixel_rays(all_pixels(), T_camera_world, K, distortion=lens)
    blind = np.isnan(n_world[:, 0]).reshape(HEIGHT, WIDTH)
    assert 0.1 < blind.mean() < 0.9
    assert (np.isfinite(image.depth) != blind).mean() > 0.93
    assert np.isfinite(image.depth[20:28, 28:36]).all()


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


def test_points_in_sight_are_those_that_nothing_stands_before():
    T_camera_world = look_at(np.array([0.5, -3.0, 1.7]), np.array([0.3, 8.0, 1.0]))
    K_street = intrinsics(260.0, 159.5, 119.5)
    eye = camera_center(T_camera_world)
    p, n = (vectors[:600] for vectors in street_map())
    p = np.concatenate(
        [p[((eye - p) * n).sum(axis=1) > 0], eye + np.array([[0.0, -4.0, 0.0], [0.0, 0.0, 0.0]])]
    )
    shown = in_sight(
        p,
        T_camera_world,
        K_street,
        depth=render(street_items(), T_camera_world, K_street, width=320, height=240).depth,
    )
    a, b, c = np.concatenate(
        [solid.p_world[solid.faces] for solid in street().solids.values()]
    ).transpose(1, 0, 2)
    free = []
    for v in p[:-2] - eye:  # eye + s v = a + g (b - a) + h (c - a), by Cramer's rule
        across = np.cross(v, c - a)
        from_a = eye - a
        with np.errstate(divide="ignore", invalid="ignore"):
            scale = 1.0 / np.einsum("fx,fx->f", across, b - a)
            g = scale * np.einsum("fx,fx->f", across, from_a)
            around = np.cross(from_a, b - a)
            h = scale * (around @ v)
            s = scale * np.einsum("fx,fx->f", around, c - a)
        free.append(not ((g >= 0) & (h >= 0) & (g + h <= 1) & (s > 0) & (s < 0.97)).any())
    u, v = project(p[:-2], T_camera_world, K_street).T
    met = np.array(free) & (u >= 0) & (u <= 319) & (v >= 0) & (v <= 239)
    assert 50 < met.sum() < len(met) - 50
    assert (shown[:-2] & ~met).mean() < 0.01  # at an edge
    near = np.linalg.norm(p[:-2] - eye, axis=1) < 13.0
    assert (
        shown[:-2][met & near].mean() > 0.9
    )  # what leans, far away, has too many depths in a pixel
    assert not shown[-2:].any()  # behind the camera, and in it


def test_the_solids_of_the_street_are_closed_and_face_outwards():
    for name, solid in street().solids.items():
        if name == "ground":
            continue
        edges = np.sort(solid.faces[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
        _, counts = np.unique(edges, axis=0, return_counts=True)
        assert (counts == 2).all(), name
        a, b, c = (solid.p_world[solid.faces[:, k]] for k in range(3))
        assert np.einsum("ni,ni->", a, np.cross(b, c)) > 0, name
