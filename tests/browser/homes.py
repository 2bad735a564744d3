"""The three homes of a lesson's page, each opened in a real browser: live, on a site, and in a
notebook's HTML.
"""

import re
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any
from unittest.mock import patch

from axe_playwright_python.sync_playwright import Axe

from tests.browser.chrome import WAIT
from tests.browser.visits import SELDOM
from workbench.lesson import Lesson, Question, Sweep
from workbench.notebook import Replay
from workbench.publish.site import publish
from workbench.run.timeline import Timeline
from workbench.story import ASKED, has_story
from workbench.viewer.server import Server

WIDTH, HEIGHT = 1280, 720
NO_PICTURE = b"<svg xmlns='http://www.w3.org/2000/svg'/>"
PHONE = {"width": 390, "height": 844, "deviceScaleFactor": 3, "mobile": True}
BARRIERS = """async (options) => {
  const { violations } = await axe.run({ exclude: [["math"]] }, options);
  const serious = violations.filter((one) => ["serious", "critical"].includes(one.impact));
  return serious.map((one) => `${one.id}: ${one.nodes[0].html.slice(0, 120)}`);
}"""
LINKED = re.compile(r"\[([^\]]*)\]\(run:([^)@]*)(@-?\d+)?\)")


@dataclass
class Home:
    """A lesson's page, open.

    Attributes:
        kind: `live`, `site` or `notebook`.
        lesson: As it is there: a site has some of its presets.
        page: The browser's.
        frame: The document with the lesson's page.
        server: What feeds it, where it is live.
        errors: What went wrong in the console, and addresses elsewhere that were asked for.
    """

    kind: str
    lesson: Lesson
    page: Any
    frame: Any
    server: Server
    errors: list[str]

    def find(self, selector: str, **options: Any) -> Any:
        """Return what the lesson's page has under a selector."""
        return self.frame.locator(selector, **options)

    def ask(self, expression: str, argument: Any = None) -> Any:
        """Return what the lesson's page says."""
        return self.frame.evaluate(expression, argument)

    def until(self, expression: str, argument: Any = None) -> None:
        """Wait until something holds of the lesson's page."""
        self.frame.wait_for_function(expression, arg=argument)

    def comes_true(self, holds: Callable[[], Any]) -> None:
        """Wait until something holds of the server."""
        for _ in range(WAIT // 50):
            if holds():
                return
            self.page.wait_for_timeout(50)
        raise AssertionError("it never came true")

    def press(self, key: str) -> None:
        """Press a key wherever the focus is."""
        self.page.keyboard.press(key)

    def says(self, caption: str, k: int | None = None) -> None:
        """Wait until a caption is told, at a step if one is named."""
        self.until(
            "([text, k]) => $('#caption').textContent === text && (k === null || page.k === k)",
            [caption, k],
        )

    def shown_as(self, **options: Any) -> None:
        """Take another window: width, height, deviceScaleFactor, mobile."""
        session = self.page.context.new_cdp_session(self.page)
        session.send("Emulation.setDeviceMetricsOverride", options)
        self.until(
            "width => innerWidth === width" if self.kind != "notebook" else "() => true",
            options["width"],
        )


def barriers(frame: Any, *rules: str) -> list[str]:
    """Return what axe calls serious in a document: the rule, and the first place that breaks it; of
    some rules, if named.
    """
    frame.evaluate(Axe().axe_script)
    options = {"iframes": False, "preload": False, "resultTypes": ["violations"]}
    return frame.evaluate(BARRIERS, options | ({"runOnly": rules} if rules else {}))


class Browser:
    """One browser for all visits, so that what lessons share is loaded once; somebody who wants no
    motion sits before it.
    """

    def __init__(self, chromium: Any, server: Server):
        self._context = chromium.new_context(
            viewport={"width": WIDTH, "height": HEIGHT}, reduced_motion="reduce"
        )
        self._server = server

    @contextmanager
    def opened(self, kind: str, lesson: Lesson, folder: Path) -> Iterator[Home]:
        """Open a lesson in one of its homes, as if for the first time; its window closes at the
        end.
        """
        lesson, address = HOMES[kind](lesson, self._server, folder)
        page = self._context.new_page()
        errors = []
        page.add_init_script(SELDOM)
        if kind == "notebook":  # what it draws is looked at in JupyterLab
            page.add_init_script("secondsBetweenPictures = 3600")
        ours = ("file:", "data:", "blob:", "about:", self._server.address)
        page.on("pageerror", lambda error: errors.append(str(error)))
        page.on(
            "console",
            lambda message: errors.append(message.text) if message.type == "error" else None,
        )
        page.on(
            "request",
            lambda request: (
                None if request.url.startswith(ours) else errors.append(request.url[:200])
            ),
        )
        try:
            page.goto(address)
            if kind == "notebook":
                page.locator("iframe").wait_for()
            frame = page.main_frame.child_frames[0] if kind == "notebook" else page.main_frame
            frame.wait_for_function("page.run && page.run.finished && page.step() !== undefined")
            yield Home(kind, lesson, page, frame, self._server, errors)
            frame.evaluate("localStorage.clear()")
        finally:
            page.close()

    def close(self) -> None:
        """Close it."""
        self._context.close()


def _live(lesson: Lesson, server: Server, folder: Path) -> tuple[Lesson, str]:
    bench = f"&step={lesson.first_step}" if has_story(lesson) else ""
    return lesson, f"{server.address}/?lesson={lesson.name}{bench}"


def _site(lesson: Lesson, server: Server, folder: Path) -> tuple[Lesson, str]:
    kept = few(lesson, folder)

    def known(_: Lesson, params: Any) -> Timeline:
        return server.runs.timelines.get(lesson, params)

    with (
        patch("workbench.publish.runs.record_bytes", lambda *_, **__: b"no page here reads it"),
        patch("workbench.publish.runs.still_svg", lambda *_, **__: NO_PICTURE),
        patch("workbench.publish.runs.Timeline", known),
        patch("workbench.publish.site.Timelines", lambda: SimpleNamespace(get=known)),
    ):
        publish(folder / "site", [kept])
    return kept, (folder / "site" / kept.name / "index.html").as_uri()


def _notebook(lesson: Lesson, server: Server, folder: Path) -> tuple[Lesson, str]:
    file = folder / "saved.html"
    with patch("workbench.notebook.Timeline", server.runs.timelines.get):
        html = Replay(lesson, lesson.params(), None, height=HEIGHT - 20)._repr_html_()
    head = (
        "<meta charset=utf-8><meta name=viewport content='width=device-width'><title>Saved</title>"
    )
    file.write_text(f"<!doctype html>{head}<body style='margin:0'>{html}")
    return lesson, file.as_uri()


HOMES: dict[str, Callable[[Lesson, Server, Path], tuple[Lesson, str]]] = {
    "live": _live,
    "site": _site,
    "notebook": _notebook,
}


def few(lesson: Lesson, folder: Path) -> Lesson:
    """Return a lesson with the runs that a visit needs: one preset, one question, two values of a
    sweep.
    """
    first = linked(lesson) or next((preset.name for preset in lesson.presets), None)
    kept = {"default", "this", "", first}
    page = folder / "page.md"
    text = LINKED.sub(lambda match: match[0] if match[2] in kept else match[1], lesson.text())
    if has_story(lesson):  # whose scenes name runs that are left out here: its workbench alone
        text = f"# {lesson.title}\n\n{lesson.summary} [Look](run:{first or 'default'}).\n"
    question = asked(lesson).name if lesson.questions else ""
    page.write_text(ASKED.sub(lambda match: match[0] if match[1] == question else "", text))
    sweeps = ()
    if lesson.sweeps:
        sweep = lesson.sweeps[0]
        usual = getattr(lesson.params(), sweep.knob)
        other = next(value for value in sweep.values if value != usual)
        sweeps = (
            Sweep(sweep.knob, tuple(value for value in sweep.values if value in (usual, other))),
        )
    presets = tuple(preset for preset in lesson.presets if preset.name == first)
    questions = (asked(lesson),) if lesson.questions else ()
    return replace(lesson, presets=presets, questions=questions, sweeps=sweeps, page=page)


def asked(lesson: Lesson) -> Question:
    """Return the question that needs the fewest runs besides the default and the preset that is
    linked.
    """
    kept = [
        lesson.params(),
        *(preset.params for preset in lesson.presets if preset.name == linked(lesson)),
    ]
    return min(lesson.questions, key=lambda question: question.params not in kept)


def linked(lesson: Lesson) -> str | None:
    """Return the preset that a lesson's article runs first."""
    if has_story(lesson):  # its links move the stage of the story
        return None
    names = {preset.name for preset in lesson.presets}
    return next((match[2] for match in LINKED.finditer(lesson.text()) if match[2] in names), None)


def own_end(run: Timeline) -> int:
    """Return the last step of a run itself; tries of other starts may follow it."""
    tries = run.lesson.tries
    return next(
        (k - 1 for k, step in enumerate(run.known()) if tries is not None and tries(step.state)),
        len(run) - 1,
    )
