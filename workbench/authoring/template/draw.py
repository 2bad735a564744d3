"""What one step looks like: a mapping from path to what stands there.

A path names the same thing for the whole run.
"""

import numpy as np

from workbench.captions import counted, metres, share
from workbench.geometry.polylines import between
from workbench.lesson import Look, say
from workbench.scene import Caption, Chart, Points, Scene, Segments

from .inputs import P_TRUE, Estimate, Fixes, Input, expected_error

WEIGHTS = np.linspace(0.0, 1.0, 101)
DISTANCE = Chart("Distance", unit="m")
EXPECTED = Chart("Expected error", "weight of a bad fix", "mm", x_range=(0.0, 1.0))


def draw(look: Look[Input, Fixes, Estimate]) -> Scene:
    """Show the fixes so far, the beacon and the estimate, and how far they are apart."""
    params, estimate = look.params, look.now
    p = look.subject.p[: estimate.count]
    is_good = look.subject.is_good[: estimate.count]
    expected = 1000 * expected_error(params, WEIGHTS)
    here = 1000 * float(expected_error(params, np.array(params.weight)))
    helpful = float(WEIGHTS[expected <= expected[0]].max())
    scene: Scene = {
        "good": Points(p[is_good], "target", 0.012, name="fixes of the good sensor"),
        "beacon": Points(P_TRUE[None], "truth", 0.016, name="the beacon"),
        "estimate": Points(estimate.p[None], "source", 0.016, name="estimate"),
        "miss": Segments(between(P_TRUE, estimate.p), "wrong", 3.0, name="error of the estimate"),
        "error": DISTANCE.scalar(error_of(estimate), "error", "truth"),
        "expected/whole": EXPECTED.whole(WEIGHTS, expected, "expected error"),
        "expected/mark": EXPECTED.mark(params.weight, here, "this weight", knob="weight"),
        "caption": caption(look),
    }
    if estimate.count > 1:
        scene["bad"] = Points(p[~is_good], "other", 0.012, name="fixes of the bad sensor")
    if helpful > 0:
        scene["expected/helps"] = EXPECTED.band(0, helpful, "better than without the bad sensor")
    return scene


def error_of(estimate: Estimate) -> float:
    """Return the distance of the estimate from the beacon, metres."""
    return float(np.linalg.norm(estimate.p - P_TRUE))


def caption(look: Look[Input, Fixes, Estimate]) -> Caption:
    """Say what the last fix changed."""
    estimate = look.now
    error = metres(error_of(estimate))
    if look.before is None:
        return say("One fix is the estimate: it is {error} off.", error=error)
    return say(
        "{fixes}: the last one has {part} of all weight, and the estimate is {error} off.",
        fixes=counted(estimate.count, "fix", "fixes"),
        part=share(estimate.w[-1] / estimate.w.sum()),
        error=error,
    )
