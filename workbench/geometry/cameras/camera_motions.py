"""Where a camera was that saw many known points: by DLT, by SQPnP, and by least squares.

All functions take world points in metres and their observed normalised image coordinates (X/Z,
Y/Z), and give T_camera_world. Points are taken relative to their mean first, so that coordinates of
a map lose no digits; `centred=False` leaves that out. Leading dimensions are problems that are
solved side by side.
Reference: Hartley and Zisserman, Multiple View Geometry, 2nd ed., 7.1 (DLT) and appendix 6
(Levenberg-Marquardt); Terzakis and Lourakis, A Consistently Fast and Globally Optimal Solution to
the Perspective-n-Point Problem, 2020.
"""

import numpy as np
from jaxtyping import Float

from workbench.geometry.motions import exp_se3, skew, turns
from workbench.geometry.motions.alignment import nearest_rotation
from workbench.geometry.two_views.homography import homogeneous

_SKEW = np.stack([skew(axis) for axis in np.eye(3)])


def reprojection_errors(
    Ts_camera_world: Float[np.ndarray, "*k 4 4"],
    p_world: Float[np.ndarray, "*j n 3"],
    xy: Float[np.ndarray, "*i n 2"],
) -> Float[np.ndarray, "*k n"]:
    """Return how far each point is seen from where it was observed; infinite from behind."""
    p_camera = _moved(Ts_camera_world, p_world)
    with np.errstate(all="ignore"):
        off = p_camera[..., :2] / p_camera[..., 2:] - xy
        return np.where(p_camera[..., 2] > 0.0, np.sqrt(np.square(off).sum(axis=-1)), np.inf)


def rms_reprojection(
    Ts_camera_world: Float[np.ndarray, "*k 4 4"],
    p_world: Float[np.ndarray, "*j n 3"],
    xy: Float[np.ndarray, "*i n 2"],
) -> Float[np.ndarray, "*k"]:
    """Return the root mean square reprojection error of each motion; infinite from behind."""
    return np.asarray(
        np.sqrt(np.square(reprojection_errors(Ts_camera_world, p_world, xy)).mean(axis=-1))
    )


def linearised(
    Ts_camera_world: Float[np.ndarray, "*k 4 4"],
    p_world: Float[np.ndarray, "*k n 3"],
    xy: Float[np.ndarray, "*k n 2"],
) -> tuple[Float[np.ndarray, "*k m"], Float[np.ndarray, "*k m 6"]]:
    """Return the residuals, u and v of point after point, and their derivatives by a twist.

    The twist is (v, w), metres and radians, in the camera's frame: T becomes exp(twist) T (Solà,
    182).
    """
    p_camera = _moved(Ts_camera_world, p_world)
    near = 1.0 / p_camera[..., 2]
    x, y = p_camera[..., 0] * near, p_camera[..., 1] * near
    J = np.zeros((*x.shape, 2, 6))
    J[..., 0, 0] = J[..., 1, 1] = near
    J[..., 0, 2], J[..., 1, 2] = -x * near, -y * near
    J[..., 0, 3] = -x * y
    J[..., 0, 4] = 1.0 + x * x
    J[..., 0, 5] = -y
    J[..., 1, 3] = -1.0 - y * y
    J[..., 1, 4] = x * y
    J[..., 1, 5] = x
    residuals = np.stack([x, y], axis=-1) - xy
    return residuals.reshape(*x.shape[:-1], -1), J.reshape(*x.shape[:-1], -1, 6)


def gauss_newton_step(
    T_camera_world: Float[np.ndarray, "4 4"],
    p_world: Float[np.ndarray, "n 3"],
    xy: Float[np.ndarray, "n 2"],
) -> Float[np.ndarray, "4 4"]:
    """Return the motion after one Gauss-Newton step, the shortest that does, on squared errors."""
    residuals, J = linearised(T_camera_world, p_world, xy)
    return exp_se3(-np.linalg.lstsq(J, residuals, rcond=None)[0]) @ T_camera_world


