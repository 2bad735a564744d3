"""One browser's page: builds it for a lesson, turns what a person does into wishes, and shows what came of them.

Callbacks only record a wish in the session and wake the page's one worker, which computes off the event loop and then
updates the browser in one piece. So no callback ever waits, and the latest wish wins.
"""

import asyncio
import html
import json
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager, nullcontext
from dataclasses import replace
from typing import Any

import numpy as np
import viser

from workbench import links
from workbench.authoring.reloading import carried
from workbench.authors import Blaming
from workbench.errors import AuthorError, InputError
from workbench.exercise.driven import first_difference
from workbench.exercise.finding import exercises_of
from workbench.exercise.watching import Watched
from workbench.knobs import Pick, fields_of
from workbench.lesson import Lesson, Question
from workbench.page.legend import escape
from workbench.picking import picked_params
from workbench.questions import answer as find_answer
from workbench.scene import Caption
from workbench.session import SPEEDS, Look, Session
from workbench.timeline import Timelines
from workbench.viewer.charts import Beside
from workbench.viewer.code_tab import CodeTab
from workbench.viewer.controls import add_commands, listen_for_clicks, on_click
from workbench.viewer.course import add_course
from workbench.viewer.exercise_tab import ExerciseTab
from workbench.viewer.knob_panel import KnobPanel
from workbench.viewer.progress import KEY, Progress
from workbench.viewer.reading import Reading
from workbench.viewer.sink import ViserSink
from workbench.viewer.stage import BACKDROPS, set_stage
from workbench.viewer.terminal import tell_terminal
from workbench.viewer.transport import Transport

SLICE = 0.04  # seconds of computing between two pictures
NARROW = 760  # pixels; below, viser stacks all panels into a sheet at the bottom, which hides three fifths of the scene
SHORT = 820  # pixels; below, the timeline hides a third of it


