"""What one step looks like: the body and where it started, the numbers beside it, and what just
happened in words.
"""

import functools

import numpy as np

from lessons.transforms.captions import caption_of_build, caption_of_move, times
from lessons.transforms.state import FRONT, Body, Built, Ghost, Moved, State
from workbench.data.framing import ground_grid
from workbench.geometry.meshes.invariants import Change
from workbench.geometry.motions import inverse
from workbench.geometry.motions.affine import (
    decompose,
    is_affine,
    kind_of,
    transform,
    transform_directions,
    translation,
)
from workbench.geometry.motions.rotations import (
    EulerOrder,
    axis_angle_from_rotation,
    euler_axes,
    gimbal_margin,
    matrix_to_euler,
    quaternion_from_matrix,
)
from workbench.geometry.polylines import between, segments
from workbench.numerals import ROUND_OFF, angle, fixed, fixed_row, length, percent
from workbench.scene import (
    Axes,
    Chart,
    Curve,
    Label,
    Mesh,
    Primitive,
    Role,
    Scene,
    Segments,
    Table,
    is_rigid,
)

TURNED, SPEED = Chart("Turned so far", "t", "deg"), Chart("Turning speed", "t", "deg per unit of t")
DET, MOVED = Chart("det T"), Chart("Distance", unit="m")
OFF, VOLUME = Chart("Error to truth", unit="deg"), Chart("Volume", unit="%")
GIMBAL = Chart("Gimbal lock", "middle angle (deg)", "sine between axes")
MIDDLE = np.arange(-180.0, 181.0, 5.0)  # degrees
GROUND = Segments(ground_grid(0.5, 0.0, 2.5), "neutral", 1, opacity=0.2, name="grid 0.5 m")
AXIS_ROLES: tuple[Role, ...] = ("x", "y", "z")


def draw(state: State) -> Scene:
    """Return the picture of one step."""
    return _draw_build(state) if isinstance(state, Built) else _draw_move(state)


def _draw_build(state: Built) -> Scene:
    body, T, T_body = state.body, state.T, state.T_world_body
    scene: dict[str, Primitive] = {
        "ground": GROUND,
        **_shown("start", body, np.eye(4), "target", 0.15),
        **_shown("body", body, T, "source", 0.85),
        "world": Axes(None, 0.4, name="world axes"),
        "start name": _above("start", body, np.eye(4)),
        "vertex": Label(f"vertex {body.point}", state.trail[-1], "highlight"),
        "volume": DET.scalar(float(np.linalg.det(T[:3, :3])) if is_affine(T) else np.nan, "det T"),
        "moved": MOVED.scalar(
            float(np.linalg.norm(state.trail[-1] - state.trail[0])),
            f"vertex {body.point} from its start",
        ),
        "matrix": _matrix(T, "T, all factors so far"),
        "measured": _invariants(state),
        "numbers": _in_other_numbers(T, T_body, state.params.order),
        "one point": _one_point(state),
        "gimbal": _gimbal_curve(state),
        "caption": caption_of_build(state),
    }
    if len(state.trail) > 1:
        scene["trail"] = Segments(
            segments(state.trail), "highlight", 2.5, name=f"vertex {body.point}, factor by factor"
        )
    if is_affine(T):
        scene["front"] = _front(body, T)
    if state.params.compare == "direction with w = 1":
        wrong = transform(T, FRONT[None])[0]
        p_door = transform(T, body.p_door[None])[0]
        scene["wrong front"] = Segments(
            between(p_door, p_door + 0.5 * wrong), "wrong", 3, name="with w = 1"
        )
    if state.factor.kind == "turn" or (state.complete and _shows_lock(state)):
        scene |= _turning_axes(state)
    for i, ghost in enumerate(state.ghosts):
        scene |= _ghost(i, ghost, body)
    if np.isfinite(state.left):
        scene["left"] = MOVED.scalar(state.left, "left after taking it back", "truth")
    if state.factor.kind not in ("start", "undo"):
        scene["frame"] = Axes(T_body, 0.35, name="body axes")
    return scene


