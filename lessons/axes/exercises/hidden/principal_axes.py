"""What principal_axes is graded by besides the checks that a student sees."""

import numpy as np

from lessons.axes.exercises import GRADERS
from lessons.axes.exercises.principal_axes import AXES_HINT, SKEWED, a_cloud, axes_verdict
from workbench.data.lopsided import a_rotation
from workbench.exercise import Function, Verdict, band, check, refused, worst


@check(2, public=False)
def other_lumps(candidate: Function) -> Verdict:
    """Clouds of other shapes, sizes and places get their axes."""
    verdicts = []
    for k, size in enumerate((1e-3, 0.1, 1.0, 100.0)):
        p = size * a_cloud(np.random.default_rng(GRADERS() + k), 30 + 200 * k)
        verdicts.append(
            axes_verdict(candidate(p), p, f"A cloud {size:g} times as large. {AXES_HINT}")
        )
    return worst(verdicts)


@check(1, public=False)
def far_away(candidate: Function) -> Verdict:
    """A cloud a thousand kilometres away has the same axes."""
    p = a_cloud(np.random.default_rng(GRADERS() + 10), 300) + np.array([1e6, -2e6, 3e6])
    return axes_verdict(
        candidate(p), p, "Far from the origin. Subtract the centroid before you multiply."
    )


@check(1, public=False)
def flat_and_thin(candidate: Function) -> Verdict:
    """A flat cloud, points on one line, few and equal ones get right-handed frames that fit; no
    point is refused.
    """
    rng = np.random.default_rng(GRADERS() + 20)
    flat = rng.normal(size=(50, 3)) * [0.5, 0.2, 0.0] @ a_rotation(rng).T + 1.0
    line = np.outer(np.linspace(-1, 1, 9), [0.6, 0.0, 0.8]) + 0.3
    cases = [
        ("A flat cloud", flat, 3),
        ("Points on a line", line, 1),
        ("A single point", line[:1], 0),
    ]
    cases += [
        ("Two points", flat[:2], 1),
        ("Three points", flat[:3], 3),
        ("Equal points", np.tile(line[:1], (4, 1)), 0),
    ]
    for k in range(3):  # along an axis, and across one
        cases.append(("Points on a line", np.linspace(-2, 1, 6)[:, None] * np.eye(3)[[k]], 1))
        cases.append(
            (
                "A flat cloud",
                (rng.normal(size=(40, 3)) * [0.5, 0.2, 0.0])[:, np.roll([0, 1, 2], k)],
                3,
            )
        )
    verdicts = [refused(candidate, np.empty((0, 3)), what="A cloud without points")]
    for label, p, first in cases:
        axes = candidate(p)
        verdicts.append(
            axes_verdict(axes, p, f"{label}. {AXES_HINT}", max(first, 1))
            if first
            else frame_only(axes)
        )
    return worst(verdicts)


def frame_only(axes: np.ndarray) -> Verdict:
    """Judge that axes are a right-handed frame, where the cloud says no more."""
    off = float(np.abs(axes.T @ axes - np.eye(3)).max())
    return band(
        "A single place: its frame, V^T V and determinant, is off by",
        max(off, abs(float(np.linalg.det(axes)) - 1.0)),
        "",
        good=SKEWED,
        fair=SKEWED,
        hint="Right is 0: any right-handed frame.",
    )
