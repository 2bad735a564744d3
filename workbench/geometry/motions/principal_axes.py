"""The frame that a cloud carries: its centroid and principal axes, and rules for their signs.

Axes are the columns of a 3x3 matrix, the direction of the largest variance first; right-handed
unless said otherwise.
"""

import numpy as np
from jaxtyping import Float

from workbench.geometry.motions.alignment import chunks

Cloud = Float[np.ndarray, "n 3"]
Axes = Float[np.ndarray, "3 3"]


def centroid_and_covariance(p: Cloud) -> tuple[Float[np.ndarray, "3"], Float[np.ndarray, "3 3"]]:
    """Return the mean of points and their covariance about it, (1/n) sum (p - m)(p - m)^T, m^2.

    Moments are taken about the first point, or they would lose all digits far from the origin.
    Reference: Chan, Golub and LeVeque, Algorithms for computing the sample variance, 1983.

    Raises:
        ValueError: If there is no point, or a number is not finite.

    Examples:
        >>> centroid_and_covariance(np.array([[1.0, 0, 0], [3, 0, 0]]))[1].diagonal().tolist()
        [1.0, 0.0, 0.0]
    """
    if len(p) == 0:
        raise ValueError("a cloud without points has no centroid")
    first = p[0]
    ones = np.ones(min(len(p), 8192))
    products = np.zeros(9)
    for rows in chunks(len(p)):
        x, y, z = (np.subtract(p[rows, k], first[k]) for k in range(3))
        unit = ones[: len(x)]
        products += [x @ unit, y @ unit, z @ unit, x @ x, x @ y, x @ z, y @ y, y @ z, z @ z]
    mean, second = products[:3] / len(p), products[3:] / len(p)
    covariance = second[[[0, 1, 2], [1, 3, 4], [2, 4, 5]]] - np.outer(mean, mean)
    if not np.isfinite(covariance).all():
        raise ValueError("a point is not a finite number")
    return first + mean, covariance


def principal_axes(p: Cloud) -> Axes:
    """Return the directions of largest, middle and least variance as columns of a rotation.

    Any two columns may be turned round. Equal variances leave their directions open too.
    Reference: Pearson, On lines and planes of closest fit, 1901; Jolliffe, Principal Component
    Analysis, 1.1.
    """
    return ordered(*np.linalg.eigh(centroid_and_covariance(p)[1]))[1]


def ordered(variances: Float[np.ndarray, "3"], axes: Axes) -> tuple[Float[np.ndarray, "3"], Axes]:
    """Return variances and axes from largest to least, the third turned so that det = +1."""
    falling = np.argsort(-variances, kind="stable")
    return variances[falling], right_handed(axes[:, falling])


def right_handed(axes: Axes) -> Axes:
    """Return the axes with the third one as the cross product of the first two."""
    return np.column_stack([axes[:, 0], axes[:, 1], np.cross(axes[:, 0], axes[:, 1])])


def right_handed_frames(axes: Axes) -> Float[np.ndarray, "k 3 3"]:
    """Return every right-handed frame that has these axes: each choice of signs with det = +1."""
    signs = [(a, b, c) for a in (1, -1) for b in (1, -1) for c in (1, -1)]
    frames = [axes * sign for sign in signs]
    return np.stack([frame for frame in frames if np.linalg.det(frame) > 0])


def third_moments(axes: Axes, p: Cloud) -> Float[np.ndarray, "3"]:
    """Return the mean cubed coordinates along each axis, m^3, which tell an axis' ends apart."""
    along = (p - p.mean(axis=0)) @ axes
    return np.einsum("ij,ij,ij->j", along, along, along) / len(p)


def canonical_signs(axes: Axes, p: Cloud) -> Axes:
    """Return the axes with signs that turn with the cloud: third moments of axes 1 and 2 >= 0.

    Reference: Bro, Acar and Kolda, Resolving the sign ambiguity in the SVD, 2008, with other sums.
    """
    return right_handed(axes * np.where(third_moments(axes, p) < 0, -1.0, 1.0))


def largest_entry_signs(axes: Axes) -> Axes:
    """Return the axes with the largest entry of 1 and 2 positive, as scikit-learn's svd_flip.

    It looks at coordinates, not at the cloud: signs change as soon as the cloud was turned.
    """
    largest = np.abs(axes).argmax(axis=0)
    return right_handed(axes * np.where(axes[largest, np.arange(3)] < 0, -1.0, 1.0))


def degrees_between_axes(axes: Axes, other: Axes) -> Float[np.ndarray, "3"]:
    """Return the angle between each axis and its namesake, without signs, degrees in [0, 90]."""
    across = np.linalg.norm(np.cross(axes, other, axis=0), axis=0)
    return np.degrees(np.arctan2(across, np.abs(np.einsum("ij,ij->j", axes, other))))
