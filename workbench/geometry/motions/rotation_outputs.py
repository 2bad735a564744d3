"""Numbers that a network can put out for a rotation: decoding, and the gradient back through it.

Batches throughout: outputs are (n, k), rotations (n, d, d) with d = 2 or 3. Every `pullback` takes
the gradient of a loss by the entries of R to that by the numbers.
References: Zhou et al., On the continuity of rotation representations in neural networks, CVPR
2019, section 4 and eq. 15. Levinson et al., An analysis of SVD for deep rotation estimation,
NeurIPS 2020, section 3.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np
import scipy
from jaxtyping import Float

from workbench.geometry.motions.alignment import nearest_rotation
from workbench.geometry.motions.rigid import skew, turns

Rotations = Float[np.ndarray, "n d d"]
Decode = Callable[[np.ndarray], np.ndarray]
"""decode(outputs) -> rotations."""

_FLAT = 1e-3  # radians: below, a series is taken for (a - sin a) / a³


@dataclass(frozen=True, eq=False, kw_only=True)
class Representation:
    """One way to write rotations as numbers: those of no turn, a decoder, its pullback.

    `numbers` are asked for where the loss is on them: a choice where several mean one rotation.
    """

    start: Float[np.ndarray, " k"]
    decode: Decode
    pullback: Callable[[np.ndarray, np.ndarray], np.ndarray]
    numbers: Callable[[np.ndarray], np.ndarray]


def rotation_from_six(y: Float[np.ndarray, "n 6"]) -> Float[np.ndarray, "n 3 3"]:
    """Return the rotations with two vectors, made orthonormal (Gram-Schmidt), as first columns.

    Vectors that are zero or parallel give what is not finite (Zhou et al. 2019, eq. 15).
    """
    u, v, _, _, _ = _six(y)
    return np.stack([u, v, np.cross(u, v)], axis=2)


def degrees_apart(R: Rotations, other: Rotations) -> Float[np.ndarray, " n"]:
    """Return the angle between each two matrices, from their difference, up to 180 degrees."""
    half = np.linalg.norm(R - other, axis=(1, 2)) / np.sqrt(8)
    return np.degrees(2 * np.arcsin(np.clip(np.nan_to_num(half, nan=1.0), 0, 1)))


def _unit(v: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    length = np.linalg.norm(v, axis=1, keepdims=True)
    with np.errstate(divide="ignore", invalid="ignore"):
        return v / length, length


def _through_unit(slope: np.ndarray, u: np.ndarray, length: np.ndarray) -> np.ndarray:
    """Return the gradient by v, given that by u = v / |v|."""
    return (slope - u * (u * slope).sum(axis=1, keepdims=True)) / length


def _six(y: np.ndarray) -> tuple[np.ndarray, ...]:
    u, length_u = _unit(y[:, :3])
    along = (u * y[:, 3:]).sum(axis=1, keepdims=True)
    v, length_v = _unit(y[:, 3:] - along * u)
    return u, v, length_u, length_v, along


def _six_back(y: np.ndarray, slope: np.ndarray) -> np.ndarray:
    u, v, length_u, length_v, along = _six(y)
    by_third = slope[:, :, 2]
    by_u, by_v = slope[:, :, 0] + np.cross(v, by_third), slope[:, :, 1] + np.cross(by_third, u)
    by_rest = _through_unit(by_v, v, length_v)
    part = (u * by_rest).sum(axis=1, keepdims=True)
    by_u = by_u - along * by_rest - y[:, 3:] * part
    return np.concatenate([_through_unit(by_u, u, length_u), by_rest - u * part], axis=1)


def _nine(y: np.ndarray) -> tuple[np.ndarray, ...]:
    U, s, Vt = np.linalg.svd(y.reshape(-1, 3, 3))
    signs = np.ones_like(s)
    signs[:, 2] = np.linalg.det(U @ Vt)
    return U, s * signs, signs[:, :, None] * Vt


def _nine_back(y: np.ndarray, slope: np.ndarray) -> np.ndarray:
    U, s, Vt = _nine(y)  # M = U diag(s) Vt with U Vt a rotation: the last s may be negative
    inner = U.swapaxes(1, 2) @ slope @ Vt.swapaxes(1, 2)
    sums = s[:, :, None] + s[:, None, :]
    turns = (inner - inner.swapaxes(1, 2)) / np.where(np.abs(sums) < 1e-9, 1e-9, sums)
    return (U @ turns @ Vt).reshape(-1, 9)


def _quaternion_decode(y: np.ndarray) -> np.ndarray:
    w, x, y_, z = _unit(y)[0].T
    rows = [
        [1 - 2 * (y_ * y_ + z * z), 2 * (x * y_ - w * z), 2 * (x * z + w * y_)],
        [2 * (x * y_ + w * z), 1 - 2 * (x * x + z * z), 2 * (y_ * z - w * x)],
        [2 * (x * z - w * y_), 2 * (y_ * z + w * x), 1 - 2 * (x * x + y_ * y_)],
    ]
    return np.moveaxis(np.array(rows), 2, 0)


def _quaternion_back(y: np.ndarray, slope: np.ndarray) -> np.ndarray:
    q, length = _unit(y)
    w, v = q[:, :1], q[:, 1:]
    odd = np.stack([slope[:, k, j] - slope[:, j, k] for j, k in ((1, 2), (2, 0), (0, 1))], axis=1)
    even = slope + slope.swapaxes(1, 2)
    trace = np.trace(slope, axis1=1, axis2=2)[:, None]
    by_v = 2 * (w * odd + np.einsum("nij,nj->ni", even, v) - 2 * trace * v)
    return _through_unit(
        np.concatenate([2 * (v * odd).sum(axis=1, keepdims=True), by_v], axis=1), q, length
    )


def _vector_back(y: np.ndarray, slope: np.ndarray) -> np.ndarray:
    a = np.linalg.norm(y, axis=1)[:, None, None]
    K = skew(y)
    safe = np.maximum(a, _FLAT)
    third = np.where(a < _FLAT, 1 / 6 - a * a / 120, (safe - np.sin(safe)) / safe**3)
    # Left Jacobian: dR = [J dy]x R
    J = np.eye(3) + 0.5 * np.sinc(a / (2 * np.pi)) ** 2 * K + third * K @ K
    turn = slope @ turns(y).swapaxes(1, 2)
    w = np.stack([turn[:, k, j] - turn[:, j, k] for j, k in ((1, 2), (2, 0), (0, 1))], axis=1)
    return np.einsum("nij,ni->nj", J, w)


def _about(axis: int, a: np.ndarray) -> np.ndarray:
    return turns(np.outer(a, np.eye(3)[axis]))


def _euler_decode(y: np.ndarray) -> np.ndarray:
    return _about(2, y[:, 2]) @ _about(1, y[:, 1]) @ _about(0, y[:, 0])


def _euler_back(y: np.ndarray, slope: np.ndarray) -> np.ndarray:
    R_x, R_y, R_z = (_about(axis, y[:, axis]) for axis in range(3))
    first = R_z @ R_y
    about_x, about_y, about_z = skew(np.eye(3))
    R = first @ R_x
    changes = (R @ about_x, first @ about_y @ R_x, about_z @ R)
    return np.stack([(slope * change).sum(axis=(1, 2)) for change in changes], axis=1)


def _plane(c: np.ndarray, s: np.ndarray) -> np.ndarray:
    return np.stack([np.stack([c, -s], axis=1), np.stack([s, c], axis=1)], axis=1)


def _plane_slopes(slope: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the gradient by the cosine and by the sine."""
    return slope[:, 0, 0] + slope[:, 1, 1], slope[:, 1, 0] - slope[:, 0, 1]


