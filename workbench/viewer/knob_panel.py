"""Widgets for a Params class, made from its knobs; the scene's handles and picks included."""

from collections.abc import Callable
from typing import Any

import viser

from workbench.knobs import Field, Gizmo, fields_of
from workbench.lesson import Lesson
from workbench.page.legend import escape
from workbench.page.lessons import part_names
from workbench.viewer.handles import Handles

Change = Callable[..., None]


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
        self._handles = Handles(client.scene, lesson.params, change)
        self._fields = {field.name: field for field in fields_of(lesson.params)}
        defaults = lesson.params()
        for name, field in self._fields.items():
            value = getattr(defaults, name)
            if not isinstance(field.knob.by, Gizmo):
                self._widgets[name] = self._add(client.gui, field, value)
                continue
            with client.gui.add_folder(f"{field.label}: drag its handle in the scene", expand_by_default=False):
                self._widgets[name] = self._add(client.gui, field, value)

    def close(self) -> None:
        """Take the handles out of the scene; the widgets go with the interface they stand in."""
        self._handles.close()

    def show(self, params: Any) -> None:
        """Set every control to these params, without that counting as a wish."""
        for name, field in self._fields.items():
            value = getattr(params, name)
            for widget, part in zip(self._widgets[name], _parts(field, value), strict=True):
                if widget.value != part:
                    widget.value = part
        self._handles.show(params)

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
            names = [label] if len(parts) == 1 else [f"{label} {part}" for part in part_names(field)]
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


def _parts(field: Field, value: Any) -> list[Any]:
    if field.kind == "path":
        return []
    return list(value) if field.kind in ("floats", "ints") else [value]
