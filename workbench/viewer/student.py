"""One person's page on the live server: hears its wishes, computes what they need, and tells what came of them.

Messages are JSON. From the page: {"verb": ..., ...} with the verbs of VERBS. To the page: {"tell": "run" | "step" |
"answer" | "trouble", ...}. A wish is only noted; one task per page computes off the event loop, and the latest wish wins.
"""

import asyncio
import contextlib
import json
import traceback
from collections.abc import AsyncIterator, Awaitable, Callable, Mapping
from typing import Any

import numpy as np
import viser

from workbench import links
from workbench.authoring.reloading import carried
from workbench.authors import Blaming
from workbench.errors import AuthorError, InputError
from workbench.exercise.driven import Pair, first_difference
from workbench.flags import show_command
from workbench.knobs import Pick, fields_of, with_own_files
from workbench.lesson import Lesson
from workbench.page.charts import series_of
from workbench.page.lessons import files_of, values_of
from workbench.page.steps import Steps
from workbench.picking import picked_params
from workbench.questions import answer
from workbench.session import Look, Session
from workbench.timeline import Timelines
from workbench.viewer.following import Following
from workbench.viewer.handles import Handles, listen_for_clicks
from workbench.viewer.own_files import OwnFiles
from workbench.viewer.sink import ViserSink
from workbench.viewer.stage import BACKDROPS, Aim
from workbench.viewer.terminal import tell_terminal

SLICE = 0.04  # seconds of computing between two pictures


