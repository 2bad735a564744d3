"""Corners of a board in people's own pictures: read from a file, or found in pictures."""

import functools
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Literal

import numpy as np
from jaxtyping import Float

from workbench.apart import apart, note
from workbench.data.files import stamp, word_rows
from workbench.data.files.arrays import read_arrays
from workbench.data.pictures import (
    Pictures,
    grey_picture,
    holds_many,
    matched,
    names_in,
    pictures_of,
    stamp_of,
)
from workbench.data.views.board_corners import board_corners
from workbench.data.views.boards import board_points
from workbench.errors import InputError
from workbench.numerals import counted

MOST_VIEWS, MOST_POINTS = 40, 1000
# share by which the shape of a picture may differ from that which corners were found in
STRETCHED = 0.01
Which = Literal["first", "second"]
_BOARD = ("object_points", "p_board", "board")
_PIXELS = (
    ("left", "right"),
    ("uv", "uv2"),
    ("corners", "corners2"),
    ("image_points", "image_points2"),
)
_SIZES = (
    (640, 480), (752, 480), (800, 600), (1024, 768), (1280, 720), (1280, 960), (1600, 1200), (1920, 1080), (2048, 1536),  # noqa: E501
    (2592, 1944), (3264, 2448), (3840, 2160), (4032, 3024), (5184, 3456), (6000, 4000),
)  # fmt: skip


@dataclass(frozen=True, eq=False, kw_only=True)
class Corners:
    """Corners of a file.

    Attributes:
        p_board: Points of the board, in the file's unit, Z = 0.
        uv: Their pixels in every view that is left.
        names: What the views are called; empty where the file does not say.
        stated: Width and height of the pictures, as the file says, or None.
        left_out: Views, from 0, that are not in `uv`: too many of their corners have no number.
    """

    p_board: Float[np.ndarray, "n 3"]
    uv: Float[np.ndarray, "k n 2"]
    names: tuple[str, ...] = ()
    stated: tuple[int, int] | None = None
    left_out: tuple[int, ...] = ()

    @property
    def count(self) -> int:
        """How many views the file has."""
        return len(self.uv) + len(self.left_out)

    @property
    def views(self) -> tuple[int, ...]:
        """The numbers of the views in `uv`, as the file counts them from 0."""
        return tuple(view for view in range(self.count) if view not in self.left_out)

    @property
    def size(self) -> tuple[int, int]:
        """Width and height: as stated, or the least usual size that holds all corners."""
        return self.stated or _size_of(self.uv)


@apart
def read_corners(path: Path, which: Which = "first") -> Corners:
    """Return the corners of a file, of the first or the second camera.

    Formats: npz with object_points (n, 3) or (n, 2), and left, corners, uv or image_points (k, n,
    2), a second camera's in right, corners2, uv2 or image_points2, and optionally size (width,
    height) and what the pictures are called (names, or left_names, right_names and so on); or lines
    of text `view X Y u v`. Corners with NaN or infinity are left out, and counted; all views have
    the same points, so with a corner goes its point in all views, or its view: whichever lacks the
    larger share of its corners.

    Raises:
        InputError: If it is no such file, too little is left, or the board is not flat, not broad,
            or not the same in all views.
    """
    stamp(path)
    given = _from_arrays(path, which) if path.suffix.lower() == ".npz" else _from_text(path)
    if given.count > MOST_VIEWS:
        raise InputError(
            f"{path.name}: {given.count} views; from 2 to {MOST_VIEWS} are calibrated from"
        )
    if len(given.p_board) > MOST_POINTS:
        raise InputError(
            f"{path.name}: {len(given.p_board)} points on the board; from 4 to {MOST_POINTS} are"
            " calibrated from"
        )
    corners = _with_numbers(given, path.name)
    p, uv = corners.p_board, corners.uv
    left = " left without NaN and infinity" if corners is not given else ""
    if len(uv) < 2:
        raise InputError(
            f"{path.name}: {len(uv)} views{left}; from 2 to {MOST_VIEWS} are calibrated from"
        )
    if len(p) < 4:
        raise InputError(
            f"{path.name}: {len(p)} points on the board{left}; from 4 to {MOST_POINTS} are"
            " calibrated from"
        )
    reach = np.linalg.svd(p[:, :2] - p[:, :2].mean(axis=0), compute_uv=False)
    if not reach[1] > 1e-6 * reach[0] > 0 or np.ptp(p[:, 2]) > 1e-6 * reach[0]:
        raise InputError(
            f"{path.name}: the board's points lie on one line, or not in a plane Z = 0"
        )
    if (np.ptp(uv, axis=1).min(axis=1) <= 0).any():
        raise InputError(f"{path.name}: in a view all corners are on one row or column of pixels")
    return corners


