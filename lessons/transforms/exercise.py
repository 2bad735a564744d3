"""The exercises of this lesson: invert a motion, turn about an axis, multiply Euler angles."""

from collections.abc import Iterator

import numpy as np
from jaxtyping import Float

from lessons.transforms import answers
from workbench.exercise.judging import degrees_between, left_alone, motion_verdict, refused, rotation_verdict, worst
from workbench.exercise.model import Exercise, Function, Verdict, band, check, fail, full, partial
from workbench.geometry import rotations
from workbench.geometry.motions import exp_so3, inverse, motion
from workbench.geometry.rotations import EULER_ORDERS

STUDENTS, GRADERS = 11, 7310  # seeds of what a student sees run, and of what only a grader does

# invert_rigid ---------------------------------------------------------------------------------------------------------


def invert_rigid(T_a_b: Float[np.ndarray, "4 4"]) -> Float[np.ndarray, "4 4"]:
    """Return the motion T_b_a that takes points back from frame a to frame b.

    With T_a_b = (R, t) a point goes p_a = R p_b + t, metres. The inverse undoes that for every point.

    Args:
        T_a_b: A rigid motion: rotation R in the upper left 3x3, translation t (metres) in the last column, and
            (0, 0, 0, 1) as last row. It may be the identity. Nobody gives you a motion that scales or shears.

    Returns:
        T_b_a, again a rigid motion, in a new array: the input stays as it is.
    """
    return inverse(T_a_b)


def some_motions(seed: int, n: int = 5) -> Iterator[np.ndarray]:
    """Yield motions that turn by 20 to 160 degrees and shift by half a metre to two."""
    rng = np.random.default_rng(seed)
    for _ in range(n):
        axis, shift = rng.normal(size=(2, 3))
        w = axis / np.linalg.norm(axis) * np.radians(rng.uniform(20, 160))
        yield motion(exp_so3(w), shift / np.linalg.norm(shift) * rng.uniform(0.5, 2.0))


def some_points(seed: int, n: int = 50, size: float = 1.0) -> np.ndarray:
    """Return points in a cube of this half edge, metres."""
    return np.random.default_rng(seed).uniform(-size, size, (n, 3))


INVERT_HINT = "Solve p_a = R p_b + t for p_b."


@check(3)
def there_and_back(candidate: Function) -> Verdict:
    """A point that goes from b to a and back is where it was."""
    return worst(
        motion_verdict(candidate(T) @ T, np.eye(4), INVERT_HINT, p=some_points(STUDENTS))
        for T in some_motions(STUDENTS)
    )


@check(1)
def twice_is_nothing(candidate: Function) -> Verdict:
    """The inverse of the inverse is the motion itself."""
    return worst(motion_verdict(candidate(candidate(T)), T, INVERT_HINT) for T in some_motions(STUDENTS + 1))


@check(1)
def motion_is_left_alone(candidate: Function) -> Verdict:
    """The motion that comes in is not changed."""
    T = next(some_motions(STUDENTS + 2))
    return left_alone(candidate, motion_verdict(candidate(T), inverse(T), INVERT_HINT))


@check(3, public=False)
def products_turn_round(candidate: Function) -> Verdict:
    """The inverse of a product is the product of the inverses, the other way round."""
    verdicts = []
    for T_a_b, T_b_c in zip(some_motions(GRADERS), some_motions(GRADERS + 1), strict=True):
        T_c_a = candidate(T_b_c) @ candidate(T_a_b)
        verdicts += [motion_verdict(candidate(T_a_b @ T_b_c), T_c_a, INVERT_HINT), _right(T_a_b, candidate(T_a_b))]
    return worst(verdicts)


@check(2, public=False)
def special_motions(candidate: Function) -> Verdict:
    """The identity, a pure translation, half a turn and a motion a kilometre long are inverted."""
    far = np.array([800.0, -500.0, 300.0])
    cases = (np.eye(4), motion(np.eye(3), far), motion(np.diag([-1.0, 1.0, -1.0]), far))
    return worst(_right(T, candidate(T)) for T in (*cases, motion(exp_so3(np.array([0.0, 0.0, 1.0])), far)))


def _right(T: np.ndarray, T_back: np.ndarray) -> Verdict:
    return motion_verdict(T_back @ T, np.eye(4), INVERT_HINT, p=some_points(GRADERS))


# rotation_from_axis_angle ---------------------------------------------------------------------------------------------


def rotation_from_axis_angle(axis: Float[np.ndarray, "3"], angle: float) -> Float[np.ndarray, "3 3"]:
    """Return the rotation matrix R that turns by an angle about an axis through the origin.

    R turns vectors actively, v_turned = R @ v, counter-clockwise where the axis points at you (right-hand rule): a
    quarter turn about z takes x to y.

    Args:
        axis: Direction of the axis. Its length has no meaning and need not be 1; it is not zero.
        angle: Radians; any sign, also more than a turn.

    Returns:
        R, with R^T R = I and determinant 1.

    Raises:
        ValueError: If the axis has length zero: it names no direction.
    """
    return rotations.rotation_from_axis_angle(axis, float(angle))


