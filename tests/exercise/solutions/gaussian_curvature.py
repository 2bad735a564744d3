"""What students hand in for gaussian_curvature."""

import numpy as np

NAMED = {
    "wrong_thirds": "a third of each face",
    "wrong_defect": "defect not divided",
    "wrong_border_kept": "a value on the border",
    "wrong_ring_area": "whole faces",
    "wrong_voronoi_everywhere": "voronoi in obtuse faces",
    "wrong_full_turn_on_the_border_kept": "no border",
}


def corners(p, faces):
    for k in range(3):
        i, j, l = faces[:, k], faces[:, (k + 1) % 3], faces[:, (k + 2) % 3]
        yield i, p[j] - p[i], p[l] - p[i]


def double_areas(p, faces):
    return np.linalg.norm(
        np.cross(p[faces[:, 1]] - p[faces[:, 0]], p[faces[:, 2]] - p[faces[:, 0]]), axis=1
    )


def angle_sums(p, faces):
    total = np.zeros(len(p))
    for i, u, v in corners(p, faces):
        np.add.at(total, i, np.arctan2(np.linalg.norm(np.cross(u, v), axis=1), (u * v).sum(1)))
    return total


def border(count, faces):
    edges = np.sort(np.vstack([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]), axis=1)
    found, times = np.unique(edges, axis=0, return_counts=True)
    mask = np.zeros(count, bool)
    mask[found[times == 1].ravel()] = True
    return mask


def areas(p, faces, obtuse_at=0.5, obtuse_else=0.25, mixed=True):
    area, double = np.zeros(len(p)), double_areas(p, faces)
    dots = np.array([(u * v).sum(1) for _, u, v in corners(p, faces)])
    obtuse = (dots < 0).any(axis=0) if mixed else np.zeros(len(faces), bool)
    safe = np.where(double > 0, double, 1)
    for k, (i, u, v) in enumerate(corners(p, faces)):
        cot_j, cot_l = dots[(k + 1) % 3] / safe, dots[(k + 2) % 3] / safe
        voronoi = ((u**2).sum(1) * cot_l + (v**2).sum(1) * cot_j) / 8
        share = np.where(dots[k] < 0, obtuse_at, obtuse_else) * double / 2
        np.add.at(area, i, np.where(obtuse, share, voronoi))
    return area


def divided(p, faces, defect, area):
    with np.errstate(all="ignore"):
        return np.where(border(len(p), faces), np.nan, defect / area)


def right_mixed(p, faces):
    return divided(p, faces, 2 * np.pi - angle_sums(p, faces), areas(p, faces))


def right_loops(p, faces):
    defect, area, count = [2 * np.pi] * len(p), [0.0] * len(p), {}
    for f in faces.tolist():
        P = [p[i] for i in f]
        A = float(np.linalg.norm(np.cross(P[1] - P[0], P[2] - P[0]))) / 2
        ang = []
        for k in range(3):
            u, v = P[(k + 1) % 3] - P[k], P[(k + 2) % 3] - P[k]
            ang.append(float(np.arctan2(2 * A, u @ v)))
            edge = tuple(sorted((f[k], f[(k + 1) % 3])))
            count[edge] = count.get(edge, 0) + 1
        for k in range(3):
            defect[f[k]] -= ang[k]
            if max(ang) > np.pi / 2:
                area[f[k]] += A / 2 if ang[k] > np.pi / 2 else A / 4
            else:
                u, v = P[(k + 1) % 3] - P[k], P[(k + 2) % 3] - P[k]
                area[f[k]] += (
                    float(u @ u / np.tan(ang[(k + 2) % 3]) + v @ v / np.tan(ang[(k + 1) % 3])) / 8
                )
    edge_of = {i for edge, n in count.items() if n == 1 for i in edge}
    return [float("nan") if i in edge_of else d / a for i, (d, a) in enumerate(zip(defect, area))]


def right_bincount(p, faces):
    corner = p[faces]
    u, v = np.roll(corner, -1, 1) - corner, np.roll(corner, 1, 1) - corner
    dot = np.einsum("fck,fck->fc", u, v)
    double = np.linalg.norm(np.cross(u[:, 0], v[:, 0]), axis=1)[:, None]
    angle = np.arctan2(double, dot)
    with np.errstate(all="ignore"):
        cot = dot / double
    uu, vv = (u**2).sum(-1), (v**2).sum(-1)
    part = (uu * np.roll(cot, 1, 1) + vv * np.roll(cot, -1, 1)) / 8
    obtuse = (angle > np.pi / 2).any(1, keepdims=True)
    part = np.where(obtuse, np.where(angle > np.pi / 2, double / 4, double / 8), part)
    defect = 2 * np.pi - np.bincount(faces.ravel(), angle.ravel(), len(p))
    return divided(p, faces, defect, np.bincount(faces.ravel(), part.ravel(), len(p)))


def right_clipped_cosines(p, faces):
    total = np.zeros(len(p))
    for i, u, v in corners(p, faces):
        c = (u * v).sum(1) / np.linalg.norm(u, axis=1) / np.linalg.norm(v, axis=1)
        np.add.at(total, i, np.arccos(np.clip(c, -1, 1)))
    return divided(p, faces, 2 * np.pi - total, areas(p, faces))


def right_nan_written_at_the_end(p, faces):
    K = (2 * np.pi - angle_sums(p, faces)) / areas(p, faces)
    K[border(len(p), faces)] = np.nan
    return K


def right_scaled_mesh(p, faces):
    s = np.ptp(p)
    return right_mixed(p / s, faces) / s**2


