"""Right answers on cameras and pictures by somebody who read the starters alone, none of the
checks: projecting, calibrating, poses, features, two views, disparity. `EXERCISE__kind`.

They take other ways than the tables of `solutions/`: calls of other libraries, loops, lists, single
precision, other algorithms. Each earns full marks, or a check asks for more than its contract says.
"""

import itertools
import math
from fractions import Fraction

import numpy as np
from scipy import linalg, ndimage, special
from scipy.spatial.transform import Rotation


def camera_center__solve(T_camera_world):
    return np.linalg.solve(T_camera_world[:3, :3], -T_camera_world[:3, 3])


def camera_center__null_space(T_camera_world):
    h = linalg.null_space(T_camera_world[:3])[:, 0]
    return (h[:3] / h[3]).tolist()


def choose_pose__key(candidates, p_world, xy):
    def cost(T):
        seen = (T @ np.c_[p_world, np.ones(len(p_world))].T)[:3].T
        if seen[:, 2].min() <= 0:
            return math.inf
        return float(np.sum((seen[:, :2] / seen[:, 2:] - xy) ** 2))

    return min(candidates, key=cost).copy()


def constraint_rows__symmetric_outer(H):
    def row(a, b):
        S = np.outer(a, b) + np.outer(b, a)
        return [S[0, 0] / 2, S[0, 1], S[1, 1] / 2, S[0, 2], S[1, 2], S[2, 2] / 2]

    a, b = H[:, 0], H[:, 1]
    return [row(a, b), np.subtract(row(a, a), row(b, b))]


def depth_from_disparity__masked(d, f, baseline):
    out = np.full(np.shape(d), np.nan)
    out[d == 0] = np.inf
    np.divide(f * baseline, d, out=out, where=d > 0)
    return out


def depth_from_disparity__vectorized(d, f, baseline):
    def one(x):
        if x > 0:
            return f * baseline / x
        return math.inf if x == 0 else math.nan

    return np.vectorize(one, otypes=[float])(d)


def distort__loop_of_lists(xy_camera, k1, k2, p1, p2):
    out = []
    for x, y in xy_camera.tolist():
        s = x * x + y * y
        radial = 1 + s * (k1 + s * k2)
        out.append(
            [
                x * radial + 2 * p1 * x * y + p2 * (s + 2 * x * x),
                y * radial + p1 * (s + 2 * y * y) + 2 * p2 * x * y,
            ]
        )
    return np.array(out).reshape(-1, 2)


def eight_point__covariance_eigenvector(uv_first, uv_second):
    if len(uv_first) < 8:
        raise ValueError("eight are needed")

    def normal(uv):
        c = uv.mean(0)
        s = math.sqrt(2) / np.mean([math.dist(x, c) for x in uv])
        return np.array([[s, 0, -s * c[0]], [0, s, -s * c[1]], [0, 0, 1]])

    A, B = normal(uv_first), normal(uv_second)
    a = np.c_[uv_first, np.ones(len(uv_first))] @ A.T
    b = np.c_[uv_second, np.ones(len(uv_second))] @ B.T
    rows = np.stack([np.kron(y, x) for x, y in zip(a, b, strict=True)])
    F = linalg.svd(rows, full_matrices=True)[2][-1].reshape(3, 3)
    U, S, Vt = linalg.svd(F)
    return -7.5 * B.T @ (S[0] * np.outer(U[:, 0], Vt[0]) + S[1] * np.outer(U[:, 1], Vt[1])) @ A


def essential_to_poses__rodrigues_half_turn(E):
    U, _, Vt = linalg.svd(E)
    if linalg.det(U @ Vt) < 0:
        Vt = -Vt
    poses = []
    for quarter, sign in itertools.product((1, -1), repeat=2):
        Q = np.array([[0, -quarter, 0], [quarter, 0, 0], [0, 0, 1]])
        T = np.eye(4)
        T[:3, :3] = U @ Q @ Vt
        T[:3, 3] = sign * U[:, 2]
        poses.append(T)
    return poses


def essential_to_poses__cofactors(E):
    """Horn 1990: R from the cofactors of E, after E is scaled so that its translation has length one."""
    E = E * math.sqrt(2) / linalg.norm(E)
    t = linalg.svd(E)[0][:, 2]
    cofactors = np.stack([np.cross(E[1], E[2]), np.cross(E[2], E[0]), np.cross(E[0], E[1])])
    out = []
    for s in (t, -t):
        cross = np.array([[0, -s[2], s[1]], [s[2], 0, -s[0]], [-s[1], s[0], 0]])
        for sign in (1, -1):
            U, _, Vt = linalg.svd(cofactors - sign * cross @ E)
            out.append(np.block([[U @ Vt, s[:, None]], [np.zeros((1, 3)), 1]]))
    return np.array(out)


