"""Follows the files behind a served lesson while they are edited: a student's function, and a
lesson given by its path.

Two threads of their own look at the files and run the checks, so that no file, however long its
code takes, holds up a page.
"""

import threading
from collections.abc import Callable, Iterable
from typing import Any, Protocol

from workbench.authoring.reloading import Edited
from workbench.errors import InputError
from workbench.exercise.watching import RUNNING, WatchedFile
from workbench.lesson import Lesson
from workbench.page.code import text_html
from workbench.page.exercise import report_data
from workbench.page.lessons import lesson_data
from workbench.viewer.terminal import tell_terminal

POLL = 0.3
"""Seconds between two looks at the files."""


class Follower(Protocol):
    """A page, as what is told of a file reaches it; called in a thread of ours."""

    def go_on(self, before: Lesson, after: Lesson, news: dict[str, Any] | None) -> None:
        """Go on in another version of a lesson, where that lesson is open, and tell the page."""

    def tell_where(self, lesson: Lesson, news: dict[str, Any]) -> None:
        """Tell the page something, where that lesson is open."""


class Following:
    """Follows files until it is closed.

    Args:
        lesson: What is served of them first.
        watched: A student's file that drives it.
        edited: Its own files.
        replace: Called with a lesson and its new version when that is to be served instead.
        pages: Returns the pages that are open.
    """

    def __init__(
        self,
        lesson: Lesson,
        watched: WatchedFile | None,
        edited: Edited | None,
        *,
        replace: Callable[[Lesson, Lesson], None],
        pages: Callable[[], Iterable[Follower]],
    ):
        self.watched, self.edited = watched, edited
        self._lesson, self._replace, self._pages = lesson, replace, pages
        self._trouble: InputError | None = None
        self._reported: dict[str, Any] = {}  # what the pages were told last
        self._ended, self._to_check = threading.Event(), threading.Event()
        if watched is not None or edited is not None:
            threading.Thread(target=self._look, name="files", daemon=True).start()
        if watched is not None:
            self._to_check.set()
            threading.Thread(target=self._check, name="checks", daemon=True).start()

    def close(self) -> None:
        """Look no more, and end the student's process."""
        self._ended.set()
        self._to_check.set()
        if self.watched is not None:
            self.watched.close()

    def news(self, lesson: Lesson) -> list[dict[str, Any]]:
        """Return what a page that opens a lesson is told of its files."""
        if lesson is not self._lesson:
            return []
        told = [] if self.watched is None else [exercise_news(self.watched)]
        return told + (
            [] if self._trouble is None else [{"tell": "notice", "text": str(self._trouble)}]
        )

    def _look(self) -> None:
        while not self._ended.wait(POLL):
            try:
                if self.edited is not None and self.edited.changed():
                    self._reload(self.edited)
                if self.watched is not None and self.watched.changed():
                    self._go_on(self.watched.lesson)
                    self._to_check.set()
                if self.watched is not None and self._reported != report_of(self.watched):
                    self._report(self.watched)
            except Exception as error:  # the next save is looked at again
                tell_terminal(error)

    def _check(self) -> None:
        assert self.watched is not None
        while self._to_check.wait() and not self._ended.is_set():
            self._to_check.clear()
            if self.watched.said == RUNNING:
                self.watched.check()
            self._report(self.watched)

    def _reload(self, edited: Edited) -> None:
        """Serve the new lesson, or say what is wrong with it while the one before goes on."""
        trouble, lesson = edited.trouble, edited.lesson
        try:
            if trouble is None and self.watched is not None:
                self.watched.follow(lesson)
                lesson = self.watched.lesson
            data = None if trouble is not None else lesson_data(lesson)
        except InputError as error:
            trouble = error
            data = None
        self._trouble = trouble
        if trouble is not None:
            tell_terminal(trouble)
            self._tell({"tell": "notice", "text": str(trouble)})
            return
        self._go_on(lesson, {"tell": "lesson", "lesson": data})
        if self.watched is not None:
            self._report(self.watched)
            self._to_check.set()

    def _go_on(self, after: Lesson, news: dict[str, Any] | None = None) -> None:
        before = self._lesson
        self._lesson = after
        self._replace(before, after)
        for page in self._pages():
            page.go_on(before, after, news)

    def _report(self, watched: WatchedFile) -> None:
        self._reported = report_of(watched)
        self._tell(exercise_news(watched))

    def _tell(self, news: dict[str, Any]) -> None:
        for page in self._pages():
            page.tell_where(self._lesson, news)


def exercise_news(watched: WatchedFile) -> dict[str, Any]:
    """Return what a page is told of a student's file: its name, its source, and what the checks
    found.
    """
    source = {"name": watched.path.name, "html": text_html(watched.source)}
    return {
        "tell": "exercise",
        "name": watched.exercise.name,
        "source": source,
        "report": report_of(watched),
    }


def report_of(watched: WatchedFile) -> dict[str, Any]:
    """Return what the checks found of a student's file as it is now, and what it printed in the run
    that it drives.
    """
    return report_data(watched.said, watched.printed())
