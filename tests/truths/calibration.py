"""What is true of a calibration, apart from the lesson's core: a camera written out, its inverse,
differences for slopes.
"""

import functools

import numpy as np

from lessons.calibration.state import State
from workbench.algorithms.least_squares.board_adjustment import Adjustment

K = np.array([[536.0, 0, 342], [0, 536, 236], [0, 0, 1]])
LENS = (-0.27, 0.05, 0.0015, -0.0005, 0.0)


def bent(xy: np.ndarray, k1: float, k2: float, p1: float, p2: float, k3: float) -> np.ndarray:  # noqa: PLR0917
    """Brown's lens as OpenCV's documentation has it."""
    x, y = xy[..., 0], xy[..., 1]
    r2 = x**2 + y**2
    radial = 1 + k1 * r2 + k2 * r2**2 + k3 * r2**3
    return np.stack(
        [
            x * radial + 2 * p1 * x * y + p2 * (r2 + 2 * x**2),
            y * radial + p1 * (r2 + 2 * y**2) + 2 * p2 * x * y,
        ],
        axis=-1,
    )


def seen(K: np.ndarray, lens: tuple[float, ...], Ts: np.ndarray, *, p: np.ndarray) -> np.ndarray:
    """Pixels (k, n, 2) of the board in every view."""
    c = p @ np.swapaxes(Ts[:, :3, :3], 1, 2) + Ts[:, None, :3, 3]
    return bent(c[..., :2] / c[..., 2:], *lens) @ K[:2, :2].T + K[:2, 2]


@functools.cache
def rays() -> tuple[np.ndarray, np.ndarray]:
    """Pixels of a grid over the picture, and the true rays they look along, by fixed-point
    iteration.
    """
    u, v = np.meshgrid(np.linspace(0, 639, 33), np.linspace(0, 479, 25))
    uv = np.stack([u.ravel(), v.ravel()], axis=1)
    goal = (uv - K[:2, 2]) / 536.0
    xy = goal.copy()
    for _ in range(300):
        xy = xy + goal - bent(xy, *LENS)
    assert np.abs(bent(xy, *LENS) - goal).max() < 1e-9
    return uv, xy


def worst_ray(K_found: np.ndarray, lens: tuple[float, ...]) -> float:
    """How far off the farthest ray of the grid is, pixels."""
    uv, xy = rays()
    return float(
        np.linalg.norm(bent(xy, *lens) @ K_found[:2, :2].T + K_found[:2, 2] - uv, axis=1).max()
    )


def rms_of(state: State) -> np.ndarray:
    """The rms of each view, from the camera and the poses themselves."""
    estimate, subject = state.now, state.subject
    assert estimate.K is not None
    off = (
        seen(estimate.K, tuple(estimate.lens), estimate.Ts_camera_board, p=subject.p_board)
        - subject.uv
    )
    return np.sqrt((off**2).sum(axis=2).mean(axis=1))


def deviation_of_f(state: State) -> float:
    """The predicted deviation of fx, from a dense Jacobian by differences over all unknowns,
    weighted as the loss asks.
    """
    adjustment = state.now.adjustment
    subject = state.subject
    assert isinstance(adjustment, Adjustment)
    p, uv = subject.p_board, subject.uv
    free = [i for i in range(9) if adjustment.free[i]]
    shared = np.array(
        [
            adjustment.K[0, 0],
            adjustment.K[1, 1],
            adjustment.K[0, 2],
            adjustment.K[1, 2],
            *adjustment.lens,
        ]
    )

    def residuals(x: np.ndarray) -> np.ndarray:
        """Residuals where the free shared unknowns, and then all poses alike, have moved by x; one
        row per view.
        """
        s = shared.copy()
        s[free] += x[: len(free)]
        a, b, c = x[len(free) : len(free) + 3]
        W = np.array([[0, -c, b], [c, 0, -a], [-b, a, 0]])
        Ts = adjustment.Ts_camera_board.copy()
        Ts[:, :3, :3] = (np.eye(3) + W + W @ W / 2) @ Ts[:, :3, :3]
        Ts[:, :3, 3] += x[len(free) + 3 :]
        camera = np.array([[s[0], 0, s[2]], [0, s[1], s[3]], [0, 0, 1]])
        return (seen(camera, tuple(s[4:]), Ts, p=p) - uv).reshape(len(uv), -1)

    sizes = np.array([*[1e-3 if i < 4 else 1e-6 for i in free], *([1e-6] * 6)])
    slopes = np.stack(
        [(residuals(h) - residuals(-h)) / (2 * h.sum()) for h in np.diag(sizes)], axis=2
    )
    unknowns = len(free) + 6 * len(uv)
    r = residuals(0 * sizes)
    J = np.zeros((*r.shape, unknowns))
    J[:, :, : len(free)] = slopes[:, :, : len(free)]
    for k in range(len(uv)):  # a pose moves its own view only
        J[k, :, len(free) + 6 * k : len(free) + 6 * (k + 1)] = slopes[k, :, len(free) :]
    J = J.reshape(-1, unknowns)
    r = r.ravel()
    w = np.ones(len(uv) * len(p))
    if state.params.loss == "Cauchy":
        w = 1 / (1 + (r.reshape(-1, 2) ** 2).sum(axis=1) / state.params.corner**2)
    w = np.repeat(w, 2)
    scale = 1 / np.sqrt((J**2 * w[:, None]).sum(axis=0))
    N = (J * scale).T @ (w[:, None] * (J * scale))
    return float(
        scale[0] * np.sqrt((w * r**2).sum() / (len(r) - unknowns) * np.linalg.inv(N)[0, 0])
    )
