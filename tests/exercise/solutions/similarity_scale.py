"""What students hand in for similarity_scale."""

import numpy as np

NAMED = {
    "wrong_ratio_rms": "ratio of sizes",
    "wrong_ratio_std": "ratio of sizes",
    "wrong_frobenius": "ratio of sizes",
    "wrong_trace_of_d": "mirror counted in",
    "wrong_nuclear_norm": "mirror counted in",
    "wrong_target_variance": "target to source",
    "wrong_swapped": "target to source",
    "wrong_inverse": "upside down",
    "wrong_no_centroids": "not centred",
    "wrong_no_rotation": "without the rotation",
    "wrong_mean_over_sum": "divided once",
}


def centred(a, b):
    if len(a) == 0:
        raise ValueError("no pairs")
    return a - a.mean(axis=0), b - b.mean(axis=0)


def svd(a, b):
    U, D, Vt = np.linalg.svd(a.T @ b)
    return U, D, Vt, np.sign(np.linalg.det(U) * np.linalg.det(Vt))


def right_umeyama(p_target, p_source):
    a, b = centred(p_target, p_source)
    if not b.any():
        return 1.0
    _U, D, _Vt, sign = svd(a, b)
    return (D[0] + D[1] + sign * D[2]) / (b**2).sum()


def right_numpy_scalar(p_target, p_source):
    a, b = centred(p_target, p_source)
    n = len(a)
    U, D, Vt = np.linalg.svd(a.T @ b / n)
    S = np.eye(3)
    if np.linalg.det(U @ Vt) < 0:
        S[2, 2] = -1
    variance = np.mean(np.sum(b**2, axis=1))
    return np.trace(np.diag(D) @ S) / variance if variance > 0 else np.float64(1)


def right_rotation_first(p_target, p_source):
    a, b = centred(p_target, p_source)
    if np.abs(b).max() < 1e-12:
        return 1.0
    U, _D, Vt, sign = svd(a, b)
    R = U @ np.diag([1, 1, sign]) @ Vt
    return float(((b @ R.T) * a).sum() / (b * b).sum())


def right_least_squares(p_target, p_source):
    a, b = centred(p_target, p_source)
    if (b**2).sum() == 0:
        return 1.0
    U, _D, Vt, sign = svd(a, b)
    turned = b @ (U @ np.diag([1, 1, sign]) @ Vt).T
    return float(np.linalg.lstsq(turned.reshape(-1, 1), a.reshape(-1), rcond=None)[0][0])


def right_trace(p_target, p_source):
    a, b = centred(p_target, p_source)
    U, _D, Vt, sign = svd(a, b)
    R = (U * [1, 1, sign]) @ Vt
    below = np.trace(b.T @ b)
    return float(np.trace(R.T @ a.T @ b) / below) if below else 1.0


def right_other_way_round(p_target, p_source):
    a, b = centred(p_target, p_source)
    if len(a) == 1 or np.ptp(b, axis=0).max() == 0:
        return 1
    U, D, Vt = np.linalg.svd(b.T @ a)
    if np.linalg.det(Vt.T @ U.T) < 0:
        D = D * np.array([1, 1, -1])
    return D.sum() / np.linalg.norm(b) ** 2


def right_cov(p_target, p_source):
    if not len(p_target):
        raise ValueError("nothing to compare")
    if len(p_target) == 1:
        return 1.0
    C = np.cov(p_target.T, p_source.T, bias=True)
    H, variance = C[:3, 3:], np.trace(C[3:, 3:])
    if variance == 0:
        return 1.0
    D = np.linalg.svd(H, compute_uv=False)
    D[2] *= np.sign(np.linalg.det(H)) or 1
    return D.sum() / variance


