"""Wrong answers that students give to the exercises of this lesson, and right ones that are written differently."""

import numpy as np

from workbench.algorithms.icp import nearest
from workbench.exercise.model import Mistake
from workbench.geometry import alignment
from workbench.geometry.motions import exp_so3, inverse, motion, skew

# align_rigid ----------------------------------------------------------------------------------------------------------


def centroids_only(p_target: np.ndarray, p_source: np.ndarray) -> np.ndarray:
    """Matches the centroids and does not rotate."""
    return motion(np.eye(3), p_target.mean(0) - p_source.mean(0))


def rotation_transposed(p_target: np.ndarray, p_source: np.ndarray) -> np.ndarray:
    """Uses R^T, with the translation that goes with it."""
    R = alignment.align_rigid(p_target, p_source)[:3, :3].T
    return motion(R, p_target.mean(0) - R @ p_source.mean(0))


def reflection_kept(p_target: np.ndarray, p_source: np.ndarray) -> np.ndarray:
    """Leaves the determinant as it comes from the SVD."""
    U, _, Vt = np.linalg.svd((p_target - p_target.mean(0)).T @ (p_source - p_source.mean(0)))
    return motion(U @ Vt, p_target.mean(0) - U @ Vt @ p_source.mean(0))


def whole_matrix_negated(p_target: np.ndarray, p_source: np.ndarray) -> np.ndarray:
    """Negates R where its determinant is -1."""
    T = reflection_kept(p_target, p_source)
    R = T[:3, :3] * np.sign(np.linalg.det(T[:3, :3]))
    return motion(R, p_target.mean(0) - R @ p_source.mean(0))


def target_to_source(p_target: np.ndarray, p_source: np.ndarray) -> np.ndarray:
    """Returns T_source_target."""
    return inverse(alignment.align_rigid(p_target, p_source))


def centroid_not_turned(p_target: np.ndarray, p_source: np.ndarray) -> np.ndarray:
    """Uses t = mean_target - mean_source with any R."""
    T = alignment.align_rigid(p_target, p_source)
    return motion(T[:3, :3], p_target.mean(0) - p_source.mean(0))


def not_centred(p_target: np.ndarray, p_source: np.ndarray) -> np.ndarray:
    """Takes the products of the points themselves."""
    R = alignment.nearest_rotation(p_target.T @ p_source)
    return motion(R, p_target.mean(0) - R @ p_source.mean(0))


def principal_axes(p_target: np.ndarray, p_source: np.ndarray) -> np.ndarray:
    """Lays the principal axes over each other, whose signs nobody knows."""
    centred = (p - p.mean(0) for p in (p_target, p_source))
    axes_target, axes_source = (np.linalg.eigh(p.T @ p)[1] for p in centred)
    axes_target, axes_source = (axes * [1, 1, np.sign(np.linalg.det(axes))] for axes in (axes_target, axes_source))
    R = axes_target @ axes_source.T
    return motion(R, p_target.mean(0) - R @ p_source.mean(0))


def scaled(p_target: np.ndarray, p_source: np.ndarray) -> np.ndarray:
    """Fits a scale as well."""
    return alignment.align_similarity(p_target, p_source)


ALIGN_MISTAKES = (
    Mistake(
        "centroids only",
        centroids_only,
        "You moved the centroids onto each other and did not rotate. Find R from the covariance of the centred pairs.",
    ),
    Mistake(
        "rotation transposed",
        rotation_transposed,
        "Your R equals the transpose of the right one. From the SVD U D V^T of sum(target source^T) it is U V^T, from that "
        "of sum(source target^T) it is V U^T.",
    ),
    Mistake(
        "reflection kept",
        reflection_kept,
        "Your R is right but where it is a mirror image (determinant -1), as on flat, noisy clouds. Flip the direction with "
        "the smallest singular value then.",
    ),
    Mistake(
        "whole matrix negated",
        whole_matrix_negated,
        "Where the SVD gives a mirror image you negate all of R. Only the direction with the smallest singular value "
        "changes its sign: it costs least.",
    ),
    Mistake(
        "target to source",
        target_to_source,
        "You returned the motion from target to source: the inverse of the right one. T_target_source takes source points "
        "to the target.",
    ),
    Mistake(
        "centroid not turned",
        centroid_not_turned,
        "Your rotation is right, your translation is not: the source's centroid turns too, t = mean_target - R mean_source.",
    ),
    Mistake(
        "not centred",
        not_centred,
        "You built the covariance from points that are not centred. Subtract each cloud's centroid first.",
    ),
    Mistake(
        "principal axes",
        principal_axes,
        "You laid the principal axes over each other. Their signs are open, so you may be half a turn off with a small "
        "residual. The rows are pairs: use them.",
    ),
    Mistake(
        "scaled",
        scaled,
        "You fitted a scale as well. A rigid motion has none: R alone, with determinant 1.",
    ),
)


