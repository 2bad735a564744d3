"""What students hand in for signed_volume."""

import numpy as np

NAMED = {
    "wrong_abs_of_each": "unsigned",
    "wrong_abs_at_the_end": "size only",
    "wrong_a_third": "a third",
    "wrong_half_like_area": "a half",
    "wrong_no_division": "undivided",
    "wrong_c_cross_b": "turned round",
    "wrong_centred_first": "about the middle",
    "wrong_hull": "convex hull",
}


def right_cross(p, faces):
    a, b, c = p[faces[:, 0]], p[faces[:, 1]], p[faces[:, 2]]
    return (a * np.cross(b, c)).sum() / 6


def right_permutation_symbol(p, faces):
    e = np.zeros((3, 3, 3))
    e[0, 1, 2] = e[1, 2, 0] = e[2, 0, 1] = 1
    e[0, 2, 1] = e[2, 1, 0] = e[1, 0, 2] = -1
    v = p[faces]
    return np.einsum("xyz,fx,fy,fz->", e, v[:, 0], v[:, 1], v[:, 2]) / 6


def right_determinants(p, faces):
    return np.linalg.det(p[faces]).sum() / 6


def wrong_prisms(p, faces):
    """Each face with its shadow on the ground: signed shadow times mean height."""
    a, b, c = (p[faces[:, i]] for i in range(3))
    u, v = b - a, c - a
    shadow = (u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]) / 2
    return np.dot(shadow, (a[:, 2] + b[:, 2] + c[:, 2]) / 3)


def right_sarrus(p, faces):
    total = 0.0
    for i, j, k in faces.tolist():
        (ax, ay, az), (bx, by, bz), (cx, cy, cz) = p[i].tolist(), p[j].tolist(), p[k].tolist()
        total += (
            ax * by * cz + ay * bz * cx + az * bx * cy - az * by * cx - ay * bx * cz - ax * bz * cy
        )
    return total / 6


def wrong_abs_of_each(p, faces):
    a, b, c = p[faces].transpose(1, 0, 2)
    return np.abs(np.einsum("ij,ij->i", a, np.cross(b, c))).sum() / 6


def wrong_abs_at_the_end(p, faces):
    a, b, c = p[faces].transpose(1, 0, 2)
    return abs(np.einsum("ij,ij->", a, np.cross(b, c)) / 6)


def wrong_a_third(p, faces):
    a, b, c = p[faces].transpose(1, 0, 2)
    return np.einsum("ij,ij->", a, np.cross(b, c)) / 3


def wrong_half_like_area(p, faces):
    a, b, c = p[faces].transpose(1, 0, 2)
    return (a * np.cross(b, c)).sum() / 2


def wrong_no_division(p, faces):
    a, b, c = p[faces].transpose(1, 0, 2)
    return (a * np.cross(b, c)).sum()


def wrong_c_cross_b(p, faces):
    a, b, c = p[faces].transpose(1, 0, 2)
    return (a * np.cross(c, b)).sum() / 6


def wrong_centred_first(p, faces):
    q = p - p.mean(axis=0)
    a, b, c = q[faces].transpose(1, 0, 2)
    return (a * np.cross(b, c)).sum() / 6


def wrong_hull(p, faces):
    from scipy.spatial import ConvexHull

    return ConvexHull(p).volume


def wrong_flux_of_x_alone(p, faces):
    """The divergence theorem with (x, 0, 0): right for closed meshes only."""
    if len(faces) == 0:
        return 0.0
    a, b, c = p[faces].transpose(1, 0, 2)
    n = np.cross(b - a, c - a) / 2
    return (n[:, 0] * (a[:, 0] + b[:, 0] + c[:, 0]) / 3).sum()


def wrong_centre_of_the_box(p, faces):
    q = p - (p.max(axis=0) + p.min(axis=0)) / 2
    a, b, c = q[faces].transpose(1, 0, 2)
    return (a * np.cross(b, c)).sum() / 6


def wrong_tip_in_first_vertex(p, faces):
    q = p - p[0]
    a, b, c = q[faces].transpose(1, 0, 2)
    return (a * np.cross(b, c)).sum() / 6


def wrong_divides_without_faces(p, faces):
    a, b, c = p[faces].transpose(1, 0, 2)
    return (a * np.cross(b, c)).sum(axis=1).mean() * len(faces) / 6


def wrong_small_is_nothing(p, faces):
    V = right_cross(p, faces)
    return 0.0 if abs(V) < 1e-3 else V


def wrong_open_is_never_negative(p, faces):
    edges = np.sort(np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]), axis=1)
    closed = len(edges) and (np.unique(edges, axis=0, return_counts=True)[1] == 2).all()
    return right_cross(p, faces) if closed else abs(right_cross(p, faces))
