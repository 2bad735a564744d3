"""Rotations by their other names: an axis and an angle, 24 kinds of Euler angles, quaternions.

All stand for the matrix `R_a_b` that takes coordinates of frame b to frame a. Angles are radians,
positive counter-clockwise about their axis (right-hand rule). Quaternions are (w, x, y, z). An
Euler order is three letters, with one angle for each. Lower case turns about the fixed axes of the
world, one after the other; upper case about the body's own axes, carried along by the earlier
turns. So "xyz" with (a, b, c) is Rz(c) Ry(b) Rx(a), and "XYZ" is Rx(a) Ry(b) Rz(c). Another order
raises ValueError.
Reference: Murray, Li and Sastry, A Mathematical Introduction to Robotic Manipulation, 1994, eq.
2.14. Diebel, Representing Attitude, 2006, 5.1; his R takes world to body. Solà, Quaternion
kinematics for the error-state Kalman filter, 2017, 2.5.
"""

from typing import Literal, get_args

import numpy as np
from jaxtyping import Float

from workbench.geometry.motions.rigid import exp_so3, log_so3

Axis = Literal["x", "y", "z"]
FixedOrder = Literal[
    "xyz", "xzy", "yxz", "yzx", "zxy", "zyx", "xyx", "xzx", "yxy", "yzy", "zxz", "zyz"
]
CarriedOrder = Literal[
    "XYZ", "XZY", "YXZ", "YZX", "ZXY", "ZYX", "XYX", "XZX", "YXY", "YZY", "ZXZ", "ZYZ"
]
EulerOrder = Literal[FixedOrder, CarriedOrder]
EULER_ORDERS: tuple[EulerOrder, ...] = get_args(EulerOrder)

# Sine of the angle between the first and the third axis below which they count as one
_LOCKED = 1e-12


def rotation_from_axis_angle(
    axis: Float[np.ndarray, "3"], angle: float
) -> Float[np.ndarray, "3 3"]:
    """Return the rotation by an angle about an axis of any length (Rodrigues; Murray et al., 2.14).

    Raises:
        ValueError: If the axis is zero or not finite; it names no direction.

    Examples:
        >>> R = rotation_from_axis_angle(np.array([0.0, 0.0, 2.0]), np.pi / 2)  # of any length
        >>> (R @ np.array([1.0, 0.0, 0.0])).round(6).tolist()
        [0.0, 1.0, 0.0]
    """
    length = np.linalg.norm(axis)
    if not 0.0 < length < np.inf:
        raise ValueError(f"the axis {axis} names no direction")
    return exp_so3(axis * (angle / length))


def axis_angle_from_rotation(R: Float[np.ndarray, "3 3"]) -> tuple[Float[np.ndarray, "3"], float]:
    """Return the unit axis, x for the identity, and the angle in [0, pi] of a rotation."""
    w = log_so3(R)
    largest = np.abs(w).max()
    if largest == 0.0:
        return np.array([1.0, 0.0, 0.0]), 0.0
    axis = w / largest  # first, so that the square of a tiny angle does not vanish
    return axis / np.linalg.norm(axis), float(np.linalg.norm(w))


def rotation_about(axis: Axis, angle: float) -> Float[np.ndarray, "3 3"]:
    """Return the rotation by an angle in radians about one coordinate axis."""
    return _about("xyz".index(axis), angle)


def euler_to_matrix(angles: Float[np.ndarray, "3"], order: EulerOrder) -> Float[np.ndarray, "3 3"]:
    """Return the rotation that three successive turns make (Diebel 2006, 5.1).

    Examples:
        >>> angles = np.array([0.1, 0.2, 0.3])
        >>> bool(np.allclose(euler_to_matrix(angles, "xyz"), euler_to_matrix(angles[::-1], "ZYX")))
        True
    """
    (i, j, k), carried = _letters(order)
    first, second, third = _about(i, angles[0]), _about(j, angles[1]), _about(k, angles[2])
    return first @ second @ third if carried else third @ second @ first