def align_by_svd(p_target: np.ndarray, p_source: np.ndarray) -> np.ndarray:
    """Kabsch with source on the left: R = V diag(1, 1, d) U^T."""
    if len(p_source) == 0:
        raise ValueError("no pairs")
    centre_target, centre_source = np.mean(p_target, axis=0), np.mean(p_source, axis=0)
    U, _, Vt = np.linalg.svd((p_source - centre_source).T @ (p_target - centre_target))
    d = np.sign(np.linalg.det(Vt.T @ U.T))
    T = np.eye(4)
    T[:3, :3] = Vt.T @ np.diag([1.0, 1.0, d]) @ U.T
    T[:3, 3] = centre_target - T[:3, :3] @ centre_source
    return T


def align_by_quaternion(p_target: np.ndarray, p_source: np.ndarray) -> np.ndarray:
    """Horn's unit quaternion: the eigenvector of the largest eigenvalue."""
    if not len(p_source):
        raise ValueError("no pairs")
    a, b = p_source - p_source.mean(0), p_target - p_target.mean(0)
    M = a.T @ b
    v = np.array([M[1, 2] - M[2, 1], M[2, 0] - M[0, 2], M[0, 1] - M[1, 0]])
    N = np.zeros((4, 4))
    N[0, 0], N[0, 1:], N[1:, 0] = np.trace(M), v, v
    N[1:, 1:] = M + M.T - np.trace(M) * np.eye(3)
    w, x, y, z = np.linalg.eigh(N)[1][:, -1]
    R = np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )
    T = np.eye(4)
    T[:3, :3], T[:3, 3] = R, p_target.mean(0) - R @ p_source.mean(0)
    return T


# match ----------------------------------------------------------------------------------------------------------------


def matched_backwards(p_target: np.ndarray, p_source: np.ndarray) -> np.ndarray:
    """Finds the source point nearest to each target point."""
    return nearest(p_source, p_target)


def paired_by_row(p_target: np.ndarray, p_source: np.ndarray) -> np.ndarray:
    """Pairs points with the same row number."""
    return np.arange(len(p_source)) % len(p_target)


def one_to_one(p_target: np.ndarray, p_source: np.ndarray) -> np.ndarray:
    """Gives every target point away once, first come first served, as long as there are any."""
    distances = np.linalg.norm(p_source[:, None] - p_target, axis=2)
    indices = np.empty(len(p_source), dtype=int)
    for k, row in enumerate(distances):
        indices[k] = np.argmin(row) if np.isfinite(row).any() else k % len(p_target)
        distances[:, indices[k]] = np.inf
    return indices


def height_ignored(p_target: np.ndarray, p_source: np.ndarray) -> np.ndarray:
    """Compares x and y only."""
    return np.argmin(np.linalg.norm(p_source[:, None, :2] - p_target[:, :2], axis=2), axis=1)


def manhattan(p_target: np.ndarray, p_source: np.ndarray) -> np.ndarray:
    """Sums absolute differences."""
    return np.argmin(np.abs(p_source[:, None] - p_target).sum(axis=2), axis=1)


def farthest(p_target: np.ndarray, p_source: np.ndarray) -> np.ndarray:
    """Takes the largest distance."""
    return np.argmax(np.linalg.norm(p_source[:, None] - p_target, axis=2), axis=1)


