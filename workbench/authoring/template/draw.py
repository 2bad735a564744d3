"""What one step looks like: a mapping from path to what stands there. A path names the same thing for the whole run."""

import numpy as np

from workbench.scene import Points, Scalar, Scene, Segments

from .state import P_TRUE, State
from .words import caption


def draw(state: State) -> Scene:
    """Show the fixes, the beacon and the estimate, and how far they are apart."""
    miss = np.stack([P_TRUE, state.p_estimate])[None]
    return {
        "fixes": Points(state.p, "target", 0.012, name="fixes"),
        "beacon": Points(P_TRUE[None], "truth", 0.03, name="the beacon"),
        "estimate": Points(state.p_estimate[None], "source", 0.03, name="estimate"),
        "miss": Segments(miss, "wrong", 3.0, name="error of the estimate"),
        "spread": Scalar(state.spread, "weighted RMS distance of the fixes", "Distance", "m", "source"),
        "error": Scalar(state.error, "error of the estimate", "Distance", "m", "truth"),
        "caption": caption(state),
    }
