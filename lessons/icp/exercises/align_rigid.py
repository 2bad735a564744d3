"""Write the rigid alignment of paired points (Kabsch), with the mirror image ruled out. The
lesson's fit steps are made by it; it is judged in degrees and metres, never by its residual.
"""

import numpy as np
from jaxtyping import Float

from lessons.icp.exercises import STUDENTS, a_motion
from workbench.exercise import (
    Function,
    Verdict,
    alternative,
    check,
    contract,
    left_alone,
    mistake,
    motion_verdict,
    worst,
)
from workbench.geometry.motions import alignment, apply, exp_so3, inverse, motion


@contract(
    slot="align",
    forbid=("scipy.spatial.transform",),
    examples=(
        (
            (
                "align_rigid(np.array([[2.0, 0, 0], [3, 0, 0], [2, 1, 0]]), np.array([[0.0, 0, 0],"
                " [1, 0, 0], [0, 1, 0]]))"
            ),
            "[[1, 0, 0, 2], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]",
        ),
        (
            (
                "align_rigid(np.array([[0.0, 0, 0], [0, 1, 0], [-1, 0, 0]]), np.array([[0.0, 0, 0],"
                " [1, 0, 0], [0, 1, 0]]))"
            ),
            "[[0, -1, 0, 0], [1, 0, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]",
        ),
    ),
)
def align_rigid(
    p_target: Float[np.ndarray, "n 3"], p_source: Float[np.ndarray, "n 3"]
) -> Float[np.ndarray, "4 4"]:
    """Return the rigid motion T_target_source that brings paired points closest together.

    It minimises the sum of the squared distances |p_target - (R p_source + t)| over all rotations R
    and translations t.

    Args:
        p_target: Points in the target frame, metres.
        p_source: Their partners in the source frame, metres: row k belongs to row k.

    Returns:
        The 4x4 motion with R in the upper left, t in the last column and (0, 0, 0, 1) as last row.
        R is always a rotation with determinant 1, also where a mirror image would fit better: flat
        clouds with noise, mirrored clouds. Points on one line, or a single pair, leave a part of
        the turn open; any one of the best motions is right then.

    Raises:
        ValueError: If there are no pairs (n = 0).
    """
    return alignment.align_rigid(p_target, p_source)


ALIGN_HINT = (
    "Centre both clouds, take the SVD of their covariance, and see which way round R belongs."
)


def a_cloud(rng: np.random.Generator, n: int = 60) -> np.ndarray:
    """Return points of a lump half a metre in size, aside from the origin."""
    return rng.normal(size=(n, 3)) * [0.5, 0.3, 0.2] + [0.4, -0.7, 0.3]


def aligned(
    candidate: Function, p_target: np.ndarray, p_source: np.ndarray, hint: str = ALIGN_HINT
) -> Verdict:
    """Judge by the least-squares motion: in degrees, and in metres at the points."""
    return motion_verdict(
        candidate(p_target, p_source), alignment.align_rigid(p_target, p_source), hint, p=p_source
    )


@check(2)
def exact_pairs(candidate: Function) -> Verdict:
    """Exact pairs 20, 60 and 120 degrees apart are brought together."""
    verdicts = []
    for k, degrees in enumerate((20.0, 60.0, 120.0)):
        rng = np.random.default_rng(STUDENTS + k)
        T = a_motion(rng, degrees)
        p_source = a_cloud(rng)
        got = candidate(apply(T, p_source), p_source)
        verdicts.append(
            motion_verdict(got, T, f"{degrees:g} degrees apart. {ALIGN_HINT}", p=p_source)
        )
    return worst(verdicts)


@check(2)
def turned_rod(candidate: Function) -> Verdict:
    """A rod turned by up to 170 degrees is turned back, though its ends look alike: half a turn
    leaves a small residual.
    """
    rng = np.random.default_rng(STUDENTS + 5)
    verdicts = []
    for degrees in (170.0, 120.0, -170.0):
        p_source = rng.normal(size=(80, 3)) * [0.6, 0.012, 0.01]
        T = motion(
            exp_so3(np.radians(degrees) * np.array([0.0, 0.6, 0.8])), np.array([0.2, 0.1, -0.3])
        )
        verdicts.append(
            motion_verdict(candidate(apply(T, p_source), p_source), T, ALIGN_HINT, p=p_source)
        )
    return worst(verdicts)


@check(1)
def pairs_are_left_alone(candidate: Function) -> Verdict:
    """The clouds that come in are not changed."""
    rng = np.random.default_rng(STUDENTS + 6)
    p_source = a_cloud(rng)
    return left_alone(candidate, aligned(candidate, apply(a_motion(rng, 50.0), p_source), p_source))


