"""Relates two views of a rigid scene: the fundamental matrix, its estimates and its distances.

Convention: `F` takes a pixel of the first image to its line in the second, `uv_second_h.T @ F @
uv_first_h = 0`, and is scaled to Frobenius norm one. `uv_second` are the matches of `uv_first`, row
by row.
Reference: Hartley and Zisserman, Multiple View Geometry, 2nd ed. (HZ), chapters 9 and 11.
"""

import numpy as np
from jaxtyping import Bool, Float

from workbench.geometry.motions import skew
from workbench.geometry.refinement import levenberg_marquardt
from workbench.geometry.two_views.homography import homogeneous, normalising_similarity, null_vector

_SMALLEST = 1e-300
_THIRDS = np.array([0.0, 2.0, -2.0]) * np.pi / 3.0
_Factors = tuple[np.ndarray, np.ndarray, float]


def fundamental_from_cameras(
    K_first: Float[np.ndarray, "3 3"],
    K_second: Float[np.ndarray, "3 3"],
    T_second_first: Float[np.ndarray, "4 4"],
) -> Float[np.ndarray, "3 3"]:
    """Return the fundamental matrix of two calibrated cameras (HZ 9.6 and 9.12).

    Raises:
        ValueError: If the cameras share their centre: there is no epipolar geometry then.

    Examples:
        >>> T_second_first = np.eye(4)
        >>> T_second_first[0, 3] = -0.2  # the second camera stands 0.2 m to the right
        >>> F = fundamental_from_cameras(np.eye(3), np.eye(3), T_second_first)
        >>> epipolar_lines(F, np.array([[0.3, 0.1]])).round(6).tolist()  # v = 0.1: the same row
        [[0.0, 1.0, -0.1]]
    """
    R_second_first = T_second_first[:3, :3]
    t_second_first = T_second_first[:3, 3]
    if not np.linalg.norm(t_second_first) > 0.0:
        raise ValueError(
            "both cameras stand at one place: translation (0, 0, 0) has no epipolar geometry"
        )
    E = skew(t_second_first) @ R_second_first
    F = np.linalg.inv(K_second).T @ E @ np.linalg.inv(K_first)
    return F / np.linalg.norm(F)


def epipolar_lines(
    F: Float[np.ndarray, "3 3"], uv_first: Float[np.ndarray, "n 2"]
) -> Float[np.ndarray, "n 3"]:
    """Return the second image's lines (a, b, c) of first pixels, NaN at the epipole.

    (a, b) is a unit normal. For lines in the first image pass `F.T`.
    """
    lines = homogeneous(uv_first) @ F.T
    lengths = np.linalg.norm(lines[:, :2], axis=1, keepdims=True)
    return np.divide(lines, lengths, out=np.full_like(lines, np.nan), where=lengths > 0.0)


GENERATORS = np.array([skew(axis) for axis in np.eye(3)])
_FIRST, _SECOND = np.diag([1.0, 0.0, 0.0]), np.diag([0.0, 1.0, 0.0])
# Slopes of diag(cos a, sin a, 0) between two turning rotations: what cos a and sin a contribute
_BY_COSINE = np.concatenate([GENERATORS @ _FIRST, -_FIRST @ GENERATORS, _SECOND[None]])
_BY_SINE = np.concatenate([GENERATORS @ _SECOND, -_SECOND @ GENERATORS, -_FIRST[None]])
_AROUND = np.arange(5)[:, None] % 3 * 3 + np.arange(5) % 3
"""Where a 3 x 3 matrix, flat, has the entries of one that goes on around in both directions."""


def sampson_distances(
    F: Float[np.ndarray, "*k 3 3"],
    uv_first: Float[np.ndarray, "n 2"],
    uv_second: Float[np.ndarray, "n 2"],
) -> Float[np.ndarray, "*k n"]:
    """Return how far, to first order, each match must move to satisfy F, pixels (HZ eq. 11.9).

    The sign is that of `uv_second_h.T @ F @ uv_first_h`. Works in the precision of its input.
    """
    u, v = y = np.ascontiguousarray(uv_second.T)
    a, b, algebraic = _lines(np.moveaxis(F, -2, 0), uv_first.T)
    algebraic += a * u
    algebraic += b * v
    squared = np.square(_lines(np.moveaxis(F, -1, 0)[:2], y)).sum(axis=0)
    squared += np.square(a, out=a)
    squared += np.square(b, out=b)
    np.maximum(squared, np.finfo(squared.dtype).tiny, out=squared)
    return np.divide(algebraic, np.sqrt(squared, out=squared), out=algebraic)


