"""What one step looks like, for any viewer: a mapping from path to frozen primitive.

In space: `Points`, `Segments`, `Mesh`, `Axes`, `Camera`, `Label`, `Picture`. Beside it: `Scalar` (one number per step),
`Curve` (y over x at this step), `Table`, `Picture` without a place in space, and `Caption`.

A path such as `"source/points"` names a thing for the length of a run: a sink makes its world equal to a scene by path.
A thing that moves keeps its arrays (the same objects) and changes `T_world_object`, so that sinks send a pose.
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, fields, replace
from typing import Any, Literal, TypeAlias

import numpy as np

Role: TypeAlias = Literal[
    "target", "source", "correspondence", "truth", "wrong", "highlight", "neutral", "other", "x", "y", "z"
]

PALETTE: Mapping[Role, tuple[int, int, int]] = {
    "target": (0, 114, 178),  # blue: target, reference
    "source": (230, 159, 0),  # orange: source, estimate
    "correspondence": (153, 153, 153),  # grey
    "truth": (0, 158, 115),  # green
    "wrong": (213, 94, 0),  # vermillion: wrong, outlier
    "highlight": (204, 121, 167),  # purple
    "neutral": (110, 118, 129),  # things without a part in the story
    "other": (86, 180, 233),  # sky blue: one more curve
    "x": (213, 94, 0),
    "y": (0, 158, 115),
    "z": (0, 114, 178),
}

UNKNOWN = (128, 128, 128)
"""The grey of what a Field does not know."""
_VIRIDIS = ("440154", "472d7b", "3b528b", "2c728e", "21918c", "28ae80", "5dc863", "addc30", "fde725")
_DIVERGING = ("0072b2", "6baed0", "f4f4f4", "eba273", "d55e00")


@dataclass(frozen=True, eq=False)
class Field:
    """A number per point, vertex or pixel, shown by a colour map that has a bar with its unit.

    Args:
        values: (n,) or (h, w). NaN means unknown and is drawn in grey.
        low: The lower end of the colour bar; values below are clipped.
        high: Its upper end.
        map: `viridis` for magnitudes; `diverging` for signed quantities, where low must be -high.
    """

    values: np.ndarray
    low: float
    high: float
    title: str
    unit: str = ""
    map: Literal["viridis", "diverging"] = "viridis"

    def __post_init__(self) -> None:
        _array("Field.values", self.values)
        _need(
            bool(np.isfinite([self.low, self.high]).all()) and self.low < self.high, "a Field needs low < high, finite"
        )
        if self.map == "diverging":
            _need(bool(np.isclose(self.low, -self.high)), "a diverging Field has zero in the middle: low = -high")

    def rgb(self) -> np.ndarray:
        """Return the colours, uint8, one more axis of length 3 than `values`."""
        known = np.isfinite(self.values)
        level = np.where(known, (self.values - self.low) / (self.high - self.low), 0.0)
        colors = color_map(self.map, level)
        colors[~known] = UNKNOWN
        return colors


@dataclass(frozen=True, eq=False)
class Classes:
    """A class per point: `ids` (n,) index into `roles`, each with its name in the legend."""

    ids: np.ndarray
    roles: tuple[Role, ...]
    names: tuple[str, ...]

    def __post_init__(self) -> None:
        _need(len(self.roles) == len(self.names) > 0, "Classes needs one name per role")
        _array("Classes.ids", self.ids)
        _need(self.ids.dtype.kind in "iub", "Classes.ids are whole numbers")
        _need(self.ids.size == 0 or int(self.ids.max()) < len(self.roles), "a class id is beyond the roles")

    def rgb(self) -> np.ndarray:
        """Return (n, 3) uint8 colours."""
        return np.array([PALETTE[role] for role in self.roles], np.uint8)[self.ids.astype(int)]


Color: TypeAlias = Role | Field | Classes | np.ndarray


@dataclass(frozen=True, eq=False)
class Points:
    """A cloud: `p` (n, 3) in the object's frame, each point drawn as a disc of `radius` metres.

    `color` is a role, a Field, Classes, or (n, 3) uint8 for measured colours.
    """

    p: np.ndarray
    color: Color = "neutral"
    radius: float = 0.01
    T_world_object: np.ndarray | None = None
    opacity: float = 1.0
    name: str = ""

    def __post_init__(self) -> None:
        _rows("Points.p", self.p, 3)
        _common(self, len(self.p))
        _need(self.radius > 0, "Points.radius is positive")


@dataclass(frozen=True, eq=False)
class Segments:
    """Line segments: `ends` (n, 2, 3); `width` in pixels. `color` as for Points, one per segment."""

    ends: np.ndarray
    color: Color = "correspondence"
    width: float = 1.5
    T_world_object: np.ndarray | None = None
    opacity: float = 1.0
    name: str = ""

    def __post_init__(self) -> None:
        _array("Segments.ends", self.ends)
        _need(
            self.ends.ndim == 3 and self.ends.shape[1:] == (2, 3), f"Segments.ends is (n, 2, 3), not {self.ends.shape}"
        )
        _finite("Segments.ends", self.ends)
        _common(self, len(self.ends))


@dataclass(frozen=True, eq=False)
class Mesh:
    """A triangle mesh: `p` (v, 3), `faces` (f, 3) indices; `color` as for Points, one per vertex."""

    p: np.ndarray
    faces: np.ndarray
    color: Color = "neutral"
    T_world_object: np.ndarray | None = None
    opacity: float = 1.0
    wireframe: bool = False
    flat: bool = False
    name: str = ""

    def __post_init__(self) -> None:
        _rows("Mesh.p", self.p, 3)
        _array("Mesh.faces", self.faces)
        _need(self.faces.ndim == 2 and self.faces.shape[1] == 3, f"Mesh.faces is (f, 3), not {self.faces.shape}")
        _need(self.faces.dtype.kind in "iu", "Mesh.faces are whole numbers")
        _need(len(self.faces) > 0 and len(self.p) > 0, "a Mesh has at least one face")
        _need(int(self.faces.min()) >= 0 and int(self.faces.max()) < len(self.p), "a face index is out of range")
        _common(self, len(self.p))


@dataclass(frozen=True, eq=False)
class Axes:
    """A coordinate frame: three arrows of `length` metres, x vermillion, y green, z blue."""

    T_world_object: np.ndarray | None = None
    length: float = 0.3
    opacity: float = 1.0
    name: str = ""

    def __post_init__(self) -> None:
        _common(self, None)
        _need(self.length > 0, "Axes.length is positive")


@dataclass(frozen=True, eq=False)
class Camera:
    """A pinhole camera: its frustum up to `depth` metres, with its image (h, w, 3) uint8 if any.

    `T_world_object` is T_world_camera, in the OpenCV frame (+Z forward, +Y down). `K` is in pixels.
    """

    K: np.ndarray
    width: int
    height: int
    T_world_object: np.ndarray | None = None
    depth: float = 0.5
    image: np.ndarray | None = None
    color: Role = "neutral"
    opacity: float = 1.0
    name: str = ""

    def __post_init__(self) -> None:
        _array("Camera.K", self.K)
        _need(
            self.K.shape == (3, 3) and self.K[0, 0] > 0 and self.K[1, 1] > 0,
            "Camera.K is (3, 3), focal lengths positive",
        )
        _need(self.width > 0 and self.height > 0 and self.depth > 0, "Camera sizes are positive")
        if self.image is not None:
            _image("Camera.image", self.image)
        _common(self, None)


@dataclass(frozen=True, eq=False)
class Label:
    """A word in space at `p` (3,)."""

    text: str
    p: np.ndarray
    color: Role = "neutral"
    T_world_object: np.ndarray | None = None
    opacity: float = 1.0

    def __post_init__(self) -> None:
        _text("Label.text", self.text)
        _array("Label.p", self.p)
        _need(self.p.shape == (3,), f"Label.p is (3,), not {self.p.shape}")
        _common(self, None)


@dataclass(frozen=True, eq=False)
class Picture:
    """An image: on a plane in space where `width` (metres) is given, else beside the scene.

    On a plane it is centred at the object's origin, columns along +x, rows along +y of the object's frame (an OpenCV image
    plane seen from behind the camera). `image` is (h, w) or (h, w, 3) uint8, or a Field of values (h, w).
    """

    image: np.ndarray | Field
    title: str = ""
    width: float | None = None
    T_world_object: np.ndarray | None = None
    opacity: float = 1.0

    def __post_init__(self) -> None:
        if isinstance(self.image, Field):
            _need(self.image.values.ndim == 2 and self.image.values.size > 0, "a Picture's Field holds (h, w) values")
        else:
            _image("Picture.image", self.image)
        _need(self.width is None or self.width > 0, "Picture.width is positive")
        _common(self, None)

    def rgb(self) -> np.ndarray:
        """Return (h, w, 3) uint8."""
        if isinstance(self.image, Field):
            return self.image.rgb()
        return self.image if self.image.ndim == 3 else np.repeat(self.image[:, :, None], 3, 2)

    def places(self, uv: np.ndarray) -> np.ndarray:
        """Return where pixels (..., 2), column first, lie in the world, (..., 3); for a picture that stands in space."""
        h, w = (self.image.values if isinstance(self.image, Field) else self.image).shape[:2]
        xy = (uv - np.array([w - 1, h - 1]) / 2) * (self.width or 1.0) / w
        T = np.eye(4) if self.T_world_object is None else self.T_world_object
        return xy @ T[:3, :2].T + T[:3, 3]


@dataclass(frozen=True, eq=False)
class Scalar:
    """One number of this step; a sink draws it as a curve over steps. NaN means: none at this step.

    Scalars with the same `chart` share one plot; `unit` is written at its axis. `log` asks for a logarithmic axis.
    """

    value: float
    name: str
    chart: str
    unit: str = ""
    color: Role = "source"
    log: bool = False

    def __post_init__(self) -> None:
        number = isinstance(self.value, (int, float, np.number)) and not isinstance(self.value, np.complexfloating)
        _need(number, f"Scalar.value is one real number, not {_what(self.value)}: float(...) makes one")
        _color(self.color)


@dataclass(frozen=True, eq=False)
class Curve:
    """y over x at this step: a cost curve, a histogram, a basin. Curves with the same `chart` share one plot.

    `marks` are x positions worth a vertical line (the chosen disparity, the current angle). NaN in y leaves a gap.
    """

    x: np.ndarray
    y: np.ndarray
    name: str
    chart: str
    x_label: str
    y_label: str = ""
    color: Role = "source"
    kind: Literal["line", "bars", "dots"] = "line"
    marks: tuple[float, ...] = ()

    def __post_init__(self) -> None:
        _array("Curve.x", self.x)
        _array("Curve.y", self.y)
        good = self.x.ndim == 1 and self.x.shape == self.y.shape and len(self.x) > 0
        _need(good, f"Curve.x and y are (n,), n > 0, as long as each other, not {self.x.shape} and {self.y.shape}")
        _color(self.color)
        _finite("Curve.x", self.x)


@dataclass(frozen=True, eq=False)
class Table:
    """A small table of text beside the scene: a matrix, measured invariants. Rows have the length of `header`."""

    title: str
    header: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]

    def __post_init__(self) -> None:
        _need(all(len(row) == len(self.header) for row in self.rows), "every Table row is as long as the header")
        for cell in (*self.header, *(cell for row in self.rows for cell in row)):
            _text(f"each cell of the Table {self.title!r}", cell)


@dataclass(frozen=True, eq=False)
class Caption:
    """What just happened and why, with the number that changed: one or two sentences of plain text."""

    text: str
    tone: Literal["info", "good", "wrong"] = "info"

    def __post_init__(self) -> None:
        _text("Caption.text", self.text)
        _need(bool(self.text.strip()), "a Caption says something")


Spatial: TypeAlias = Points | Segments | Mesh | Axes | Camera | Label | Picture
Primitive: TypeAlias = Spatial | Scalar | Curve | Table | Caption
Scene: TypeAlias = Mapping[str, Primitive]
PRIMITIVES: tuple[type, ...] = (Points, Segments, Mesh, Axes, Camera, Label, Picture, Scalar, Curve, Table, Caption)


def in_space(primitive: Primitive) -> bool:
    """Tell whether a primitive has a place in the 3D view."""
    if isinstance(primitive, Picture):
        return primitive.width is not None
    return isinstance(primitive, Points | Segments | Mesh | Axes | Camera | Label)


def caption_of(scene: Scene) -> Caption:
    """Return the caption of a scene; every scene has exactly one, at the path `caption`."""
    caption = scene.get("caption")
    if not isinstance(caption, Caption):
        raise ValueError("a scene needs a Caption at the path 'caption': say what happened in this step")
    return caption


def ghost(scene: Scene, beside: Scene, opacity: float = 0.25) -> dict[str, Primitive]:
    """Return what another scene has elsewhere, faded, under `ghost/`, to stand behind the scene `beside`.

    What is at the same place in both is left out: a ghost over it would only pale it. A ghost hides nothing: points and
    lines, which are drawn opaque, are finer than those they stand behind, a camera is its frustum alone, and a picture
    that differs from one at its place in space is left out. A picture beside the scene stands there as pinned.
    """
    return {
        f"ghost/{path}": _faint(primitive, opacity)
        for path, primitive in scene.items()
        if isinstance(primitive, Points | Segments | Mesh | Axes | Camera | Picture)
        and not _same_place(primitive, beside.get(path))
    }


def _faint(primitive: Spatial, opacity: float) -> Spatial:
    if isinstance(primitive, Picture) and not in_space(primitive):
        return replace(primitive, title=f"{primitive.title}, pinned" if primitive.title else "pinned")
    faint = replace(primitive, opacity=primitive.opacity * opacity)
    if isinstance(faint, Points):
        return replace(faint, radius=0.4 * faint.radius)
    if isinstance(faint, Segments):
        return replace(faint, width=0.6 * faint.width)
    return replace(faint, image=None) if isinstance(faint, Camera) else faint


def _same_place(a: Primitive, b: Primitive | None) -> bool:
    """Tell whether b is where a is and like it, up to round-off and how it is coloured and named."""
    looks = {"color", "opacity", "name", "title"}
    if isinstance(a, Camera) or (isinstance(a, Picture) and in_space(a)):
        looks.add("image")
    return type(a) is type(b) and all(
        _near(getattr(a, field.name), getattr(b, field.name)) for field in fields(a) if field.name not in looks
    )


def _near(a: Any, b: Any) -> bool:
    if isinstance(a, np.ndarray) and isinstance(b, np.ndarray) and a.dtype.kind == b.dtype.kind == "f":
        return a is b or (a.shape == b.shape and np.allclose(a, b, rtol=1e-9, atol=1e-9, equal_nan=True))
    return same(a, b)


def same(a: object, b: object) -> bool:
    """Tell whether two values of a scene look the same; arrays are compared by identity first, then by content."""
    if a is b:
        return True
    if type(a) is not type(b):
        return False
    if isinstance(a, np.ndarray) and isinstance(b, np.ndarray):
        return a.dtype == b.dtype and a.shape == b.shape and np.array_equal(a, b, equal_nan=a.dtype.kind == "f")
    if isinstance(a, (*PRIMITIVES, Field, Classes)):
        return all(same(getattr(a, f.name), getattr(b, f.name)) for f in fields(a))  # type: ignore[arg-type]
    if isinstance(a, Mapping) and isinstance(b, Mapping):
        return a.keys() == b.keys() and all(same(a[key], b[key]) for key in a)
    if isinstance(a, float) and isinstance(b, float):
        return a == b or (np.isnan(a) and np.isnan(b))
    return a == b


def arrays(value: Any) -> Iterator[np.ndarray]:
    """Walk through all arrays that a scene, primitive or state holds."""
    if isinstance(value, np.ndarray):
        yield value
    elif isinstance(value, Mapping):
        for item in value.values():
            yield from arrays(item)
    elif isinstance(value, (tuple, list)):
        for item in value:
            yield from arrays(item)
    elif hasattr(value, "__dataclass_fields__") and not isinstance(value, type):
        for item in fields(value):
            yield from arrays(getattr(value, item.name))


def color_map(name: Literal["viridis", "diverging"], level: np.ndarray) -> np.ndarray:
    """Return uint8 colours (..., 3) for levels from 0 to 1, clipped.

    Reference: viridis after van der Walt and Smith (2015), at nine stops; the diverging map joins the palette's blue and
    vermillion through near-white.
    """
    stops = np.array(
        [[int(code[i : i + 2], 16) for i in (0, 2, 4)] for code in (_VIRIDIS if name == "viridis" else _DIVERGING)]
    )
    at = np.clip(level, 0.0, 1.0) * (len(stops) - 1)
    return np.stack([np.interp(at, np.arange(len(stops)), stops[:, i]) for i in range(3)], -1).round().astype(np.uint8)


def color_rows(color: Color, n: int) -> np.ndarray:
    """Return (n, 3) uint8 colours of n items."""
    if isinstance(color, str):
        return np.broadcast_to(np.array(PALETTE[color], np.uint8), (n, 3))
    return color if isinstance(color, np.ndarray) else color.rgb()


def is_rigid(T: np.ndarray) -> bool:
    """Tell whether a 4x4 is a rotation and a translation, so that a viewer can take it as a pose."""
    rows, last = T[:3, :3].tolist(), T[3].tolist()
    if last != [0.0, 0.0, 0.0, 1.0]:
        return False
    (a, b, c), (d, e, f), (g, h, i) = rows  # in plain numbers: numpy takes 70 times as long for so few
    lengths = a * a + b * b + c * c, d * d + e * e + f * f, g * g + h * h + i * i
    products = a * d + b * e + c * f, a * g + b * h + c * i, d * g + e * h + f * i
    orthonormal = all(abs(one - 1.0) <= 1e-5 for one in lengths) and all(abs(one) <= 1e-6 for one in products)
    return orthonormal and a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g) > 0


def _need(holds: bool, message: str) -> None:
    if not holds:
        raise ValueError(message)


def _what(value: object) -> str:
    return f"{value!r:.40}" if isinstance(value, str) else f"of type {type(value).__name__}"


def _array(name: str, value: object) -> None:
    _need(isinstance(value, np.ndarray), f"{name} is an array, not {_what(value)}: np.asarray(...) makes one")


def _text(name: str, value: object) -> None:
    _need(isinstance(value, str), f'{name} is a text, not {_what(value)}: f"{{...:.3f}}" makes one')


def _color(role: object) -> None:
    _need(role in PALETTE, f"unknown colour role {role!r}: one of {', '.join(PALETTE)}")


def _finite(name: str, values: np.ndarray) -> None:
    _need(bool(np.isfinite(values).all()), f"{name} holds NaN or infinity: leave such rows out before drawing")


def _rows(name: str, rows: np.ndarray, columns: int) -> None:
    _array(name, rows)
    _need(rows.ndim == 2 and rows.shape[1] == columns, f"{name} is (n, {columns}), not {rows.shape}")
    _finite(name, rows)


def _image(name: str, image: np.ndarray) -> None:
    _array(name, image)
    good = image.dtype == np.uint8 and (image.ndim == 2 or (image.ndim == 3 and image.shape[2] == 3)) and image.size > 0
    _need(good, f"{name} is (h, w) or (h, w, 3) uint8, not {image.dtype} {image.shape}")


def _common(primitive: Any, n: int | None) -> None:
    T = primitive.T_world_object
    if T is not None:
        _array("T_world_object", T)
        _need(T.shape == (4, 4), f"T_world_object is (4, 4), not {T.shape}")
        _finite("T_world_object", T)
    _need(0.0 <= primitive.opacity <= 1.0, "opacity is between 0 and 1")
    color = getattr(primitive, "color", "neutral")
    if isinstance(color, str):
        _color(color)
    elif isinstance(color, np.ndarray):
        _need(
            color.dtype == np.uint8 and color.shape == (n, 3),
            f"colours are ({n}, 3) uint8, not {color.dtype} {color.shape}",
        )
    elif isinstance(color, Field):
        _need(color.values.shape == (n,), f"the Field holds {color.values.shape} values for {n} items")
    elif isinstance(color, Classes):
        _need(color.ids.shape == (n,), f"Classes holds {color.ids.shape} ids for {n} items")
    else:
        _need(False, f"a colour is a role, a Field, Classes or an array ({n}, 3) uint8, not {_what(color)}")
