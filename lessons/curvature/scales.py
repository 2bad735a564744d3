"""How far the colours reach, and how long the arrows are: fixed for built-in surfaces, by
percentile for own meshes.
"""

import numpy as np

from lessons.curvature.state import State
from workbench.numerals import ROUND_OFF

# Fixed, so that the same colour means the same curvature in every run of a built-in surface.
K_SCALE, H_SCALE, DEFECT_SCALE = 5.0, 2.5, 0.2
ARROW = 0.06  # metres of arrow per m⁻¹
OWN_ARROW = 0.15  # metres: of an own mesh the arrows of MOST vertices are at most as long
MOST = 90  # per cent of an own mesh' vertices that its colours tell apart


def reach(state: State, values: np.ndarray, fixed: float) -> float:
    """Return where the colours of these values end: `fixed`, or for an own mesh what MOST per cent
    of its vertices keep to.

    Rounded to two digits that count. Where nearly all values are 0, as on a box of many faces, the
    largest counts.
    """
    if state.subject.truth is not None:
        return fixed
    known = np.abs(values[np.isfinite(values)])
    most = float(np.percentile(known, MOST)) if len(known) else 0.0
    most = most if most > ROUND_OFF else float(known.max(initial=0.0))
    return float(f"{most:.2g}") if most > ROUND_OFF else fixed


def share_within(values: np.ndarray, limit: float) -> str:
    """Return how many of the known values are at most so large, in per cent, rounded down."""
    known = np.abs(values[np.isfinite(values)])
    return f"{int(100 * np.mean(known <= limit)) if len(known) else 100} %"


def arrow(state: State) -> float:
    """Return the metres of arrow per m⁻¹ of a mean-curvature normal."""
    if state.subject.truth is not None:
        return ARROW
    lengths = np.linalg.norm(state.now.normals_2H, axis=1)
    return OWN_ARROW / reach(state, lengths, OWN_ARROW / ARROW)