def matrix_to_euler(R: Float[np.ndarray, "3 3"], order: EulerOrder) -> Float[np.ndarray, "3"]:
    """Return three angles that make this rotation, in the order of the letters.

    The middle angle is in [-pi/2, pi/2] where the three letters differ, in [0, pi] where the first
    comes back; the others are in [-pi, pi]. In gimbal lock only the sum or the difference of the
    outer angles is determined; the last one is then zero.

    Examples:
        >>> R = euler_to_matrix(np.array([0.1, 0.2, 0.3]), "ZYX")
        >>> matrix_to_euler(R, "ZYX").round(6).tolist()
        [0.1, 0.2, 0.3]
    """
    (i, j, k), carried = _letters(order)
    if not carried:  # the same product, read from its other end
        i, k = k, i
    n_third = R[:, k]
    away = 3 - i - j  # the axis that is neither the first nor the second
    sign = 1.0 if (j - i) % 3 == 1 else -1.0
    aside = np.hypot(n_third[j], n_third[away])
    if k == i:
        a = np.arctan2(n_third[j], -sign * n_third[away])
        b = np.arctan2(aside, n_third[i])
    else:
        a = np.arctan2(-sign * n_third[j], n_third[k])
        b = np.arctan2(sign * n_third[i], aside)
    if aside > _LOCKED:
        c = _angle_about(k, _about(j, b).T @ _about(i, a).T @ R)
    elif carried:
        a = _angle_about(i, R @ _about(j, b).T)
        c = 0.0
    else:
        a = 0.0
        c = _angle_about(k, _about(j, b).T @ R)
    return np.array([a, b, c] if carried else [c, b, a])


def euler_axes(angles: Float[np.ndarray, "3"], order: EulerOrder) -> Float[np.ndarray, "3 3"]:
    """Return the axes in the world, as rows: a change of angles turns by `change @ axes`."""
    (i, j, k), carried = _letters(order)
    if not carried:
        i, k = k, i
        angles = angles[::-1]
    R_first = _about(i, angles[0])
    axes = np.array([np.eye(3)[i], R_first[:, j], R_first @ _about(j, angles[1])[:, k]])
    return axes if carried else axes[::-1]


def gimbal_margin(angles: Float[np.ndarray, "3"], order: EulerOrder) -> float:
    """Return the sine of the angle between the first and third axis: 0 in gimbal lock."""
    first, _, third = euler_axes(angles, order)
    return float(np.linalg.norm(np.cross(first, third)))


def locked_family(
    angles: Float[np.ndarray, "3"], order: EulerOrder, turns: Float[np.ndarray, "n"]
) -> Float[np.ndarray, "n 3"]:
    """Return triples of the same rotation in gimbal lock, the first angles differing by `turns`.

    Raises:
        ValueError: If the angles are not in gimbal lock, where no such family exists.
    """
    if gimbal_margin(angles, order) > _LOCKED:
        raise ValueError(f"{np.degrees(angles)} degrees in order {order} are not in gimbal lock")
    first, _, third = euler_axes(angles, order)
    return angles + np.outer(turns, [1.0, 0.0, -np.sign(first @ third)])


def other_triple(angles: Float[np.ndarray, "3"], order: EulerOrder) -> Float[np.ndarray, "3"]:
    """Return the second triple that makes the same rotation; there always is one, lock or not."""
    (i, _, k), _ = _letters(order)
    a, b, c = angles
    return np.array([a + np.pi, -b if i == k else np.pi - b, c + np.pi])


def triple_past_lock(
    angles: Float[np.ndarray, "3"], order: EulerOrder, turn: float
) -> Float[np.ndarray, "3"]:
    """Return the nearest triple that turns the body on in the direction lost in gimbal lock."""
    first, second, _ = euler_axes(angles, order)
    R = exp_so3(turn * np.cross(first, second)) @ euler_to_matrix(angles, order)
    triple = matrix_to_euler(R, order)
    return min(
        (triple, other_triple(triple, order)), key=lambda triple: angles_apart(triple, angles)
    )


def angles_apart(triple: Float[np.ndarray, "3"], other: Float[np.ndarray, "3"]) -> float:
    """Return by how much the angle differs that differs most, radians, modulo full turns.

    Examples:
        >>> round(angles_apart(np.array([3.0, 0.0, 0.0]), np.array([3.0 - 2 * np.pi, 0.1, 0.0])), 6)
        0.1
    """
    return float(np.abs((triple - other + np.pi) % (2.0 * np.pi) - np.pi).max())


