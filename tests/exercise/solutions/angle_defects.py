"""What students hand in for angle_defects."""

import numpy as np

NAMED = {
    "wrong_no_border": "full turn on the border",
    "wrong_fancy_index_sum": "repeated indices",
    "wrong_arccos_not_clipped": "cosine beyond 1",
}


def angles(p, faces):
    a, b, c = p[faces[:, 0]], p[faces[:, 1]], p[faces[:, 2]]
    out = []
    for i, j, k in ((a, b, c), (b, c, a), (c, a, b)):
        u, v = j - i, k - i
        out.append(np.arctan2(np.linalg.norm(np.cross(u, v), axis=1), (u * v).sum(axis=1)))
    return np.array(out).T


def border(count, faces):
    edges = np.sort(np.vstack([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]), axis=1)
    found, times = np.unique(edges, axis=0, return_counts=True)
    mask = np.zeros(count, bool)
    mask[found[times == 1].ravel()] = True
    return mask


def full_turn(p, faces):
    return np.where(border(len(p), faces), np.pi, 2 * np.pi)


def right_add_at(p, faces):
    out = full_turn(p, faces)
    np.subtract.at(out, faces, angles(p, faces))
    return out


def right_law_of_cosines_clipped(p, faces):
    out = full_turn(p, faces)
    for k in range(3):
        i, j, l = p[faces[:, k]], p[faces[:, (k + 1) % 3]], p[faces[:, (k + 2) % 3]]
        b, c, a = ((j - i) ** 2).sum(1), ((l - i) ** 2).sum(1), ((l - j) ** 2).sum(1)
        cosine = np.clip((b + c - a) / (2 * np.sqrt(b * c)), -1, 1)
        np.subtract.at(out, faces[:, k], np.arccos(cosine))
    return out


def right_sparse_border(p, faces):
    from scipy.sparse import coo_array

    i, j = faces.ravel(), np.roll(faces, -1, axis=1).ravel()
    directed = coo_array((np.ones(len(i)), (i, j)), shape=(len(p), len(p))).tocsr()
    lonely = abs(directed - directed.T)
    mask = np.asarray(lonely.sum(axis=1)).ravel() > 0
    sums = np.zeros(len(p))
    np.add.at(sums, faces.ravel(), angles(p, faces).ravel())
    return 2 * np.pi - np.pi * mask - sums


def right_matrix_product(p, faces):
    incidence = np.zeros((len(p), faces.size))
    incidence[faces.ravel(), np.arange(faces.size)] = 1
    return full_turn(p, faces) - incidence @ angles(p, faces).ravel()


# wrong ---------------------------------------------------------------------------------------------------------------


def wrong_no_border(p, faces):
    return 2 * np.pi - np.bincount(faces.ravel(), angles(p, faces).ravel(), minlength=len(p))


def wrong_fancy_index_sum(p, faces):
    out, a = full_turn(p, faces), angles(p, faces)
    for k in range(3):
        out[faces[:, k]] -= a[:, k]
    return out


def wrong_arccos_not_clipped(p, faces):
    out = full_turn(p, faces)
    with np.errstate(invalid="ignore"):
        for k in range(3):
            u, v = (
                p[faces[:, (k + 1) % 3]] - p[faces[:, k]],
                p[faces[:, (k + 2) % 3]] - p[faces[:, k]],
            )
            c = (u * v).sum(1) / (np.sqrt((u**2).sum(1)) * np.sqrt((v**2).sum(1)))
            np.subtract.at(out, faces[:, k], np.arccos(c))
    return out


def wrong_lone_vertices_are_zero(p, faces):
    out = right_add_at(p, faces)
    out[np.bincount(faces.ravel(), minlength=len(p)) == 0] = 0
    return out


def wrong_lone_vertices_lost(p, faces):
    return right_add_at(p, faces)[: faces.max() + 1]


def wrong_lone_vertices_break_bincount(p, faces):
    return full_turn(p, faces) - np.bincount(faces.ravel(), angles(p, faces).ravel())


def wrong_flat_faces_skipped(p, faces):
    a = angles(p, faces)
    keep = a.min(axis=1) > 1e-6
    out = full_turn(p, faces)
    np.subtract.at(out, faces[keep], a[keep])
    return out


def wrong_scaled_in_place(p, faces):
    p /= np.abs(p).max()
    return right_add_at(p, faces)


def wrong_faces_sorted_in_place(p, faces):
    faces.sort(axis=1)
    return right_add_at(p, faces)


def wrong_only_the_last_may_have_no_face(p, faces):
    out = right_add_at(p, faces)
    out[np.setdiff1d(np.arange(faces.max()), faces)] = 0
    return out


def wrong_one_without_faces_at_most(p, faces):
    out = right_add_at(p, faces)
    out[np.setdiff1d(np.arange(len(p)), faces)[1:]] = 0
    return out
