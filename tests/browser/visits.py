"""A page that is open in a real browser, and what a student does in it."""

import io
from typing import Any

import numpy as np
from PIL import Image

from workbench.viewer.server import Server

SELDOM = """if (parent !== self && (location.pathname.includes("/scene/") || parent.stage)) {
  const waiting = [];
  let last = 0;
  window.requestAnimationFrame = (draw) => waiting.push(draw);
  setInterval(() => {
    if (!waiting.length || performance.now() - last < (parent.secondsBetweenPictures ?? 0.5) * 1000) return;
    last = performance.now();
    parent.pictures = (parent.pictures ?? 0) + 1;
    for (const draw of waiting.splice(0)) draw(last);
  }, 50);
}"""
"""Lets viser draw a few pictures a second or fewer: without a graphics card they are what a visit
costs most.
"""

MOST = 200  # pictures
ALIKE = 6  # pictures in a row that are the same: surfaces are decoded beside the frames


def at_rest(page: Any) -> np.ndarray:
    """Return what a scene looks like as soon as it stays as it is, by the means over tiles of ten
    pixels.

    Thin lines of a grid are not drawn the same twice.
    """
    view = page.locator("#view").bounding_box()
    between = {
        "x": view["x"] + 10,
        "y": view["y"] + 40,
        "width": view["width"] - 20,
        "height": view["height"] - 90,
    }
    before = b""
    alike = 0
    for _ in range(MOST):
        page.evaluate(
            "new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))"
        )
        shot = page.screenshot(clip=between)
        alike = alike + 1 if shot == before else 0
        if alike == ALIKE:
            image = Image.open(io.BytesIO(shot)).convert("RGB")
            return np.asarray(
                image.resize((image.width // 10, image.height // 10), Image.Resampling.BOX)
            ).astype(int)
        before = shot
    raise AssertionError("the scene does not come to rest")


class Visit:
    """One browser window on the workbench; errors of its console, and addresses elsewhere that it
    asks for, are kept.

    Without `scene` an empty page stands in the place of viser's: for what is said, and not drawn.
    """

    def __init__(
        self,
        chromium: Any,
        server: Server,
        query: str = "",
        *,
        width: int = 1280,
        height: int = 720,
        scene: bool = False,
    ):
        self.errors: list[str] = []
        self.address = server.address
        context = chromium.new_context(
            viewport={"width": width, "height": height}, reduced_motion="reduce"
        )
        context.grant_permissions(["clipboard-read", "clipboard-write"], origin=server.address)
        self.page = context.new_page()
        self.page.add_init_script(SELDOM)
        if not scene:
            empty = "<!doctype html><title>No scene</title>"
            self.page.route(
                "**/scene/", lambda route: route.fulfill(body=empty, content_type="text/html")
            )
        self.page.on("pageerror", lambda error: self.errors.append(str(error)))
        self.page.on(
            "console",
            lambda message: self.errors.append(message.text) if message.type == "error" else None,
        )
        self.page.on("request", lambda request: self._local(request.url, server))
        self.go(query)

    def _local(self, url: str, server: Server) -> None:
        if not url.startswith((server.address, f"ws://127.0.0.1:{server.port}", "data:", "blob:")):
            self.errors.append(f"asked for {url}")

    def go(self, query: str) -> None:
        self.page.goto(f"{self.address}/{query}")

    def says(self, caption: str) -> None:
        self.page.locator("#caption").get_by_text(caption).wait_for()

    def act(self, verb: str) -> None:
        self.page.locator(f"[data-act={verb}]").click()

    def button(self, name: str):
        return self.page.get_by_role("button", name=name, exact=True).first

    def scene(self) -> None:
        """Wait until the scene is there."""
        self.page.frame_locator("#scene iframe").locator("canvas").first.wait_for()
