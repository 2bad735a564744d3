"""What a step looks like as one value: compared with another, walked through, and as the ghost of
another.
"""

from collections.abc import Iterator, Mapping
from dataclasses import fields, replace
from typing import Any, TypeAlias

import numpy as np

from workbench.scene.colors import Classes, Field
from workbench.scene.side_panels import Caption, Curve, Scalar, Table
from workbench.scene.spatial import Axes, Camera, Label, Mesh, Picture, Points, Segments, Spatial

Primitive: TypeAlias = Spatial | Scalar | Curve | Table | Caption
Scene: TypeAlias = Mapping[str, Primitive]
PRIMITIVES: tuple[type, ...] = (
    Points,
    Segments,
    Mesh,
    Axes,
    Camera,
    Label,
    Picture,
    Scalar,
    Curve,
    Table,
    Caption,
)
HOLD_NOTHING = frozenset((str, float, int, bool, type(None)))
PALE = 0.25
"""How opaque a ghost is beside what it is of."""


def in_space(primitive: Primitive) -> bool:
    """Tell whether a primitive has a place in the 3D view."""
    if isinstance(primitive, Picture):
        return primitive.width is not None
    return isinstance(primitive, Points | Segments | Mesh | Axes | Camera | Label)


def caption_of(scene: Scene) -> Caption:
    """Return the caption of a scene; every scene has exactly one, at the path `caption`."""
    caption = scene.get("caption")
    if not isinstance(caption, Caption):
        raise ValueError(
            "a scene needs a Caption at the path 'caption': say what happened in this step"
        )
    return caption


def ghost(scene: Scene, beside: Scene) -> dict[str, Primitive]:
    """Return what another scene has elsewhere, faded, under `ghost/`, to stand behind the scene
    `beside`.

    What is at the same place in both is left out: a ghost over it would only pale it. A ghost hides
    nothing: points and lines, which are drawn opaque, are finer than those they stand behind, a
    camera is its frustum alone, and a picture that differs from one at its place in space is left
    out. A picture beside the scene stands there as pinned.
    """
    return {
        f"ghost/{path}": _faint(primitive)
        for path, primitive in scene.items()
        if isinstance(primitive, Points | Segments | Mesh | Axes | Camera | Picture)
        and not _same_place(primitive, beside.get(path))
    }


def _faint(primitive: Spatial) -> Spatial:
    if isinstance(primitive, Picture) and not in_space(primitive):
        return replace(
            primitive, title=f"{primitive.title}, pinned" if primitive.title else "pinned"
        )
    faint = replace(primitive, opacity=PALE * primitive.opacity)
    if isinstance(faint, Points):
        return replace(faint, radius=0.4 * faint.radius)
    if isinstance(faint, Segments):
        return replace(faint, width=0.6 * faint.width)
    return replace(faint, image=None) if isinstance(faint, Camera) else faint


def _same_place(a: Primitive, b: Primitive | None) -> bool:
    """Tell whether b is where a is and like it, up to round-off and how it is coloured and
    named.
    """
    looks = {"color", "opacity", "name", "title"}
    if isinstance(a, Camera) or (isinstance(a, Picture) and in_space(a)):
        looks.add("image")
    return type(a) is type(b) and all(
        _near(getattr(a, field.name), getattr(b, field.name))
        for field in fields(a)
        if field.name not in looks
    )


def _near(a: Any, b: Any) -> bool:
    if (
        isinstance(a, np.ndarray)
        and isinstance(b, np.ndarray)
        and a.dtype.kind == b.dtype.kind == "f"
    ):
        return a is b or (
            a.shape == b.shape and np.allclose(a, b, rtol=1e-9, atol=1e-9, equal_nan=True)
        )
    return same(a, b)


def same(a: object, b: object) -> bool:
    """Tell whether two values of a scene look the same; arrays are compared by identity first, then
    by content.
    """
    if a is b:
        return True
    if type(a) is not type(b):
        return False
    if isinstance(a, np.ndarray) and isinstance(b, np.ndarray):
        return (
            a.dtype == b.dtype
            and a.shape == b.shape
            and np.array_equal(a, b, equal_nan=a.dtype.kind == "f")
        )
    if isinstance(a, (*PRIMITIVES, Field, Classes)):
        return all(same(getattr(a, f.name), getattr(b, f.name)) for f in fields(a))  # type: ignore[arg-type]
    if isinstance(a, Mapping) and isinstance(b, Mapping):
        return a.keys() == b.keys() and all(same(a[key], b[key]) for key in a)
    if isinstance(a, float) and isinstance(b, float):
        return a == b or (np.isnan(a) and np.isnan(b))
    return a == b


def same_but_for_pose(a: Primitive, b: Primitive | None) -> bool:
    """Tell whether two things in space look the same, wherever they are."""
    return (
        in_space(a)
        and type(a) is type(b)
        and all(
            same(getattr(a, f.name), getattr(b, f.name))
            for f in fields(a)
            if f.name != "T_world_object"
        )
    )


def arrays(value: Any) -> Iterator[np.ndarray]:
    """Walk through all arrays that a scene, primitive or state holds; what it holds twice is walked
    through once.
    """
    waiting = [value]
    seen = {}
    while waiting:
        value = waiting.pop()
        if isinstance(value, np.ndarray):
            yield value
        elif type(value) not in HOLD_NOTHING and id(value) not in seen:
            seen[id(value)] = value  # kept, so that nothing else gets its id
            if isinstance(value, (tuple, list)):
                waiting.extend(value)
            elif hasattr(type(value), "__dataclass_fields__"):
                waiting.extend([getattr(value, field.name) for field in fields(value)])
            elif isinstance(value, Mapping):
                waiting.extend(value.values())
