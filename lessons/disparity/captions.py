"""Captions of the whole pair: what a step did, with the number that changed."""

import math
from typing import Any, Literal, TypeAlias

import numpy as np

from lessons.disparity.matching import MapLook, chosen
from lessons.disparity.truth import depth_errors, flat_parts, known_depths
from workbench.algorithms.stereo.disparity import Stage
from workbench.captions import counted, metres, number, pixels, share
from workbench.captions import fixed as decimals
from workbench.certain import sure
from workbench.geometry.cameras.stereo import depth_uncertainty
from workbench.lesson import say
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


def caption(look: MapLook) -> Caption:
    """Return the caption of one step."""
    state = look.now
    if state.stage is None:
        return _of_depth(look) if state.uncertainty is None else _of_error(look)
    return {
        Stage.COMPARE: _compared,
        Stage.AGGREGATE: _aggregated,
        Stage.PATHS: _path,
        Stage.CHECK: _checked,
        Stage.REFINE: _refined,
        Stage.SMOOTH: _smoothed,
    }[state.stage](look)


def _compared(look: MapLook) -> Caption:
    d = look.now.done - 1
    if d == 0:
        return say("Shift 0: both pictures lie on each other as they are.")
    fresh = int((look.now.disparity == d).sum())
    return say(
        "Shift {d}: {fresh} cost less here than at any smaller shift.",
        d=d,
        fresh=counted(fresh, "pixel"),
    )


def _aggregated(look: MapLook) -> Caption:
    window = look.params.window
    cost = look.params.cost
    words = f"{cost} over {window} × {window} pixels: a whole window must fit, not one pixel"
    if window == 1:
        words = "A window of one pixel sums nothing"
    if look.before is None or math.isnan(look.now.wrong):
        return say(f"{words}.", place="window")
    was = look.before.wrong
    wrong = look.now.wrong
    return say(
        f"{words}. Wrong pixels {{was}} → {{wrong}}.",
        was=share(was, 1),
        wrong=share(wrong, 1),
        place="window",
    )


def _path(look: MapLook) -> Caption:
    state = look.now
    before = sure(look.before)
    words = f"Path {{k}} of 8, {WAYS[sure(state.direction)]}: "
    place = "paths" if state.done == 1 else ""
    if math.isnan(state.wrong):
        words += "the energy falls from {was} to {is_now} per pixel."
        if state.energy > before.energy:
            words = words.replace("falls", "goes")
        was = number(before.energy, 4)
        is_now = number(state.energy, 4)
        return say(words, k=state.done, was=was, is_now=is_now, place=place)
    words += "wrong pixels {was} → {wrong}."
    was = share(before.wrong, 1)
    wrong = share(state.wrong, 1)
    return say(words, k=state.done, was=was, wrong=wrong, place=place)


def _checked(look: MapLook) -> Caption:
    state = look.now
    pair = look.subject.pair
    words = "Where left and right disagree by over 1 px, the pixel is given up: {lost}"
    values: dict[str, Any] = {"lost": share(state.unknown, 1)}
    truth = pair.disparity
    visible = pair.visible
    if visible is not None and truth is not None and (np.isfinite(truth) & ~visible).any():
        hidden = np.isnan(state.disparity[np.isfinite(truth) & ~visible]).mean()
        words += " of all, {hidden} of what the right camera cannot see"
        values["hidden"] = share(hidden, 0)
    words += "."
    if look.subject.seem_exchanged:
        as_given, exchanged = look.subject.agreeing
        words += (
            " With the pictures exchanged more pixels find each other, {exchanged} instead of"
            " {given}: is the left one the right one?"
        )
        values |= {"exchanged": share(exchanged, 0), "given": share(as_given, 0)}
    return say(words, place="check", **values)


def _refined(look: MapLook) -> Caption:
    known = np.isfinite(look.now.disparity)
    moved = np.abs(look.now.disparity - np.rint(look.now.disparity))[known]
    mean = float(moved.mean()) if known.any() else 0.0
    return say(
        "A parabola through three costs has its lowest point between pixels, {mean} px from whole"
        " ones on average.",
        mean=decimals(mean, 2),
        place="refine",
    )


def _smoothed(look: MapLook) -> Caption:
    words = "The median of each 3 × 3 neighbourhood drops single outliers and keeps edges"
    if math.isnan(look.now.wrong):
        return say(f"{words}.", place="median")
    return say(f"{words}; {{wrong}} are wrong.", wrong=share(look.now.wrong, 1), place="median")


