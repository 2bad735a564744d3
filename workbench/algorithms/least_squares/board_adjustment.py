"""Refines a camera, its lens and the poses of a board together, by Levenberg and Marquardt.

The normal equations have 4 to 9 unknowns that all views share and 6 of each view alone. The pose
blocks are independent, so they are solved for first (Schur's complement), and what is left is as
large as the camera. Boards are in metres, residuals are projected minus measured pixels.

Reference: Zhang, A Flexible New Technique for Camera Calibration, PAMI 2000, 3.2 and 3.3 (what is
minimised); Triggs et al., Bundle Adjustment: A Modern Synthesis, 2000, sections 3.2 (residual
weights) and 6.1 (Schur's complement).
"""

from collections.abc import Iterator
from dataclasses import dataclass
from enum import Enum

import numpy as np
from jaxtyping import Bool, Float

from workbench.geometry.cameras import intrinsics
from workbench.geometry.cameras.distortion import Distortion
from workbench.geometry.motions import turns
from workbench.tracing import traced

SHARED = ("fx", "fy", "cx", "cy", "k1", "k2", "p1", "p2", "k3")
"""What all views share, in the order of covariances."""
# rows of a view's block
_POSE = slice(9, 15)
_RESIDUAL = 15


def shared_numbers(K: Float[np.ndarray, "3 3"], lens: Distortion) -> Float[np.ndarray, "9"]:
    """Return the values of `SHARED`, the first four in pixels."""
    return np.array([K[0, 0], K[1, 1], K[0, 2], K[1, 2], *lens])


class Stop(Enum):
    """Why the iteration ended."""

    CONVERGED = "converged: the cost fell by less than the tolerance"
    STUCK = "no step lowers the cost any more"
    MAX_ITERATIONS = "the maximum number of iterations is reached"

    @property
    def message(self) -> str:
        """The reason in words."""
        return self.value


@dataclass(frozen=True, eq=False, kw_only=True)
class Adjustment:
    """One iteration.

    Attributes:
        iteration: How many linear systems were solved; 0 is the start.
        weights: How much each corner's squared residual counts.
        cost: The sum of the loss over all corners, px².
        damping: With which the next system is solved.
        accepted: Whether this step lowered the cost; a rejected one changes nothing but the
            damping.
        covariance: Of the free ones of `SHARED`; None before the end, and where the views do not
            determine them.
        free: Which of `SHARED` are free.
        stop: Why this is the last, or None.
    """

    iteration: int
    K: Float[np.ndarray, "3 3"]
    lens: Distortion
    Ts_camera_board: Float[np.ndarray, "k 4 4"]
    residuals: Float[np.ndarray, "k n 2"]
    weights: Float[np.ndarray, "k n"]
    cost: float
    damping: float
    accepted: bool
    free: Bool[np.ndarray, "9"]
    covariance: Float[np.ndarray, "f f"] | None = None
    stop: Stop | None = None

    @property
    def deviations(self) -> Float[np.ndarray, "9"]:
        """Predicted standard deviations of `SHARED`; 0 for what is fixed, NaN if not known."""
        deviations = np.zeros(9)
        deviations[self.free] = (
            np.nan if self.covariance is None else np.sqrt(np.diag(self.covariance))
        )
        return deviations


