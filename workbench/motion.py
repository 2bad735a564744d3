"""What moves from one step to the next, on its way: rigid poses between those of two scenes."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from scipy.spatial.transform import Rotation, Slerp

from workbench.scene import Scene, Segments, Spatial, is_rigid, same, same_but_for_pose

SECONDS = 0.25
FRAMES = 10
"""Pictures of a move, the last of which is the step itself."""

Move = tuple[Spatial, np.ndarray, np.ndarray]


@dataclass(frozen=True)
class Way:
    """What is seen between two steps: some things on their way, the others where they were.

    Lines that the later step changes are away meanwhile.

    Attributes:
        scene: What is seen, at the first picture.
        poses: By path, what moves: its pose at each picture, (pictures, 4, 4).
    """

    scene: Scene
    poses: dict[str, np.ndarray]


def eased(pictures: int = FRAMES) -> list[float]:
    """Return how much of the way is behind at each picture before the step itself: it starts and ends gently."""
    return [share * share * (3.0 - 2.0 * share) for share in (k / pictures for k in range(1, pictures))]


def way(before: Scene, after: Scene, shares: Sequence[float]) -> Way | None:
    """Return what is seen on the way between two scenes; None where nothing only moves.

    It turns evenly, its middle on a straight line.

    Args:
        before: The scene that is left.
        after: The scene that is gone to.
        shares: How much of the way is behind at each picture, 0 to 1.
    """
    moving = moves(before, after)
    if not moving:
        return None
    left = {
        path
        for path, thing in before.items()
        if isinstance(thing, Segments) and path not in moving and not same(thing, after.get(path))
    }
    poses = {path: _poses(*move, np.asarray(shares)) for path, move in moving.items()}
    scene = {
        path: replace(moving[path][0], T_world_object=poses[path][0]) if path in moving else thing
        for path, thing in before.items()
        if path not in left
    }
    return Way(scene, poses)


def moves(before: Scene, after: Scene) -> dict[str, Move]:
    """Return what only has another rigid pose in `after`: by path, the thing and its poses before and after, (4, 4)."""
    found: dict[str, Move] = {}
    for path, thing in before.items():
        other = after.get(path)
        if same_but_for_pose(thing, other):
            T_before, T_after = _pose(thing), _pose(other)
            if is_rigid(T_before) and is_rigid(T_after) and not np.allclose(T_before, T_after, atol=1e-9):
                found[path] = (thing, T_before, T_after)  # type: ignore[assignment]
    return found


def _poses(thing: Spatial, T_before: np.ndarray, T_after: np.ndarray, shares: np.ndarray) -> np.ndarray:
    turns = Rotation.from_matrix(np.stack([T_before[:3, :3], T_after[:3, :3]]))
    middle = _middle(thing)
    T = np.tile(np.eye(4), (len(shares), 1, 1))
    T[:, :3, :3] = Slerp([0.0, 1.0], turns)(shares).as_matrix()
    start, end = (T_[:3, :3] @ middle + T_[:3, 3] for T_ in (T_before, T_after))
    T[:, :3, 3] = start + shares[:, None] * (end - start) - T[:, :3, :3] @ middle
    return T


def _middle(thing: Any) -> np.ndarray:
    """Return the mean of a thing's points, in its own frame."""
    for name in ("p", "ends"):
        points = getattr(thing, name, None)
        if points is not None and len(points):
            return np.asarray(points, float).reshape(-1, 3).mean(0)
    return np.zeros(3)


def _pose(thing: Any) -> np.ndarray:
    return np.eye(4) if thing.T_world_object is None else thing.T_world_object
