"""Where a field on a grid has a value: lines in the plane, and the surface where it is zero.

Reference: Lorensen and Cline, Marching cubes, SIGGRAPH 1987; `fields.marching` is the method.
"""

from collections.abc import Callable

import numpy as np
from jaxtyping import Float, Int

from workbench.geometry.fields.marching import marching_cubes, marching_squares
from workbench.geometry.fields.voxels import Grid

EdgeCrossings = Callable[[np.ndarray, np.ndarray, np.ndarray, np.ndarray], np.ndarray]
"""edge_crossings(p_a, p_b, f_a, f_b) -> where the field is zero on each edge."""


def edge_crossings(  # noqa: PLR0917
    p_a: Float[np.ndarray, "n 3"],
    p_b: Float[np.ndarray, "n 3"],
    f_a: Float[np.ndarray, " n"],
    f_b: Float[np.ndarray, " n"],
) -> Float[np.ndarray, "n 3"]:
    """Return where a field that is linear along each edge is zero; the middle if it is all zero.

    Examples:
        >>> edge_crossings(
        ...     np.zeros((1, 3)), np.ones((1, 3)), np.array([-1.0]), np.array([3.0])
        ... ).tolist()
        [[0.25, 0.25, 0.25]]
    """
    apart = f_a - f_b
    t = np.where(apart == 0, 0.5, f_a / np.where(apart == 0, 1.0, apart))
    return p_a + t[:, None] * (p_b - p_a)


def level_lines(
    values: Float[np.ndarray, "y x"],
    levels: Float[np.ndarray, " k"],
    low_corner: Float[np.ndarray, "2"],
    *,
    spacing: float,
) -> Float[np.ndarray, "n 2 2"]:
    """Return the segments along which a field has one of some values; it has a row for each y from
    `low_corner`.

    Examples:
        >>> values = np.array([[0.0, 1.0], [0.0, 1.0]])
        >>> level_lines(values, np.array([0.25]), np.zeros(2), spacing=1.0).tolist()
        [[[0.25, 0.0], [0.25, 1.0]]]
    """
    ends = [np.empty((0, 2, 2))]
    for level in levels:
        low, high, segments = marching_squares(values > level)
        f_low = values[tuple(low.T)]
        along = (level - f_low) / (values[tuple(high.T)] - f_low)
        ends.append((low + along[:, None] * (high - low))[segments])
    return low_corner + spacing * np.concatenate(ends)[..., ::-1]


def level_surface(
    values: Float[np.ndarray, "x y z"], grid: Grid, edge_crossings: EdgeCrossings = edge_crossings
) -> tuple[Float[np.ndarray, "v 3"], Int[np.ndarray, "f 3"]]:
    """Return the surface where a field is zero, its faces outwards: towards positive values.

    Values stand at the cells' middles. Both arrays are empty where the field has one sign or the
    grid is one cell thin. `edge_crossings` places the vertices on all edges at once.
    """
    if min(values.shape) < 2 or not values.min() < 0 <= values.max():
        return np.empty((0, 3)), np.empty((0, 3), dtype=np.intp)
    below, above, faces = marching_cubes(values < 0)
    start = grid.low + grid.spacing / 2
    f_below = values[tuple(below.T)].astype(float)
    f_above = values[tuple(above.T)].astype(float)
    p = edge_crossings(start + grid.spacing * below, start + grid.spacing * above, f_below, f_above)
    return p, faces
