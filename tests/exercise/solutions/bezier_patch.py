"""What students hand in for bezier_patch."""

import numpy as np

NAMED = {
    "wrong_swapped": "swapped",
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


def right_matrix(control, uv):
    M = np.array([[1.0, 0, 0, 0], [-3, 3, 0, 0], [3, -6, 3, 0], [-1, 3, -3, 1]])
    U, V = (np.vander(t, 4, increasing=True) @ M for t in uv.T)
    return np.stack([((U @ control[..., k]) * V).sum(axis=1) for k in range(3)], axis=1)


def right_tensordot(control, uv):
    weights = basis(uv[:, 0])[:, :, None] * basis(uv[:, 1])[:, None, :]
    return np.tensordot(weights, control, axes=([1, 2], [0, 1]))


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


def wrong_in_place(control, uv):
    control *= 1.0
    uv[:] = 1 - uv
    return right_einsum(control, 1 - uv)


def wrong_one_place_is_no_row(control, uv):
    return np.squeeze(right_einsum(control, uv))
