"""What students hand in for project."""

import numpy as np

NAMED = {
    "wrong_all_divided": "divides behind too",
    "wrong_camera_to_world": "motion inverted",
    "wrong_focal_lengths_only_no_skew": "skew forgotten",
    "wrong_mask_returned_rows": "rows dropped",
    "wrong_v_then_u": "row before column",
}


def in_camera(p, T):
    return p @ T[:3, :3].T + T[:3, 3]


def right_mask(p_world, T, K):
    X = in_camera(p_world, T)
    uv = np.full((len(X), 2), np.nan)
    ok = X[:, 2] > 0
    h = X[ok] @ K.T
    uv[ok] = h[:, :2] / h[:, 2:]
    return uv


def right_where(p_world, T, K):
    X = in_camera(p_world, T)
    with np.errstate(all="ignore"):
        h = (X / X[:, 2:]) @ K.T
    return np.where(X[:, 2:] > 0, h[:, :2], np.nan)


def right_loop(p_world, T, K):
    out = np.empty((p_world.shape[0], 2))
    for i in range(p_world.shape[0]):
        x, y, z = T[:3, :3].dot(p_world[i]) + T[:3, 3]
        if z <= 0:
            out[i] = np.nan
            continue
        out[i, 0] = K[0, 0] * x / z + K[0, 1] * y / z + K[0, 2]
        out[i, 1] = K[1, 1] * y / z + K[1, 2]
    return out


def right_nested_lists(p_world, T, K):
    rows = right_loop(p_world, T, K).tolist()
    return rows if rows else np.zeros((0, 2))


def right_einsum(p_world, T, K):
    h = np.concatenate([p_world, np.ones((len(p_world), 1))], axis=1)
    X = np.einsum("ij,nj->ni", T, h)[:, :3]
    x = np.einsum("ij,nj->ni", K, X)
    with np.errstate(divide="ignore", invalid="ignore"):
        uv = x[:, :2] / x[:, 2:3]
    uv[X[:, 2] <= 0] = np.nan
    return uv


def right_nan_depths(p_world, T, K):
    X = in_camera(p_world, T)
    z = np.where(X[:, 2] > 0, X[:, 2], np.nan)
    return np.column_stack(
        [(K[0, 0] * X[:, 0] + K[0, 1] * X[:, 1]) / z + K[0, 2], K[1, 1] * X[:, 1] / z + K[1, 2]]
    )


def right_column_points(p_world, T, K):
    P = K @ T[:3]
    x, y, w = P @ np.vstack([p_world.T, np.ones(p_world.shape[0])])
    z = (T @ np.vstack([p_world.T, np.ones(p_world.shape[0])]))[2]
    out = np.full((2, len(w)), np.nan)
    np.divide([x, y], w, out=out, where=np.stack([z > 0, z > 0]))
    return out.T


def right_single_precision(p_world, T, K):
    return right_mask(p_world, T, K).astype(np.float32)


class Camera:
    def __init__(self, T, K):
        self.T, self.K = T, K

    def pixel(self, p):
        X = self.T[:3, :3] @ p + self.T[:3, 3]
        return (self.K @ X / X[2])[:2] if X[2] > 0 else np.array([np.nan, np.nan])


def right_class(p_world, T, K):
    camera = Camera(T, K)
    return np.array([camera.pixel(p) for p in p_world]).reshape(len(p_world), 2)


def right_recursive(p_world, T, K):
    if len(p_world) < 2:
        return right_loop(p_world, T, K)
    m = len(p_world) // 2
    return np.vstack([right_recursive(p_world[:m], T, K), right_recursive(p_world[m:], T, K)])


# wrong ---------------------------------------------------------------------------------------------------------------


def wrong_all_divided(p_world, T, K):
    with np.errstate(all="ignore"):
        h = in_camera(p_world, T) @ K.T
        return h[:, :2] / h[:, 2:]


def wrong_camera_to_world(p_world, T, K):
    return right_mask(p_world, np.linalg.inv(T), K)