def squares_expanded(p_target: np.ndarray, p_source: np.ndarray) -> np.ndarray:
    """Uses |a|^2 + |b|^2 - 2 a b, where far from the origin all digits cancel."""
    squares = (p_source**2).sum(1)[:, None] + (p_target**2).sum(1) - 2 * p_source @ p_target.T
    return np.argmin(squares, axis=1)


def distances_returned(p_target: np.ndarray, p_source: np.ndarray) -> np.ndarray:
    """Returns how far, not which."""
    return np.linalg.norm(p_target[nearest(p_target, p_source)] - p_source, axis=1)


MATCH_MISTAKES = (
    Mistake(
        "matched backwards",
        matched_backwards,
        "You returned the nearest source point of each target point. Nearest neighbour is not symmetric: it must be one "
        "target index for each source point.",
    ),
    Mistake(
        "paired by row",
        paired_by_row,
        "You paired points with the same row number. The rows of two scans have nothing to do with each other: compare "
        "distances.",
    ),
    Mistake(
        "one to one",
        one_to_one,
        "You give every target point away only once. In ICP several source points may share a partner: each takes its "
        "nearest, on its own.",
    ),
    Mistake("height ignored", height_ignored, "You compare x and y only. The distance is in space: z counts too."),
    Mistake(
        "Manhattan distance",
        manhattan,
        "You sum absolute differences. That is the Manhattan distance; sum their squares for the Euclidean one.",
    ),
    Mistake("farthest", farthest, "You return the farthest target points: argmax where argmin belongs."),
    Mistake(
        "squares expanded",
        squares_expanded,
        "You use |a|^2 + |b|^2 - 2 a·b. Far from the origin these cancel and leave no digits: subtract the points first.",
    ),
    Mistake(
        "distances returned",
        distances_returned,
        "You returned the distances. Return which target point it is: indices, whole numbers.",
    ),
)


def match_all_at_once(p_target: np.ndarray, p_source: np.ndarray) -> np.ndarray:
    """Compares every pair in one array."""
    squares = np.sum((p_source[:, None, :] - p_target[None, :, :]) ** 2, axis=2)
    return np.asarray(np.argmin(squares, axis=1))


def match_one_by_one(p_target: np.ndarray, p_source: np.ndarray) -> list[int]:
    """Loops over the source."""
    return [int(np.argmin(np.linalg.norm(p_target - p, axis=1))) for p in p_source]


def match_with_a_tree(p_target: np.ndarray, p_source: np.ndarray) -> np.ndarray:
    """Asks a k-d tree."""
    from scipy.spatial import cKDTree

    if len(p_target) == 0:
        raise ValueError("no target")
    return np.asarray(cKDTree(p_target).query(p_source)[1])


# point_to_plane_step --------------------------------------------------------------------------------------------------


