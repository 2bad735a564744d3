"""What students hand in for pose_from_distances."""

import numpy as np

NAMED = {
    "wrong_no_determinant": "without determinant",
    "wrong_inverse": "inverted",
    "wrong_depths": "lengths as depths",
    "wrong_no_distances": "without distances",
    "wrong_translation": "translation not turned",
    "wrong_transposed": "rotation transposed",
}


def right_kabsch(p_world, rays, distances):
    q = rays * distances[:, None]
    a, b = p_world.mean(0), q.mean(0)
    U, S, Vt = np.linalg.svd((q - b).T @ (p_world - a))
    R = U @ np.diag([1, 1, np.linalg.det(U @ Vt)]) @ Vt
    T = np.eye(4)
    T[:3, :3] = R
    T[:3, 3] = b - R @ a
    return T


def right_solve_with_the_normal(p_world, rays, distances):
    q = distances[:, None] * rays
    A = np.array([p_world[1] - p_world[0], p_world[2] - p_world[0]])
    B = np.array([q[1] - q[0], q[2] - q[0]])
    A = np.vstack([A, np.cross(A[0], A[1])])
    B = np.vstack([B, np.cross(B[0], B[1])])
    R = np.linalg.solve(A, B).T
    T = np.eye(4)
    T[:3, :3] = R
    T[:3, 3] = (q - p_world @ R.T).mean(axis=0)
    return T


def right_gram_schmidt(p_world, rays, distances):
    q = rays * distances[:, np.newaxis]

    def basis(p):
        u, v = p[1] - p[0], p[2] - p[0]
        u = u / np.sqrt(u @ u)
        v = v - (v @ u) * u
        v = v / np.sqrt(v @ v)
        return np.array([u, v, np.cross(u, v)])

    R = basis(q).T @ basis(p_world)
    t = q[2] - R @ p_world[2]
    return np.r_[np.c_[R, t], [[0, 0, 0, 1]]]


# wrong ---------------------------------------------------------------------------------------------------------------


def wrong_no_determinant(p_world, rays, distances):
    q = rays * distances[:, None]
    U, S, Vt = np.linalg.svd((q - q.mean(0)).T @ (p_world - p_world.mean(0)))
    R = U @ Vt
    T = np.eye(4)
    T[:3, :3] = R
    T[:3, 3] = q.mean(0) - R @ p_world.mean(0)
    return T


def wrong_inverse(p_world, rays, distances):
    return np.linalg.inv(right_kabsch(p_world, rays, distances))


def wrong_depths(p_world, rays, distances):
    return right_kabsch(p_world, rays / rays[:, 2:3], distances)


def wrong_no_distances(p_world, rays, distances):
    return right_kabsch(p_world, rays, np.ones(3))


def wrong_translation(p_world, rays, distances):
    T = right_kabsch(p_world, rays, distances)
    T[:3, 3] = (rays * distances[:, None]).mean(0) - p_world.mean(0)
    return T


def wrong_transposed(p_world, rays, distances):
    T = right_kabsch(p_world, rays, distances)
    R = T[:3, :3].T.copy()
    T[:3, :3] = R
    T[:3, 3] = (rays * distances[:, None]).mean(0) - R @ p_world.mean(0)
    return T


def wrong_small_triangles_are_lines(p_world, rays, distances):
    n = np.cross(p_world[1] - p_world[0], p_world[2] - p_world[0])
    return right_kabsch(p_world, rays, distances) if np.linalg.norm(n) > 1e-3 else np.eye(4)


def wrong_equal_distances_refused(p_world, rays, distances):
    if np.ptp(distances) < 1e-9:
        raise ValueError("no solution")
    return right_kabsch(p_world, rays, distances)


def wrong_half_a_turn_is_none(p_world, rays, distances):
    T = right_kabsch(p_world, rays, distances)
    if np.trace(T[:3, :3]) < -1 + 1e-9:
        T[:3, :3] = np.eye(3)
    return T


def wrong_rays_turned_to_the_front(p_world, rays, distances):
    return right_kabsch(p_world, np.where(rays[:, 2:] < 0, -rays, rays), distances)


def right_polar_by_newton(p_world, rays, distances):
    def frame(p):
        u, v = p[1] - p[0], p[2] - p[0]
        n = np.cross(u, v)
        return np.column_stack([u, v, n / np.linalg.norm(n)])

    q = distances[:, None] * rays
    R = frame(q) @ np.linalg.inv(frame(p_world))
    for _ in range(30):
        R = (R + np.linalg.inv(R).T) / 2
    T = np.eye(4)
    T[:3, :3], T[:3, 3] = R, q.mean(0) - R @ p_world.mean(0)
    return T