@mistake(
    "You moved the centroids onto each other and did not rotate. Find R from the covariance of the"
    " centred pairs."
)
def centroids_only(p_target: np.ndarray, p_source: np.ndarray) -> np.ndarray:
    """Matches the centroids and does not rotate."""
    return motion(np.eye(3), p_target.mean(0) - p_source.mean(0))


@mistake(
    "Your R equals the transpose of the right one. From the SVD U D V^T of sum(target source^T) it"
    " is U V^T, from that of sum(source target^T) it is V U^T."
)
def rotation_transposed(p_target: np.ndarray, p_source: np.ndarray) -> np.ndarray:
    """Uses R^T, with the translation that goes with it."""
    R = alignment.align_rigid(p_target, p_source)[:3, :3].T
    return motion(R, p_target.mean(0) - R @ p_source.mean(0))


@mistake(
    "Your R is right but where it is a mirror image (determinant -1), as on flat, noisy clouds."
    " Flip the direction with the smallest singular value then."
)
def reflection_kept(p_target: np.ndarray, p_source: np.ndarray) -> np.ndarray:
    """Leaves the determinant as it comes from the SVD."""
    U, _, Vt = np.linalg.svd((p_target - p_target.mean(0)).T @ (p_source - p_source.mean(0)))
    return motion(U @ Vt, p_target.mean(0) - U @ Vt @ p_source.mean(0))


@mistake(
    "Where the SVD gives a mirror image you negate all of R. Only the direction with the smallest"
    " singular value changes its sign: it costs least."
)
def whole_matrix_negated(p_target: np.ndarray, p_source: np.ndarray) -> np.ndarray:
    """Negates R where its determinant is -1."""
    T = reflection_kept(p_target, p_source)
    R = T[:3, :3] * np.sign(np.linalg.det(T[:3, :3]))
    return motion(R, p_target.mean(0) - R @ p_source.mean(0))


@mistake(
    "You returned the motion from target to source: the inverse of the right one. T_target_source"
    " takes source points to the target."
)
def target_to_source(p_target: np.ndarray, p_source: np.ndarray) -> np.ndarray:
    """Returns T_source_target."""
    return inverse(alignment.align_rigid(p_target, p_source))


@mistake(
    "Your rotation is right, your translation is not: the source's centroid turns too, t ="
    " mean_target - R mean_source."
)
def centroid_not_turned(p_target: np.ndarray, p_source: np.ndarray) -> np.ndarray:
    """Uses t = mean_target - mean_source with any R."""
    T = alignment.align_rigid(p_target, p_source)
    return motion(T[:3, :3], p_target.mean(0) - p_source.mean(0))


@mistake(
    "You built the covariance from points that are not centred. Subtract each cloud's centroid"
    " first."
)
def not_centred(p_target: np.ndarray, p_source: np.ndarray) -> np.ndarray:
    """Takes the products of the points themselves."""
    R = alignment.nearest_rotation(p_target.T @ p_source)
    return motion(R, p_target.mean(0) - R @ p_source.mean(0))


@mistake(
    "You laid the principal axes over each other. Their signs are open, so you may be half a turn"
    " off with a small residual. The rows are pairs: use them."
)
def principal_axes(p_target: np.ndarray, p_source: np.ndarray) -> np.ndarray:
    """Lays the principal axes over each other, whose signs nobody knows."""
    centred = (p - p.mean(0) for p in (p_target, p_source))
    axes_target, axes_source = (np.linalg.eigh(p.T @ p)[1] for p in centred)
    axes_target, axes_source = (
        axes * [1, 1, np.sign(np.linalg.det(axes))] for axes in (axes_target, axes_source)
    )
    R = axes_target @ axes_source.T
    return motion(R, p_target.mean(0) - R @ p_source.mean(0))


@mistake("You fitted a scale as well. A rigid motion has none: R alone, with determinant 1.")
def scaled(p_target: np.ndarray, p_source: np.ndarray) -> np.ndarray:
    """Fits a scale as well."""
    return alignment.align_similarity(p_target, p_source)


@alternative
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


@alternative
def align_by_quaternion(p_target: np.ndarray, p_source: np.ndarray) -> np.ndarray:
    """Horn's unit quaternion: the eigenvector of the largest eigenvalue."""
    if not len(p_source):
        raise ValueError("no pairs")
    a, b = p_source - p_source.mean(0), p_target - p_target.mean(0)
    M = a.T @ b
    v = np.array([M[1, 2] - M[2, 1], M[2, 0] - M[0, 2], M[0, 1] - M[1, 0]])
    N = np.zeros((4, 4))
    N[0, 0] = np.trace(M)
    N[0, 1:] = v
    N[1:, 0] = v
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
    T[:3, :3] = R
    T[:3, 3] = p_target.mean(0) - R @ p_source.mean(0)
    return T