def linear(p_source: np.ndarray, n_target: np.ndarray, gap: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return (w, v) of least squares, w about the origin."""
    A = np.hstack([np.cross(p_source, n_target), n_target])
    x = np.linalg.lstsq(A, gap, rcond=1e-9)[0]
    return x[:3], x[3:]


def gaps(p_target: np.ndarray, p_source: np.ndarray, n_target: np.ndarray) -> np.ndarray:
    """Return the signed distances that are left along the normals."""
    return np.sum((p_target - p_source) * n_target, axis=1)


def sign_of_the_gap(p_target: np.ndarray, p_source: np.ndarray, n_target: np.ndarray) -> np.ndarray:
    """Moves away from the planes."""
    w, v = linear(p_source, n_target, -gaps(p_target, p_source, n_target))
    return motion(exp_so3(w), v)


def cross_turned_round(p_target: np.ndarray, p_source: np.ndarray, n_target: np.ndarray) -> np.ndarray:
    """Uses n x p for p x n."""
    w, v = linear(p_source, n_target, gaps(p_target, p_source, n_target))
    return motion(exp_so3(-w), v)


def point_to_point(p_target: np.ndarray, p_source: np.ndarray, n_target: np.ndarray) -> np.ndarray:
    """Does not use the normals."""
    return alignment.align_rigid(p_target, p_source)


def no_proper_rotation(p_target: np.ndarray, p_source: np.ndarray, n_target: np.ndarray) -> np.ndarray:
    """Returns I + [w]x."""
    w, v = linear(p_source, n_target, gaps(p_target, p_source, n_target))
    return motion(np.eye(3) + skew(w), v)


def translation_only(p_target: np.ndarray, p_source: np.ndarray, n_target: np.ndarray) -> np.ndarray:
    """Leaves the rotation out."""
    v = np.linalg.lstsq(n_target, gaps(p_target, p_source, n_target), rcond=1e-9)[0]
    return motion(np.eye(3), v)


def singular(p_target: np.ndarray, p_source: np.ndarray, n_target: np.ndarray) -> np.ndarray:
    """Solves the normal equations as if the planes held everything."""
    A = np.hstack([np.cross(p_source, n_target), n_target])
    x = np.linalg.solve(A.T @ A, A.T @ gaps(p_target, p_source, n_target))
    return motion(exp_so3(x[:3]), x[3:])


def translation_of_the_centred(p_target: np.ndarray, p_source: np.ndarray, n_target: np.ndarray) -> np.ndarray:
    """Turns about the centroid and forgets to say so in t."""
    w, v = linear(p_source - p_source.mean(0), n_target, gaps(p_target, p_source, n_target))
    return motion(exp_so3(w), v)


STEP_MISTAKES = (
    Mistake(
        "sign of the gap",
        sign_of_the_gap,
        "Your step goes away from the planes: the right side has the wrong sign. It is (p_target - p_source) · n.",
    ),
    Mistake(
        "cross product turned round",
        cross_turned_round,
        "Your translation is right and your rotation turns backwards. (w x p) · n = w · (p x n): p x n, not n x p.",
    ),
    Mistake(
        "point to point",
        point_to_point,
        "You aligned the points themselves. Only the distance along the normal counts: sliding along a plane costs nothing.",
    ),
    Mistake(
        "no proper rotation",
        no_proper_rotation,
        "You returned I + [w]x, which stretches the cloud at every step. Return the rotation by |w| about w.",
    ),
    Mistake(
        "translation only",
        translation_only,
        "You left the rotation out. There are six unknowns: three of rotation, w, and three of translation, v.",
    ),
    Mistake(
        "singular",
        singular,
        "All is right but where the planes leave a direction open: your 6×6 system is singular there. Use least squares "
        "with the smallest norm (np.linalg.lstsq).",
    ),
    Mistake(
        "centroid forgotten",
        translation_of_the_centred,
        "You turn about the centroid, but your motion turns about the origin. Add c - R c to the translation.",
    ),
)


def step_about_the_origin(p_target: np.ndarray, p_source: np.ndarray, n_target: np.ndarray) -> np.ndarray:
    """Low's product of three turns, about the origin."""
    A = np.hstack([np.cross(p_source, n_target), n_target])
    a, b, c, *v = np.linalg.lstsq(A, gaps(p_target, p_source, n_target), rcond=1e-9)[0]
    Rx = np.array([[1, 0, 0], [0, np.cos(a), -np.sin(a)], [0, np.sin(a), np.cos(a)]])
    Ry = np.array([[np.cos(b), 0, np.sin(b)], [0, 1, 0], [-np.sin(b), 0, np.cos(b)]])
    Rz = np.array([[np.cos(c), -np.sin(c), 0], [np.sin(c), np.cos(c), 0], [0, 0, 1]])
    T = np.eye(4)
    T[:3, :3], T[:3, 3] = Rz @ Ry @ Rx, v
    return T


def step_by_pseudo_inverse(p_target: np.ndarray, p_source: np.ndarray, n_target: np.ndarray) -> np.ndarray:
    """Normal equations about the centroid, pseudo-inverse, and the rotation from the SVD of I + [w]x."""
    c = p_source.mean(axis=0)
    A = np.hstack([np.cross(p_source - c, n_target), n_target])
    x = np.linalg.pinv(A.T @ A, rcond=1e-10, hermitian=True) @ (A.T @ gaps(p_target, p_source, n_target))
    W = np.array([[1, -x[2], x[1]], [x[2], 1, -x[0]], [-x[1], x[0], 1]])
    U, _, Vt = np.linalg.svd(W)
    T = np.eye(4)
    T[:3, :3] = U @ Vt
    T[:3, 3] = c + x[3:] - U @ Vt @ c
    return T
