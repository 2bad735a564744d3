"""A running workbench for the tests in this folder."""

from collections.abc import Iterator

import pytest

from workbench.viewer.server import Server


@pytest.fixture(scope="session")
def app() -> Iterator[App]:
    """The workbench, serving all lessons."""
    app = App(port=0)
    yield app
    app.stop()
