"""The timeline: caption, legend, first / back / play / next / last, and the step slider."""

from collections.abc import Callable
from contextlib import AbstractContextManager
from typing import Any

import viser

from workbench.page.legend import escape, legend_html
from workbench.session import Look

BUTTONS = ("First", "Back", "Play", "Next", "Last")


class Transport:
    """The controls of time.

    Args:
        gui: The client's interface.
        container: Where they stand.
        act: Called with `first`, `back`, `play`, `next` or `last`.
        seek: Called with the step a person dragged to.
    """

    def __init__(
        self,
        gui: viser.GuiApi,
        container: AbstractContextManager,
        act: Callable[[str], None],
        seek: Callable[[Any], None],
    ):
        self._gui, self._container, self._seek = gui, container, seek
        with container:
            self._caption = gui.add_html("")
            self._legend = gui.add_html("")
            self._buttons = gui.add_button_group("Step", BUTTONS)
        self._mark: int | None = None
        self._slider = self._new_slider(1, 0)
        self._said = ""

        @self._buttons.on_click
        async def _(event: Any) -> None:
            if event.client is not None:
                act(str(event.target.value).lower())

    def _new_slider(self, last: int, k: int) -> viser.GuiSliderHandle[int]:
        marks = None if self._mark is None else ((self._mark, "first difference"),)
        with self._container:
            slider = self._gui.add_slider(
                "Go to", 0, last, 1, k, marks=marks, hint="Drag to any step; N and P go one on and one back"
            )

        @slider.on_update
        async def _(event: Any) -> None:
            if event.client is not None:
                self._seek(event.target.value)

        return slider

    def show(self, look: Look, mark: int | None = None) -> None:
        """Show where the run stands and what happened there; `mark` is a step worth a word at the slider."""
        last = max(look.known - 1, 1)
        k = min(look.k, last)
        if mark != self._mark:  # a slider's marks stay as they were made
            self._mark = mark
            self._slider.remove()
            self._slider = self._new_slider(last, k)
        if self._slider.max != last:
            self._slider.max = last
        if self._slider.value != k:
            self._slider.value = k
        steps = f"Step {look.k} of {look.known - 1}" + ("" if look.finished else " …")
        if self._buttons.label != steps:
            self._buttons.label = steps
        text = (
            f'<div class="wb-caption {look.caption.tone}" role="status" aria-live="polite">'
            f"{escape(look.caption.text)}</div>"
        )
        if text != self._said:
            self._said = self._caption.content = text
        legend = legend_html(look.scene, look.lesson.view.grid)
        if self._legend.content != legend:
            self._legend.content = legend
        names = tuple("Pause" if look.playing and name == "Play" else name for name in BUTTONS)
        if tuple(self._buttons.options) != names:
            self._buttons.options = names
