"""Right answers on shapes by somebody who read the starters alone, none of the checks: surfaces,
volumes, curvature, graphs, distances of points and of clouds. `EXERCISE__kind`.

They take other ways than the tables of `solutions/`: calls of other libraries, loops, lists, single
precision, other algorithms. Each earns full marks, or a check asks for more than its contract says.
"""

import heapq
import math
from collections import defaultdict

import numpy as np
from scipy import linalg, optimize, sparse, spatial


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


def points_on_faces__folded(p, faces, u):
    a, b, c = (p[faces[:, k]] for k in range(3))
    area = np.linalg.norm(np.cross(b - a, c - a), axis=1)
    ends = np.cumsum(area) / area.sum()
    k = np.minimum(np.searchsorted(ends, u[:, 0], side="right"), np.flatnonzero(area)[-1])
    s, t = u[:, 1:2], u[:, 2:3]
    over = s + t > 1
    s, t = np.where(over, 1 - s, s), np.where(over, 1 - t, t)
    return a[k] + s * (b - a)[k] + t * (c - a)[k]


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


def box_sdf__single_precision(p, half_size):
    q = (np.abs(p) - half_size).astype(np.float32)
    return np.linalg.norm(np.maximum(q, 0), axis=1) + np.minimum(q.max(axis=1), 0)