def _of_depth(look: MapLook) -> Caption:
    pictures = look.subject
    params = look.params
    camera = pictures.pair.camera
    u, v = pictures.pixel
    d = chosen(look)
    if not pictures.metric:
        here = "is unknown"
        values: dict[str, Any] = {}
        if math.isfinite(d):
            here = "has d = {d}"
            values = {"d": pixels(d)}
        return say(
            f"Pixel ({u}, {v}) {here}. The cameras are not known: give own_focal_length and"
            " own_baseline for metres. Until then the size of the cloud is made up.",
            place="depth",
            **values,
        )
    depth = float(look.now.depth[v, u])
    true = float(pictures.true_depth[v, u])
    words = f"Pixel ({u}, {v}) is unknown and stays so."
    values = {}
    if math.isinf(depth):
        words = f"Pixel ({u}, {v}) has d = 0: it is infinitely far, not missing."
    elif math.isfinite(depth):
        over = "d" if camera.doffs == 0 else f"(d + {brief(camera.doffs)})"
        words = f"Z = f B / {over}: pixel ({u}, {v}) with d = {{d}} is {{depth}} away."
        values = {"d": pixels(d, 3), "depth": metres(depth)}
        if math.isfinite(true):
            words = words[:-1] + ", in truth {true}."
            values["true"] = metres(true)
    if params.disparity_error:
        words += " Every d was made {error} larger first."
        values["error"] = pixels(params.disparity_error)
    return say(words, tone=_tone(look), place="depth", **values)


def _of_error(look: MapLook) -> Caption:
    pictures = look.subject
    state = look.now
    if not pictures.metric:
        return _of_relative_error(look)
    known = np.isfinite(state.depth) & (state.depth <= pictures.far)
    if not known.any():
        return say("No pixel has a depth, so there is no error to show.", tone="wrong")
    error = state.disparity_error
    baseline = pictures.pair.camera.baseline
    flat = flat_parts(pictures, state.depth)
    at = [float(z) for z in np.percentile(state.depth[known], [2, 98])]
    if 1 < len(flat) <= 4 and max(flat) > 1.2 * min(flat):
        at = list(flat)
    moved = depth_uncertainty(np.array(at), pictures.f, baseline, disparity_error=error)
    told = ", ".join(f"{length(z)} by {length(m)}" for z, m in zip(at, moved, strict=True))
    words = f"To first order {{error}} of error moves a depth by Z² / (f B): {told}."
    if look.params.disparity_error and at == list(flat):
        medians = (length(abs(float(np.median(off)))) for off in flat.values())
        words += f" Measured: {', '.join(medians)}."
    values: dict[str, Any] = {"error": pixels(error)}
    off = depth_errors(pictures, state.depth)
    if len(off):
        words += " Half of all points are within {half} of the truth."
        values["half"] = metres(float(np.median(off)))
    return say(words, tone=_tone(look), place="±", **values)


def _of_relative_error(look: MapLook) -> Caption:
    """Say by which part of itself a depth moves, for which no camera has to be known."""
    error = look.now.disparity_error
    d = look.now.disparity
    known = d[np.isfinite(d) & (d > 0)]
    if not len(known):
        return say("No pixel has a disparity above 0, so there is no error to show.", tone="wrong")
    at = [float(d) + look.subject.pair.camera.doffs for d in np.percentile(known, [98, 50])]
    moved = ", ".join(f"at {brief(d)} px by {percent(error / d)}" for d in at if d > 0)
    return say(
        f"To first order {{error}} of error moves a depth by that over d, whatever the cameras:"
        f" {moved}.",
        error=pixels(error),
        place="±",
    )


def _tone(look: MapLook) -> Tone:
    """Judge the depths: good within 3 % in the median and with few wrong pixels, wrong beyond 10 %
    or with many.

    Who asks for a mistake, or leaves the paths out, gets what was asked for.
    """
    depths, true = known_depths(look.subject, look.now.depth)
    if not len(depths):
        return "info"
    params = look.params
    relative = float(np.median(np.abs(depths / true - 1.0)))
    if relative > 0.1 or look.now.wrong > 0.2:
        asked_for = (
            params.mistake != "none" or params.disparity_error != 0 or params.smoothness == 0
        )
        return "info" if asked_for else "wrong"
    return "info" if relative > 0.03 or look.now.wrong > 0.05 else "good"


def distance(depth: float) -> str:
    """Write how far away something is, in metres, to the millimetre."""
    if math.isnan(depth):
        return "unknown"
    return "infinitely far" if math.isinf(depth) else f"{fixed(depth, 3)} m"