def quaternion_from_matrix(R: Float[np.ndarray, "3 3"]) -> Float[np.ndarray, "4"]:
    """Return the unit quaternion (w, x, y, z) of a rotation that has w >= 0.

    Examples:
        >>> quaternion_from_matrix(rotation_about("z", np.pi)).round(6).tolist()
        [0.0, 0.0, 0.0, 1.0]
    """
    w = log_so3(R)
    half = 0.5 * np.linalg.norm(w)
    return np.concatenate([[max(np.cos(half), 0.0)], 0.5 * np.sinc(half / np.pi) * w])


def matrix_from_quaternion(q: Float[np.ndarray, "4"]) -> Float[np.ndarray, "3 3"]:
    """Return the rotation of a quaternion (w, x, y, z) of any length (Solà 2017, 2.5).

    Raises:
        ValueError: If the quaternion is zero or not finite.
    """
    length = np.linalg.norm(q)
    if not 0.0 < length < np.inf:
        raise ValueError(f"the quaternion {q} names no rotation")
    w, x, y, z = q / length
    return np.array(
        [
            [w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z],
        ]
    )


def quaternion_product(
    p: Float[np.ndarray, "4"], q: Float[np.ndarray, "4"]
) -> Float[np.ndarray, "4"]:
    """Return the quaternion of the rotation that turns by q first and then by p: R(p) R(q).

    Examples:
        >>> p, q = (quaternion_from_matrix(rotation_about(axis, 0.3)) for axis in ("x", "z"))
        >>> R = matrix_from_quaternion(quaternion_product(p, q))
        >>> bool(np.allclose(R, rotation_about("x", 0.3) @ rotation_about("z", 0.3)))
        True
    """
    return np.concatenate(
        [[p[0] * q[0] - p[1:] @ q[1:]], p[0] * q[1:] + q[0] * p[1:] + np.cross(p[1:], q[1:])]
    )


def great_circle(
    q_start: Float[np.ndarray, "4"], q_end: Float[np.ndarray, "4"], t: float
) -> Float[np.ndarray, "4"]:
    """Return the unit quaternion at the fraction t of the arc between two, signs as they are.

    With q and -q, one rotation, the arc may be the long way; of opposite ones the start is
    returned.
    Reference: Shoemake, Animating rotation with quaternion curves, SIGGRAPH 1985.
    """
    angle = 2.0 * np.arctan2(np.linalg.norm(q_end - q_start), np.linalg.norm(q_end + q_start))
    if np.sin(angle) < 1e-12 and angle > 1.0:
        return q_start
    near = np.sinc((1 - t) * angle / np.pi) * (1 - t)
    far = np.sinc(t * angle / np.pi) * t
    q = near * q_start + far * q_end
    return q / np.linalg.norm(q)


def slerp(
    q_start: Float[np.ndarray, "4"], q_end: Float[np.ndarray, "4"], t: float
) -> Float[np.ndarray, "4"]:
    """Return the unit quaternion at the fraction t of the shortest turn, at constant speed.

    Examples:
        >>> q_start, q_end = (quaternion_from_matrix(rotation_about("z", a)) for a in (0.0, 0.8))
        >>> R = matrix_from_quaternion(slerp(q_start, q_end, 0.25))
        >>> bool(np.allclose(R, rotation_about("z", 0.2)))
        True
    """
    return great_circle(q_start, q_end if q_start @ q_end >= 0 else -q_end, t)


def _letters(order: str) -> tuple[tuple[int, int, int], bool]:
    """Return the three axes as indices, and whether the body carries them along."""
    if order not in EULER_ORDERS:
        raise ValueError(f"{order!r} is not an Euler order; there are 24, such as 'xyz' and 'ZYX'")
    i, j, k = ("xyz".index(letter) for letter in order.lower())
    return (i, j, k), order.isupper()


def _about(axis: int, angle: float) -> np.ndarray:
    R = np.eye(3)
    j, k = (axis + 1) % 3, (axis + 2) % 3
    R[j, j] = R[k, k] = np.cos(angle)
    R[k, j] = np.sin(angle)
    R[j, k] = -R[k, j]
    return R


def _angle_about(axis: int, R: np.ndarray) -> float:
    """Return the angle of a rotation that is known to be about this axis."""
    j, k = (axis + 1) % 3, (axis + 2) % 3
    return float(np.arctan2(R[k, j] - R[j, k], R[j, j] + R[k, k]))
