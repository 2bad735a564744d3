"""What canonical_signs is graded by besides the checks that a student sees."""

import numpy as np

from lessons.axes.exercises import GRADERS
from lessons.axes.exercises.canonical_signs import SIGNS_HINT, of_any_signs, several, signs_verdict
from workbench.data.lopsided import a_lopsided_cloud, a_rotation
from workbench.exercise import Function, Verdict, check, worst


@check(2, public=False)
def mirror_images(candidate: Function) -> Verdict:
    """Clouds whose three tails are left-handed get right-handed frames: axis 3 has no say of its
    own.
    """
    return several(candidate, GRADERS(), 6, mirrored=True)


@check(2, public=False)
def far_and_small(candidate: Function) -> Verdict:
    """Clouds far from the origin, and tiny ones, get the signs of their tails."""
    verdicts = []
    for k, (size, away) in enumerate(((1.0, 5e3), (1e-3, 0.0), (1.0, -5e3), (1e3, 20.0))):
        rng = np.random.default_rng(GRADERS() + 20 + k)
        p = size * a_lopsided_cloud(rng, 300, mirrored=bool(k % 2)) + away
        axes = of_any_signs(rng, p)
        verdicts.append(
            signs_verdict(candidate(axes, p), axes, p, f"Far away, or small. {SIGNS_HINT}")
        )
    return worst(verdicts)


@check(1, public=False)
def few_outvote_many(candidate: Function) -> Verdict:
    """A few far points outvote the many on the other side, and on the same side agree with them."""
    verdicts = []
    for k in range(4):
        rng = np.random.default_rng(GRADERS() + 40 + k)
        levels = rng.choice([0.4, -1.0, 2.2], (400, 3), p=[0.6, 0.35, 0.05]) + 0.05 * rng.normal(
            size=(400, 3)
        )
        p = levels * [0.6, 0.35, 0.2] @ a_rotation(rng).T + 0.3
        axes = of_any_signs(rng, p)
        verdicts.append(
            signs_verdict(candidate(axes, p), axes, p, f"Few points far away. {SIGNS_HINT}")
        )
    return worst(verdicts)


@check(1, public=False)
def against_the_farthest_point(candidate: Function) -> Verdict:
    """One point far away does not outvote a tail of many; where the third moment is 0 an axis stays
    as it is.
    """
    rng = np.random.default_rng(GRADERS() + 60)
    along = np.concatenate(
        [np.tile([[-0.7], [0.2]], (1, 3)).repeat([60, 240], axis=0), np.full((30, 3), 1.4)]
    )
    along = np.concatenate([along + 0.02 * rng.normal(size=along.shape), np.full((1, 3), -2.0)]) * [
        0.6,
        0.35,
        0.2,
    ]
    p = along @ a_rotation(rng).T
    axes = of_any_signs(rng, p)
    verdicts = [signs_verdict(candidate(axes, p), axes, p, f"One point is far away. {SIGNS_HINT}")]
    box = np.array([[x, y, z] for x in (-4.0, 4.0) for y in (-1.0, -1.0, 2.0) for z in (-1.0, 1.0)])
    even = np.array([[x, y, z] for x in (-4.0, 4.0) for y in (-2.0, 2.0) for z in (-1.0, 1.0)])
    clouds = ((box, "axis 1 is"), (box[:, [1, 0, 2]], "axis 2 is"), (even, "both are"))
    for cloud, which in clouds:
        for signs in ([-1.0, -1.0, 1.0], [1.0, 1.0, -1.0]):
            axes = np.diag(signs)
            hint = f"The third moment of {which} 0: what has none stays."
            verdicts.append(signs_verdict(candidate(axes, cloud), axes, cloud, hint))
    return worst(verdicts)
