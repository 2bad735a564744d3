"""Scenes as pixels: places by the pinhole's own formula, what hides what, and what is glass."""

import tracemalloc

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from workbench.rendering import raster
from workbench.rendering.framing import framed
from workbench.rendering.lens import Lens
from workbench.rendering.raster import clipped, painted
from workbench.rendering.shapes import shapes_of, stage_of
from workbench.scene import PALETTE, Axes, Camera, Label, Mesh, Picture, Points, Segments
from workbench.view import View

VIEW = View(eye=(0.0, -5.0, 0.0), target=(0.0, 0.0, 0.0), fov_degrees=45.0)
SIZE = 320, 200
LENS = Lens.of(VIEW, SIZE)
WALL = np.array([[-1.0, 0, -1], [1, 0, -1], [1, 0, 1], [-1, 0, 1]])
FACES = np.array([[0, 1, 2], [0, 2, 3]])


def pixels(scene, lens=LENS, **more) -> np.ndarray:
    return np.asarray(painted(shapes_of(scene), lens, scale=1.0, **more)).astype(int)


def middle(picture: np.ndarray, role) -> tuple[float, float]:
    near = np.abs(picture[..., :3] - PALETTE[role]).max(-1) < 30
    rows, columns = np.nonzero(near & (picture[..., 3] > 200))
    return columns.mean() + 0.5, rows.mean() + 0.5


@given(x=st.floats(-1.5, 1.5), z=st.floats(-1, 1), y=st.floats(-1, 2))
@settings(max_examples=20, deadline=None)
def test_a_point_is_where_the_pinhole_has_it(x, y, z):
    focal = 100 / np.tan(np.radians(22.5))
    expected = (160 + focal * x / (5 + y), 100 - focal * z / (5 + y))
    seen = pixels({"p": Points(np.array([[x, y, z]]), "source", 0.06)})
    if 5 < expected[0] < 315 and 5 < expected[1] < 195:
        assert middle(seen, "source") == pytest.approx(expected, abs=0.7)


def test_the_nearer_hides_the_farther_in_any_order():
    wall = Mesh(WALL, FACES, "target")
    behind = Points(np.array([[0.0, 1.0, 0.0]]), "source", 0.2)
    before = Points(np.array([[0.0, -1.0, 0.0]]), "source", 0.2)
    for scene in ({"a": wall, "b": behind}, {"b": behind, "a": wall}):
        color = pixels(scene)[100, 160, :3]
        assert color[2] > color[0]
    for scene in ({"a": wall, "b": before}, {"b": before, "a": wall}):
        assert pixels(scene)[100, 160, :3] == pytest.approx(PALETTE["source"], abs=3)


def test_a_line_through_a_wall_is_hidden_where_it_is_behind():
    line = Segments(np.array([[[-0.9, -1.0, 0.0], [0.9, 1.0, 0.0]]]), "source", width=5.0)
    seen = pixels({"a": Mesh(WALL, FACES, "target"), "b": line})
    orange = np.flatnonzero(np.abs(seen[100, :, :3] - PALETTE["source"]).max(-1) < 30)
    assert orange.min() < 120
    assert orange.max() == pytest.approx(160, abs=3)


def test_glass_lets_through_what_is_behind_it():
    behind = Points(np.array([[0.0, 1.0, 0.0]]), "source", 0.2)
    glass = Mesh(WALL, FACES, "target", opacity=0.5)
    seen = pixels({"a": glass, "b": behind})[100, 160]
    wall = pixels({"a": Mesh(WALL, FACES, "target")})[100, 160, :3]
    assert seen[:3] == pytest.approx((np.array(PALETTE["source"]) + wall) / 2, abs=3)
    assert pixels({"a": glass})[100, 160, 3] == pytest.approx(128, abs=2)


def test_what_is_faint_keeps_more_of_its_colour_on_a_dark_ground():
    faint = {"a": Points(np.zeros((1, 3)), "source", 0.3, opacity=0.25)}
    assert pixels(faint)[100, 160, 3] == pytest.approx(64, abs=1)
    assert pixels(faint, dark=True)[100, 160, 3] == pytest.approx(255 * 0.25**0.6, abs=1)


def test_a_picture_has_each_pixel_in_its_place():
    image = np.zeros((2, 2, 3), np.uint8)
    image[0, 0] = (255, 0, 0)
    image[1, 1] = (0, 0, 255)
    seen = pixels({"a": Picture(image, width=2.0, T_world_object=VIEW.facing(0.0, 0.0))})
    focal = LENS.focal
    step = focal * 0.45 / 5
    left = round(160 - step * 2)
    right = round(160 + step * 2)
    top = round(100 - step * 2)
    low = round(100 + step * 2)
    assert seen[top, left, :3] == pytest.approx((255, 0, 0), abs=3)
    assert seen[low, right, :3] == pytest.approx((0, 0, 255), abs=3)
    assert seen[top, right, :3].max() < 3


