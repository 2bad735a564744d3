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
    now = look.now
    way = now.way
    method = look.params.method
    point = min(params.point, len(body.solid.p) - 1)
    scene: dict[str, Primitive] = {
        "ground": GROUND,
        **_ends(look),
        **shown("body", body, now.T_world_body, name=f"by {method}"),
        "shortest": lines(body, now.T_world_shortest, color="truth", name="shortest turn"),
        "shortest path": Segments(segments(now.shortest.path), "truth", 3),
        **_axes_of_turns(look),
        "vertex": Label(f"vertex {point}", way.path[-1], "highlight"),
        "off": OFF.scalar(now.off, "from the shortest turn", "truth"),
        "volume": VOLUME.scalar(100 * now.volume, "volume"),
        "t": TIME.scalar(now.t, "t"),
        "turned so far": TOTAL.scalar(float(way.turned[-1]), "turned in all"),
        "turned by the shortest": TOTAL.scalar(
            float(now.shortest.turned[len(way.times) - 1]), "turned at best", "truth"
        ),
        "matrix": Table.of_matrix(
            f"T at t = {now.t:.2f}", ("x axis", "y axis", "z axis", "origin"), now.T_world_body
        ),
        "numbers": numbers(now.T_world_body[:3, :3]),
        "turned at best": TURNED.whole(
            now.shortest.times, now.shortest.turned, "shortest turn", "truth"
        ),
        "turned": TURNED.second(way.times, way.turned, f"by {method}", "source"),
        "turned mark": TURNED.mark(now.t, float(way.turned[-1]), "now", "source", steps="t"),
        "caption": caption(look),
    }
    if is_about_one_place(now):
        radius = float(np.linalg.norm(now.shortest.path[0]))
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
    now = look.now
    if is_about_one_place(now):
        return {"end edges": lines(body, now.T_world_end, color="target", name="the end")}
    return {
        **shown("start", body, now.T_world_start, color="target", opacity=0.12),
        **shown("end", body, now.T_world_end, color="target", opacity=0.12),
        "start name": _above("start", body, now.T_world_start),
        "end name": _above("end", body, now.T_world_end),
    }


def is_about_one_place(now: Moved) -> bool:
    """Whether the origin of the body stays: the followed vertex is on a globe then."""
    return not now.T_world_end[:3, 3].any()


def _above(word: str, body: Body, T: np.ndarray) -> Label:
    p = transform(T, body.solid.p)
    return Label(word, p[np.argmax(p[:, 2])] + [0.0, 0.0, 0.05], "target")


def _axes_of_turns(look: Look[Input, Body, Moved]) -> dict[str, Primitive]:
    """Return the axis of the shortest turn, and the line about which the body turned to come here:
    for a screw, its own.
    """
    now = look.now
    scene = dict[str, Primitive]()
    R = now.T_world_end[:3, :3] @ now.T_world_start[:3, :3].T
    axis, turn = axis_angle_from_rotation(R)
    if turn > ROUND_OFF:
        scene |= _line("axis shortest", now.T_world_shortest[:3, 3], axis, color="truth")
    if not (is_rigid(now.T_world_body) and is_rigid(now.T_world_before)):
        return scene
    step = now.T_world_body @ inverse(now.T_world_before)
    axis, turn = axis_angle_from_rotation(step[:3, :3])
    if turn > ROUND_OFF:
        p = now.T_world_body[:3, 3]
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
    now = look.now
    method = look.params.method
    way = now.way
    shortest = float(now.shortest.turned[-1])
    if len(way.times) == 1:
        said = "t = 0, the start. The shortest turn to the end is {shortest}; " + HOW[method] + "."
        return say(said, shortest=degrees(shortest, 4))
    values: dict[str, Any] = {"t": fixed(now.t, 2), "turned": degrees(float(way.turned[-1]), 4)}
    begun = "t = {t}: turned {turned} so far"
    if abs(now.volume - 1.0) > SAME:
        mirrored = ", mirrored" if now.volume < 0 else ""
        said = begun + f"; the volume is {{left}} of the start's{mirrored}, so this is no rotation."
        return say(said, tone="wrong", left=share(abs(now.volume)), **values)
    if now.t < 1.0:
        aside = float(np.linalg.norm((now.T_world_body - now.T_world_shortest)[:3, 3]))
        said = begun + (
            ", on the shortest turn" if now.off <= 1e-6 else ", {off} from the shortest turn"
        )
        if now.off > 1e-6:
            values["off"] = degrees(now.off)
        if aside > SAME:
            return say(said + "; lerp has its origin {aside} away.", aside=metres(aside), **values)
        return say(said + ".", **values)
    return _arrival(look, begun, values)


def _arrival(look: Look[Input, Body, Moved], begun: str, values: dict[str, Any]) -> Caption:
    """Say at t = 1 whether the end is met, and whether the way there was the shortest turn."""
    now = look.now
    p = look.subject.solid.p
    shortest = float(now.shortest.turned[-1])
    lowest = float(np.abs(now.way.volume).min())
    apart = transform(now.T_world_body, p) - transform(now.T_world_end, p)
    missed = float(np.linalg.norm(apart, axis=1).max())
    if missed > SAME:
        said = begun + ". The end is missed: the farthest vertex is {missed} off."
        return say(said, tone="wrong", missed=metres(missed), **values)
    if abs(lowest - 1.0) > SAME:
        said = begun + ". The end is met, but on the way the volume fell to {lowest}."
        return say(said, lowest=share(lowest), **values)
    is_best = now.way.turned[-1] <= shortest + 0.05
    said = begun + ". The end is met; the shortest turn is {shortest}."
    return say(said, tone="good" if is_best else "info", shortest=degrees(shortest, 4), **values)