def refined(
    Ts_camera_world: Float[np.ndarray, "k 4 4"],
    p_world: Float[np.ndarray, "*j n 3"],
    xy: Float[np.ndarray, "*i n 2"],
    *,
    weights: Float[np.ndarray, " n"] | None = None,
    steps: int = 30,
) -> Float[np.ndarray, "k 4 4"]:
    """Return the nearby motions of least squared reprojection errors, by Levenberg-Marquardt.

    The cost never rises. All points must be in front at the start; a step that brings one behind
    the camera has failed. Weights count squared errors.
    """
    k = len(Ts_camera_world)
    p_mean = p_world.mean(axis=-2)
    q = np.broadcast_to(p_world - p_mean[..., None, :], (k, *p_world.shape[-2:]))
    xy = np.broadcast_to(xy, (k, *xy.shape[-2:]))
    T = _about(Ts_camera_world, p_mean)
    root = None if weights is None else np.repeat(np.sqrt(weights), 2)
    damping = np.full(k, 1e-6)
    cost = np.full(k, np.inf)
    active = np.arange(k)
    with np.errstate(all="ignore"):
        residuals, J = _weighted(*linearised(T, q, xy), root)
        cost = np.square(residuals).sum(axis=-1)
        for _ in range(steps):
            A = np.swapaxes(J, -1, -2) @ J
            diagonal = np.einsum("kii->ki", A)
            diagonal *= 1.0 + damping[active, None]
            diagonal += 1e-300
            gradient = (np.swapaxes(J, -1, -2) @ residuals[..., None])[..., 0]
            good = np.isfinite(A).all(axis=(1, 2)) & (np.abs(np.linalg.det(A)) > 0.0)
            step = -np.linalg.solve(
                np.where(good[:, None, None], A, np.eye(6)), gradient[..., None]
            )[..., 0]
            trial = _retracted(T[active], np.where(np.isfinite(step), step, 0.0))
            again, J_again = _weighted(*linearised(trial, q[active], xy[active]), root)
            ahead = (q[active] @ trial[:, 2, :3, None])[..., 0] + trial[:, 2, 3, None] > 0.0
            lower = np.square(again).sum(axis=-1)
            better = good & (lower < cost[active]) & ahead.all(axis=1)
            settled = better & (cost[active] - lower <= 1e-10 * cost[active])
            settled |= ~better & (np.abs(step).max(axis=1) < 1e-12)
            T[active[better]], cost[active[better]] = trial[better], lower[better]
            damping[active] *= np.where(better, 0.1, 10.0)
            residuals = np.where(better[:, None], again, residuals)
            J = np.where(better[:, None, None], J_again, J)
            going = ~settled & (damping[active] < 1e12)
            active, residuals, J = active[going], residuals[going], J[going]
            if not len(active):
                break
    return _about(T, -p_mean)


def dlt_motion(
    p_world: Float[np.ndarray, "n 3"], xy: Float[np.ndarray, "n 2"], *, centred: bool = True
) -> Float[np.ndarray, "4 4"]:
    """Return the motion in the projection matrix that solves x × P X = 0 best.

    Points in one plane leave many. Centred, it also scales the points (Hartley's normalisation).
    Reference: Hartley and Zisserman, algorithm 7.1, then the nearest rotation and mean singular
    value.

    Raises:
        ValueError: If there are fewer than six points.
    """
    if len(p_world) < 6:
        raise ValueError(f"the direct linear transform needs 6 points, not {len(p_world)}")
    p_mean, scale = (p_world.mean(axis=0), 1.0) if centred else (np.zeros(3), 1.0)
    if centred:
        scale = np.sqrt(3.0) / max(float(np.linalg.norm(p_world - p_mean, axis=1).mean()), 1e-300)
    X = homogeneous(scale * (p_world - p_mean))
    A = np.concatenate(
        [np.hstack([X, 0 * X, -xy[:, :1] * X]), np.hstack([0 * X, X, -xy[:, 1:] * X])]
    )
    P = np.linalg.svd(A, full_matrices=False)[2][-1].reshape(3, 4)
    U, S, Vt = np.linalg.svd(P[:, :3])
    sign = np.sign(np.linalg.det(U) * np.linalg.det(Vt))
    T = np.eye(4)
    T[:3, :3] = sign * U @ Vt
    T[:3, 3] = sign * P[:, 3] * 3.0 / max(S.sum(), 1e-300) / scale
    return _about(T[None], -p_mean)[0]


def sqpnp(
    p_world: Float[np.ndarray, "*k n 3"], xy: Float[np.ndarray, "*k n 2"], *, centred: bool = True
) -> Float[np.ndarray, "*k 4 4"]:
    """Return the motions that minimise the points' squared distances from their rays.

    The cost is a quadratic form in the nine entries of R. From rotations near its lowest
    eigenvectors sequential quadratic programs go down. Points may lie in one plane, but not on one
    line.
    Reference: Terzakis and Lourakis 2020, eq. 5 to 10 and 3.2; steps are kept on the rotations
    here.

    Raises:
        ValueError: If there are fewer than three points.
    """
    if p_world.shape[-2] < 3:
        raise ValueError(f"three points at least are needed, not {p_world.shape[-2]}")
    batch = p_world.shape[:-2]
    p, xy = (rows.reshape(-1, *rows.shape[-2:]) for rows in (p_world, xy))
    p_mean = p.mean(axis=1) if centred else np.zeros((len(p), 3))
    q = p - p_mean[:, None]
    omega, t_of_r = _quadratic_form(q, xy)
    vectors = np.swapaxes(np.linalg.eigh(omega)[1][..., :_STARTS], -1, -2).reshape(
        len(p), _STARTS, 3, 3
    )
    # Whose nearest rotation moves these points most alike
    starts = vectors @ (np.swapaxes(q, 1, 2) @ q)[:, None]
    R = nearest_rotation(np.concatenate([starts, -starts], axis=1))
    rows = np.arange(len(p))[:, None]
    mean = q.mean(axis=1)
    for programs, kept in ((2, 2), (_PROGRAMS, 1)):
        R = _programs(omega, R, programs)
        r = R.reshape(*R.shape[:2], 9)
        t = r @ np.swapaxes(t_of_r, -1, -2)
        ahead = (R[:, :, 2] @ mean[..., None])[..., 0] + t[..., 2] > 0.0
        order = np.argsort(np.where(ahead, ((r @ omega) * r).sum(axis=-1), np.inf), axis=1)[
            :, :kept
        ]
        R, t = R[rows, order], t[rows, order]
    T = np.zeros((len(p), 4, 4))
    T[:, :3, :3] = R[:, 0]
    T[:, :3, 3] = t[:, 0]
    T[:, 3, 3] = 1.0
    return _about(T, -p_mean).reshape(*batch, 4, 4)


