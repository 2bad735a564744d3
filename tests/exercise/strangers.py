"""Right answers to every exercise by somebody who read the starters alone, none of the checks: `EXERCISE__kind`.

They take other ways than the tables of `solutions/`: calls of other libraries, loops, lists, single precision, other
algorithms. Each earns full marks, or a check asks for more than its contract says.
"""

import heapq
import itertools
import math
from collections import defaultdict
from fractions import Fraction

import numpy as np
from scipy import linalg, ndimage, optimize, sparse, spatial, special
from scipy.spatial.transform import Rotation


def align_rigid__nested_lists(p_target, p_source):
    n = len(p_source)
    if n < 1:
        raise ValueError
    mean_t = [sum(row[i] for row in p_target.tolist()) / n for i in range(3)]
    mean_s = [sum(row[i] for row in p_source.tolist()) / n for i in range(3)]
    H = np.zeros((3, 3))
    for s, t in zip(p_source.tolist(), p_target.tolist(), strict=True):
        for i in range(3):
            for j in range(3):
                H[i, j] += (t[i] - mean_t[i]) * (s[j] - mean_s[j])
    U, _, Vt = linalg.svd(H)
    R = U @ np.diag([1, 1, round(linalg.det(U) * linalg.det(Vt))]) @ Vt
    t = np.array(mean_t) - R @ mean_s
    return [[*R[0], t[0]], [*R[1], t[1]], [*R[2], t[2]], [0, 0, 0, 1]]


def angle_defects__corner_loop(p, faces):
    used, total = defaultdict(int), [0.0] * len(p)
    for face in faces.tolist():
        for k in range(3):
            i, j, l = face[k], face[(k + 1) % 3], face[(k + 2) % 3]
            used[frozenset((i, j))] += 1
            u, v = p[j] - p[i], p[l] - p[i]
            total[i] += math.atan2(float(np.linalg.norm(np.cross(u, v))), float(u @ v))
    border = set().union(*(edge for edge, times in used.items() if times == 1))
    return [(math.pi if i in border else 2 * math.pi) - total[i] for i in range(len(p))]


def bezier_patch__de_casteljau(control, uv):
    out = []
    for u, v in uv:
        q = control
        for _ in range(3):
            q = (1 - u) * q[:-1] + u * q[1:]
        q = q[0]
        for _ in range(3):
            q = (1 - v) * q[:-1] + v * q[1:]
        out.append(q[0])
    return np.array(out).reshape(-1, 3)


def bezier_patch__power_basis(control, uv):
    M = np.array([[1, 0, 0, 0], [-3, 3, 0, 0], [3, -6, 3, 0], [-1, 3, -3, 1.0]])
    U, V = np.vander(uv[:, 0], 4, increasing=True) @ M, np.vander(uv[:, 1], 4, increasing=True) @ M
    return np.einsum("ni,nj,ijk->nk", U, V, control)


def box_sdf__by_nearest_point(p, half_size):
    nearest = np.clip(p, -half_size, half_size)
    outside = np.sqrt(((p - nearest) ** 2).sum(1))
    inside = (half_size - abs(p)).min(1)
    return np.where(inside > 0, -inside, outside)


def camera_center__solve(T_camera_world):
    return np.linalg.solve(T_camera_world[:3, :3], -T_camera_world[:3, 3])


def camera_center__null_space(T_camera_world):
    h = linalg.null_space(T_camera_world[:3])[:, 0]
    return (h[:3] / h[3]).tolist()


def canonical_signs__loop(axes, p):
    middle = np.mean(p, axis=0)
    kept = []
    for k in (0, 1):
        moment = sum(float((x - middle) @ axes[:, k]) ** 3 for x in p)
        kept.append(-axes[:, k] if moment < 0 else axes[:, k].copy())
    return np.stack([*kept, np.cross(*kept)], axis=1)


def chamfer__cdist(p_a, p_b):
    if not len(p_a) or not len(p_b):
        raise ValueError("empty")
    D = spatial.distance.cdist(p_a, p_b, "sqeuclidean")
    return D.min(1).mean() + D.min(0).mean()


