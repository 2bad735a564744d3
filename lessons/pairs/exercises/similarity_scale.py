"""Write the scale between two scans whose points are paired. The last step by pairs takes it from
your function, there and back: see the presets 'Noise in both scans' and 'A mirror image'.
"""

import numpy as np
from jaxtyping import Float

from lessons.pairs.exercises import STUDENTS
from workbench.data.lopsided import a_lopsided_cloud, a_rotation
from workbench.exercise import (
    Function,
    Verdict,
    against,
    alternative,
    band,
    check,
    contract,
    left_alone,
    mistake,
    worst,
)
from workbench.geometry.motions import alignment


@contract(
    slot="similarity_scale",
    examples=(
        (
            (
                "similarity_scale(np.array([[0.0, 0, 0], [3, 0, 0], [0, 6, 0]]), np.array([[0.0, 0,"
                " 0], [1, 0, 0], [0, 2, 0]]))"
            ),
            "3",
        ),
        (
            (
                "similarity_scale(np.array([[4.0, 0, 0], [5, 0, 0], [4, 1, 0]]), np.array([[1.0, 1,"
                " 1], [1, 1, 1], [1, 1, 1]]))"
            ),
            "1",
        ),
    ),
)
def similarity_scale(
    p_target: Float[np.ndarray, "n 3"], p_source: Float[np.ndarray, "n 3"]
) -> float:
    """Return the scale s of the similarity p_target = s R p_source + t that leaves the least sum of
    squared distances.

    R is a rotation (determinant +1), also where a mirror image would fit better, and s, R and t are
    the best together.

    Args:
        p_target: Points in the target frame, metres.
        p_source: Their partners in the source frame, metres: row k belongs to row k.

    Returns:
        How many times as large the target is. Noise in the source makes it too small; that is so,
        leave it. Source points that all coincide say nothing about scale: 1 then.

    Raises:
        ValueError: If there are no pairs (n = 0).
    """
    return alignment.similarity_scale(p_target, p_source)


SCALE_HINT = (
    "s = tr(D S) / variance of the source (Umeyama, eq. 42), with S = diag(1, 1, det U det V)."
)


def scale_verdict(
    candidate: Function, p_target: np.ndarray, p_source: np.ndarray, hint: str = SCALE_HINT
) -> Verdict:
    """Judge a scale in per cent of the least-squares one."""
    right = alignment.similarity_scale(p_target, p_source)
    got = candidate(p_target, p_source)
    comparison = f"Scale {against(got, right, 5)}. {hint}"
    return band(
        "The scale is off by", 100 * abs(got / right - 1), "%", good=0.01, fair=0.2, hint=comparison
    )


def pairs(
    seed: int, scale: float, noise: float = 0.0, mirror: bool = False, n: int = 60
) -> tuple[np.ndarray, np.ndarray]:
    """Return target and source: turned, shifted, scaled, with noise in both."""
    rng = np.random.default_rng(seed)
    p = a_lopsided_cloud(rng, n)
    q = p * [1.0, 1.0, -1.0 if mirror else 1.0]
    target = scale * p @ a_rotation(rng).T + rng.uniform(-2.0, 2.0, 3)
    return target + noise * rng.normal(size=p.shape), q + noise * rng.normal(size=p.shape)


@check(2)
def exact_pairs(candidate: Function) -> Verdict:
    """Exact pairs of scale 0.4, 1 and 2.5 tell their scale."""
    return worst(
        scale_verdict(candidate, *pairs(STUDENTS + k, scale))
        for k, scale in enumerate((0.4, 1.0, 2.5))
    )


@check(2)
def noisy_pairs(candidate: Function) -> Verdict:
    """With 10 cm of noise in both scans it is the least-squares scale, there and back."""
    verdicts = []
    for k, scale in enumerate((0.7, 1.5)):
        p_target, p_source = pairs(STUDENTS + 10 + k, scale, 0.1)
        verdicts += [
            scale_verdict(candidate, p_target, p_source),
            scale_verdict(candidate, p_source, p_target),
        ]
    return worst(verdicts)


@check(1)
def pairs_are_left_alone(candidate: Function) -> Verdict:
    """The clouds that come in are not changed."""
    p_target, p_source = pairs(STUDENTS + 20, 1.3, 0.02)
    return left_alone(candidate, scale_verdict(candidate, p_target, p_source))


