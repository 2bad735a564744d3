"""The picture against rays: what one through each pixel meets, with and without a lens, and which
points nothing stands before.
"""

import numpy as np
import pytest
import scipy
from hypothesis import given, settings

from tests.geometry.small_camera import BARREL, BLUE, HEIGHT, RED, WIDTH, K, lenses, seeds
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
from workbench.geometry.cameras.raster import MeshItem, in_sight, render


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
        # what is thinner than a pixel may be hit by one and missed by the other
        assert between[inside].mean() > 0.99


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
    # what leans, far away, has too many depths in a pixel
    assert shown[:-2][met & near].mean() > 0.9
    assert not shown[-2:].any()  # behind the camera, and in it
