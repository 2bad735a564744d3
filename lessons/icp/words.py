"""What a step of ICP says: what just happened, its numbers, and at the end whether it has come home."""

import numpy as np

from lessons.icp.state import State
from workbench.scene import Caption

FITS = {
    "point-to-point": "the rigid motion with the least squared distance to the partners",
    "point-to-plane": "the step with the least squared distance to the partners' tangent planes",
    "similarity": "the similarity with the least squared distance to the partners",
    "affine": "the affine map with the least squared distance to the partners",
}


def caption(state: State) -> Caption:
    """Return the caption of a step."""
    if state.tries:
        return Caption(_of_try(state))
    now = state.icp
    text = _of_match(state) if now.phase == "match" else _of_fit(state)
    if now.stop is None:
        return Caption(text)
    text += f" Stop: {now.stop.message}."
    if not state.known:
        return Caption(text)
    verdict = "It has come home." if state.home else "It looks settled, and it is wrong."
    return Caption(f"{text} {verdict}", "good" if state.home else "wrong")


def _of_match(state: State) -> str:
    now = state.icp
    kept, n = int(np.count_nonzero(now.kept)), len(now.kept)
    text = f"Match {now.iteration}: each source point takes its nearest target point. {kept:,} of {n:,} are kept"
    if kept < n:
        text += f" (up to {length(now.limit)} apart)"
    text += f"; RMSE {length(now.rmse)}." if kept else "."
    if np.isfinite(state.right):
        text += f" {_share(state.right)} right."
    return text + _far_apart(state)


def _of_fit(state: State) -> str:
    text = f"Fit {state.icp.iteration}: {FITS[state.params.fit]} turns the source by {_angle(state.turned)};"
    text += f" RMSE {length(state.rmse_before)} → {length(state.icp.rmse)}"
    return text + (f", {off(state)} from the truth." if state.known else ".")


def _of_try(state: State) -> str:
    """Return what came of another start, an experiment: where it ends wrong, the run itself has not gone wrong."""
    last = state.tries[-1]
    home = state.scans.at_home(last.error)
    text = (
        f"Another start: from {last.start_angle:.0f}° away, ICP {'comes home' if home else 'ends'}"
        f" {_angle(last.error.rotation)} and {length(last.error.translation)} from the truth, at RMSE {length(last.rmse)}."
    )
    if last.start_angle < 180:
        return text
    if state.edge is None:
        return f"{text} Not even the start at 0° comes home."
    return f"{text} In this row, every start up to {state.edge:.0f}° comes home."


def _far_apart(state: State) -> str:
    """Say that scans which start farther apart than the target is wide need a guess."""
    if state.icp.iteration > 1 or not state.icp.distances.min() * state.scans.scale > 1.2:
        return ""
    gap, width = length(float(state.icp.distances.min())), length(1.2 / state.scans.scale)
    return f" The scans start {gap} apart and the target is {width} wide: bring the source near it first."


def off(state: State) -> str:
    """Return how far a step is from the truth: turn and shift."""
    return f"{_angle(state.error.rotation)} and {length(state.error.translation)}"


def _share(right: float) -> str:
    if right < 0.005:
        return "Hardly any of them is"
    return f"{'Only ' if right < 0.5 else ''}{100 * right:.0f} % of them are"


def _angle(degrees: float) -> str:
    return f"{degrees:.3g}°" if degrees >= 0.001 else "less than 0.001°"


def length(metres: float) -> str:
    """Return a length in the unit that suits it, without an exponent."""
    if metres >= 1e6:
        return f"{metres / 1000:,.0f} km"
    if metres >= 1000:
        return f"{metres:,.0f} m"
    if metres >= 0.1:
        return f"{metres:.3g} m"
    return f"{1000 * metres:.3g} mm" if metres >= 1e-6 else f"{1e6 * metres:.2g} µm" if metres >= 1e-9 else "0 mm"
