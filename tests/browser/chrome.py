"""Finds a Chromium or Chrome, and starts it so that it draws without a graphics card."""

import os
import shutil
from collections.abc import Iterator
from contextlib import contextmanager

HOW_TO = (
    "no Chromium or Chrome here: install one (Debian: apt-get install chromium), or set WORKBENCH_CHROMIUM to its path"
)
FLAGS = [
    "--no-sandbox",
    "--use-gl=angle",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
    "--ignore-gpu-blocklist",
    "--disable-background-networking",
    "--disable-component-update",
    "--no-first-run",
]


def find_chromium() -> str | None:
    """Return the path of a browser, None where there is none."""
    named = os.environ.get("WORKBENCH_CHROMIUM")
    if named:
        return named
    names = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable", "chrome")
    return next((path for name in names if (path := shutil.which(name))), None)


@contextmanager
def started() -> Iterator:
    """Start a browser; the value opens pages."""
    from playwright.sync_api import sync_playwright

    path = find_chromium()
    assert path is not None, HOW_TO
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=path, args=FLAGS)
        try:
            yield browser
        finally:
            browser.close()
