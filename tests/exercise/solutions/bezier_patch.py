"""What students hand in for bezier_patch."""

from math import comb

import numpy as np

NAMED = {
    "wrong_swapped": "swapped",
    "wrong_transposed_net": "swapped",
    "wrong_powers": "without binomials",
    "wrong_bilinear": "corners alone",
    "wrong_reversed": "backwards",
    "wrong_u_twice": "one parameter",
    "wrong_pascal": "wrong binomials",
    "wrong_lagrange": "through all",
}


def basis(t):
    return np.stack([(1 - t) ** 3, 3 * t * (1 - t) ** 2, 3 * t**2 * (1 - t), t**3], axis=1)


def right_einsum(control, uv):
    return np.einsum("ni,nj,ijk->nk", basis(uv[:, 0]), basis(uv[:, 1]), control)


def right_loops(control, uv):
    answer = np.zeros((len(uv), 3))
    for n, (u, v) in enumerate(uv):
        for i in range(4):
            for j in range(4):
                weight = (
                    comb(3, i) * u**i * (1 - u) ** (3 - i) * comb(3, j) * v**j * (1 - v) ** (3 - j)
                )
                answer[n] += weight * control[i, j]
    return answer


def right_matrix(control, uv):
    M = np.array([[1.0, 0, 0, 0], [-3, 3, 0, 0], [3, -6, 3, 0], [-1, 3, -3, 1]])
    U, V = (np.vander(t, 4, increasing=True) @ M for t in uv.T)
    return np.stack([((U @ control[..., k]) * V).sum(axis=1) for k in range(3)], axis=1)


def right_de_casteljau(control, uv):
    def line(points, t):
        while len(points) > 1:
            points = [(1 - t) * points[k] + t * points[k + 1] for k in range(len(points) - 1)]
        return points[0]

    found = [line([line(list(row), v) for row in control], u) for u, v in uv]
    return np.array(found).reshape(-1, 3)


def right_rows_first(control, uv):
    U, V = basis(uv[:, 0]), basis(uv[:, 1])
    along_u = (U @ control.reshape(4, 12)).reshape(-1, 4, 3)
    return (V[:, :, None] * along_u).sum(axis=1)


def right_tensordot(control, uv):
    weights = basis(uv[:, 0])[:, :, None] * basis(uv[:, 1])[:, None, :]
    return np.tensordot(weights, control, axes=([1, 2], [0, 1]))


def right_scipy(control, uv):
    from scipy.special import comb as choose

    k = np.arange(4)
    U, V = (choose(3, k) * t[:, None] ** k * (1 - t)[:, None] ** (3 - k) for t in uv.T)
    return np.sum(U[:, :, None, None] * V[:, None, :, None] * control, axis=(1, 2))


def right_vectorised_legs(control, uv):
    u, v = uv[:, 0].reshape(-1, 1, 1, 1), uv[:, 1].reshape(-1, 1, 1, 1)
    net = np.broadcast_to(control, (len(uv), 4, 4, 3))
    for _ in range(3):
        net = (1 - u) * net[:, :-1] + u * net[:, 1:]
    for _ in range(3):
        net = (1 - v) * net[:, :, :-1] + v * net[:, :, 1:]
    return net[:, 0, 0]


def right_horner(control, uv):
    def cubic(a, b, c, d, t):
        s = 1 - t
        return a * s**3 + 3 * b * s * s * t + 3 * c * s * t * t + d * t**3

    u, v = uv[:, :1], uv[:, 1:]
    rows = [cubic(*(control[i, j] for j in range(4)), v) for i in range(4)]
    return cubic(*rows, u)


# wrong ---------------------------------------------------------------------------------------------------------------


def wrong_swapped(control, uv):
    return right_einsum(control, uv[:, ::-1])


def wrong_transposed_net(control, uv):
    return np.einsum("ni,nj,jik->nk", basis(uv[:, 0]), basis(uv[:, 1]), control)


