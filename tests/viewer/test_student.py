"""A page's wishes on the live server, without a browser: what comes from another thread wakes a page that is at rest."""

import asyncio
import json
import threading
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace

from tests import fake
from workbench.lesson import View
from workbench.timeline import Timeline, Timelines
from workbench.viewer import student
from workbench.viewer.student import Student


class Talk:
    """A student at work, and what the page was told."""

    def __init__(self) -> None:
        self.told: list[dict] = []
        self._heard = asyncio.Event()
        self.student = Student({"fake": fake.lesson}, Timelines(), self._hear)
        self._work = asyncio.create_task(self.student.work())

    async def _hear(self, text: str) -> None:
        self.told.append(json.loads(text))
        self._heard.set()

    def say(self, **message) -> None:
        self.student.hear(json.dumps(message))

    async def until(self, what) -> dict:
        """Wait for the first message that is wanted."""
        async with asyncio.timeout(60):  # nothing else wakes the loop
            while not (found := [message for message in self.told if what(message)]):
                assert not self._work.done(), self._work
                self._heard.clear()
                await self._heard.wait()
        return found[0]

    async def at_rest(self) -> None:
        await self.until(lambda message: message["tell"] == "run" and message["finished"])
        await asyncio.sleep(0)
        self.told.clear()


def talk(script) -> None:
    """Run the script in a thread of its own: a browser test before may have left its loop running in this one."""

    async def run() -> None:
        await script(Talk())

    with ThreadPoolExecutor(1) as threads:
        threads.submit(lambda: asyncio.run(run())).result()


def test_steps_are_those_of_the_timeline():
    here = Timeline(fake.lesson, fake.Params()).complete()

    async def script(me: Talk) -> None:
        me.say(verb="open", query="?lesson=fake", lesson="fake")
        await me.at_rest()
        for k in (2, 1, 3):
            me.say(verb="seek", k=k)
            step = await me.until(lambda message, k=k: message["tell"] == "step" and message["k"] == k)
            assert step["step"]["caption"] == here[k].caption.text

    talk(script)


def test_a_wish_of_another_thread_wakes_a_page_at_rest():
    there = Timeline(fake.lesson, fake.Params(angle=33.0)).complete()

    async def script(me: Talk) -> None:
        me.say(verb="open", query="?lesson=fake", lesson="fake")
        await me.at_rest()
        threading.Timer(0.2, lambda: me.student._moved(angle=33.0)).start()  # when the loop sleeps
        run = await me.until(lambda message: message["tell"] == "run" and message["params"]["angle"] == 33.0)
        assert run["known"] <= len(there)

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


def test_the_camera_goes_where_a_preset_wants_it_and_a_knob_leaves_it_there(monkeypatch):
    seen: list[View] = []
    monkeypatch.setattr(student, "set_stage", lambda client, view: seen.append(view))
    monkeypatch.setattr(student, "listen_for_clicks", lambda scene, heard: None)
    own = View(eye=(0.0, -3.0, 0.0), grid=None)
    first, *others = fake.lesson.presets
    lesson = replace(fake.lesson, presets=(replace(first, view=own), *others))

    class Blank:
        scene = None

        def show(self, scene) -> None: ...

        def repaint(self, backdrop) -> None: ...

    async def script(me: Talk) -> None:
        one = me.student
        one._client, one._sink = Blank(), Blank()  # type: ignore[assignment]
        for params in (lesson.params(), first.params, replace(first.params, angle=33.0), first.params, lesson.params()):
            one._set_up(lesson, params)

    talk(script)
    assert seen == [lesson.view, own, lesson.view]
