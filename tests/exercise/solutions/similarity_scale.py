"""What students hand in for similarity_scale."""

import numpy as np

NAMED = {
    "wrong_ratio_rms": "ratio of sizes",
    "wrong_trace_of_d": "mirror counted in",
    "wrong_nuclear_norm": "mirror counted in",
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


def right_trace(p_target, p_source):
    a, b = centred(p_target, p_source)
    U, _D, Vt, sign = svd(a, b)
    R = (U * [1, 1, sign]) @ Vt
    below = np.trace(b.T @ b)
    return float(np.trace(R.T @ a.T @ b) / below) if below else 1.0


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


def wrong_trace_of_d(p_target, p_source):
    a, b = centred(p_target, p_source)
    return float(np.linalg.svd(a.T @ b)[1].sum() / (b**2).sum()) if b.any() else 1.0


def wrong_nuclear_norm(p_target, p_source):
    a, b = centred(p_target, p_source)
    return float(np.linalg.norm(a.T @ b, "nuc") / np.sum(b * b)) if b.any() else 1.0


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
