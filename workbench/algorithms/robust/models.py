"""What can be fitted robustly: each kind is the five functions that RANSAC and Huber's method need.

Rows are (x, y) for LINE and CIRCLE, (x, y, z) for PLANE and SPHERE, in metres; (u, v, u', v') for
HOMOGRAPHY and FUNDAMENTAL, a pixel of the first image and its match in the second; (x, y, z, x',
y', z') for RIGID, a source point and its target. `MODELS` are those of points and pixels.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from jaxtyping import Float

from workbench.geometry.motions.alignment import align_rigid, nearest_rotation
from workbench.geometry.points.metrics import rms
from workbench.geometry.shapes.circles_spheres import (
    circle_from_points,
    fit_sphere,
    sphere_distances,
    sphere_from_points,
)
from workbench.geometry.shapes.lines_planes import (
    fit_hyperplane,
    hyperplane_distances,
    line_from_points,
    plane_from_points,
)
from workbench.geometry.two_views.epipolar import (
    fit_fundamental,
    fundamentals_from_seven,
    orientation_agrees,
    refine_fundamental,
    sampson_distances,
)
from workbench.geometry.two_views.homography import (
    fit_homography,
    homographies_from_four,
    refine_homography,
    transfer_distances,
)

BEFORE = (2, 0, 1)  # of each corner of a triangle
SIDES_ALIKE = 0.9  # of a triangle and its match, the shorter as a share of the longer


@dataclass(frozen=True, kw_only=True)
class Model:
    """A kind of model. An estimate of it is an array whose shape depends on the kind.

    Attributes:
        sample_size: How many rows determine it.
        fewest: How many rows a refit needs.
        columns: How many numbers a row has.
        unit: Of its distances.
        degenerate_when: In words, when a sample determines no model.
        solve: From samples (k, sample_size, columns) the estimates through them, in one list: none
            for a degenerate sample, up to three for one sample of a fundamental matrix.
        distances: From estimates (..., *shape) and rows (n, columns) the distances (..., n), never
            negative. Keeps float32.
        solve_each: As `solve`, and of which sample each estimate is, in their order, bit by bit as
            one by one. None where a call for one sample costs little.
        refit: `refit(p, weights=None, start=None)`: the weighted least-squares estimate, near
            `start` where that is given.
    """

    name: str
    sample_size: int
    fewest: int
    columns: int
    unit: str
    degenerate_when: str
    solve: Callable[[np.ndarray], np.ndarray]
    distances: Callable[[np.ndarray, np.ndarray], np.ndarray]
    refit: Callable[..., np.ndarray]
    solve_each: Callable[[np.ndarray], tuple[np.ndarray, np.ndarray]] | None = None


def finite(estimates: Float[np.ndarray, "k ..."]) -> Float[np.ndarray, "j ..."]:
    """Return the estimates that have no NaN: the solvers mark a degenerate sample by it."""
    return estimates[np.isfinite(estimates).all(axis=tuple(range(1, estimates.ndim)))]


def from_points(solver: Callable[[np.ndarray], np.ndarray]) -> Callable[[np.ndarray], np.ndarray]:
    """Return a `Model.solve` of a function from one sample to one estimate or NaN."""
    return lambda samples: finite(
        np.stack([np.asarray(solver(sample), dtype=float) for sample in samples])
    )


def rms_distance(
    model: Model, estimate: Float[np.ndarray, "..."], p: Float[np.ndarray, "n d"]
) -> float:
    """Return the root mean square distance of the rows to an estimate, in the model's unit."""
    return rms(model.distances(estimate, p))


def _hyperplane_distances(hyperplane: np.ndarray, p: np.ndarray) -> np.ndarray:
    signed = hyperplane_distances(hyperplane, p)
    return np.abs(signed, out=signed)


def _sphere_distances(sphere: np.ndarray, p: np.ndarray) -> np.ndarray:
    return np.abs(sphere_distances(sphere, p))


def _refit_hyperplane(
    p: np.ndarray, weights: np.ndarray | None = None, start: np.ndarray | None = None
) -> np.ndarray:
    """Fit in closed form; a start is not needed."""
    return fit_hyperplane(p, weights)


