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
    now = look.now
    if isinstance(now, Try):
        return _of_try(look, now)
    return _of_match(look, now) if now.phase == "match" else _of_fit(look, now)


def turned(look: SpaceLook, now: icp.State) -> float:
    """Return by how much the last fit turned the source, degrees."""
    before = look.before
    T = look.subject.T_start if not isinstance(before, icp.State) else before.T_target_source
    return degrees_between(now.T_target_source, T)


def tries_of(look: SpaceLook) -> tuple[Try, ...]:
    """Return the tries so far, this one included."""
    return tuple(one for one in (*look.past, look.now) if isinstance(one, Try))


def _of_match(look: SpaceLook, now: icp.State) -> Caption:
    kept, n = int(np.count_nonzero(now.kept)), len(now.kept)
    words = "Match {n}: every orange point takes the nearest blue one."
    values = {}
    if kept < n:
        words = "Match {n}: of {points} the closest {kept} are kept."
        values = {"points": counted(n, "match", "matches"), "kept": kept}
    if now.stop is not None:
        return _stopped(look, now, words, {"n": now.iteration, **values})
    words += _at_start(look, now) if now.iteration == 1 else ""
    return say(words, n=now.iteration, **values, place="match")


def _of_fit(look: SpaceLook, now: icp.State) -> Caption:
    scans, by = look.subject, degrees(turned(look, now))
    if now.stop is not None:
        return _stopped(look, now, "", {})
    if not scans.known:
        words = "Fit {n} turns orange by {turned}: RMSE {rmse}."
        return say(words, n=now.iteration, turned=by, rmse=metres(now.rmse), place="fit")
    off = degrees(scans.error(now.T_target_source).rotation)
    words = "Fit {n} turns orange by {turned}; {off} are left."
    return say(words, n=now.iteration, turned=by, off=off, place="fit")


def _stopped(look: SpaceLook, now: icp.State, words: str, values: dict) -> Caption:
    scans = look.subject
    assert now.stop is not None
    reason = f"{words} Stop after {{rounds}}: {now.stop.message}.".strip()
    values = {**values, "rounds": counted(now.iteration, "round")}
    if not scans.known:
        return say(reason, **values, place="fit")
    error = scans.error(now.T_target_source)
    if now.stop is icp.Stop.CONVERGED:  # the usual end needs no reason
        reason = "It comes to rest after {rounds}"
        reason += ", {off} and {away} from the truth."
    else:
        reason += " It is {off} and {away} from the truth."
    return say(
        reason,
        right=scans.at_home(error),
        settled=now.stop in SETTLED,
        off=degrees(error.rotation),
        away=metres(error.translation),
        place="fit",
        **values,
    )


def _of_try(look: SpaceLook, now: Try) -> Caption:
    scans, home = look.subject, look.subject.at_home(now.error)
    n = len(scans.p_source)
    few = len(range(n)[every(n, TRIED)])
    fewer = f" (with {few:,} of its points)" if few < n else ""
    ended = ", at an RMSE of {rmse}" if np.isfinite(now.rmse) else ", without a match that is kept"
    words = "From {start} away ICP {what}, {off} off" + ended + fewer + "."
    values = {
        "start": degrees(now.start_angle),
        "what": "comes home" if home else "ends elsewhere",
        "off": degrees(now.error.rotation),
    }
    if np.isfinite(now.rmse):
        values["rmse"] = metres(now.rmse)
    if now.start_angle < 180:
        return say(words, place="other starts", **values)
    last = edge(tries_of(look), scans)
    if last is None:
        return say(f"{words} Not even a start at 0° comes home.", place="other starts", **values)
    words += " It comes home from every start up to {edge}."
    return say(words, edge=degrees(last), place="other starts", **values)


def _at_start(look: SpaceLook, now: icp.State) -> str:
    """Say what has no effect on own scans, and where scans that start far apart need a guess."""
    text, idle = "", [name.replace("_", " ") for name in look.params.changed]
    if idle:
        has = "has" if len(idle) == 1 else "have"
        text += f" Your own scans are open: {', '.join(idle)} {has} no effect on them."
    gap, width = float(now.distances.min()), WIDTH / look.subject.frame.scale
    if gap > width:
        text += (
            f" The scans start {length(gap)} apart, and the target is {length(width)} wide: bring"
            " the source near it."
        )
    return text
