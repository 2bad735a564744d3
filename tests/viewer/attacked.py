"""A server that is attacked while somebody works there: the others go on, and nothing is left of
anybody.
"""

import asyncio
import contextlib
from collections.abc import AsyncIterator, Awaitable, Callable, Iterator

import pytest

from tests import fake
from tests.fake_page import FakePage
from tests.loops import run_apart
from workbench.run import links
from workbench.run.timeline import Timeline
from workbench.viewer.server import Server

HERE = "?lesson=fake"


@pytest.fixture(scope="module", name="server")
def attacked_server() -> Iterator[Server]:
    server = Server(links.Place(fake.lesson, fake.Params()))
    yield server
    server.stop()


@contextlib.asynccontextmanager
async def visiting(server: Server, query: str = HERE) -> AsyncIterator[FakePage]:
    page = await FakePage(f"{server.address}/", query).open()
    try:
        await page.until(lambda page: page.run.get("finished"))
        yield page
    finally:
        await page.close()


async def goes_on(page: FakePage) -> None:
    """See a page make a few steps."""
    for k in (1, 4, 2, 0):
        await page.seek(k)
        assert (
            page.step["step"]["caption"]
            == Timeline(fake.lesson, fake.Params()).complete()[k].caption.text
        )


async def until(holds: Callable[[], bool]) -> None:
    async with asyncio.timeout(60):
        while not holds():
            await asyncio.sleep(0.02)


def meanwhile(server: Server, attack: Callable[[FakePage], Awaitable[None]]) -> None:
    """Attack a server while somebody works there; then see that nothing is left of anybody."""

    async def all_of_it() -> None:
        async with visiting(server) as page:
            await attack(page)
            await goes_on(page)
        await until(lambda: not server.students)

    run_apart(all_of_it())
    assert len(server.runs.scheduler) == 0
