"""Captions: what a step did, with the number that changed."""

import math
from typing import Literal, TypeAlias

import numpy as np

from lessons.disparity.state import State
from lessons.disparity.truth import depth_errors, flat_parts, known_depths
from workbench.algorithms.stereo.disparity import Stage
from workbench.certain import sure
from workbench.numerals import brief, fixed, length, percent
from workbench.scene import Caption

Tone: TypeAlias = Literal["info", "good", "wrong"]
WAYS = {
    (0, 1): "to the right",
    (0, -1): "to the left",
    (1, 0): "down",
    (-1, 0): "up",
    (1, 1): "down and right",
    (-1, -1): "up and left",
    (1, -1): "down and left",
    (-1, 1): "up and right",
}


def caption(state: State) -> Caption:
    """Return the caption of one step."""
    if state.stage is None:
        return _of_error(state) if state.uncertainty is not None else _of_depth(state)
    words = {
        Stage.COMPARE: _compared,
        Stage.AGGREGATE: _aggregated,
        Stage.PATHS: _path,
        Stage.CHECK: _checked,
        Stage.REFINE: _refined,
        Stage.SMOOTH: _smoothed,
    }[state.stage](state)
    return Caption(words)


def _compared(state: State) -> str:
    d, n = state.done - 1, state.disparity.size
    if d == 0:
        return (
            "d = 0: both pictures lie on each other as they are. So far each pixel keeps this one."
        )
    fresh = int((state.disparity == d).sum())
    return (
        f"d = {d}: left (u, v) against right (u − {d}, v). {fresh:,} pixels"
        f" ({percent(fresh / n, 1)}) fit better than at any smaller shift."
    )


def _aggregated(state: State) -> str:
    window, cost = state.setup.params.window, state.setup.params.cost
    if window == 1:
        return (
            f"A window of one pixel sums nothing: the winner of each {cost} curve stays as it"
            f" was{_wrong_now(state)}."
        )
    return (
        f"{cost} over {window} × {window} pixels: a whole window must fit, not one pixel by chance"
        f"{_change(state, ': ')}."
    )


def _path(state: State) -> str:
    change = _change(state, "")
    change = (
        change
        or f"energy {brief(sure(state.before).energy, 4)} → {brief(state.energy, 4)} per pixel"
    )
    return (
        f"Path {state.done} of 8, {WAYS[sure(state.direction)]}: neighbours that disagree pay;"
        f" {change}."
    )


def _checked(state: State) -> str:
    lost = int(np.isnan(state.disparity).sum())
    text = (
        "The right picture chooses too: where the two differ by over 1 px, the pixel is given up: "
        f"{lost:,} ({percent(state.unknown, 1)})"
    )
    visible = state.setup.pair.visible
    truth = state.setup.pair.disparity
    if visible is not None and truth is not None and (np.isfinite(truth) & ~visible).any():
        hidden = np.isnan(state.disparity[np.isfinite(truth) & ~visible]).mean()
        text += f", {percent(hidden, 0)} of what the right camera cannot see"
    return f"{text}{_change(state, '; ')}.{_exchanged(state)}"


def _exchanged(state: State) -> str:
    """Say so where the pictures seem to have changed places."""
    if not state.setup.seem_exchanged:
        return ""
    as_given, exchanged = state.setup.agreeing
    return (
        f" With the pictures exchanged more pixels find each other, {percent(exchanged, 0)} instead"
        f" of {percent(as_given, 0)}: is the left one the right one?"
    )


def _refined(state: State) -> str:
    known = np.isfinite(state.disparity)
    moved = np.abs(state.disparity - np.rint(state.disparity))[known]
    mean = float(moved.mean()) if known.any() else 0.0
    return (
        "The lowest point of the parabola through three costs lies between pixels: "
        f"{fixed(mean, 2)} px from whole ones on average{_error(state)}."
    )


def _smoothed(state: State) -> str:
    return (
        "The median of each 3 × 3 neighbourhood drops single outliers and keeps"
        f" edges{_error(state)}{_wrong_now(state)}."
    )


