"""What students hand in for euler_to_matrix."""

import itertools

import numpy as np

NAMED = {
    "wrong_fixed_and_carried_swapped": "product turned round",
    "wrong_first_letter_decides": "any order taken",
    "wrong_no_refusal": "any order taken",
    "wrong_transposed_turns_and_no_refusal": "clockwise",
}

ORDERS = [a + b + c for a, b, c in itertools.product("xyz", repeat=3) if a != b and b != c]


def refuse(order):
    if order.lower() not in ORDERS or not (order.islower() or order.isupper()):
        raise ValueError(f"unknown order {order}")


def Rx(a):
    c, s = np.cos(a), np.sin(a)
    return np.array([[1, 0, 0], [0, c, -s], [0, s, c]])


def Ry(a):
    c, s = np.cos(a), np.sin(a)
    return np.array([[c, 0, s], [0, 1, 0], [-s, 0, c]])


def Rz(a):
    c, s = np.cos(a), np.sin(a)
    return np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])


TURNS = {"x": Rx, "y": Ry, "z": Rz}


def turns(angles, order):
    return [TURNS[letter](a) for letter, a in zip(order.lower(), angles)]


def product(angles, order):
    A, B, C = turns(angles, order)
    return C @ B @ A if order.islower() else A @ B @ C


def right_dictionary(angles, order):
    refuse(order)
    return product(angles, order)


def right_reversed_extrinsic(angles, order):
    refuse(order)
    if order.isupper():
        return right_reversed_extrinsic(angles[::-1], order[::-1].lower())
    return product(angles, order)


def right_multi_dot(angles, order):
    refuse(order)
    R = turns(angles, order)
    return np.linalg.multi_dot(R[::-1] if order.islower() else R)


def right_reduce(angles, order):
    from functools import reduce

    refuse(order)
    return reduce(
        np.matmul, turns(angles, order) if order.isupper() else reversed(turns(angles, order))
    )


# wrong ---------------------------------------------------------------------------------------------------------------


def wrong_fixed_and_carried_swapped(angles, order):
    refuse(order)
    A, B, C = turns(angles, order)
    return A @ B @ C if order.islower() else C @ B @ A


def wrong_no_refusal(angles, order):
    A, B, C = turns(angles, order)
    return A @ B @ C if order.isupper() else C @ B @ A


def wrong_transposed_turns_and_no_refusal(angles, order):
    return product([-a for a in angles], order)


def wrong_asserted(angles, order):
    assert order.lower() in ORDERS and (order.islower() or order.isupper())
    return product(angles, order)


def wrong_key_error(angles, order):
    known = {o: o for o in ORDERS} | {o.upper(): o for o in ORDERS}
    return product(angles, known[order] if order.islower() else known[order].upper())


def wrong_mixed_case_accepted(angles, order):
    if order.lower() not in ORDERS:
        raise ValueError("bad order")
    return product(angles, order)


def wrong_first_letter_decides(angles, order):
    A, B, C = turns(angles, order)
    return C @ B @ A if order[0].islower() else A @ B @ C


def wrong_angles_wrapped_in_place(angles, order):
    refuse(order)
    angles += np.pi
    angles %= 2 * np.pi
    angles -= np.pi
    return product(angles, order)


def wrong_refuses_gimbal_lock(angles, order):
    refuse(order)
    if abs(abs(angles[1]) - np.pi / 2) < 1e-6:
        raise ValueError("gimbal lock")
    return product(angles, order)


def wrong_swallowed(angles, order):
    try:
        refuse(order)
        return product(angles, order)
    except ValueError:
        return np.eye(3)


def wrong_end_not_compared(angles, order):
    if (
        len(order) != 3
        or not (order.islower() or order.isupper())
        or set(order.lower()) - set("xyz")
    ):
        raise ValueError(order)
    if order[0] == order[1]:
        raise ValueError(order)
    return product(angles, order)


def wrong_only_three_letters_read(angles, order):
    if (
        not (order.islower() or order.isupper())
        or set(order.lower()) - set("xyz")
        or len(order) < 3
    ):
        raise ValueError(order)
    if order[0] == order[1] or order[1] == order[2]:
        raise ValueError(order)
    return product(angles, order[:3])


def wrong_case_of_the_first_two(angles, order):
    low = order.lower()
    if (
        len(low) != 3
        or set(low) - set("xyz")
        or low[1] in (low[0], low[2])
        or order[0].islower() != order[1].islower()
    ):
        raise ValueError(order)
    return product(angles, order)


def wrong_lock_of_equal_ends(angles, order):
    refuse(order)
    if order[0] == order[2] and abs(np.sin(angles[1])) < 1e-9:
        return np.eye(3)
    return product(angles, order)


def wrong_angles_cut_off(angles, order):
    refuse(order)
    return product(np.clip(angles, -np.pi, np.pi), order)