def wrong_focal_lengths_only_no_skew(p_world, T, K):
    X = in_camera(p_world, T)
    z = np.where(X[:, 2] > 0, X[:, 2], np.nan)
    return np.column_stack([K[0, 0] * X[:, 0] / z + K[0, 2], K[1, 1] * X[:, 1] / z + K[1, 2]])


def wrong_mask_returned_rows(p_world, T, K):
    uv = right_mask(p_world, T, K)
    return uv[~np.isnan(uv[:, 0])]


def wrong_v_then_u(p_world, T, K):
    return np.fliplr(right_mask(p_world, T, K))


def wrong_infinite_behind(p_world, T, K):
    uv = right_mask(p_world, T, K)
    uv[np.isnan(uv)] = np.inf
    return uv


def wrong_zeros_behind(p_world, T, K):
    return np.nan_to_num(right_mask(p_world, T, K))


def wrong_minus_one_behind(p_world, T, K):
    uv = right_mask(p_world, T, K)
    uv[np.isnan(uv)] = -1
    return uv


def wrong_zero_depth_divided(p_world, T, K):
    X = in_camera(p_world, T)
    with np.errstate(all="ignore"):
        uv = (X[:, :2] / X[:, 2:]) @ K[:2, :2].T + K[:2, 2]
    return np.where(X[:, 2:] >= 0, uv, np.nan)


def wrong_nan_in_one_column(p_world, T, K):
    uv = right_mask(p_world, T, K)
    uv[np.isnan(uv[:, 1]), 1] = 0
    return uv


def wrong_absolute_depth(p_world, T, K):
    X = in_camera(p_world, T)
    with np.errstate(all="ignore"):
        return (X[:, :2] / np.abs(X[:, 2:])) @ K[:2, :2].T + K[:2, 2]


def wrong_near_plane(p_world, T, K):
    X = in_camera(p_world, T)
    uv = right_mask(p_world, T, K)
    uv[X[:, 2] < 0.1] = np.nan
    return uv


def wrong_outside_the_picture_is_nan(p_world, T, K):
    uv = right_mask(p_world, T, K)
    with np.errstate(invalid="ignore"):
        uv[(uv < 0).any(axis=1) | (uv[:, 0] > 2 * K[0, 2])] = np.nan
    return uv


def wrong_rounded_to_pixels(p_world, T, K):
    return np.round(right_mask(p_world, T, K))


def wrong_homogeneous_returned(p_world, T, K):
    uv = right_mask(p_world, T, K)
    return np.column_stack([uv, np.ones(len(uv))])


def wrong_rotation_transposed(p_world, T, K):
    S = T.copy()
    S[:3, :3] = T[:3, :3].T
    return right_mask(p_world, S, K)


def wrong_translation_forgotten(p_world, T, K):
    S = np.eye(4)
    S[:3, :3] = T[:3, :3]
    return right_mask(p_world, S, K)


def wrong_one_focal_length(p_world, T, K):
    L = K.copy()
    L[1, 1] = K[0, 0]
    return right_mask(p_world, T, L)


def wrong_moved_in_place(p_world, T, K):
    p_world[:] = in_camera(p_world, T)
    return right_mask(p_world, np.eye(4), K)


def wrong_all_behind_is_an_error(p_world, T, K):
    uv = right_mask(p_world, T, K)
    if len(uv) and np.isnan(uv).all():
        raise ValueError("no point is visible")
    return uv


def wrong_empty_is_a_list(p_world, T, K):
    return [[float(a) for a in row] for row in right_mask(p_world, T, K)]


def wrong_k_transposed(p_world, T, K):
    return right_mask(p_world, T, K.T)


def wrong_divided_after_k_added(p_world, T, K):
    X = in_camera(p_world, T)
    z = np.where(X[:, 2:] > 0, X[:, 2:], np.nan)
    return (X[:, :2] * [K[0, 0], K[1, 1]] + K[:2, 2]) / z


def wrong_tenth_of_a_millimetre(p_world, T, K):
    return np.where(in_camera(p_world, T)[:, 2:] > 1e-4, right_where(p_world, T, K), np.nan)


def wrong_single_point_without_its_row(p_world, T, K):
    return right_where(p_world, T, K)[0] if len(p_world) == 1 else right_where(p_world, T, K)
