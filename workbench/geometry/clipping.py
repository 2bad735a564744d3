"""Cuts segments and triangles at planes, lines at windows, and edges into short pieces.

A plane cuts away whatever is not at a positive signed distance `ahead`; results come with the row
of `p` that each piece comes from. `low` and `high` are opposite corners of a rectangle or box.
Reference: Liang and Barsky, A new concept and method for line clipping, 1984.
"""

import functools
from collections.abc import Callable

import numpy as np
from jaxtyping import Float, Int

MOST_CUTS = 12


def clip_segments(
    p: Float[np.ndarray, "n 2 3"], ahead: Float[np.ndarray, "n 2"]
) -> tuple[Float[np.ndarray, "m 2 3"], Int[np.ndarray, " m"]]:
    """Return the part of each segment that lies ahead of a plane."""
    kept = np.flatnonzero((ahead > 0).any(axis=1))
    p, ahead = p[kept], ahead[kept]
    crossing = _crossing(p[:, 0], p[:, 1], ahead[:, 0], ahead_b=ahead[:, 1])
    return np.where((ahead > 0)[:, :, None], p, crossing[:, None]), kept


def clip_triangles(
    p: Float[np.ndarray, "n 3 3"], ahead: Float[np.ndarray, "n 3"]
) -> tuple[Float[np.ndarray, "m 3 3"], Int[np.ndarray, " m"]]:
    """Return the part of each triangle ahead of a plane: up to two, turning the same way."""
    count = (ahead > 0).sum(axis=1)
    whole, tip, stump = (np.flatnonzero(count == number) for number in (3, 1, 2))
    a, _, _, ab, ac = _lone_corner_first(p[tip], ahead[tip], ahead[tip] > 0)
    _, e, f, de, df = _lone_corner_first(p[stump], ahead[stump], ahead[stump] <= 0)
    pieces = [p[whole], np.stack([a, ab, ac], 1), np.stack([de, e, f], 1), np.stack([de, f, df], 1)]
    return np.concatenate(pieces), np.concatenate([whole, tip, stump, stump])


def clip_to_rectangle(
    uv: Float[np.ndarray, "n 2 2"], low: Float[np.ndarray, "2"], high: Float[np.ndarray, "2"]
) -> tuple[Float[np.ndarray, " n"], Float[np.ndarray, " n"]]:
    """Return from which to which share of its length, in [0, 1], each segment lies in a rectangle.

    Start is not below stop where a segment misses or has NaN ends (Liang and Barsky).
    """
    way = uv[:, 1] - uv[:, 0]
    with np.errstate(divide="ignore", invalid="ignore"):
        to_low, to_high = (low - uv[:, 0]) / way, (high - uv[:, 0]) / way
        start = np.fmax(np.fmin(to_low, to_high).max(axis=1, initial=0.0), 0.0)
        stop = np.fmin(np.fmax(to_low, to_high).min(axis=1, initial=1.0), 1.0)
    return start, np.where(np.isnan(uv).any(axis=(1, 2)), -1.0, stop)


def segments_inside(
    ends: Float[np.ndarray, "n 2 d"], low: Float[np.ndarray, "d"], high: Float[np.ndarray, "d"]
) -> Float[np.ndarray, "m 2 d"]:
    """Return the segments whose ends are both finite and inside a rectangle or box; none is cut."""
    return ends[(np.isfinite(ends) & (ends >= low) & (ends <= high)).all(axis=(1, 2))]


def cut_to_rectangle(
    ends: Float[np.ndarray, "n 2 2"], low: Float[np.ndarray, "2"], high: Float[np.ndarray, "2"]
) -> Float[np.ndarray, "m 2 2"]:
    """Return the parts of segments inside a rectangle; nothing of those whose ends are not finite.

    Examples:
        >>> cut_to_rectangle(
        ...     np.array([[[-3.0, 0.0], [1.0, 0.0]]]), np.full(2, -1.0), np.full(2, 2.0)
        ... ).tolist()
        [[[-1.0, 0.0], [1.0, 0.0]]]
    """
    ends = ends[np.isfinite(ends).all(axis=(1, 2))]
    shares = np.stack(clip_to_rectangle(ends, low, high), axis=1)
    cut = ends[:, :1] + shares[..., None] * (ends[:, 1:] - ends[:, :1])
    return cut[shares[:, 0] < shares[:, 1]]


def clip_lines(
    lines: Float[np.ndarray, "n 3"], low: Float[np.ndarray, "2"], high: Float[np.ndarray, "2"]
) -> Float[np.ndarray, "m 2 2"]:
    """Return the parts of infinite lines (a, b, c), (a, b) a unit normal, inside a rectangle."""
    normals, offsets = lines[:, :2], lines[:, 2:]
    foot = -normals * offsets
    direction = np.column_stack([-normals[:, 1], normals[:, 0]])
    with np.errstate(all="ignore"):
        to_low, to_high = (low - foot) / direction, (high - foot) / direction
    nearer, farther = np.fmin(to_low, to_high), np.fmax(to_low, to_high)
    # over the whole rectangle it comes no farther than rounding: along a side it is all inside
    parallel = np.abs(direction) < 1e-12
    outside = (parallel & ((foot < low) | (foot > high))).any(axis=1)
    enter = np.where(parallel, -np.inf, nearer).max(axis=1, initial=-np.inf)
    leave = np.where(parallel, np.inf, farther).min(axis=1, initial=np.inf)
    seen = (enter < leave) & ~outside
    t = np.stack([enter[seen], leave[seen]], axis=1)
    return foot[seen, None] + t[:, :, None] * direction[seen, None]