def _lines(
    rows: Float[np.ndarray, "r *k 3"], uv: Float[np.ndarray, "2 n"]
) -> Float[np.ndarray, "r *k n"]:
    """Return each row times each homogeneous pixel, all rows in one product: two at least, for the
    sums of one row alone are rounded otherwise.
    """
    flat = rows.reshape(-1, 3)
    products = flat[:, :2] @ uv
    products += flat[:, 2:]
    return products.reshape(*rows.shape[:-1], -1)


def fundamentals_from_seven(
    uv_first: Float[np.ndarray, "*k 7 2"], uv_second: Float[np.ndarray, "*k 7 2"]
) -> Float[np.ndarray, "*k 3 3 3"]:
    """Return the one or three fundamental matrices through each seven matches (HZ 11.1.2).

    The seven constraints leave a line of matrices, G + root D; its singular ones are the roots of a
    cubic. NaN for roots that are not real, and constraints that are not independent.
    """
    T = normalising_similarity(np.concatenate([uv_first, uv_second], axis=-2))
    T_transposed = np.swapaxes(T, -1, -2)
    x, y = homogeneous(uv_first) @ T_transposed, homogeneous(uv_second) @ T_transposed
    constraints = (y[..., :, None] * x[..., None, :]).reshape(*x.shape[:-1], 9)
    basis, triangle = np.linalg.qr(np.swapaxes(constraints, -1, -2), mode="complete")
    diagonal = np.abs(np.diagonal(triangle, axis1=-2, axis2=-1))
    independent = diagonal.min(-1) > 1e-9 * diagonal.max(-1)
    G, D = (np.ascontiguousarray(basis[..., k]).reshape(*x.shape[:-2], 3, 3) for k in (7, 8))
    cofactors_G, cofactors_D = _cofactors(G), _cofactors(D)
    cubic = (  # of det(G + root D), highest power first
        (D[..., 0, :] * cofactors_D[..., 0, :]).sum(-1),
        (G * cofactors_D).sum((-2, -1)),
        (D * cofactors_G).sum((-2, -1)),
        (G[..., 0, :] * cofactors_G[..., 0, :]).sum(-1),
    )
    roots = real_cubic_roots(np.stack(cubic, axis=-1))
    roots = np.where(independent[..., None], roots, np.nan)
    F = G[..., None, :, :] + roots[..., None, None] * D[..., None, :, :]
    F = T_transposed[..., None, :, :] @ F @ T[..., None, :, :]
    return F / np.linalg.norm(F, axis=(-2, -1), keepdims=True)


def orientation_agrees(
    F: Float[np.ndarray, "*k s 3 3"],
    uv_first: Float[np.ndarray, "*k m 2"],
    uv_second: Float[np.ndarray, "*k m 2"],
) -> Bool[np.ndarray, "*k s"]:
    """Return of each matrix whether all m matches can lie in front of both cameras, or all behind.

    Then `epipole x uv_second_h` and `F @ uv_first_h` point the same way.
    Reference: Chum, Werner and Matas, Epipolar Geometry Estimation via RANSAC Benefits from the
    Oriented Epipolar Constraint, ICPR 2004, eq. 2.
    """
    crosses = _cofactors(np.swapaxes(F, -1, -2)).reshape(-1, 3, 3)  # of its columns
    longest = np.square(crosses).sum(-1).argmax(-1)
    epipole = crosses[np.arange(len(crosses)), longest].reshape(*F.shape[:-2], 3)
    twisted = skew(epipole) @ F  # (e x y) . (F x) = -y' twisted x
    x, y = homogeneous(uv_first)[..., None, :, :], homogeneous(uv_second)[..., None, :, :]
    side = ((y @ twisted) * x) @ np.ones(3)
    return np.asarray((side > 0.0).all(-1) | (side < 0.0).all(-1))


