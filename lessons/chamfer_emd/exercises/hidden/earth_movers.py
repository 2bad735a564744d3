"""What earth_movers is graded by besides the checks that a student sees."""

import numpy as np

from lessons.chamfer_emd.exercises import (
    GRADERS,
    moved_together,
    no_points_refused,
    reordered,
    two_clouds,
    value_verdict,
)
from lessons.chamfer_emd.exercises.earth_movers import MOVER_HINT, mover_found
from workbench.algorithms.transport import exact as transport
from workbench.exercise import Function, Verdict, check, worst


@check(2, public=False)
def shifted_copies(candidate: Function) -> Verdict:
    """A cloud and its copy, shifted by 0.7 m and with its rows in another order, are 0.7 m apart;
    unshifted 0.
    """
    p, _ = two_clouds(GRADERS() + 60, 50, 1)
    copy = reordered(GRADERS(), p)
    v = 0.7 * np.array([2.0, -1.0, 2.0]) / 3
    shifted = value_verdict(candidate(p, copy + v), 0.7, "m", MOVER_HINT, "Shifted: ")
    return worst(
        (shifted, value_verdict(candidate(p, copy), 0.0, "m", MOVER_HINT, "Other order: "))
    )


@check(2, public=False)
def bunched_points(candidate: Function) -> Verdict:
    """Nine of ten points bunched at one place are far from an even ring, though each gap is
    short.
    """
    rng = np.random.default_rng(GRADERS() + 70)
    angles = np.linspace(0, 2 * np.pi, 40, endpoint=False)
    even = np.column_stack([np.cos(angles), np.sin(angles), 0 * angles])
    bunched = reordered(GRADERS(), np.where(np.arange(40)[:, None] % 10 == 0, even, even[:1]))
    return mover_found(candidate, bunched + 0.01 * rng.normal(size=even.shape), even)


@check(2, public=False)
def unequal_counts(candidate: Function) -> Verdict:
    """Where counts differ no point is left out: 10 and 20, 20 and 10, 12 and 8, 5 and 8, 1 and 9,
    and a point twice.
    """
    verdicts = []
    for k, (n, m) in enumerate(((10, 20), (12, 8), (1, 9), (20, 10), (5, 8))):
        p_a, p_b = two_clouds(GRADERS() + 80 + k, n, m)
        verdicts.append(mover_found(candidate, p_a, p_b, f"{n} and {m} points: "))
    p, _ = two_clouds(GRADERS() + 90, 7, 1)
    more = np.vstack([p, p[:1]])
    twice = [
        mover_found(candidate, *pair, "A point twice: ")
        for pair in ((p, more), (more, p), (more, p[::-1] + 0.5))
    ]
    return worst((*verdicts, *twice))


@check(1, public=False)
def movers_far_away(candidate: Function) -> Verdict:
    """Turned, and a thousand kilometres away, the distance is the same."""
    p_a, p_b = two_clouds(GRADERS() + 100, 30, 30)
    right = transport.earth_movers(p_a, p_b)
    return value_verdict(
        candidate(*moved_together(GRADERS(), p_a, p_b, 1e6)), right, "m", MOVER_HINT
    )


@check(1, public=False)
def nothing_to_move(candidate: Function) -> Verdict:
    """A cloud without points is refused."""
    return no_points_refused(candidate)
