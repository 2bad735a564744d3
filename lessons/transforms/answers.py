"""Wrong answers that students give to the exercises of this lesson, and right ones that are written differently."""

import numpy as np

from workbench.exercise.model import Mistake
from workbench.geometry.motions import exp_so3, motion, skew
from workbench.geometry.rotations import euler_to_matrix, rotation_about, rotation_from_axis_angle

# invert_rigid ---------------------------------------------------------------------------------------------------------


def negated_translation(T_a_b: np.ndarray) -> np.ndarray:
    """(R^T, -t)."""
    return motion(T_a_b[:3, :3].T, -T_a_b[:3, 3])


def rotation_kept(T_a_b: np.ndarray) -> np.ndarray:
    """(R, -t)."""
    return motion(T_a_b[:3, :3], -T_a_b[:3, 3])


def translation_turned_forwards(T_a_b: np.ndarray) -> np.ndarray:
    """(R^T, -R t)."""
    return motion(T_a_b[:3, :3].T, -T_a_b[:3, :3] @ T_a_b[:3, 3])


def sign_forgotten(T_a_b: np.ndarray) -> np.ndarray:
    """(R^T, R^T t)."""
    return motion(T_a_b[:3, :3].T, T_a_b[:3, :3].T @ T_a_b[:3, 3])


def all_transposed(T_a_b: np.ndarray) -> np.ndarray:
    """The transpose of the 4x4."""
    return T_a_b.T.copy()


INVERT_MISTAKES = (
    Mistake(
        "negated translation",
        negated_translation,
        "You returned (R^T, -t). The translation is undone in frame a, but R^T turns it first: it must be -R^T t.",
    ),
    Mistake(
        "rotation kept",
        rotation_kept,
        "You returned (R, -t): the translation is negated, but the rotation still turns from b to a. Its inverse is R^T.",
    ),
    Mistake(
        "translation turned forwards",
        translation_turned_forwards,
        "Your rotation is R^T, but your translation is -R t. The inverse has -R^T t: solve p_a = R p_b + t for p_b.",
    ),
    Mistake(
        "sign forgotten",
        sign_forgotten,
        "Your translation is R^T t; it has the wrong sign. Solve p_a = R p_b + t for p_b: p_b = R^T p_a - R^T t.",
    ),
    Mistake(
        "all transposed",
        all_transposed,
        "You transposed the whole 4×4, so that t lies in the last row. Only its 3×3 rotation is orthogonal.",
    ),
)


def invert_by_elimination(T_a_b: np.ndarray) -> np.ndarray:
    """Any inverse of the 4x4 will do."""
    return np.linalg.inv(T_a_b)


def invert_by_parts(T_a_b: np.ndarray) -> np.ndarray:
    """The motion to the origin first, then the turn back."""
    back, turn = np.eye(4), np.eye(4)
    back[:3, 3] = -T_a_b[:3, 3]
    turn[:3, :3] = T_a_b[:3, :3].T
    return turn @ back


# rotation_from_axis_angle ---------------------------------------------------------------------------------------------


def clockwise(axis: np.ndarray, angle: float) -> np.ndarray:
    """R^T."""
    return rotation_from_axis_angle(axis, -angle)


def degrees_taken(axis: np.ndarray, angle: float) -> np.ndarray:
    """Converts what is in radians already."""
    return rotation_from_axis_angle(axis, np.radians(angle))


def axis_not_unit(axis: np.ndarray, angle: float) -> np.ndarray:
    """Rodrigues' formula with the axis as it comes."""
    W = skew(axis)
    return np.eye(3) + np.sin(angle) * W + (1 - np.cos(angle)) * W @ W


def square_forgotten(axis: np.ndarray, angle: float) -> np.ndarray:
    """I + sin(angle) K, the formula for small angles."""
    return np.eye(3) + np.sin(angle) * skew(axis / np.linalg.norm(axis))


def projection_forgotten(axis: np.ndarray, angle: float) -> np.ndarray:
    """cos(angle) I + sin(angle) K, without (1 - cos) a a^T."""
    return np.cos(angle) * np.eye(3) + np.sin(angle) * skew(axis / np.linalg.norm(axis))


def zero_axis_divides(axis: np.ndarray, angle: float) -> np.ndarray:
    """Divides by a length of zero."""
    W = skew(axis / np.linalg.norm(axis))
    return np.eye(3) + np.sin(angle) * W + (1 - np.cos(angle)) * W @ W


def zero_axis_is_identity(axis: np.ndarray, angle: float) -> np.ndarray:
    """Makes an answer up."""
    return exp_so3(axis * (angle / np.linalg.norm(axis))) if np.any(axis) else np.eye(3)


AXIS_ANGLE_MISTAKES = (
    Mistake(
        "clockwise",
        clockwise,
        "Your R is the transpose of the right one: it turns clockwise. Look along the axis towards you: a positive angle "
        "turns counter-clockwise (right-hand rule).",
    ),
    Mistake(
        "degrees taken",
        degrees_taken,
        "You took the angle for degrees. It is in radians: do not convert it.",
    ),
    Mistake(
        "axis not of unit length",
        axis_not_unit,
        "Your formula uses the axis as it comes; it holds for a unit axis only. Divide by its length first.",
    ),
    Mistake(
        "square forgotten",
        square_forgotten,
        "You returned I + sin(angle) K. That holds for small angles; the term (1 - cos(angle)) K K is missing.",
    ),
    Mistake(
        "projection forgotten",
        projection_forgotten,
        "You returned cos(angle) I + sin(angle) K. The part along the axis must stay: add (1 - cos(angle)) a a^T.",
    ),
    Mistake(
        "zero axis divides",
        zero_axis_divides,
        "All is right but the axis of length zero, by which you divide: it names no direction. Raise a ValueError.",
    ),
    Mistake(
        "zero axis is the identity",
        zero_axis_is_identity,
        "All is right but the axis of length zero, for which you return the identity. The contract asks for a ValueError: "
        "an answer made up hides the error of whoever calls you.",
    ),
)


