"""What similarity_scale is graded by besides the checks that a student sees."""

import numpy as np

from lessons.pairs.exercises import GRADERS
from lessons.pairs.exercises.similarity_scale import SCALE_HINT, pairs, scale_verdict
from workbench.data.lopsided import a_rotation
from workbench.exercise import Function, Verdict, band, check, refused, worst


@check(2, public=False)
def mirror_images(candidate: Function) -> Verdict:
    """Where one scan is a mirror image, and where flat scans have noise, no reflection is counted
    in.
    """
    verdicts = []
    for k in range(6):
        p_target, p_source = pairs(GRADERS() + k, 1.0 + 0.2 * k, 0.02, mirror=bool(k % 2))
        if k % 2 == 0:
            rng = np.random.default_rng(GRADERS() + 50 + k)
            p_source = (p_source - p_source.mean(axis=0)) * [1.0, 1.0, 0.0]
            p_target = (1.0 + 0.2 * k) * p_source @ a_rotation(rng).T + 0.05 * rng.normal(
                size=p_source.shape
            )
            p_source = p_source + 0.05 * rng.normal(size=p_source.shape)
        verdicts.append(
            scale_verdict(
                candidate, p_target, p_source, f"Mirrored, or flat and noisy. {SCALE_HINT}"
            )
        )
    return worst(verdicts)


@check(1, public=False)
def far_away(candidate: Function) -> Verdict:
    """Clouds ten kilometres from the origin have the same scale."""
    p_target, p_source = pairs(GRADERS() + 20, 1.7, 0.03)
    v_target = np.array([1e4, -3e3, 2e3])
    v_source = np.array([-4e3, -9e3, 0.0])
    return scale_verdict(
        candidate, p_target + v_target, p_source + v_source, f"Far away. {SCALE_HINT}"
    )


@check(1, public=False)
def small_and_large(candidate: Function) -> Verdict:
    """Objects of centimetres and of kilometres have their scale too, and what is a hundredth or a
    hundred times as large.
    """
    verdicts = []
    for k, size in enumerate((0.01, 1000.0)):
        p_target, p_source = pairs(GRADERS() + 40 + k, 0.8, 0.05)
        verdicts.append(
            scale_verdict(
                candidate, size * p_target, size * p_source, f"Small, or large. {SCALE_HINT}"
            )
        )
        verdicts.append(
            scale_verdict(
                candidate, *pairs(GRADERS() + 44 + k, (0.01, 100.0)[k]), f"Scaled. {SCALE_HINT}"
            )
        )
    return worst(verdicts)


@check(1, public=False)
def no_scale_to_see(candidate: Function) -> Verdict:
    """Source points that coincide, and a single pair, give 1; two pairs have a scale; no pairs are
    refused.
    """
    p_target, p_source = pairs(GRADERS() + 30, 1.2)
    verdicts = [refused(candidate, np.empty((0, 3)), np.empty((0, 3)), what="A call without pairs")]
    for case, q in (
        ("Source points that coincide", np.full(p_target.shape, 0.5)),
        ("A single pair", p_source[:1]),
    ):
        verdicts.append(scale_verdict(candidate, p_target[: len(q)], q, f"{case}. {SCALE_HINT}"))
    line = np.outer(np.linspace(-1, 1, 7), [0.6, 0.0, 0.8])
    for case, p, q in (
        ("Two pairs", p_target[:2], p_source[:2]),
        ("Three pairs", p_target[:3], p_source[:3]),
        ("Points on a line", 1.4 * line[:, [1, 2, 0]], line + 0.3),
    ):
        verdicts.append(scale_verdict(candidate, p, q, f"{case}. {SCALE_HINT}"))
    zero = candidate(np.full(p_source.shape, 0.5), p_source)
    hint = f"Target points that coincide. {SCALE_HINT}"
    verdicts.append(
        band(
            "The scale is off by",
            100 * abs(zero),
            "%",
            good=0.01,
            fair=0.2,
            hint=f"Scale {zero:.5g}, right is 0. {hint}",
        )
    )
    return worst(verdicts)
