"""What the stage `poses` looks like, and the caption of its steps."""

from typing import Any

import numpy as np

from lessons.rotations.drawing import GROUND, lines, numbers, shown
from lessons.rotations.inputs import Body, Input, Method
from lessons.rotations.poses import Moved
from workbench.captions import degrees, fixed, metres, share
from workbench.geometry.motions import inverse
from workbench.geometry.motions.affine import transform
from workbench.geometry.motions.rotations import axis_angle_from_rotation
from workbench.geometry.polylines import between, segments, sphere_rings
from workbench.lesson import Look, say
from workbench.numerals import ROUND_OFF
from workbench.scene import (
    Caption,
    Chart,
    Label,
    Primitive,
    Role,
    Scene,
    Segments,
    Table,
    is_rigid,
)

SAME = 1e-9  # metres: what rounding leaves
TURNED = Chart("Turned so far", "t", "deg", x_range=(0.0, 1.0), y_range=(0.0, 360.0))
SPEED = Chart("Turning speed", "t", "deg per unit of t")
OFF = Chart("Error to truth", unit="deg")
VOLUME = Chart("Volume", unit="%")
TIME = Chart("Time")
TOTAL = Chart("Turned", unit="deg")
HOW: dict[Method, str] = {
    "slerp + lerp": "slerp goes just that turn, about one axis",
    "Euler angles": "each of the three angles runs at constant speed",
    "matrix entries": "each entry of the matrix runs at constant speed",
    "slerp to -q": "slerp runs to −q, which is the end's rotation too",
    "screw": "one screw turns and slides at constant speed",
}


def draw(look: Look[Input, Body, Moved]) -> Scene:
    """Return the picture of one time between the poses."""
    params = look.params
    body = look.subject
    state = look.now
    way = state.way
    method = look.params.method
    point = min(params.point, len(body.solid.p) - 1)
    scene: dict[str, Primitive] = {
        "ground": GROUND,
        **_ends(look),
        **shown("body", body, state.T_world_body, name=f"by {method}"),
        "shortest": lines(body, state.T_world_shortest, color="truth", name="shortest turn"),
        "shortest path": Segments(segments(state.shortest.path), "truth", 3),
        **_axes_of_turns(look),
        "vertex": Label(f"vertex {point}", way.path[-1], "highlight"),
        "off": OFF.scalar(state.off, "from the shortest turn", "truth"),
        "volume": VOLUME.scalar(100 * state.volume, "volume"),
        "t": TIME.scalar(state.t, "t"),
        "turned so far": TOTAL.scalar(float(way.turned[-1]), "turned in all"),
        "turned by the shortest": TOTAL.scalar(
            float(state.shortest.turned[len(way.times) - 1]), "turned at best", "truth"
        ),
        "matrix": Table.of_matrix(
            f"T at t = {state.t:.2f}", ("x axis", "y axis", "z axis", "origin"), state.T_world_body
        ),
        "numbers": numbers(state.T_world_body[:3, :3]),
        "turned at best": TURNED.whole(
            state.shortest.times, state.shortest.turned, "shortest turn", "truth"
        ),
        "turned": TURNED.second(way.times, way.turned, f"by {method}", "source"),
        "turned mark": TURNED.mark(state.t, float(way.turned[-1]), "now", "source", steps="t"),
        "caption": caption(look),
    }
    if is_about_one_place(state):
        radius = float(np.linalg.norm(state.shortest.path[0]))
        globe = sphere_rings(np.zeros(3), max(radius, 1e-6))
        scene["globe"] = Segments(globe, "neutral", 1.0, opacity=0.35, name="globe of the vertex")
    if len(way.path) > 1:
        scene["path"] = Segments(segments(way.path), "source", 4, name=f"path of vertex {point}")
        speed = np.diff(way.turned) / np.diff(way.times)
        scene["speed"] = SPEED.curve(way.times[1:], speed, method)
    return scene


def _ends(look: Look[Input, Body, Moved]) -> dict[str, Primitive]:
    """Return both poses; where all turns are about one place, the outline of the end alone."""
    body = look.subject
    state = look.now
    if is_about_one_place(state):
        return {"end edges": lines(body, state.T_world_end, color="target", name="the end")}
    return {
        **shown("start", body, state.T_world_start, color="target", opacity=0.12),
        **shown("end", body, state.T_world_end, color="target", opacity=0.12),
        "start name": _above("start", body, state.T_world_start),
        "end name": _above("end", body, state.T_world_end),
    }


