"""Write the rotation that three Euler angles stand for, in all 24 orders. The lesson turns its
rings by it, and the body wherever Euler angles are blended.
"""

import numpy as np
from jaxtyping import Float

from lessons.rotations.exercises import STUDENTS
from workbench.exercise import (
    Function,
    Verdict,
    alternative,
    check,
    contract,
    mistake,
    rotation_verdict,
    worst,
)
from workbench.geometry.motions import rotations
from workbench.geometry.motions.rotations import EULER_ORDERS, rotation_about


@contract(
    slot="euler_to_matrix",
    forbid=("scipy.spatial.transform",),
    examples=(
        (
            'euler_to_matrix(np.array([np.pi / 2, 0.0, np.pi / 2]), "xyz")',
            "[[0, 0, 1], [1, 0, 0], [0, 1, 0]]",
        ),
        (
            'euler_to_matrix(np.array([np.pi / 2, 0.0, np.pi / 2]), "XYZ")',
            "[[0, -1, 0], [0, 0, -1], [1, 0, 0]]",
        ),
    ),
)
def euler_to_matrix(angles: Float[np.ndarray, "3"], order: str) -> Float[np.ndarray, "3 3"]:
    """Return the rotation matrix R that three successive turns make.

    R turns vectors actively, v_turned = R @ v. Each turn follows the right-hand rule.

    Args:
        angles: Radians, one for each letter, in the order of the letters: the first letter's turn
            is made first.
        order: Three letters. Lower case turns about the fixed axes of the world, so that "xyz" with
            angles (a, b, c) is Rz(c) @ Ry(b) @ Rx(a). Upper case turns about the body's own axes,
            which the earlier turns have carried along: "XYZ" is Rx(a) @ Ry(b) @ Rz(c).

    Returns:
        R, also in gimbal lock, where it is as good a rotation as any.

    Raises:
        ValueError: If the order is none of the 24: three letters of x, y and z in one case, no
            letter twice in a row ("xyx" is one, "xxy" and "xYz" are none).
    """
    if order not in EULER_ORDERS:
        raise ValueError(f"{order!r} is none of the 24 orders")
    return rotations.euler_to_matrix(angles, order)


EULER_HINT = 'Compare with "xyz": Rz(c) @ Ry(b) @ Rx(a), and "XYZ": Rx(a) @ Ry(b) @ Rz(c).'


def some_angles(seed: int) -> np.ndarray:
    """Return three angles of 20 to 70 degrees, of either sign."""
    rng = np.random.default_rng(seed)
    return np.radians(rng.uniform(20, 70, 3)) * rng.choice([-1.0, 1.0], 3)


def _ordered(candidate: Function, angles: np.ndarray, order: str) -> Verdict:
    right = rotations.euler_to_matrix(angles, order)  # type: ignore[arg-type]
    return rotation_verdict(candidate(angles, order), right, f'Order "{order}". {EULER_HINT}')


@check(2)
def one_turn(candidate: Function) -> Verdict:
    """A single turn is about the axis of its letter, by the right angle."""
    angles = np.radians(40.0) * np.eye(3)
    return worst(
        _ordered(candidate, angles[k], order) for order in ("xyz", "ZYX", "yzx") for k in range(3)
    )


@check(2)
def fixed_axes(candidate: Function) -> Verdict:
    """Lower case turns about the fixed axes of the world: xyz and zxy."""
    return worst(_ordered(candidate, some_angles(STUDENTS), order) for order in ("xyz", "zxy"))


@check(2)
def carried_axes(candidate: Function) -> Verdict:
    """Upper case turns about the body's own axes: XYZ and ZYX."""
    return worst(_ordered(candidate, some_angles(STUDENTS + 1), order) for order in ("XYZ", "ZYX"))


@mistake(
    "Your product is the wrong way round: you turn about the body's own axes for lower case, and"
    " about fixed ones for upper case. “xyz” is Rz Ry Rx: each new turn about a fixed axis is"
    " multiplied on the left."
)
def product_turned_round(angles: np.ndarray, order: str) -> np.ndarray:
    """Lower and upper case swapped."""
    return rotations.euler_to_matrix(angles, order.swapcase())  # type: ignore[arg-type]