class Student:
    """What one page sees.

    Args:
        lessons: All lessons that are served, by name.
        timelines: The runs kept for everybody.
        send: Sends a text to the page; says nothing where the page has left.
    """

    def __init__(self, lessons: Mapping[str, Lesson], timelines: Timelines, send: Callable[[str], Awaitable[None]]):
        self.lessons, self.timelines, self._send = lessons, timelines, send
        self._loop = asyncio.get_running_loop()
        self.start: links.Place | None = None  # where browsers begin; its own files are kept
        self.following: Following | None = None
        self.files = OwnFiles()
        self._news: list[Mapping[str, Any]] = []  # what the page is told next, of the files behind its lesson
        self.session: Session | None = None
        self._wake = asyncio.Event()
        self._client: viser.ClientHandle | None = None
        self._sink: ViserSink | None = None
        self._staged: Lesson | None = None
        self._aim = Aim()
        self._steps: Steps | None = None
        self._sent: set[int] = set()  # numbers of things of this run that the page has
        self._told: Any = None  # what was last said of the run
        self._run = 0
        self._waiting: list[dict[str, Any]] = []
        self._dark = False
        self._handles: Handles | None = None
        self._wants_handles = False

    def join(self, client: viser.ClientHandle) -> None:
        """Take the scene of this page, which has come up; may be called in viser's thread."""
        self._loop.call_soon_threadsafe(self._join, client)

    def _join(self, client: viser.ClientHandle) -> None:
        self._client, self._sink, self._staged, self._handles = client, ViserSink(client.scene), None, None
        self._aim.lost()
        client.gui.configure_theme(show_logo=False, show_share_button=False, dark_mode=self._dark)
        self._told = None
        self._wake.set()

    def hear(self, text: str) -> None:
        """Note a wish; what is none is ignored."""
        try:
            message = json.loads(text)
        except (ValueError, RecursionError):
            return
        if isinstance(message, dict) and isinstance(message.get("verb"), str) and message["verb"] in VERBS:
            self._waiting.append(message)
            del self._waiting[:-200]
            self._wake.set()

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
                tell_terminal(AuthorError(f"a wish could not be fulfilled: {error!r}", traceback.format_exc()))
                await self._tell(tell="trouble", text="Something went wrong; the terminal of the server says what.")

    async def _do_what_is_wished(self) -> None:
        waiting, self._waiting = self._waiting, []
        for message in waiting:
            try:
                await VERBS[message["verb"]](self, message)
            except InputError as error:
                tell_terminal(error)
                await self._tell(tell="trouble", text=str(error))
        news, self._news = self._news, []
        for told in news:
            await self._tell(**told)
        session = self.session
        if session is None:
            return
        if session.pending:
            await asyncio.to_thread(session.compute, SLICE)
        await self._show(session)
        if session.pending:
            self._wake.set()

    # the verbs ------------------------------------------------------------------------------------------------------

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
        session = self.session or Session(place.lesson, self.timelines)
        session.open(place.lesson, params, place.step)
        session.message, self.session = trouble, session
        self._aim.open(session.lesson, params)
        if self.following is not None:
            self._news += self.following.news(place.lesson)

    async def seek(self, message: Mapping[str, Any]) -> None:
        """Go to a step; negative counts from the end."""
        k = message.get("k")
        if self.session is not None and isinstance(k, int):
            self.session.last() if k < 0 else self.session.seek(k)

    async def run(self, message: Mapping[str, Any]) -> None:
        """Open a preset, or the default, at a step if one is named."""
        session, name, step = self.session, str(message.get("run", "")), message.get("step")
        if session is None:
            return
        if name == "default":
            session.reset()
        elif name:
            session.use_preset(name)
        if isinstance(step, int):
            session.open(session.lesson, session.params, step)
        self._aim.open(session.lesson, session.params)

    async def change(self, message: Mapping[str, Any]) -> None:
        """Set params; files are not set from a browser."""
        values = message.get("values")
        if self.session is not None and isinstance(values, dict):
            private = {field.name for field in fields_of(self.session.lesson.params) if field.sensitive}
            self.session.change(**{name: value for name, value in values.items() if name not in private})

    async def reset(self, message: Mapping[str, Any]) -> None:
        """Go back to the default run."""
        if self.session is not None:
            self.session.reset()
            self._aim.open(self.session.lesson, self.session.params)

    async def forget(self, message: Mapping[str, Any]) -> None:
        """Go on without a file of one's own."""
        session, name = self.session, message.get("field")
        if session is not None and name in {
            field.name for field in fields_of(session.lesson.params) if field.sensitive
        }:
            session.change(**{str(name): None})

    async def pin(self, message: Mapping[str, Any]) -> None:
        """Keep the run that is shown behind the next ones, or let it go."""
        if self.session is not None:
            self.session.unpin() if self.session.pinned else self.session.pin()

    async def predict(self, message: Mapping[str, Any]) -> None:
        """Compare a prediction with the run that answers, tell the page, and show that run."""
        session = self.session
        if session is None:
            return
        lesson = session.lesson
        question = next((one for one in lesson.questions if one.name == message.get("question")), None)
        if question is None:
            return
        try:
            with Blaming(f"lesson {lesson.name}, question {question.name!r}", question.answer):
                found = await asyncio.to_thread(answer, lesson, question, message.get("given"), self.timelines)
        except InputError as error:
            tell_terminal(error)
            await self._tell(tell="answer", question=question.name, trouble=str(error))
            return
        await self._tell(tell="answer", question=question.name, right=found.right, truth=found.truth, why=found.why)
        session.open(lesson, question.params, found.step)
        self._aim.open(lesson, question.params)

    async def handles(self, message: Mapping[str, Any]) -> None:
        """Show the handles in the scene, or hide them."""
        self._wants_handles = message.get("on") is True
        if self._handles is not None and not self._wants_handles:
            self._handles.close()
            self._handles = None

    async def theme(self, message: Mapping[str, Any]) -> None:
        """Draw the scene for a dark or a light page."""
        self._dark = message.get("dark") is True
        if self._client is not None and self._sink is not None:
            self._client.gui.configure_theme(show_logo=False, show_share_button=False, dark_mode=self._dark)
            self._sink.repaint(BACKDROPS[self._dark])

    # what comes from elsewhere ---------------------------------------------------------------------------------------

    async def take_file(self, field: str, name: str, parts: AsyncIterator[bytes]) -> None:
        """Set a field of Params to a person's own file; the folder it is in goes with this page.

        Raises:
            InputError: If the lesson takes no such file, or it cannot be kept.
        """
        session = self.session
        if session is None or field not in {one.name for one in fields_of(session.lesson.params) if one.sensitive}:
            raise InputError("this lesson takes no such file")
        path = await self.files.keep(field, name, parts)
        self._change({field: path})

    def go_on(self, before: Lesson, after: Lesson, news: Mapping[str, Any] | None) -> None:
        """Go on in another version of a lesson, at the same params and step, where it is open; called in another thread."""
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
        session.go_on(after, carried(session.params, after))
        if view != after.view_of(session.params):
            self._aim.open(after, session.params)
        self._tell_where(after, news or {"tell": "notice", "text": ""})

    def _tell_where(self, lesson: Lesson, news: Mapping[str, Any]) -> None:
        if self.session is not None and self.session.lesson is lesson:
            self._news.append(news)
            self._wake.set()

    # telling --------------------------------------------------------------------------------------------------------

    async def _show(self, session: Session) -> None:
        look = session.look()
        if look is None or session is not self.session:
            return
        if look.timeline.failure is not None:
            tell_terminal(AuthorError(look.timeline.stopped or "", look.timeline.failure))
        trouble = self._draw(look)
        if self._steps is None or self._steps.timeline is not look.timeline:
            self._steps, self._sent, self._run = Steps(look.timeline), set(), self._run + 1
        now = (self._run, look.known, look.finished, look.pinned, look.params, session.message)
        if now != self._told:
            self._told = now
            await self._tell(**await asyncio.to_thread(self._run_told, look))
        if look.known:
            await self._tell(**await asyncio.to_thread(self._step_told, look, trouble))
        elif trouble is None and look.caption.text:
            await self._tell(tell="trouble", text=look.caption.text)

    def _run_told(self, look: Look) -> dict[str, Any]:
        assert self._steps is not None
        params, lesson = look.params, look.lesson
        preset = "default" if params == lesson.params() else getattr(lesson.preset_of(params), "name", "")
        return {
            "tell": "run",
            "run": self._run,
            "name": preset,
            "params": values_of(params),
            "known": look.known,
            "finished": look.finished,
            "pinned": series_of(look.pinned_series) if look.pinned else None,
            "mark": first_difference(look.timeline.known()),
            "files": files_of(params),
            "command": show_command(lesson, params),
            "query": links.write(links.Place(lesson, params)),
            **self._steps.series(),
        }

    def _step_told(self, look: Look, trouble: str | None) -> dict[str, Any]:
        assert self._steps is not None
        step = dict(self._steps.step(look.k))
        if look.caption.text != step["caption"] or trouble:
            step |= {"caption": trouble or look.caption.text, "tone": "wrong" if trouble else look.caption.tone}
        wanted = [*step["shown"], step["legend"]]
        code = self._steps.code(look.k)
        if code is not None:
            state = look.timeline[look.k].state
            step["code"] = code | ({"wrong": state.line} if isinstance(state, Pair) and state.line else {})
            wanted.append(code["source"])
        new = {n: self._steps.things[n] for n in wanted if n not in self._sent}
        self._sent |= set(new)
        return {"tell": "step", "run": self._run, "k": look.k, "step": step, "things": new}

    def _draw(self, look: Look) -> str | None:
        """Make the scene equal to what is looked at; return what went wrong."""
        if self._client is None or self._sink is None:
            return None
        try:
            with Blaming(f"lesson {look.lesson.name}", look.lesson.draw), self._client.atomic():
                if self._staged is not look.lesson:
                    self._set_up(look.lesson)
                if self.session is not None and look.timeline is self.session.timeline:  # else it is of the run before
                    self._aim.show(self._client, look.lesson, look.timeline.params)
                self._sink.show(look.scene)
                if self._wants_handles and self._handles is None:
                    self._handles = Handles(self._client.scene, look.lesson.params, self._moved)
                if self._handles is not None:
                    self._handles.show(look.params)
        except InputError as error:
            tell_terminal(error)
            return str(error)
        finally:
            self._client.flush()
        return None

    def _set_up(self, lesson: Lesson) -> None:
        """Make the stage a lesson's: its handles, and clicks that set its params."""
        assert self._client is not None
        assert self._sink is not None
        if self._staged is None:
            self._sink.repaint(BACKDROPS[self._dark])
        if self._handles is not None:
            self._handles.close()
            self._handles = None
        can_be_picked = any(isinstance(field.knob.by, Pick) for field in fields_of(lesson.params))
        listen_for_clicks(self._client.scene, self._clicks if can_be_picked else None)
        self._staged = lesson

    def _clicks(self, p_origin: np.ndarray, v_ray: np.ndarray) -> None:
        """Note a click in the scene; called in viser's thread."""
        self._loop.call_soon_threadsafe(self._clicked, p_origin, v_ray)

    def _moved(self, **values: Any) -> None:
        """Note that a handle was moved; called in viser's thread."""
        self._loop.call_soon_threadsafe(self._change, values)

    def _clicked(self, p_origin: np.ndarray, v_ray: np.ndarray) -> None:
        look = None if self.session is None else self.session.look()
        values = {} if look is None else picked_params(look.params, look.scene, p_origin, v_ray)
        if values:
            self._change(values)

    def _change(self, values: Mapping[str, Any]) -> None:
        if self.session is not None:
            self.session.change(**values)
            self._wake.set()

    async def _tell(self, **message: Any) -> None:
        await self._send(json.dumps(message, ensure_ascii=False, separators=(",", ":")))


VERBS: Mapping[str, Callable[[Student, Mapping[str, Any]], Awaitable[None]]] = {
    "open": Student.open,
    "seek": Student.seek,
    "run": Student.run,
    "change": Student.change,
    "reset": Student.reset,
    "forget": Student.forget,
    "pin": Student.pin,
    "predict": Student.predict,
    "handles": Student.handles,
    "theme": Student.theme,
}
