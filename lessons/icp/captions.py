"""What a step of ICP says: what just happened, its numbers, and at the end whether it has come
home.
"""

import numpy as np

from lessons.icp.basin import thinned
from lessons.icp.scans import WIDTH
from lessons.icp.state import State
from workbench.algorithms.registration.icp import Stop
from workbench.numerals import angle, length, percent
from workbench.scene import Caption

SETTLED = (Stop.CONVERGED, Stop.CIRCLING)


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
    came = " It has come home." if state.home else ""
    return Caption.verdict(text + came, right=state.home, settled=now.stop in SETTLED)


def _of_match(state: State) -> str:
    now = state.icp
    kept, n = int(np.count_nonzero(now.kept)), len(now.kept)
    text = (
        f"Match {now.iteration}: each source point takes its nearest target point. {kept:,} of"
        f" {n:,} are kept"
    )
    if kept < n:
        text += f" (up to {length(now.limit)} apart)"
    text += f"; RMSE {length(now.rmse)}." if kept else "."
    return text + (_at_start(state) if now.iteration == 1 else "")


def _of_fit(state: State) -> str:
    text = f"Fit {state.icp.iteration} turns the source by {angle(state.turned)}:"
    text += f" RMSE {length(state.rmse_before)} → {length(state.icp.rmse)}"
    if not state.known:
        return f"{text}."
    return f"{text}, {off(state)} from the truth. {_share(state.right)} right."


def _of_try(state: State) -> str:
    """Return what came of another start, an experiment: where it ends wrong, the run itself has not
    gone wrong.
    """
    last = state.tries[-1]
    home = state.scans.at_home(last.error)
    text = (
        f"{_other_setup(state)}: from {last.start_angle:.0f}° away, ICP"
        f" {'comes home' if home else 'ends'} {angle(last.error.rotation)} and"
        f" {length(last.error.translation)} from the truth, at RMSE {length(last.rmse)}."
    )
    if last.start_angle < 180:
        return text
    if state.edge is None:
        return f"{text} Not even the start at 0° comes home."
    return f"{text} In this row, every start up to {state.edge:.0f}° comes home."


def _other_setup(state: State) -> str:
    """Say in what the tries differ from the run itself, besides the angle."""
    params, few = state.params, len(thinned(state.scans))
    text = "Another start"
    if few < len(state.scans.p_source):
        text += f", with {few} of the source's points"
    if params.target is None and params.start_angle:
        text += ", turned the other way"
    return text + (", not shifted" if params.target is None and params.start_shift else "")


def _at_start(state: State) -> str:
    """Say what of the params has no effect on own scans, and where scans that start far apart need
    a guess.
    """
    text, idle = "", [name.replace("_", " ") for name in state.params.idle]
    if idle:
        text += (
            f" Your own scans are open: {', '.join(idle)} {'has' if len(idle) == 1 else 'have'} no"
            " effect on them."
        )
    gap, width = float(state.icp.distances.min()), WIDTH / state.scans.frame.scale
    if gap > width:
        text += (
            f" The scans start {length(gap)} apart, and the target is {length(width)} wide: bring"
            " the source near it."
        )
    return text


def off(state: State) -> str:
    """Return how far a step is from the truth: turn and shift."""
    return f"{angle(state.error.rotation)} and {length(state.error.translation)}"


def _share(right: float) -> str:
    if right < 0.005:
        return "Hardly any of its matches was"
    return f"{'Only ' if right < 0.5 else ''}{percent(right, 0)} of its matches were"