def fit_fundamental(
    uv_first: Float[np.ndarray, "n 2"],
    uv_second: Float[np.ndarray, "n 2"],
    weights: Float[np.ndarray, " n"] | None = None,
) -> Float[np.ndarray, "3 3"]:
    """Return the fundamental matrix of weighted matches by the normalised eight-point algorithm.

    It minimises an algebraic error; `refine_fundamental` goes on to pixels. Matches of one plane,
    or of a camera that only turned, give one of many solutions.
    Reference: Hartley, In Defense of the Eight-Point Algorithm, PAMI 1997.

    Raises:
        ValueError: If there are fewer than eight matches.
    """
    if len(uv_first) < 8 or len(uv_first) != len(uv_second):
        raise ValueError(
            f"eight points need at least 8 pairs of pixels, got {uv_first.shape} and"
            f" {uv_second.shape}"
        )
    uv = np.stack([uv_first, uv_second])
    T_first, T_second = normalising_similarity(uv)
    x, y = homogeneous(uv)
    constraints = epipolar_constraints((T_first @ x.T).T, (T_second @ y.T).T)
    if weights is not None:
        constraints = constraints * np.sqrt(weights)[:, None]
    F = T_second.T @ rank_two(null_vector(constraints).reshape(3, 3)) @ T_first
    return F / np.linalg.norm(F)


def epipolar_constraints(
    x_h: Float[np.ndarray, "n 3"], y_h: Float[np.ndarray, "n 3"]
) -> Float[np.ndarray, "n 9"]:
    """Return one row per match whose product with F, row by row, is y' F x (HZ eq. 11.3)."""
    # Long columns: a match at a time is slower, most of all from columns
    return outer_products(y_h.T, x_h.T).T


def rank_two(F: Float[np.ndarray, "3 3"]) -> Float[np.ndarray, "3 3"]:
    """Return the nearest matrix of rank two: the smallest singular value dropped (HZ 11.1.1)."""
    U, s, Vt = np.linalg.svd(F)
    return (U[:, :2] * s[:2]) @ Vt[:2]


def epipoles(F: Float[np.ndarray, "3 3"]) -> tuple[Float[np.ndarray, "3"], Float[np.ndarray, "3"]]:
    """Return the epipoles (u, v, w) in both images, F e = 0 and F' e' = 0 (HZ 9.2.4).

    Examples:
        >>> first, _ = epipoles(np.array([[0.0, -1.0, 5.0], [1.0, 0.0, -3.0], [-5.0, 3.0, 0.0]]))
        >>> (first / first[2]).round(9).tolist()
        [3.0, 5.0, 1.0]
    """
    U, _, Vt = np.linalg.svd(F)
    return Vt[2], U[:, 2]


def refine_fundamental(
    F: Float[np.ndarray, "3 3"],
    uv_first: Float[np.ndarray, "n 2"],
    uv_second: Float[np.ndarray, "n 2"],
    *,
    weights: Float[np.ndarray, " n"] | None = None,
    steps: int = 10,
) -> Float[np.ndarray, "3 3"]:
    """Return the matrix of rank two near `F` with the smallest sum of squared Sampson distances.

    The unknown is F = U diag(cos a, sin a, 0) V': two rotations and an angle. Never worse than `F`
    with its smallest singular value dropped.
    Reference: Bartoli and Sturm, Nonlinear Estimation of the Fundamental Matrix with Minimal
    Parameters, PAMI 2004, section 4.
    """
    root = np.ones(len(uv_first)) if weights is None else np.sqrt(weights)
    T = normalising_similarity(np.concatenate([uv_first, uv_second]))
    # One match per column: sums over rows are quick
    x, y = (T @ homogeneous(uv).T for uv in (uv_first, uv_second))
    outer = outer_products(y, x)

    def linearise(unknown: _Factors) -> tuple[np.ndarray, np.ndarray]:
        residuals, by_F = sampson_slopes(_compose(unknown), x, y, outer=outer)
        return root * residuals, (_tangent(unknown) @ by_F * root).T

    def retract(unknown: _Factors, step: np.ndarray) -> _Factors:
        U, V, angle = unknown
        turn_U, turn_V = _turns(step[:6].reshape(2, 3))
        return U @ turn_U, V @ turn_V, angle + step[6]

    back = np.linalg.inv(T)
    U, s, Vt = np.linalg.svd(back.T @ F @ back)
    start = (U, Vt.T, np.arctan2(s[1], s[0]))
    F = T.T @ _compose(levenberg_marquardt(linearise, retract, start, steps=steps)) @ T
    return F / np.linalg.norm(F)


