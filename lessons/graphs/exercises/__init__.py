"""The exercises of this lesson: the graph of nearest neighbours, its Laplacian, and a layer of a
graph network.
"""

import numpy as np

from workbench.exercise import HiddenSeed, Verdict, against, fail, full, partial

# seeds of what a student sees run, and of what only a grader does
STUDENTS = 17
GRADERS = HiddenSeed(6043)


def weighted(seed: int, count: int, chance: float = 0.5) -> np.ndarray:
    """Return a symmetric matrix of weights from 0.2 to 3, without loops; some pairs have no
    edge.
    """
    rng = np.random.default_rng(seed)
    upper = np.triu(
        rng.uniform(0.2, 3.0, (count, count)) * (rng.random((count, count)) < chance), 1
    )
    return np.round(upper + upper.T, 3)


def matrix_verdict(
    got: np.ndarray, right: np.ndarray, hint: str, case: str = "", *, fair: float = 1e-3
) -> Verdict:
    """Judge a matrix by its entry that is farthest off: all points up to 1e-6, half up to `fair`.

    Args:
        got: The answer.
        right: The right one, of the same shape.
        hint: What to look at where it is wrong.
        case: How the message begins: the graph.
        fair: The error up to which half of the points are earned.
    """
    off = np.where(np.isfinite(got), np.abs(got - right), np.inf)
    if not off.size or off.max() <= 1e-6:
        return full(f"{case}all {got.size} entries are right.")
    i, j = (int(at) for at in np.unravel_index(int(np.argmax(off)), off.shape))
    wrong = int((off > 1e-6).sum())
    message = (
        f"{case}{wrong} of {got.size} entries are wrong: [{i}, {j}] is"
        f" {against(got[i, j], right[i, j])}."
    )
    return (
        partial(0.5, f"{message} Close. {hint}") if off.max() <= fair else fail(f"{message} {hint}")
    )
