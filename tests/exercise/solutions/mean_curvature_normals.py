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


def right_loops(p, faces):
    total = np.zeros((len(p), 3))
    for f in faces.tolist():
        for k in range(3):
            o, i, j = f[k], f[(k + 1) % 3], f[(k + 2) % 3]
            u, v = p[i] - p[o], p[j] - p[o]
            cot = float(u @ v) / float(np.sqrt(max(u @ u * (v @ v) - (u @ v) ** 2, 1e-300)))
            total[i] += cot * (p[i] - p[j])
            total[j] += cot * (p[j] - p[i])
    return finished(p, faces, total, 2 * areas(p, faces))


def right_area_gradient(p, faces):
    total = np.zeros_like(p)
    n = np.cross(p[faces[:, 1]] - p[faces[:, 0]], p[faces[:, 2]] - p[faces[:, 0]])
    n /= np.linalg.norm(n, axis=1, keepdims=True)
    for k in range(3):
        np.add.at(
            total, faces[:, k], np.cross(n, p[faces[:, (k + 2) % 3]] - p[faces[:, (k + 1) % 3]])
        )
    return finished(p, faces, total, 2 * areas(p, faces))


def right_dictionary_of_edges(p, faces):
    weight = {}
    for i, j, c in opposite(p, faces):
        for a, b, w in zip(i.tolist(), j.tolist(), c.tolist()):
            weight[min(a, b), max(a, b)] = weight.get((min(a, b), max(a, b)), 0.0) + w
    total = np.zeros_like(p)
    for (a, b), w in weight.items():
        total[a] += w * (p[a] - p[b])
        total[b] += w * (p[b] - p[a])
    return finished(p, faces, total, 2 * areas(p, faces))


def right_tangents_of_angles(p, faces):
    total = np.zeros_like(p)
    for k in range(3):
        o, i, j = faces[:, k], faces[:, (k + 1) % 3], faces[:, (k + 2) % 3]
        u, v = p[i] - p[o], p[j] - p[o]
        angle = np.arctan2(np.linalg.norm(np.cross(u, v), axis=1), (u * v).sum(1))
        pull = np.tan(np.pi / 2 - angle)[:, None] * (p[i] - p[j])
        np.add.at(total, i, pull)
        np.subtract.at(total, j, pull)
    return finished(p, faces, total, 2 * areas(p, faces))


def right_bincount_per_axis(p, faces):
    total = np.zeros_like(p)
    for i, j, c in opposite(p, faces):
        for axis in range(3):
            pull = c * (p[i, axis] - p[j, axis])
            total[:, axis] += np.bincount(i, pull, len(p)) - np.bincount(j, pull, len(p))
    return finished(p, faces, total, 2 * areas(p, faces))


def right_scaled_mesh(p, faces):
    s = np.ptp(p)
    return right_cotangents((p - p.mean(axis=0)) / s, faces) / s


def right_single_precision(p, faces):
    return right_cotangents(p, faces).astype(np.float32)


class Mesh:
    def __init__(self, p, faces):
        self.p, self.faces = p, faces

    @property
    def normals(self):
        return finished(
            self.p, self.faces, pulls(self.p, self.faces), 2 * areas(self.p, self.faces)
        )


def right_class(p, faces):
    return Mesh(p, faces).normals


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


def wrong_direction_only(p, faces):
    out = right_cotangents(p, faces)
    with np.errstate(invalid="ignore"):
        return out / np.maximum(np.linalg.norm(out, axis=1, keepdims=True), 1e-12)


def wrong_lengths_returned(p, faces):
    return np.linalg.norm(right_cotangents(p, faces), axis=1)


def wrong_tangent_for_cotangent(p, faces):
    total = np.zeros_like(p)
    for i, j, c in opposite(p, faces):
        with np.errstate(all="ignore"):
            pull = np.nan_to_num(1 / c)[:, None] * (p[i] - p[j])
        np.add.at(total, i, pull)
        np.subtract.at(total, j, pull)
    return finished(p, faces, total, 2 * areas(p, faces))


def wrong_cosine_for_cotangent(p, faces):
    total = np.zeros_like(p)
    for i, j, c in opposite(p, faces):
        pull = (c / np.sqrt(1 + c**2))[:, None] * (p[i] - p[j])
        np.add.at(total, i, pull)
        np.subtract.at(total, j, pull)
    return finished(p, faces, total, 2 * areas(p, faces))


def wrong_negative_weights_cut(p, faces):
    total = np.zeros_like(p)
    for i, j, c in opposite(p, faces):
        pull = np.maximum(c, 0)[:, None] * (p[i] - p[j])
        np.add.at(total, i, pull)
        np.subtract.at(total, j, pull)
    return finished(p, faces, total, 2 * areas(p, faces))


def wrong_fancy_index_sum(p, faces):
    total = np.zeros_like(p)
    for i, j, c in opposite(p, faces):
        pull = c[:, None] * (p[i] - p[j])
        total[i] += pull
        total[j] -= pull
    return finished(p, faces, total, 2 * areas(p, faces))


def wrong_uniform_weights(p, faces):
    total = np.zeros_like(p)
    for i, j, _ in opposite(p, faces):
        np.add.at(total, i, p[i] - p[j])
        np.subtract.at(total, j, p[i] - p[j])
    return finished(p, faces, total, 2 * areas(p, faces))


def wrong_border_is_zero(p, faces):
    return np.nan_to_num(right_cotangents(p, faces))


def wrong_border_is_infinite(p, faces):
    out = right_cotangents(p, faces)
    return np.where(np.isnan(out), np.inf, out)


def wrong_one_nan_per_row(p, faces):
    out = right_cotangents(p, faces)
    out[np.isnan(out[:, 0]), 1:] = 0
    return out


def wrong_turned_outward_by_the_position(p, faces):
    out = right_cotangents(p, faces)
    flip = np.sign((out * p).sum(axis=1, keepdims=True))
    return out * np.where(flip == 0, 1, flip)


def wrong_moved_in_place(p, faces):
    p -= p.mean(axis=0)
    return right_cotangents(p, faces)


def wrong_transposed(p, faces):
    return right_cotangents(p, faces).T


def wrong_voronoi_without_the_obtuse_case(p, faces):
    area = np.zeros(len(p))
    for i, j, c in opposite(p, faces):
        part = c * ((p[i] - p[j]) ** 2).sum(axis=1) / 8
        np.add.at(area, i, part)
        np.add.at(area, j, part)
    return finished(p, faces, pulls(p, faces), 2 * area)


def wrong_sphere_assumed(p, faces):
    q = p - p.mean(axis=0)
    return finished(p, faces, 2 * q, (q**2).sum(axis=1))


def wrong_sum_of_face_normals(p, faces):
    n = np.cross(p[faces[:, 1]] - p[faces[:, 0]], p[faces[:, 2]] - p[faces[:, 0]])
    total = np.zeros_like(p)
    np.add.at(total, faces.ravel(), np.repeat(n, 3, axis=0))
    return finished(p, faces, total, 2 * areas(p, faces))


def wrong_area_of_the_mesh(p, faces):
    return finished(p, faces, pulls(p, faces), np.full(len(p), 2 * areas(p, faces).mean()))


def wrong_each_edge_from_one_end(p, faces):
    total = np.zeros_like(p)
    for i, j, c in opposite(p, faces):
        np.add.at(total, i, 2 * c[:, None] * (p[i] - p[j]))
    return finished(p, faces, total, 2 * areas(p, faces))


def wrong_a_little_added_to_the_area(p, faces):
    return finished(p, faces, pulls(p, faces), 2 * areas(p, faces) + 1e-7)
