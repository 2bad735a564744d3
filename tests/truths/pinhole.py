"""The lesson's camera written out in plain numpy, and how far a stage of the calculation is from
it.
"""

import functools
from typing import Any

import numpy as np

from tests.verdicts import Run
from workbench.data.views.street import street

STAGES = ("world", "camera", "divide", "distort", "pixels", "back")
CRATE = np.array([[-1.4, 5.5, 0.0], [-1.4, 5.5, 1.0]])
TOWER = np.array([[-3.7, 13.2, 0.0], [-3.7, 13.2, 5.0]])


@functools.lru_cache(maxsize=32)
def camera(params: Any, dolly: float | None = None) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """R, t and K before the edit."""
    eye = np.array(params.camera, float)
    target = np.array(params.target, float)
    forward = (target - eye) / np.linalg.norm(target - eye)
    right = np.cross(forward, [0.0, 0.0, 1.0])
    right /= np.linalg.norm(right)
    c = np.cos(np.radians(params.turn))
    d = np.sin(np.radians(params.turn))
    about = np.array([[c, d, 0.0], [-d, c, 0.0], [0.0, 0.0, 1.0]])  # clockwise from above
    target = eye + about @ (target - eye)
    forward = about @ forward
    right = about @ right
    eye = eye + params.aside * right
    target = target + params.aside * right
    factor = params.dolly if dolly is None else dolly
    eye = target - factor * np.linalg.norm(target - eye) * forward
    R = np.stack([right, np.cross(forward, right), forward])
    f = params.f * factor
    return R, -R @ eye, np.array([[f, 0, 159.5], [0, f, 119.5], [0, 0, 1.0]])


def edited(params: Any, K: np.ndarray) -> np.ndarray:
    K = K.copy()
    if "cropped" in params.edit:
        K[:2, 2] -= (params.cut, 40)
    if "half" in params.edit:
        K[:2, 2] = (K[:2, 2] + 0.5) / 2 - 0.5
        K[:2, :2] /= 2
    return K


def points(params: Any) -> np.ndarray:
    """The street's points, with the lamp on the ray of the picked one where it hangs there."""
    p = street().points
    R, t, _ = camera(params)
    at = R @ p[params.point] + t
    if params.z == 0.0 or at[2] <= 0:
        return p
    p = p.copy()
    p[5] = R.T @ (params.z * at / at[2] - t)
    return p


def followed(params: Any) -> int:
    """Which point is followed."""
    return params.point if np.array_equal(points(params), street().points) else 5


def calculated(run: Run) -> dict[str, np.ndarray]:
    """The followed and all other points at each stage, with the run's mistake: written out once
    more.
    """
    params = run.params
    p = points(run.params)
    R, t, K = camera(params)
    K = edited(params, K) if params.k_follows else K
    R_true = R
    t_true = t
    if params.mistake == "pose inverted":
        t = -R.T @ t
        R = R.T
    if params.mistake == "OpenGL axes":
        flip = np.diag([1.0, -1.0, -1.0])
        R = flip @ R
        t = flip @ t
    p_camera = p @ R.T + t
    Z = p_camera[:, 2:]
    anyway = params.mistake in ("OpenGL axes", "divides behind too")
    with np.errstate(all="ignore"):
        xy = np.where((Z > 0) | anyway, p_camera[:, :2] / Z, np.nan)
        f = K[0, 0] if params.mistake == "lens on pixels" else 1.0
        inside = np.linalg.norm(xy, axis=1) < fold(params)
        xy_bent = polynomial(params, f * xy) / f
    if not (params.p1 or params.p2):
        xy_bent[~inside] = np.nan
    K_used = K[[1, 0, 2]][:, [0, 1, 2]] if params.mistake == "row before column" else K
    uv = xy_bent @ K_used[:2, :2].T + K_used[:2, 2]
    C = -R.T @ t if params.mistake != "t for the centre" else t
    z = p_camera[:, 2]
    if params.mistake == "ray length for depth":
        z = np.linalg.norm(p @ R_true.T + t_true, axis=1)
    back = (
        C
        + z[:, None] * np.column_stack([np.where(np.isfinite(uv), xy, np.nan), np.ones(len(p))]) @ R
    )
    if params.mistake == "lens on pixels":  # no inverse to write out
        back = run.states[-1].now.p_back
    return {
        "p": p,
        "camera": p_camera,
        "divide": xy,
        "distort": xy_bent,
        "pixels": uv,
        "back": back,
        "z": z,
    }


