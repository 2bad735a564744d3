"""Says of a scene what viser's own scene API would say, to viser's client.

NumPy and the standard library alone, since a browser that computes a lesson makes its scenes by
this too. `tests/wire/test_writer.py` holds it equal to viser's scene API, which takes two to four
times as long: it makes a handle of each node, for which nobody here asks.
"""

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from workbench.machinery.images import jpeg, plain_png

Said = dict[str, Any]
"""A message of viser as plain data; an array in it is `{"__binary_index": i, "dtype": ...}`."""
Heard = list[tuple[Said, list[memoryview]]]
"""Messages, each with its arrays."""
ImageFile = tuple[str, bytes]
"""A kind of file, `jpeg` or `png`, and a file's bytes."""

_GRID = {
    "width": 10.0,
    "height": 10.0,
    "fade_strength": 1.0,
    "plane_color": (255, 255, 255),
    "plane_opacity": 0.0,
}
_UNTURNED = (1.0, 0.0, 0.0, 0.0)
_SKY = {
    "type": "EnvironmentMapMessage",
    "hdri_data": None,
    "background": False,
    "background_blurriness": 0.0,
    "background_intensity": 1.0,
    "background_wxyz": _UNTURNED,
    "environment_intensity": 1.0,
    "environment_wxyz": _UNTURNED,
}


def as_jpeg(image: np.ndarray) -> ImageFile:
    """Return an image as viser sends it."""
    return "jpeg", jpeg(image)


def as_png(image: np.ndarray) -> ImageFile:
    """Return an image as it is sent where there is no Pillow."""
    return "png", plain_png(image)


class Writer:
    """Hears what viser would send for what is added to a scene. For one thread.

    Args:
        picture: Returns an image, (h, w, 3) uint8, as the bytes of a file, and which kind of file.
    """

    def __init__(self, picture: Callable[[np.ndarray], ImageFile] = as_jpeg) -> None:
        self._scene = PlainScene(picture)
        self._scene.add_frame(
            "/WorldAxes", axes_length=0.5, axes_radius=0.0125, origin_radius=0.025
        )
        self._scene.say({"type": _HIDING, "name": "/WorldAxes", "visible": False})
        self.at_first = self._scene.taken()

    def heard(self, add: Callable[[Any], Any]) -> Heard:
        """Return what viser would say when something is added to its scene: each message, and its
        arrays.
        """
        add(self._scene)
        return self._scene.taken()


_HIDING = "SetSceneNodeVisibilityMessage"


class PlainScene:
    """The methods of viser's SceneApi that `primitives` and `stage` call, by the same keywords."""

    def __init__(self, picture: Callable[[np.ndarray], ImageFile]) -> None:
        self._picture = picture
        self._heard: Heard = []

    def taken(self) -> Heard:
        """Return what was said; then nothing is."""
        heard = self._heard
        self._heard = []
        return heard

    def say(self, message: Said, arrays: list[memoryview] | None = None) -> None:
        """Say one message."""
        self._heard.append((message, arrays or []))

    def configure_default_lights(self, *, cast_shadow: bool) -> None:
        """Light the scene by viser's lamps."""
        self.say({"type": "EnableLightsMessage", "enabled": True, "cast_shadow": cast_shadow})

    def configure_environment_map(self, *, hdri: None) -> None:
        """Show no surroundings."""
        self.say({**_SKY, "hdri_data": hdri})

    def add_light_hemisphere(self, name: str, *, position: Any, **props: Any) -> None:
        """Add a plain sky."""
        self._node("HemisphereLightMessage", name, props, position=position)

    def add_frame(self, name: str, **sizes: float) -> None:
        """Add three axes at the origin."""
        shown = {"show_axes": True, "origin_color": (236, 236, 0), "scale": 1.0}
        self._node("FrameMessage", name, shown | sizes)

    def add_grid(self, name: str, *, position: Any, **props: Any) -> None:
        """Add a grid."""
        self._node("GridMessage", name, _GRID | {"scale": 1.0} | props, position=position)

    def add_point_cloud(
        self, name: str, points: np.ndarray, colors: np.ndarray, **props: Any
    ) -> None:
        """Add points."""
        self._node("PointCloudMessage", name, _colored(points, colors) | props)

    def add_line_segments(
        self, name: str, points: np.ndarray, colors: np.ndarray, **props: Any
    ) -> None:
        """Add lines."""
        self._node("LineSegmentsMessage", name, _colored(points, colors) | props)

    def add_arrows(self, name: str, points: np.ndarray, colors: np.ndarray, **props: Any) -> None:
        """Add arrows."""
        self._node("ArrowMessage", name, _colored(points, colors) | props)

    def add_mesh_simple(
        self, name: str, vertices: np.ndarray, faces: np.ndarray, **props: Any
    ) -> None:
        """Add a mesh of one colour."""
        shape = {"vertices": vertices, "faces": faces, "opacity": None, "material": "standard"}
        self._node("MeshMessage", name, shape | {"scale": 1.0} | props)

    def add_glb(self, name: str, glb_data: bytes, **props: Any) -> None:
        """Add what a glTF file holds."""
        self._node("GlbMessage", name, {"glb_data": glb_data, "scale": 1.0} | props)

    def add_image(self, name: str, image: np.ndarray, *size: float, **props: Any) -> None:
        """Add an image of a width and a height."""
        position = props.pop("position", None)
        width, height = size
        shown = {"render_width": width, "render_height": height, "scale": 1.0}
        kind, data = self._picture(image)
        picture = {"_format": kind, "_data": data}
        self._node("ImageMessage", name, picture | shown | props, position=position)

    def _node(
        self, kind: str, name: str, props: Mapping[str, Any], *, position: Any = None
    ) -> None:
        arrays: list[memoryview] = []

        def plain(value: Any) -> Any:
            if not isinstance(value, np.ndarray):
                return value
            arrays.append(np.ascontiguousarray(value).data)
            return {"__binary_index": len(arrays) - 1, "dtype": value.dtype.str}

        told = {key: plain(value) for key, value in props.items()}
        self.say({"type": kind, "name": name, "props": told}, arrays)
        if position is not None:
            place = tuple(float(x) for x in position)
            self.say({"type": "SetPositionMessage", "name": name, "position": place})


def _colored(points: np.ndarray, colors: np.ndarray) -> dict[str, Any]:
    return {"points": points, "colors": colors, "scale": 1.0}