def right_kahan(p, faces):
    area = np.zeros(len(p))
    cut = np.zeros(len(p))
    for f in faces:
        part = areas(p[f], np.array([[0, 1, 2]]))
        new = area[f] + (part - cut[f])
        cut[f] = (new - area[f]) - (part - cut[f])
        area[f] = new
    return divided(p, faces, 2 * np.pi - angle_sums(p, faces), area)


def right_single_precision(p, faces):
    return right_mixed(p, faces).astype(np.float32)


def right_complex_angles(p, faces):
    total = np.zeros(len(p))
    for i, u, v in corners(p, faces):
        np.add.at(total, i, np.angle((u * v).sum(1) + 1j * np.linalg.norm(np.cross(u, v), axis=1)))
    return divided(p, faces, 2 * np.pi - total, areas(p, faces))


class Vertices:
    def __init__(self, p, faces):
        self.p, self.faces = p.copy(), faces.copy()

    def curvature(self):
        return right_mixed(self.p, self.faces)


def right_class(p, faces):
    return Vertices(p, faces).curvature()


# wrong ---------------------------------------------------------------------------------------------------------------


def third_areas(p, faces):
    return np.bincount(faces.ravel(), np.repeat(double_areas(p, faces) / 6, 3), len(p))


def wrong_thirds(p, faces):
    return divided(p, faces, 2 * np.pi - angle_sums(p, faces), third_areas(p, faces))


def wrong_defect(p, faces):
    return divided(p, faces, 2 * np.pi - angle_sums(p, faces), 1.0)


def wrong_border_kept(p, faces):
    turn = np.where(border(len(p), faces), np.pi, 2 * np.pi)
    return (turn - angle_sums(p, faces)) / areas(p, faces)


def wrong_full_turn_on_the_border_kept(p, faces):
    return (2 * np.pi - angle_sums(p, faces)) / areas(p, faces)


def wrong_ring_area(p, faces):
    return divided(p, faces, 2 * np.pi - angle_sums(p, faces), 3 * third_areas(p, faces))


def wrong_voronoi_everywhere(p, faces):
    double = double_areas(p, faces)
    area = np.zeros(len(p))
    dots = np.array([(u * v).sum(1) for _, u, v in corners(p, faces)])
    with np.errstate(all="ignore"):
        for k, (i, u, v) in enumerate(corners(p, faces)):
            part = (
                ((u**2).sum(1) * dots[(k + 2) % 3] + (v**2).sum(1) * dots[(k + 1) % 3]) / double / 8
            )
            np.add.at(area, i, part)
    return divided(p, faces, 2 * np.pi - angle_sums(p, faces), area)


def wrong_quarter_and_eighths(p, faces):
    return divided(p, faces, 2 * np.pi - angle_sums(p, faces), areas(p, faces, 0.25, 0.125))


def wrong_third_of_obtuse_faces(p, faces):
    return divided(p, faces, 2 * np.pi - angle_sums(p, faces), areas(p, faces, 1 / 3, 1 / 3))


def wrong_halves_swapped(p, faces):
    return divided(p, faces, 2 * np.pi - angle_sums(p, faces), areas(p, faces, 0.25, 0.5))


def wrong_border_is_zero(p, faces):
    return np.nan_to_num(right_mixed(p, faces))


def wrong_border_is_infinite(p, faces):
    K = right_mixed(p, faces)
    return np.where(np.isnan(K), np.inf, K)


def wrong_border_left_out(p, faces):
    K = right_mixed(p, faces)
    return K[~np.isnan(K)]


def wrong_sign(p, faces):
    return -right_mixed(p, faces)


def wrong_absolute(p, faces):
    return np.abs(right_mixed(p, faces))


def wrong_root(p, faces):
    with np.errstate(invalid="ignore"):
        return np.sqrt(right_mixed(p, faces))


def wrong_flat_face_gives_nan(p, faces):
    total = np.zeros(len(p))
    with np.errstate(all="ignore"):
        for i, u, v in corners(p, faces):
            n = np.cross(u, v)
            s = (n * (n / np.linalg.norm(n, axis=1)[:, None])).sum(1)
            np.add.at(total, i, np.arctan2(s, (u * v).sum(1)))
        return divided(p, faces, 2 * np.pi - total, areas(p, faces))


def wrong_flat_face_dropped(p, faces):
    faces = faces[double_areas(p, faces) > 1e-12]
    return right_mixed(p, faces)


def wrong_mean_area_for_all(p, faces):
    return divided(p, faces, 2 * np.pi - angle_sums(p, faces), areas(p, faces).mean())


def wrong_area_of_the_neighbour(p, faces):
    return divided(p, faces, 2 * np.pi - angle_sums(p, faces), np.roll(areas(p, faces), 1))


def wrong_scaled_in_place(p, faces):
    p -= p.mean(axis=0)
    return right_mixed(p, faces)


def wrong_degrees(p, faces):
    return np.degrees(right_mixed(p, faces))


def wrong_sphere_assumed(p, faces):
    r = np.linalg.norm(p - p.mean(axis=0), axis=1).mean()
    return np.where(border(len(p), faces), np.nan, 1 / r**2)


def wrong_column(p, faces):
    return right_mixed(p, faces)[:, None]


def wrong_total_only(p, faces):
    return float(np.nansum(right_mixed(p, faces)))


def wrong_a_little_added_to_the_area(p, faces):
    return divided(p, faces, 2 * np.pi - angle_sums(p, faces), areas(p, faces) + 1e-7)


def wrong_large_values_cut(p, faces):
    return np.clip(right_mixed(p, faces), -1000, 1000)
