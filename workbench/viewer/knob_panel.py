"""Widgets for a Params class, made from its knobs; the scene's handles and picks included."""

import itertools
from collections.abc import Callable
from typing import Any

import numpy as np
import viser
from viser.transforms import SO3

from workbench.knobs import Field, Gizmo, fields_of
from workbench.lesson import Lesson
from workbench.viewer.style import escape

Change = Callable[..., None]


_NUMBERS = itertools.count()
"""Of handles: the browser may take the pose of one that is gone for that of another with its name."""


class KnobPanel:
    """The controls of one lesson's params.

    Args:
        client: Whose controls they are.
        lesson: Whose params they set.
        change: Called with a field's name and value when a person moved a control; must not block.
    """

    def __init__(self, client: viser.ClientHandle, lesson: Lesson, change: Change):
        self._change = change
        self._widgets: dict[str, list[Any]] = {}
        self._gizmos: dict[str, Any] = {}
        self._held: str | None = None  # the gizmo a hand is on: it leads, and is not moved from here
        self._fields = {field.name: field for field in fields_of(lesson.params)}
        defaults = lesson.params()
        for name, field in self._fields.items():
            value = getattr(defaults, name)
            if not isinstance(field.knob.by, Gizmo):
                self._widgets[name] = self._add(client.gui, field, value)
                continue
            self._gizmos[name] = self._gizmo(client.scene, field, value)
            with client.gui.add_folder(f"{field.label}: drag its handle in the scene", expand_by_default=False):
                self._widgets[name] = self._add(client.gui, field, value)

    def close(self) -> None:
        """Take the handles out of the scene; the widgets go with the interface they stand in."""
        for gizmo in self._gizmos.values():
            gizmo.remove()
        self._gizmos.clear()

    def show(self, params: Any) -> None:
        """Set every control to these params, without that counting as a wish."""
        for name, field in self._fields.items():
            value = getattr(params, name)
            for widget, part in zip(self._widgets[name], _parts(field, value), strict=True):
                if widget.value != part:
                    widget.value = part
            gizmo = self._gizmos.get(name)
            if gizmo is not None and self._held != name:
                gizmo.position = np.array(value[:3])
                gizmo.wxyz = SO3.exp(np.array(value[3:6])).wxyz if len(value) == 6 else np.array([1.0, 0, 0, 0])

    def _add(self, gui: viser.GuiApi, field: Field, value: Any) -> list[Any]:
        knob, label = field.knob, field.label
        unit = f" ({knob.unit})" if knob.unit else ""
        if field.kind == "path":
            file = "none; start with a file to set it" if value is None else str(value)
            gui.add_html(f'<div class="wb-note">{escape(label)}: {escape(file)}</div>', visible=value is not None)
            return []
        if field.kind == "bool":
            widgets = [gui.add_checkbox(label, value, hint=knob.hint)]
        elif field.kind == "choice":
            widgets = [gui.add_dropdown(label + unit, field.choices, initial_value=value, hint=knob.hint)]
        else:
            parts = _parts(field, value)
            names = [label] if len(parts) == 1 else [f"{label} {part}" for part in _part_names(field)]
            whole = field.kind in ("int", "ints")
            low, high = knob.low or 0, knob.high or 0
            ends = (
                (int(low), int(high), int(max(1, field.step)))
                if whole
                else (float(low), float(high), float(field.step))
            )
            widgets = [
                gui.add_slider(name + unit, *ends, part, hint=knob.hint)
                for name, part in zip(names, parts, strict=True)
            ]
        for i, widget in enumerate(widgets):
            widget.on_update(self._listener(field, i))
        return widgets

    def _listener(self, field: Field, i: int) -> Callable[[Any], Any]:
        async def changed(event: Any) -> None:
            if event.client is None:
                return
            if field.kind in ("floats", "ints"):
                parts = [widget.value for widget in self._widgets[field.name]]
                parts[i] = event.target.value
                self._change(**{field.name: parts})
            else:
                self._change(**{field.name: event.target.value})

        return changed

    def _gizmo(self, scene: viser.SceneApi, field: Field, value: tuple[float, ...]) -> Any:
        size = field.knob.by.size if isinstance(field.knob.by, Gizmo) else 0.5
        gizmo = scene.add_transform_controls(
            f"/gizmo/{field.name}~{next(_NUMBERS)}",
            scale=size,
            disable_rotations=len(value) != 6,
            depth_test=False,
            line_width=3.0,
        )

        @gizmo.on_update
        async def _(event: Any) -> None:
            if event.client is None:
                return
            self._held = None if event.phase == "end" else field.name
            values = [float(v) for v in event.target.position]
            if len(value) == 6:
                values += [float(v) for v in SO3(np.array(event.target.wxyz)).log()]
            self._change(**{field.name: values})

        return gizmo


def _parts(field: Field, value: Any) -> list[Any]:
    if field.kind == "path":
        return []
    return list(value) if field.kind in ("floats", "ints") else [value]


def _part_names(field: Field) -> tuple[str, ...]:
    n = field.length
    known = {2: ("x", "y"), 3: ("x", "y", "z"), 6: ("x", "y", "z", "turn x", "turn y", "turn z")}
    return field.knob.parts or known.get(n) or tuple(str(i + 1) for i in range(n))
