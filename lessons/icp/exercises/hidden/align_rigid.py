"""What align_rigid is graded by besides the checks that a student sees."""

import numpy as np

from lessons.icp.exercises import GRADERS, a_motion
from lessons.icp.exercises.align_rigid import ALIGN_HINT, a_cloud, aligned
from workbench.exercise import (
    Function,
    Verdict,
    band,
    beside,
    check,
    motion_verdict,
    refused,
    worst,
)
from workbench.geometry.motions import apply


@check(1, public=False)
def noisy_pairs(candidate: Function) -> Verdict:
    """With 2 cm of noise the least-squares motion is found, from target to source and back."""
    verdicts = []
    for k in range(3):
        rng = np.random.default_rng(GRADERS() + k)
        p_source = a_cloud(rng, 200)
        p_target = apply(a_motion(rng, 60.0 + 40.0 * k), p_source) + 0.02 * rng.normal(
            size=p_source.shape
        )
        verdicts += [aligned(candidate, p_target, p_source), aligned(candidate, p_source, p_target)]
    return worst(verdicts)


@check(2, public=False)
def no_mirror_image(candidate: Function) -> Verdict:
    """Flat clouds with noise, and mirrored ones, are turned and not mirrored."""
    verdicts = []
    for k in range(8):
        rng = np.random.default_rng(GRADERS() + 10 + k)
        flat = a_cloud(rng) * [1.0, 1.0, 0.0]
        p_target = apply(a_motion(rng, 20.0 * k), flat) + 0.01 * rng.normal(size=flat.shape)
        verdicts.append(aligned(candidate, p_target, flat, "Is the determinant of R 1 here?"))
        solid = a_cloud(rng)
        mirrored = apply(a_motion(rng, 20.0 * k), solid * [1.0, 1.0, -1.0])
        verdicts.append(
            aligned(candidate, mirrored, solid, "The cloud is mirrored: is the determinant of R 1?")
        )
    return worst(verdicts)


@check(1, public=False)
def far_away(candidate: Function) -> Verdict:
    """Clouds ten kilometres from the origin, of a centimetre, and half a turn apart are aligned as
    well.
    """
    rng = np.random.default_rng(GRADERS() + 30)
    p_source = a_cloud(rng) + np.array([10_000.0, -4_000.0, 300.0])
    p_target = apply(a_motion(rng, 75.0), p_source - p_source.mean(0)) + np.array(
        [-6_000.0, 8_000.0, 0.0]
    )
    verdicts = [aligned(candidate, p_target, p_source)]
    small = 0.02 * a_cloud(rng)
    verdicts.append(
        aligned(
            candidate,
            apply(a_motion(rng, 50.0, 0.1), small),
            small,
            f"Of a centimetre. {ALIGN_HINT}",
        )
    )
    for turn in ([1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0]):
        solid = a_cloud(rng)
        verdicts.append(
            aligned(candidate, solid * turn + 0.5, solid, f"Half a turn apart. {ALIGN_HINT}")
        )
    return worst(verdicts)


@check(1, public=False)
def points_on_a_line(candidate: Function) -> Verdict:
    """Points on one line, at one place, and one pair to three get one of their best motions; no
    pairs are refused.
    """
    rng = np.random.default_rng(GRADERS() + 40)
    line = np.outer(np.linspace(-1, 1, 9), [0.6, 0.0, 0.8]) + 0.3
    T = a_motion(rng, 65.0)
    verdicts = [refused(candidate, np.empty((0, 3)), np.empty((0, 3)), what="A call without pairs")]
    few = a_cloud(rng, 3)
    cases = (
        ("Points on a line", line),
        ("A single pair", line[:1]),
        ("Two pairs", few[:2]),
        ("Three pairs", few),
        ("Points at one place", np.tile(few[0], (4, 1))),
    )
    for case, p_source in cases:
        got = candidate(apply(T, p_source), p_source)
        p_target = apply(T, p_source)
        moved = apply(got, p_source)
        away = float(np.linalg.norm(moved - p_target, axis=1).max())
        hint = beside(moved[-1], p_target[-1], ALIGN_HINT, "The last point")
        verdicts.append(motion_verdict(got, got, f"{case}. {ALIGN_HINT}"))
        verdicts.append(
            band(f"{case}: largest distance left", away, "m", good=1e-3, fair=2e-2, hint=hint)
        )
    return worst(verdicts)