def outer_products(
    y: Float[np.ndarray, "3 n"], x: Float[np.ndarray, "3 n"]
) -> Float[np.ndarray, "9 n"]:
    """Return the products y_i x_j of each column."""
    return (y[:, None, :] * x[None, :, :]).reshape(9, -1)


def sampson_slopes(
    F: Float[np.ndarray, "3 3"],
    x: Float[np.ndarray, "3 n"],
    y: Float[np.ndarray, "3 n"],
    *,
    outer: Float[np.ndarray, "9 n"],
) -> tuple[Float[np.ndarray, " n"], Float[np.ndarray, "9 n"]]:
    """Return the signed Sampson distances, and their slopes by the nine entries of F.

    x and y are homogeneous pixels in columns, `outer` their unchanging `outer_products(y, x)`.
    """
    lines_y = F @ x
    lines_x = F.T @ y
    lines_y[2] = lines_x[2] = 0.0
    squared = np.square(lines_y).sum(0) + np.square(lines_x).sum(0)
    inverse = 1.0 / np.sqrt(np.maximum(squared, _SMALLEST))
    residuals = F.ravel() @ outer * inverse
    # The quotient rule: the numerator changes by y x', half the squared scale by l_y x' + y l_x'.
    share = residuals * inverse
    by_F = outer_products((y - share * lines_y) * inverse, x)
    by_F -= outer_products(y, share * inverse * lines_x)
    return residuals, by_F


def real_cubic_roots(coefficients: Float[np.ndarray, "*k 4"]) -> Float[np.ndarray, "*k 3"]:
    """Return the real roots of a x^3 + b x^2 + c x + d, NaN for others, and all NaN where a = 0.

    Reference: Press et al., Numerical Recipes, 3rd ed., 5.6, eq. 5.6.10 to 5.6.18.
    """
    with np.errstate(all="ignore"):
        b, c, d = (coefficients[..., i] / coefficients[..., 0] for i in (1, 2, 3))
        middle = b / 3.0
        Q = middle * middle - c / 3.0
        R = middle * (middle * middle - 0.5 * c) + 0.5 * d
        beyond = R * R - Q * Q * Q  # below 0 there are three
        root = np.sqrt(np.abs(Q))
        third = np.arccos(np.clip(R / root**3, -1.0, 1.0)) / 3.0
        roots = -2.0 * root * np.cos(third + _THIRDS.reshape(3, *[1] * b.ndim))
        A = -np.copysign(np.cbrt(np.abs(R) + np.sqrt(np.maximum(beyond, 0.0))), R)
        alone = A + np.where(A == 0.0, 0.0, Q / A)
        single = ~(beyond < 0.0)
        roots[0, single] = alone[single]
        roots[1:, single] = np.nan
        roots -= middle
        # The closed form cancels where a is small: two Newton steps put that right
        for _ in range(2):
            value = ((roots + b) * roots + c) * roots + d
            slope = (3.0 * roots + 2.0 * b) * roots + c
            roots -= np.where(slope == 0.0, 0.0, value / slope)
    return np.moveaxis(roots, 0, -1)


def _compose(factors: _Factors) -> np.ndarray:
    U, V, angle = factors
    return (U[:, :2] * np.array([np.cos(angle), np.sin(angle)])) @ V[:, :2].T


def _tangent(factors: _Factors) -> np.ndarray:
    """Return the entries of F differentiated by the turn of U, that of V and the angle: (7, 9)."""
    U, V, angle = factors
    return (U @ (np.cos(angle) * _BY_COSINE + np.sin(angle) * _BY_SINE) @ V.T).reshape(7, 9)


def _turns(w: Float[np.ndarray, "k 3"]) -> Float[np.ndarray, "k 3 3"]:
    """Return rotations that are `exp(skew(w))` to second order (Cayley's map)."""
    half = skew(0.5 * w)
    return np.eye(3) + (2.0 / (1.0 + 0.25 * np.square(w).sum(1)))[:, None, None] * (
        half + half @ half
    )


def _cofactors(A: np.ndarray) -> np.ndarray:
    """Return the matrix of cofactors."""
    wide = A.reshape(*A.shape[:-2], 9)[..., _AROUND]
    first = wide[..., 1:4, 1:4] * wide[..., 2:, 2:]
    other = wide[..., 1:4, 2:] * wide[..., 2:, 1:4]
    return first - other