def chamfer__pure_python(p_a, p_b):
    if not len(p_a) or not len(p_b):
        raise ValueError("empty")
    a, b = p_a.tolist(), p_b.tolist()
    a_to_b = sum(min(math.dist(x, y) for y in b) ** 2 for x in a) / len(a)
    return a_to_b + sum(min(math.dist(x, y) for x in a) ** 2 for y in b) / len(b)


def chamfer_gradient__trees(p, q):
    _, near_q = spatial.KDTree(q).query(p)
    _, near_p = spatial.KDTree(p).query(q)
    g = 2 / len(p) * (p - q[near_q])
    for j, i in enumerate(near_p):
        g[i] += 2 / len(q) * (p[i] - q[j])
    return g


def choose_pose__key(candidates, p_world, xy):
    def cost(T):
        seen = (T @ np.c_[p_world, np.ones(len(p_world))].T)[:3].T
        if seen[:, 2].min() <= 0:
            return math.inf
        return float(np.sum((seen[:, :2] / seen[:, 2:] - xy) ** 2))

    return min(candidates, key=cost).copy()


def circle_linearised__hypot(circle, p):
    x, y, r = circle
    distance = np.hypot(p[:, 0] - x, p[:, 1] - y)
    safe = np.where(distance == 0, 1, distance)
    J = np.full((len(p), 3), -1.0)
    J[:, 0], J[:, 1] = (x - p[:, 0]) / safe, (y - p[:, 1]) / safe
    return [distance - r, J]


def circle_linearised__complex(circle, p):
    rows, slopes = [], []
    for x, y in p:
        z = complex(x - circle[0], y - circle[1])
        rows.append(abs(z) - circle[2])
        u = z / abs(z) if z else 0j
        slopes.append([-u.real, -u.imag, -1])
    return np.array(rows), np.array(slopes)


def constraint_rows__symmetric_outer(H):
    def row(a, b):
        S = np.outer(a, b) + np.outer(b, a)
        return [S[0, 0] / 2, S[0, 1], S[1, 1] / 2, S[0, 2], S[1, 2], S[2, 2] / 2]

    a, b = H[:, 0], H[:, 1]
    return [row(a, b), np.subtract(row(a, a), row(b, b))]


def count_inliers__loop(plane, p, inlier_distance):
    a, b, c, d = map(float, plane)
    return sum(abs(a * x + b * y + c * z + d) <= inlier_distance for x, y, z in p.tolist())


def count_inliers__numpy_int(plane, p, inlier_distance):
    return np.count_nonzero(
        np.abs(np.append(p, np.ones((len(p), 1)), axis=1) @ plane) <= inlier_distance
    )


def damped_step__stacked_lstsq(residuals, jacobian, damping):
    D = np.diag(np.sqrt(damping * (jacobian**2).sum(0)))
    A = np.vstack([jacobian, D])
    return linalg.lstsq(A, np.append(-residuals, np.zeros(len(D))))[0]


def damped_step__cholesky(residuals, jacobian, damping):
    N = jacobian.T @ jacobian
    N[np.diag_indices_from(N)] *= 1 + damping
    return linalg.cho_solve(linalg.cho_factor(N), -jacobian.T @ residuals)


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


def earth_movers__linear_program(p_a, p_b):
    n, m = len(p_a), len(p_b)
    if n == 0 or m == 0:
        raise ValueError("a cloud is empty")
    cost = spatial.distance_matrix(p_a, p_b)
    rows = sparse.kron(sparse.eye(n), np.ones((1, m)))
    columns = sparse.kron(np.ones((1, n)), sparse.eye(m))
    A = sparse.vstack([rows, columns]).tocsr()
    b = np.append(np.full(n, 1 / n), np.full(m, 1 / m))
    return float(optimize.linprog(cost.ravel(), A_eq=A[:-1], b_eq=b[:-1], method="highs-ds").fun)


def edge_crossings__proportion(p_a, p_b, f_a, f_b):
    wa, wb = np.abs(f_b), np.abs(f_a)
    return (wa[:, None] * p_a + wb[:, None] * p_b) / (wa + wb)[:, None]


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