def right_loops(p_target, p_source):
    n = len(p_source)
    if n == 0:
        raise ValueError("empty")
    mt, ms = sum(p_target) / n, sum(p_source) / n
    H, v = np.zeros((3, 3)), 0.0
    for x, y in zip(p_target, p_source, strict=False):
        H += np.outer(x - mt, y - ms)
        v += np.dot(y - ms, y - ms)
    if v < 1e-20:
        return 1.0
    U, D, Vt = np.linalg.svd(H)
    d = np.linalg.det(U) * np.linalg.det(Vt)
    return float(np.dot(D, [1, 1, 1 if d > 0 else -1]) / v)


def right_quaternion(p_target, p_source):
    a, b = centred(p_target, p_source)
    v = (b * b).sum()
    if v == 0:
        return 1.0
    S = b.T @ a
    K = np.empty((4, 4))
    K[0, 0] = S[0, 0] + S[1, 1] + S[2, 2]
    K[0, 1:] = K[1:, 0] = [S[1, 2] - S[2, 1], S[2, 0] - S[0, 2], S[0, 1] - S[1, 0]]
    K[1:, 1:] = S + S.T - K[0, 0] * np.eye(3)
    return np.linalg.eigvalsh(K).max() / v


def right_polar(p_target, p_source):
    a, b = centred(p_target, p_source)
    v = float((b**2).sum())
    if v == 0.0:
        return 1.0
    H = a.T @ b
    w = np.sqrt(np.maximum(np.linalg.eigvalsh(H.T @ H), 0))
    return float((w[2] + w[1] + (w[0] if np.linalg.det(H) >= 0 else -w[0])) / v)


# wrong ---------------------------------------------------------------------------------------------------------------


def wrong_ratio_rms(p_target, p_source):
    a, b = centred(p_target, p_source)
    return np.sqrt((a**2).sum() / (b**2).sum()) if b.any() else 1.0


def wrong_ratio_std(p_target, p_source):
    if len(p_target) == 0:
        raise ValueError("no pairs")
    below = np.sqrt(p_source.var(axis=0).sum())
    return float(np.sqrt(p_target.var(axis=0).sum()) / below) if below else 1.0


def wrong_frobenius(p_target, p_source):
    a, b = centred(p_target, p_source)
    return float(np.linalg.norm(a) / np.linalg.norm(b)) if np.linalg.norm(b) else 1.0


def wrong_ratio_of_extents(p_target, p_source):
    a, b = centred(p_target, p_source)
    below = np.ptp(b, axis=0).max()
    return float(np.ptp(a, axis=0).max() / below) if below else 1.0


def wrong_mean_of_ratios(p_target, p_source):
    a, b = centred(p_target, p_source)
    below = np.linalg.norm(b, axis=1)
    return float((np.linalg.norm(a, axis=1) / below).mean()) if below.all() else 1.0


def wrong_mean_distance(p_target, p_source):
    a, b = centred(p_target, p_source)
    below = np.linalg.norm(b, axis=1).mean()
    return float(np.linalg.norm(a, axis=1).mean() / below) if below else 1.0


def wrong_trace_of_d(p_target, p_source):
    a, b = centred(p_target, p_source)
    return float(np.linalg.svd(a.T @ b)[1].sum() / (b**2).sum()) if b.any() else 1.0


def wrong_nuclear_norm(p_target, p_source):
    a, b = centred(p_target, p_source)
    return float(np.linalg.norm(a.T @ b, "nuc") / np.sum(b * b)) if b.any() else 1.0


def wrong_target_variance(p_target, p_source):
    a, b = centred(p_target, p_source)
    if not a.any():
        return 1.0
    _U, D, _Vt, sign = svd(a, b)
    return float((D * [1, 1, sign]).sum() / (a**2).sum())


def wrong_swapped(p_target, p_source):
    return float(right_umeyama(p_source, p_target))


def wrong_inverse(p_target, p_source):
    return float(1.0 / right_umeyama(p_target, p_source))


def wrong_no_centroids(p_target, p_source):
    if len(p_target) == 0:
        raise ValueError("no pairs")
    if not p_source.any():
        return 1.0
    _U, D, _Vt, sign = svd(p_target, p_source)
    return float((D * [1, 1, sign]).sum() / (p_source**2).sum())