def plane_in_box(
    plane: Float[np.ndarray, "4"], low: Float[np.ndarray, "3"], high: Float[np.ndarray, "3"]
) -> Float[np.ndarray, "n 3"]:
    """Return the corners of a plane's part inside a box, in one order for it and its negative."""
    corners = np.array(
        [[(low, high)[bit][axis] for axis, bit in enumerate(bits)] for bits in np.ndindex(2, 2, 2)]
    )
    edges = np.array(
        [(i, j) for i in range(8) for j in range(i + 1, 8) if bin(i ^ j).count("1") == 1]
    )
    sides = corners @ plane[:3] + plane[3]
    start, end = sides[edges[:, 0]], sides[edges[:, 1]]
    cut = (start > 0) != (end > 0)
    if not cut.any():
        return np.zeros((0, 3))
    share = (start[cut] / (start[cut] - end[cut]))[:, None]
    points = (1.0 - share) * corners[edges[cut, 0]] + share * corners[edges[cut, 1]]
    normal = plane[:3] * np.sign(plane[np.argmax(np.abs(plane[:3]))])
    u = np.cross(normal, np.eye(3)[np.argmin(np.abs(normal))])
    v = points - points.mean(axis=0)
    return points[np.argsort(np.arctan2(v @ np.cross(normal, u), v @ u))]


def cut_finely(
    p: Float[np.ndarray, "n c 3"],
    flatten: Callable[[np.ndarray], np.ndarray],
    longest: float,
    *,
    low: Float[np.ndarray, "2"],
    high: Float[np.ndarray, "2"],
) -> tuple[Float[np.ndarray, "m c 3"], Int[np.ndarray, " m"]]:
    """Return segments or triangles cut until no edge is longer than `longest` in a flat picture.

    `flatten` gives places there, (n, 2). What is outside is dropped; edges are halved 12 times at
    most.
    """
    source = np.arange(len(p))
    done = []
    for cuts_left in range(MOST_CUTS, -1, -1):
        xy = flatten(p.reshape(-1, 3)).reshape(*p.shape[:2], 2)
        lowest, highest = over_corners(np.minimum, xy), over_corners(np.maximum, xy)
        inside = np.flatnonzero(((highest >= low) & (lowest <= high)).all(axis=1))
        p, source, xy = p[inside], source[inside], xy[inside]
        edge = np.roll(xy, -1, axis=1) - xy
        long = over_corners(np.maximum, np.einsum("nci,nci->nc", edge, edge)) > longest**2
        if not cuts_left:
            long[:] = False
        done.append((p[~long], source[~long]))
        if not long.any():
            break
        pieces = _halves(p[long]) if p.shape[1] == 2 else _quarters(p[long])
        p = np.concatenate(pieces)
        source = np.tile(source[long], len(pieces))
    return np.concatenate([p for p, _ in done]), np.concatenate([source for _, source in done])


def over_corners(
    choose: np.ufunc, rows: Float[np.ndarray, "n c *more"]
) -> Float[np.ndarray, "n *more"]:
    """Return the minimum or maximum over the few corners of each row, faster than numpy does."""
    return functools.reduce(choose, (rows[:, corner] for corner in range(rows.shape[1])))


def _lone_corner_first(
    p: np.ndarray, ahead: np.ndarray, alone: np.ndarray
) -> tuple[np.ndarray, ...]:
    """Return triangles a, b, c turned so that the lone corner leads, and the cuts on ab and ac."""
    turn = (np.argmax(alone, axis=1)[:, None] + np.arange(3)) % 3
    a, b, c = np.take_along_axis(p, turn[:, :, None], axis=1).transpose(1, 0, 2)
    at_a, at_b, at_c = np.take_along_axis(ahead, turn, axis=1).T
    return a, b, c, _crossing(a, b, at_a, ahead_b=at_b), _crossing(a, c, at_a, ahead_b=at_c)


def _crossing(
    p_a: np.ndarray, p_b: np.ndarray, ahead_a: np.ndarray, *, ahead_b: np.ndarray
) -> np.ndarray:
    """Return where segments a-b cross the plane at which `ahead` is zero, if they do."""
    with np.errstate(divide="ignore", invalid="ignore"):
        return p_a + (ahead_a / (ahead_a - ahead_b))[:, None] * (p_b - p_a)


def _halves(p: np.ndarray) -> list[np.ndarray]:
    middle = 0.5 * (p[:, 0] + p[:, 1])
    return [np.stack([p[:, 0], middle], axis=1), np.stack([middle, p[:, 1]], axis=1)]


def _quarters(p: np.ndarray) -> list[np.ndarray]:
    a, b, c = p[:, 0], p[:, 1], p[:, 2]
    ab, bc, ca = 0.5 * (a + b), 0.5 * (b + c), 0.5 * (c + a)
    return [
        np.stack(corners, axis=1)
        for corners in ((a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca))
    ]
