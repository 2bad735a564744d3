"""What every run of a lesson promises of its picture: what it draws lies where its camera looks."""

from collections.abc import Iterator

import numpy as np

from workbench.authoring.promises import Found, Subject, promise
from workbench.lesson import View
from workbench.scene import Axes, Camera, Label, Mesh, Picture, Points, Primitive, Scene, Segments

ASPECT = 4 / 3
"""Width over height of the frame that is asked for, about that of the stage on a desktop."""
LEAST_SEEN = 0.25
"""Of the named things of a step, this share has a place in the frame: a close-up leaves others out,
some lie at infinity.
"""


@promise
def the_picture_lies_in_its_frame(subject: Subject) -> Found:
    """At every step of every preset, enough of the things with a name have a place in the frame of
    its camera.
    """
    runs = {"the default run": subject.lesson.params()}
    runs |= {f"preset {preset.name!r}": preset.params for preset in subject.lesson.presets}
    for name, params in runs.items():
        view = subject.lesson.view_of(params)
        for k, step in enumerate(subject.whole(params, name).known()):
            places = dict(_named_places(step.scene))
            lost = [path for path, p in places.items() if not in_frame(view, p).any()]
            out = (
                f"{subject.who}, {name}, step {k}: out of its frame are {', '.join(lost)}; give it"
                " a view of its own"
            )
            yield out if len(lost) > (1 - LEAST_SEEN) * len(places) else None


def in_frame(view: View, p_world: np.ndarray) -> np.ndarray:
    """Return which points (n, 3) a view has in its frame, before the eye, (n,) bool."""
    eye = view.seen_from()
    ahead = np.array(view.target) - eye
    ahead /= np.linalg.norm(ahead)
    right = np.cross(ahead, view.up)
    right /= np.linalg.norm(right)
    p_eye = (p_world - eye) @ np.stack([right, np.cross(right, ahead), ahead], axis=1)
    half_height = np.tan(np.radians(view.fov_degrees) / 2) * p_eye[:, 2]
    inside = (np.abs(p_eye[:, 0]) <= ASPECT * half_height) & (np.abs(p_eye[:, 1]) <= half_height)
    return inside & (p_eye[:, 2] > 0)


def _named_places(scene: Scene) -> Iterator[tuple[str, np.ndarray]]:
    """Yield the path of each named thing in space and its finite points in the world, (n, 3), one
    or more.
    """
    for path, primitive in scene.items():
        p = _own_points(primitive)
        if p is None:
            continue
        T = getattr(primitive, "T_world_object", None)
        p = p if T is None else p @ T[:3, :3].T + T[:3, 3]
        p = p[np.isfinite(p).all(axis=1)]
        if len(p):
            yield path, p


def _own_points(primitive: Primitive) -> np.ndarray | None:
    """Return the points of a thing with a name, (n, 3), in its own frame; None of what has no name
    or no place.
    """
    if isinstance(primitive, Label):
        return primitive.p[None]
    if isinstance(primitive, Picture) and primitive.width is not None:
        return np.zeros((1, 3))
    if isinstance(primitive, (Points, Mesh)) and primitive.name:
        return primitive.p
    if isinstance(primitive, Segments) and primitive.name:
        return primitive.ends.reshape(-1, 3)
    if isinstance(primitive, (Axes, Camera)) and primitive.name:
        return np.zeros((1, 3))
    return None
