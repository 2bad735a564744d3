"""What a step in space says: what just happened, the number that changed, and how it ends."""

import numpy as np

from lessons.icp.inputs import Input
from lessons.icp.scans import WIDTH, Scans
from lessons.icp.space import TRIED, Try, edge
from workbench.algorithms.registration import icp
from workbench.captions import counted, degrees, metres
from workbench.data.thinning import every
from workbench.geometry.motions.alignment import degrees_between
from workbench.lesson import Look, say
from workbench.numerals import length
from workbench.scene import Caption

SETTLED = (icp.Stop.CONVERGED, icp.Stop.CIRCLING)
SpaceLook = Look[Input, Scans, icp.State | Try]


def caption(look: SpaceLook) -> Caption:
    """Return the caption of a step."""
    state = look.now
    if isinstance(state, Try):
        return _of_try(look, state)
    return _of_match(look, state) if state.phase == "match" else _of_fit(look, state)


def turned(look: SpaceLook, state: icp.State) -> float:
    """Return by how much the last fit turned the source, degrees."""
    before = look.before
    T = look.subject.T_start if not isinstance(before, icp.State) else before.T_target_source
    return degrees_between(state.T_target_source, T)


def tries_of(look: SpaceLook) -> tuple[Try, ...]:
    """Return the tries so far, this one included."""
    return tuple(state for state in (*look.past, look.now) if isinstance(state, Try))


def _of_match(look: SpaceLook, state: icp.State) -> Caption:
    kept = int(np.count_nonzero(state.kept))
    n = len(state.kept)
    words = "Match {n}: every orange point takes the nearest blue one."
    values = {}
    if kept < n:
        words = "Match {n}: of {points} the closest {kept} are kept."
        values = {"points": counted(n, "match", "matches"), "kept": kept}
    if state.stop is not None:
        return _stopped(look, state, words, values={"n": state.iteration, **values})
    words += _at_start(look, state) if state.iteration == 1 else ""
    return say(words, n=state.iteration, **values, place="match")


def _of_fit(look: SpaceLook, state: icp.State) -> Caption:
    scans = look.subject
    by = degrees(turned(look, state))
    if state.stop is not None:
        return _stopped(look, state, "", values={})
    if not scans.known:
        words = "Fit {n} turns orange by {turned}: RMSE {rmse}."
        return say(words, n=state.iteration, turned=by, rmse=metres(state.rmse), place="fit")
    off = degrees(scans.error(state.T_target_source).rotation)
    words = "Fit {n} turns orange by {turned}; {off} are left."
    return say(words, n=state.iteration, turned=by, off=off, place="fit")


def _stopped(look: SpaceLook, state: icp.State, words: str, *, values: dict) -> Caption:
    scans = look.subject
    assert state.stop is not None
    reason = f"{words} Stop after {{rounds}}: {state.stop.message}.".strip()
    values = {**values, "rounds": counted(state.iteration, "round")}
    if not scans.known:
        return say(reason, **values, place="fit")
    error = scans.error(state.T_target_source)
    if state.stop is icp.Stop.CONVERGED:  # the usual end needs no reason
        reason = "It comes to rest after {rounds}"
        reason += ", {off} and {away} from the truth."
    else:
        reason += " It is {off} and {away} from the truth."
    return say(
        reason,
        right=scans.at_home(error),
        settled=state.stop in SETTLED,
        off=degrees(error.rotation),
        away=metres(error.translation),
        place="fit",
        **values,
    )


def _of_try(look: SpaceLook, attempt: Try) -> Caption:
    scans = look.subject
    home = look.subject.at_home(attempt.error)
    n = len(scans.p_source)
    few = len(range(n)[every(n, TRIED)])
    fewer = f" (with {few:,} of its points)" if few < n else ""
    ended = (
        ", at an RMSE of {rmse}" if np.isfinite(attempt.rmse) else ", without a match that is kept"
    )
    words = "From {start} away ICP {what}, {off} off" + ended + fewer + "."
    values = {
        "start": degrees(attempt.start_angle),
        "what": "comes home" if home else "ends elsewhere",
        "off": degrees(attempt.error.rotation),
    }
    if np.isfinite(attempt.rmse):
        values["rmse"] = metres(attempt.rmse)
    if attempt.start_angle < 180:
        return say(words, place="other starts", **values)
    last = edge(tries_of(look), scans)
    if last is None:
        return say(f"{words} Not even a start at 0° comes home.", place="other starts", **values)
    words += " It comes home from every start up to {edge}."
    return say(words, edge=degrees(last), place="other starts", **values)


def _at_start(look: SpaceLook, state: icp.State) -> str:
    """Say what has no effect on own scans, and where scans that start far apart need a guess."""
    text = ""
    idle = [name.replace("_", " ") for name in look.params.changed]
    if idle:
        has = "has" if len(idle) == 1 else "have"
        text += f" Your own scans are open: {', '.join(idle)} {has} no effect on them."
    gap = float(state.distances.min())
    width = WIDTH / look.subject.frame.scale
    if gap > width:
        text += (
            f" The scans start {length(gap)} apart, and the target is {length(width)} wide: bring"
            " the source near it."
        )
    return text