def eikonal_update__scalar_quadratic(a, b, h):
    out = np.empty(len(a))
    for i, (x, y) in enumerate(zip(a.tolist(), b.tolist(), strict=True)):
        low, high = sorted((x, y))
        out[i] = (
            low + h
            if high - low >= h
            else (low + high + math.sqrt(2 * h * h - (high - low) ** 2)) / 2
        )
    return out


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


def euler_to_matrix__matrix_exponential(angles, order):
    fixed, own = order == order.lower(), order == order.upper()
    if len(order) != 3 or not (fixed or own) or any(letter not in "xyzXYZ" for letter in order):
        raise ValueError(order)
    if any(axis == other for axis, other in itertools.pairwise(order)):
        raise ValueError(order)
    R = np.eye(3)
    for letter, angle in zip(order.lower(), angles, strict=True):
        w = np.zeros(3)
        w["xyz".index(letter)] = angle
        turn = linalg.expm(np.cross(np.eye(3), w))
        R = turn @ R if fixed else R @ turn
    return R


def gaussian_curvature__lists(p, faces):
    count = defaultdict(int)
    area, angles = np.zeros(len(p)), np.zeros(len(p))
    for face in faces:
        a = [p[i] for i in face]
        corner = []
        for k in range(3):
            u, v = a[(k + 1) % 3] - a[k], a[(k + 2) % 3] - a[k]
            corner.append(math.atan2(np.linalg.norm(np.cross(u, v)), u @ v))
            count[tuple(sorted((int(face[k]), int(face[(k + 1) % 3]))))] += 1
        whole = np.linalg.norm(np.cross(a[1] - a[0], a[2] - a[0])) / 2
        for k, i in enumerate(face):
            angles[i] += corner[k]
            if whole <= 1e-14 * max(np.linalg.norm(a[1] - a[0]), np.linalg.norm(a[2] - a[0])) ** 2:
                continue
            if max(corner) > math.pi / 2:
                area[i] += whole / 2 if corner[k] > math.pi / 2 else whole / 4
            else:
                j, l = (k + 1) % 3, (k + 2) % 3
                area[i] += (
                    (a[j] - a[k]) @ (a[j] - a[k]) / math.tan(corner[l])
                    + (a[l] - a[k]) @ (a[l] - a[k]) / math.tan(corner[j])
                ) / 8
    K = (2 * math.pi - angles) / area
    for edge, times in count.items():
        if times == 1:
            K[list(edge)] = math.nan
    return K


def gcn_layer__sparse(adjacency, features, weights):
    A = sparse.csr_array(adjacency + np.eye(len(adjacency)))
    D = sparse.diags_array(1 / np.sqrt(A.sum(axis=1)))
    return np.maximum((D @ A @ D) @ (features @ weights), 0)


def gcn_layer__message_passing(adjacency, features, weights):
    n = len(adjacency)
    degree = [1 + sum(row) for row in adjacency]
    out = []
    for i in range(n):
        gathered = features[i] / degree[i]
        for j in range(n):
            if adjacency[i, j]:
                gathered = gathered + adjacency[i, j] * features[j] / math.sqrt(
                    degree[i] * degree[j]
                )
        out.append([max(value, 0.0) for value in gathered @ weights])
    return out


def great_circle_distance__vectors(a, b, radius):
    def unit(rows):
        latitude, longitude = np.radians(rows).T
        return np.stack(
            [
                np.cos(latitude) * np.cos(longitude),
                np.cos(latitude) * np.sin(longitude),
                np.sin(latitude),
            ],
            1,
        )

    u, v = unit(a), unit(b)
    return radius * 2 * np.arctan2(np.linalg.norm(u - v, axis=1), np.linalg.norm(u + v, axis=1))


def great_circle_distance__vincenty(a, b, radius):
    out = []
    for (la, oa), (lb, ob) in zip(np.radians(a), np.radians(b), strict=True):
        d = ob - oa
        y = math.hypot(
            math.cos(lb) * math.sin(d),
            math.cos(la) * math.sin(lb) - math.sin(la) * math.cos(lb) * math.cos(d),
        )
        out.append(
            radius
            * math.atan2(y, math.sin(la) * math.sin(lb) + math.cos(la) * math.cos(lb) * math.cos(d))
        )
    return out


