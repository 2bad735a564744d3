"""What harris_response is graded by besides the checks that a student sees."""

import numpy as np

from lessons.features.exercises import GRADERS
from lessons.features.exercises.harris_response import judged, textured
from workbench.exercise import Function, Verdict, check, worst


@check(2, public=False)
def other_pictures(candidate: Function) -> Verdict:
    """High, wide and very small pictures, one of noise alone, and one of 16 bits."""
    noise = np.random.default_rng(GRADERS() + 3).normal(128.0, 20.0, (30, 30))
    return worst(
        judged(candidate, image, label)
        for image, label in (
            (textured(GRADERS(), 64, 24), "64 rows of 24"),
            (textured(GRADERS() + 1, 17, 61), "17 rows of 61"),
            (noise, "Noise"),
            (textured(GRADERS() + 4, 6, 5), "6 rows of 5"),
            (257.0 * noise - 9000.0, "Levels of 16 bits"),
        )
    )


@check(1, public=False)
def brightness_and_contrast(candidate: Function) -> Verdict:
    """A darker picture of a hundredth of the contrast: its response is smaller by 10⁸; of a
    ten-thousandth, by 10¹⁶.
    """
    picture = textured(GRADERS() + 2, 40, 40)
    return worst(
        [judged(candidate, c * picture + 3.0, f"Contrast times {c:g}") for c in (1e-2, 1e-4)]
    )