@traced
def adjust(
    K: Float[np.ndarray, "3 3"],
    lens: Distortion,
    Ts_camera_board: Float[np.ndarray, "k 4 4"],
    *,
    p_board: Float[np.ndarray, "n 3"],
    uv: Float[np.ndarray, "k n 2"],
    coefficients: int = 5,
    corner: float | None = None,
    max_iterations: int = 60,
    tolerance: float = 1e-10,
) -> Iterator[Adjustment]:
    """Yield the iterations of the joint refinement, from the start on, rejected ones too.

    The cost never rises. The predicted covariance takes errors of all corners for independent and
    alike, and the board for flat and as large as `p_board` says.

    Args:
        K: Where to begin, pixels; the skew is left out.
        coefficients: How many of k1, k2, p1, p2, k3 are free; the others stay as they are.
        corner: Residuals well beyond it, in pixels, hardly count (Cauchy's loss); squares if None.
        max_iterations: Linear systems solved at most.
        tolerance: Converged when a step lowers the cost by less than this share.
    """
    free = np.arange(9) < 4 + coefficients
    shared = shared_numbers(K, lens)
    R = Ts_camera_board[:, :3, :3]
    t = Ts_camera_board[:, :3, 3]
    block = linearised(shared, R, t, p_board=p_board, uv=uv)
    damping = 1e-4
    accepted = True
    stop = None
    covariance = None
    cost, weights = loss(block, corner)
    for iteration in range(max_iterations + 1):
        if iteration == max_iterations:
            stop = stop or Stop.MAX_ITERATIONS
        if stop:
            covariance = _covariance(block, weights, free)
        yield Adjustment(
            iteration=iteration,
            K=intrinsics(shared[0], shared[2], shared[3], fy=shared[1]),
            lens=Distortion(*shared[4:].tolist()),
            Ts_camera_board=_motions(R, t),
            residuals=np.moveaxis(block[:, _RESIDUAL].reshape(len(uv), 2, -1), 1, 2),
            weights=weights,
            cost=cost,
            damping=damping,
            accepted=accepted,
            free=free,
            covariance=covariance,
            stop=stop,
        )
        if stop:
            return
        step = solved(_normal(block, weights), free, damping)
        moved = shared, R, t
        if step is not None:
            moved = shared + step[0], turns(step[1][:, :3]) @ R, t + step[1][:, 3:]
        trial = linearised(*moved, p_board=p_board, uv=uv)
        trial_cost, trial_weights = loss(trial, corner)
        accepted = trial_cost < cost and bool(moved[0][:2].min() > 0)
        if accepted:
            stop = Stop.CONVERGED if cost - trial_cost <= tolerance * cost else None
            (shared, R, t), block, cost, weights = moved, trial, trial_cost, trial_weights
            damping = max(damping / 10.0, 1e-12)
        else:
            damping *= 10.0
            stop = Stop.STUCK if damping > 1e8 else None


_QUIETLY = np.errstate(all="ignore")
"""A point at depth 0 or beyond all numbers gives a cost that is not finite: such a step is
rejected.
"""


@_QUIETLY
def linearised(
    shared: Float[np.ndarray, "9"],
    R_camera_board: Float[np.ndarray, "k 3 3"],
    t: Float[np.ndarray, "k 3"],
    *,
    p_board: Float[np.ndarray, "n 3"],
    uv: Float[np.ndarray, "k n 2"],
) -> Float[np.ndarray, "k 16 m"]:
    """Return the derivatives of each view's 2n residuals, all u and then all v; these come last.

    Rows 0 to 8 belong to `SHARED`, 9 to 11 to a turn of the board about its origin (R becomes
    exp(w) R), 12 to 14 to t.
    """
    n = len(p_board)
    fx, fy, cx, cy, k1, k2, p1, p2, k3 = shared
    q = R_camera_board @ p_board.T  # (k, 3, n)
    X, Y, Z = np.moveaxis(q + t[:, :, None], 1, 0)
    per_depth = 1.0 / Z
    x, y = X * per_depth, Y * per_depth
    out = np.zeros((len(uv), 16, 2 * n))
    of_u, of_v = out[:, :, :n], out[:, :, n:]
    xx, yy, xy = x * x, y * y, x * y
    s = xx + yy
    growth = 2.0 * (k1 + s * (2.0 * k2 + s * (3.0 * k3)))
    factor = 1.0 + s * (k1 + s * (k2 + s * k3)) + 2.0 * (p2 * x + p1 * y)
    bent_x, bent_y = factor * x + p2 * s, factor * y + p1 * s

    of_u[:, 0] = bent_x
    of_v[:, 1] = bent_y
    of_u[:, 2] = 1.0
    of_v[:, 3] = 1.0
    fx_x, fy_y = fx * x, fy * y
    for row, power in ((4, s), (5, s * s), (8, s**3)):
        of_u[:, row], of_v[:, row] = fx_x * power, fy_y * power
    of_u[:, 6] = 2.0 * fx * xy
    of_v[:, 6] = fy * (s + 2.0 * yy)
    of_u[:, 7] = fx * (s + 2.0 * xx)
    of_v[:, 7] = 2.0 * fy * xy

    slope_xx = factor + x * (growth * x + 4.0 * p2)  # the lens's own Jacobian, which is symmetric
    slope_xy = growth * xy + 2.0 * (p1 * x + p2 * y)
    slope_yy = factor + y * (growth * y + 4.0 * p1)
    for part, along_x, along_y in (
        (of_u, fx * slope_xx, fx * slope_xy),
        (of_v, fy * slope_xy, fy * slope_yy),
    ):
        a, b = along_x * per_depth, along_y * per_depth
        c = -(x * a + y * b)
        part[:, 12], part[:, 13], part[:, 14] = a, b, c
        part[:, 9] = q[:, 1] * c - q[:, 2] * b  # a turn w moves the point by w × q
        part[:, 10] = q[:, 2] * a - q[:, 0] * c
        part[:, 11] = q[:, 0] * b - q[:, 1] * a
    of_u[:, 15], of_v[:, 15] = fx * bent_x + cx - uv[:, :, 0], fy * bent_y + cy - uv[:, :, 1]
    return out


