"""A browser and a running workbench for the tests in this folder; without a browser they are skipped with the reason."""

import os
from collections.abc import Iterator

import pytest

from tests.browser.chrome import HOW_TO, find_chromium, started
from workbench.viewer.app import App


@pytest.fixture(scope="session")
def chromium() -> Iterator:
    """A running Chromium; on a build server a missing one is a failure, not a skip."""
    if find_chromium() is None:
        if os.environ.get("CI"):
            pytest.fail(HOW_TO)
        pytest.skip(HOW_TO)
    with started() as browser:
        yield browser


@pytest.fixture(scope="session")
def app() -> Iterator[App]:
    """The workbench, serving all lessons."""
    app = App(port=0)
    yield app
    app.stop()
