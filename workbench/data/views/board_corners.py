"""The corners of a checkerboard in a picture: saddles of brightness, joined to a grid square by
square, then refined.

Reference: Bennett and Lasenby, ChESS: quick and robust detection of chess-board features, Computer
Vision and Image Understanding 118, 2014 (the ring around a corner). Geiger, Moosmann, Car and
Schuster, Automatic camera and range sensor calibration using a single shot, ICRA 2012, section III
(a board grown from a corner). Foerstner and Guelch, A fast operator for detection and precise
location of distinct points, corners and centres of circular features, 1987 (refinement).
"""

from collections.abc import Iterator
from typing import Any

import numpy as np
import scipy
from jaxtyping import Complex, Float, Int, UInt8

# pixels along the longer side at most, to which a picture is shrunk where corners are sought
SIDES = (
    800,
    1200,
    400,
)
# pixels: of the saddles, of the ring around one, between two
BLUR = 1.5
RING = 4.5
APART = 7
MOST, SEEDS = 500, 120  # saddles that are looked at, and those from which a board is grown
FOURFOLD = 0.55  # share of a ring's changes that two dark and two bright sectors make
# share of them by which its opposite sides may differ: they do where a square meets the board's rim
UNLIKE = 0.2
FAINT = 4.0  # grey levels: rings that change less are noise
NEAR = 0.3  # of a square's edge: how far a corner may be from where its neighbours let expect it
# of the shortest edge: half the window in which a corner is refined; wider ones see other corners'
# edges
REACH = 0.3
ITERATIONS = 40
STILL = 1e-3  # pixels

Table = Int[np.ndarray, "rows columns"]


