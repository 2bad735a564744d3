"""What students hand in for points_on_faces."""

import numpy as np

NAMED = {
    "wrong_uniform_over_faces": "faces alike",
    "wrong_no_root": "without the root",
    "wrong_three_normalised": "normalised",
    "wrong_whole_parallelogram": "parallelogram",
    "wrong_centroids": "middles",
}


def _areas(p, faces):
    a, b, c = p[faces[:, 0]], p[faces[:, 1]], p[faces[:, 2]]
    return np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2


def _by_area(p, faces, u):
    cdf = np.cumsum(_areas(p, faces))
    return np.clip(np.searchsorted(cdf / cdf[-1], u[:, 0], side="right"), 0, len(faces) - 1)


def right_osada(p, faces, u):
    k = _by_area(p, faces, u)
    a, b, c = p[faces[k, 0]], p[faces[k, 1]], p[faces[k, 2]]
    r1, r2 = np.sqrt(u[:, 1])[:, None], u[:, 2][:, None]
    return (1 - r1) * a + r1 * (1 - r2) * b + r1 * r2 * c


def right_sorted_gaps(p, faces, u):
    """The gaps of two sorted numbers are even barycentric coordinates."""
    k = _by_area(p, faces, u)
    low, high = np.sort(u[:, 1:], axis=1).T
    w = np.stack([low, high - low, 1 - high], axis=1)
    return (w[:, :, None] * p[faces[k]]).sum(axis=1)


def right_not_normalised(p, faces, u):
    """The number is stretched to the whole area; the running sums stay what they are."""
    sums = _areas(p, faces).cumsum()
    k = np.minimum(np.searchsorted(sums, u[:, 0] * sums[-1], "right"), len(faces) - 1)
    s, t = np.sqrt(u[:, 1]), u[:, 2]
    weights = np.column_stack([1 - s, s * (1 - t), s * t])
    return np.einsum("nc,ncx->nx", weights, p[faces[k]])


def right_bisect(p, faces, u):
    from bisect import bisect_right
    from itertools import accumulate

    sums = list(accumulate(_areas(p, faces).tolist()))
    found = np.empty((len(u), 3))
    for row, (pick, s, t) in enumerate(u):
        a, b, c = p[faces[min(bisect_right(sums, pick * sums[-1]), len(sums) - 1)]]
        found[row] = a * (1 - s**0.5) + s**0.5 * (b * (1 - t) + c * t)
    return found


def wrong_uniform_over_faces(p, faces, u):
    k = (u[:, 0] * len(faces)).astype(int).clip(0, len(faces) - 1)
    a, b, c = p[faces[k, 0]], p[faces[k, 1]], p[faces[k, 2]]
    r, t = np.sqrt(u[:, 1:2]), u[:, 2:3]
    return (1 - r) * a + r * (1 - t) * b + r * t * c


def wrong_no_root(p, faces, u):
    k = _by_area(p, faces, u)
    a, b, c = p[faces[k, 0]], p[faces[k, 1]], p[faces[k, 2]]
    s, t = u[:, 1:2], u[:, 2:3]
    return (1 - s) * a + s * (1 - t) * b + s * t * c


def wrong_three_normalised(p, faces, u):
    k = _by_area(p, faces, u)
    w = (u + 1e-300) / (u + 1e-300).sum(axis=1, keepdims=True)
    return (w[:, :, None] * p[faces[k]]).sum(axis=1)


def wrong_whole_parallelogram(p, faces, u):
    k = _by_area(p, faces, u)
    a, b, c = p[faces[k, 0]], p[faces[k, 1]], p[faces[k, 2]]
    return a + u[:, 1:2] * (b - a) + u[:, 2:3] * (c - a)


def wrong_centroids(p, faces, u):
    return p[faces[_by_area(p, faces, u)]].mean(axis=1)


def wrong_own_random_seeded(p, faces, u):
    return right_osada(p, faces, np.random.default_rng(0).random(u.shape))


def wrong_sorted_rows(p, faces, u):
    return right_osada(p, faces, u[np.argsort(u[:, 0])])


def wrong_without_the_third(p, faces, u):
    areas = _areas(p, faces)
    reached = np.cumsum(areas) / areas.sum()
    k = np.clip(np.searchsorted(reached, u[:, 0], side="right"), 0, len(faces) - 1)
    a, b, c = p[faces[k, 0]], p[faces[k, 1]], p[faces[k, 2]]
    r = np.sqrt(u[:, [1]])
    t = ((u[:, 0] - reached[k]) * areas.sum() / areas[k] + 1)[:, None]
    return (1 - r) * a + r * (1 - t) * b + r * t * c


def wrong_second_number_twice(p, faces, u):
    return right_osada(p, faces, np.column_stack([u[:, 0], u[:, 1], (u[:, 1] * 997) % 1]))


def wrong_a_little_added_to_the_areas(p, faces, u):
    n = np.cross(p[faces[:, 1]] - p[faces[:, 0]], p[faces[:, 2]] - p[faces[:, 0]])
    reached = np.cumsum(np.linalg.norm(n, axis=1) / 2 + 1e-6)
    k = np.minimum(np.searchsorted(reached, u[:, 0] * reached[-1], side="right"), len(faces) - 1)
    a, b, c = p[faces[k, 0]], p[faces[k, 1]], p[faces[k, 2]]
    s, t = np.sqrt(u[:, 1:2]), u[:, 2:]
    return (1 - s) * a + s * (1 - t) * b + s * t * c


def wrong_one_row_is_no_row(p, faces, u):
    return np.squeeze(right_osada(p, faces, u))


def wrong_beyond_the_last_face(p, faces, u):
    n = np.cross(p[faces[:, 1]] - p[faces[:, 0]], p[faces[:, 2]] - p[faces[:, 0]])
    A = np.linalg.norm(n, axis=1)
    k = np.searchsorted(np.cumsum(A / A.sum()), u[:, 0], side="right")
    a, b, c = p[faces[k, 0]], p[faces[k, 1]], p[faces[k, 2]]
    s, t = np.sqrt(u[:, 1:2]), u[:, 2:]
    return (1 - s) * a + s * (1 - t) * b + s * t * c
