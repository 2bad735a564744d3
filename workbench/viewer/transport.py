"""The timeline: caption, legend, first / back / play / next / last, and the step slider."""

from collections.abc import Callable
from typing import Any

import viser

from workbench.session import Look
from workbench.viewer.style import escape, legend_html

BUTTONS = ("First", "Back", "Play", "Next", "Last")


class Transport:
    """The controls of time, in the container that is open.

    Args:
        gui: The client's interface.
        act: Called with `first`, `back`, `play`, `next` or `last`.
        seek: Called with the step a person dragged to.
    """

    def __init__(
        self,
        gui: viser.GuiApi,
        act: Callable[[str], None],
        seek: Callable[[Any], None],
    ):
        self.gui = gui
        self._caption = gui.add_html("")
        self._legend = gui.add_html("")
        self._buttons = gui.add_button_group("Step", BUTTONS)
        self._slider = gui.add_slider("Go to", 0, 1, 1, 0, hint="Drag to any step; N and P go one on and one back")
        self._said = ""

        @self._buttons.on_click
        async def _(event: Any) -> None:
            if event.client is not None:
                act(str(event.target.value).lower())

        @self._slider.on_update
        async def _(event: Any) -> None:
            if event.client is not None:
                seek(event.target.value)

    def show(self, look: Look) -> None:
        """Show where the run stands and what happened there."""
        last = max(look.known - 1, 1)
        if self._slider.max != last:
            self._slider.max = last
        k = min(look.k, last)
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
