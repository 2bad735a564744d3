"""Rigid motions: SO(3) and SE(3) with exp and log that hold at the identity and at half a turn.

A motion `T_a_b` is 4x4 and takes points of frame b to frame a: `p_a = apply(T_a_b, p_b)`. A twist
is (v, w): the translational part in metres first, then the rotation vector in radians.
Reference: Solà, Deray and Atchuthan, A micro Lie theory for state estimation in robotics, 2018,
appendices B and D.
"""

import numpy as np
from jaxtyping import Float

R_ROWS_DOWN = np.diag([1.0, -1.0, -1.0])
"""Lays a picture into the plane z = 0, its rows along -y, seen from above as it is."""
R_UPRIGHT = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0]])
"""Stands a picture up, its rows along -z; a camera looks along +y."""


def motion(R: Float[np.ndarray, "3 3"], t: Float[np.ndarray, "3"]) -> Float[np.ndarray, "4 4"]:
    """Return the 4x4 motion with this rotation and this translation in metres.

    Examples:
        >>> motion(np.eye(3), np.array([1.0, 2.0, 3.0]))[:3, 3].tolist()
        [1.0, 2.0, 3.0]
    """
    T = np.eye(4)
    T[:3, :3] = R
    T[:3, 3] = t
    return T


def inverse(T: Float[np.ndarray, "4 4"]) -> Float[np.ndarray, "4 4"]:
    """Return the inverse of a rigid motion, T_b_a of T_a_b; wrong for one that scales or shears.

    Examples:
        >>> T_a_b = exp_se3(np.array([1.0, 2.0, 3.0, 0.1, 0.2, 0.3]))
        >>> bool(np.allclose(inverse(T_a_b) @ T_a_b, np.eye(4)))
        True
    """
    R = T[:3, :3]
    return motion(R.T, -R.T @ T[:3, 3])


def apply(T: Float[np.ndarray, "4 4"], p: Float[np.ndarray, "*n 3"]) -> Float[np.ndarray, "*n 3"]:
    """Return the points moved by a motion or an affine map: T_a_b takes p_b to p_a.

    Examples:
        >>> T_world_body = motion(exp_so3(np.array([0.0, 0.0, np.pi / 2])), np.array([5.0, 0, 0]))
        >>> apply(T_world_body, np.array([[1.0, 0.0, 0.0]])).round(6).tolist()
        [[5.0, 1.0, 0.0]]
    """
    return p @ T[:3, :3].T + T[:3, 3]


def turn_about(p: Float[np.ndarray, "3"], R: Float[np.ndarray, "3 3"]) -> Float[np.ndarray, "4 4"]:
    """Return the motion that turns by a rotation and leaves the point where it is."""
    return motion(R, p - R @ p)


def angle_between(v: Float[np.ndarray, "3"], w: Float[np.ndarray, "3"]) -> float:
    """Return the angle between two vectors in [0, pi] radians, exact at both ends; 0 beside zero.

    Examples:
        >>> round(angle_between(np.array([2.0, 0.0, 0.0]), np.array([1.0, 1.0, 0.0])) / np.pi, 6)
        0.25
    """
    return float(np.arctan2(np.linalg.norm(np.cross(v, w)), v @ w))


def across(
    n: Float[np.ndarray, "*k 3"],
) -> tuple[Float[np.ndarray, "*k 3"], Float[np.ndarray, "*k 3"]]:
    """Return two unit vectors at right angles to a unit vector and to each other."""
    least = np.eye(3)[np.abs(n).argmin(axis=-1)]
    u = np.cross(n, least)
    u = u / np.linalg.norm(u, axis=-1, keepdims=True)
    return u, np.cross(n, u)


def rotation_angle(R: Float[np.ndarray, "3 3"]) -> float:
    """Return the angle of a rotation in [0, pi] radians, exact at both ends.

    Examples:
        >>> round(rotation_angle(exp_so3(np.array([0.0, 0.0, 0.5]))), 6)
        0.5
    """
    return float(np.arctan2(np.linalg.norm(_twice_vee(R)), np.trace(R) - 1.0))


def skew(w: Float[np.ndarray, "*k 3"]) -> Float[np.ndarray, "*k 3 3"]:
    """Return the matrix whose product with x is the cross product w x x, for each vector w."""
    W = np.zeros((*w.shape[:-1], 3, 3))
    W[..., 2, 1], W[..., 0, 2], W[..., 1, 0] = w[..., 0], w[..., 1], w[..., 2]
    return W - np.swapaxes(W, -1, -2)