def powers(t):
    k = np.arange(4)
    return t[:, None] ** k * (1 - t[:, None]) ** (3 - k)


def wrong_powers(control, uv):
    return np.einsum("ni,nj,ijk->nk", powers(uv[:, 0]), powers(uv[:, 1]), control)


def wrong_bilinear(control, uv):
    u, v = uv[:, :1], uv[:, 1:]
    low = (1 - u) * control[0, 0] + u * control[3, 0]
    high = (1 - u) * control[0, 3] + u * control[3, 3]
    return (1 - v) * low + v * high


def wrong_reversed(control, uv):
    return right_einsum(control[::-1, ::-1], uv)


def wrong_u_twice(control, uv):
    return np.einsum("ni,nj,ijk->nk", basis(uv[:, 0]), basis(uv[:, 0]), control)


def wrong_pascal(control, uv):
    return np.einsum("ni,nj,ijk->nk", *(powers(t) * [1, 2, 2, 1] for t in uv.T), control)


def wrong_lagrange(control, uv):
    at = np.linspace(0, 1, 4)
    weights = [
        np.stack([np.prod([(t - b) / (a - b) for b in at if b != a], axis=0) for a in at], axis=1)
        for t in uv.T
    ]
    return np.einsum("ni,nj,ijk->nk", *weights, control)


def wrong_normalised_powers(control, uv):
    U, V = (powers(t) / powers(t).sum(axis=1, keepdims=True) for t in uv.T)
    return np.einsum("ni,nj,ijk->nk", U, V, control)


def wrong_mean(control, uv):
    return np.tile(control.mean(axis=(0, 1)), (len(uv), 1))


def wrong_v_reversed(control, uv):
    return right_einsum(control[:, ::-1], uv)


def wrong_u_reversed(control, uv):
    return right_einsum(control[::-1], uv)


def wrong_degree_four(control, uv):
    k = np.arange(4)
    times = np.array([comb(4, i) for i in k])
    U, V = (times * t[:, None] ** k * (1 - t[:, None]) ** (4 - k) for t in uv.T)
    return np.einsum("ni,nj,ijk->nk", U, V, control)


def wrong_diagonal(control, uv):
    return np.einsum("ni,ni,iik->nk", basis(uv[:, 0]), basis(uv[:, 1]), control)


def wrong_row_only(control, uv):
    return basis(uv[:, 0]) @ control[:, 0]


def wrong_nearest(control, uv):
    i, j = np.rint(3 * uv).astype(int).T
    return control[i, j]


def wrong_piecewise(control, uv):
    i, j = np.minimum((3 * uv).astype(int), 2).T
    u, v = (3 * uv - np.stack([i, j], axis=1)).T[:, :, None]
    low = (1 - u) * control[i, j] + u * control[i + 1, j]
    return (1 - v) * low + v * ((1 - u) * control[i, j + 1] + u * control[i + 1, j + 1])


def wrong_b_spline(control, uv):
    U, V = (
        np.stack(
            [(1 - t) ** 3, 3 * t**3 - 6 * t**2 + 4, -3 * t**3 + 3 * t**2 + 3 * t + 1, t**3], axis=1
        )
        / 6
        for t in uv.T
    )
    return np.einsum("ni,nj,ijk->nk", U, V, control)


def wrong_shape(control, uv):
    return right_einsum(control, uv).T


def wrong_in_place(control, uv):
    control *= 1.0
    uv[:] = 1 - uv
    return right_einsum(control, 1 - uv)


def wrong_sum_of_curves(control, uv):
    return (basis(uv[:, 0]) @ control.mean(axis=1) + basis(uv[:, 1]) @ control.mean(axis=0)) / 2


def wrong_one_place_is_no_row(control, uv):
    return np.squeeze(right_einsum(control, uv))


def wrong_end_not_reached(control, uv):
    return right_einsum(control, np.minimum(uv, 0.999))
