"""One person's page on the live server: hears its requests, computes what they need, and tells what
came of them.

Messages are JSON. From the page: {"verb": ..., ...} with the verbs of VERBS. To the page: {"tell":
"run" | "step" | "answer" | "trouble", ...}, and scenes as bytes. A request is only noted; one task
per page computes off the event loop, and the latest request wins.
"""

import asyncio
import contextlib
import math
import traceback
from collections.abc import AsyncIterator, Awaitable, Callable, Mapping
from functools import partial
from typing import Any

import numpy as np

from workbench.authoring.reloading import carried
from workbench.errors import AuthorError, InputError
from workbench.knobs import paths_of, with_own_files
from workbench.lesson import Lesson
from workbench.machinery.authors import Blaming
from workbench.run import links
from workbench.run.picking import picked_params
from workbench.run.questions import answer
from workbench.run.session import Session
from workbench.run.timeline import Timeline
from workbench.viewer.following import Following
from workbench.viewer.own_files import OwnFiles
from workbench.viewer.requests import Requests, read_request
from workbench.viewer.runs import SharedRuns
from workbench.viewer.terminal import tell_terminal
from workbench.viewer.updates import PageUpdates, packed

LARGEST = 1e9
"""Of the numbers of a click, metres."""
AWAITED = 30.0
"""Seconds that a page whose step is being computed keeps its run, however little room there is."""


