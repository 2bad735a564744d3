"""What moves from one step to the next, on its way: rigid poses between those of two scenes."""

from dataclasses import fields, replace
from typing import Any

import numpy as np
from scipy.spatial.transform import Rotation, Slerp

from workbench.scene import Primitive, Scene, Segments, Spatial, in_space, is_rigid, same

SECONDS = 0.25
FRAMES = 10
"""Pictures of a move, the last of which is the step itself."""

Move = tuple[Spatial, np.ndarray, np.ndarray]


def moves(before: Scene, after: Scene) -> dict[str, Move]:
    """Return what only has another rigid pose in `after`: by path, the thing and its poses before and after, (4, 4)."""
    found: dict[str, Move] = {}
    for path, thing in before.items():
        other = after.get(path)
        if _only_moved(thing, other):
            T_before, T_after = _pose(thing), _pose(other)
            if is_rigid(T_before) and is_rigid(T_after) and not np.allclose(T_before, T_after, atol=1e-9):
                found[path] = (thing, T_before, T_after)  # type: ignore[assignment]
    return found


def between(before: Scene, after: Scene, moving: dict[str, Move], share: float) -> Scene:
    """Return what is seen of `before` when what moves is at `share` of its way, 0 to 1.

    It turns evenly, its middle on a straight line. Lines that the step changes are away meanwhile.
    """
    left = {
        path
        for path, thing in before.items()
        if isinstance(thing, Segments) and path not in moving and not same(thing, after.get(path))
    }
    on_the_way = {path: _at(*move, share) for path, move in moving.items()}
    return {path: on_the_way.get(path, thing) for path, thing in before.items() if path not in left}


def _at(thing: Spatial, T_before: np.ndarray, T_after: np.ndarray, share: float) -> Spatial:
    turns = Rotation.from_matrix(np.stack([T_before[:3, :3], T_after[:3, :3]]))
    middle = _middle(thing)
    T = np.eye(4)
    T[:3, :3] = Slerp([0.0, 1.0], turns)(share).as_matrix()
    start, end = (T_[:3, :3] @ middle + T_[:3, 3] for T_ in (T_before, T_after))
    T[:3, 3] = (1.0 - share) * start + share * end - T[:3, :3] @ middle
    return replace(thing, T_world_object=T)


def _middle(thing: Any) -> np.ndarray:
    """Return the mean of a thing's points, in its own frame."""
    for name in ("p", "ends"):
        points = getattr(thing, name, None)
        if points is not None and len(points):
            return np.asarray(points, float).reshape(-1, 3).mean(0)
    return np.zeros(3)


def _only_moved(thing: Primitive, other: Primitive | None) -> bool:
    return (
        in_space(thing)
        and type(thing) is type(other)
        and all(
            same(getattr(thing, f.name), getattr(other, f.name)) for f in fields(thing) if f.name != "T_world_object"
        )
    )


def _pose(thing: Any) -> np.ndarray:
    return np.eye(4) if thing.T_world_object is None else thing.T_world_object
