"""What students hand in for pose_from_distances."""

import numpy as np

NAMED = {
    "wrong_no_determinant": "without determinant",
    "wrong_inverse": "inverted",
    "wrong_inverse_by_swapping": "inverted",
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


def right_kabsch_other_way(p_world, rays, distances):
    q = (rays.T * distances).T
    a, b = p_world.mean(axis=0), q.mean(axis=0)
    H = (p_world - a).T @ (q - b)
    U, S, Vt = np.linalg.svd(H)
    R = Vt.T @ U.T
    if np.linalg.det(R) < 0:
        Vt[2] *= -1
        R = Vt.T @ U.T
    return np.vstack([np.column_stack([R, b - R @ a]), [0, 0, 0, 1]])


def right_frames(p_world, rays, distances):
    def frame(p):
        x = p[1] - p[0]
        x = x / np.linalg.norm(x)
        z = np.cross(x, p[2] - p[0])
        z = z / np.linalg.norm(z)
        return np.stack([x, np.cross(z, x), z], axis=1)

    q = distances.reshape(3, 1) * rays
    R = frame(q) @ frame(p_world).T
    T = np.eye(4)
    T[:3, :3], T[:3, 3] = R, q[0] - R @ p_world[0]
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


def right_horn(p_world, rays, distances):
    q = distances[:, None] * rays
    a, b = p_world - p_world.mean(0), q - q.mean(0)
    S = a.T @ b
    N = np.array(
        [
            [S[0, 0] + S[1, 1] + S[2, 2], S[1, 2] - S[2, 1], S[2, 0] - S[0, 2], S[0, 1] - S[1, 0]],
            [S[1, 2] - S[2, 1], S[0, 0] - S[1, 1] - S[2, 2], S[0, 1] + S[1, 0], S[2, 0] + S[0, 2]],
            [S[2, 0] - S[0, 2], S[0, 1] + S[1, 0], -S[0, 0] + S[1, 1] - S[2, 2], S[1, 2] + S[2, 1]],
            [S[0, 1] - S[1, 0], S[2, 0] + S[0, 2], S[1, 2] + S[2, 1], -S[0, 0] - S[1, 1] + S[2, 2]],
        ]
    )
    w, x, y, z = np.linalg.eigh(N)[1][:, -1]
    R = np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )
    return np.block(
        [[R, (q.mean(0) - R @ p_world.mean(0))[:, None]], [np.zeros((1, 3)), np.ones((1, 1))]]
    )


def right_inverse_of_the_inverse(p_world, rays, distances):
    q = distances[:, None] * rays
    a, b = q.mean(0), p_world.mean(0)
    U, _, Vt = np.linalg.svd((p_world - b).T @ (q - a))
    D = np.diag([1.0, 1.0, np.sign(np.linalg.det(U @ Vt))])
    T = np.eye(4)
    T[:3, :3] = U @ D @ Vt
    T[:3, 3] = b - T[:3, :3] @ a
    return np.linalg.inv(T)


def right_loop(p_world, rays, distances):
    q = np.zeros((3, 3))
    for i in range(3):
        length = np.linalg.norm(rays[i])
        for j in range(3):
            q[i][j] = distances[i] * rays[i][j] / length
    cp, cq = sum(p_world) / 3, sum(q) / 3
    H = np.zeros((3, 3))
    for i in range(3):
        H += np.outer(q[i] - cq, p_world[i] - cp)
    U, _, Vt = np.linalg.svd(H)
    R = U @ Vt
    if np.linalg.det(R) < 0:
        U[:, 2] = -U[:, 2]
        R = U @ Vt
    T = np.eye(4)
    T[:3, :3] = R
    T[:3, 3] = cq - R @ cp
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


def wrong_no_determinant_covariance_the_other_way(p_world, rays, distances):
    q = rays * distances[:, None]
    U, S, Vt = np.linalg.svd((p_world - p_world.mean(0)).T @ (q - q.mean(0)))
    R = (U @ Vt).T
    T = np.eye(4)
    T[:3, :3] = R
    T[:3, 3] = q.mean(0) - R @ p_world.mean(0)
    return T


def wrong_inverse(p_world, rays, distances):
    return np.linalg.inv(right_kabsch(p_world, rays, distances))


def wrong_inverse_by_swapping(p_world, rays, distances):
    q = rays * distances[:, None]
    U, S, Vt = np.linalg.svd((p_world - p_world.mean(0)).T @ (q - q.mean(0)))
    R = U @ np.diag([1, 1, np.linalg.det(U @ Vt)]) @ Vt
    T = np.eye(4)
    T[:3, :3] = R
    T[:3, 3] = p_world.mean(0) - R @ q.mean(0)
    return T


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


def wrong_translation_of_the_first_end(p_world, rays, distances):
    T = right_kabsch(p_world, rays, distances)
    T[:3, 3] = rays[0] * distances[0]
    return T


def wrong_centre(p_world, rays, distances):
    T = right_kabsch(p_world, rays, distances)
    T[:3, 3] = -T[:3, :3].T @ T[:3, 3]
    return T


def wrong_not_centred(p_world, rays, distances):
    q = rays * distances[:, None]
    U, S, Vt = np.linalg.svd(q.T @ p_world)
    R = U @ np.diag([1, 1, np.linalg.det(U @ Vt)]) @ Vt
    T = np.eye(4)
    T[:3, :3] = R
    T[:3, 3] = q.mean(0) - R @ p_world.mean(0)
    return T


def wrong_affine(p_world, rays, distances):
    q = rays * distances[:, None]
    A = np.linalg.lstsq(p_world - p_world.mean(0), q - q.mean(0), rcond=None)[0].T
    T = np.eye(4)
    T[:3, :3] = A
    T[:3, 3] = q.mean(0) - A @ p_world.mean(0)
    return T


def wrong_squared_distances(p_world, rays, distances):
    return right_kabsch(p_world, rays, distances**2)


def wrong_mirrored_always(p_world, rays, distances):
    q = rays * distances[:, None]
    U, S, Vt = np.linalg.svd((q - q.mean(0)).T @ (p_world - p_world.mean(0)))
    R = U @ np.diag([1, 1, -np.linalg.det(U @ Vt)]) @ Vt
    T = np.eye(4)
    T[:3, :3] = R
    T[:3, 3] = q.mean(0) - R @ p_world.mean(0)
    return T


def wrong_identity_rotation(p_world, rays, distances):
    T = np.eye(4)
    T[:3, 3] = (rays * distances[:, None] - p_world).mean(0)
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