def _draw_move(state: Moved) -> Scene:
    body, way = state.body, state.way
    x = state.shortest.times
    scene: dict[str, Primitive] = {
        "ground": GROUND,
        **_shown("start", body, state.T_world_start, "target", 0.15),
        **_shown("end", body, state.T_world_end, "target", 0.15),
        **_shown("body", body, state.T_world_body, "source", 0.85, f"by {state.params.method}"),
        "start name": _above("start", body, state.T_world_start),
        "end name": _above("end", body, state.T_world_end),
        "shortest": _lines(body, state.T_world_shortest, "truth", "shortest turn"),
        "shortest path": Segments(segments(state.shortest.path), "truth", 2),
        **_axes_of_turns(state),
        "vertex": Label(f"vertex {body.point}", way.path[-1], "highlight"),
        "off": OFF.scalar(state.off, "from the shortest turn", "truth"),
        "volume": VOLUME.scalar(100 * state.volume, "volume"),
        "matrix": _matrix(state.T_world_body, f"T at t = {state.t:.2f}"),
        "measured": _invariants(state),
        "numbers": _in_other_numbers(state.T_world_body, state.T_world_body, state.params.order),
        "turned": TURNED.curve(way.times, way.turned, state.params.method, marks=(state.t,)),
        "turned at best": TURNED.curve(x, state.shortest.turned, "shortest turn", "truth"),
        "caption": caption_of_move(state),
    }
    if len(way.path) > 1:
        scene["path"] = Segments(
            segments(way.path), "source", 3, name=f"path of vertex {body.point}"
        )
        scene["speed"] = SPEED.curve(
            way.times[1:], np.diff(way.turned) / np.diff(way.times), state.params.method
        )
    return scene


def _above(word: str, body: Body, T: np.ndarray) -> Label:
    p = transform(T, body.solid.p)
    return Label(word, p[np.argmax(p[:, 2])] + [0.0, 0.0, 0.05], "target")


def _axes_of_turns(state: Moved) -> dict[str, Primitive]:
    """Return the axis of the shortest turn, and the line about which the body turned to come here:
    for a screw, its own.
    """
    axis, turn = axis_angle_from_rotation(state.T_world_end[:3, :3] @ state.T_world_start[:3, :3].T)
    scene: dict[str, Primitive] = {}
    if turn > ROUND_OFF:
        scene |= _line(
            "axis shortest", state.T_world_shortest[:3, 3], axis, "truth", "shortest turn"
        )
    if not (is_rigid(state.T_world_body) and is_rigid(state.T_world_before)):
        return scene
    step = state.T_world_body @ inverse(state.T_world_before)
    axis, turn = axis_angle_from_rotation(step[:3, :3])
    if turn > ROUND_OFF:
        p = state.T_world_body[:3, 3]
        if (
            state.params.method == "screw"
        ):  # what stays on its line: (I - R) p is the shift across the axis
            across = step[:3, 3] - axis * (axis @ step[:3, 3])
            p = np.linalg.lstsq(np.eye(3) - step[:3, :3], across)[0] + axis * (axis @ p)
        scene |= _line("axis", p, axis, "source", "turning now")
    return scene


def _line(
    path: str, p: np.ndarray, axis: np.ndarray, color: Role, name: str
) -> dict[str, Primitive]:
    up = axis if axis[2] > -1e-9 else -axis
    ends = between(p - 0.6 * up, p + up)
    return {path: Segments(ends, color, 2.5), f"{path} name": Label(name, ends[0, 1], color)}


def _shown(
    path: str, body: Body, T: np.ndarray, color: Role, opacity: float, name: str = ""
) -> dict[str, Primitive]:
    """Return the body as a surface with its edges; the faces of a mirrored one go round the other
    way.
    """
    p, faces, pose = body.solid.p, body.solid.faces, T
    if not is_affine(T):
        p, pose = transform(T, p), None
    elif np.linalg.det(T[:3, :3]) < 0:
        faces = faces[:, ::-1]
    return {
        path: Mesh(p, faces, color, pose, opacity, flat=True, name=name),
        f"{path} edges": _lines(body, T, "target" if color == "target" else "neutral", ""),
    }


def _lines(body: Body, T: np.ndarray, color: Role, name: str) -> Segments:
    ends, pose = body.solid.lines, T
    if not is_affine(T):
        ends, pose = transform(T, ends.reshape(-1, 3)).reshape(-1, 2, 3), None
    return Segments(ends, color, 2.0, pose, name=name)


def _ghost(i: int, ghost: Ghost, body: Body) -> dict[str, Primitive]:
    T = translation(ghost.apart) @ ghost.T
    p = transform(T, body.solid.p)
    p_label = p[np.argmax(p[:, 2])] + [0.0, 0.0, 0.08 + (0.0 if ghost.apart.any() else 0.1 * i)]
    ends = "ends the same" if ghost.same else f"farthest vertex {length(ghost.distance)} off"
    return {
        f"ghost {i}": _lines(body, T, ghost.color, ""),
        f"ghost {i} name": Label(f"{ghost.name}: {ends}", p_label, ghost.color),
    }


def _front(body: Body, T: np.ndarray) -> Segments:
    v = 0.5 * transform_directions(T, FRONT[None])[0]
    side = 0.08 * np.cross(v, [0.0, 0.0, 1.0] if abs(v[2]) < 0.4 else [1.0, 0.0, 0.0])
    p = transform(T, body.p_door[None])[0]
    tip, neck = p + v, p + v - 0.2 * v
    ends = np.array([[p, tip], [tip, neck + side], [tip, neck - side]])
    return Segments(ends, "highlight", 3, name="front: a direction, w = 0")


