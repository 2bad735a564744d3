"""Write which four motions an essential matrix allows. The lesson tries them one after the other,
and goes on with the one that has most points in front of both cameras.
"""

import itertools

import numpy as np
from jaxtyping import Float

from lessons.epipolar.exercises import STUDENTS
from workbench.exercise import (
    Function,
    Verdict,
    alternative,
    band,
    beside,
    check,
    contract,
    fail,
    left_alone,
    mistake,
    number,
    worst,
)
from workbench.exercise.judging import degrees_between
from workbench.geometry.motions import exp_so3, motion, skew
from workbench.geometry.two_views import essential


@contract(
    slot="essential_to_poses",
    examples=(
        (
            "essential_to_poses(array([[0., 0, 0], [0, 0, -1], [0, 1, 0]]))[:, :3, 3].min(axis=0)",
            "[-1, 0, 0]",
        ),
        (
            "essential_to_poses(array([[0., 0, 0], [0, 0, -1], [0, 1, 0]]))[:, :3, 3].max(axis=0)",
            "[1, 0, 0]",
        ),
        (
            "essential_to_poses(array([[0., 0, 0], [0, 0, -1], [0, 1, 0]]))[:, :3, :3].max(axis=0)",
            "np.eye(3)",
        ),
    ),
    either=lambda Ts: [np.asarray(Ts)[list(order)] for order in itertools.permutations(range(4))],
)
def essential_to_poses(E: Float[np.ndarray, "3 3"]) -> Float[np.ndarray, "4 4 4"]:
    """Return the four motions T_second_first with E = [t]x R at some scale, in any order; each t
    has length one.

    Two rotations, and with each of them t forth and back. Where E has noise they are near those of
    the E without.

    Args:
        E: An essential matrix: two equal singular values and a zero, but for some noise; of any
            scale and sign.

    Returns:
        Four 4x4 motions, each with R in the upper left, t in the last column and (0, 0, 0, 1) as
        last row. Every R is a rotation with determinant 1.
    """
    return essential.essential_to_poses(E)


HINT = (
    "With E = U S V^T they are U W V^T and U W^T V^T, t = ± the last column of U; det U and det V"
    " have to be 1."
)


def some_motions(seed: int, n: int = 6) -> list[tuple[np.ndarray, np.ndarray]]:
    """Return essential matrices of many scales and both signs, with the motions they were made
    of.
    """
    rng = np.random.default_rng(seed)
    made = []
    for k in range(n):
        axis, t = rng.normal(size=(2, 3))
        R = exp_so3(rng.uniform(0.1, 1.2) * axis / np.linalg.norm(axis))
        t = t / np.linalg.norm(t)
        made.append(((-1.0) ** k * rng.uniform(0.3, 4.0) * skew(t) @ R, motion(R, t)))
    return made


def is_motion(T: np.ndarray) -> bool:
    """Tell whether a 4x4 is a rotation, mirrored or not, and a translation."""
    if not np.isfinite(T).all() or np.abs(T[3] - [0, 0, 0, 1]).max() > 1e-5:
        return False
    return bool(np.abs(T[:3, :3].T @ T[:3, :3] - np.eye(3)).max() < 1e-5)


def apart(T: np.ndarray, right: np.ndarray) -> float:
    """Return by how many degrees the rotations differ, or by how many hundredths the translations,
    if that is more.
    """
    if np.linalg.det(T[:3, :3]) < 0:
        return 180.0
    return max(
        degrees_between(T[:3, :3], right[:3, :3]),
        100 * float(np.linalg.norm(T[:3, 3] - right[:3, 3])),
    )


def judged(Ts: np.ndarray, rights: np.ndarray, good: float = 0.01, fair: float = 0.5) -> Verdict:
    """Judge whether each of some right motions is among the answers, by the one that is farthest
    from all of them.
    """
    for T in Ts:
        if not is_motion(T):
            if np.isfinite(T).all() and np.allclose(T[:3, :3].T @ T[:3, :3], np.eye(3), atol=1e-6):
                last = ", ".join(number(value) for value in T[3])
                return fail(
                    f"The last row of one of yours is ({last}), right is (0, 0, 0, 1). {HINT}"
                )
            told = (
                beside(T[:3, :3].T @ T[:3, :3], np.eye(3), HINT, "R^T R")
                if np.isfinite(T).all()
                else HINT
            )
            return fail(f"One of yours is no motion. {told}")
        det = float(np.linalg.det(T[:3, :3]))
        if det < 0:
            return fail(
                "One of your rotations mirrors."
                f" {beside(np.array([det]), np.ones(1), HINT, 'Its determinant')}"
            )
        if abs((long := float(np.linalg.norm(T[:3, 3]))) - 1) > 1e-5:
            return fail(beside(np.array([long]), np.ones(1), HINT, "The length of one of your t"))
    offs = np.array([[apart(T, right) for T in Ts] for right in rights])
    k = int(offs.min(axis=1).argmax())
    nearest = Ts[offs[k].argmin()]
    by_t = degrees_between(nearest[:3, :3], rights[k][:3, :3]) < 0.01
    part, name = (np.s_[:3, 3], "its t") if by_t else (np.s_[:3, :3], "its R")
    told = beside(nearest[part], rights[k][part], HINT, name)
    return band(
        "The motion that you miss most is off by",
        float(offs[k].min()),
        "degrees, or hundredths of t",
        good=good,
        fair=fair,
        hint=f"Of your nearest, {told}",
    )


