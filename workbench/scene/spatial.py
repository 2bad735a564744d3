"""What has a place in space."""

from dataclasses import dataclass
from typing import Any, TypeAlias

import numpy as np

from workbench.scene.checks import (
    check_array,
    check_finite,
    check_image,
    check_rows,
    check_text,
    need,
    what,
)
from workbench.scene.colors import Classes, Color, Field, Role, check_role


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
        check_rows("Points.p", self.p, 3)
        _check_common(self, len(self.p))
        need(self.radius > 0, "Points.radius is positive")


@dataclass(frozen=True, eq=False)
class Segments:
    """Line segments: `ends` (n, 2, 3); `width` in pixels. `color` as for Points, one per
    segment.
    """

    ends: np.ndarray
    color: Color = "correspondence"
    width: float = 1.5
    T_world_object: np.ndarray | None = None
    opacity: float = 1.0
    name: str = ""

    def __post_init__(self) -> None:
        check_array("Segments.ends", self.ends)
        need(
            self.ends.ndim == 3 and self.ends.shape[1:] == (2, 3),
            f"Segments.ends is (n, 2, 3), not {self.ends.shape}",
        )
        check_finite("Segments.ends", self.ends)
        _check_common(self, len(self.ends))


@dataclass(frozen=True, eq=False)
class Mesh:
    """A triangle mesh: `p` (v, 3), `faces` (f, 3) indices; `color` as for Points, one per
    vertex.
    """

    p: np.ndarray
    faces: np.ndarray
    color: Color = "neutral"
    T_world_object: np.ndarray | None = None
    opacity: float = 1.0
    wireframe: bool = False
    flat: bool = False
    name: str = ""

    def __post_init__(self) -> None:
        check_rows("Mesh.p", self.p, 3)
        check_array("Mesh.faces", self.faces)
        need(
            self.faces.ndim == 2 and self.faces.shape[1] == 3,
            f"Mesh.faces is (f, 3), not {self.faces.shape}",
        )
        need(self.faces.dtype.kind in "iu", "Mesh.faces are whole numbers")
        need(len(self.faces) > 0 and len(self.p) > 0, "a Mesh has at least one face")
        need(
            int(self.faces.min()) >= 0 and int(self.faces.max()) < len(self.p),
            "a face index is out of range",
        )
        _check_common(self, len(self.p))


@dataclass(frozen=True, eq=False)
class Axes:
    """A coordinate frame: three arrows of `length` metres, x vermillion, y green, z blue."""

    T_world_object: np.ndarray | None = None
    length: float = 0.3
    opacity: float = 1.0
    name: str = ""

    def __post_init__(self) -> None:
        _check_common(self, None)
        need(self.length > 0, "Axes.length is positive")


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
        check_array("Camera.K", self.K)
        need(
            self.K.shape == (3, 3) and self.K[0, 0] > 0 and self.K[1, 1] > 0,
            "Camera.K is (3, 3), focal lengths positive",
        )
        need(self.width > 0 and self.height > 0 and self.depth > 0, "Camera sizes are positive")
        if self.image is not None:
            check_image("Camera.image", self.image)
        _check_common(self, None)


@dataclass(frozen=True, eq=False)
class Label:
    """A word in space at `p` (3,): above it, and moved where words would cover each other.

    One that `stays`, such as a number in its cell, is centred at `p`; others go out of its way.
    """

    text: str
    p: np.ndarray
    color: Role = "neutral"
    T_world_object: np.ndarray | None = None
    opacity: float = 1.0
    stays: bool = False

    def __post_init__(self) -> None:
        check_text("Label.text", self.text)
        check_array("Label.p", self.p)
        need(self.p.shape == (3,), f"Label.p is (3,), not {self.p.shape}")
        _check_common(self, None)


