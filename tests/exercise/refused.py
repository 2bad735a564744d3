"""Right answers that a library gives in one call, as they were handed in: `EXERCISE__kind`. Their
exercises forbid that.
"""

import cmath

import numpy as np
from scipy import sparse
from scipy.sparse import csgraph
from scipy.spatial.transform import Rotation


def unit(axis):
    n = np.linalg.norm(axis)
    if n == 0:
        raise ValueError("zero axis")
    return axis / n


def refuse(order):
    if order.lower() == order or order.upper() == order:
        return
    raise ValueError("mixed")


def with_centroids(R, p_target, p_source):
    T = np.eye(4)
    T[:3, :3] = R
    T[:3, 3] = p_target.mean(0) - R @ p_source.mean(0)
    return T


def align_rigid__horn_quaternion(p_target, p_source):
    if len(p_target) == 0:
        raise ValueError("no pairs")
    a, b = p_source - p_source.mean(0), p_target - p_target.mean(0)
    S = a.T @ b
    d = np.array([S[1, 2] - S[2, 1], S[2, 0] - S[0, 2], S[0, 1] - S[1, 0]])
    N = np.zeros((4, 4))
    N[0, 0] = np.trace(S)
    N[0, 1:] = N[1:, 0] = d
    N[1:, 1:] = S + S.T - np.trace(S) * np.eye(3)
    w, x, y, z = np.linalg.eigh(N)[1][:, -1]
    R = Rotation.from_quat([x, y, z, w]).as_matrix()
    T = np.eye(4)
    T[:3, :3] = R
    T[:3, 3] = p_target.mean(0) - R @ p_source.mean(0)
    return T


def euler_to_matrix__scipy(angles, order):
    letters = order.lower() if isinstance(order, str) else ""
    if len(letters) != 3 or set(letters) - set("xyz") or order not in (letters, letters.upper()):
        raise ValueError("no order")
    if letters[0] == letters[1] or letters[1] == letters[2]:
        raise ValueError("twice in a row")
    return Rotation.from_euler(order, angles).as_matrix()


def rotation_from_axis_angle__complex_half_turn(axis, angle):
    if not np.any(axis):
        raise ValueError("zero axis")
    half = cmath.exp(0.5j * angle)
    return Rotation.from_quat(
        np.append(half.imag * axis / np.linalg.norm(axis), half.real)
    ).as_matrix()


def shortest_distances__csgraph(edges, lengths, count, source):
    graph = sparse.coo_array((lengths, (edges[:, 0], edges[:, 1])), (count, count))
    return csgraph.bellman_ford(graph.tocsr(), directed=False, indices=source)


def rotation_from_axis_angle__scipy(axis, angle):
    from scipy.spatial.transform import Rotation

    return Rotation.from_rotvec(angle * unit(axis)).as_matrix()


def euler_to_matrix__scipy_turn_by_turn(angles, order):
    from scipy.spatial.transform import Rotation

    refuse(order)
    total = Rotation.identity()
    for letter, a in zip(order, angles, strict=True):
        turn = Rotation.from_euler(letter.lower(), float(a))
        total = turn * total if letter.islower() else total * turn
    return total.as_matrix()


def align_rigid__with_scipy(p_target, p_source):
    from scipy.spatial.transform import Rotation

    if len(p_source) == 0:
        raise ValueError("no pairs")
    a, b = p_source - p_source.mean(0), p_target - p_target.mean(0)
    if len(a) == 1:
        return with_centroids(np.eye(3), p_target, p_source)
    import warnings

    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        R, _ = Rotation.align_vectors(b, a)
    return with_centroids(R.as_matrix(), p_target, p_source)


def match__cdist(p_target, p_source):
    from scipy.spatial.distance import cdist

    if not p_target.size:
        raise ValueError("empty target")
    return np.argmin(cdist(p_source, p_target), axis=1)


def match__kdtree(p_target, p_source):
    from scipy.spatial import KDTree

    if p_target.shape[0] < 1:
        raise ValueError("empty target")
    _, index = KDTree(p_target).query(p_source, k=1)
    return index


def laplacian__scipy(adjacency):
    from scipy.sparse.csgraph import laplacian as of

    return of(adjacency)


def mahalanobis__cdist(p, mean, covariance):
    from scipy.spatial.distance import cdist

    return cdist(p, mean[None], "mahalanobis", VI=np.linalg.inv(covariance)).ravel()


def shortest_distances__scipy(edges, lengths, count, source):
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import dijkstra

    G = coo_array((lengths, (edges[:, 0], edges[:, 1])), shape=(count, count)).tocsr()
    return dijkstra(G, directed=False, indices=[source])[0]


def pose_from_distances__scipy(p_world, rays, distances):
    from scipy.spatial.transform import Rotation

    q = distances[:, None] * rays
    R = Rotation.align_vectors(q - q.mean(0), p_world - p_world.mean(0))[0].as_matrix()
    T = np.identity(4)
    T[:3, :3] = R
    T[:3, 3] = q.mean(0) - R @ p_world.mean(0)
    return T