def _solve_homographies(samples: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    H_b_a = homographies_from_four(samples[..., :2], samples[..., 2:])
    of_sample = np.flatnonzero(np.isfinite(H_b_a).all(axis=(-2, -1)))
    return H_b_a[of_sample], of_sample


def _transfer_distances(H_b_a: np.ndarray, matches: np.ndarray) -> np.ndarray:
    return transfer_distances(H_b_a, matches[:, :2], matches[:, 2:])


def _refit_homography(
    matches: np.ndarray, weights: np.ndarray | None = None, start: np.ndarray | None = None
) -> np.ndarray:
    uv_a, uv_b = matches[:, :2], matches[:, 2:]
    start = fit_homography(uv_a, uv_b, weights) if start is None else start
    return refine_homography(start, uv_a, uv_b, weights=weights)


def _solve_fundamentals(samples: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    uv_first, uv_second = samples[..., :2], samples[..., 2:]
    F = fundamentals_from_seven(uv_first, uv_second)
    of_sample, root = np.nonzero(np.isfinite(F).all(axis=(-2, -1)))
    F = F[of_sample, root]
    agree = orientation_agrees(F[:, None], uv_first[of_sample], uv_second[of_sample])[:, 0]
    return F[agree], of_sample[agree]


def _sampson_distances(F: np.ndarray, matches: np.ndarray) -> np.ndarray:
    signed = sampson_distances(F, matches[:, :2], matches[:, 2:])
    return np.abs(signed, out=signed)


def _refit_fundamental(
    matches: np.ndarray, weights: np.ndarray | None = None, start: np.ndarray | None = None
) -> np.ndarray:
    uv_first, uv_second = matches[:, :2], matches[:, 2:]
    start = fit_fundamental(uv_first, uv_second, weights) if start is None else start
    return refine_fundamental(start, uv_first, uv_second, weights=weights)


def _solve_rigid(samples: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    p_source, p_target = samples[..., :3], samples[..., 3:]
    sides = [np.linalg.norm(p - p[:, BEFORE], axis=2) for p in (p_source, p_target)]
    alike = (np.minimum(*sides) > SIDES_ALIKE * np.maximum(*sides)) & (sides[0] > 0)
    of_sample = np.flatnonzero(alike.all(axis=1))
    T_target_source = np.zeros((len(of_sample), 4, 4)) + np.eye(4)
    if len(of_sample):
        p, q = p_source[of_sample], p_target[of_sample]
        mean_p, mean_q = p.mean(axis=1, keepdims=True), q.mean(axis=1, keepdims=True)
        # as align_rigid, for many triangles
        R = nearest_rotation(np.swapaxes(q - mean_q, 1, 2) @ (p - mean_p))
        T_target_source[:, :3, :3] = R
        T_target_source[:, :3, 3] = (mean_q - mean_p @ np.swapaxes(R, 1, 2))[:, 0]
    return T_target_source, of_sample


def _pair_distances(T_target_source: np.ndarray, pairs: np.ndarray) -> np.ndarray:
    R = T_target_source[..., :3, :3]
    t = T_target_source[..., None, :3, 3]
    off = pairs[:, :3] @ np.swapaxes(R, -1, -2) + t - pairs[:, 3:]
    return np.sqrt(np.einsum("...ij,...ij->...i", off, off))


def _refit_rigid(
    pairs: np.ndarray, weights: np.ndarray | None = None, start: np.ndarray | None = None
) -> np.ndarray:
    """Fit in closed form; a start is not needed."""
    return align_rigid(pairs[:, 3:], pairs[:, :3], weights)


LINE = Model(
    name="line",
    sample_size=2,
    fewest=2,
    columns=2,
    unit="m",
    degenerate_when="the two points coincide",
    solve=lambda samples: finite(line_from_points(samples)),
    distances=_hyperplane_distances,
    refit=_refit_hyperplane,
)
PLANE = Model(
    name="plane",
    sample_size=3,
    fewest=3,
    columns=3,
    unit="m",
    degenerate_when="the three points lie on one line",
    solve=lambda samples: finite(plane_from_points(samples)),
    distances=_hyperplane_distances,
    refit=_refit_hyperplane,
)
CIRCLE = Model(
    name="circle",
    sample_size=3,
    fewest=3,
    columns=2,
    unit="m",
    degenerate_when="the three points lie on one line",
    solve=lambda samples: finite(circle_from_points(samples)),
    distances=_sphere_distances,
    refit=fit_sphere,
)
SPHERE = Model(
    name="sphere",
    sample_size=4,
    fewest=4,
    columns=3,
    unit="m",
    degenerate_when="the four points lie in one plane",
    solve=lambda samples: finite(sphere_from_points(samples)),
    distances=_sphere_distances,
    refit=fit_sphere,
)
HOMOGRAPHY = Model(
    name="homography",
    sample_size=4,
    fewest=4,
    columns=4,
    unit="px",
    degenerate_when="no camera can see both sets of four pixels as one plane",
    solve=lambda samples: _solve_homographies(samples)[0],
    solve_each=_solve_homographies,
    distances=_transfer_distances,
    refit=_refit_homography,
)
FUNDAMENTAL = Model(
    name="fundamental matrix",
    sample_size=7,
    fewest=8,
    columns=4,
    unit="px",
    degenerate_when="no two cameras can see the seven matches in front of them",
    solve=lambda samples: _solve_fundamentals(samples)[0],
    solve_each=_solve_fundamentals,
    distances=_sampson_distances,
    refit=_refit_fundamental,
)
RIGID = Model(
    name="rigid motion",
    sample_size=3,
    fewest=3,
    columns=6,
    unit="m",
    degenerate_when=(
        "the two triangles have different sides, so that no motion brings them together"
    ),
    solve=lambda samples: _solve_rigid(samples)[0],
    solve_each=_solve_rigid,
    distances=_pair_distances,
    refit=_refit_rigid,
)
MODELS = {model.name: model for model in (LINE, PLANE, CIRCLE, SPHERE, HOMOGRAPHY, FUNDAMENTAL)}
