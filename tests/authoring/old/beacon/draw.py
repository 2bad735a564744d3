"""What one step looks like: a mapping from path to what stands there. A path names the same thing for the whole run."""

from workbench.geometry.polylines import between
from workbench.scene import Chart, Points, Scene, Segments

from .state import P_TRUE, State
from .words import caption

DISTANCE = Chart("Distance", unit="m")


def draw(state: State) -> Scene:
    """Show the fixes, the beacon and the estimate, and how far they are apart."""
    return {
        "fixes": Points(state.p, "target", 0.012, name="fixes"),
        "beacon": Points(P_TRUE[None], "truth", 0.03, name="the beacon"),
        "estimate": Points(state.p_estimate[None], "source", 0.03, name="estimate"),
        "miss": Segments(between(P_TRUE, state.p_estimate), "wrong", 3.0, name="error of the estimate"),
        "spread": DISTANCE.scalar(state.spread, "weighted RMS distance of the fixes"),
        "error": DISTANCE.scalar(state.error, "error of the estimate", "truth"),
        "caption": caption(state),
    }
