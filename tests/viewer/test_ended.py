"""A live server that is ended: nothing of a student goes on, and no lesson keeps it from ending."""

import asyncio
import contextlib
import signal
import sys
from collections.abc import AsyncIterator

import httpx
import pytest

from tests.exercise.processes import family
from tests.exercise.test_interrupted import HANGS, sandboxed, there, until
from tests.fake_page import FakePage
from tests.loops import run_apart
from tests.viewer.test_serving import running
from workbench.exercise.sandbox import best

BLOCKS = """
import threading
from dataclasses import replace
from tests import fake

def run(params):
    steps = fake.run(params)
    yield next(steps)
    yield next(steps)
    threading.Event().wait()

lesson = replace(fake.lesson, name="blocks", run=run, presets=(), questions=())
"""


@contextlib.asynccontextmanager
async def opened(address: str, query: str) -> AsyncIterator[FakePage]:
    page = await FakePage(address, query).open()
    try:
        yield page
    finally:
        await page.close()


@pytest.mark.skipif(
    sys.platform != "linux" or not best().holds,
    reason=f"nothing shuts submissions in: {best().why}",
)
@pytest.mark.parametrize("how", [signal.SIGTERM, signal.SIGKILL])
def test_a_live_student_s_file_ends_with_the_server(tmp_path, how):
    file = tmp_path / "my_invert_rigid.py"
    file.write_text(HANGS)

    async def visit(address: str) -> set[int]:
        async with opened(address, "?lesson=transforms") as page:
            await page.until(lambda page: page.run)
            pids = until(lambda: sandboxed(process.pid))
            process.send_signal(how)
            return pids

    with running("show", "transforms", "--with", str(file), "--port", "0") as (process, address):
        pids = run_apart(visit(address))
        _, errors = process.communicate(timeout=300)
        assert (process.returncode, errors) == (
            (0, "") if how == signal.SIGTERM else (-signal.SIGKILL, errors)
        )
        until(lambda: not there(pids))
        assert not family(process.pid)


def test_a_lesson_that_blocks_for_ever_does_not_keep_ctrl_c_from_ending_a_server(tmp_path):
    (tmp_path / "blocks.py").write_text(BLOCKS)

    async def visit(address: str) -> None:
        async with opened(address, "?lesson=blocks") as page:
            await page.until(lambda page: page.step.get("k") == 0)
            await page.say(verb="seek", k=4)
            async with httpx.AsyncClient(base_url=address, trust_env=False) as browser:
                with contextlib.suppress(httpx.ReadTimeout):
                    # the thread that makes pictures blocks as well
                    await browser.get("picture/blocks", timeout=0.5)
            with pytest.raises(TimeoutError):
                await page.until(lambda page: page.step.get("k") == 4, 0.5)
            await page.seek(1)
            process.send_signal(signal.SIGINT)
            assert await asyncio.to_thread(process.wait, 20) == 0

    with running("show", str(tmp_path / "blocks.py"), "--port", "0") as (process, address):
        run_apart(visit(address))
        out, errors = process.communicate(timeout=20)
        assert (process.returncode, out, errors) == (0, "", "")
