"""Relates two images of a plane: the homography, its estimates and its distances.

Convention: `H_b_a` takes pixels of image a to pixels of image b, `uv_b_h ~ H_b_a @ uv_a_h`, and has
Frobenius norm one. `uv_b` are the matches of `uv_a`, row by row.
Reference: Hartley and Zisserman, Multiple View Geometry, 2nd ed. (HZ), chapter 4.
"""

import numpy as np
from jaxtyping import Bool, Float

from workbench.geometry.polylines import segments
from workbench.geometry.refinement import levenberg_marquardt

_FLAT = 1e-9
_SMALLEST = 1e-300
_NEXT, _AFTER = [1, 2, 0], [2, 0, 1]
_ROUNDS = 15  # of inverse iteration at most
_STILL = 1e-14  # how far a unit vector moves in its last one at most


def homogeneous(p: Float[np.ndarray, "*k n d"]) -> Float[np.ndarray, "*k n d+1"]:
    """Return the points with a last coordinate of one appended."""
    return np.concatenate([p, np.ones_like(p[..., :1])], axis=-1)


def normalising_similarity(uv: Float[np.ndarray, "*k n 2"]) -> Float[np.ndarray, "*k 3 3"]:
    """Return the similarity that brings the centroid to 0 and the mean distance from it to √2.

    Reference: Hartley, In Defense of the Eight-Point Algorithm, PAMI 1997, section 5.
    """
    centroid = np.ones(uv.shape[-2]) @ uv / uv.shape[-2]  # quicker than the mean of columns
    u, v = (uv[..., k] - centroid[..., k, None] for k in range(2))
    spread = np.sqrt(u * u + v * v).mean(axis=-1)
    scale = np.sqrt(2.0) / np.where(spread > 0.0, spread, np.sqrt(2.0))
    T = np.zeros((*uv.shape[:-2], 3, 3), uv.dtype)
    T[..., 0, 0] = T[..., 1, 1] = scale
    T[..., :2, 2] = -scale[..., None] * centroid
    T[..., 2, 2] = 1.0
    return T


def transform_pixels(
    H_b_a: Float[np.ndarray, "*k 3 3"], uv_a: Float[np.ndarray, "n 2"]
) -> Float[np.ndarray, "*k n 2"]:
    """Return where each homography takes each pixel, in its precision; NaN at infinity.

    Examples:
        >>> H_b_a = np.array([[1.0, 0, 10], [0, 1, 0], [0, 0, 1]])  # ten columns to the right
        >>> transform_pixels(H_b_a, np.array([[3.0, 4.0]])).tolist()
        [[13.0, 4.0]]
    """
    uv_b_h = H_b_a[..., :2] @ uv_a.T + H_b_a[..., 2:]
    w = uv_b_h[..., 2, :]
    w = np.where(w == 0.0, np.asarray(np.nan, w.dtype), w)
    return np.stack([uv_b_h[..., 0, :] / w, uv_b_h[..., 1, :] / w], axis=-1)


def warped_grid(
    H_b_a: Float[np.ndarray, "3 3"],
    size: Float[np.ndarray, "2"],
    cells: int = 4,
    *,
    pieces: int = 8,
) -> Float[np.ndarray, "n 2 2"]:
    """Return a grid over image a of this (width, height), cut in pieces, as segments in image b."""
    t = np.linspace(0.0, 1.0, cells * pieces + 1)
    ticks = np.linspace(0.0, 1.0, cells + 1)
    lines = [np.column_stack([np.full_like(t, x), t]) for x in ticks]
    lines += [line[:, ::-1] for line in lines]
    ends = np.concatenate([segments(line * size) for line in lines])
    with np.errstate(all="ignore"):
        return transform_pixels(H_b_a, ends.reshape(-1, 2)).reshape(-1, 2, 2)


def transfer_distances(
    H_b_a: Float[np.ndarray, "*k 3 3"],
    uv_a: Float[np.ndarray, "n 2"],
    uv_b: Float[np.ndarray, "n 2"],
) -> Float[np.ndarray, "*k n"]:
    """Return how far each pixel of image a lands from its match, in pixels of b; maybe infinite."""
    uv_b_h = H_b_a[..., :2] @ uv_a.T + H_b_a[..., 2:]
    off = uv_b_h[..., :2, :]
    with np.errstate(divide="ignore", invalid="ignore"):
        off /= uv_b_h[..., 2:, :]
        off -= uv_b.T
        off *= off
        distances = np.sqrt(off[..., 0, :] + off[..., 1, :])
    return np.fmin(distances, np.inf, out=distances)  # at infinity on all sides: not a number