def harris_response__eigenvalues(image):
    smooth = ndimage.gaussian_filter(image, 1)
    gu, gv = ndimage.sobel(smooth, 1) / 8, ndimage.sobel(smooth, 0) / 8
    A, B, C = (ndimage.gaussian_filter(product, 1.5) for product in (gu * gu, gu * gv, gv * gv))
    first, second = np.linalg.eigvalsh(
        np.moveaxis(np.array([[A, B], [B, C]]), (0, 1), (2, 3))
    ).transpose(2, 0, 1)
    return first * second - 0.04 * (first + second) ** 2


def mutual_matches__loops(a, b, ratio):
    D = np.sqrt(((a[:, None, :] - b[None, :, :]) ** 2).sum(-1))
    matches = []
    for i in range(len(a)):
        j = int(D[i].argmin())
        second = np.delete(D[i], j).min()
        matches.append(j if D[:, j].argmin() == i and D[i, j] < ratio * second else -1)
    return matches


def pose_from_distances__align_vectors(p_world, rays, distances):
    ends = rays * distances[:, None]
    frame = lambda x: np.stack([x[1] - x[0], x[2] - x[0], np.cross(x[1] - x[0], x[2] - x[0])], 1)  # noqa: E731
    U, _, Vt = linalg.svd(frame(ends) @ linalg.inv(frame(p_world)))
    R = U @ Vt
    T = np.eye(4)
    T[:3, :3], T[:3, 3] = R, ends.mean(0) - R @ p_world.mean(0)
    return T


def pose_from_homography__polar(K, H):
    M = np.linalg.inv(K) @ H
    M = M * 2 / (np.linalg.norm(M[:, 0]) + np.linalg.norm(M[:, 1]))
    if M[2, 2] < 0:
        M = -M
    R = linalg.polar(np.column_stack([M[:, 0], M[:, 1], np.cross(M[:, 0], M[:, 1])]))[0]
    return np.block([[R, M[:, 2:]], [np.array([[0, 0, 0, 1]])]])


def pose_step__loop(T, p_world, xy):
    rows, rest = [], []
    for q, seen in zip(p_world @ T[:3, :3].T + T[:3, 3], xy, strict=True):
        X, Y, Z = q
        P = np.array([[1 / Z, 0, -X / Z**2], [0, 1 / Z, -Y / Z**2]])
        rows.append(np.hstack([P, P @ -np.array([[0, -Z, Y], [Z, 0, -X], [-Y, X, 0]])]))
        rest.append(seen - (X / Z, Y / Z))
    step = linalg.lstsq(np.vstack(rows), np.hstack(rest))[0]
    M = np.eye(4)
    M[:3, :3] = Rotation.from_rotvec(step[3:]).as_matrix()
    M[:3, 3] = step[:3]
    return M @ T


def project__homogeneous(p_world, T_camera_world, K):
    h = (K @ T_camera_world[:3] @ np.vstack([p_world.T, np.ones(len(p_world))])).T
    out = np.full((len(p_world), 2), np.nan)
    seen = h[:, 2] > 0
    out[seen] = h[seen, :2] / h[seen, 2:]
    return out


def reprojection_rms__norm(residuals):
    return linalg.norm(residuals) / math.sqrt(len(residuals))


def reprojection_rms__fractions(residuals):
    total = sum(Fraction(float(value)) ** 2 for value in residuals.ravel())
    return math.sqrt(total / len(residuals))


def sad_cost_volume__convolved(left, right, max_disparity, window):
    left, right = np.asarray(left, float), np.asarray(right, float)
    if left.shape != right.shape or window < 1 or window % 2 == 0 or max_disparity >= left.shape[1]:
        raise ValueError("sizes")
    h, w = left.shape
    cost = np.full((max_disparity + 1, h, w), np.inf)
    for d in range(max_disparity + 1):
        slice_ = abs(left[:, d:] - right[:, : w - d])
        for axis in (0, 1):
            slice_ = ndimage.convolve1d(slice_, np.ones(window), axis, mode="nearest")
        cost[d, :, d:] = slice_
    return cost


def triangulate__rays_in_the_middle(P_first, P_second, uv_first, uv_second):
    out = []
    for a, b in zip(uv_first, uv_second, strict=True):
        rows = []
        for P, (u, v) in ((P_first, a), (P_second, b)):
            P = P / np.linalg.norm(P[2, :3])
            rows += [u * P[2] - P[0], v * P[2] - P[1]]
        rows = np.array(rows)
        out.append(np.linalg.lstsq(rows[:, :3], -rows[:, 3], rcond=None)[0])
    return np.array(out).reshape(-1, 3)


def winner_takes_all__running(cost):
    best, where = cost[0].astype(float), np.zeros(cost.shape[1:], int)
    for d in range(1, len(cost)):
        lower = cost[d] < best
        best[lower], where[lower] = cost[d][lower], d
    return where


def project__einsum_strided(p_world, T_camera_world, K):
    camera = np.einsum("ij,nj->ni", T_camera_world[:3, :3], p_world) + T_camera_world[None, :3, 3]
    with np.errstate(divide="ignore", invalid="ignore"):
        uv = np.einsum("ij,nj->in", K, camera / camera[:, 2:])[:2].T
    uv[~(camera[:, 2] > 0)] = special.xlogy(np.nan, 1)
    return uv
