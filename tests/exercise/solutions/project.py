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


def right_einsum(p_world, T, K):
    h = np.concatenate([p_world, np.ones((len(p_world), 1))], axis=1)
    X = np.einsum("ij,nj->ni", T, h)[:, :3]
    x = np.einsum("ij,nj->ni", K, X)
    with np.errstate(divide="ignore", invalid="ignore"):
        uv = x[:, :2] / x[:, 2:3]
    uv[X[:, 2] <= 0] = np.nan
    return uv


def right_column_points(p_world, T, K):
    P = K @ T[:3]
    x, y, w = P @ np.vstack([p_world.T, np.ones(p_world.shape[0])])
    z = (T @ np.vstack([p_world.T, np.ones(p_world.shape[0])]))[2]
    out = np.full((2, len(w)), np.nan)
    np.divide([x, y], w, out=out, where=np.stack([z > 0, z > 0]))
    return out.T


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


def wrong_zero_depth_divided(p_world, T, K):
    X = in_camera(p_world, T)
    with np.errstate(all="ignore"):
        uv = (X[:, :2] / X[:, 2:]) @ K[:2, :2].T + K[:2, 2]
    return np.where(X[:, 2:] >= 0, uv, np.nan)


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


def wrong_tenth_of_a_millimetre(p_world, T, K):
    return np.where(in_camera(p_world, T)[:, 2:] > 1e-4, right_where(p_world, T, K), np.nan)


def wrong_single_point_without_its_row(p_world, T, K):
    return right_where(p_world, T, K)[0] if len(p_world) == 1 else right_where(p_world, T, K)