def _angle_back(y: np.ndarray, slope: np.ndarray) -> np.ndarray:
    by_c, by_s = _plane_slopes(slope)
    return (by_s * np.cos(y[:, 0]) - by_c * np.sin(y[:, 0]))[:, None]


def _pair_back(y: np.ndarray, slope: np.ndarray) -> np.ndarray:
    return _through_unit(np.stack(_plane_slopes(slope), axis=1), *_unit(y))


def _half_decode(y: np.ndarray) -> np.ndarray:
    c, s = _unit(y)[0].T
    return _plane(c * c - s * s, 2 * c * s)


def _half_back(y: np.ndarray, slope: np.ndarray) -> np.ndarray:
    u, length = _unit(y)
    c, s = u.T
    by_c, by_s = _plane_slopes(slope)
    return _through_unit(
        2 * np.stack([c * by_c + s * by_s, c * by_s - s * by_c], axis=1), u, length
    )


def _half_numbers(R: np.ndarray) -> np.ndarray:
    half = np.arctan2(R[:, 1, 0], R[:, 0, 0]) / 2
    return np.stack([np.cos(half), np.sin(half)], axis=1)


def _as(name: str) -> Callable[[np.ndarray], np.ndarray]:
    def numbers(R: np.ndarray) -> np.ndarray:
        rotation = scipy.spatial.transform.Rotation.from_matrix(R)
        if name == "quaternion":
            return rotation.as_quat(canonical=True)[:, [3, 0, 1, 2]]
        return rotation.as_euler("xyz") if name == "Euler" else rotation.as_rotvec()

    return numbers


