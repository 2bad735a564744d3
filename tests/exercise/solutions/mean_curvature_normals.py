"""What students hand in for mean_curvature_normals."""

import numpy as np

NAMED = {
    "wrong_towards_the_neighbours": "inward",
    "wrong_half": "h n",
    "wrong_not_halved": "four h n",
    "wrong_thirds": "a third of each face",
    "wrong_border_kept": "a value on the border",
}


def opposite(p, faces):
    """Yield of every corner its edge's two ends and its cotangent."""
    for k in range(3):
        o, i, j = faces[:, k], faces[:, (k + 1) % 3], faces[:, (k + 2) % 3]
        u, v = p[i] - p[o], p[j] - p[o]
        yield i, j, (u * v).sum(1) / np.linalg.norm(np.cross(u, v), axis=1)


def border(count, faces):
    edges = np.sort(np.vstack([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]), axis=1)
    found, times = np.unique(edges, axis=0, return_counts=True)
    mask = np.zeros(count, bool)
    mask[found[times == 1].ravel()] = True
    return mask


def areas(p, faces):
    area = np.zeros(len(p))
    double = np.linalg.norm(
        np.cross(p[faces[:, 1]] - p[faces[:, 0]], p[faces[:, 2]] - p[faces[:, 0]]), axis=1
    )
    cot = np.array([c for _, _, c in opposite(p, faces)])
    obtuse = (cot < 0).any(axis=0)
    for k in range(3):
        i, j, l = faces[:, k], faces[:, (k + 1) % 3], faces[:, (k + 2) % 3]
        voronoi = ((p[j] - p[i]) ** 2).sum(1) * cot[(k + 2) % 3] + ((p[l] - p[i]) ** 2).sum(
            1
        ) * cot[(k + 1) % 3]
        share = np.where(cot[k] < 0, double / 4, double / 8)
        np.add.at(area, i, np.where(obtuse, share, voronoi / 8))
    return area


def pulls(p, faces):
    total = np.zeros_like(p)
    for i, j, c in opposite(p, faces):
        pull = c[:, None] * (p[i] - p[j])
        np.add.at(total, i, pull)
        np.add.at(total, j, -pull)
    return total


def finished(p, faces, total, area):
    out = total / np.asarray(area).reshape(-1, 1)
    out[border(len(p), faces)] = np.nan
    return out


def right_cotangents(p, faces):
    return finished(p, faces, pulls(p, faces), 2 * areas(p, faces))


def right_sparse_laplacian(p, faces):
    from scipy.sparse import coo_array

    i, j, c = (np.concatenate(part) for part in zip(*opposite(p, faces)))
    W = coo_array((np.r_[c, c], (np.r_[i, j], np.r_[j, i])), shape=(len(p), len(p))).tocsr()
    return finished(
        p, faces, np.asarray(W.sum(axis=1)).reshape(-1, 1) * p - W @ p, 2 * areas(p, faces)
    )


def right_area_gradient(p, faces):
    total = np.zeros_like(p)
    n = np.cross(p[faces[:, 1]] - p[faces[:, 0]], p[faces[:, 2]] - p[faces[:, 0]])
    n /= np.linalg.norm(n, axis=1, keepdims=True)
    for k in range(3):
        np.add.at(
            total, faces[:, k], np.cross(n, p[faces[:, (k + 2) % 3]] - p[faces[:, (k + 1) % 3]])
        )
    return finished(p, faces, total, 2 * areas(p, faces))


def right_scaled_mesh(p, faces):
    s = np.ptp(p)
    return right_cotangents((p - p.mean(axis=0)) / s, faces) / s


# wrong ---------------------------------------------------------------------------------------------------------------


def wrong_towards_the_neighbours(p, faces):
    return finished(p, faces, -pulls(p, faces), 2 * areas(p, faces))


def wrong_half(p, faces):
    return finished(p, faces, pulls(p, faces), 4 * areas(p, faces))


def wrong_not_halved(p, faces):
    return finished(p, faces, pulls(p, faces), areas(p, faces))


def thirds(p, faces):
    double = np.linalg.norm(
        np.cross(p[faces[:, 1]] - p[faces[:, 0]], p[faces[:, 2]] - p[faces[:, 0]]), axis=1
    )
    return np.bincount(faces.ravel(), np.repeat(double / 6, 3), len(p))


def wrong_thirds(p, faces):
    return finished(p, faces, pulls(p, faces), 2 * thirds(p, faces))


def wrong_border_kept(p, faces):
    return pulls(p, faces) / (2 * areas(p, faces))[:, None]


def wrong_turned_outward_by_the_position(p, faces):
    out = right_cotangents(p, faces)
    flip = np.sign((out * p).sum(axis=1, keepdims=True))
    return out * np.where(flip == 0, 1, flip)


def wrong_moved_in_place(p, faces):
    p -= p.mean(axis=0)
    return right_cotangents(p, faces)


def wrong_a_little_added_to_the_area(p, faces):
    return finished(p, faces, pulls(p, faces), 2 * areas(p, faces) + 1e-7)
