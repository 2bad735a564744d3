"""What one step looks like: the body and where it started, the numbers beside it, and what just happened in words."""

import functools

import numpy as np

from lessons.transforms.body import FRONT, Body
from lessons.transforms.compare import Ghost
from lessons.transforms.states import Built, Moved, State
from lessons.transforms.tables import in_other_numbers, invariants, matrix, one_point
from lessons.transforms.words import caption_of_build, caption_of_move, length
from workbench.geometry.affine import transform, transform_directions, translation
from workbench.geometry.rotations import EulerOrder, euler_axes, gimbal_margin
from workbench.scene import Axes, Curve, Label, Mesh, Primitive, Role, Scalar, Scene, Segments

MIDDLE = np.arange(-180.0, 181.0, 5.0)  # degrees
AXIS_ROLES: tuple[Role, ...] = ("x", "y", "z")


def draw(state: State) -> Scene:
    """Return the picture of one step."""
    return _draw_build(state) if isinstance(state, Built) else _draw_move(state)


def _draw_build(state: Built) -> Scene:
    body, T, T_body = state.body, state.T, state.T_world_body
    scene: dict[str, Primitive] = {
        **_shown("start", body, np.eye(4), "target", 0.15, "start"),
        **_shown("body", body, T, "source", 0.85, "body now"),
        "world": Axes(None, 0.4, name="world axes"),
        "vertex": Label(f"vertex {body.point}", state.trail[-1], "highlight"),
        "volume": Scalar(float(np.linalg.det(T[:3, :3])) if _affine(T) else np.nan, "det T", "det T", "", "source"),
        "moved": Scalar(
            float(np.linalg.norm(state.trail[-1] - state.trail[0])),
            f"vertex {body.point} from its start",
            "Distance",
            "m",
        ),
        "matrix": matrix(T, "T, all factors so far"),
        "measured": invariants(state),
        "numbers": in_other_numbers(T, T_body, state.params.order),
        "one point": one_point(state),
        "gimbal": _gimbal_curve(state),
        "caption": caption_of_build(state),
    }
    if len(state.trail) > 1:
        ends = np.stack([state.trail[:-1], state.trail[1:]], axis=1)
        scene["trail"] = Segments(ends, "highlight", 2.5, name=f"vertex {body.point}, factor by factor")
    if _affine(T):
        scene["front"] = _arrow(transform(T, body.p_door[None])[0], T, "highlight", "front: a direction, w = 0")
    if state.params.compare == "direction with w = 1":
        wrong = transform(T, FRONT[None])[0]
        p_door = transform(T, body.p_door[None])[0]
        scene["wrong front"] = Segments(np.array([[p_door, p_door + 0.5 * wrong]]), "wrong", 3, name="with w = 1")
    if state.factor.kind == "turn" or (state.complete and _shows_lock(state)):
        scene |= _turning_axes(state)
    for i, ghost in enumerate(state.ghosts):
        scene |= _ghost(i, ghost, body)
    if state.left == state.left:
        scene["left"] = Scalar(state.left, "left after taking it back", "Distance", "m", "truth")
    if state.factor.kind not in ("start", "undo"):
        scene["frame"] = Axes(T_body, 0.35, name="body axes")
    return scene


def _draw_move(state: Moved) -> Scene:
    body, way = state.body, state.way
    x = state.shortest.times
    scene: dict[str, Primitive] = {
        **_shown("start", body, state.T_world_start, "target", 0.15, "start"),
        **_shown("end", body, state.T_world_end, "target", 0.15, "end"),
        **_shown("body", body, state.T_world_body, "source", 0.85, f"by {state.params.method}"),
        "shortest": _lines(body, state.T_world_shortest, "truth", "shortest turn"),
        "shortest path": Segments(_steps(state.shortest.path), "truth", 2, name="its path"),
        "vertex": Label(f"vertex {body.point}", way.path[-1], "highlight"),
        "off": Scalar(state.off, "from the shortest turn", "Error to truth", "deg", "truth"),
        "volume": Scalar(100 * state.volume, "volume", "Volume", "%"),
        "matrix": matrix(state.T_world_body, f"T at t = {state.t:.2f}"),
        "measured": invariants(state),
        "numbers": in_other_numbers(state.T_world_body, state.T_world_body, state.params.order),
        "turned": Curve(way.times, way.turned, state.params.method, "Turned so far", "t", "deg", marks=(state.t,)),
        "turned at best": Curve(x, state.shortest.turned, "shortest turn", "Turned so far", "t", "deg", "truth"),
        "caption": caption_of_move(state),
    }
    if len(way.path) > 1:
        scene["path"] = Segments(_steps(way.path), "source", 3, name=f"path of vertex {body.point}")
        speed = np.diff(way.turned) / np.diff(way.times)
        scene["speed"] = Curve(way.times[1:], speed, state.params.method, "Turning speed", "t", "deg per unit of t")
    return scene


