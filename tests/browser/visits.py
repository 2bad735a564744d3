"""A page that is open in a real browser, and what a student does in it."""

from typing import Any

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
"""Lets viser draw a few pictures a second or fewer: without a graphics card they are what a visit costs most."""


class Visit:
    """One browser window on the workbench; errors of its console, and addresses elsewhere that it asks for, are kept.

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
        context = chromium.new_context(viewport={"width": width, "height": height}, reduced_motion="reduce")
        context.grant_permissions(["clipboard-read", "clipboard-write"], origin=server.address)
        self.page = context.new_page()
        self.page.add_init_script(SELDOM)
        if not scene:
            empty = "<!doctype html><title>No scene</title>"
            self.page.route("**/scene/*/", lambda route: route.fulfill(body=empty, content_type="text/html"))
        self.page.on("pageerror", lambda error: self.errors.append(str(error)))
        self.page.on("console", lambda message: self.errors.append(message.text) if message.type == "error" else None)
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