def _turning_axes(state: Built) -> dict[str, Primitive]:
    """Return the directions about which the three angles now turn the body; the one turned last is
    thick.
    """
    axes = euler_axes(state.angles, state.params.order)
    last = (
        state.params.first == "rotate, then translate"
    )  # the turns came first and were carried along since
    middle = state.T_world_body[:3, 3] if last else np.zeros(3)
    scene: dict[str, Primitive] = {}
    for k, (axis, letter) in enumerate(zip(axes, state.params.order, strict=True)):
        up = (1.6, 1.35, 1.1)[k] * (axis if axis[2] > -1e-9 else -axis)
        width = 6.0 if k == state.turns - 1 else 3.0
        role, name = AXIS_ROLES["xyz".index(letter.lower())], f"angle {k + 1} ({letter})"
        scene[f"axis {k + 1}"] = Segments(between(middle - 0.7 * up, middle + up), role, width)
        scene[f"axis {k + 1} name"] = Label(name, middle + up, role)
    return scene


def _shows_lock(state: Built) -> bool:
    return (
        state.params.compare == "other triples"
        or gimbal_margin(state.angles, state.params.order) < 0.1
    )


@functools.cache
def _margins(order: EulerOrder) -> np.ndarray:
    """Return how far from gimbal lock each middle angle is; the other two do not matter."""
    return np.array([gimbal_margin(np.array([0.0, m, 0.0]), order) for m in np.radians(MIDDLE)])


def _gimbal_curve(state: Built) -> Curve:
    name, marks = "0: the first and third axis are one", (state.params.angles[1],)
    return GIMBAL.curve(MIDDLE, _margins(state.params.order), name, "highlight", marks=marks)


def _matrix(T: np.ndarray, title: str) -> Table:
    """Show a 4×4; its columns are where the axes and the origin go."""
    return Table.of_matrix(title, ("x axis", "y axis", "z axis", "origin"), T)


def _amount(change: Change) -> str:
    """Say in a few words what became of a measure."""
    if change.kept:
        return "kept"
    if change.name == "orientation":
        return "flipped"
    if change.unit == "rad":
        return f"by up to {angle(np.degrees(change.amount))}"
    return f"by up to {percent(change.amount)}" if np.isnan(change.factor) else times(change.factor)


def _invariants(state: State) -> Table:
    """Show which measures of the body survived, this factor and all of them."""
    if isinstance(state, Built):
        header = ("measured", "this factor", "all so far")
        lines = [
            (a.name, _amount(a), _amount(b))
            for a, b in zip(state.by_factor, state.by_all, strict=True)
        ]
        kinds = ("kind of map", kind_of(state.factor.matrix).value, kind_of(state.T).value)
        return Table("What survives", header, (kinds, *lines))
    lines = [(change.name, _amount(change)) for change in state.by_all]
    return Table(
        "What survives",
        ("measured", "since the start"),
        (("kind of map", kind_of(state.T_world_body).value), *lines),
    )


def _one_point(state: Built) -> Table:
    """Show the followed vertex (w = 1) and the direction to the front (w = 0) before and after the
    map.
    """
    columns = [np.append(state.body.p_point, 1.0), np.append(FRONT, 0.0)]
    p, v = columns
    after_p, after_v = state.T @ p, state.T @ v
    lines = zip("xyzw", p, after_p, v, after_v, strict=True)
    return Table(
        "A point and a direction",
        ("", f"vertex {state.body.point}", "T · vertex", "front", "T · front"),
        tuple((name, *(fixed(value, 2) for value in values)) for name, *values in lines),
    )


def _in_other_numbers(T: np.ndarray, T_world_body: np.ndarray, order: EulerOrder) -> Table:
    """Show the rotation in a 4×4 under its other names; what stretches or mirrors is split off
    first.

    A projective map has no such parts: then the rotation is that of its rigid factors alone.
    """
    affine = is_affine(T)
    parts = decompose(T if affine else T_world_body)
    R = parts.rotation
    axis, radians = axis_angle_from_rotation(R)
    rows = [
        (
            f"Euler {order}",
            ", ".join(f"{fixed(a, 1)}°" for a in np.degrees(matrix_to_euler(R, order))),
        ),
        ("axis", fixed_row(axis, 2) if radians > ROUND_OFF else "any"),
        ("angle", f"{fixed(np.degrees(radians), 1)}°"),
        ("quaternion w, x, y, z", fixed_row(quaternion_from_matrix(R), 2)),
    ]
    if affine:
        stretches = fixed_row(np.linalg.eigvalsh(parts.stretch)[::-1], 2)
        rows += [
            ("stretch" + ", mirrored at the origin" * (parts.mirror < 0), stretches),
            ("det T", fixed(float(np.linalg.det(T[:3, :3])), 2)),
        ]
    return Table("The rotation, in other numbers", ("name", "numbers"), tuple(rows))
