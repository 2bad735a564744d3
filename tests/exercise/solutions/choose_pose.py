"""What students hand in for choose_pose."""

import numpy as np

NAMED = {
    "wrong_no_depths_in_a_loop": "without depths",
    "wrong_first_three": "by three",
    "wrong_inverse": "inverted",
    "wrong_read_inverted": "read inverted",
    "wrong_largest": "the worst",
    "wrong_mean_depth": "mean depth",
    "wrong_no_division": "without division",
    "wrong_sign_of_depth": "only behind",
    "wrong_first": "the first",
    "wrong_most_in_front": "most in front",
    "wrong_last_point_alone": "by the last",
}


def right_loop(candidates, p_world, xy):
    best, least = None, np.inf
    for T in candidates:
        p = p_world @ T[:3, :3].T + T[:3, 3]
        if np.any(p[:, 2] <= 0):
            continue
        e = np.sqrt(np.mean(np.sum((p[:, :2] / p[:, 2:] - xy) ** 2, axis=1)))
        if e < least:
            best, least = T, e
    return candidates[0] if best is None else best


def right_vectorised(candidates, p_world, xy):
    p = np.einsum("mij,nj->mni", candidates[:, :3, :3], p_world) + candidates[:, None, :3, 3]
    with np.errstate(all="ignore"):
        e = ((p[..., :2] / p[..., 2:] - xy) ** 2).sum((1, 2))
    e[(p[..., 2] <= 0).any(1)] = np.inf
    return candidates[np.argmin(e)]


def right_homogeneous(candidates, p_world, xy):
    ph = np.c_[p_world, np.ones(len(p_world))]
    errors = []
    for T in candidates:
        q = (T @ ph.T).T
        ok = np.all(q[:, 2] > 0)
        errors.append(np.linalg.norm(q[:, :2] / q[:, [2]] - xy) if ok else float("inf"))
    return candidates[int(np.argmin(errors))].copy()


def right_min_with_key(candidates, p_world, xy):
    def cost(T):
        x, y, z = T[:3, :3] @ p_world.T + T[:3, 3:]
        return (
            np.inf if z.min() <= 0 else np.mean((x / z - xy[:, 0]) ** 2 + (y / z - xy[:, 1]) ** 2)
        )

    return min(candidates, key=cost)


def right_large_number_for_behind(candidates, p_world, xy):
    costs = np.zeros(len(candidates))
    for k, T in enumerate(candidates):
        p = p_world @ T[:3, :3].T + T[:3, 3]
        costs[k] = 1e30 if (p[:, 2] <= 0).any() else np.square(p[:, :2] / p[:, 2:] - xy).sum()
    return candidates[costs.argmin()]


# wrong ---------------------------------------------------------------------------------------------------------------


def wrong_no_depths_in_a_loop(candidates, p_world, xy):
    best, least = None, np.inf
    for T in candidates:
        p = p_world @ T[:3, :3].T + T[:3, 3]
        e = np.linalg.norm(p[:, :2] / p[:, 2:] - xy)
        if e < least:
            best, least = T, e
    return best


def wrong_first_three(candidates, p_world, xy):
    return right_loop(candidates, p_world[:3], xy[:3])


def wrong_inverse(candidates, p_world, xy):
    return np.linalg.inv(right_loop(candidates, p_world, xy))


def wrong_read_inverted(candidates, p_world, xy):
    k = [
        np.allclose(T, right_loop(np.linalg.inv(candidates), p_world, xy))
        for T in np.linalg.inv(candidates)
    ]
    return candidates[int(np.argmax(k))]


def wrong_largest(candidates, p_world, xy):
    errors = []
    for T in candidates:
        p = p_world @ T[:3, :3].T + T[:3, 3]
        errors.append(np.linalg.norm(p[:, :2] / p[:, 2:] - xy) if (p[:, 2] > 0).all() else -1)
    return candidates[int(np.argmax(errors))]


def wrong_mean_depth(candidates, p_world, xy):
    errors = []
    for T in candidates:
        p = p_world @ T[:3, :3].T + T[:3, 3]
        errors.append(np.linalg.norm(p[:, :2] / p[:, 2:] - xy) if p[:, 2].mean() > 0 else np.inf)
    return candidates[int(np.argmin(errors))]


def wrong_no_division(candidates, p_world, xy):
    errors = []
    for T in candidates:
        p = p_world @ T[:3, :3].T + T[:3, 3]
        errors.append(np.linalg.norm(p[:, :2] - xy) if (p[:, 2] > 0).all() else np.inf)
    return candidates[int(np.argmin(errors))]


def wrong_first(candidates, p_world, xy):
    return candidates[0]


def wrong_most_in_front(candidates, p_world, xy):
    front = [(p_world @ T[2, :3] + T[2, 3] > 0).sum() for T in candidates]
    return candidates[int(np.argmax(front))]


def wrong_last_point_alone(candidates, p_world, xy):
    return right_loop(candidates, p_world[-1:], xy[-1:])


def wrong_sign_of_depth(candidates, p_world, xy):
    errors = []
    for T in candidates:
        p = p_world @ T[:3, :3].T + T[:3, 3]
        errors.append(np.linalg.norm(p[:, :2] / p[:, 2:] - xy) if (p[:, 2] < 0).all() else np.inf)
    return candidates[int(np.argmin(errors))]


def chosen(candidates, p_world, xy, cost, least=0.0):
    p = np.einsum("mij,nj->mni", candidates[:, :3, :3], p_world) + candidates[:, None, :3, 3]
    with np.errstate(all="ignore"):
        off = p[..., :2] / p[..., 2:] - xy
    costs = np.array([cost(one) for one in off])
    costs[(p[..., 2] <= least).any(1)] = np.inf
    return candidates[np.argmin(costs)]


def wrong_ten_centimetres(candidates, p_world, xy):
    return chosen(candidates, p_world, xy, lambda off: np.square(off).sum(), 0.1)


def wrong_five_millimetres(candidates, p_world, xy):
    near = [((p_world @ T[:3, :3].T + T[:3, 3])[:, 2] > 0.005).all() for T in candidates]
    return right_loop(candidates[near], p_world, xy) if any(near) else candidates[0]


def wrong_beside_the_camera_left_out(candidates, p_world, xy):
    best, least = candidates[0], np.inf
    for T in candidates:
        p = p_world @ T[:3, :3].T + T[:3, 3]
        if np.any(p[:, 2] < 0):
            continue
        ok = p[:, 2] > 0
        e = np.mean(np.sum((p[ok, :2] / p[ok, 2:] - xy[ok]) ** 2, axis=1))
        if e < least:
            best, least = T, e
    return best


def wrong_fewest_behind(candidates, p_world, xy):
    front = np.array([((p_world @ T[:3, :3].T + T[:3, 3])[:, 2] > 0).sum() for T in candidates])
    return right_loop(candidates[front == front.max()], p_world, xy)


def wrong_four_at_most(candidates, p_world, xy):
    return right_loop(candidates[:4], p_world, xy)


def wrong_one_point_says_nothing(candidates, p_world, xy):
    return right_loop(candidates, p_world, xy) if len(p_world) > 1 else candidates[0]
