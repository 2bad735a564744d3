"""A scene in which one thing stands out, because somebody reads of it."""

from dataclasses import replace
from typing import Any

from workbench.scene import Axes, Camera, Label, Mesh, Picture, Points, Primitive, Scene, Segments, in_space

FAINT = 0.3
"""How much is left of what is not meant."""


def lit(scene: Scene, path: str) -> Scene:
    """Return a scene in which what is at `path`, or under it, stands out; the scene itself where nothing is there."""
    meant = {one for one, thing in scene.items() if in_space(thing) and (one == path or one.startswith(f"{path}/"))}
    if not meant:
        return scene
    return {one: _stronger(thing) if one in meant else _fainter(thing) for one, thing in scene.items()}


def _stronger(thing: Primitive) -> Primitive:
    if isinstance(thing, Points):
        return replace(thing, radius=1.6 * thing.radius, opacity=1.0)
    if isinstance(thing, Segments):
        return replace(thing, width=2.0 * thing.width, opacity=1.0)
    if isinstance(thing, Mesh):
        return replace(thing, opacity=max(thing.opacity, 0.8))
    if isinstance(thing, Axes):
        return replace(thing, length=1.25 * thing.length, opacity=1.0)
    return replace(thing, opacity=1.0) if isinstance(thing, Camera) else thing


def _fainter(thing: Any) -> Primitive:
    """Return a thing that steps back; words and pictures stay: they say what is seen."""
    if isinstance(thing, Label | Picture) or not in_space(thing):
        return thing
    return replace(thing, opacity=FAINT * thing.opacity)
