"""Right answers on motions and fits by somebody who read the starters alone, none of the checks:
rotations, coordinates, ICP's steps, axes, least squares, RANSAC. `EXERCISE__kind`.

They take other ways than the tables of `solutions/`: calls of other libraries, loops, lists, single
precision, other algorithms. Each earns full marks, or a check asks for more than its contract says.
"""

import itertools
import math

import numpy as np
from scipy import linalg
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


def canonical_signs__loop(axes, p):
    middle = np.mean(p, axis=0)
    kept = []
    for k in (0, 1):
        moment = sum(float((x - middle) @ axes[:, k]) ** 3 for x in p)
        kept.append(-axes[:, k] if moment < 0 else axes[:, k].copy())
    return np.stack([*kept, np.cross(*kept)], axis=1)


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


def match__brute(p_target, p_source):
    if not len(p_target):
        raise ValueError("nothing to match")
    return [min(range(len(p_target)), key=lambda j: math.dist(p_target[j], x)) for x in p_source]


def meet__determinants(lines_a, lines_b):
    out = []
    for (a, b, c), (d, e, f) in zip(lines_a.tolist(), lines_b.tolist(), strict=True):
        out.append([b * f - c * e, c * d - a * f, a * e - b * d])
    return np.array(out).reshape(-1, 3)


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
