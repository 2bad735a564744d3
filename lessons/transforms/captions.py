"""The caption of every step."""

import numpy as np

from lessons.transforms.body import numbers_of
from lessons.transforms.compare import in_degrees, other_triples
from lessons.transforms.state import FRONT, SAME, Built, Ghost, Method, Moved
from workbench.geometry.motions import angle_between
from workbench.geometry.motions.affine import Kind, kind_of, transform
from workbench.geometry.motions.rotations import gimbal_margin
from workbench.numerals import angle, brief, fixed, length, percent
from workbench.scene import Caption

LOCKED = 1e-12  # sine between the outer axes; below it they are one
NEAR_LOCK = 0.1

_HOW: dict[Method, str] = {
    "slerp + lerp": "slerp is asked for just that turn, about one axis",
    "Euler angles": "here each of the three angles runs at constant speed",
    "matrix entries": "here each entry of the matrix runs at constant speed",
    "slerp to -q": "here slerp runs to −q, which is the end's rotation too",
    "screw": "here one screw turns and slides at constant speed",
}

TAKEN_BACK = ("nothing", "undo by (Rᵀ, −t)", "undo all as if rigid")  # what such runs are about


def caption_of_build(state: Built) -> Caption:
    """Say what the newest factor did, and how the second reading compares once the map is
    complete.
    """
    caption = _factor_caption(state)
    if state.factor.kind == "undo" and state.ghosts:
        (ghost,) = state.ghosts
        if ghost.same:
            return Caption(f"{caption.text} Here {ghost.name} does the same.", caption.tone)
        return Caption(
            f"{caption.text} {ghost.name} leaves its farthest vertex {length(ghost.distance)} off.",
            "wrong",
        )
    if state.complete and state.ghosts:
        beside = f"Beside it: {state.params.compare}, {_spread(state.ghosts)}."
        return Caption(f"{caption.text} {beside}", caption.tone)
    if state.complete and state.params.compare == "direction with w = 1":
        text, wrong = _front_with_w_1(state)
        return Caption(f"{caption.text} {text}", "wrong" if wrong else caption.tone)
    return caption


def _front_with_w_1(state: Built) -> tuple[str, bool]:
    """Say where the front points when it is taken for a point, and whether that is wrong."""
    right, taken = (state.T @ np.append(FRONT, w) for w in (0.0, 1.0))
    if np.linalg.norm(taken[:3]) < SAME:
        return "The front taken with w = 1 has length 0: it points nowhere.", True
    apart = np.degrees(angle_between(right[:3], taken[:3]))
    if np.linalg.norm(right[:3] - taken[:3]) < SAME:
        return "The front taken with w = 1 is the same here: nothing was translated.", False
    if apart < 1e-6:
        return (
            "The front taken with w = 1 points the same way here, but its length is another.",
            True,
        )
    return f"The front taken with w = 1 points {angle(apart, 2)} away from it.", True


def _spread(ghosts: tuple[Ghost, ...]) -> str:
    others = [ghost.distance for ghost in ghosts if not ghost.same]
    if not others:
        return "the same motion" if len(ghosts) == 1 else f"all {len(ghosts)} the same motion"
    low, high = length(min(others)), length(max(others))
    off = f"farthest vertex {low} off" if low == high else f"farthest vertex {low} to {high} off"
    if len(others) == len(ghosts):
        return off
    return (
        f"{len(ghosts) - len(others)} of {len(ghosts)} the same, "
        + ("the other: " if len(others) == 1 else "the others: ")
        + off
    )


def _factor_caption(state: Built) -> Caption:
    kind, words, point = state.factor.kind, state.factor.words, state.body.point
    change = {c.name: c.amount for c in state.by_factor}
    moved = float(np.linalg.norm(state.trail[-1] - state.trail[max(len(state.trail) - 2, 0)]))
    det = fixed(float(np.linalg.det(state.factor.matrix[:3, :3])), 2)
    if kind == "undo":
        return _undo_caption(state)
    if kind == "start":
        volume = state.body.measures.volume
        size = f"{len(state.body.solid.p):,} vertices"
        size += "" if np.isnan(volume) else f", volume {brief(volume)} m³"
        return Caption(f"The {state.body.name} before anything is done: {size}; T is the identity.")
    if kind == "scale":
        text = (
            f"Scaled, {words}: edges change by up to {percent(change['edge lengths'])}, volumes ×"
            f" {det}."
        )
    elif kind == "shear":
        text = (
            f"Sheared, {words}: angles change by up to {angle(np.degrees(change['angles']))}, yet"
            f" det is {det}: the"
        )
        text += " volume stays."
    elif kind == "perspective":
        text = (
            f"Divided by {words}: straight edges stay straight, but edges that were parallel are"
            " now up to"
        )
        text += (
            f" {angle(np.degrees(change['parallel edges']))} apart. The last row of T is no longer"
            " 0 0 0 1."
        )
    elif kind == "mirror":
        text = (
            f"Mirrored, {words}: det is {det}. Every length and angle is kept, but a left hand"
            " would now be a right"
        )
        text += " one; no rotation does that."
    elif kind == "translate":
        text = (
            f"Translated by {words}: every point (w = 1) moved {length(moved)}, every direction (w"
            " = 0) 0 m."
        )
    else:
        return _turn_caption(state, moved, f"Turned {words}", point)
    return Caption(text + _lock_words(state))