class Page:
    """What one browser sees.

    Args:
        client: The browser.
        lessons: All lessons that are served, by name, in order.
        timelines: The runs kept for everybody.
        start: Where a browser begins whose address names no lesson; None is the course page.
        watched: A student's file that drives one of the lessons.
    """

    def __init__(
        self,
        client: viser.ClientHandle,
        lessons: Mapping[str, Lesson],
        timelines: Timelines,
        start: links.Place | None = None,
        watched: Watched | None = None,
    ):
        self.client, self.lessons, self.timelines, self._start = client, lessons, timelines, start
        self._watched, self._exercise = watched, None
        self.session: Session | None = None
        self.progress = Progress()
        self.sink = ViserSink(client.scene)
        self._wake = asyncio.Event()
        self._loop = asyncio.get_running_loop()
        width = client.camera.image_width or 1440
        self._narrow = width < NARROW
        short = 0 < client.camera.image_height < SHORT
        self._framing = (1.8, 0.58) if self._narrow else (1.15, 0.1) if short else (1.0, 0.0)
        self._left, self._right = min(max(int(0.26 * width), 300), 380), min(max(int(0.24 * width), 290), 350)
        self._between = min(width - self._left - self._right - 28, 682)
        self._address = ""
        self._sides: list[Callable[[Look], None]] = []
        self._say: Callable[[Look], None] = lambda look: None  # shows the caption
        self._troubles: set[str] = set()  # what was told in a notification
        self._knobs: KnobPanel | None = None
        self._tasks: set[asyncio.Task] = set()
        self._do(self._work())

    def close(self) -> None:
        """Stop everything that runs for this browser."""
        for task in self._tasks:
            task.cancel()

    async def open(self, query: str, kept: str | None) -> None:
        """Show the place that the browser's address names.

        Args:
            query: The address from `?` on; untrusted.
            kept: The progress text this browser kept; untrusted.
        """
        self.progress = Progress(kept)
        self._theme()
        place, trouble = self._start, None
        try:
            place = links.read(query, here=self._start.lesson if self._start else None) or self._start
        except InputError as error:
            trouble = str(error)
        if place is None:
            self.show_course(trouble)
        else:
            self.show_lesson(place, trouble)

    # the two kinds of page ------------------------------------------------------------------------------------------

    def show_course(self, trouble: str | None = None) -> None:
        """Show the course: all lessons, the first one's run behind them."""
        lesson = next(iter(self.lessons.values()))
        self._reset(lesson)
        gui = self.client.gui
        panel = gui.add_panel()
        with panel.add_tab("Course"):
            self._script = gui.add_html("")
            if trouble:
                gui.add_html(f'<div class="wb-caption wrong" role="alert">{escape(trouble)}</div>')
            add_course(gui, self.lessons.values(), self.progress, self._enter)
        if not self._narrow:
            panel.dock_left()
            panel.set_width(460)
            gui.set_panel_label("Choose a lesson")
            gui.main_panel.minimize()
        else:
            panel.expand()
        self._remember("?")
        self._wake.set()

    def show_lesson(self, place: links.Place, trouble: str | None = None) -> None:
        """Build the page of a lesson and go to a place in it."""
        lesson = place.lesson
        self.progress.visit(lesson.name)
        self._keep()
        session = self._reset(lesson)
        session.open(lesson, place.params, place.step)
        session.message = trouble
        gui = self.client.gui
        gui.set_panel_label(lesson.title)
        self._add_text(lesson, session)
        if self._narrow:
            self._add_time(session, nullcontext())
            knobs = self._add_controls(lesson, session)
            side = gui.add_panel()
            charts = Beside(gui, side.add_tab("Curves"))
        else:
            knobs = self._add_controls(lesson, session)
            gui.main_panel.dock_right()
            gui.main_panel.set_width(self._right)
            side = gui.add_panel()
            charts = Beside(gui, side.add_tab("Curves"))
            side.dock_below(gui.main_panel)
            bottom = gui.add_panel()
            self._add_time(session, bottom.add_tab("Timeline"))
            bottom.float(x=14, y=-14, width=self._between)
        self._sides += [lambda look: knobs.show(look.params), charts.show]
        self._add_commands(session)
        self._add_picks(lesson, session)
        self._wake.set()

    def show_report(self) -> None:
        """Show what the checks say of the watched file."""
        if self._exercise is not None:
            self._exercise.show_report()
            self.client.flush()

    def replace_lesson(self, before: Lesson, after: Lesson) -> None:
        """Go on in a lesson whose student's function was loaded again, at the same params and step."""
        session = self.session
        if session is not None and session.lesson is before:
            session.open(after, session.params, session.step)
            self.show_report()
            self._wake.set()

    def rebuild(self, before: Lesson, after: Lesson) -> None:
        """Go on in a lesson that was edited, at the same params and step; where another one is open, nothing happens."""
        session = self.session
        if session is not None and session.lesson is before and self._sides:
            self.show_lesson(links.Place(after, carried(session.params, after), session.step))

    def tell(self, lesson: Lesson, trouble: InputError) -> None:
        """Show what is wrong with a lesson's files in place of the caption, where it is open; its run stays as it was."""
        if self.session is not None and self.session.lesson is lesson and self._sides:
            self.session.message = str(trouble)
            self._wake.set()

    @staticmethod
    def _to_difference(session: Session) -> None:
        at = first_difference(session.timeline.known())
        if at is not None:
            session.seek(at)

    def _reset(self, lesson: Lesson) -> Session:
        self.client.gui.reset()
        self._sides, self._say = [], lambda look: None
        self._troubles.clear()
        self.sink.show({})
        if self._knobs is not None:
            self._knobs.close()
            self._knobs = None
        self.session = session = Session(lesson, self.timelines)
        set_stage(self.client, lesson.view, self._framing)
        return session

    def _add_text(self, lesson: Lesson, session: Session) -> None:
        gui = self.client.gui
        panel = gui.add_panel()

        def predict(question: Question, given: Any) -> None:
            self._do(self._answer(session, reading, question, given))

        with panel.add_tab("Lesson"), self._telling(lesson, "page"):
            reading = Reading(gui, lesson, predict, self.progress.answers(lesson.name))
        with panel.add_tab("Code"):
            code = CodeTab(gui)
        self._exercise, exercises = None, ()
        with self._telling(lesson, "exercises"):
            exercises = exercises_of(lesson)
        if exercises:
            with panel.add_tab("Exercise"), self._telling(lesson, "exercises"):
                mine = self._watched if self._watched is not None and self._watched.lesson is lesson else None
                self._exercise = ExerciseTab(
                    gui, lesson, mine, lambda: self._wish(lambda: self._to_difference(session))
                )
        with panel.add_tab("Course"):
            add_course(gui, self.lessons.values(), self.progress, self._enter, current=lesson)
        if not self._narrow:
            panel.dock_left()
            panel.set_width(self._left)
        self._sides.append(lambda look: code.show(look.moment))

    def _add_time(self, session: Session, container: Any) -> None:
        with container:
            self._script = self.client.gui.add_html("")
        transport = Transport(
            self.client.gui,
            container,
            lambda verb: self._act(session, verb),
            lambda k: self._wish(lambda: session.seek(k)),
        )
        self._say = transport.show
        self._sides.append(lambda look: transport.show(look, first_difference(look.timeline.known())))

    def _add_controls(self, lesson: Lesson, session: Session) -> KnobPanel:
        gui = self.client.gui
        acts: dict[str, Callable[[], None]] = {
            "Pin this run": lambda: self._toggle_pin(session),
            "Reset": lambda: self._wish(session.reset),
            "Copy link": lambda: self._copy_link(session),
            "Download recording": lambda: self._do(self._download(session)),
            "Theme": self._switch_theme,
        }
        first = gui.add_button_group("Run", ("Pin this run", "Reset", "Theme"))
        second = gui.add_button_group("Share", ("Copy link", "Download recording"))
        speed = gui.add_dropdown(
            "Speed", tuple(map(_speed, SPEEDS)), initial_value=_speed(session.speed), hint="How fast Play goes"
        )
        for group in (first, second):
            on_click(group, lambda group=group: acts.get(str(group.value), lambda: self._toggle_pin(session))())

        tabs = gui.add_tab_group()
        with tabs.add_tab("Presets"):
            for preset in lesson.presets:
                button = gui.add_button(preset.title, hint=preset.line)
                gui.add_html(f'<div class="wb-note">{escape(preset.line)}</div>')
                on_click(button, lambda name=preset.name: self._wish(lambda: session.use_preset(name)))
        with tabs.add_tab("Parameters"):
            self._knobs = knobs = KnobPanel(
                self.client, lesson, lambda **values: self._wish(lambda: session.change(**values))
            )

        @speed.on_update
        async def _(event: Any) -> None:
            if event.client is not None:
                wanted = next((s for s in SPEEDS if _speed(s) == event.target.value), None)
                self._wish(lambda: session.set_speed(wanted, self._loop.time()))

        def show(look: Look) -> None:
            names = ("Unpin" if look.pinned else "Pin this run", "Reset", "Theme")
            if tuple(first.options) != names:
                first.options = names

        self._sides.append(show)
        return knobs

    def _add_commands(self, session: Session) -> None:
        gui = self.client.gui
        keys: list[tuple[str, Any, Callable[[], None]]] = [
            ("Next step", "N", lambda: self._act(session, "next")),
            ("Previous step", "P", lambda: self._act(session, "back")),
            ("Play or pause", "K", lambda: self._act(session, "play")),
            ("First step", "home", lambda: self._act(session, "first")),
            ("Last step", "end", lambda: self._act(session, "last")),
            ("Reset the lesson", "R", lambda: self._wish(session.reset)),
            ("Pin or unpin this run", "I", lambda: self._toggle_pin(session)),
            ("Copy a link to this step", "C", lambda: self._copy_link(session)),
            ("Download a recording", None, lambda: self._do(self._download(session))),
            ("Light or dark theme", "T", self._switch_theme),
            ("All lessons", None, self.show_course),
        ]
        for number, preset in enumerate(session.lesson.presets, 1):
            key = str(number) if number <= 9 else None
            keys.append(
                (f"Preset: {preset.title}", key, lambda p=preset: self._wish(lambda: session.use_preset(p.name)))
            )
        add_commands(gui, keys)

    def _add_picks(self, lesson: Lesson, session: Session) -> None:
        def clicked(p_origin: np.ndarray, v_ray: np.ndarray) -> None:
            look = session.look()
            values = {} if look is None else picked_params(session.params, look.scene, p_origin, v_ray)
            if values:
                self._wish(lambda: session.change(**values))

        can_be_picked = any(isinstance(field.knob.by, Pick) for field in fields_of(lesson.params))
        listen_for_clicks(self.client.scene, clicked if can_be_picked else None)

    # wishes ---------------------------------------------------------------------------------------------------------

    def _wish(self, verb: Callable[[], None]) -> None:
        if self.session is not None:
            try:
                with Blaming(f"lesson {self.session.lesson.name}", self.session.lesson.run):
                    verb()
            except InputError as error:
                self._trouble("That cannot be done", error)
        self._wake.set()

    def _act(self, session: Session, verb: str) -> None:
        if verb in ("play", "pause"):
            session.pause() if session.playing else session.play(self._loop.time())
        elif verb == "next":
            session.pause()
            session.forward()
        elif verb in ("first", "back", "last"):
            {"first": session.first, "back": session.back, "last": session.last}[verb]()
        self._wake.set()

    def _toggle_pin(self, session: Session) -> None:
        self._wish(session.unpin if session.pinned else session.pin)

    def _enter(self, lesson: Lesson) -> None:
        self.show_lesson(links.Place(lesson, lesson.params()))

    def _switch_theme(self) -> None:
        self.progress.dark = not self.progress.dark
        self._keep()
        self._theme()

    async def _answer(self, session: Session, reading: Reading, question: Question, given: Any) -> None:
        reading.say(question, "Running it …")
        try:
            with Blaming(f"lesson {session.lesson.name}, question {question.name!r}", question.answer):
                answer = await asyncio.to_thread(find_answer, session.lesson, question, given, session.timelines)
        except InputError as error:
            tell_terminal(error)
            reading.say(question, str(error))
            return
        if given is not None:
            self.progress.answer(session.lesson.name, question.name, given)
            self._keep()
        reading.show(question, given, answer)
        session.open(session.lesson, question.params, answer.step)
        self._wake.set()

    async def _download(self, session: Session) -> None:
        from workbench.recording import file_name, record_bytes

        note = self.client.add_notification("Recording", "Writing the run …", loading=True, with_close_button=False)
        timeline = session.timeline
        try:
            preset = timeline.lesson.preset_of(timeline.params)
            name = None if preset is None else preset.name
            with Blaming(f"lesson {session.lesson.name}, recording", session.lesson.draw):
                data = await asyncio.to_thread(lambda: record_bytes(timeline.complete(), preset=name))
            self.client.send_file_download(file_name(timeline.lesson, name), data, save_immediately=True)
        except InputError as error:
            tell_terminal(error)
            session.message = str(error)
            self._wake.set()
        finally:
            note.remove()

    def _copy_link(self, session: Session) -> None:
        query = self._query(session)
        self._run_script(
            f"const a = location.origin + location.pathname + {json.dumps(query)};"
            "navigator.clipboard && navigator.clipboard.writeText(a)"
        )
        self.client.add_notification("Link to this step copied", query, auto_close_seconds=4.0)

    # the worker -----------------------------------------------------------------------------------------------------

    async def _work(self) -> None:
        while True:
            await self._wake.wait()
            self._wake.clear()
            session = self.session
            if session is None:
                continue
            try:
                if session.pending:
                    await asyncio.to_thread(session.compute, SLICE)
                due = session.tick(self._loop.time())
                with Blaming(f"lesson {session.lesson.name}", session.lesson.draw):
                    self._show(session)
            except Exception as error:  # the page must outlive whatever a lesson does
                due = None
                session.pause()
                self._trouble("This step cannot be shown", error)
            if session.pending:
                self._wake.set()
            elif due is not None:
                self._loop.call_at(due, self._wake.set)

    def _show(self, session: Session) -> None:
        look = session.look()
        if look is None or session is not self.session:
            return
        if look.timeline.failure is not None:
            tell_terminal(AuthorError(look.timeline.stopped or "", look.timeline.failure))
        with self.client.atomic():
            wrong = [error for show in (self._show_scene, *self._sides) if (error := _failing(show, look)) is not None]
            if wrong:
                self._say(replace(look, caption=Caption(str(wrong[0]), "wrong")))
        for error in wrong:
            self._trouble("This step cannot be shown", error)
        if self._sides and not look.playing and look.finished:
            self._remember(self._query(session))
        self.client.flush()

    def _show_scene(self, look: Look) -> None:
        self.sink.show(look.scene)

    @contextmanager
    def _telling(self, lesson: Lesson, what: str, function: object = None) -> Iterator[None]:
        """Tell in the open container and in the terminal what goes wrong in the block; the page goes on."""
        try:
            with Blaming(f"lesson {lesson.name}, {what}", function or lesson.run):
                yield
        except InputError as error:
            self.client.gui.add_html(f'<div class="wb-caption wrong" role="alert">{escape(str(error))}</div>')
            tell_terminal(error)

    def _trouble(self, title: str, error: Exception) -> None:
        """Tell an error, each once: in a notification, and in the terminal with its traceback."""
        tell_terminal(error)
        if self._sides and str(error) not in self._troubles:
            self._troubles.add(str(error))
            self.client.add_notification(title, str(error), color="red")

    # what the browser keeps -----------------------------------------------------------------------------------------

    def _query(self, session: Session) -> str:
        return links.write(links.Place(session.lesson, session.params, session.step))

    def _remember(self, query: str) -> None:
        """Keep the browser's address equal to the place, so that a reload comes back to it."""
        if query != self._address:
            self._address = query
            self._run_script(f"history.replaceState(null, '', {json.dumps(query)})")

    def _run_script(self, script: str) -> None:
        self._script.content = f'<img src="data:,x" alt="" hidden onerror="{html.escape(script)}">'

    def _keep(self) -> None:
        self.client.local_storage.set_item(KEY, self.progress.text())

    def _theme(self) -> None:
        self.client.gui.configure_theme(show_logo=False, show_share_button=False, dark_mode=self.progress.dark)
        self.sink.repaint(BACKDROPS[self.progress.dark])

    def _do(self, work: Any) -> None:
        task = self._loop.create_task(work)
        self._tasks.add(task)
        task.add_done_callback(self._tasks.discard)


def _failing(show: Callable[[Look], None], look: Look) -> InputError | None:
    """Show a part of the page; return what went wrong, with the place in the lesson where it can be found."""
    try:
        with Blaming(f"lesson {look.lesson.name}", look.lesson.draw):
            show(look)
    except InputError as error:
        return error
    return None


def _speed(steps_per_second: float) -> str:
    return "1 step a second" if steps_per_second == 1 else f"{steps_per_second:g} steps a second"
