"""Checks that run where a class is graded, by exercise: what is published leaves this out."""

from lessons.chamfer_emd.exercises import (
    GRADERS,
    Cloud,
    moved_together,
    reordered,
    value_verdict,
)
from workbench.exercise import Function, Verdict, worst


def same_when_moved(
    candidate: Function, clouds: tuple[Cloud, Cloud], right: float, hint: str
) -> Verdict:
    """Judge a distance in m² of two clouds in another order of rows, and turned and far away."""
    p_a, p_b = clouds
    mixed = candidate(reordered(GRADERS(), p_a), reordered(GRADERS() + 1, p_b))
    away = candidate(*moved_together(GRADERS(), p_a, p_b, 1e6))
    return worst(
        (
            value_verdict(mixed, right, "m²", hint, "Other order: "),
            value_verdict(away, right, "m²", "Subtract before you square. " + hint, "Far away: "),
        )
    )
