"""A page's requests on the live server, without a browser: what comes from another thread wakes a
page that is at rest.
"""

import asyncio
import json
import threading
from dataclasses import replace

import numpy as np

from tests import fake
from tests.loops import run_apart
from workbench.lesson import Lesson, Preset, View
from workbench.run import links
from workbench.run.timeline import Timeline
from workbench.viewer.connection import PageConnection
from workbench.viewer.runs import SharedRuns


class Talk:
    """A student at work, and what the page was told."""

    def __init__(self, lesson: Lesson = fake.lesson) -> None:
        self.told: list[dict] = []
        self.scenes: list[dict] = []  # what was said before their arrays
        self._heard = asyncio.Event()
        self.runs = SharedRuns()
        self.student = PageConnection({"fake": lesson}, self.runs, self._hear)
        self._work = asyncio.create_task(self.student.work())

    async def _hear(self, part: str | bytes) -> None:
        if isinstance(part, bytes):
            head = json.loads(part[4 : 4 + int.from_bytes(part[:4], "little")])
            self.scenes.append(head)
        else:
            self.told.append(json.loads(part))
        self._heard.set()

    def say(self, **message) -> None:
        self.student.hear(json.dumps(message))

    async def until(self, wanted) -> dict:
        """Wait for the first message that is wanted."""
        async with asyncio.timeout(60):  # nothing else wakes the loop
            while not (matching := [message for message in self.told if wanted(message)]):
                assert not self._work.done(), self._work
                self._heard.clear()
                await self._heard.wait()
        return matching[0]

    async def at_rest(self) -> None:
        await self.until(lambda message: message["tell"] == "run" and message["finished"])
        await asyncio.sleep(0)
        self.told.clear()


def talk(script, lesson: Lesson = fake.lesson) -> None:
    async def run() -> None:
        me = Talk(lesson)
        try:
            await script(me)
        finally:
            me.runs.close()

    run_apart(run())


def test_steps_are_those_of_the_timeline():
    here = Timeline(fake.lesson, fake.Params()).complete()

    async def script(me: Talk) -> None:
        me.say(verb="open", query="?lesson=fake", lesson="fake")
        await me.at_rest()
        for k in (2, 1, 3):
            me.say(verb="seek", k=k)
            step = await me.until(
                lambda message, k=k: message["tell"] == "step" and message["k"] == k
            )
            assert step["step"]["caption"] == here[k].caption.text

    talk(script)


def test_a_wish_of_another_thread_wakes_a_page_at_rest():
    news = {"tell": "notice", "text": "saved"}

    async def script(me: Talk) -> None:
        me.say(verb="open", query="?lesson=fake", lesson="fake")
        await me.at_rest()
        threading.Timer(
            0.2, lambda: me.student.tell_where(fake.lesson, news)
        ).start()  # when the loop sleeps
        await me.until(lambda message: message["tell"] == "notice")

    talk(script)


def test_news_that_nobody_waits_for_delay_no_step(monkeypatch):
    news = {"tell": "notice", "text": "saved"}

    async def script(me: Talk) -> None:
        me.say(verb="open", query="?lesson=fake", lesson="fake")
        await me.at_rest()
        shown = asyncio.Queue[str]()
        for name in ("stepping", "showing"):
            crew = getattr(me.runs, name)

            async def noted(*args, name=name, do=crew.do):
                shown.put_nowait(name)
                return await do(*args)

            monkeypatch.setattr(crew, "do", noted)
        async with asyncio.timeout(60):
            me.say(verb="seek", k=2)
            assert await shown.get() == "stepping"
            await me.until(lambda message: message["tell"] == "step" and message["k"] == 2)
            me.student.tell_where(fake.lesson, news)
            assert await shown.get() == "showing"

    talk(script)


def test_another_caption_draws_no_scene_anew():
    async def script(me: Talk) -> None:
        me.say(verb="open", query="?lesson=fake", lesson="fake")
        await me.at_rest()
        assert me.scenes
        me.scenes.clear()
        me.say(verb="change", values={"angle": "steep"})
        await me.until(
            lambda message: message["tell"] == "step" and message["step"]["tone"] == "wrong"
        )
        me.say(verb="seek", k=3)
        await me.until(lambda message: message["tell"] == "step" and message["k"] == 3)
        assert [head["k"] for head in me.scenes] == [3]

    talk(script)


