"""How a body is drawn, and what the stage `factors` looks like."""

import numpy as np

from lessons.transforms.captions import caption_of, times
from lessons.transforms.factors import Built, Ghost
from lessons.transforms.inputs import FRONT, Body, Input
from workbench.data.framing import ground_grid
from workbench.geometry.meshes.invariants import Change
from workbench.geometry.motions.affine import is_affine, kind_of, transform, transform_directions
from workbench.geometry.polylines import segments
from workbench.lesson import Look
from workbench.numerals import angle, fixed, length, percent
from workbench.scene import (
    Axes,
    Chart,
    Label,
    Mesh,
    Primitive,
    Role,
    Scene,
    Segments,
    Table,
    arrows,
)

DET = Chart("det T")
MOVED = Chart("Distance", unit="m")
GROUND = Segments(ground_grid(0.5, 0.0, 2.5), "neutral", 1, opacity=0.2, name="grid 0.5 m")


def shown(
    path: str,
    body: Body,
    T: np.ndarray,
    *,
    color: Role = "source",
    opacity: float = 0.85,
    name: str = "",
) -> dict[str, Primitive]:
    """Return the body as a surface with its edges; the faces of a mirrored one go round the other
    way.
    """
    p = body.solid.p
    faces = body.solid.faces
    pose = T
    if not is_affine(T):
        p = transform(T, p)
        pose = None
    elif np.linalg.det(T[:3, :3]) < 0:
        faces = faces[:, ::-1]
    edges = "neutral" if color == "source" else color
    return {
        path: Mesh(p, faces, color, pose, opacity, flat=True, name=name),
        f"{path} edges": lines(body, T, color=edges),
    }


def lines(body: Body, T: np.ndarray, *, color: Role, width: float = 2.0) -> Segments:
    """Return the edges of the body alone."""
    ends = body.solid.lines
    pose = T
    if not is_affine(T):
        ends = transform(T, ends.reshape(-1, 3)).reshape(-1, 2, 3)
        pose = None
    return Segments(ends, color, width, pose)


def above(word: str, body: Body, T: np.ndarray, *, color: Role) -> Label:
    """Return a word over the highest vertex of the body."""
    p = transform(T, body.solid.p)
    return Label(word, p[np.argmax(p[:, 2])] + [0.0, 0.0, 0.08], color)


def draw(look: Look[Input, Body, Built]) -> Scene:
    """Return the picture of one step of the stage `factors`."""
    body = look.subject
    state = look.now
    point = look.subject.followed(look.params.point)
    T = state.T
    identity = np.eye(4)
    det = float(np.linalg.det(T[:3, :3])) if is_affine(T) else np.nan
    moved = float(np.linalg.norm(state.trail[-1] - state.trail[0]))
    scene: dict[str, Primitive] = {
        "ground": GROUND,
        **shown("start", body, identity, color="target", opacity=0.15),
        **shown("body", body, T),
        "world": Axes(None, 0.4, name="world axes"),
        "start name": above("start", body, identity, color="target"),
        "vertex": Label(f"vertex {point}", state.trail[-1], "highlight"),
        "volume": DET.scalar(det, "det T"),
        "moved": MOVED.scalar(moved, f"vertex {point} from its start"),
        "matrix": Table.of_matrix(
            "T, all factors so far", ("x axis", "y axis", "z axis", "origin"), T
        ),
        "measured": _invariants(state),
        "one point": _one_point(body.solid.p[point], state, point),
        "caption": caption_of(look),
    }
    if len(state.trail) > 1:
        name = f"vertex {point}, factor by factor"
        scene["trail"] = Segments(segments(state.trail), "highlight", 2.5, name=name)
    if is_affine(T):
        scene["front"] = front(body, T)
    if look.params.compare == "direction with w = 1":
        p_door = transform(T, body.p_door[None])
        tip = p_door + 0.5 * transform(T, FRONT[None])
        scene["wrong front"] = arrows(p_door, tip, "wrong", head=0.1, width=3, name="with w = 1")
    if state.ghost is not None:
        scene |= _ghost(state.ghost, body)
    if np.isfinite(state.left):
        scene["left"] = MOVED.scalar(state.left, "left after taking it back", "truth")
    if state.factor.kind not in ("start", "undo"):
        scene["frame"] = Axes(state.T_world_body, 0.35, name="body axes")
    return scene


def front(body: Body, T: np.ndarray, *, size: float = 0.5, width: float = 3.0) -> Segments:
    """Return the arrow to the front, a direction, so many times as long as it is."""
    p_door = transform(T, body.p_door[None])
    tip = p_door + size * transform_directions(T, FRONT[None])
    name = "front: a direction, w = 0"
    return arrows(p_door, tip, "highlight", head=0.12, width=width, name=name)


def _ghost(ghost: Ghost, body: Body) -> dict[str, Primitive]:
    p = transform(ghost.T, body.solid.p)
    ends = f"farthest vertex {length(ghost.distance)} off"
    if ghost.same:
        ends = "ends the same"
    p_label = p[np.argmax(p[:, 2])] + [0.0, 0.0, 0.08]
    return {
        "ghost": lines(body, ghost.T, color=ghost.color),
        "ghost name": Label(f"{ghost.name}: {ends}", p_label, ghost.color),
    }


def _amount(change: Change) -> str:
    """Say in a few words what became of a measure."""
    if change.kept:
        return "kept"
    if change.name == "orientation":
        return "flipped"
    if change.unit == "rad":
        return f"by up to {angle(np.degrees(change.amount))}"
    if np.isnan(change.factor):
        return f"by up to {percent(change.amount)}"
    return times(change.factor)


def _invariants(state: Built) -> Table:
    """Show which measures of the body survived, this factor and all of them."""
    kinds = ("kind of map", kind_of(state.factor.matrix).value, kind_of(state.T).value)
    rows = [
        (change.name, _amount(change), _amount(every))
        for change, every in zip(state.by_factor, state.by_all, strict=True)
    ]
    return Table("What survives", ("measured", "this factor", "all so far"), (kinds, *rows))


def _one_point(p: np.ndarray, state: Built, point: int) -> Table:
    """Show the followed vertex (w = 1) and the direction to the front (w = 0) before and after the
    map.
    """
    place = np.append(p, 1.0)
    direction = np.append(FRONT, 0.0)
    columns = (place, state.T @ place, direction, state.T @ direction)
    rows = tuple(
        (name, *(fixed(column[i], 2) for column in columns)) for i, name in enumerate("xyzw")
    )
    header = ("", f"vertex {point}", "T · vertex", "front", "T · front")
    return Table("A point and a direction", header, rows)
