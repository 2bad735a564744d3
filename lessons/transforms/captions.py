"""The caption of every step of the stage `factors`."""

import numpy as np

from lessons.transforms.factors import NO_SCALE, SAME, Built
from lessons.transforms.inputs import FRONT, Body, Input
from workbench.captions import degrees, fixed, metres
from workbench.geometry.motions import angle_between
from workbench.lesson import Look, say
from workbench.numerals import brief
from workbench.numerals import fixed as in_places
from workbench.scene import Caption

FACTORS = {
    "scale": "Scaled, {words}: volumes × {det}.",
    "shear": "Sheared, {words}: angles change by up to {bent}, volumes × {det}.",
    "perspective": "Divided by {words}: edges that were parallel are up to {apart} apart.",
    "mirror": "Mirrored, {words}: lengths and angles are kept, but det is {det}.",
    "translate": "Translated by {words}: every place moved {moved}, every direction 0 m.",
    "turn": "Turned {words}: vertex {point} moved {moved}, and no length or angle changed.",
    "handle": "Turned {words}: vertex {point} moved {moved}, and no length or angle changed.",
}


def caption_of(look: Look[Input, Body, Built]) -> Caption:
    """Return what the newest factor did, and how the second reading compares at the end."""
    state = look.now
    params = look.params
    if state.factor.kind == "start":
        return say("The {name} before anything is done: T is the identity.", name=look.subject.name)
    if state.factor.kind == "undo":
        return _of_undo(look)
    if state.complete and state.ghost is not None:
        off = metres(state.ghost.distance)
        name = state.ghost.name
        if state.ghost.same:
            return say("Beside it: {name}. Here both end the same.", name=name)
        return say("Beside it: {name}. Its farthest vertex is {off} off.", name=name, off=off)
    if state.complete and params.compare == "direction with w = 1":
        return _of_direction(state)
    changed = {change.name: change.amount for change in state.by_factor}
    moved = float(np.linalg.norm(state.trail[-1] - state.trail[-2]))
    values = {
        "words": state.factor.words,
        "det": fixed(float(np.linalg.det(state.factor.matrix[:3, :3])), 2),
        "bent": degrees(np.degrees(changed["angles"])),
        "apart": degrees(np.degrees(changed["parallel edges"])),
        "moved": metres(moved),
        "point": look.subject.followed(params.point),
    }
    sentence = FACTORS[state.factor.kind]
    return say(sentence, **{k: v for k, v in values.items() if f"{{{k}}}" in sentence})


def _of_direction(state: Built) -> Caption:
    """Say where the front points when it is taken for a place."""
    right, taken = ((state.T @ np.append(FRONT, w))[:3] for w in (0.0, 1.0))
    if np.linalg.norm(taken) < SAME:
        return say("The front taken with w = 1 has length 0: it points nowhere.", tone="wrong")
    if np.linalg.norm(right - taken) < SAME:
        return say("The front taken with w = 1 is the same here: nothing was translated.")
    off = degrees(np.degrees(angle_between(right, taken)))
    return say("The front taken with w = 1 points {off} away from it.", tone="wrong", off=off)


def _of_undo(look: Look[Input, Body, Built]) -> Caption:
    state = look.now
    stays = what_stays(look)
    if state.left > SAME:
        return say(
            "Taken back by the given inverse: the farthest vertex is {left} off.",
            tone="wrong",
            left=metres(state.left),
        )
    if state.ghost is not None:
        name = state.ghost.name
        if state.ghost.same:
            return say("Taken back with (Rᵀ, −Rᵀt). Here {name} does the same.", name=name)
        return say(
            "Taken back with (Rᵀ, −Rᵀt). {name} leaves the farthest vertex {off} off.",
            tone="wrong",
            name=name,
            off=metres(state.ghost.distance),
        )
    if stays:
        return say("The motion is undone by (Rᵀ, −Rᵀt). " + stays)
    tone = "good" if look.params.compare == "nothing" else "info"
    return say("The motion is undone by (Rᵀ, −Rᵀt): every vertex is at its start.", tone=tone)


def what_stays(look: Look[Input, Body, Built]) -> str:
    """Say what the inverse of the motion leaves as it is: what was done to the shape before."""
    params = look.params
    reads = {
        "scale": params.scale != NO_SCALE,
        "shear": params.shear != 0.0,
        "division by w": params.perspective != 0.0,
        "reflection": params.mirror != "none",
    }
    done = [name for name, is_done in reads.items() if is_done]
    if done == ["scale"] and params.scale[:2] == (1.0, 1.0):
        return f"The stretch is not: the body is {brief(params.scale[2], 3)} times as high."
    if not done:
        return ""
    return f"The {' and the '.join(done)} {'is' if len(done) == 1 else 'are'} not."


def times(factor: float) -> str:
    """Write what an area or volume is multiplied by."""
    return f"× {in_places(factor, 2) if factor >= 0.1 else brief(factor, 2)}"
