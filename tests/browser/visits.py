"""A page that is open in a real browser, and what a student does in it."""

from workbench.viewer.server import Server


class Visit:
    """One browser window on the workbench; errors of its console, and addresses elsewhere that it asks for, are kept."""

    def __init__(self, chromium, server: Server, query: str = "", width: int = 1440, height: int = 900):
        self.errors: list[str] = []
        self.address = server.address
        context = chromium.new_context(viewport={"width": width, "height": height})
        context.grant_permissions(["clipboard-read", "clipboard-write"], origin=server.address)
        self.page = context.new_page()
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