IN_PLANE: Mapping[str, Representation] = {
    "one number": Representation(
        start=np.zeros(1),
        decode=lambda y: _plane(np.cos(y[:, 0]), np.sin(y[:, 0])),
        pullback=_angle_back,
        numbers=lambda R: np.arctan2(R[:, 1, 0], R[:, 0, 0])[:, None],
    ),
    "half the angle": Representation(
        start=np.array([1.0, 0.0]), decode=_half_decode, pullback=_half_back, numbers=_half_numbers
    ),
    "cosine and sine": Representation(
        start=np.array([1.0, 0.0]),
        decode=lambda y: _plane(*_unit(y)[0].T),
        pullback=_pair_back,
        numbers=lambda R: R[:, :, 0],
    ),
}
"""An angle in (-pi, pi]; cosine and sine of half of it, of either sign; or of itself."""

IN_SPACE: Mapping[str, Representation] = {
    "Euler": Representation(
        start=np.zeros(3), decode=_euler_decode, pullback=_euler_back, numbers=_as("Euler")
    ),
    "axis-angle": Representation(
        start=np.zeros(3), decode=turns, pullback=_vector_back, numbers=_as("vector")
    ),
    "quaternion": Representation(
        start=np.eye(4)[0],
        decode=_quaternion_decode,
        pullback=_quaternion_back,
        numbers=_as("quaternion"),
    ),
    "6D": Representation(
        start=np.eye(3)[:2].ravel(),
        decode=rotation_from_six,
        pullback=_six_back,
        numbers=lambda R: np.concatenate([R[:, :, 0], R[:, :, 1]], axis=1),
    ),
    "9D": Representation(
        start=np.eye(3).ravel(),
        decode=lambda y: nearest_rotation(y.reshape(-1, 3, 3)),
        pullback=_nine_back,
        numbers=lambda R: R.reshape(-1, 9),
    ),
}
"""Angles about fixed x, y, z; a rotation vector; (w, x, y, z), w >= 0; two columns; all nine."""


def random_rotations(
    count: int, dimension: int, largest: float, *, rng: np.random.Generator
) -> tuple[Rotations, Float[np.ndarray, "n w"]]:
    """Return uniformly random rotations by at most an angle, and their angles or rotation vectors.

    Reference: Miles, On random rotations in R^3, Biometrika 1965: angles have density (1 - cos a) /
    pi.
    """
    if dimension == 2:
        a = rng.uniform(-largest, largest, (count, 1))
        return IN_PLANE["one number"].decode(a), a
    table = np.linspace(0, largest, 257)
    a = np.interp(rng.uniform(0, largest - np.sin(largest), count), table - np.sin(table), table)
    w = _unit(rng.normal(size=(count, 3)))[0] * a[:, None]
    return turns(w), w