def board_corners(
    grey: UInt8[np.ndarray, "h w"], columns: int, rows: int
) -> Float[np.ndarray, "n 2"] | None:
    """Return the inner corners of a whole checkerboard, pixels, row by row; or None.

    Rows run to the right where the first corner is at the upper left. That is the one of the two
    ends between dark squares where colours tell them apart, else the upper one. None too where the
    board is larger.
    """
    for side in SIDES:
        k = -(-max(grey.shape) // side)
        h, w = (length // k for length in grey.shape)
        if min(h, w) <= 2 * RING + 1:
            return None
        small = (
            grey[: h * k, : w * k]
            .reshape(h, k, w, k)
            .mean(axis=(1, 3), dtype=np.float32)
            .astype(float)
        )
        uv, wave = _saddles(small)
        for table in _tables(uv, wave, columns, rows=rows):
            corners = k * (uv[_from_the_first(uv, wave, table)] + 0.5) - 0.5
            edges = [np.linalg.norm(np.diff(corners, axis=axis), axis=2).min() for axis in (0, 1)]
            return refined(grey, corners.reshape(-1, 2), max(2, round(REACH * min(edges))))
    return None


def refined(
    grey: UInt8[np.ndarray, "h w"], uv: Float[np.ndarray, "n 2"], half: int
) -> Float[np.ndarray, "n 2"]:
    """Return corners where the gradients around them, at right angles to the way there, put them.

    The window is twice `half` wide, pixels; gradients count less towards its border. A corner that
    would leave it stays.

    Reference: Foerstner and Guelch 1987; OpenCV's cornerSubPix, whose fixed points these are.
    """
    dy, dx = np.mgrid[-half : half + 1, -half : half + 1].reshape(2, -1)
    weight = np.exp(-(dx**2 + dy**2) / half**2)
    corners = uv.copy()

    def level(v: int, u: int) -> np.ndarray:
        at = [corners[:, 1:] + dy + v, corners[:, :1] + dx + u]
        return scipy.ndimage.map_coordinates(grey, at, output=float, order=1, mode="nearest")

    for _ in range(ITERATIONS):
        gx = level(0, 1) - level(0, -1)
        gy = level(1, 0) - level(-1, 0)
        xx, xy, yy = weight * gx * gx, weight * gx * gy, weight * gy * gy
        A = np.stack(
            [xx.sum(axis=1), xy.sum(axis=1), xy.sum(axis=1), yy.sum(axis=1)], axis=1
        ).reshape(-1, 2, 2)
        b = np.stack([(xx * dx + xy * dy).sum(axis=1), (xy * dx + yy * dy).sum(axis=1)], axis=1)
        flat = np.linalg.det(A) <= 1e-9 * np.trace(A, axis1=1, axis2=2) ** 2
        move = np.linalg.solve(
            np.where(flat[:, None, None], np.eye(2), A), np.where(flat[:, None], 0.0, b)[..., None]
        )
        corners = corners + move[..., 0]
        away = np.abs(corners - uv).max(axis=1) > half
        corners[away] = uv[away]
        if np.abs(move[~away]).max(initial=0.0) < STILL:
            break
    return corners


def _saddles(grey: np.ndarray) -> tuple[Float[np.ndarray, "n 2"], Complex[np.ndarray, " n"]]:
    """Return pixels around which dark and bright alternate twice, and twice the bright's angle."""
    yy, xx, xy = (
        scipy.ndimage.gaussian_filter(grey, BLUR, order=order) for order in ((2, 0), (0, 2), (1, 1))
    )
    strength = xy * xy - xx * yy
    v, u = np.nonzero((strength == scipy.ndimage.maximum_filter(strength, APART)) & (strength > 0))
    strongest = np.argsort(-strength[v, u], kind="stable")[: 4 * MOST]
    u, v = u[strongest], v[strongest]
    angle = np.arange(32) * np.pi / 16
    around = [v[:, None] + RING * np.sin(angle), u[:, None] + RING * np.cos(angle)]
    ring = scipy.ndimage.map_coordinates(
        scipy.ndimage.gaussian_filter(grey, 1.0), around, order=1, mode="nearest"
    )
    ring -= ring.mean(axis=1, keepdims=True)
    wave = ring @ np.exp(2j * angle) / len(angle)
    changes = np.maximum(np.square(ring).mean(axis=1), 1e-9)
    fourfold = 2 * np.abs(wave) ** 2 > FOURFOLD * changes
    unlike = (
        np.square(ring - np.roll(ring, len(angle) // 2, axis=1)).mean(axis=1) / 4 > UNLIKE * changes
    )
    kept = np.flatnonzero(fourfold & ~unlike & (np.abs(wave) > FAINT))[:MOST]
    return np.column_stack([u, v])[kept].astype(float), wave[kept] / np.abs(wave[kept])


def _tables(uv: np.ndarray, wave: np.ndarray, columns: int, *, rows: int) -> Iterator[Table]:
    """Yield whole boards as tables of saddles, grown from one saddle and two beside it."""
    if len(uv) < columns * rows:
        return
    tree = scipy.spatial.cKDTree(uv)
    known = set[int]()
    for seed in range(min(len(uv), SEEDS)):
        if seed in known:
            continue  # of a board that was grown already
        near = np.asarray(tree.query(uv[seed], k=min(9, len(uv)))[1])[1:]
        near = near[_differ(wave[seed], wave[near])]
        for nearest, other in ((near[0], k) for k in near[1:4]):
            x, y = uv[nearest] - uv[seed], uv[other] - uv[seed]
            turn = x[0] * y[1] - x[1] * y[0]
            if abs(turn) > 0.4 * np.linalg.norm(x) * np.linalg.norm(y):
                right, down = (nearest, other) if turn > 0 else (other, nearest)
                grid = {(0, 0): seed, (0, 1): int(right), (1, 0): int(down)}
                grid = _grown(uv, wave, tree, grid=grid)
                yield from _whole(grid, columns, rows)
                if len(grid) >= columns * rows:
                    known |= set(grid.values())


def _differ(wave: Any, other: Any) -> Any:
    """Tell whether dark and bright have changed places: they do from a corner to the next."""
    return np.real(wave * np.conj(other)) < -0.2


def _grown(
    uv: np.ndarray, wave: np.ndarray, tree: "scipy.spatial.cKDTree", *, grid: dict
) -> dict[tuple[int, int], int]:
    """Return the grid with all saddles that lie where those next to them let expect one."""
    used = set(grid.values())
    waiting = list(grid)
    for i, j in waiting:  # grows
        for di, dj in ((0, 1), (1, 0), (0, -1), (-1, 0)):
            behind = (i - di, j - dj)
            place = (i + di, j + dj)
            sides = [
                ((i + s * dj, j + s * di), (i + di + s * dj, j + dj + s * di)) for s in (1, -1)
            ]
            ways = [(grid[behind], grid[i, j])] if behind in grid else []
            ways += [
                (grid[here], grid[ahead]) for here, ahead in sides if here in grid and ahead in grid
            ]
            if place in grid or not ways:
                continue
            step = uv[ways[0][1]] - uv[ways[0][0]]
            away, k = tree.query(uv[grid[i, j]] + step)
            if (
                away < NEAR * np.linalg.norm(step)
                and int(k) not in used
                and _differ(wave[grid[i, j]], wave[k])
            ):
                grid[place] = int(k)
                used.add(int(k))
                waiting.append(place)
    return grid


def _whole(grid: dict[tuple[int, int], int], columns: int, rows: int) -> Iterator[Table]:
    """Yield the board in a grid that has that shape, no further row or column half full."""
    places = np.array(list(grid))
    high, wide = (np.ptp(places, axis=0) + 3).tolist()
    table = np.full((high, wide), -1)
    table[tuple((places - places.min(axis=0) + 1).T)] = list(grid.values())
    for turned in (table, np.rot90(table)):
        for i in range(1, len(turned) - rows):
            for j in range(1, len(turned[0]) - columns):
                framed = turned[i - 1 : i + rows + 1, j - 1 : j + columns + 1] >= 0
                beside = (framed[0], framed[-1], framed[:, 0], framed[:, -1])
                if framed[1:-1, 1:-1].all() and all(line[1:-1].mean() <= 0.5 for line in beside):
                    yield turned[i : i + rows, j : j + columns]


def _from_the_first(uv: np.ndarray, wave: np.ndarray, table: Table) -> Table:
    """Return the table turned so that its first corner is between dark squares, or upper."""
    diagonal = complex(*(uv[table[1, 1]] - uv[table[0, 0]]))
    back = table[::-1, ::-1]
    if sum(table.shape) % 2:  # the two ends differ
        return table if (wave[table[0, 0]] * np.conj(diagonal) ** 2).real < 0 else back
    return table if uv[table[0, 0]].sum() < uv[back[0, 0]].sum() else back
