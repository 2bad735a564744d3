"""Finds a Chromium or Chrome, and starts it so that it draws without a graphics card."""

import os
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from playwright.sync_api import Browser, BrowserContext, BrowserType, Page

WAIT = 180_000
"""Milliseconds after which a test gives up: it waits for states, also on a busy machine that draws
slowly.
"""
HOW_TO = (
    "no Chromium or Chrome here: install one (Debian: apt-get install chromium-headless-shell), or"
    " set WORKBENCH_CHROMIUM to its path"
)
FLAGS = [
    "--no-sandbox",
    "--use-gl=angle",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
    "--ignore-gpu-blocklist",
    # what draws by software on a busy machine is slow, not dead
    "--disable-gpu-watchdog",
    "--disable-gpu-process-crash-limit",
    # a page around the scene is put together without WebGL's software renderer
    "--disable-gpu-compositing",
    "--disable-gpu-rasterization",
    "--disable-background-networking",
    "--disable-component-update",
    "--no-first-run",
]


def find_chromium() -> str | None:
    """Return the path of a browser, None where there is none."""
    named = os.environ.get("WORKBENCH_CHROMIUM")
    if named:
        return named
    names = (
        "chromium-headless-shell",
        "chromium",
        "chromium-browser",
        "google-chrome",
        "google-chrome-stable",
        "chrome",
    )
    return next((path for name in names if (path := shutil.which(name))), None)


class Chrome:
    """A running browser; whatever its pages wait for, they wait for as long as a slow machine
    needs.

    Tests ask pages by expressions, which a page's own policy would refuse; `bypass_csp=False` holds
    a page to its policy.
    """

    def __init__(self, browser: "Browser"):
        self._browser = browser

    def new_context(self, **options: Any) -> "BrowserContext":
        """Return a browser window of its own: its own storage, its own tabs."""
        context = self._browser.new_context(**{"bypass_csp": True, **options})
        context.set_default_timeout(WAIT)
        return context

    def new_page(self, **options: Any) -> "Page":
        """Return a page in a window of its own, which closes with it."""
        page = self._browser.new_page(**{"bypass_csp": True, **options})
        page.set_default_timeout(WAIT)
        return page

    @contextmanager
    def another(self) -> Iterator["Chrome"]:
        """Start a browser in which nothing was done before; the value opens pages."""
        browser = _launched(self._browser.browser_type)
        try:
            yield Chrome(browser)
        finally:
            browser.close()


@contextmanager
def started() -> Iterator[Chrome]:
    """Start a browser; the value opens pages."""
    from playwright.sync_api import sync_playwright

    with sync_playwright() as playwright:
        browser = _launched(playwright.chromium)
        try:
            yield Chrome(browser)
        finally:
            browser.close()


def _launched(kind: "BrowserType") -> "Browser":
    path = find_chromium()
    assert path is not None, HOW_TO
    return kind.launch(executable_path=path, args=FLAGS)