def _of_depth(state: State) -> Caption:
    setup = state.setup
    camera, (u, v) = setup.pair.camera, setup.pixel
    if not setup.metric:
        return _of_unknown_cameras(state)
    depth = float(state.depth[v, u])
    d = "d" if camera.doffs == 0 else f"(d + {brief(camera.doffs)})"
    law = f"Z = f B / {d} with f = {brief(setup.f, 4)} px, B = {brief(camera.baseline)} m"
    true = float(setup.true_depth[v, u])
    truth = "" if math.isnan(true) else f" (truth: {distance(true)})"
    if math.isnan(depth):
        here = f"left pixel ({u}, {v}) is unknown and stays so"
    elif math.isinf(depth):
        here = f"left pixel ({u}, {v}) has d = 0, which means infinitely far, not missing{truth}"
    else:
        here = (
            f"left pixel ({u}, {v}), d = {fixed(state.chosen, 2)} px, is {distance(depth)}"
            f" away{truth}"
        )
    infinite = int(np.isinf(state.depth).sum())
    more = f" {infinite:,} pixels are infinitely far." if infinite else ""
    extra = (
        ""
        if not setup.params.disparity_error
        else f" {brief(setup.params.disparity_error)} px was added to every d first."
    )
    return Caption(f"{law}: {here}.{more}{extra}", _tone(state))


def _of_unknown_cameras(state: State) -> Caption:
    u, v = state.setup.pixel
    here = "is unknown" if math.isnan(state.chosen) else f"has d = {fixed(state.chosen, 2)} px"
    return Caption(
        f"Left pixel ({u}, {v}) {here}. Z = f B / d needs f and the baseline B of these cameras,"
        " which are not known: give own_focal_length and own_baseline for metres. The cloud only"
        f" shows what is nearer than what; its size is made up.{_exchanged(state)}"
    )


def _of_relative_error(state: State) -> Caption:
    """Say by which part of itself a depth moves, for which no camera has to be known."""
    e, known = (
        state.disparity_error,
        state.disparity[np.isfinite(state.disparity) & (state.disparity > 0)],
    )
    if not len(known):
        return Caption("No pixel has a disparity above 0, so there is no error to show.", "wrong")
    at = [float(d) + state.setup.pair.camera.doffs for d in np.percentile(known, [98, 50])]
    moved = ", ".join(f"at {brief(d)} px by {percent(e / d)}" for d in at if d > 0)
    return Caption(
        f"To first order {brief(e)} px of error moves a depth by {brief(e)} px / d of itself,"
        f" whatever the cameras: {moved}."
    )


def _of_error(state: State) -> Caption:
    if not state.setup.metric:
        return _of_relative_error(state)
    known = np.isfinite(state.depth) & (state.depth <= state.setup.far)
    if not known.any():
        return Caption("No pixel has a depth, so there is no error to show.", "wrong")
    e, fB = state.disparity_error, state.setup.f * state.setup.pair.camera.baseline
    flat = flat_parts(state)
    at = (
        list(flat)
        if 1 < len(flat) <= 4 and max(flat) > 1.2 * min(flat)
        else [float(z) for z in np.percentile(state.depth[known], [2, 98])]
    )
    moved = ", ".join(f"{length(z)} by {length(z * z / fB * e)}" for z in at)
    text = (
        f"To first order {brief(e)} px of error moves a depth by Z² / (f B) · {brief(e)} px:"
        f" {moved}."
    )
    if state.setup.params.disparity_error and at == list(flat):
        text += (
            f" Measured: {', '.join(length(abs(float(np.median(off)))) for off in flat.values())}."
        )
    off = depth_errors(state)
    if len(off):
        text += f" Half of all points are within {length(float(np.median(off)))} of the truth."
    return Caption(text, _tone(state))


def _tone(state: State) -> Tone:
    """Judge the depths: good within 3 % in the median and with few wrong pixels, wrong beyond 10 %
    or with many.

    Who asks for a mistake, or leaves the paths out, gets what was asked for.
    """
    found, true = known_depths(state)
    if not len(found):
        return "info"
    params, relative = state.setup.params, float(np.median(np.abs(found / true - 1.0)))
    if relative > 0.1 or state.wrong > 0.2:
        asked_for = (
            params.mistake != "none" or params.disparity_error != 0 or params.smoothness == 0
        )
        return "info" if asked_for else "wrong"
    return "info" if relative > 0.03 or state.wrong > 0.05 else "good"


def distance(depth: float) -> str:
    """Write how far away something is, in metres, to the millimetre."""
    return (
        "unknown"
        if math.isnan(depth)
        else "infinitely far"
        if math.isinf(depth)
        else f"{fixed(depth, 3)} m"
    )


def _wrong_now(state: State) -> str:
    return "" if math.isnan(state.wrong) else f"; {percent(state.wrong, 1)} are wrong"


def _change(state: State, lead: str) -> str:
    if state.before is None or math.isnan(state.wrong):
        return ""
    return f"{lead}wrong pixels {fixed(100 * state.before.wrong, 1)} → {percent(state.wrong, 1)}"


def _error(state: State) -> str:
    if state.before is None or math.isnan(state.error) or math.isnan(state.before.error):
        return ""
    return (
        f"; mean error of the right ones {fixed(state.before.error, 3)} →"
        f" {fixed(state.error, 3)} px"
    )
