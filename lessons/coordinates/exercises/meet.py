"""Write where lines meet, in homogeneous coordinates. The lesson turns two lines parallel and takes
their meeting from you: it has to stay a vector without a division by 0.
"""

import numpy as np
from jaxtyping import Float

from lessons.coordinates.exercises import STUDENTS, numbers, row_by_row
from workbench.exercise import Function, Verdict, alternative, check, contract, left_alone, mistake
from workbench.geometry.shapes import projective


@contract(
    slot="meet",
    preset="infinity",
    examples=(
        ("meet(np.array([[1.0, 0, -2]]), np.array([[0.0, 1, -3]]))", "[[2, 3, 1]]"),
        ("meet(np.array([[0.0, 1, 0]]), np.array([[0.0, 1, -1]]))", "[[-1, 0, 0]]"),
    ),
)
def meet(
    lines_a: Float[np.ndarray, "n 3"], lines_b: Float[np.ndarray, "n 3"]
) -> Float[np.ndarray, "n 3"]:
    """Return the points (x, y, w) where the lines cross those in the same rows, in homogeneous
    coordinates.

    Any factor other than 0 will do: (2, 3, 1) and (-4, -6, -2) are the same point.

    Args:
        lines_a: One row (a, b, c) per line, the points with a x + b y + c w = 0; at any scale.
        lines_b: Likewise.

    Returns:
        For parallel lines the point at infinity, w = 0. The same line twice, at whatever scale, has
        no one meeting: (0, 0, 0).
    """
    return projective.meet(lines_a, lines_b)


HINT = "The meeting is orthogonal to both vectors: l × l′."


def judged(
    candidate: Function, lines_a: np.ndarray, lines_b: np.ndarray, hint: str = HINT
) -> Verdict:
    """Judge points up to their factors, by the angle between the vectors in degrees."""
    got = candidate(lines_a, lines_b)
    right = projective.meet(lines_a, lines_b)
    off = np.degrees(projective.angle_between_rays(got, right))
    asked = [f"{numbers(a)} and {numbers(b)}" for a, b in zip(lines_a, lines_b, strict=True)]
    return row_by_row(asked, got, right, off, hint, good=1e-5, fair=1e-2)


def lines(seed: int, n: int = 8) -> tuple[np.ndarray, np.ndarray]:
    """Return lines in all directions, at many scales and of either sign."""
    rng = np.random.default_rng(seed)
    both = rng.normal(size=(2, n, 3)) * rng.uniform(0.2, 5.0, (2, n, 1))
    return both[0], both[1]


@check(3)
def lines_cross(candidate: Function) -> Verdict:
    """Lines of many directions and scales meet where they cross."""
    return judged(candidate, *lines(STUDENTS))


@check(2)
def upright_lines(candidate: Function) -> Verdict:
    """So do upright and level lines, and lines through the origin."""
    upright = [1.0, 0, -2]
    level = [0.0, 2, 3]
    slanting = [1.0, -3, 0]
    return judged(
        candidate,
        np.array([upright, level, slanting, upright, slanting]),
        np.array([level, slanting, upright, [2.0, 1, 0], [1.0, 1, 0]]),
        f"An upright line (1, 0, c) has no slope. {HINT}",
    )


@check(2)
def parallels(candidate: Function) -> Verdict:
    """Parallel lines meet at infinity, where w is 0."""
    a = np.array([[0.0, 1, 0], [1.0, 0, 4], [2.0, -1, 3], [1.0, 1, -1]])
    b = np.array([[0.0, 1, -1], [-2.0, 0, 4], [4.0, -2, 1], [1.0, 1, 1]])
    return judged(
        candidate,
        a,
        b,
        f"Parallels have w = 0: leave the vector as it is, divide nothing by w. {HINT}",
    )


@check(1)
def lines_are_left_alone(candidate: Function) -> Verdict:
    """The lines that come in are not changed."""
    return left_alone(candidate, judged(candidate, *lines(STUDENTS + 1)))


def parts(lines_a: np.ndarray, lines_b: np.ndarray) -> tuple[np.ndarray, ...]:
    """Return a, b, c of the one and d, e, f of the other lines."""
    return *lines_a.T, *lines_b.T


@mistake(
    "You divided by w. That is infinite or no number for parallels; a homogeneous vector needs no"
    " division."
)
def divided_by_w(lines_a: np.ndarray, lines_b: np.ndarray) -> np.ndarray:
    """Makes w one."""
    x_h = projective.meet(lines_a, lines_b)
    return x_h / x_h[:, 2:]


@mistake(
    "You solved with slopes y = m x + k: upright lines have none, and parallels divide by 0. Take l"
    " × l′."
)
def by_slopes(lines_a: np.ndarray, lines_b: np.ndarray) -> np.ndarray:
    """Divides by b."""
    a, b, c, d, e, f = parts(lines_a, lines_b)
    x = (c / b - f / e) / (d / e - a / b)
    return np.column_stack([x, -(a * x + c) / b, np.ones(len(x))])


@mistake("The middle entry of your product has the wrong sign: it is c d − a f, not a f − c d.")
def middle_sign(lines_a: np.ndarray, lines_b: np.ndarray) -> np.ndarray:
    """Forgets the sign of the cofactor."""
    return projective.meet(lines_a, lines_b) * [1.0, -1.0, 1.0]


@mistake(
    "You read lines as a x + b y = c. Here c is on the other side: a x + b y + c = 0, so your"
    " points are mirrored."
)
def c_on_the_right(lines_a: np.ndarray, lines_b: np.ndarray) -> np.ndarray:
    """Turns c round."""
    turn = np.array([1.0, 1.0, -1.0])
    return projective.meet(lines_a * turn, lines_b * turn)


@mistake(
    "You multiplied entry by entry. The cross product is asked for, which is orthogonal to both."
)
def entry_by_entry(lines_a: np.ndarray, lines_b: np.ndarray) -> np.ndarray:
    """Takes a * b."""
    return lines_a * lines_b


@mistake(
    "You return (x, y, 1) from a solver and something made up where it fails. l × l′ needs no"
    " solver and never fails."
)
def solved_with_nan(lines_a: np.ndarray, lines_b: np.ndarray) -> np.ndarray:
    """Solves two equations, NaN where they are singular."""
    rows = []
    for a, b in zip(lines_a, lines_b, strict=True):
        A = np.array([a[:2], b[:2]])
        rows.append(
            np.append(np.linalg.solve(A, -np.array([a[2], b[2]])), 1.0)
            if np.linalg.det(A)
            else [np.nan] * 3
        )
    return np.array(rows)


@mistake(
    "You subtracted the lines: l − l′ is another line through the meeting, not the meeting. Take l"
    " × l′."
)
def difference(lines_a: np.ndarray, lines_b: np.ndarray) -> np.ndarray:
    """Takes l - l'."""
    return lines_a - lines_b


@alternative
def by_numpy(lines_a: np.ndarray, lines_b: np.ndarray) -> np.ndarray:
    """Asks numpy."""
    return np.cross(lines_a, lines_b)


@alternative
def by_skew_matrices(lines_a: np.ndarray, lines_b: np.ndarray) -> np.ndarray:
    """Multiplies by [l]x."""
    S = np.zeros((len(lines_a), 3, 3))
    a, b, c = lines_a.T
    S[:, 0, 1] = -c
    S[:, 0, 2] = b
    S[:, 1, 2] = -a
    S -= S.transpose(0, 2, 1)
    return np.einsum("nij,nj->ni", S, lines_b)
