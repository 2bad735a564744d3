"""A page with the scripts that show scenes, and a model of viser's client that they feed; no
server, no drawing.
"""

import base64
import json
from collections.abc import Iterable
from pathlib import Path
from typing import Any

from workbench.lesson import View
from workbench.page.bundles import SCENE, STATIC
from workbench.scene import Scene
from workbench.wire.nodes import Maker
from workbench.wire.packing import PageWire

MODEL = Path(__file__).with_name("viser_model.js")
VIEW = View(eye=(2.0, -2.0, 1.5))
BODY = (
    '<div id="scene" style="position:relative;width:800px;height:500px">'
    '<iframe style="width:100%;height:100%;border:0"></iframe><div id="labels"></div></div>'
)
START = (
    "stage.frame = $('iframe'); for (const part of [labels, handles]) part.start(); const wire ="
    " new Wire(); connect();"
)


class Fed:
    """A page that shows scenes to a modelled client.

    Args:
        chromium: A running browser.
        knobs: Those of the lesson, as the page knows them.
    """

    def __init__(self, chromium: Any, knobs: Iterable[dict[str, Any]] = ()):
        self.page = chromium.new_page(viewport={"width": 900, "height": 600})
        self.errors: list[str] = []
        self.page.on("pageerror", lambda error: self.errors.append(str(error)))
        style = (STATIC / "page.css").read_text(encoding="utf-8")
        self.page.set_content(f"<!doctype html><style>{style}</style>{BODY}")
        self.page.add_script_tag(content=f"const LESSON = {json.dumps({'knobs': list(knobs)})};")
        self.page.add_script_tag(path=MODEL)
        for name in ("tools.js", *SCENE):
            self.page.add_script_tag(path=STATIC / name)
        self.page.add_script_tag(content=START)
        self._wire = PageWire(Maker())
        self._count = 0

    def add(self, scenes: Iterable[Scene], view: View = VIEW) -> range:
        """Let the page read scenes, and return their numbers there."""
        first = self._count
        for scene in scenes:
            message = self._wire.step({}, scene, view)
            self("(content) => { read(wire, content); }", base64.b64encode(message).decode())
            self._count += 1
        return range(first, self._count)

    def __call__(self, script: str, argument: Any = None) -> Any:
        """Return what a function of the page returns; an error in the page fails the test."""
        value = self.page.evaluate(script, argument)
        assert self.errors == []
        return value

    def close(self) -> None:
        """Close the page."""
        self.page.close()