def harris_response__eigenvalues(image):
    smooth = ndimage.gaussian_filter(image, 1)
    gu, gv = ndimage.sobel(smooth, 1) / 8, ndimage.sobel(smooth, 0) / 8
    A, B, C = (ndimage.gaussian_filter(product, 1.5) for product in (gu * gu, gu * gv, gv * gv))
    first, second = np.linalg.eigvalsh(
        np.moveaxis(np.array([[A, B], [B, C]]), (0, 1), (2, 3))
    ).transpose(2, 0, 1)
    return first * second - 0.04 * (first + second) ** 2


def huber_weights__clipped(residuals, corner):
    return np.clip(residuals, -corner, corner) / np.where(residuals == 0, 1, residuals) + (
        residuals == 0
    )


def huber_weights__special(residuals, corner):
    return [1.0 if abs(r) <= corner else corner / abs(r) for r in residuals]


def invert_rigid__inv(T_a_b):
    return np.linalg.inv(T_a_b)


def invert_rigid__solve(T_a_b):
    return linalg.solve(T_a_b, np.identity(4))


def iterations_needed__loglog(inlier_ratio, sample_size, confidence):
    clean = inlier_ratio**sample_size
    if clean <= 0:
        return math.inf
    if clean >= 1:
        return 1
    return max(1, math.ceil(math.log1p(-confidence) / math.log1p(-clean) - 1e-12))


def knn_adjacency__argsort(p, k):
    D = np.linalg.norm(p[:, None] - p[None], axis=2)
    np.fill_diagonal(D, np.inf)
    A = np.zeros(D.shape, bool)
    np.put_along_axis(A, np.argsort(D, 1)[:, :k], True, 1)
    return A | A.T


def knn_adjacency__heaps(p, k):
    rows = p.tolist()
    A = [[0] * len(rows) for _ in rows]
    for i, x in enumerate(rows):
        for _, j in heapq.nsmallest(
            k, ((math.dist(x, y), j) for j, y in enumerate(rows) if j != i)
        ):
            A[i][j] = A[j][i] = 1
    return A


def laplacian__incidence(adjacency):
    i, j = np.nonzero(np.triu(adjacency))
    B = np.zeros((len(i), len(adjacency)))
    B[np.arange(len(i)), i], B[np.arange(len(i)), j] = 1, -1
    return B.T @ np.diag(adjacency[i, j]) @ B


def mahalanobis__whitened(p, mean, covariance):
    return np.linalg.norm(
        linalg.solve_triangular(linalg.cholesky(covariance, lower=True), (p - mean).T, lower=True),
        axis=0,
    )


def mahalanobis__eigen(p, mean, covariance):
    values, vectors = np.linalg.eigh(covariance)
    return np.sqrt((((p - mean) @ vectors) ** 2 / values).sum(1)).tolist()


def match__brute(p_target, p_source):
    if not len(p_target):
        raise ValueError("nothing to match")
    return [min(range(len(p_target)), key=lambda j: math.dist(p_target[j], x)) for x in p_source]


def mean_curvature_normals__edge_loop(p, faces):
    pull, area, count = np.zeros_like(p), np.zeros(len(p)), defaultdict(int)
    for face in faces:
        x = p[face]
        whole = np.linalg.norm(np.cross(x[1] - x[0], x[2] - x[0])) / 2
        cot = [(x[(k + 1) % 3] - x[k]) @ (x[(k + 2) % 3] - x[k]) / (2 * whole) for k in range(3)]
        for k in range(3):
            j, l = (k + 1) % 3, (k + 2) % 3
            pull[face[j]] += cot[k] * (x[j] - x[l])
            pull[face[l]] += cot[k] * (x[l] - x[j])
            count[tuple(sorted((int(face[j]), int(face[l]))))] += 1
            if min(cot) < 0:
                area[face[k]] += whole / (2 if cot[k] < 0 else 4)
            else:
                area[face[k]] += (
                    ((x[j] - x[k]) ** 2).sum() * cot[l] + ((x[l] - x[k]) ** 2).sum() * cot[j]
                ) / 8
    H = pull / (2 * area[:, None])
    H[sorted({i for edge, times in count.items() if times == 1 for i in edge})] = np.nan
    return H