def four_in_general_position(
    uv_a: Float[np.ndarray, "*k 4 2"], uv_b: Float[np.ndarray, "*k 4 2"]
) -> Bool[np.ndarray, "*k"]:
    """Return of each four matches whether some camera can see both quadrangles as one plane.

    False where three pixels lie on one line, and where only some of the four triangles turn over.
    Reference: Chum, Werner and Matas, ICPR 2004 (the oriented constraint, here for a homography).

    Examples:
        >>> uv = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
        >>> four_in_general_position(np.stack([uv, uv]), np.stack([uv, uv[[0, 2, 1, 3]]])).tolist()
        [True, False]
    """
    return _in_general_position(uv_a, uv_b, _triangle_areas(uv_a), areas_b=_triangle_areas(uv_b))


def homographies_from_four(
    uv_a: Float[np.ndarray, "*k 4 2"], uv_b: Float[np.ndarray, "*k 4 2"]
) -> Float[np.ndarray, "*k 3 3"]:
    """Return the homography through each four matches in general position, else NaN.

    In image a, x3 = l0 x0 + l1 x1 + l2 x2; in image b, y3 = m0 y0 + m1 y1 + m2 y2. Then the sum of
    (m_i / l_i) y_i (x_j × x_k)' takes all four pixels to their matches (HZ 2.3, example 2.12).
    """
    T = normalising_similarity(np.concatenate([uv_a, uv_b], axis=-2))
    x, y = (homogeneous(uv) @ np.swapaxes(T, -1, -2) for uv in (uv_a, uv_b))
    areas_x, areas_y = _triangle_areas(x), _triangle_areas(y)
    usable = _in_general_position(x, y, areas_x, areas_b=areas_y)
    weights = areas_y[..., :3] / np.where(usable[..., None], areas_x[..., :3], np.nan)
    crosses = cross(x[..., [1, 2, 0], :], x[..., [2, 0, 1], :])
    H = np.linalg.inv(T) @ np.swapaxes(weights[..., None] * y[..., :3, :], -1, -2) @ crosses @ T
    return H / np.sqrt(np.square(H).sum((-2, -1), keepdims=True))


def fit_homography(
    uv_a: Float[np.ndarray, "n 2"],
    uv_b: Float[np.ndarray, "n 2"],
    weights: Float[np.ndarray, " n"] | None = None,
) -> Float[np.ndarray, "3 3"]:
    """Return the homography of weighted matches by the normalised DLT (HZ algorithm 4.2).

    It minimises an algebraic error; `refine_homography` goes on to pixels.

    Raises:
        ValueError: If there are fewer than four matches.

    Examples:
        >>> uv_a = np.array([[0.0, 0], [1, 0], [1, 1], [0, 1]])
        >>> H_b_a = fit_homography(uv_a, 2.0 * uv_a)
        >>> bool(np.allclose(H_b_a / H_b_a[2, 2], np.diag([2.0, 2.0, 1.0])))
        True
    """
    if len(uv_a) < 4 or len(uv_a) != len(uv_b):
        raise ValueError(
            f"a homography needs at least 4 pairs of pixels, got {uv_a.shape} and {uv_b.shape}"
        )
    H = _fitted(uv_a, uv_b, np.ones(len(uv_a)) if weights is None else np.sqrt(weights))
    return H / np.linalg.norm(H)


def fit_homographies(
    uv_a: Float[np.ndarray, "*k n 2"], uv_b: Float[np.ndarray, "*k n 2"]
) -> Float[np.ndarray, "*k 3 3"]:
    """Return the homographies of many pairs of images side by side, as `fit_homography` does."""
    H = _fitted(uv_a, uv_b, np.ones(uv_a.shape[-2]))
    return H / np.linalg.norm(H, axis=(-2, -1), keepdims=True)


def _fitted(uv_a: np.ndarray, uv_b: np.ndarray, root: np.ndarray) -> np.ndarray:
    """Return homographies, at any scale, from matches with the roots of their weights."""
    T_a, T_b = normalising_similarity(np.stack([uv_a, uv_b]))
    x, y = (homogeneous(uv) @ np.swapaxes(T, -1, -2) for uv, T in ((uv_a, T_a), (uv_b, T_b)))
    zero = np.zeros_like(x)
    x = x * root[:, None]
    rows_v = np.concatenate([zero, -x, y[..., 1:2] * x], axis=-1)
    rows_u = np.concatenate([x, zero, -y[..., 0:1] * x], axis=-1)
    H = null_vector(np.concatenate([rows_v, rows_u], axis=-2)).reshape(*x.shape[:-2], 3, 3)
    return np.linalg.inv(T_b) @ H @ T_a


def null_vector(A: Float[np.ndarray, "*k n c"]) -> Float[np.ndarray, "*k c"]:
    """Return the unit vector that A makes smallest: its last right singular vector."""
    return np.linalg.svd(np.linalg.qr(A, mode="r"), full_matrices=True)[2][..., -1, :]