def test_what_is_behind_the_eye_is_left_out_and_a_line_from_there_is_cut():
    ends = np.array([[[0.0, -9.0, 0.5], [0.0, 3.0, 0.5]], [[0.0, -9.0, 0.0], [0.0, -7.0, 0.0]]])
    uv, inverse, which = clipped(ends, LENS)
    assert which.tolist() == [0]
    assert np.isfinite(uv).all()
    assert (inverse > 0).all()
    assert ((uv >= -1e-6) & (uv <= np.array(SIZE) + 1e-6)).all()
    assert not pixels({"a": Points(np.array([[0.0, -9.0, 0.0]]), "source", 1.0)}).any()


def test_all_that_stands_in_space_is_drawn():
    K = np.array([[100.0, 0, 50], [0, 100, 40], [0, 0, 1]])
    for thing in (
        Axes(),
        Camera(K, 100, 80),
        Camera(K, 100, 80, image=np.zeros((80, 100), np.uint8)),
        Mesh(WALL, FACES, wireframe=True),
        Mesh(WALL, FACES, flat=True),
    ):
        assert pixels({"a": thing})[..., 3].any(), type(thing).__name__


def test_degenerate_things_draw_nothing_and_fail_nowhere():
    nothing = {
        "points": Points(np.zeros((0, 3))),
        "lines": Segments(np.zeros((0, 2, 3))),
        "edge": Picture(
            np.zeros((3, 3), np.uint8), width=1.0, T_world_object=np.diag([1, 1, 1, 1.0])
        ),
        "flat": Mesh(np.zeros((3, 3)), np.array([[0, 1, 2]])),
    }
    assert not pixels(nothing)[..., 3].any()


def test_a_frame_holds_what_is_seen_and_leaves_out_grid_and_faint_lines():
    scene = {
        "far": Segments(np.array([[[-9.0, 0, 0], [9.0, 0, 0]]]), opacity=0.2),
        "here": Points(np.array([[2.0, 0.0, 1.0], [3.5, 0.0, 1.2]]), "source", 0.05),
        "word": Label("here", np.array([3.0, 0.0, 1.1])),
    }
    lens = framed([[*stage_of(VIEW), *shapes_of(scene)]], VIEW, SIZE)
    uv, _ = lens.seen(scene["here"].p)
    assert ((uv > 0) & (uv < SIZE)).all()
    assert np.ptp(uv[:, 0]) > 0.25 * SIZE[0]
    assert framed([], VIEW, SIZE).focal == LENS.focal


def test_a_narrow_picture_shows_as_much_in_its_width():
    wide = Lens.of(VIEW, (240, 200))
    narrow = Lens.of(VIEW, (100, 200))
    assert 240 / wide.focal == pytest.approx(100 / narrow.focal)


def everything() -> dict:
    rng = np.random.default_rng(0)
    p = rng.normal(size=(60, 3)) * [1.5, 0.8, 1.0]
    image = rng.integers(0, 255, (20, 30, 3), np.uint8)
    return {
        "points": Points(p, "source", 0.05),
        "lines": Segments(p.reshape(-1, 2, 3), "target", width=4.0),
        "level": Segments(np.array([[[-9.0, 0, 0.3], [9.0, 0, 0.3]]]), "truth"),
        "upright": Segments(np.array([[[0.2, 0, -9.0], [0.2, 0, 9.0]]]), "truth"),
        "glass": Mesh(WALL, FACES, "target", opacity=0.5),
        "twice": Mesh(1.3 * WALL, np.array([*FACES, *FACES]), "wrong", opacity=0.3),
        "wall": Mesh(WALL + np.array([1.0, 0.4, 0.2]), FACES, "highlight"),
        "sheet": Picture(image, width=3.0, opacity=0.7, T_world_object=VIEW.facing(0.0, 0.0)),
    }


@pytest.mark.parametrize("rows", [1, 7, 64])
def test_a_picture_that_is_made_in_bands_is_the_one_that_is_made_whole(monkeypatch, rows):
    whole = pixels(everything())
    monkeypatch.setattr(raster, "BAND", 3 * SIZE[0] * 3 * rows)
    monkeypatch.setattr(raster, "MOST", 5000)
    assert np.array_equal(pixels(everything()), whole)
    assert len(np.unique(whole[..., :3].reshape(-1, 3), axis=0)) > 500


def test_the_memory_of_a_wide_picture_is_that_of_a_band():
    lens = LENS.scaled(12)
    shapes = shapes_of({name: everything()[name] for name in ("glass", "wall", "sheet")})
    tracemalloc.start()
    try:
        painted(shapes, lens, scale=12.0)
        _, most = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
    assert most < 300e6
