"""How keys, buttons and clicks in the scene become wishes: small bridges from viser's events to plain functions."""

from collections.abc import Callable, Iterable
from typing import Any

import numpy as np
import viser

Act = Callable[[], None]


def on_click(handle: Any, act: Act) -> None:
    """Call `act` when a person clicks a button; what the server sets itself does not count."""

    @handle.on_click
    async def _(event: Any) -> None:
        if event.client is not None:
            act()


def add_commands(gui: viser.GuiApi, commands: Iterable[tuple[str, Any, Act]]) -> None:
    """Add (label, key or None, act) to the command palette; the keys work everywhere on the page."""
    for label, key, act in commands:
        command = gui.add_command(label, hotkey=key)

        @command.on_trigger
        async def _(event: Any, act: Act = act) -> None:
            act()


def listen_for_clicks(scene: viser.SceneApi, clicked: Callable[[np.ndarray, np.ndarray], None] | None) -> None:
    """Call `clicked` with the eye and the direction of every click in the scene; None listens no more."""
    scene.remove_click_callback()
    if clicked is None:
        return

    @scene.on_click()  # type: ignore[arg-type]
    async def _(event: Any) -> None:
        clicked(np.array(event.ray_origin), np.array(event.ray_direction))