def null_vectors(A: Float[np.ndarray, "k n c"]) -> Float[np.ndarray, "k c"]:
    """Return `null_vector` of many small matrices, to round-off and the sign, by inverse iteration.

    With A = Q R each round solves R'R x = x before; what it leaves of other directions shrinks by
    the square of the two least singular values' ratio. What still moves after it is left to the
    decomposition, such as where the two are alike or the least is 0.
    Reference: Golub and Van Loan, Matrix Computations, 4th ed., 8.2.2.
    """
    triangles = np.asarray(np.linalg.qr(A, mode="r"))
    R = np.moveaxis(triangles, 0, -1).copy()  # a row of numbers for each entry
    x = np.zeros((R.shape[1], len(A)))
    x[-1] = 1.0
    moving = np.ones(len(A), bool)
    with np.errstate(all="ignore"):
        for _ in range(_ROUNDS):
            before = x.copy()
            for i in range(len(x)):  # R' y = x
                x[i] = (x[i] - (R[:i, i] * x[:i]).sum(axis=0)) / R[i, i]
            for i in reversed(range(len(x))):  # R x = y
                x[i] = (x[i] - (R[i, i + 1 :] * x[i + 1 :]).sum(axis=0)) / R[i, i]
            x /= np.sqrt((x * x).sum(axis=0))
            moving = ~(np.abs(x - before).max(axis=0) < _STILL)
            if not moving.any():
                break
    vectors = np.ascontiguousarray(x.T)
    if moving.any():
        vectors[moving] = null_vector(A[moving])
    return vectors


def refine_homography(
    H_b_a: Float[np.ndarray, "3 3"],
    uv_a: Float[np.ndarray, "n 2"],
    uv_b: Float[np.ndarray, "n 2"],
    *,
    weights: Float[np.ndarray, " n"] | None = None,
    steps: int = 10,
) -> Float[np.ndarray, "3 3"]:
    """Return the homography near `H_b_a` of least squared transfer distances (HZ 4.2.2, 4.5)."""
    root = np.ones(len(uv_a)) if weights is None else np.sqrt(weights)
    T_a, T_b = normalising_similarity(np.stack([uv_a, uv_b]))
    # One match per column: sums over rows are quick
    x = T_a @ homogeneous(uv_a).T
    y = (T_b @ homogeneous(uv_b).T)[:2]
    h = (T_b @ H_b_a @ np.linalg.inv(T_a)).ravel()
    # The scale is of no account, so the largest entry stays as it is: its slopes come last
    fixed = np.argmax(np.abs(h))
    place = np.arange(9)
    place[fixed:] -= 1
    place[fixed] = 8
    free = np.arange(9) != fixed

    def linearise(h: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        u, v, w = h.reshape(3, 3) @ x
        inverse = 1.0 / np.where(w == 0.0, _SMALLEST, w)
        u = u * inverse
        v = v * inverse
        x_w = x * (root * inverse)
        slopes = np.zeros((9, 2, x.shape[1]))
        slopes[place[0:3], 0] = slopes[place[3:6], 1] = x_w
        slopes[place[6:9], 0], slopes[place[6:9], 1] = -u * x_w, -v * x_w
        return np.concatenate([root * (u - y[0]), root * (v - y[1])]), slopes[:8].reshape(8, -1).T

    def retract(h: np.ndarray, step: np.ndarray) -> np.ndarray:
        moved = h.copy()
        moved[free] += step
        return moved

    h = levenberg_marquardt(linearise, retract, h / np.abs(h).max(), steps=steps)
    H = np.linalg.inv(T_b) @ h.reshape(3, 3) @ T_a
    return H / np.linalg.norm(H)


def _in_general_position(
    a: np.ndarray, b: np.ndarray, areas_a: np.ndarray, *, areas_b: np.ndarray
) -> np.ndarray:
    turned = areas_a * areas_b
    same = (turned > 0.0).all(-1) | (turned < 0.0).all(-1)
    return np.asarray(same & _broad(a, areas_a) & _broad(b, areas_b))


def _triangle_areas(p: np.ndarray) -> np.ndarray:
    """Return twice the signed areas of the triangles (3 1 2), (3 2 0), (3 0 1) and (0 1 2)."""
    start = p[..., [3, 3, 3, 0], :2]
    v, w = p[..., [1, 2, 0, 1], :2] - start, p[..., [2, 0, 1, 2], :2] - start
    return v[..., 0] * w[..., 1] - v[..., 1] * w[..., 0]


def _broad(p: np.ndarray, areas: np.ndarray) -> np.ndarray:
    """Say whether no triangle is flat beside the extent of the four points."""
    extent = np.square(p[..., 1:, :2] - p[..., :1, :2]).sum(-1).max(-1)
    return np.asarray(np.abs(areas).min(-1) > _FLAT * extent)


def cross(v: Float[np.ndarray, "..."], w: Float[np.ndarray, "..."]) -> Float[np.ndarray, "..."]:
    """Return the cross product; quicker than numpy's on many small blocks."""
    return v[..., _NEXT] * w[..., _AFTER] - v[..., _AFTER] * w[..., _NEXT]