def exp_so3(w: Float[np.ndarray, "3"]) -> Float[np.ndarray, "3 3"]:
    """Return the rotation by |w| radians about w (Rodrigues' formula); zero gives the identity.

    Examples:
        >>> (exp_so3(np.array([0.0, 0.0, np.pi / 2])).round(6) + 0.0).tolist()
        [[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]
    """
    angle = np.linalg.norm(w)
    W = skew(w)
    return np.eye(3) + _sine_term(angle) * W + _cosine_term(angle) * W @ W


def turns(w: Float[np.ndarray, "*k 3"]) -> Float[np.ndarray, "*k 3 3"]:
    """Return the rotation by |w| radians about each of many vectors, as `exp_so3` for one."""
    angle = np.sqrt(np.square(w).sum(axis=-1))[..., None, None]
    W = skew(w)
    return (
        np.eye(3) + np.sinc(angle / np.pi) * W + 0.5 * np.sinc(0.5 * angle / np.pi) ** 2 * (W @ W)
    )


def log_so3(R: Float[np.ndarray, "3 3"]) -> Float[np.ndarray, "3"]:
    """Return the rotation vector of R, one of length at most pi such that `exp_so3` gives R back.

    Examples:
        >>> log_so3(exp_so3(np.array([0.1, -0.2, 0.3]))).round(6).tolist()
        [0.1, -0.2, 0.3]
    """
    w, *v = _unit_quaternion(R)
    sine = np.linalg.norm(v)
    if sine < 1e-12:  # the limit of the factor below; w is 1 to the last digit here
        return 2.0 * np.array(v)
    return 2.0 * np.arctan2(sine, w) / sine * np.array(v)


def exp_se3(twist: Float[np.ndarray, "6"]) -> Float[np.ndarray, "4 4"]:
    """Return the motion along a screw: twist = (v, w), metres and radians."""
    v, w = twist[:3], twist[3:]
    return motion(exp_so3(w), _left_jacobian(w) @ v)


def log_se3(T: Float[np.ndarray, "4 4"]) -> Float[np.ndarray, "6"]:
    """Return the twist (v, w) of a rigid motion, such that `exp_se3` gives the motion back.

    Examples:
        >>> log_se3(motion(np.eye(3), np.array([1.0, 2.0, 3.0]))).tolist()
        [1.0, 2.0, 3.0, 0.0, 0.0, 0.0]
    """
    w = log_so3(T[:3, :3])
    return np.concatenate([np.linalg.solve(_left_jacobian(w), T[:3, 3]), w])


def _sine_term(angle: float | np.floating) -> float:
    """sin(a) / a, which is 1 at zero."""
    return float(np.sinc(angle / np.pi))


def _cosine_term(angle: float | np.floating) -> float:
    """(1 - cos a) / a^2 = 2 sin^2(a/2) / a^2: 1/2 at zero, without loss of digits near it."""
    return 0.5 * float(np.sinc(0.5 * angle / np.pi)) ** 2


def _left_jacobian(w: np.ndarray) -> np.ndarray:
    """Return the matrix V of SE(3)'s exp (Solà et al., eq. 174)."""
    angle = np.linalg.norm(w)
    cubic = (angle - np.sin(angle)) / angle**3 if angle > 1e-3 else 1.0 / 6.0 - angle**2 / 120.0
    W = skew(w)
    return np.eye(3) + _cosine_term(angle) * W + cubic * W @ W


def _twice_vee(R: np.ndarray) -> np.ndarray:
    return np.array([R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1]])


def _unit_quaternion(R: np.ndarray) -> np.ndarray:
    """(w, x, y, z) with w >= 0, from its largest component: no division by a small number."""
    x, y, z = _twice_vee(R)
    a, b, c = np.diag(R)
    four_q_times_q = np.array(  # row i is 4 q_i q
        [
            [1 + a + b + c, x, y, z],
            [x, 1 + a - b - c, R[0, 1] + R[1, 0], R[2, 0] + R[0, 2]],
            [y, R[0, 1] + R[1, 0], 1 - a + b - c, R[1, 2] + R[2, 1]],
            [z, R[2, 0] + R[0, 2], R[1, 2] + R[2, 1], 1 - a - b + c],
        ]
    )
    q = four_q_times_q[np.argmax(np.diag(four_q_times_q))]
    return q / np.linalg.norm(q) * (1.0 if q[0] >= 0 else -1.0)