@_QUIETLY
def loss(
    block: Float[np.ndarray, "k 16 m"], corner: float | None
) -> tuple[float, Float[np.ndarray, "k n"]]:
    """Return the summed loss and the weight of each corner: squares, or Cauchy's loss.

    Cauchy's loss is c² log(1 + e²/c²), whose slope is that of the weighted square e² / (1 + e²/c²).
    """
    squared = np.square(block[:, _RESIDUAL])
    n = squared.shape[1] // 2
    e2 = squared[:, :n] + squared[:, n:]
    if corner is None:
        return float(e2.sum()), np.ones_like(e2)
    scaled = e2 / corner**2
    return float(corner**2 * np.log1p(scaled).sum()), 1.0 / (1.0 + scaled)


@_QUIETLY
def solved(
    normal: Float[np.ndarray, "k 16 16"], free: Bool[np.ndarray, "9"], damping: float
) -> tuple[Float[np.ndarray, "9"], Float[np.ndarray, "k 6"]] | None:
    """Return the damped step of the shared unknowns and of every pose; None without a solution.

    Args:
        normal: Products of the rows of every view's block.
        free: Which shared unknowns may move.
        damping: By which share the diagonal is raised (Marquardt).
    """
    A, B, P, g, h = _parts(normal, free)
    A.flat[:: len(A) + 1] *= 1.0 + damping
    P[:, range(6), range(6)] *= 1.0 + damping
    step = np.zeros(9)
    try:
        eliminated = np.linalg.solve(
            P, np.concatenate([np.moveaxis(B, 1, 2), h[:, :, None]], axis=2)
        )
        per_shared = eliminated[:, :, :-1]
        alone = eliminated[:, :, -1]
        step[free] = np.linalg.solve(
            A - (B @ per_shared).sum(axis=0), np.einsum("ksp,kp->s", B, alone) - g
        )
    except np.linalg.LinAlgError:
        return None
    poses = -alone - per_shared @ step[free]
    return (step, poses) if np.isfinite(step).all() and np.isfinite(poses).all() else None


def shared_information(
    block: Float[np.ndarray, "k 16 m"], free: Bool[np.ndarray, "9"]
) -> Float[np.ndarray, "f f"]:
    """Return the normal matrix of the free shared unknowns with the poses eliminated."""
    return _information(block @ np.swapaxes(block, 1, 2), free)


@_QUIETLY
def _normal(block: np.ndarray, weights: np.ndarray) -> np.ndarray:
    return (block * np.tile(weights, 2)[:, None, :]) @ np.swapaxes(block, 1, 2)


def _parts(normal: np.ndarray, free: np.ndarray) -> tuple[np.ndarray, ...]:
    """Return A (f, f), B (k, f, 6), P (k, 6, 6), g (f,) and h (k, 6)."""
    shared = np.flatnonzero(free)
    total = normal.sum(axis=0)
    return (
        total[np.ix_(shared, shared)],
        normal[:, shared, _POSE],
        normal[:, _POSE, _POSE].copy(),
        total[shared, _RESIDUAL],
        normal[:, _POSE, _RESIDUAL],
    )


def _information(normal: np.ndarray, free: np.ndarray) -> np.ndarray:
    A, B, P, _, _ = _parts(normal, free)
    return A - (B @ np.linalg.solve(P, np.swapaxes(B, 1, 2))).sum(axis=0)


@_QUIETLY
def _covariance(block: np.ndarray, weights: np.ndarray, free: np.ndarray) -> np.ndarray | None:
    """Return the covariance of the free shared unknowns; None where the views leave them open."""
    normal = _normal(block, weights)
    spare = 2 * weights.size - int(free.sum()) - 6 * len(block)
    try:
        S = _information(normal, free)
        scale = 1.0 / np.sqrt(np.diag(S))  # units of the unknowns differ by a thousand
        covariance = np.linalg.inv(S * np.outer(scale, scale)) * np.outer(scale, scale)
    except (np.linalg.LinAlgError, FloatingPointError):
        return None
    covariance *= normal[:, _RESIDUAL, _RESIDUAL].sum() / spare if spare > 0 else np.nan
    return (
        covariance if np.isfinite(covariance).all() and (np.diag(covariance) >= 0).all() else None
    )


def _motions(R: np.ndarray, t: np.ndarray) -> np.ndarray:
    T = np.zeros((len(R), 4, 4))
    T[:, :3, :3] = R
    T[:, :3, 3] = t
    T[:, 3, 3] = 1.0
    return T