def meet__determinants(lines_a, lines_b):
    out = []
    for (a, b, c), (d, e, f) in zip(lines_a.tolist(), lines_b.tolist(), strict=True):
        out.append([b * f - c * e, c * d - a * f, a * e - b * d])
    return np.array(out).reshape(-1, 3)


def mutual_matches__loops(a, b, ratio):
    D = np.sqrt(((a[:, None, :] - b[None, :, :]) ** 2).sum(-1))
    matches = []
    for i in range(len(a)):
        j = int(D[i].argmin())
        second = np.delete(D[i], j).min()
        matches.append(j if D[:, j].argmin() == i and D[i, j] < ratio * second else -1)
    return matches


def one_sided__tree(p_a, p_b):
    if min(len(p_a), len(p_b)) == 0:
        raise ValueError("empty cloud")
    return float(np.square(spatial.cKDTree(p_b).query(p_a)[0]).mean())


def pair_angles__loop(p_i, n_i, p_j, n_j):
    rows = []
    for p, n, q, m in zip(p_i, n_i, p_j, n_j, strict=True):
        d = (q - p) / np.linalg.norm(q - p)
        u, other = n, m
        if abs(m @ d) > abs(n @ d):
            u, other, d = m, n, -d
        v = np.cross(d, u)
        v = v / np.linalg.norm(v)
        w = np.cross(u, v)
        rows.append((math.atan2(w @ other, u @ other), v @ other, u @ d))
    return np.array(rows).reshape(-1, 3)


def plane_from_points__svd(p):
    sides = p - p[[1, 2, 0]]
    longest = np.linalg.norm(sides, axis=1).max()
    cross = np.cross(p[1] - p[0], p[2] - p[0])
    if not np.linalg.norm(cross) >= 1e-9 * longest**2 or longest == 0:
        return [math.nan] * 4
    n = cross / np.linalg.norm(cross)
    return [*n, -float(n @ p.mean(0))]


def point_to_plane_step__centred(p_target, p_source, n_target):
    middle = p_source.mean(0)
    A = np.hstack([np.cross(p_source - middle, n_target), n_target])
    b = ((p_target - p_source) * n_target).sum(1)
    x = np.linalg.pinv(A) @ b
    T = np.eye(4)
    T[:3, :3] = Rotation.from_rotvec(x[:3]).as_matrix()
    T[:3, 3] = middle + x[3:] - T[:3, :3] @ middle
    return T


def points_on_faces__folded(p, faces, u):
    a, b, c = (p[faces[:, k]] for k in range(3))
    area = np.linalg.norm(np.cross(b - a, c - a), axis=1)
    ends = np.cumsum(area) / area.sum()
    k = np.minimum(np.searchsorted(ends, u[:, 0], side="right"), np.flatnonzero(area)[-1])
    s, t = u[:, 1:2], u[:, 2:3]
    over = s + t > 1
    s, t = np.where(over, 1 - s, s), np.where(over, 1 - t, t)
    return a[k] + s * (b - a)[k] + t * (c - a)[k]


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


def principal_axes__svd(p):
    if len(p) == 0:
        raise ValueError("no points")
    V = np.linalg.svd(p - p.mean(0), full_matrices=True)[2].T
    V[:, 2] *= np.linalg.det(V)
    return V


def principal_axes__eig(p):
    if len(p) == 0:
        raise ValueError("no points")
    centred = p - np.mean(p, axis=0)
    _, V = linalg.eigh(centred.T @ centred)
    first, second = V[:, 2], V[:, 1]
    return np.array([first, second, np.cross(first, second)]).T


def project__homogeneous(p_world, T_camera_world, K):
    h = (K @ T_camera_world[:3] @ np.vstack([p_world.T, np.ones(len(p_world))])).T
    out = np.full((len(p_world), 2), np.nan)
    seen = h[:, 2] > 0
    out[seen] = h[seen, :2] / h[seen, 2:]
    return out