def pictures_below(corners: Corners, path: Path, only: int) -> Pictures:
    """Return a person's own pictures in which corners were found, as large as these or shrunk.

    `path` is a folder or a zip, matched by the names of views or in order; or a picture of the view
    `only`. The corners have to lie in the pictures, or their file says of which size these were.

    Raises:
        InputError: If they are no pictures, not as many as views, or of another size than each
            other or the corners.
    """
    count = corners.count
    names = tuple(path.name if view == min(only, count - 1) else None for view in range(count))
    pictures = pictures_of(path, matched(path, corners.names, count) if holds_many(path) else names)
    w, h = pictures.size
    u, v = corners.uv.reshape(-1, 2).max(axis=0)
    stated = corners.stated
    if stated is None and not (u < w and v < h):
        raise InputError(
            f"{path.name or path}: pictures of {w} x {h} pixels, and corners as far as ({u:.0f},"
            f" {v:.0f})"
        )
    if stated is not None and abs(w * stated[1] / (h * stated[0]) - 1) > STRETCHED:
        raise InputError(
            f"{path.name or path}: pictures of {w} x {h} pixels, and corners of {stated[0]} x"
            f" {stated[1]}"
        )
    return pictures


def find_corners(path: Path, columns: int, rows: int) -> tuple[Corners, Pictures, tuple[str, ...]]:
    """Return a board's corners found in a person's pictures, these pictures, and the others' names.

    Squares are as large as ours, since nobody can tell: it changes how far away boards are, and
    nothing else.

    Raises:
        InputError: If they are no pictures of one size, too many, or fewer than two show such a
            board.
    """
    names = names_in(path) if holds_many(path) else (path.name,)
    if len(names) > MOST_VIEWS:
        raise InputError(
            f"{path.name or path}: {len(names)} pictures; up to {MOST_VIEWS} are calibrated from"
        )
    size = pictures_of(path, names).size
    by_name = {
        name: _found(path, name, stamp_of(path, name), columns=columns, rows=rows) for name in names
    }
    with_board = {name: uv for name, uv in by_name.items() if uv is not None}
    if len(with_board) < 2:
        raise InputError(
            f"{path.name or path}: a whole board of {columns} x {rows} inner corners in"
            f" {len(with_board)} of {len(names)} pictures; two are needed, of a board of that shape"
        )
    corners = Corners(
        p_board=board_points(columns, rows),
        uv=np.stack(list(with_board.values())),
        names=tuple(with_board),
        stated=size,
    )
    return (
        corners,
        Pictures(path, tuple(with_board), size),
        tuple(name for name in names if name not in with_board),
    )


@functools.lru_cache(maxsize=4 * MOST_VIEWS)
def _found(
    path: Path, name: str, _stamp: tuple[int, int], *, columns: int, rows: int
) -> np.ndarray | None:
    return board_corners(grey_picture(path, name), columns, rows)


def _with_numbers(given: Corners, name: str) -> Corners:
    """Return the views and points that all have numbers, and tell what was left out."""
    unknown: np.ndarray = np.asarray(
        ~np.isfinite(given.uv).all(axis=2) | ~np.isfinite(given.p_board).all(axis=1)
    )
    if not unknown.any():
        return given
    if unknown.all():
        raise InputError(f"{name}: all {unknown.size:,} corners are NaN or infinite")
    views, points = np.arange(unknown.shape[0]), np.arange(unknown.shape[1])
    while (missing := unknown[np.ix_(views, points)]).any():
        of_views, of_points = missing.mean(axis=1), missing.mean(axis=0)
        if of_views.max() > of_points.max():
            views = np.delete(views, of_views.argmax())
        else:
            points = np.delete(points, of_points.argmax())
    without = tuple(view for view in range(given.count) if view not in views)
    lost = []
    if without:
        lost.append(f"{'view' if len(without) == 1 else 'views'} {', '.join(map(str, without))}")
    if len(points) < len(given.p_board):
        lost.append(
            f"{counted(len(given.p_board) - len(points), 'point')} of the board in all views"
        )
    note(
        f"{name}: {int(unknown.sum()):,} of {counted(unknown.size, 'corner')} left out, NaN or"
        f" infinite, and with them {' and '.join(lost)}."
    )
    return replace(
        given,
        p_board=given.p_board[points],
        uv=given.uv[np.ix_(views, points)],
        left_out=without,
    )


