"""What students hand in for constraint_rows."""

import numpy as np

NAMED = {
    "wrong_transposed_first": "rows for columns",
    "wrong_v11_only": "no difference",
    "wrong_plus": "added",
    "wrong_order_of_rows": "swapped",
    "wrong_v22_first": "other sign",
    "wrong_no_symmetry": "mixed once",
    "wrong_upper_triangle_order": "row by row",
    "wrong_h2_h3": "columns one too far",
}


def v(H, i, j):
    return np.array(
        [
            H[0, i] * H[0, j],
            H[0, i] * H[1, j] + H[1, i] * H[0, j],
            H[1, i] * H[1, j],
            H[2, i] * H[0, j] + H[0, i] * H[2, j],
            H[2, i] * H[1, j] + H[1, i] * H[2, j],
            H[2, i] * H[2, j],
        ]
    )


def right_zhang(H):
    return np.array([v(H, 0, 1), v(H, 0, 0) - v(H, 1, 1)])


def right_unpacked(H):
    (a, d, _), (b, e, _), (c, f, _) = H
    return np.array(
        [
            [a * d, a * e + b * d, b * e, c * d + a * f, c * e + b * f, c * f],
            [
                a * a - d * d,
                2 * (a * b - d * e),
                b * b - e * e,
                2 * (a * c - d * f),
                2 * (b * c - e * f),
                c * c - f * f,
            ],
        ]
    )


def right_kron(H):
    pick = [0, 4, 8]
    h1, h2 = H[:, 0], H[:, 1]

    def fold(M):
        S = M + M.T
        return np.array([M[0, 0], S[0, 1], M[1, 1], S[0, 2], S[1, 2], M[2, 2]])

    return np.stack([fold(np.outer(h1, h2)), fold(np.outer(h1, h1) - np.outer(h2, h2))])


def right_duplication(H):
    D = np.zeros((9, 6))
    for k, (i, j) in enumerate([(0, 0), (0, 1), (1, 1), (0, 2), (1, 2), (2, 2)]):
        D[3 * i + j, k] = D[3 * j + i, k] = 1
    h1, h2 = H[:, 0], H[:, 1]
    return np.vstack([np.kron(h1, h2) @ D, (np.kron(h1, h1) - np.kron(h2, h2)) @ D])


def wrong_transposed_first(H):
    H = H.T
    return np.array([v(H, 0, 1), v(H, 0, 0) - v(H, 1, 1)])


def wrong_v11_only(H):
    return np.array([v(H, 0, 1), v(H, 0, 0)])


def wrong_plus(H):
    return np.array([v(H, 0, 1), v(H, 0, 0) + v(H, 1, 1)])


def wrong_order_of_rows(H):
    return np.array([v(H, 0, 0) - v(H, 1, 1), v(H, 0, 1)])


def wrong_v22_first(H):
    return np.array([v(H, 0, 1), v(H, 1, 1) - v(H, 0, 0)])


def wrong_no_symmetry(H):
    def w(a, b):
        return np.array(
            [a[0] * b[0], a[0] * b[1], a[1] * b[1], a[0] * b[2], a[1] * b[2], a[2] * b[2]]
        )

    return np.array([w(H[:, 0], H[:, 1]), w(H[:, 0], H[:, 0]) - w(H[:, 1], H[:, 1])])


def wrong_upper_triangle_order(H):
    i, j = np.triu_indices(3)
    M = np.outer(H[:, 0], H[:, 1])
    N = np.outer(H[:, 0], H[:, 0]) - np.outer(H[:, 1], H[:, 1])
    twice = np.where(i == j, 0.5, 1.0)
    return np.array([(M + M.T)[i, j] * twice, (N + N.T)[i, j] * twice])


def wrong_h2_h3(H):
    return np.array([v(H, 1, 2), v(H, 1, 1) - v(H, 2, 2)])


def wrong_small_ones_scaled(H):
    return right_zhang(H / np.linalg.norm(H)) if np.linalg.norm(H) < 0.1 else right_zhang(H)
