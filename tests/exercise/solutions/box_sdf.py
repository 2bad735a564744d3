"""What students hand in for box_sdf."""

import numpy as np

NAMED = {
    "wrong_only_outside": "nothing inside",
    "wrong_clamped_only": "nothing inside",
    "wrong_chebyshev": "largest outside",
    "wrong_six_planes": "largest outside",
    "wrong_absolute": "unsigned",
    "wrong_positive_inside": "turned round",
    "wrong_whole_edge": "halved again",
    "wrong_no_abs": "one side",
    "wrong_manhattan": "added up",
}


def right_quilez(p, half_size):
    q = np.abs(p) - half_size
    return np.linalg.norm(np.maximum(q, 0), axis=1) + np.minimum(np.max(q, axis=1), 0)


def right_where(p, half_size):
    d = np.abs(p) - half_size
    inside = (d <= 0).all(axis=1)
    out = np.sqrt((np.clip(d, 0, None) ** 2).sum(1))
    return np.where(inside, d.max(axis=1), out)


def right_nearest_point(p, half_size):
    near = np.clip(p, -half_size, half_size)
    out = np.linalg.norm(p - near, axis=1)
    depth = np.minimum(half_size - p, half_size + p).min(axis=1)
    return np.where(depth > 0, -depth, out)


def right_loop(p, half_size):
    answer = []
    for x, y, z in p:
        a, b, c = abs(x) - half_size[0], abs(y) - half_size[1], abs(z) - half_size[2]
        if a <= 0 and b <= 0 and c <= 0:
            answer.append(max(a, b, c))
        else:
            answer.append((max(a, 0) ** 2 + max(b, 0) ** 2 + max(c, 0) ** 2) ** 0.5)
    return np.array(answer, dtype=float)


def right_by_cases(p, half_size):
    q = np.abs(p) - half_size
    x, y, z = q.T
    outside = np.hypot(np.hypot(np.maximum(x, 0), np.maximum(y, 0)), np.maximum(z, 0))
    return outside + np.minimum(np.maximum(x, np.maximum(y, z)), 0)


def right_einsum(p, half_size):
    v = np.fabs(np.asarray(p, float)) - np.asarray(half_size, float)[None]
    w = v.clip(min=0)
    return np.einsum("ij,ij->i", w, w) ** 0.5 + v.max(-1).clip(max=0)


def right_mask(p, half_size):
    d = np.abs(p) - half_size
    answer = np.zeros(len(p))
    out = (d > 0).any(axis=1)
    answer[out] = np.linalg.norm(d[out].clip(min=0), axis=1)
    answer[~out] = d[~out].max(axis=1, initial=-np.inf)
    return answer


def right_sorted(p, half_size):
    d = np.sort(np.abs(p) - half_size, axis=1)[:, ::-1]
    x, y, z = np.maximum(d, 0).T
    return np.where(d[:, 0] > 0, np.sqrt(x * x + y * y + z * z), d[:, 0])


def right_list(p, half_size):
    def one(q):
        d = [abs(a) - h for a, h in zip(q, half_size, strict=True)]
        m = max(d)
        return m if m < 0 else sum(max(a, 0.0) ** 2 for a in d) ** 0.5

    return np.array([one(q) for q in p], float)


# wrong ---------------------------------------------------------------------------------------------------------------


def wrong_only_outside(p, half_size):
    return np.linalg.norm(np.maximum(np.abs(p) - half_size, 0), axis=1)


def wrong_clamped_only(p, half_size):
    return np.linalg.norm(p - np.clip(p, -half_size, half_size), axis=1)


def wrong_chebyshev(p, half_size):
    return (np.abs(p) - half_size).max(axis=1)


def wrong_six_planes(p, half_size):
    return np.maximum(p - half_size, -p - half_size).max(axis=1)


def wrong_absolute(p, half_size):
    return np.abs(right_quilez(p, half_size))


def wrong_positive_inside(p, half_size):
    return -right_quilez(p, half_size)


def wrong_whole_edge(p, half_size):
    return right_quilez(p, half_size / 2)


def wrong_no_abs(p, half_size):
    d = p - half_size
    return np.linalg.norm(np.maximum(d, 0), axis=1) + np.minimum(d.max(axis=1), 0)


def wrong_manhattan(p, half_size):
    d = np.abs(p) - half_size
    return np.maximum(d, 0).sum(axis=1) + np.minimum(d.max(axis=1), 0)


def wrong_deepest(p, half_size):
    d = np.abs(p) - half_size
    return np.linalg.norm(np.maximum(d, 0), axis=1) + np.minimum(d.min(axis=1), 0)


def wrong_squared(p, half_size):
    d = np.abs(p) - half_size
    return (np.maximum(d, 0) ** 2).sum(axis=1) + np.minimum(d.max(axis=1), 0)


def wrong_norm_inside(p, half_size):
    d = np.abs(p) - half_size
    inside = (d < 0).all(axis=1)
    return np.where(inside, -1, 1) * np.linalg.norm(
        np.where(inside[:, None], d, np.maximum(d, 0)), axis=1
    )


def wrong_sphere(p, half_size):
    return np.linalg.norm(p, axis=1) - np.linalg.norm(half_size)


def wrong_scaled_ball(p, half_size):
    return (np.linalg.norm(p / half_size, axis=1) - 1) * np.min(half_size)


def wrong_doubled(p, half_size):
    return right_quilez(p, 2 * half_size)


def wrong_no_clip(p, half_size):
    return np.linalg.norm(np.abs(p) - half_size, axis=1)


def wrong_flat(p, half_size):
    return right_quilez(p, half_size)[:, None]


def wrong_axis(p, half_size):
    d = np.abs(p) - half_size
    return np.linalg.norm(np.maximum(d, 0), axis=0) + np.minimum(d.max(axis=0), 0)


def wrong_in_place(p, half_size):
    np.abs(p, out=p)
    return right_quilez(p, half_size)


def wrong_cube(p, half_size):
    return right_quilez(p, np.full(3, half_size[0]))


def wrong_nearest_corner(p, half_size):
    return np.linalg.norm(np.abs(p) - half_size, axis=1) * np.where(
        (np.abs(p) < half_size).all(axis=1), -1, 1
    )
