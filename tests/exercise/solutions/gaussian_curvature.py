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


def right_nan_written_at_the_end(p, faces):
    K = (2 * np.pi - angle_sums(p, faces)) / areas(p, faces)
    K[border(len(p), faces)] = np.nan
    return K


def right_scaled_mesh(p, faces):
    s = np.ptp(p)
    return right_mixed(p / s, faces) / s**2


def right_complex_angles(p, faces):
    total = np.zeros(len(p))
    for i, u, v in corners(p, faces):
        np.add.at(total, i, np.angle((u * v).sum(1) + 1j * np.linalg.norm(np.cross(u, v), axis=1)))
    return divided(p, faces, 2 * np.pi - total, areas(p, faces))


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


def wrong_scaled_in_place(p, faces):
    p -= p.mean(axis=0)
    return right_mixed(p, faces)


def wrong_a_little_added_to_the_area(p, faces):
    return divided(p, faces, 2 * np.pi - angle_sums(p, faces), areas(p, faces) + 1e-7)


def wrong_large_values_cut(p, faces):
    return np.clip(right_mixed(p, faces), -1000, 1000)