@mistake(
    "You always turn about fixed axes. Upper case means the body's own axes, which earlier turns"
    " have carried along: “XYZ” is Rx Ry Rz."
)
def case_ignored(angles: np.ndarray, order: str) -> np.ndarray:
    """Always about fixed axes."""
    return rotations.euler_to_matrix(angles, order.lower())  # type: ignore[arg-type]


@mistake(
    "You always turn about the body's own axes. Lower case means the fixed axes of the world: “xyz”"
    " is Rz Ry Rx."
)
def always_carried(angles: np.ndarray, order: str) -> np.ndarray:
    """Always about the body's own axes."""
    return rotations.euler_to_matrix(angles, order.upper())  # type: ignore[arg-type]


@mistake(
    "Each of your three turns is the transpose of the right one: it turns clockwise. About z, the"
    " right-hand rule takes x to y."
)
def clockwise(angles: np.ndarray, order: str) -> np.ndarray:
    """Every elementary turn transposed."""
    return rotations.euler_to_matrix(-angles, order)  # type: ignore[arg-type]


@mistake("You took the angles for degrees. They are in radians: do not convert them.")
def degrees_taken(angles: np.ndarray, order: str) -> np.ndarray:
    """Converts what is in radians already."""
    return rotations.euler_to_matrix(np.radians(angles), order)  # type: ignore[arg-type]


@mistake(
    "You read the angles as those about x, y and z. They come in the order of the letters: in “zyx”"
    " the first one is about z."
)
def angles_of_axes(angles: np.ndarray, order: str) -> np.ndarray:
    """Reads the angles as those about x, y and z, whatever the order of the letters."""
    return rotations.euler_to_matrix(
        np.array([angles["xyz".index(letter)] for letter in order.lower()]),
        order,  # type: ignore[arg-type]
    )


@mistake("You always turn about x, y, z. Read the letters: “zxz” begins with z.")
def order_ignored(angles: np.ndarray, order: str) -> np.ndarray:
    """Always Rz Ry Rx."""
    return rotations.euler_to_matrix(angles, "XYZ" if order.isupper() else "xyz")


@mistake(
    "All is right but that you accept any letters. Two equal letters in a row, other letters or"
    " mixed cases are none of the 24 orders: raise a ValueError."
)
def any_order_taken(angles: np.ndarray, order: str) -> np.ndarray:
    """Multiplies whatever letters come."""
    first, second, third = (
        rotation_about(a, v)  # type: ignore[arg-type]
        for a, v in zip(order.lower(), angles, strict=False)
    )
    return first @ second @ third if order.isupper() else third @ second @ first


@alternative
def euler_in_loops(angles: np.ndarray, order: str) -> np.ndarray:
    """One turn after the other, on the left or on the right."""
    known = [a + b + c for a in "xyz" for b in "xyz" for c in "xyz" if a != b != c]
    if order.lower() not in known or order not in (order.lower(), order.upper()):
        raise ValueError(f"no order: {order}")
    R = np.eye(3)
    for letter, angle in zip(order, angles, strict=True):
        i = "xyz".index(letter.lower())
        K = np.cross(np.eye(3)[i], np.eye(3)).T
        turn = np.eye(3) + np.sin(angle) * K + (1 - np.cos(angle)) * (K @ K)
        R = turn @ R if letter.islower() else R @ turn
    return R


@alternative
def euler_by_quaternions(angles: np.ndarray, order: str) -> np.ndarray:
    """The product of three quaternions, each as a 4x4 matrix."""
    if (
        len(order) != 3
        or set(order.lower()) - set("xyz")
        or order.lower()[1] in (order.lower()[0], order.lower()[2])
    ):
        raise ValueError(order)
    if order != order.lower() and order != order.upper():
        raise ValueError(order)
    q = np.array([1.0, 0.0, 0.0, 0.0])
    pairs = list(zip(order.lower(), angles, strict=True))
    for letter, angle in (
        pairs if order.isupper() else pairs[::-1]
    ):  # on the right, in the order of the product
        w = np.cos(angle / 2)
        x, y, z = np.sin(angle / 2) * np.array([letter == "x", letter == "y", letter == "z"])
        q = np.array([[w, -x, -y, -z], [x, w, z, -y], [y, -z, w, x], [z, y, -x, w]]) @ q
    w = q[0]
    v = q[1:]
    K = np.array([[0, -v[2], v[1]], [v[2], 0, -v[0]], [-v[1], v[0], 0]])
    return np.eye(3) + 2 * w * K + 2 * K @ K