def polynomial(params: Any, xy: np.ndarray) -> np.ndarray:
    """Where the lens' formula puts points, however far out."""
    (x, y) = xy.T
    p1 = params.p1
    p2 = params.p2
    s = x * x + y * y
    g = 1 + params.k1 * s + params.k2 * s * s
    a = 2 * p1 * x * y + p2 * (s + 2 * x * x)
    b = p1 * (s + 2 * y * y) + 2 * p2 * x * y
    return np.array([x * g + a, y * g + b]).T


def ideal(params: Any, p: np.ndarray, dolly: float | None = None) -> np.ndarray:
    """Places on the plane Z = 1; NaN where nothing is in front."""
    R, t, _ = camera(params, dolly)
    X, Y, Z = R @ p.T + t[:, None]
    with np.errstate(all="ignore"):
        return np.where(Z > 0, np.array([X, Y]) / Z, np.nan).T


def fold(params: Any) -> float:
    """The radius at which the radial polynomial turns round, by looking for it; infinity without
    tangential terms found.
    """
    r = np.linspace(0, 5, 50001)
    slope = 1 + 3 * params.k1 * r**2 + 5 * params.k2 * r**4
    return float(r[np.argmax(slope <= 0)]) if (slope <= 0).any() else np.inf


def bent(params: Any, xy: np.ndarray) -> np.ndarray:
    out = polynomial(params, xy)
    if not (params.p1 or params.p2):
        out[np.linalg.norm(xy, axis=1) > fold(params)] = np.nan
    return out


def pixels(params: Any, p: np.ndarray, dolly: float | None = None) -> np.ndarray:
    K = edited(params, camera(params, dolly)[2])
    return bent(params, ideal(params, p, dolly)) @ K[:2, :2] + K[:2, 2]


def centre(params: Any) -> np.ndarray:
    R, t, _ = camera(params)
    return -R.T @ t


def height(params: Any, ends: np.ndarray, dolly: float | None = None) -> float:
    low, high = pixels(params, ends, dolly)
    return float(np.linalg.norm(high - low))


def both(run: Run, k: int) -> tuple[np.ndarray, np.ndarray]:
    """The calculated and the true places of all points at a stage, in pixels of the true K."""
    state = run.states[k]
    params = run.params
    K = edited(params, camera(params)[2])
    xy = ideal(params, points(params))
    if k == STAGES.index("divide"):
        got = state.now.xy
        true = xy
    elif k == STAGES.index("distort"):
        got = state.now.xy_bent
        true = bent(params, xy)
    else:
        return state.now.uv, pixels(params, points(params))
    return got @ K[:2, :2] + K[:2, 2], true @ K[:2, :2] + K[:2, 2]


def median_off(run: Run, k: int) -> float:
    off = np.linalg.norm(np.subtract(*both(run, k)), axis=1)
    return float(np.median(off[np.isfinite(off)])) if np.isfinite(off).any() else 0.0


def lost(run: Run, k: int) -> tuple[int, int]:
    """How many points have a true place and no calculated one, and the other way round."""
    got, true = (np.isfinite(uv).all(axis=1) for uv in both(run, k))
    return int((true & ~got).sum()), int((got & ~true).sum())


def median_back(run: Run) -> float:
    off = np.linalg.norm(run.states[-1].now.p_back - points(run.params), axis=1)
    return float(np.median(off[np.isfinite(off)])) if np.isfinite(off).any() else 0.0


def shot_gap(params: Any) -> float:
    corners = street().edges.reshape(-1, 3)
    R, t, K = camera(params)
    X, Y, _ = R @ corners.T + t[:, None]
    depth = R[2] @ np.array(params.target) + t[2]
    flat = np.array([X, Y]).T * K[0, 0] / depth + K[:2, 2]
    return float(np.linalg.norm(pixels(params, corners) - flat, axis=1).max())


def moves(run: Run) -> tuple[np.ndarray, np.ndarray]:
    """Each point's place and shift by the lens."""
    state = run.states[STAGES.index("distort")].now
    seen = np.isfinite(state.xy_bent).all(axis=1)
    return state.xy[seen], (state.xy_bent - state.xy)[seen]


def pixels_at(run: Run) -> np.ndarray:
    return run.states[STAGES.index("pixels")].now.uv