@check(3)
def the_true_motion(candidate: Function) -> Verdict:
    """The motion that E was made of is among the four, and so is the one with t turned round."""
    return worst(
        judged(candidate(E), np.stack([T, motion(T[:3, :3], -T[:3, 3])]))
        for E, T in some_motions(STUDENTS)
    )


@check(3)
def all_four(candidate: Function) -> Verdict:
    """All four motions are there, whatever the scale and sign of E."""
    return worst(
        judged(candidate(E), essential.essential_to_poses(E)) for E, _ in some_motions(STUDENTS + 1)
    )


@check(1)
def matrices_are_left_alone(candidate: Function) -> Verdict:
    """The matrix that comes in is not changed."""
    E, _ = some_motions(STUDENTS + 2, 1)[0]
    return left_alone(candidate, judged(candidate(E), essential.essential_to_poses(E)))


W = np.array([[0.0, -1, 0], [1, 0, 0], [0, 0, 1]])


def four(Rs: tuple[np.ndarray, np.ndarray], t: np.ndarray) -> np.ndarray:
    """Return both rotations with t forth and back."""
    Ts = np.tile(np.eye(4), (4, 1, 1))
    Ts[:, :3, :3] = Rs[0], Rs[0], Rs[1], Rs[1]
    Ts[:, :3, 3] = t, -t, t, -t
    return Ts


def proper(E: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return U and V^T with determinants 1."""
    U, _, Vt = np.linalg.svd(E)
    return U * np.sign(np.linalg.det(U)), Vt * np.sign(np.linalg.det(Vt))


@mistake(
    "Some of your rotations have determinant −1: they mirror. Turn the sign of U or V round where"
    " its determinant is −1."
)
def signs_not_mended(E: np.ndarray) -> np.ndarray:
    """Takes U and V as they come."""
    U, _, Vt = np.linalg.svd(E)
    return four((U @ W @ Vt, U @ W.T @ Vt), U[:, 2])


@mistake("You used V where V^T belongs: numpy's svd returns V^T already.")
def v_for_its_transpose(E: np.ndarray) -> np.ndarray:
    """Transposes once too often."""
    U, Vt = proper(E)
    return four((U @ W @ Vt.T, U @ W.T @ Vt.T), U[:, 2])


@mistake(
    "You have one rotation only. There are two, half a turn about the baseline apart: with W and"
    " with W^T."
)
def one_rotation(E: np.ndarray) -> np.ndarray:
    """Uses W twice."""
    U, Vt = proper(E)
    return four((U @ W @ Vt, U @ W @ Vt), U[:, 2])


@mistake("You have each rotation with one sign of t only. Both are allowed: t and −t.")
def one_direction(E: np.ndarray) -> np.ndarray:
    """Forgets -t."""
    U, Vt = proper(E)
    Rs = U @ W @ Vt, U @ W.T @ Vt
    return np.stack([motion(R, U[:, 2]) for R in (*Rs, *Rs)])


@mistake(
    "Your t is the last column of V, which is the second centre seen from the first camera. t is"
    " the last column of U."
)
def t_from_v(E: np.ndarray) -> np.ndarray:
    """Takes the null vector on the wrong side."""
    U, Vt = proper(E)
    return four((U @ W @ Vt, U @ W.T @ Vt), Vt[2])


@mistake("You return the inverses, which take the second camera's frame to the first's.")
def inverses(E: np.ndarray) -> np.ndarray:
    """Turns each motion round."""
    return np.stack([np.linalg.inv(T) for T in essential.essential_to_poses(E)])


@mistake("Your rotations are transposed: V W U^T takes the second camera's frame to the first's.")
def transposed_rotations(E: np.ndarray) -> np.ndarray:
    """Takes R^T with the right t."""
    U, Vt = proper(E)
    return four(((U @ W @ Vt).T, (U @ W.T @ Vt).T), U[:, 2])


@mistake("Your t is as long as a singular value of E. E has no scale: t has length one.")
def t_scaled(E: np.ndarray) -> np.ndarray:
    """Gives t the length of E."""
    U, Vt = proper(E)
    return four((U @ W @ Vt, U @ W.T @ Vt), U[:, 2] * np.linalg.svd(E)[1][0])


@alternative
def signs_of_rotations(E: np.ndarray) -> np.ndarray:
    """Turns the sign of R round where it mirrors."""
    U, _, Vt = np.linalg.svd(E)
    W = np.array([[0, -1, 0], [1, 0, 0], [0, 0, 1]])
    Ts = np.tile(np.eye(4), (4, 1, 1))
    for k, R in enumerate((U @ W.T @ Vt, U @ W @ Vt)):
        Ts[2 * k : 2 * k + 2, :3, :3] = R * np.sign(np.linalg.det(R))
    Ts[:, :3, 3] = -U[:, 2], U[:, 2], -U[:, 2], U[:, 2]
    return Ts


@alternative
def by_cofactors(E: np.ndarray) -> np.ndarray:
    """Takes R as the cofactors of E less [t]x E, without W (Horn)."""
    U, _, Vt = np.linalg.svd(E)
    E = U @ np.diag([1.0, 1.0, 0.0]) @ Vt
    t = U[:, 2]
    cofactors = np.stack([np.cross(E[1], E[2]), np.cross(E[2], E[0]), np.cross(E[0], E[1])])
    return four((cofactors - skew(t) @ E, cofactors + skew(t) @ E), t)
