"""Write the filter: keep a match only where both descriptors are nearest to each other, and the
nearest is much nearer than the second nearest. RANSAC draws its samples from what your function
keeps.
"""

import numpy as np
from jaxtyping import Float, Int

from lessons.features.exercises import STUDENTS
from workbench.exercise import (
    Function,
    Verdict,
    alternative,
    check,
    contract,
    fail,
    full,
    left_alone,
    mistake,
    worst,
)
from workbench.geometry.features import matching


@contract(
    slot="mutual_matches",
    examples=(
        (
            "mutual_matches(np.array([[0.0], [5.0], [5.2]]), np.array([[0.3], [5.1], [9.0]]), 0.9)",
            "[0, 1, -1]",
        ),
        (
            (
                "mutual_matches(np.array([[0.0, 0], [4, 0]]), np.array([[4.0, 1], [0, 1], [0,"
                " 1.1]]), 0.8)"
            ),
            "[-1, 0]",
        ),
    ),
)
def mutual_matches(
    a: Float[np.ndarray, "n d"], b: Float[np.ndarray, "m d"], ratio: float
) -> Int[np.ndarray, " n"]:
    """Return for each row of a the index of its match in b, or -1 where it has none.

    Row i of a matches row j of b where j is the nearest of all rows of b to a[i], i is the nearest
    of all rows of a to b[j], the first of equally near ones, and the distance of a[i] to b[j] is
    less than ratio times its distance to the second nearest row of b.

    Args:
        a: Descriptors, one per row.
        b: Descriptors of the other set, two rows or more.
        ratio: Between 0 and 1, of distances (not of squared ones).

    Returns:
        Whole numbers, one for each row of a. The inputs stay as they are.
    """
    return matching.mutual_matches(a, b, ratio)


HINT = "Nearest both ways, and d1 < ratio * d2 for the distances to the two nearest rows of b."


def sets(seed: int, n: int, m: int, d: int, shift: float = 0.6) -> tuple[np.ndarray, np.ndarray]:
    """Return descriptors that partly belong together, some clearly and some hardly, in another
    order.
    """
    rng = np.random.default_rng(seed)
    common = rng.normal(size=(min(n, m), d))
    a, b = (
        np.concatenate([common, rng.normal(size=(count - len(common), d))])
        + shift * rng.uniform(0, 2, (count, 1)) * rng.normal(size=(count, d))
        for count in (n, m)
    )
    return a, rng.permutation(b)


def judged(candidate: Function, a: np.ndarray, b: np.ndarray, ratio: float, label: str) -> Verdict:
    """Judge row by row."""
    got = candidate(a, b, ratio)
    right = matching.mutual_matches(a, b, ratio)
    off = np.flatnonzero(got != right)
    if not len(off):
        return full(f"{label}: all {len(right)} rows are right.")
    i = int(off[0])
    kept = (
        f"you keep {np.count_nonzero(got >= 0)} matches, right are {np.count_nonzero(right >= 0)}"
    )
    return fail(f"{label}: {kept}; [{i}] is {int(got[i])}, right is {int(right[i])}. {HINT}")


@check(2)
def a_few(candidate: Function) -> Verdict:
    """Thirty descriptors of each set, at ratios of 0.9 and 0.5."""
    return worst(
        judged(candidate, *sets(STUDENTS, 30, 30, 5), ratio, f"30 and 30, {ratio:g}")
        for ratio in (0.9, 0.5)
    )


@check(1)
def sets_of_other_sizes(candidate: Function) -> Verdict:
    """More descriptors in one set than in the other, both ways round."""
    cases = ((12, 40, 0.85), (40, 12, 0.85), (50, 40, 0.5))
    return worst(
        judged(candidate, *sets(STUDENTS + n, n, m, 4), ratio, f"{n} and {m}")
        for n, m, ratio in cases
    )


@check(1)
def inputs_are_left_alone(candidate: Function) -> Verdict:
    """The descriptors are not changed."""
    return left_alone(
        candidate, judged(candidate, *sets(STUDENTS + 2, 10, 12, 3), 0.9, "10 and 12")
    )


def distances(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Return all distances, (n, m)."""
    return np.sqrt(((a[:, None] - b[None]) ** 2).sum(axis=-1))


def kept(D: np.ndarray, passes: np.ndarray, mutual: bool = True) -> np.ndarray:
    """Return the nearest where it passes, and is mutual where that is asked."""
    j = D.argmin(axis=1)
    if mutual:
        passes = passes & (D.argmin(axis=0)[j] == np.arange(len(D)))
    return np.where(passes, j, -1)


@mistake(
    "You ask one way only: the match of b[j] must be a[i] too. Several rows of a now share one row"
    " of b."
)
def one_direction(a: np.ndarray, b: np.ndarray, ratio: float) -> np.ndarray:
    """Only the ratio."""
    D = distances(a, b)
    low = np.sort(D, axis=1)
    return kept(D, low[:, 0] < ratio * low[:, 1], mutual=False)


@mistake(
    "You compare squared distances with the ratio, which lets more pass: take the roots, or square"
    " the ratio too."
)
def squared_distances(a: np.ndarray, b: np.ndarray, ratio: float) -> np.ndarray:
    """d1² < ratio d2²."""
    D = distances(a, b) ** 2
    low = np.sort(D, axis=1)
    return kept(D, low[:, 0] < ratio * low[:, 1])


@mistake(
    "Your ratio test is reversed: it keeps what is ambiguous. Keep a match where d1 < ratio * d2."
)
def test_reversed(a: np.ndarray, b: np.ndarray, ratio: float) -> np.ndarray:
    """d1 > ratio d2."""
    D = distances(a, b)
    low = np.sort(D, axis=1)
    return kept(D, low[:, 0] > ratio * low[:, 1])


@mistake(
    "You keep every match that is nearest both ways. The ratio of the two nearest distances has to"
    " be asked as well."
)
def no_ratio(a: np.ndarray, b: np.ndarray, ratio: float) -> np.ndarray:
    """Only mutual."""
    D = distances(a, b)
    return kept(D, np.ones(len(D), bool))


@mistake(
    "Your second nearest is among the rows of a. It is the second nearest row of b to the same"
    " a[i]."
)
def second_of_the_wrong_set(a: np.ndarray, b: np.ndarray, ratio: float) -> np.ndarray:
    """Asks the ratio down the columns."""
    D = distances(a, b)
    low = np.sort(D, axis=0)
    return kept(D, (low[0] < ratio * low[1])[D.argmin(axis=1)])


@alternative
def in_loops(a: np.ndarray, b: np.ndarray, ratio: float) -> np.ndarray:
    """One row after the other."""
    matches = []
    for i, x in enumerate(a):
        d = [float(np.linalg.norm(x - y)) for y in b]
        j = int(np.argmin(d))
        second = min(d[:j] + d[j + 1 :])
        back = int(np.argmin([float(np.linalg.norm(z - b[j])) for z in a]))
        matches.append(j if back == i and d[j] < ratio * second else -1)
    return np.array(matches)


@alternative
def with_all_distances(a: np.ndarray, b: np.ndarray, ratio: float) -> np.ndarray:
    """All distances at once."""
    D = distances(a, b)
    low = np.sort(D, axis=1)
    return kept(D, low[:, 0] < ratio * low[:, 1])
