"""What one page is told of the run it looks at, and sent of its scenes: only what it has not
got.
"""

import json
from collections.abc import Mapping
from typing import Any

from workbench.errors import AuthorError, InputError
from workbench.exercise.driven import StepPair, calls_it, first_difference
from workbench.exercise.watching import WatchedFile
from workbench.lesson import Lesson, View
from workbench.machinery.authors import Blaming
from workbench.page.lessons import files_of
from workbench.page.updates import RunUpdates
from workbench.run.session import Session, Shown
from workbench.run.timeline import Timeline
from workbench.viewer.runs import SharedRuns
from workbench.viewer.terminal import tell_terminal
from workbench.wire.packing import PageWire
from workbench.wire.stage import Aim


class PageUpdates:
    """What a page has been told, and what is new to it.

    Args:
        runs: What is shared between all pages.

    Attributes:
        timeline: The run that the page was told of last; None where it is to be told all.
        aim: Where the page's camera is put.
    """

    def __init__(self, runs: SharedRuns):
        self._runs = runs
        self._wire = PageWire(runs.maker)
        self.aim = Aim()
        self.timeline: Timeline | None = None
        self._updates: RunUpdates | None = None  # of that run
        self._run = 0
        self._seen: Any = None  # what the page was shown last
        self._drawn: Any = None  # of which its scene is
        self._view: tuple[Lesson, View] | None = None  # on which stage

    def forget(self) -> None:
        """Hold no run any more."""
        self.timeline = self._updates = self._seen = self._drawn = None

    def show(
        self, session: Session, look: Shown, *, tell: bool, watched: WatchedFile | None
    ) -> list[str | bytes]:
        """Return what the page is to be sent so that it shows a look: its scene as bytes, and
        texts.

        Args:
            session: Where the person is.
            look: What is to be seen there.
            tell: Whether the step is told again though it is the one that was seen.
            watched: A student's file that drives a lesson.
        """
        timeline = look.timeline
        if timeline.failure is not None:
            tell_terminal(AuthorError(timeline.stopped or "", timeline.failure))
        if self.timeline is not timeline or self._updates is None:
            self._run += 1
            self.timeline = timeline
            self._updates = RunUpdates(self._run, self._runs.steps(timeline))
        seen = self._run, look.k, look.known > 0, look.caption, timeline is session.timeline
        new = seen != self._seen
        drawn, trouble = (
            self._scene(look, current=timeline is session.timeline) if new else (None, None)
        )
        told = [self._run_told(self._updates, look, watched)]
        again = new or tell or trouble is not None
        if look.known and again:
            told.append(self._step_told(self._updates, look, trouble))
        elif not look.known and trouble is None and look.caption.text and again:
            told.append({"tell": "trouble", "text": look.caption.text})
        self._seen = seen if trouble is None else None
        return [
            *([] if drawn is None else [drawn]),
            *(packed(message) for message in told if message is not None),
        ]

    def _scene(self, look: Shown, *, current: bool) -> tuple[bytes | None, str | None]:
        """Return the bytes that the page lacks of a scene, or what went wrong; its view is of the
        run that is wanted.

        Nothing where the page shows it: a caption that is another, or a run that is no longer
        wanted, draws nothing anew.
        """
        lesson = look.lesson
        head = {"run": self._run, "k": look.k}
        try:
            with Blaming(f"lesson {lesson.name}", lesson.draw):
                if current or self._view is None or self._view[0] is not lesson:
                    self._view = lesson, self.aim.view(lesson, look.timeline.params)
                wanted = self._run, look.k, look.known > 0, self._view
                if wanted == self._drawn:
                    return None, None
                content = self._wire.step(head, look.scene, self._view[1], stage=lesson.name)
                self._drawn = wanted
                return content, None
        except InputError as error:
            self._drawn = None
            tell_terminal(error)
            return None, str(error)

    def _run_told(
        self, updates: RunUpdates, look: Shown, watched: WatchedFile | None
    ) -> dict[str, Any] | None:
        """Return what is new of the run since it was last told, None when nothing is."""
        is_watched = watched is not None and watched.lesson is look.lesson
        more = {
            "files": files_of(look.own),
            "aside": look.own is not look.params,
            "mark": first_difference(look.timeline.known()) if is_watched else None,
            "called": calls_it(look.timeline) if is_watched else None,
        }
        return updates.run(look.params, known=look.known, finished=look.finished, more=more)

    def _step_told(self, updates: RunUpdates, look: Shown, trouble: str | None) -> dict[str, Any]:
        step = look.timeline[look.k]
        more = {}
        if trouble or look.caption.text != step.caption.text:
            tone = "wrong" if trouble else look.caption.tone
            more = {"caption": trouble or look.caption.text, "tone": tone}
        wrong = step.state.line if isinstance(step.state, StepPair) else 0
        return updates.step(look.k, more, wrong)


def packed(message: Mapping[str, Any]) -> str:
    """Return a message as a page takes it."""
    return json.dumps(message, ensure_ascii=False, separators=(",", ":"))
