"""What in the scene sets a lesson's params: handles that a person drags, and that follow what is set elsewhere; clicks."""

import itertools
from collections.abc import Callable
from typing import Any

import numpy as np
import viser
from viser.transforms import SO3

from workbench.knobs import Field, Gizmo, fields_of

_NUMBERS = itertools.count()
"""Of handles: the browser may take the pose of one that is gone for that of another with its name."""


class Handles:
    """The handles of one lesson, one for each field of its Params that is set by a Gizmo.

    Args:
        scene: Where they stand.
        params: The Params class.
        change: Called with a field's name and values when a person moved a handle; must not block.
    """

    def __init__(self, scene: viser.SceneApi, params: type, change: Callable[..., None]):
        self._change = change
        self._held: str | None = None  # the handle a hand is on: it leads, and is not moved from here
        self._handles = {
            field.name: self._added(scene, field) for field in fields_of(params) if isinstance(field.knob.by, Gizmo)
        }

    def close(self) -> None:
        """Take the handles out of the scene."""
        for handle in self._handles.values():
            handle.remove()
        self._handles.clear()

    def show(self, params: Any) -> None:
        """Put every handle where these params say."""
        for name, handle in self._handles.items():
            value = getattr(params, name)
            if self._held != name:
                handle.position = np.array([*value[:3], 0.0][:3])
                handle.wxyz = SO3.exp(np.array(value[3:6])).wxyz if len(value) == 6 else np.array([1.0, 0, 0, 0])

    def _added(self, scene: viser.SceneApi, field: Field) -> Any:
        assert isinstance(field.knob.by, Gizmo)
        handle = scene.add_transform_controls(
            f"/gizmo/{field.name}~{next(_NUMBERS)}",
            scale=field.knob.by.size,
            disable_rotations=field.length != 6,
            active_axes=(True, True, field.length != 2),
            depth_test=False,
            line_width=3.0,
        )

        @handle.on_update
        async def _(event: Any) -> None:
            if event.client is None:
                return
            self._held = None if event.phase == "end" else field.name
            values = [float(v) for v in event.target.position][: field.length]
            if field.length == 6:
                values += [float(v) for v in SO3(np.array(event.target.wxyz)).log()]
            self._change(**{field.name: values})

        return handle


def listen_for_clicks(scene: viser.SceneApi, clicked: Callable[[np.ndarray, np.ndarray], None] | None) -> None:
    """Call `clicked` with the eye and the direction of every click in the scene; None listens no more."""
    scene.remove_click_callback()
    if clicked is None:
        return

    @scene.on_click()  # type: ignore[arg-type]
    async def _(event: Any) -> None:
        clicked(np.array(event.ray_origin), np.array(event.ray_direction))
