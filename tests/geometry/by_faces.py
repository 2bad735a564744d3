"""Angles, areas and borders of a mesh by school geometry, to hold the fast formulas and what is
said of them to.
"""

import functools

import numpy as np


@functools.lru_cache(maxsize=8)
def measured_face_by_face(
    p_bytes: bytes, faces_bytes: bytes
) -> tuple[np.ndarray, np.ndarray, np.ndarray, int]:
    """Return angle sums, mixed areas, which vertices lie on the border, and V - E + F, face by
    face.
    """
    p = np.frombuffer(p_bytes).reshape(-1, 3)
    faces = np.frombuffer(faces_bytes, dtype=np.int64).reshape(-1, 3)
    angles, areas = np.zeros(len(p)), np.zeros(len(p))
    a, b, c = p[faces].swapaxes(0, 1)
    area = np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2
    corner = []
    for here, first, second in ((a, b, c), (b, c, a), (c, a, b)):
        u, v = first - here, second - here
        cosine = np.einsum("fx,fx->f", u, v) / np.linalg.norm(u, axis=1) / np.linalg.norm(v, axis=1)
        corner.append(np.arccos(np.clip(cosine, -1, 1)))
    obtuse = np.max(corner, axis=0) > np.pi / 2
    for k, (here, first, second) in enumerate(((a, b, c), (b, c, a), (c, a, b))):
        # The cell ends at the bisectors of the two edges: their halves, times the cotangent of the
        # angle across.
        across = [
            np.sum((first - here) ** 2, axis=1) / np.tan(corner[(k + 2) % 3]),
            np.sum((second - here) ** 2, axis=1) / np.tan(corner[(k + 1) % 3]),
        ]
        share = np.where(
            obtuse, np.where(corner[k] > np.pi / 2, area / 2, area / 4), (across[0] + across[1]) / 8
        )
        angles += np.bincount(faces[:, k], corner[k], len(p))
        areas += np.bincount(faces[:, k], share, len(p))
    ends = np.sort(np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]), axis=1)
    edges, times = np.unique(ends[:, 0] * len(p) + ends[:, 1], return_counts=True)
    border = np.zeros(len(p), dtype=bool)
    border[edges[times == 1] // len(p)] = border[edges[times == 1] % len(p)] = True
    return angles, areas, border, len(np.unique(faces)) - len(edges) + len(faces)