TURN_HINT = "What lies along the axis stays, what lies across it turns; the length of the axis must not matter."


def some_turns(seed: int, n: int = 6) -> Iterator[tuple[np.ndarray, float]]:
    """Yield axes of lengths from 0.2 to 5 and angles of 20 to 160 degrees of either sign."""
    rng = np.random.default_rng(seed)
    for k in range(n):
        axis = rng.normal(size=3)
        axis *= rng.uniform(0.2, 0.7) ** (-1) ** k / np.linalg.norm(axis)
        yield axis, float(np.radians(rng.uniform(20, 160)) * (-1) ** (k // 2))


@check(2)
def quarter_turn(candidate: Function) -> Verdict:
    """A quarter turn about z takes x to y."""
    right = np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
    return rotation_verdict(candidate(np.array([0.0, 0.0, 1.0]), np.pi / 2), right, TURN_HINT)


@check(2)
def any_axis(candidate: Function) -> Verdict:
    """About axes in all directions and of all lengths, R turns by the right angle."""
    return worst(
        rotation_verdict(candidate(axis, angle), rotations.rotation_from_axis_angle(axis, angle), TURN_HINT)
        for axis, angle in some_turns(STUDENTS)
    )


@check(1)
def axis_is_left_alone(candidate: Function) -> Verdict:
    """The axis that comes in is not changed."""
    axis, angle = next(some_turns(STUDENTS + 1))
    right = rotations.rotation_from_axis_angle(axis, angle)
    return left_alone(candidate, rotation_verdict(candidate(axis, angle), right, TURN_HINT))


@check(2, public=False)
def turned_axis(candidate: Function) -> Verdict:
    """With the axis turned by Q, R becomes Q R Q^T."""
    verdicts = []
    for (axis, angle), T in zip(some_turns(GRADERS), some_motions(GRADERS, 6), strict=True):
        Q = T[:3, :3]
        R = rotations.rotation_from_axis_angle(axis, angle)
        verdicts.append(rotation_verdict(candidate(Q @ axis, angle), Q @ R @ Q.T, TURN_HINT))
    return worst(verdicts)


@check(1, public=False)
def special_angles(candidate: Function) -> Verdict:
    """No turn, half a turn and more than a full turn are rotations, and an angle of 1e-6 is not lost."""
    axis = np.array([0.3, -0.4, 1.2])
    verdicts = [
        rotation_verdict(candidate(axis, v), rotations.rotation_from_axis_angle(axis, v), f"Angle {v:.3g}. {TURN_HINT}")
        for v in (0.0, np.pi, -np.pi, 7.5)
    ]
    tiny = degrees_between(candidate(axis, 1e-6), np.eye(3)) / np.degrees(1e-6)
    kept = band("Relative error of an angle of 1e-6", abs(tiny - 1.0), "", good=1e-3, fair=1e-1, hint=TURN_HINT)
    return worst([*verdicts, kept])


@check(2, public=False)
def zero_axis(candidate: Function) -> Verdict:
    """An axis of length zero is refused."""
    return refused(candidate, np.zeros(3), 0.5, what="A zero axis")


# euler_to_matrix ------------------------------------------------------------------------------------------------------


def euler_to_matrix(angles: Float[np.ndarray, "3"], order: str) -> Float[np.ndarray, "3 3"]:
    """Return the rotation matrix R that three successive turns make.

    R turns vectors actively, v_turned = R @ v. Each turn follows the right-hand rule.

    Args:
        angles: Radians, one for each letter, in the order of the letters: the first letter's turn is made first.
        order: Three letters. Lower case turns about the fixed axes of the world, so that "xyz" with angles (a, b, c) is
            Rz(c) @ Ry(b) @ Rx(a). Upper case turns about the body's own axes, which the earlier turns have carried
            along: "XYZ" is Rx(a) @ Ry(b) @ Rz(c).

    Returns:
        R, also in gimbal lock, where it is as good a rotation as any.

    Raises:
        ValueError: If the order is none of the 24: three letters of x, y and z in one case, no letter twice in a row
            ("xyx" is one, "xxy" and "xYz" are none).
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
    return rotation_verdict(candidate(angles, order), euler_to_matrix(angles, order), f'Order "{order}". {EULER_HINT}')


@check(2)
def one_turn(candidate: Function) -> Verdict:
    """A single turn is about the axis of its letter, by the right angle."""
    one = np.radians(40.0) * np.eye(3)
    return worst(_ordered(candidate, one[k], order) for order in ("xyz", "ZYX", "yzx") for k in range(3))


@check(2)
def fixed_axes(candidate: Function) -> Verdict:
    """Lower case turns about the fixed axes of the world: xyz and zxy."""
    return worst(_ordered(candidate, some_angles(STUDENTS), order) for order in ("xyz", "zxy"))


@check(2)
def carried_axes(candidate: Function) -> Verdict:
    """Upper case turns about the body's own axes: XYZ and ZYX."""
    return worst(_ordered(candidate, some_angles(STUDENTS + 1), order) for order in ("XYZ", "ZYX"))


@check(2, public=False)
def all_orders(candidate: Function) -> Verdict:
    """All 24 orders give the right rotation."""
    verdicts = {order: _ordered(candidate, some_angles(GRADERS + k), order) for k, order in enumerate(EULER_ORDERS)}
    right = [order for order, verdict in verdicts.items() if verdict.share == 1.0]
    if len(right) == len(verdicts):
        return full("24 of 24 orders are right.")
    said = f"{len(right)} of 24 orders are right. {worst(verdicts.values()).message}"
    return partial(0.5, said) if len(right) >= 16 else fail(said)


@check(1, public=False)
def gimbal_lock(candidate: Function) -> Verdict:
    """At a pitch of 90 degrees the first and the third angle turn about one axis, and only their sum counts."""
    a, c, more = 0.4, -0.9, 0.7
    R, other = (candidate(np.array([a + d, np.pi / 2, c - d]), "XYZ") for d in (0.0, more))
    right = euler_to_matrix(np.array([a, np.pi / 2, c]), "XYZ")
    return worst(rotation_verdict(got, right, EULER_HINT) for got in (R, other))


@check(1, public=False)
def unknown_orders(candidate: Function) -> Verdict:
    """Orders that are none of the 24 are refused, and the angles are left alone."""
    kept = left_alone(candidate, _ordered(candidate, some_angles(GRADERS), "zyx"))
    asked = (refused(candidate, some_angles(GRADERS), order, what=f'The order "{order}"') for order in ("xxy", "xYz"))
    return worst([*asked, kept])


EXERCISES = (
    Exercise(
        name="invert_rigid",
        lesson="transforms",
        slot="invert_rigid",
        reference=invert_rigid,
        task="Write the inverse of a rigid motion. The lesson takes the body back with it at the last step: with the right "
        "inverse it stands on its ghost again, with (R^T, -t) it does not.",
        checks=(there_and_back, twice_is_nothing, motion_is_left_alone, products_turn_round, special_motions),
        mistakes=answers.INVERT_MISTAKES,
        alternatives=(answers.invert_by_elimination, answers.invert_by_parts),
        examples=(
            (
                "invert_rigid(np.array([[1.0, 0, 0, 2], [0, 1, 0, 0], [0, 0, 1, -3], [0, 0, 0, 1]]))",
                "[[1, 0, 0, -2], [0, 1, 0, 0], [0, 0, 1, 3], [0, 0, 0, 1]]",
            ),
            (
                "invert_rigid(np.array([[0.0, -1, 0, 2], [1, 0, 0, 5], [0, 0, 1, 0], [0, 0, 0, 1]]))",
                "[[0, 1, 0, -5], [-1, 0, 0, 2], [0, 0, 1, 0], [0, 0, 0, 1]]",
            ),
        ),
    ),
    Exercise(
        name="rotation_from_axis_angle",
        lesson="transforms",
        slot="rotation_from_axis_angle",
        reference=rotation_from_axis_angle,
        task="Write Rodrigues' formula: the rotation by an angle about an axis. Set the lesson's knob half to 'move between "
        "two poses' and it turns the body from one pose to the other about one axis, at constant speed.",
        checks=(quarter_turn, any_axis, axis_is_left_alone, turned_axis, special_angles, zero_axis),
        mistakes=answers.AXIS_ANGLE_MISTAKES,
        alternatives=(answers.turn_by_quaternion, answers.turn_column_by_column),
        examples=(
            (
                "rotation_from_axis_angle(np.array([0.0, 0.0, 1.0]), np.pi / 2)",
                "[[0, -1, 0], [1, 0, 0], [0, 0, 1]]",
            ),
            (
                "rotation_from_axis_angle(np.array([2.0, 2.0, 2.0]), 2 * np.pi / 3)",
                "[[0, 0, 1], [1, 0, 0], [0, 1, 0]]",
            ),
        ),
    ),
    Exercise(
        name="euler_to_matrix",
        lesson="transforms",
        slot="euler_to_matrix",
        reference=euler_to_matrix,
        task="Write the rotation that three Euler angles stand for, in all 24 orders. The lesson turns the body by it, one "
        "angle after the other.",
        checks=(one_turn, fixed_axes, carried_axes, all_orders, gimbal_lock, unknown_orders),
        mistakes=answers.EULER_MISTAKES,
        alternatives=(answers.euler_in_loops, answers.euler_by_quaternions),
        examples=(
            ('euler_to_matrix(np.array([np.pi / 2, 0.0, np.pi / 2]), "xyz")', "[[0, 0, 1], [1, 0, 0], [0, 1, 0]]"),
            ('euler_to_matrix(np.array([np.pi / 2, 0.0, np.pi / 2]), "XYZ")', "[[0, -1, 0], [0, 0, -1], [1, 0, 0]]"),
        ),
    ),
)
