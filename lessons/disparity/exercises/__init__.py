"""The exercises of this lesson: depth from disparity, the costs of all shifts, and the shift that
wins.
"""

import numpy as np

from workbench.exercise import HiddenSeed, Verdict, against, fail, full, partial

# seeds of what a student sees run, and of what only a grader does
STUDENTS = 31
GRADERS = HiddenSeed(9241)


Pair = tuple[np.ndarray, np.ndarray]
VOLUME_HINT = "cost[d, y, x] sums |left(y, x) - right(y, x - d)| over the window."


def textures(seed: int, h: int = 12, w: int = 20, shift: int = 4) -> Pair:
    """Return two noisy pictures; what the left one shows in column x is in column x - shift of the
    right one.
    """
    rng = np.random.default_rng(seed)
    scene = rng.uniform(10.0, 240.0, (h, w + shift))
    return scene[:, :w] + rng.normal(0, 3, (h, w)), scene[:, shift:] + rng.normal(0, 3, (h, w))


def cells_verdict(
    got: np.ndarray,
    right: np.ndarray,
    where: np.ndarray | None = None,
    label: str = "",
    hint: str = VOLUME_HINT,
) -> Verdict:
    """Judge costs by the share of wrong cells, per cent, and name the first of them.

    Args:
        got: The answer.
        right: The right one.
        where: Which cells are judged; all that have a finite cost where it is not given.
        label: How the message begins.
        hint: What to look at where it is wrong.
    """
    judged = np.isfinite(right) if where is None else where & np.isfinite(right)
    near = 1e-6 * float(right[judged].max())
    with np.errstate(invalid="ignore"):
        wrong = judged & ~(np.abs(got - right) <= near)
    if not wrong.any():
        return full(f"{label}{judged.sum()} of {judged.sum()} costs are right.")
    d, y, x = (int(i) for i in np.argwhere(wrong)[0])
    first = f"cost[{d}, {y}, {x}] is {against(got[d, y, x], right[d, y, x])}"
    message = f"{label}{wrong.sum()} of {judged.sum()} costs are wrong; {first}. {hint}"
    return partial(0.5, message) if wrong.sum() <= 0.05 * judged.sum() else fail(message)


def inner(right: np.ndarray, window: int) -> np.ndarray:
    """Return which cells have a window that lies inside their slice."""
    d, y, x = np.indices(right.shape)
    reach = window // 2
    _, h, w = right.shape
    return (y >= reach) & (y < h - reach) & (x >= d + reach) & (x < w - reach)