def wrong_no_rotation(p_target, p_source):
    a, b = centred(p_target, p_source)
    return float(np.trace(a.T @ b) / (b**2).sum()) if b.any() else 1.0


def wrong_mean_over_sum(p_target, p_source):
    a, b = centred(p_target, p_source)
    if not b.any():
        return 1.0
    _U, D, _Vt, sign = svd(a, b)
    return float((D * [1, 1, sign]).sum() / len(a) / (b**2).sum())


def wrong_sum_over_mean(p_target, p_source):
    a, b = centred(p_target, p_source)
    if not b.any():
        return 1.0
    _U, D, _Vt, sign = svd(a, b)
    return float((D * [1, 1, sign]).sum() / np.mean((b**2).sum(axis=1)))


def wrong_root(p_target, p_source):
    return float(np.sqrt(max(right_umeyama(p_target, p_source), 0)))


def wrong_squared(p_target, p_source):
    return float(right_umeyama(p_target, p_source) ** 2)


def wrong_largest_flipped(p_target, p_source):
    a, b = centred(p_target, p_source)
    if not b.any():
        return 1.0
    _U, D, _Vt, sign = svd(a, b)
    return float((D * [sign, 1, 1]).sum() / (b**2).sum())


def wrong_all_flipped(p_target, p_source):
    a, b = centred(p_target, p_source)
    if not b.any():
        return 1.0
    _U, D, _Vt, sign = svd(a, b)
    return float(sign * D.sum() / (b**2).sum())


def wrong_not_a_number(p_target, p_source):
    a, b = centred(p_target, p_source)
    _U, D, _Vt, sign = svd(a, b)
    return (D * [1, 1, sign]).sum() / (b**2).sum()


def wrong_no_error(p_target, p_source):
    if len(p_target) == 0:
        return 1.0
    return float(right_umeyama(p_target, p_source))


def wrong_in_place(p_target, p_source):
    if len(p_target) == 0:
        raise ValueError("no pairs")
    p_target -= p_target.mean(axis=0)
    p_source -= p_source.mean(axis=0)
    return float(right_umeyama(p_target, p_source))


def wrong_symmetric(p_target, p_source):
    _a, b = centred(p_target, p_source)
    if not b.any():
        return 1.0
    return float(
        np.sqrt(right_umeyama(p_target, p_source) / right_umeyama(p_source, p_target)) * 1.0001
    )


def wrong_variance_per_coordinate(p_target, p_source):
    a, b = centred(p_target, p_source)
    if not b.any():
        return 1.0
    _U, D, _Vt, sign = svd(a, b)
    return float((D * [1, 1, sign]).sum() / len(a) / b.var())


def wrong_centimetres_coincide(p_target, p_source):
    if len(p_source) and ((p_source - p_source.mean(0)) ** 2).sum(1).mean() < 1e-3:
        return 1.0
    return right_umeyama(p_target, p_source)


def wrong_a_little_added(p_target, p_source):
    if len(p_source) and np.ptp(p_source, axis=0).max() > 0:
        centred = p_source - p_source.mean(0)
        return right_umeyama(p_target, p_source) / (1 + 1e-6 / (centred**2).sum(1).mean())
    return right_umeyama(p_target, p_source)


def wrong_three_pairs_at_least(p_target, p_source):
    return 1.0 if len(p_source) == 2 else right_umeyama(p_target, p_source)


def wrong_a_line_has_no_scale(p_target, p_source):
    _a, b = centred(p_target, p_source)
    return 1.0 if np.linalg.matrix_rank(b) < 2 else right_umeyama(p_target, p_source)


def wrong_target_that_coincides_is_1(p_target, p_source):
    a, _b = centred(p_target, p_source)
    return right_umeyama(p_target, p_source) if a.any() else 1.0


def wrong_between_a_tenth_and_ten(p_target, p_source):
    return float(np.clip(right_umeyama(p_target, p_source), 0.1, 10))