class PageConnection:
    """What one page sees.

    Args:
        lessons: All lessons that are served, by name.
        runs: What is shared between all pages.
        send: Sends a text to the page, and returns when it may be sent more; says nothing where the
            page has left.
    """

    def __init__(
        self,
        lessons: Mapping[str, Lesson],
        runs: SharedRuns,
        send: Callable[[str | bytes], Awaitable[None]],
    ):
        self.lessons, self.runs, self._send = lessons, runs, send
        self._loop = asyncio.get_running_loop()
        self.start: links.Place | None = None  # where browsers begin; its own files are kept
        self.following: Following | None = None
        self.files = OwnFiles()
        self._news: list[
            Mapping[str, Any]
        ] = []  # what the page is told next, of the files behind its lesson
        self.session: Session | None = None
        self.acted = self._loop.time()  # when something was last wished for
        self.asleep = False  # whether its run was let go to make room
        self._waits = False  # whether what was wished for is still to be shown
        self._wake = asyncio.Event()
        self._updates = PageUpdates(runs)
        self._requests = Requests()

    def hear(self, text: str) -> bool:
        """Note a request, and tell whether it is one; what is none is ignored."""
        request = read_request(text)
        if request is None or request["verb"] not in VERBS:
            return False
        self._request(request)
        return True

    def _request(self, request: Mapping[str, Any]) -> None:
        self._requests.add(request)
        self.acted = self._loop.time()
        self._waits = True
        self._wake.set()

    def leave(self) -> None:
        """Want nothing more: the page has gone."""
        self.runs.scheduler.leave(self)

    def sleep(self) -> bool:
        """Let go of the run, to make room, until something is wished for; tell whether there was
        one. From any thread.
        """
        is_awaited = self._waits and self._loop.time() - self.acted < AWAITED
        if self.asleep or self.session is None or self._requests or is_awaited:
            return False
        self.asleep = True
        self._loop.call_soon_threadsafe(self._sleep)
        return True

    def _sleep(self) -> None:
        self.runs.scheduler.leave(self)
        if self.session is not None:
            self.session.let_go()
        self._updates.forget()

    def close(self) -> None:
        """Remove what is kept for this page alone."""
        self.files.close()

    async def work(self) -> None:
        """Do what is wished for, as long as the page is open."""
        while True:
            await self._wake.wait()
            self._wake.clear()
            try:
                await self._do_what_is_wished()
            except Exception as error:  # a defect of ours: it is told, and the page goes on
                tell_terminal(
                    AuthorError(
                        f"a request could not be fulfilled: {error!r}", traceback.format_exc()
                    )
                )
                await self._tell(
                    tell="trouble",
                    text="Something went wrong; the terminal of the server says what.",
                )

    async def _do_what_is_wished(self) -> None:
        requests = self._requests.take()
        if self.asleep and requests and self.session is not None:
            self.asleep = False
            self.session.take_up()
        for request in requests:
            try:
                await VERBS[request["verb"]](self, request)
            except InputError as error:
                tell_terminal(error)
                await self._tell(tell="trouble", text=str(error))
        news = self._news
        self._news = []
        for told in news:
            await self._tell(**told)
        session = self.session
        if session is None or self.asleep:
            return
        self.runs.scheduler.want(self, session.timeline, session.wanted, tell=self._came)
        only_steps = self._waits and session.timeline is self._updates.timeline
        crew = self.runs.stepping if only_steps else self.runs.showing
        for part in await crew.do(self._show, session, bool(requests)):
            await self._send(part)
        timeline = session.timeline
        self._waits = bool(self._requests) or not (
            timeline.finished or 0 <= session.wanted < len(timeline)
        )

    def _show(self, session: Session, tell: bool) -> list[str | bytes]:
        """Return what the page is to be sent so that it shows what is to be seen now. Not on the
        event loop.
        """
        look = session.look()
        if look is None or session is not self.session:
            return []
        watched = None if self.following is None else self.following.watched
        return self._updates.show(session, look, tell=tell, watched=watched)

    def _came(self) -> None:
        """Look again: steps have come. Called in a thread that computes."""
        self._loop.call_soon_threadsafe(self._wake.set)

    # the verbs ------------------------------------------------------------------------------------

    async def open(self, message: Mapping[str, Any]) -> None:
        """Open what an address names."""
        query, here = str(message.get("query", "")), str(message.get("lesson", ""))
        lesson = self.lessons.get(here)
        trouble, place = None, None
        try:
            place = links.read(query, here=lesson)
        except InputError as error:
            trouble = str(error)
        if place is None and lesson is not None:
            place = links.Place(lesson, lesson.params())
        if place is None:
            return
        params, start = place.params, self.start
        if start is not None and start.lesson is place.lesson:
            params = with_own_files(params, start.params)
        session = self.session or Session(place.lesson, self.runs.timelines)
        session.open(place.lesson, params, place.step)
        session.message, self.session = trouble, session
        self._updates.aim.open(session.lesson, params)
        if self.following is not None:
            self._news += self.following.news(place.lesson)

    async def seek(self, message: Mapping[str, Any]) -> None:
        """Go to a step; a negative one is the last."""
        k = message.get("k")
        if self.session is not None and isinstance(k, int):
            self.session.last() if k < 0 else self.session.seek(k)

    async def run(self, message: Mapping[str, Any]) -> None:
        """Open a preset, or the default, at a step if one is named."""
        session = self.session
        name = str(message.get("run", ""))
        step = message.get("step")
        if session is None:
            return
        question = next(
            (question for question in session.lesson.questions if question.name == name), None
        )
        if name == "default":
            session.reset()
        elif question is not None:
            session.open(session.lesson, question.params, 0)
        elif name:
            session.use_preset(name)
        if name:
            self._updates.aim.open(session.lesson, session.params)
        if step == "stop":
            step = await self._stop(session)
        if isinstance(step, int):
            session.open(session.lesson, session.params, step)

    async def _stop(self, session: Session) -> int:
        """Return the last step of the run itself; what tries other starts behind it is known
        only once it is computed.
        """
        if session.lesson.tries is None:
            return -1
        await self._computed(session.timeline)
        end = self.runs.steps(session.timeline).end()
        return -1 if end is None else end

    async def change(self, message: Mapping[str, Any]) -> None:
        """Set params; files are not set from a browser."""
        values = message.get("values")
        if self.session is not None and isinstance(values, dict):
            private = paths_of(self.session.lesson.params)
            self.session.change(
                **{name: value for name, value in values.items() if name not in private}
            )

    async def reset(self, message: Mapping[str, Any]) -> None:
        """Go back to the default run."""
        if self.session is not None:
            self.session.reset()
            self._updates.aim.open(self.session.lesson, self.session.params)

    async def forget(self, message: Mapping[str, Any]) -> None:
        """Go on without a file of one's own."""
        session = self.session
        name = message.get("field")
        if session is not None and name in paths_of(session.lesson.params):
            session.change(**{str(name): None})

    async def predict(self, message: Mapping[str, Any]) -> None:
        """Compare a prediction with the run that answers, tell the page, and show that run; own
        files are put aside.

        With `stay` the page shows it in its own time, such as a story, which plays it first.
        """
        session = self.session
        if session is None:
            return
        lesson = session.lesson
        question = next(
            (question for question in lesson.questions if question.name == message.get("question")),
            None,
        )
        if question is None:
            return
        await self._computed(self.runs.timelines.get(lesson, question.params))
        try:
            with Blaming(f"lesson {lesson.name}, question {question.name!r}", question.answer):
                compare = partial(answer, timelines=self.runs.timelines)
                given = message.get("given")
                result = await self.runs.asking.do(compare, lesson, question, given)
        except InputError as error:
            tell_terminal(error)
            await self._tell(tell="answer", question=question.name, trouble=str(error))
            return
        told = {
            "right": result.right,
            "truth": result.truth,
            "why": result.why,
            "reply": result.reply,
        }
        await self._tell(tell="answer", question=question.name, **told)
        if message.get("stay"):
            return
        session.open(lesson, question.params, result.step)
        self._updates.aim.open(lesson, question.params)

    async def click(self, message: Mapping[str, Any]) -> None:
        """Set the params that a click in the scene picks: the ray of `p_origin` (3,) and `v_ray`
        (3,), in the world.
        """
        session = self.session
        ray = _ray(message)
        look = None if session is None else session.look()
        if look is not None and session is not None and ray is not None:
            p_origin, v_ray = ray
            pick = partial(picked_params, look.params, look.scene, p_origin, v_ray=v_ray)
            values = await self.runs.stepping.do(pick)
            session.change(**values)

    async def _computed(self, timeline: Timeline) -> None:
        """Wait until a run is computed to its end; it is, in turn with what others wait for."""
        came = asyncio.Event()

        def tell() -> None:
            self._loop.call_soon_threadsafe(came.set)

        while self.runs.scheduler.want(self, timeline, -1, tell=tell):
            await came.wait()
            came.clear()

    # what comes from elsewhere --------------------------------------------------------------------

    async def take_file(self, field: str, name: str, parts: AsyncIterator[bytes]) -> None:
        """Set a field of Params to a person's own file; the folder it is in goes with this page.

        Raises:
            InputError: If the lesson takes no such file, or it cannot be kept.
        """
        session = self.session
        if session is None or field not in paths_of(session.lesson.params):
            raise InputError("this lesson takes no such file")
        path = await self.files.keep(field, name, parts)
        view = session.lesson.view_of(session.params)
        session.change(**{field: path})
        if view != session.lesson.view_of(session.params):  # a stage that shows the file
            self._updates.aim.open(session.lesson, session.params)
        self._wake.set()

    def go_on(self, before: Lesson, after: Lesson, news: Mapping[str, Any] | None) -> None:
        """Go on in another version of a lesson, at the same params and step, where it is open;
        called in another thread.
        """
        self._soon(self._go_on, before, after, news)

    def tell_where(self, lesson: Lesson, news: Mapping[str, Any]) -> None:
        """Tell the page something, where that lesson is open; called in another thread."""
        self._soon(self._tell_where, lesson, news)

    def _soon(self, act: Callable[..., None], *args: Any) -> None:
        with contextlib.suppress(RuntimeError):  # the server has stopped
            self._loop.call_soon_threadsafe(act, *args)

    def _go_on(self, before: Lesson, after: Lesson, news: Mapping[str, Any] | None) -> None:
        session = self.session
        if session is None or session.lesson is not before:
            return
        view = before.view_of(session.params)
        session.go_on(after, carried(session.params, after), carried(session.own, after))
        if view != after.view_of(session.params):
            self._updates.aim.open(after, session.params)
        self._tell_where(after, news or {"tell": "notice", "text": ""})

    def _tell_where(self, lesson: Lesson, news: Mapping[str, Any]) -> None:
        if self.session is not None and self.session.lesson is lesson:
            self._news.append(news)
            self._wake.set()

    async def _tell(self, **message: Any) -> None:
        await self._send(packed(message))


def _ray(message: Mapping[str, Any]) -> tuple[np.ndarray, np.ndarray] | None:
    """Return origin and direction of a click, both (3,); None where a browser sends something
    else.
    """
    vectors = []
    for name in ("p_origin", "v_ray"):
        values = message.get(name)
        is_vector = (
            isinstance(values, list)
            and len(values) == 3
            and all(type(x) in (int, float) for x in values)
        )
        if not is_vector or not all(math.isfinite(x) and abs(x) < LARGEST for x in values):  # type: ignore[union-attr]
            return None
        vectors.append(np.array(values, float))
    return (vectors[0], vectors[1]) if vectors[1].any() else None


VERBS: Mapping[str, Callable[[PageConnection, Mapping[str, Any]], Awaitable[None]]] = {
    "open": PageConnection.open,
    "seek": PageConnection.seek,
    "run": PageConnection.run,
    "change": PageConnection.change,
    "reset": PageConnection.reset,
    "forget": PageConnection.forget,
    "predict": PageConnection.predict,
    "click": PageConnection.click,
}