def ray_weights__loop(density, spacing):
    out = np.zeros_like(density)
    for r, row in enumerate(density):
        light = 1.0
        for s, sigma in enumerate(row):
            kept = math.exp(-sigma * spacing)
            out[r, s] = light * (1 - kept)
            light *= kept
    return out


def ray_weights__differences(density, spacing):
    through = np.exp(-spacing * np.cumsum(np.pad(density, ((0, 0), (1, 0))), axis=1))
    return through[:, :-1] - through[:, 1:]


def reprojection_rms__norm(residuals):
    return linalg.norm(residuals) / math.sqrt(len(residuals))


def reprojection_rms__fractions(residuals):
    total = sum(Fraction(float(value)) ** 2 for value in residuals.ravel())
    return math.sqrt(total / len(residuals))


def rotation_from_axis_angle__expm(axis, angle):
    length = math.hypot(*axis)
    if length == 0:
        raise ValueError("which axis?")
    x, y, z = axis / length * math.remainder(angle, 2 * math.pi)
    return linalg.expm(np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]]))


def rotation_from_six__qr(y):
    out = []
    for row in y:
        Q, R = np.linalg.qr(row.reshape(2, 3).T)
        Q = Q * np.sign(np.diag(R))
        out.append(np.column_stack([Q, np.cross(Q[:, 0], Q[:, 1])]))
    return np.array(out).reshape(-1, 3, 3)


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


def shortest_distances__bellman_ford(edges, lengths, count, source):
    far = [math.inf] * count
    far[source] = 0
    changed = True
    while changed:
        changed = False
        for (i, j), length in zip(edges.tolist(), lengths.tolist(), strict=True):
            for a, b in ((i, j), (j, i)):
                if far[a] + length < far[b]:
                    far[b], changed = far[a] + length, True
    return far


def signed_volume__determinants(p, faces):
    return sum(float(np.linalg.det(p[face])) for face in faces) / 6


def similarity_scale__umeyama(p_target, p_source):
    if not len(p_source):
        raise ValueError("no pairs")
    s, t = p_source - p_source.mean(0), p_target - p_target.mean(0)
    spread = (s * s).sum()
    if np.ptp(p_source, axis=0).max() == 0:
        return 1
    U, D, Vt = linalg.svd(t.T @ s)
    D[2] *= np.sign(linalg.det(U) * linalg.det(Vt))
    return D.sum() / spread


def spherical_from_cartesian__complex(p):
    rows = []
    for x, y, z in (p + 0.0).tolist():
        flat = math.hypot(x, y)
        azimuth = math.atan2(y, x) if flat else 0.0
        rows.append(
            (
                math.hypot(flat, z),
                math.atan2(flat, z) if flat or z else 0.0,
                abs(azimuth) if y == 0 else azimuth,
            )
        )
    return np.array(rows).reshape(-1, 3)


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


def volume_by_chance__statistics(inside, box_volume):
    n = len(inside)
    if n == 0:
        raise ValueError("no points")
    return box_volume * np.mean(inside), box_volume * np.std(inside) / math.sqrt(n)


def volume_by_chance__counted(inside, box_volume):
    hits = sum(map(bool, inside))
    share = hits / len(inside) if len(inside) else None
    if share is None:
        raise ValueError("no points")
    return [box_volume * share, box_volume * math.sqrt(share * (1 - share) / len(inside))]


def winner_takes_all__running(cost):
    best, where = cost[0].astype(float), np.zeros(cost.shape[1:], int)
    for d in range(1, len(cost)):
        lower = cost[d] < best
        best[lower], where[lower] = cost[d][lower], d
    return where


def box_sdf__single_precision(p, half_size):
    q = (np.abs(p) - half_size).astype(np.float32)
    return np.linalg.norm(np.maximum(q, 0), axis=1) + np.minimum(q.max(axis=1), 0)


def project__einsum_strided(p_world, T_camera_world, K):
    camera = np.einsum("ij,nj->ni", T_camera_world[:3, :3], p_world) + T_camera_world[None, :3, 3]
    with np.errstate(divide="ignore", invalid="ignore"):
        uv = np.einsum("ij,nj->in", K, camera / camera[:, 2:])[:2].T
    uv[~(camera[:, 2] > 0)] = special.xlogy(np.nan, 1)
    return uv
