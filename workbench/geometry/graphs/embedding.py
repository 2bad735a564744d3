"""Places for things of which only the distances are known: classical scaling, stress layouts.

Reference: Borg and Groenen, Modern multidimensional scaling, 2nd ed., 2005, chapters 8 and 12.
"""

import numpy as np
from jaxtyping import Float


def classical_scaling(
    distances: Float[np.ndarray, "n n"], dims: int
) -> Float[np.ndarray, "n {dims}"]:
    """Return points about the origin whose distances fit best in the sense of inner products.

    Axes come by falling variance; each has its entry of largest size positive (section 12.1).
    """
    squares = distances**2
    centred = squares - squares.mean(axis=0) - squares.mean(axis=1)[:, None] + squares.mean()
    values, vectors = np.linalg.eigh(-centred / 2)
    points = vectors[:, ::-1][:, :dims] * np.sqrt(np.maximum(values[::-1][:dims], 0.0))
    out = np.zeros((len(distances), dims))
    largest = np.abs(points).argmax(axis=0)
    out[:, : points.shape[1]] = points * np.where(
        points[largest, np.arange(points.shape[1])] < 0, -1.0, 1.0
    )
    return out


def stress_layout(
    distances: Float[np.ndarray, "n n"], dims: int, iterations: int = 60
) -> Float[np.ndarray, "n {dims}"]:
    """Return points that lower the stress sum_ij (|p_i - p_j| - d_ij)^2, from classical scaling on.

    Reference: Borg and Groenen 2005, section 8.6 (SMACOF), all weights being 1.
    """
    p = classical_scaling(distances, dims)
    n = len(distances)
    # Nodes at one place would stay there
    p = p + 1e-3 * np.sin(np.arange(1.0, p.size + 1.0) ** 2).reshape(p.shape)
    for _ in range(iterations):
        apart = np.linalg.norm(p[:, None] - p, axis=2)
        ratio = np.divide(distances, apart, out=np.zeros((n, n)), where=apart > 0)
        p = (ratio.sum(axis=1)[:, None] * p - ratio @ p) / n  # (8.28): the Guttman transform
    return p
