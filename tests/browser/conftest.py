"""A running workbench for the tests in this folder, and visits to it."""

from collections.abc import Callable, Iterator
from typing import Any

import pytest

from tests.browser.visits import Visit
from workbench.viewer.server import Server


@pytest.fixture(scope="session")
def server() -> Iterator[Server]:
    """The workbench, serving all lessons."""
    server = Server()
    yield server
    server.stop()


@pytest.fixture
def visit(chromium, server) -> Iterator[Callable[..., Visit]]:
    """visit(query): a page that is open until the test ends; errors in its console fail the
    test.
    """
    visits: list[Visit] = []

    def opened(query: str = "", at: Server = server, **how: Any) -> Visit:
        visits.append(Visit(chromium, at, query, **how))
        return visits[-1]

    yield opened
    for visitor in visits:
        visitor.page.context.close()
    errors = [error for visitor in visits for error in visitor.errors]
    assert errors == []