def _from_arrays(path: Path, which: Which) -> Corners:
    arrays = read_arrays(path.read_bytes(), path.name)
    board = next((arrays[name] for name in _BOARD if name in arrays), None)
    pair = next((names for names in _PIXELS if names[0] in arrays), None)
    if board is None or pair is None:
        raise InputError(
            f"{path.name}: no arrays object_points and corners (left and right), but"
            f" {', '.join(arrays) or 'nothing'}"
        )
    if which == "second" and pair[1] not in arrays:
        raise InputError(f"{path.name}: no second camera: it has no array {pair[1]}")
    uv = arrays[pair[which == "second"]]
    if uv.ndim == 4 and uv.shape[2] == 1:
        uv = uv[:, :, 0]  # as OpenCV has them
    if board.ndim == 3 and len(board):
        board = board[0]
    shapes = (
        board.ndim == 2
        and board.shape[1] in (2, 3)
        and uv.ndim == 3
        and uv.shape[1:] == (len(board), 2)
    )
    if not shapes or board.dtype.kind not in "fiu" or uv.dtype.kind not in "fiu":
        raise InputError(
            f"{path.name}: arrays {board.shape} and {uv.shape}, where (n, 3) and (k, n, 2) are"
            " wanted"
        )
    p = np.zeros((len(board), 3))
    p[:, : board.shape[1]] = board
    size = arrays.get("size", arrays.get("image_size"))
    if size is not None and not (
        size.shape == (2,) and size.dtype.kind in "iuf" and size.min() > 0 and size.max() < 1e5
    ):
        raise InputError(f"{path.name}: size is two numbers, width and height in pixels")
    keys = (f"{pair[which == 'second']}_names", "names")
    names = next(
        (arrays[key] for key in keys if key in arrays and arrays[key].shape == uv.shape[:1]),
        np.empty(0, str),
    )
    return Corners(
        p_board=p,
        uv=uv.astype(float),
        names=tuple(names.tolist()) if names.dtype.kind == "U" else (),
        stated=None if size is None else (int(size[0]), int(size[1])),
    )


def _from_text(path: Path) -> Corners:
    views: dict[str, list[list[float]]] = {}
    for i, (view, *words) in word_rows(path, "corners", (".csv", ".txt")):
        try:
            numbers = [float(word) for word in words]
        except ValueError:
            if views:
                raise InputError(
                    f"{path.name}, line {i}: not numbers X Y u v behind the view"
                ) from None
            continue  # a line of names
        if len(numbers) != 4:
            raise InputError(
                f"{path.name}, line {i}: {len(numbers)} numbers behind the view; X Y u v are wanted"
            )
        views.setdefault(view, []).append(numbers)
    if len({len(rows) for rows in views.values()}) > 1:
        raise InputError(f"{path.name}: not all views have the same number of points")
    if not views:
        raise InputError(f"{path.name}: no lines view X Y u v")
    table = np.array(list(views.values()))
    known: np.ndarray = np.asarray(np.isfinite(table).all(axis=2))
    # of each point, in the first view that has it
    first = table[known.argmax(axis=0), np.arange(table.shape[1]), :2]
    if np.abs(table[:, :, :2] - first)[known].max(initial=0.0) > 0:
        raise InputError(
            f"{path.name}: the views do not list the same points of the board in the same order"
        )
    p = np.column_stack([first, np.zeros(table.shape[1])])
    return Corners(
        p_board=p, uv=np.where(known[:, :, None], table[:, :, 2:], np.nan), names=tuple(views)
    )


def _size_of(uv: np.ndarray) -> tuple[int, int]:
    """Return the least usual size of a picture that holds all pixels."""
    if not np.isfinite(uv).all() or not uv.size:
        return _SIZES[0]
    u, v = uv.reshape(-1, 2).max(axis=0)
    return next(
        ((w, h) for w, h in _SIZES if u < w and v < h), (int(1.05 * u) + 1, int(1.05 * v) + 1)
    )