def _turn_caption(state: Built, moved: float, turned: str, point: int) -> Caption:
    lost = [change.name for change in state.by_factor if not change.kept]
    if lost:
        return Caption(f"{turned}: that changed {', '.join(lost)}, so it was no rotation.", "wrong")
    if kind_of(state.factor.matrix) is Kind.IDENTITY:
        text = f"{turned}, that is not at all: nothing moved."
    else:
        solid = "volume" if any(change.name == "volume" for change in state.by_factor) else "area"
        text = (
            f"{turned}: vertex {point} moved {length(moved)}, and every length, angle and {solid}"
            " survived."
        )
    return Caption(text + _lock_words(state))


def _undo_caption(state: Built) -> Caption:
    if state.left < SAME:
        text = (
            f"Taken back with (Rᵀ, −Rᵀt): all {len(state.body.solid.p):,} vertices are where they"
            " were before the motion."
        )
        stays = _shape_that_stays(state)
        return Caption(
            text + stays, "good" if not stays and state.params.compare in TAKEN_BACK else "info"
        )
    text = (
        f"Taken back by the given inverse: the farthest vertex is {length(state.left)} from where"
        " it was before"
    )
    return Caption(f"{text} the motion.", "wrong")


def _shape_that_stays(state: Built) -> str:
    """Say what the inverse of the motion leaves as it is: what was done to the shape before."""
    params = state.params
    done = [
        name
        for name, applied in (
            ("scale", params.scale != (1.0, 1.0, 1.0)),
            ("shear", params.shear != 0.0),
            ("division by w", params.perspective != 0.0),
            ("reflection", params.mirror != "none"),
        )
        if applied
    ]
    if not done:
        return ""
    volume = next(
        (change for change in state.by_all if change.name == "volume" and not change.kept), None
    )
    size = "" if volume is None else f", and with it the volume {times(volume.factor)}"
    return (
        f" The {' and the '.join(done)} came before it and"
        f" {'stays' if len(done) == 1 else 'stay'}{size}."
    )


def times(factor: float) -> str:
    """Write what an area or volume is multiplied by."""
    return f"× {fixed(factor, 2) if factor >= 0.1 else brief(factor, 2)}"


def _lock_words(state: Built) -> str:
    margin = gimbal_margin(state.angles, state.params.order)
    if state.turns < 3 or margin > NEAR_LOCK:
        return ""
    if margin < LOCKED:
        triple = in_degrees(other_triples(numbers_of(state.params))[0])
        return f" Gimbal lock: angles 1 and 3 turn about one axis; {triple} is the same rotation."
    apart = np.degrees(np.arcsin(min(margin, 1.0)))
    return f" Nearly gimbal lock: angles 1 and 3 turn about axes {angle(apart, 2)} apart."


def caption_of_move(state: Moved) -> Caption:
    """Say where the body is between the poses, and what it lost on the way."""
    way, shortest = state.way, state.shortest.turned[-1]
    method = state.params.method
    if len(way.times) == 1:
        return Caption(
            f"t = 0: the start. The shortest turn to the end is {fixed(shortest, 1)}°;"
            f" {_HOW[method]}."
        )
    step = way.turned[-1] - way.turned[-2]
    text = (
        f"t = {state.t:.2f} by {method.replace('-q', '−q')}: turned {fixed(way.turned[-1], 1)}° so"
        " far, pose by pose,"
    )
    text += f" {fixed(step, 1)}° of it in this step"
    if abs(state.volume - 1.0) > SAME:
        share = f"the volume is {percent(abs(state.volume))} of the start's"
        return Caption(
            f"{text}; {share}{', mirrored' * (state.volume < 0)}, so this is no rotation.", "wrong"
        )
    if state.t < 1.0:
        aside = float(np.linalg.norm(state.T_world_body[:3, 3] - state.T_world_shortest[:3, 3]))
        place = f", its origin {length(aside)} from where lerp has it" if aside > SAME else ""
        turn = (
            f"{angle(state.off, 2)} from the shortest turn"
            if state.off > 1e-6
            else "on the shortest turn"
        )
        return Caption(f"{text}; {turn}{place}.")
    return _arrival(state, text, float(shortest))


def _arrival(state: Moved, text: str, shortest: float) -> Caption:
    """Say at t = 1 whether the end is met, and whether the way there was the shortest turn of a
    rigid body.
    """
    p, lowest = state.body.solid.p, float(np.abs(state.way.volume).min())
    missed = np.linalg.norm(
        transform(state.T_world_body, p) - transform(state.T_world_end, p), axis=1
    ).max()
    if missed > SAME:
        return Caption(
            f"{text}. The end is missed: the farthest vertex is {length(float(missed))} off.",
            "wrong",
        )
    if abs(lowest - 1.0) > SAME:
        return Caption(
            f"{text}. The end is met, but on the way the volume fell to {percent(lowest)}."
        )
    text += f". The end is met; the shortest turn is {fixed(shortest, 1)}°."
    return Caption(text, "info" if state.way.turned[-1] > shortest + 0.05 else "good")