def is_about_one_place(state: Moved) -> bool:
    """Whether the origin of the body stays: the followed vertex is on a globe then."""
    return not state.T_world_end[:3, 3].any()


def _above(word: str, body: Body, T: np.ndarray) -> Label:
    p = transform(T, body.solid.p)
    return Label(word, p[np.argmax(p[:, 2])] + [0.0, 0.0, 0.05], "target")


def _axes_of_turns(look: Look[Input, Body, Moved]) -> dict[str, Primitive]:
    """Return the axis of the shortest turn, and the line about which the body turned to come here:
    for a screw, its own.
    """
    state = look.now
    scene = dict[str, Primitive]()
    R = state.T_world_end[:3, :3] @ state.T_world_start[:3, :3].T
    axis, turn = axis_angle_from_rotation(R)
    if turn > ROUND_OFF:
        scene |= _line("axis shortest", state.T_world_shortest[:3, 3], axis, color="truth")
    if not (is_rigid(state.T_world_body) and is_rigid(state.T_world_before)):
        return scene
    step = state.T_world_body @ inverse(state.T_world_before)
    axis, turn = axis_angle_from_rotation(step[:3, :3])
    if turn > ROUND_OFF:
        p = state.T_world_body[:3, 3]
        if look.params.method == "screw":
            # what stays on its line: (I - R) p is the shift across the axis
            across = step[:3, 3] - axis * (axis @ step[:3, 3])
            p = np.linalg.lstsq(np.eye(3) - step[:3, :3], across)[0] + axis * (axis @ p)
        scene |= _line("axis", p, axis, color="source")
    return scene


def _line(path: str, p: np.ndarray, axis: np.ndarray, *, color: Role) -> dict[str, Primitive]:
    up = axis if axis[2] > -1e-9 else -axis
    ends = between(p - 0.6 * up, p + 1.15 * up)
    name = "shortest turn" if color == "truth" else "turning now"
    return {path: Segments(ends, color, 2.5), f"{path} name": Label(name, ends[0, 1], color)}


def caption(look: Look[Input, Body, Moved]) -> Caption:
    """Return where the body is between the poses, and what it lost on the way."""
    state = look.now
    method = look.params.method
    way = state.way
    shortest = float(state.shortest.turned[-1])
    if len(way.times) == 1:
        text = "t = 0, the start. The shortest turn to the end is {shortest}; " + HOW[method] + "."
        return say(text, shortest=degrees(shortest, 4))
    values: dict[str, Any] = {"t": fixed(state.t, 2), "turned": degrees(float(way.turned[-1]), 4)}
    begun = "t = {t}: turned {turned} so far"
    if abs(state.volume - 1.0) > SAME:
        mirrored = ", mirrored" if state.volume < 0 else ""
        text = begun + f"; the volume is {{left}} of the start's{mirrored}, so this is no rotation."
        return say(text, tone="wrong", left=share(abs(state.volume)), **values)
    if state.t < 1.0:
        aside = float(np.linalg.norm((state.T_world_body - state.T_world_shortest)[:3, 3]))
        text = begun + (
            ", on the shortest turn" if state.off <= 1e-6 else ", {off} from the shortest turn"
        )
        if state.off > 1e-6:
            values["off"] = degrees(state.off)
        if aside > SAME:
            return say(text + "; lerp has its origin {aside} away.", aside=metres(aside), **values)
        return say(text + ".", **values)
    return _arrival(look, begun, values)


def _arrival(look: Look[Input, Body, Moved], begun: str, values: dict[str, Any]) -> Caption:
    """Say at t = 1 whether the end is met, and whether the way there was the shortest turn."""
    state = look.now
    p = look.subject.solid.p
    shortest = float(state.shortest.turned[-1])
    lowest = float(np.abs(state.way.volume).min())
    apart = transform(state.T_world_body, p) - transform(state.T_world_end, p)
    missed = float(np.linalg.norm(apart, axis=1).max())
    if missed > SAME:
        text = begun + ". The end is missed: the farthest vertex is {missed} off."
        return say(text, tone="wrong", missed=metres(missed), **values)
    if abs(lowest - 1.0) > SAME:
        text = begun + ". The end is met, but on the way the volume fell to {lowest}."
        return say(text, lowest=share(lowest), **values)
    is_best = state.way.turned[-1] <= shortest + 0.05
    text = begun + ". The end is met; the shortest turn is {shortest}."
    return say(text, tone="good" if is_best else "info", shortest=degrees(shortest, 4), **values)
