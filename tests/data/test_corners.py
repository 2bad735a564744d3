"""Own corners: every form that is read, and what is refused in one line."""

from typing import Any

import numpy as np
import pytest

from workbench.apart import told
from workbench.data.views import boards
from workbench.data.views.corners import read_corners
from workbench.errors import InputError

P = boards.board_points(4, 3)


def views(k: int = 3) -> np.ndarray:
    rng = np.random.default_rng(0)
    return 200 + 1000 * P[None, :, :2] + rng.normal(size=(k, len(P), 2))


def without_numbers(*whole: int, some: tuple[tuple[int, int], ...] = (), k: int = 3) -> np.ndarray:
    """Corners of k views, NaN in whole views and in some (view, point)."""
    uv = views(k)
    uv[list(whole)] = np.nan
    for n, place in enumerate(some):
        uv[place][n % 2] = (np.nan, np.inf)[n % 2]
    return uv


@pytest.mark.parametrize(
    "names", [("object_points", "left"), ("p_board", "uv"), ("board", "corners")]
)
def test_arrays_under_several_names(tmp_path, names):
    arrays: dict[str, Any] = {names[0]: P[:, :2], names[1]: views()}
    np.savez(tmp_path / "c.npz", **arrays)
    corners = read_corners(tmp_path / "c.npz")
    np.testing.assert_array_equal(corners.p_board, P)
    np.testing.assert_array_equal(corners.uv, views())
    assert corners.size == (640, 480)


def test_opencvs_shapes_a_second_camera_and_a_size(tmp_path):
    np.savez(
        tmp_path / "c.npz",
        object_points=np.stack([P] * 3).astype(np.float32),
        image_points=views()[:, :, None],
        image_points2=2 * views(),
        size=[800, 500],
    )
    first, second = (read_corners(tmp_path / "c.npz", which) for which in ("first", "second"))
    np.testing.assert_array_equal(second.uv, 2 * first.uv)
    assert first.size == (800, 500)


@pytest.mark.parametrize("header", ["", "view,X,Y,u,v\n", "# a comment\n\n"])
def test_lines_of_text(tmp_path, header):
    lines = [
        f"{i}, {x}, {y}, {u}, {v}"
        for i, uv in enumerate(views())
        for (x, y, _), (u, v) in zip(P, uv, strict=True)
    ]
    (tmp_path / "c.csv").write_text(header + "\n".join(lines))
    corners = read_corners(tmp_path / "c.csv")
    np.testing.assert_allclose(corners.p_board, P)
    np.testing.assert_allclose(corners.uv, views())


@pytest.mark.parametrize(
    ("uv", "kept_views", "kept_points", "message"),
    [
        (
            without_numbers(some=((0, 5), (2, 5), (1, 7))),
            (0, 1, 2),
            10,
            (
                "3 of 36 corners left out, NaN or infinite, and with them 2 points of the board in"
                " all views."
            ),
        ),
        (
            without_numbers(1),
            (0, 2),
            12,
            "12 of 36 corners left out, NaN or infinite, and with them view 1.",
        ),
        (
            without_numbers(1, 4, some=((0, 5),), k=5),
            (0, 2, 3),
            11,
            (
                "25 of 60 corners left out, NaN or infinite, and with them views 1, 4 and 1 point"
                " of the board in all views."
            ),
        ),
    ],
)
@pytest.mark.parametrize("ending", ["npz", "csv"])
def test_corners_without_a_number_are_left_out_and_counted(
    tmp_path, uv, kept_views, *, kept_points, message, ending
):
    path = tmp_path / f"c.{ending}"
    if ending == "npz":
        np.savez(path, board=P, uv=uv)
    else:
        rows = [
            f"{i} {x} {y} {u} {v}"
            for i, of in enumerate(uv)
            for (x, y, _), (u, v) in zip(P, of, strict=True)
        ]
        path.write_text("\n".join(rows))
    corners = read_corners(path)
    assert told(path) == (f"{path.name}: {message}",)
    assert (corners.views, corners.count) == (kept_views, len(uv))
    assert (len(corners.p_board), corners.uv.shape) == (
        kept_points,
        (len(kept_views), kept_points, 2),
    )
    at = [int(np.flatnonzero((p == P).all(axis=1))[0]) for p in corners.p_board]
    np.testing.assert_array_equal(corners.uv, uv[np.ix_(kept_views, at)])


