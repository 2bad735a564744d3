"""The caption of every step."""

import numpy as np

from lessons.transforms.body import FRONT, numbers_of
from lessons.transforms.compare import in_degrees, other_triples
from lessons.transforms.states import Built, Moved
from workbench.geometry.affine import Kind, kind_of, transform
from workbench.geometry.rotations import gimbal_margin
from workbench.scene import Caption

EXACT = 1e-9  # metres


def caption_of_build(state: Built) -> Caption:
    """Say what the newest factor did, and how the second reading compares once the map is complete."""
    caption = _factor_caption(state)
    distances = [ghost.distance for ghost in state.ghosts]
    if state.factor.kind == "undo" and distances:
        return Caption(f"{caption.text} {state.ghosts[0].name} leaves it {distances[0]:.2f} m off.", "wrong")
    if state.complete and distances:
        return Caption(f"{caption.text} Beside it: {state.params.compare}, {_spread(distances)}.", caption.tone)
    if state.complete and state.params.compare == "direction with w = 1":
        right, wrong = (state.T @ np.append(FRONT, w) for w in (0.0, 1.0))
        off = np.degrees(angle_between(right[:3], wrong[:3]))
        return Caption(f"{caption.text} The front taken with w = 1 points {off:.0f}° off.", "wrong")
    return caption


def angle_between(v: np.ndarray, w: np.ndarray) -> float:
    """Return the angle between two directions, radians."""
    return float(np.arctan2(np.linalg.norm(np.cross(v, w)), v @ w))


def _spread(distances: list[float]) -> str:
    same = sum(d < EXACT for d in distances)
    if same == len(distances):
        return "exactly the same motion"
    others = [d for d in distances if d >= EXACT]
    text = f"{min(others):.2f}" + (f" to {max(others):.2f}" if len(others) > 1 else "") + " m off"
    return f"one the same, {text}" if same == 1 else text


def _factor_caption(state: Built) -> Caption:
    kind, words, point = state.factor.kind, state.factor.words, state.body.point
    change = {c.name: c.amount for c in state.by_factor}
    moved = float(np.linalg.norm(state.trail[-1] - state.trail[max(len(state.trail) - 2, 0)]))
    det = f"{np.linalg.det(state.factor.matrix[:3, :3]):.2f}"
    if kind == "undo":
        left = f"the farthest vertex is {1000 * state.left:.1f} mm from where it was before the motion."
        return Caption(f"Taken back with (Rᵀ, −Rᵀt): {left}", "good" if state.left < 1e-6 else "wrong")
    if kind == "start":
        volume = state.body.measures.volume
        size = f"{len(state.body.solid.p):,} vertices" + ("" if np.isnan(volume) else f", volume {volume:.3f} m³")
        return Caption(f"The {state.body.name} before anything is done: {size}; T is the identity.")
    if kind == "scale":
        text = f"Scaled, {words}: edges change by up to {100 * change['edge lengths']:.0f} %, volume × {det}."
    elif kind == "shear":
        text = f"Sheared, {words}: angles change by up to {np.degrees(change['angles']):.1f}°, yet det is {det}: the"
        text += " volume stays."
    elif kind == "perspective":
        text = f"Divided by {words}: straight edges stay straight, but parallel ones now differ by up to"
        text += f" {np.degrees(change['parallel edges']):.1f}°. The last row of T is no longer 0 0 0 1."
    elif kind == "mirror":
        text = f"Mirrored, {words}: det is {det}. Every length and angle is kept, but right and left changed places; no"
        text += " rotation does that."
    elif kind == "translate":
        text = f"Translated by {words}: every point (w = 1) moved {moved:.2f} m, every direction (w = 0) 0 m."
    else:
        text = f"Turned {words}: vertex {point} moved {moved:.2f} m, and every length, angle and volume survived."
        if not moved and kind_of(state.factor.matrix) is Kind.IDENTITY:
            text = f"Turned {words}, that is not at all: nothing moved."
    return Caption(text + (_lock_words(state) if state.turns == 3 else ""))


def _lock_words(state: Built) -> str:
    margin = gimbal_margin(state.angles, state.params.order)
    if margin > 0.1:
        return ""
    apart = np.degrees(np.arcsin(min(margin, 1.0)))
    text = f" Gimbal lock: angles 1 and 3 turn about axes {apart:.1f}° apart"
    if margin < 1e-12:
        text += f"; {in_degrees(other_triples(numbers_of(state.params))[0])} is the same rotation"
    return text + "."


def caption_of_move(state: Moved) -> Caption:
    """Say where the body is between the poses, and what it lost on the way."""
    way, method, shortest = state.way, state.params.method, state.shortest.turned[-1]
    if len(way.times) == 1:
        how = "slerp turns just that, about one axis" if "lerp +" in method else f"watch what {method} makes of it"
        return Caption(f"t = 0: the start. The shortest turn to the end is {shortest:.1f}°; {how}.")
    step = way.turned[-1] - way.turned[-2]
    text = f"t = {state.t:.2f} by {method}: turned {way.turned[-1]:.1f}° so far, {step:.1f}° of it in this step"
    if abs(state.volume - 1.0) > 1e-9:
        text += f"; the volume is {100 * state.volume:.0f} % of the start's, so this is no rotation."
        return Caption(text, "wrong")
    if state.t < 1.0:
        aside = np.linalg.norm(state.T_world_body[:3, 3] - state.T_world_shortest[:3, 3])
        arc = f", its origin {aside:.2f} m off the straight line" if aside > EXACT else ""
        return Caption(f"{text}; {state.off:.1f}° from the shortest turn{arc}.")
    p = state.body.solid.p
    missed = np.linalg.norm(transform(state.T_world_body, p) - transform(state.T_world_end, p), axis=1).max()
    text += f". The end is met within {1000 * missed:.1f} mm; the shortest turn needed {shortest:.1f}°."
    return Caption(text, "info" if way.turned[-1] > shortest + 0.05 else "good")