def centred(p_target: np.ndarray, p_source: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return both clouds about their centroids; they must have points."""
    if len(p_source) == 0:
        raise ValueError("no pairs")
    return p_target - p_target.mean(axis=0), p_source - p_source.mean(axis=0)


@mistake(
    "You returned the ratio of the clouds' sizes. It agrees for exact pairs only: noise swells"
    " both. Least squares takes the singular values of the cross-covariance."
)
def ratio_of_sizes(p_target: np.ndarray, p_source: np.ndarray) -> float:
    """Divides root mean square radii."""
    a, b = centred(p_target, p_source)
    return float(np.sqrt((a**2).sum() / (b**2).sum())) if b.any() else 1.0


@mistake(
    "You add up all singular values. Where the SVD gives a mirror image (determinant −1) the least"
    " one counts negative: tr(D S), not tr(D)."
)
def mirror_counted_in(p_target: np.ndarray, p_source: np.ndarray) -> float:
    """Takes the trace without the sign."""
    a, b = centred(p_target, p_source)
    return float(np.linalg.svd(a.T @ b)[1].sum() / (b**2).sum()) if b.any() else 1.0


@mistake(
    "You divide by the variance of the target: that is the scale from target to source. Divide by"
    " the source's, which is what s is multiplied with."
)
def target_to_source(p_target: np.ndarray, p_source: np.ndarray) -> float:
    """Returns the scale that goes back."""
    centred(p_target, p_source)
    return alignment.similarity_scale(p_source, p_target)


@mistake(
    "Your scale is one over the right one. s is multiplied with the source, so it is large where"
    " the target is large."
)
def upside_down(p_target: np.ndarray, p_source: np.ndarray) -> float:
    """Returns 1 / s."""
    return 1.0 / alignment.similarity_scale(p_target, p_source)


@mistake(
    "You did not subtract the centroids: about the origin the shift between the scans counts as"
    " size."
)
def not_centred(p_target: np.ndarray, p_source: np.ndarray) -> float:
    """Takes moments about the origin."""
    if len(p_source) == 0:
        raise ValueError("no pairs")
    U, D, Vt = np.linalg.svd(p_target.T @ p_source)
    D[2] *= np.sign(np.linalg.det(U) * np.linalg.det(Vt))
    return float(D.sum() / (p_source**2).sum()) if p_source.any() else 1.0


@mistake(
    "You take the trace of the cross-covariance without the rotation, tr(H). The clouds are turned:"
    " it is tr(D S)."
)
def without_the_rotation(p_target: np.ndarray, p_source: np.ndarray) -> float:
    """Projects without turning."""
    a, b = centred(p_target, p_source)
    return float((a * b).sum() / (b**2).sum()) if b.any() else 1.0


@mistake(
    "You divide only one of the two sums by the number of pairs. Both or none: the number cancels."
)
def divided_once(p_target: np.ndarray, p_source: np.ndarray) -> float:
    """Takes the mean above and the sum below."""
    centred(p_target, p_source)
    return (
        alignment.similarity_scale(p_target, p_source) / len(p_source)
        if np.ptp(p_source, axis=0).any()
        else 1.0
    )


@alternative
def scale_by_quaternion(p_target: np.ndarray, p_source: np.ndarray) -> float:
    """Horn: the largest eigenvalue of the quaternion matrix is tr(D S)."""
    if not len(p_target):
        raise ValueError("at least one pair is needed")
    a, b = p_target - p_target.mean(0), p_source - p_source.mean(0)
    if (b**2).sum() < 1e-24:
        return 1.0
    M = b.T @ a
    v = np.array([M[1, 2] - M[2, 1], M[2, 0] - M[0, 2], M[0, 1] - M[1, 0]])
    N = np.zeros((4, 4))
    N[0, 0] = np.trace(M)
    N[0, 1:] = v
    N[1:, 0] = v
    N[1:, 1:] = M + M.T - np.trace(M) * np.eye(3)
    return float(np.linalg.eigvalsh(N)[-1] / (b**2).sum())


@alternative
def scale_by_rotation(p_target: np.ndarray, p_source: np.ndarray) -> float:
    """Finds R first, and projects the target onto the turned source."""
    a, b = centred(p_target, p_source)
    if np.allclose(b, 0.0, atol=1e-12):
        return 1.0
    U, _, Vt = np.linalg.svd(b.T @ a)
    R = Vt.T @ np.diag([1.0, 1.0, np.sign(np.linalg.det(Vt.T @ U.T))]) @ U.T
    return float(np.sum(a * (b @ R.T)) / np.sum(b * b))