def test_a_point_of_the_board_without_a_number_is_left_out_in_all_views(tmp_path):
    board = P.copy()
    board[3, 0] = np.nan
    np.savez(tmp_path / "c.npz", board=board, uv=views())
    np.testing.assert_array_equal(read_corners(tmp_path / "c.npz").p_board, np.delete(P, 3, axis=0))
    assert told(tmp_path / "c.npz")[0].startswith("c.npz: 3 of 36 corners left out")


def test_a_size_is_guessed_that_holds_all_corners(tmp_path):
    np.savez(tmp_path / "c.npz", board=P, uv=4 * views())
    assert read_corners(tmp_path / "c.npz").size == (1600, 1200)
    np.savez(tmp_path / "c.npz", board=P, uv=100 * views())
    w, h = read_corners(tmp_path / "c.npz").size
    assert w > 100 * views()[..., 0].max()
    assert h > 100 * views()[..., 1].max()


@pytest.mark.parametrize(
    ("arrays", "message"),
    [
        ({}, "no arrays"),
        ({"board": P}, "no arrays object_points and corners"),
        ({"board": P, "uv": views()[0]}, "where"),
        ({"board": P, "uv": views()[:, 1:]}, "where"),
        ({"board": P[:, :1], "uv": views()}, "where"),
        ({"board": P, "uv": views(1)}, "1 views"),
        ({"board": P, "uv": views(41)}, "41 views"),
        ({"board": P[:3], "uv": views()[:, :3]}, "3 points"),
        ({"board": P * [1, 0, 1], "uv": views()}, "one line"),
        ({"board": P + np.arange(12)[:, None] * [0, 0, 1.0], "uv": views()}, "plane"),
        ({"board": P, "uv": np.full_like(views(), np.nan)}, "all 36 corners are NaN or infinite"),
        ({"board": P, "uv": without_numbers(0, 1)}, "1 views left without NaN"),
        (
            {"board": np.where(np.arange(12)[:, None] < 9, np.nan, P), "uv": views()},
            "3 points on the board left without NaN",
        ),
        ({"board": P, "uv": np.full_like(views(), 7.0)}, "one row or column"),
        ({"board": P, "uv": views(), "size": [1, 2, 3]}, "size"),
        ({"board": P, "uv": views(), "size": [-1, 2]}, "size"),
        ({"board": np.full((12, 3), "a"), "uv": views()}, "where"),
        ({"board": np.zeros((0, 4, 3)), "uv": views()}, "where"),
    ],
)
def test_arrays_that_are_refused(tmp_path, arrays, message):
    np.savez(tmp_path / "c.npz", **arrays)
    with pytest.raises(InputError, match=message):
        read_corners(tmp_path / "c.npz")


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "no lines"),
        ("just words", "no lines"),
        ("0 0 0 1\n", "3 numbers"),
        ("0 0 0 1 1\n0 1 0 a b", "line 2: not numbers"),
        ("0 0 0 1 1\n0 1 0 2 2\n1 0 0 3 3", "same number"),
        ("0 0 0 1 1\n1 1 0 2 2", "same points"),
    ],
)
def test_text_that_is_refused(tmp_path, text, message):
    (tmp_path / "c.csv").write_text(text)
    with pytest.raises(InputError, match=message):
        read_corners(tmp_path / "c.csv")


def test_files_that_are_none(tmp_path):
    for name, message in (("none.npz", "no such file"), ("c.png", "text files")):
        if name == "c.png":
            (tmp_path / name).write_bytes(b"\x89PNG")
        with pytest.raises(InputError, match=message):
            read_corners(tmp_path / name)
    (tmp_path / "c.npz").write_bytes(b"PK\x03\x04 broken")
    with pytest.raises(InputError, match="not readable"):
        read_corners(tmp_path / "c.npz")
    np.savez(tmp_path / "d.npz", board=P, uv=views())
    with pytest.raises(InputError, match="no second camera"):
        read_corners(tmp_path / "d.npz", "second")