def _shown(path: str, body: Body, T: np.ndarray, color: Role, opacity: float, name: str) -> dict[str, Primitive]:
    """Return the body as a surface with its edges; the faces of a mirrored one go round the other way."""
    p, faces, pose = body.solid.p, body.solid.faces, T
    if not _affine(T):
        p, pose = transform(T, p), None
    elif np.linalg.det(T[:3, :3]) < 0:
        faces = faces[:, ::-1]
    return {
        path: Mesh(p, faces, color, pose, opacity, flat=True, name=name),
        f"{path} edges": _lines(body, T, "target" if color == "target" else "neutral", ""),
    }


def _lines(body: Body, T: np.ndarray, color: Role, name: str) -> Segments:
    ends, pose = body.solid.lines, T
    if not _affine(T):
        ends, pose = transform(T, ends.reshape(-1, 3)).reshape(-1, 2, 3), None
    return Segments(ends, color, 2.0, pose, name=name)


def _ghost(i: int, ghost: Ghost, body: Body) -> dict[str, Primitive]:
    T = translation(ghost.apart) @ ghost.T
    p = transform(T, body.solid.p)
    p_label = p[np.argmax(p[:, 2])] + [0.0, 0.0, 0.08 + (0.0 if ghost.apart.any() else 0.1 * i)]
    ends = "ends the same" if ghost.same else f"farthest vertex {length(ghost.distance)} off"
    return {
        f"ghost {i}": _lines(body, T, ghost.color, ghost.name),
        f"ghost {i} name": Label(f"{ghost.name}: {ends}", p_label, ghost.color),
    }


def _arrow(p: np.ndarray, T: np.ndarray, color: Role, name: str) -> Segments:
    v = 0.5 * transform_directions(T, FRONT[None])[0]
    side = 0.08 * np.cross(v, [0.0, 0.0, 1.0] if abs(v[2]) < 0.4 else [1.0, 0.0, 0.0])
    tip = p + v
    return Segments(np.array([[p, tip], [tip, tip - 0.2 * v + side], [tip, tip - 0.2 * v - side]]), color, 3, name=name)


def _turning_axes(state: Built) -> dict[str, Primitive]:
    """Return the directions about which the three angles now turn the body; the one turned last is thick."""
    axes = euler_axes(state.angles, state.params.order)
    last = state.params.first == "rotate, then translate"  # the turns came first and were carried along since
    middle = state.T_world_body[:3, 3] if last else np.zeros(3)
    scene: dict[str, Primitive] = {}
    for k, (axis, letter) in enumerate(zip(axes, state.params.order, strict=True)):
        up = (1.6, 1.35, 1.1)[k] * (axis if axis[2] > -1e-9 else -axis)
        width = 6.0 if k == state.turns - 1 else 3.0
        role, name = AXIS_ROLES["xyz".index(letter.lower())], f"angle {k + 1} ({letter})"
        ends = np.array([[middle - 0.7 * up, middle + up]])
        scene[f"axis {k + 1}"] = Segments(ends, role, width, name=f"{name} turns about this line")
        scene[f"axis {k + 1} name"] = Label(name, middle + up, role)
    return scene


def _shows_lock(state: Built) -> bool:
    return state.params.compare == "other triples" or gimbal_margin(state.angles, state.params.order) < 0.1


@functools.cache
def _margins(order: EulerOrder) -> np.ndarray:
    """Return how far from gimbal lock each middle angle is; the other two do not matter."""
    return np.array([gimbal_margin(np.array([0.0, m, 0.0]), order) for m in np.radians(MIDDLE)])


def _gimbal_curve(state: Built) -> Curve:
    return Curve(
        MIDDLE,
        _margins(state.params.order),
        "0: the first and third axis are one",
        "Gimbal lock",
        "middle angle (deg)",
        "sine between axes",
        "highlight",
        marks=(state.params.angles[1],),
    )


def _steps(path: np.ndarray) -> np.ndarray:
    return np.stack([path[:-1], path[1:]], axis=1)


def _affine(T: np.ndarray) -> bool:
    return bool(np.array_equal(T[3], (0, 0, 0, 1)))