def turn_by_quaternion(axis: np.ndarray, angle: float) -> np.ndarray:
    """By way of the unit quaternion (cos, sin a) of half the angle."""
    length = np.sqrt(np.sum(np.square(axis)))
    if length == 0:
        raise ValueError("a zero axis")
    x, y, z = np.sin(angle / 2) * np.asarray(axis) / length
    w = np.cos(angle / 2)
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )


def turn_column_by_column(axis: np.ndarray, angle: float) -> np.ndarray:
    """Rodrigues' formula for vectors, applied to x, y and z."""
    length = np.linalg.norm(axis)
    if not length > 0:
        raise ValueError("a zero axis")
    n = axis / length
    turned = [v * np.cos(angle) + np.cross(n, v) * np.sin(angle) + n * (n @ v) * (1 - np.cos(angle)) for v in np.eye(3)]
    return np.array(turned).T


# euler_to_matrix ------------------------------------------------------------------------------------------------------


def product_turned_round(angles: np.ndarray, order: str) -> np.ndarray:
    """Lower and upper case swapped."""
    return euler_to_matrix(angles, order.swapcase())  # type: ignore[arg-type]


def case_ignored(angles: np.ndarray, order: str) -> np.ndarray:
    """Always about fixed axes."""
    return euler_to_matrix(angles, order.lower())  # type: ignore[arg-type]


def always_carried(angles: np.ndarray, order: str) -> np.ndarray:
    """Always about the body's own axes."""
    return euler_to_matrix(angles, order.upper())  # type: ignore[arg-type]


def each_clockwise(angles: np.ndarray, order: str) -> np.ndarray:
    """Every elementary turn transposed."""
    return euler_to_matrix(-angles, order)  # type: ignore[arg-type]


def in_degrees(angles: np.ndarray, order: str) -> np.ndarray:
    """Converts what is in radians already."""
    return euler_to_matrix(np.radians(angles), order)  # type: ignore[arg-type]


def angles_of_axes(angles: np.ndarray, order: str) -> np.ndarray:
    """Reads the angles as those about x, y and z, whatever the order of the letters."""
    return euler_to_matrix(np.array([angles["xyz".index(letter)] for letter in order.lower()]), order)  # type: ignore[arg-type]


def order_ignored(angles: np.ndarray, order: str) -> np.ndarray:
    """Always Rz Ry Rx."""
    return euler_to_matrix(angles, "XYZ" if order.isupper() else "xyz")


def any_order_taken(angles: np.ndarray, order: str) -> np.ndarray:
    """Multiplies whatever letters come."""
    first, second, third = (rotation_about(a, v) for a, v in zip(order.lower(), angles, strict=True))  # type: ignore[arg-type]
    return first @ second @ third if order.isupper() else third @ second @ first


EULER_MISTAKES = (
    Mistake(
        "product turned round",
        product_turned_round,
        "Your product is the wrong way round: you turn about the body's own axes for lower case, and about fixed ones for "
        "upper case. “xyz” is Rz Ry Rx: each new turn about a fixed axis is multiplied on the left.",
    ),
    Mistake(
        "case ignored",
        case_ignored,
        "You always turn about fixed axes. Upper case means the body's own axes, which earlier turns have carried along: "
        "“XYZ” is Rx Ry Rz.",
    ),
    Mistake(
        "always carried",
        always_carried,
        "You always turn about the body's own axes. Lower case means the fixed axes of the world: “xyz” is Rz Ry Rx.",
    ),
    Mistake(
        "clockwise",
        each_clockwise,
        "Each of your three turns is the transpose of the right one: it turns clockwise. About z, the right-hand rule "
        "takes x to y.",
    ),
    Mistake("degrees taken", in_degrees, "You took the angles for degrees. They are in radians: do not convert them."),
    Mistake(
        "angles of axes",
        angles_of_axes,
        "You read the angles as those about x, y and z. They come in the order of the letters: in “zyx” the first one is "
        "about z.",
    ),
    Mistake("order ignored", order_ignored, "You always turn about x, y, z. Read the letters: “zxz” begins with z."),
    Mistake(
        "any order taken",
        any_order_taken,
        "All is right but that you accept any letters. Two equal letters in a row, other letters or mixed cases are none "
        "of the 24 orders: raise a ValueError.",
    ),
)


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


def euler_by_quaternions(angles: np.ndarray, order: str) -> np.ndarray:
    """The product of three quaternions, each as a 4x4 matrix."""
    if len(order) != 3 or set(order.lower()) - set("xyz") or order.lower()[1] in (order.lower()[0], order.lower()[2]):
        raise ValueError(order)
    if order != order.lower() and order != order.upper():
        raise ValueError(order)
    q = np.array([1.0, 0.0, 0.0, 0.0])
    pairs = list(zip(order.lower(), angles, strict=True))
    for letter, angle in pairs if order.isupper() else pairs[::-1]:  # on the right, in the order of the product
        w, (x, y, z) = np.cos(angle / 2), np.sin(angle / 2) * np.array([letter == "x", letter == "y", letter == "z"])
        q = np.array([[w, -x, -y, -z], [x, w, z, -y], [y, -z, w, x], [z, y, -x, w]]) @ q
    w, v = q[0], q[1:]
    K = np.array([[0, -v[2], v[1]], [v[2], 0, -v[0]], [-v[1], v[0], 0]])
    return np.eye(3) + 2 * w * K + 2 * K @ K
