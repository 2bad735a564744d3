"""What students hand in for pose_step."""

import numpy as np

NAMED = {
    "wrong_sign": "uphill",
    "wrong_side": "composed on the right",
    "wrong_affine": "without division",
    "wrong_translation_only": "translation only",
    "wrong_no_rotation": "no proper rotation",
    "wrong_cross": "turned backwards",
    "wrong_step_alone": "step alone",
}


def skew(w):
    return np.array([[0, -w[2], w[1]], [w[2], 0, -w[0]], [-w[1], w[0], 0]])


def rodrigues(w):
    a = np.linalg.norm(w)
    if a < 1e-12:
        return np.eye(3)
    K = skew(w / a)
    return np.eye(3) + np.sin(a) * K + (1 - np.cos(a)) * K @ K


def rows(T, p_world, xy):
    J, r = [], []
    for X, x in zip(p_world, xy):
        p = T[:3, :3] @ X + T[:3, 3]
        D = np.array([[1 / p[2], 0, -p[0] / p[2] ** 2], [0, 1 / p[2], -p[1] / p[2] ** 2]])
        J.append(np.hstack([D, -D @ skew(p)]))
        r.append(p[:2] / p[2] - x)
    return np.vstack(J), np.concatenate(r)


def moved(x, T):
    S = np.eye(4)
    S[:3, :3] = rodrigues(x[3:])
    S[:3, 3] = x[:3]
    return S @ T


def right_lstsq(T, p_world, xy):
    J, r = rows(T, p_world, xy)
    return moved(np.linalg.lstsq(J, -r, rcond=None)[0], T)


def right_normal_equations(T, p_world, xy):
    J, r = rows(T, p_world, xy)
    return moved(-np.linalg.solve(J.T @ J, J.T @ r), T)


def right_numerical_jacobian(T, p_world, xy):
    def residual(d):
        p = (moved(d, T)[:3] @ np.c_[p_world, np.ones(len(p_world))].T).T
        return (p[:, :2] / p[:, 2:] - xy).ravel()

    h = 1e-6
    J = np.array([(residual(h * e) - residual(-h * e)) / (2 * h) for e in np.eye(6)]).T
    return moved(-np.linalg.lstsq(J, residual(np.zeros(6)), rcond=None)[0], T)


def right_vectorised(T, p_world, xy):
    x, y, z = T[:3, :3] @ p_world.T + T[:3, 3:]
    u, v, o = x / z, y / z, np.zeros_like(z)
    A = np.stack([1 / z, o, -u / z, -u * v, 1 + u * u, -v], axis=1)
    B = np.stack([o, 1 / z, -v / z, -1 - v * v, u * v, u], axis=1)
    J = np.vstack([A, B])
    r = np.concatenate([u - xy[:, 0], v - xy[:, 1]])
    return moved(np.linalg.lstsq(J, -r, rcond=None)[0], T)


# wrong ---------------------------------------------------------------------------------------------------------------


def wrong_sign(T, p_world, xy):
    J, r = rows(T, p_world, xy)
    return moved(np.linalg.lstsq(J, r, rcond=None)[0], T)


def wrong_side(T, p_world, xy):
    J, r = rows(T, p_world, xy)
    return T @ moved(np.linalg.lstsq(J, -r, rcond=None)[0], np.eye(4))


def wrong_affine(T, p_world, xy):
    J, r = [], []
    for X, x in zip(p_world, xy):
        p = T[:3, :3] @ X + T[:3, 3]
        D = np.array([[1 / p[2], 0, 0], [0, 1 / p[2], 0]])
        J.append(np.hstack([D, -D @ skew(p)]))
        r.append(p[:2] / p[2] - x)
    return moved(np.linalg.lstsq(np.vstack(J), -np.concatenate(r), rcond=None)[0], T)


def wrong_translation_only(T, p_world, xy):
    J, r = rows(T, p_world, xy)
    d = np.linalg.lstsq(J[:, :3], -r, rcond=None)[0]
    return moved(np.r_[d, 0, 0, 0], T)


def wrong_no_rotation(T, p_world, xy):
    J, r = rows(T, p_world, xy)
    d = np.linalg.lstsq(J, -r, rcond=None)[0]
    S = np.eye(4)
    S[:3, :3] += skew(d[3:])
    S[:3, 3] = d[:3]
    return S @ T


def wrong_cross(T, p_world, xy):
    J, r = rows(T, p_world, xy)
    J[:, 3:] *= -1
    return moved(np.linalg.lstsq(J, -r, rcond=None)[0], T)


def wrong_step_alone(T, p_world, xy):
    J, r = rows(T, p_world, xy)
    return moved(np.linalg.lstsq(J, -r, rcond=None)[0], np.eye(4))


def wrong_t_not_turned(T, p_world, xy):
    J, r = rows(T, p_world, xy)
    d = np.linalg.lstsq(J, -r, rcond=None)[0]
    out = np.eye(4)
    out[:3, :3] = rodrigues(d[3:]) @ T[:3, :3]
    out[:3, 3] = T[:3, 3] + d[:3]
    return out


def wrong_two_steps(T, p_world, xy):
    return right_lstsq(right_lstsq(T, p_world, xy), p_world, xy)


def wrong_until_it_arrives(T, p_world, xy):
    for _ in range(20):
        T = right_lstsq(T, p_world, xy)
    return T


def wrong_careful_step(T, p_world, xy):
    J, r = rows(T, p_world, xy)
    return moved(0.9 * np.linalg.lstsq(J, -r, rcond=None)[0], T)


def wrong_five_points_demanded(T, p_world, xy):
    return right_lstsq(T, p_world, xy) if len(p_world) > 4 else T


def wrong_planes_left_out(T, p_world, xy):
    thin = np.linalg.svd(p_world - p_world.mean(axis=0))[1][2] < 1e-9
    return T if thin else right_lstsq(T, p_world, xy)