_STARTS, _PROGRAMS = 4, 15


def ray_forms(xy: Float[np.ndarray, "*k n 2"]) -> Float[np.ndarray, "*k n 3 3"]:
    """Return C with p' C p = (X - x Z)^2 + (Y - y Z)^2: squared distance from a ray times depth.

    Examples:
        >>> p = np.array([0.5, 0.0, 2.0])
        >>> float(p @ ray_forms(np.array([[0.0, 0.0]]))[0] @ p)
        0.25
    """
    x, y = xy[..., 0], xy[..., 1]
    C = np.zeros((*x.shape, 3, 3))
    C[..., 0, 0] = C[..., 1, 1] = 1.0
    C[..., 0, 2] = C[..., 2, 0] = -x
    C[..., 1, 2] = C[..., 2, 1] = -y
    C[..., 2, 2] = x * x + y * y
    return C


def _quadratic_form(q: np.ndarray, xy: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return omega (k, 9, 9), the cost being r' omega r of R's rows, and (k, 3, 9) from r to t."""
    n = q.shape[1]
    C = ray_forms(xy)
    flat = C.reshape(len(q), n, 9)
    outer = (q[..., :, None] * q[..., None, :]).reshape(len(q), n, 9)
    omega = (
        (np.swapaxes(flat, 1, 2) @ outer)
        .reshape(-1, 3, 3, 3, 3)
        .transpose(0, 1, 3, 2, 4)
        .reshape(-1, 9, 9)
    )
    mixed = (np.swapaxes(flat, 1, 2) @ q).reshape(-1, 3, 9)
    t_of_r = -np.linalg.solve(C.sum(axis=1), mixed)
    return omega + np.swapaxes(mixed, -1, -2) @ t_of_r, t_of_r


def _programs(omega: np.ndarray, R: np.ndarray, most: int) -> np.ndarray:
    """Minimise the forms repeatedly in the three directions in which each rotation can move."""
    of_problem = np.repeat(np.arange(len(R)), R.shape[1])
    R = R.copy().reshape(-1, 3, 3)
    going = np.arange(len(R))
    for _ in range(most):
        E = (_SKEW @ R[going, None]).reshape(-1, 3, 9)
        H = E @ omega[of_problem[going]]
        A = H @ np.swapaxes(E, -1, -2)
        A[:, range(3), range(3)] += 1e-12 * np.trace(A, axis1=1, axis2=2)[:, None] + 1e-300
        w = -np.linalg.solve(A, H @ R[going].reshape(-1, 9, 1))[..., 0]
        R[going] = turns(w) @ R[going]
        going = going[np.abs(w).max(axis=1) > 1e-8]
        if not len(going):
            break
    return R.reshape(len(omega), -1, 3, 3)


def _moved(T: np.ndarray, p: np.ndarray) -> np.ndarray:
    return p @ np.swapaxes(T[..., :3, :3], -1, -2) + T[..., None, :3, 3]


def _retracted(T: np.ndarray, twist: np.ndarray) -> np.ndarray:
    """Move by twists, composed on the left, to first order in the translation."""
    moved = T.copy()
    R = turns(twist[..., 3:])
    moved[..., :3, :] = R @ T[..., :3, :]
    moved[..., :3, 3] += twist[..., :3]
    return moved


def _about(T: np.ndarray, p: np.ndarray) -> np.ndarray:
    """Return the motions for points given relative to p: T(q + p) = (returned)(q)."""
    moved = T.copy()
    moved[..., :3, 3] += (T[..., :3, :3] @ p[..., None])[..., 0]
    return moved


def _weighted(
    residuals: np.ndarray, J: np.ndarray, root: np.ndarray | None
) -> tuple[np.ndarray, np.ndarray]:
    return (residuals, J) if root is None else (root * residuals, root[:, None] * J)