def test_what_is_no_wish_is_ignored_and_files_are_not_set():
    async def script(me: Talk) -> None:
        me.say(verb="open", query="?lesson=fake", lesson="fake")
        await me.at_rest()
        for text in ("", "{", "[]", "7", '{"verb": "__init__"}', '{"verb": ["seek"]}', "[" * 5000):
            me.student.hear(text)
        me.say(verb="seek", k="far")
        me.say(verb="run", run="../../etc/passwd")
        me.say(verb="change", values={"scan": "/etc/passwd", "nonsense": 1})
        me.say(verb="predict", question="none", given={"a": 1})
        me.say(verb="seek", k=1)
        step = await me.until(lambda message: message["tell"] == "step" and message["k"] == 1)
        assert step["step"]["caption"]
        assert me.student.session is not None
        assert me.student.session.params == fake.Params()

    talk(script)


def test_after_an_answer_a_preset_has_the_file_of_the_command_line_again(tmp_path):
    np.save(tmp_path / "cloud.npy", np.eye(3))
    mine = fake.Params(scan=tmp_path / "cloud.npy")

    async def script(me: Talk) -> None:
        async def caption(points: str) -> None:
            await me.until(
                lambda told: (
                    told["tell"] == "step" and f" {points} points" in told["step"]["caption"]
                )
            )
            me.told.clear()

        me.student.start = links.Place(fake.lesson, mine)
        me.say(verb="open", query="?lesson=fake", lesson="fake")
        await caption("3")
        for name in ("end", "which", "end"):
            me.say(verb="predict", question=name, given=None)
            await caption("200")
            me.say(verb="change", values={"seed": 3})
            me.say(verb="run", run="", step=1)
            step = await me.until(lambda told: told["tell"] == "step" and told["k"] == 1)
            assert "200 points" in step["step"]["caption"]
            me.told.clear()
            me.say(verb="run", run="short")
            await caption("3")

    talk(script)


def test_the_camera_is_set_when_a_run_with_another_view_is_opened_and_else_left_alone():
    near = View(eye=(0.5, 0.5, 0.5))
    sparse = View(grid=2.0)
    lesson = replace(
        fake.lesson,
        presets=(
            Preset("near", "Near", "", fake.Params(angle=10.0), view=near),
            Preset("sparse", "Sparse", "", fake.Params(angle=20.0), view=sparse),
        ),
    )
    runs: set[int] = set()

    async def script(me: Talk) -> None:
        async def done(**params) -> list[list[float]]:
            """Wait for the run of these params; return where the camera was put since."""
            wanted = fake.Params(**params)
            run = await me.until(
                lambda told: (
                    told["tell"] == "run"
                    and told["run"] not in runs
                    and told["finished"]
                    and told["params"]["angle"] == wanted.angle
                )
            )
            runs.add(run["run"])
            me.told.clear()
            me.say(verb="seek", k=2)
            await me.until(lambda told: told["tell"] == "step" and told["k"] == 2)
            me.told.clear()
            eyes = [head["stage"]["camera"]["eye"] for head in me.scenes if "stage" in head]
            me.scenes.clear()
            return eyes

        me.say(verb="open", query="?lesson=fake", lesson="fake")
        assert await done() == [list(lesson.view.eye)]
        me.say(verb="change", values={"angle": 77})
        assert await done(angle=77.0) == []
        me.say(verb="run", run="near")
        assert await done(angle=10.0) == [list(near.eye)]
        me.say(verb="change", values={"angle": 11})
        assert await done(angle=11.0) == []  # a knob turns no camera
        me.say(verb="reset")
        assert await done() == [list(lesson.view.eye)]
        me.say(verb="run", run="sparse")
        assert await done(angle=20.0) == [list(sparse.eye)]
        me.say(verb="change", values={"angle": 21})
        assert await done(angle=21.0) == [list(lesson.view.eye)]  # the legend tells of another grid
        me.say(verb="predict", question="end", given=None)
        assert await done() == []

    talk(script, lesson)