@dataclass(frozen=True, eq=False)
class Picture:
    """An image: on a plane in space where `width` (metres) is given, else beside the scene.

    On a plane it is centred at the object's origin, columns along +x, rows along +y of the object's
    frame (an OpenCV image plane seen from behind the camera). `image` is (h, w) or (h, w, 3) uint8,
    or a Field of values (h, w).
    """

    image: np.ndarray | Field
    title: str = ""
    width: float | None = None
    T_world_object: np.ndarray | None = None
    opacity: float = 1.0

    def __post_init__(self) -> None:
        if isinstance(self.image, Field):
            need(
                self.image.values.ndim == 2 and self.image.values.size > 0,
                "a Picture's Field holds (h, w) values",
            )
        else:
            check_image("Picture.image", self.image)
        need(self.width is None or self.width > 0, "Picture.width is positive")
        _check_common(self, None)

    def rgb(self) -> np.ndarray:
        """Return (h, w, 3) uint8."""
        if isinstance(self.image, Field):
            return self.image.rgb()
        return self.image if self.image.ndim == 3 else np.repeat(self.image[:, :, None], 3, 2)

    @property
    def size(self) -> tuple[int, int]:
        """Width and height, pixels."""
        h, w = (self.image.values if isinstance(self.image, Field) else self.image).shape[:2]
        return w, h

    def places(self, uv: np.ndarray, nearer: float = 0.0) -> np.ndarray:
        """Return where pixels (..., 2), column first, lie in the world, (..., 3); for a picture
        that stands in space.

        `nearer` is how far in front of the picture, metres: what is drawn on it is not to be hidden
        by it.
        """
        w, h = self.size
        xy = (uv - np.array([w - 1, h - 1]) / 2) * (self.width or 1.0) / w
        T = np.eye(4) if self.T_world_object is None else self.T_world_object
        p = xy @ T[:3, :2].T + T[:3, 3]
        return p - nearer * T[:3, 2] if nearer else p

    def box(self, low: np.ndarray, high: np.ndarray, nearer: float = 0.0) -> np.ndarray:
        """Return the outline (4, 2, 3) of the pixels between two corners, in the world, as `places`
        does.
        """
        (u0, v0), (u1, v1) = low, high
        corners = self.places(np.array([[u0, v0], [u1, v0], [u1, v1], [u0, v1]]), nearer)
        return np.stack([corners, np.roll(corners, -1, axis=0)], axis=1)

    def border(self, nearer: float = 0.0) -> np.ndarray:
        """Return the outline (4, 2, 3) of all pixels, in the world."""
        return self.box(np.array([-0.5, -0.5]), np.array(self.size) - 0.5, nearer)


Spatial: TypeAlias = Points | Segments | Mesh | Axes | Camera | Label | Picture


def is_rigid(T: np.ndarray) -> bool:
    """Tell whether a 4x4 is a rotation and a translation, so that a viewer can take it as a
    pose.
    """
    rows = T[:3, :3].tolist()
    last = T[3].tolist()
    if last != [0.0, 0.0, 0.0, 1.0]:
        return False
    # in plain numbers: numpy takes 70 times as long for so few
    (a, b, c), (d, e, f), (g, h, i) = rows
    lengths = a * a + b * b + c * c, d * d + e * e + f * f, g * g + h * h + i * i
    products = a * d + b * e + c * f, a * g + b * h + c * i, d * g + e * h + f * i
    orthonormal = all(abs(length - 1.0) <= 1e-5 for length in lengths) and all(
        abs(product) <= 1e-6 for product in products
    )
    return orthonormal and a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g) > 0


def _check_common(primitive: Any, n: int | None) -> None:
    T = primitive.T_world_object
    if T is not None:
        check_array("T_world_object", T)
        need(T.shape == (4, 4), f"T_world_object is (4, 4), not {T.shape}")
        check_finite("T_world_object", T)
    need(0.0 <= primitive.opacity <= 1.0, "opacity is between 0 and 1")
    color = getattr(primitive, "color", "neutral")
    if isinstance(color, str):
        check_role(color)
    elif isinstance(color, np.ndarray):
        need(
            color.dtype == np.uint8 and color.shape == (n, 3),
            f"colours are ({n}, 3) uint8, not {color.dtype} {color.shape}",
        )
    elif isinstance(color, Field):
        need(
            color.values.shape == (n,), f"the Field holds {color.values.shape} values for {n} items"
        )
    elif isinstance(color, Classes):
        need(color.ids.shape == (n,), f"Classes holds {color.ids.shape} ids for {n} items")
    else:
        need(
            False,
            f"a colour is a role, a Field, Classes or an array ({n}, 3) uint8, not {what(color)}",
        )
